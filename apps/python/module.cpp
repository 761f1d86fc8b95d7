// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The module odosplat._core: what the Python files of the package odosplat call. It has no public names of its own.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>

#include "apps/python/bindings.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::python {

apps::OptionValues options_from(const std::vector<std::string>& lines, const std::vector<std::string>& groups) {
  try {
    return {lines, groups};
  } catch (const InputError& e) {
    const std::string fault = e.what();
    const std::string flag = "--set: ";
    throw InputError("options", fault.starts_with(flag) ? fault.substr(flag.size()) : fault);
  }
}

apps::FrameRange frames_from(const py::handle& frames) {
  apps::FrameRange range;
  if (frames.is_none()) return range;
  try {
    const auto [begin, end] = frames.cast<std::pair<std::size_t, std::optional<std::size_t>>>();
    range.begin = begin;
    if (end) range.end = *end;
  } catch (const py::cast_error&) {
    throw InputError("frames", "must be (begin, end), counted from 0, end excluded; end None: to the last");
  }
  if (range.begin >= range.end) throw InputError("frames", "must be (begin, end) with begin < end");
  return range;
}

namespace {

py::list options() {
  py::list list;
  for (const apps::PublicOption& option : apps::public_options()) {
    py::dict row;
    row["name"] = option.name;
    row["default"] = option.is_whole() ? py::object(py::int_(std::stol(option.default_text())))
                                       : py::object(py::float_(std::stod(option.default_text())));
    row["least"] = option.least;
    row["most"] = option.most;
    row["unit"] = option.unit;
    row["meaning"] = option.meaning;
    list.append(row);
  }
  return list;
}

/// pybind11 before 2.12 reads arrays of numpy 2 at wrong places, without an error.
void require_numpy_that_fits() {
#if PYBIND11_VERSION_HEX < 0x020C0000
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (std::stoi(version) < 2) return;
  const std::string fault = "odosplat was built with a pybind11 before 2.12, which needs numpy 1; here is numpy " +
                            version + ": install numpy<2, or build odosplat by pip";
  throw py::import_error(fault.c_str());
#endif
}

}  // namespace
}  // namespace odosplat::python

PYBIND11_MODULE(_core, m) {
  using namespace odosplat::python;
  require_numpy_that_fits();
  m.attr("version") = ODOSPLAT_VERSION;
  bind_errors(m);
  bind_devices(m);
  bind_cameras(m);
  bind_maps(m);
  bind_sequences(m);
  bind_clouds(m);
  bind_training(m);
  bind_tracking(m);
  bind_relocalisation(m);
  bind_evaluation(m);
  bind_checks(m);
  m.def("options", &options);
}
