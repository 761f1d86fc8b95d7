// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/stl.h>

#include "apps/python/bindings.hpp"
#include "odosplat/compute/build_notice.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/compute/no_device.hpp"
#include "odosplat/compute/program.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat::python {
namespace {

const char* word_for(compute::DeviceType type) {
  if (type == compute::DeviceType::cpu) return "cpu";
  return type == compute::DeviceType::gpu ? "gpu" : "other";
}

py::list devices() {
  std::vector<compute::DeviceInfo> found;
  {
    const py::gil_scoped_release unlocked;
    found = compute::list_devices();
  }
  py::list list;
  for (const compute::DeviceInfo& d : found) {
    py::dict row;
    row["index"] = d.index;
    row["name"] = d.name;
    row["vendor"] = d.vendor;
    row["platform"] = d.platform;
    row["driver_version"] = d.driver_version;
    row["opencl_version"] = d.opencl_version;
    row["type"] = word_for(d.type);
    row["compute_units"] = d.compute_units;
    row["memory_gib"] = d.memory_gib;
    row["refusal"] = d.refusal;
    list.append(row);
  }
  return list;
}

void use_threads(int n) {
  require(n >= 1, "threads", "at least 1, is " + std::to_string(n));
  set_threads(n);
  compute::set_cpu_threads(n);
}

}  // namespace

compute::Context open_device(const std::string& selector) {
  compute::Context context = compute::Context::open(selector);
  compute::set_build_notice(
      context, [] { log_info("building OpenCL kernels, once per device and version: the next start is quick"); });
  log_info("device " + context.device().name + " (" + context.device().platform + ")");
  if (const std::string fault = compute::program_cache_fault(); !fault.empty()) log_warning(fault);
  return context;
}

void bind_devices(py::module_& m) {
  m.def("devices", &devices);
  m.def("set_threads", &use_threads);
  m.def("threads", &threads);
  m.def("set_log_level", &set_log_level);
}

}  // namespace odosplat::python
