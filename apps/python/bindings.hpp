// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <vector>

#include "apps/input/frame_range.hpp"
#include "apps/input/public_options.hpp"
#include "odosplat/compute/context.hpp"

namespace odosplat::python {

namespace py = pybind11;

/// The parts of the module odosplat._core, which the package's Python files call.
void bind_errors(py::module_& m);
void bind_devices(py::module_& m);
void bind_cameras(py::module_& m);
void bind_maps(py::module_& m);
void bind_sequences(py::module_& m);
void bind_clouds(py::module_& m);
void bind_training(py::module_& m);
void bind_tracking(py::module_& m);
void bind_relocalisation(py::module_& m);
void bind_evaluation(py::module_& m);
void bind_checks(py::module_& m);

/// Throws Python's KeyboardInterrupt, or what a signal handler of the user's raised, if a signal came. Called from the
/// work of long calls, with or without the interpreter's lock.
void throw_if_signalled();

/// Opens a device; selector as in compute::choose_device. Without the interpreter's lock.
compute::Context open_device(const std::string& selector);

/// Lines "NAME=VALUE" as options of these groups.
apps::OptionValues options_from(const std::vector<std::string>& lines, const std::vector<std::string>& groups);

/// (begin, end) as a range of frames; None: all.
apps::FrameRange frames_from(const py::handle& frames);

}  // namespace odosplat::python
