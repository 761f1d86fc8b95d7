// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <new>
#include <opencv2/core.hpp>
#include <string>

#include "apps/command/interrupt.hpp"
#include "apps/command/no_result.hpp"
#include "apps/python/bindings.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::python {
namespace {

PyObject* input_error = nullptr;
PyObject* device_error = nullptr;
PyObject* no_result = nullptr;

/// Messages of code that the program and the module share name the program's flags: "--what: must be" becomes "what:
/// must be".
std::string without_dashes(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || text[i - 1] == ' ' || text[i - 1] == '(';
    const bool flag = begins && text.compare(i, 2, "--") == 0 && i + 2 < text.size() &&
                      std::islower(static_cast<unsigned char>(text[i + 2])) != 0;
    if (!flag) {
      plain += text[i];
      continue;
    }
    for (i += 2; i < text.size() && (std::islower(static_cast<unsigned char>(text[i])) != 0 || text[i] == '-'); ++i) {
      plain += text[i] == '-' ? '_' : text[i];
    }
    --i;
  }
  return plain;
}

/// Bytes that are no UTF-8, as in names of files, become U+FFFD.
void raise(PyObject* type, const std::string& message) {
  const std::string text = without_dashes(message);
  PyObject* object = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (object == nullptr) return;  // the interpreter has set another error
  PyErr_SetObject(type, object);
  Py_DECREF(object);
}

void translate(std::exception_ptr error) {
  try {
    std::rethrow_exception(std::move(error));
  } catch (const InputError& e) {
    raise(input_error, e.what());
  } catch (const apps::NoResult& e) {
    raise(no_result, e.what());
  } catch (const compute::NoSuchDevice& e) {
    raise(device_error, e.what());
  } catch (const compute::DeviceError& e) {
    raise(device_error, e.what());
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const std::filesystem::filesystem_error& e) {
    raise(PyExc_OSError, e.what());
  } catch (const cv::Exception& e) {
    // OpenCV reports a lack of memory by an exception of its own.
    if (e.code == cv::Error::StsNoMem) {
      PyErr_NoMemory();
    } else {
      raise(PyExc_RuntimeError, e.what());
    }
  }
}

PyObject* new_error(py::module_& m, const char* name, PyObject* base, const char* doc) {
  const std::string full = std::string("odosplat.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  m.attr(name) = py::handle(type);
  return type;
}

}  // namespace

void bind_errors(py::module_& m) {
  input_error = new_error(m, "InputError", PyExc_ValueError,
                          "Bad input, which the caller can correct. The message is one line that names the file or the "
                          "argument, the place in it, and the fault.");
  device_error = new_error(m, "DeviceError", PyExc_RuntimeError,
                           "There is no such OpenCL device, or it failed. The message says what to install.");
  no_result = new_error(m, "NoResult", PyExc_RuntimeError,
                        "The work was done, but its result cannot be used, such as an estimate of which less than half "
                        "matches the truth.");
  py::register_exception_translator(&translate);
}

void throw_if_signalled() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace odosplat::python

namespace odosplat::apps {

/// In place of the program's, which sets a flag in a signal handler of its own: here the interpreter handles signals.
bool interrupted() {
  python::throw_if_signalled();
  return false;
}

}  // namespace odosplat::apps
