// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

// The only file that includes OpenCL. Private to this folder: no other header of the project may include this one.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "odosplat/compute/context.hpp"

namespace odosplat::compute {

/// Throws DeviceError "CALL: ERROR_NAME (device)" unless status is CL_SUCCESS.
void check(cl_int status, const std::string& call, const std::string& device);
/// "CL_OUT_OF_RESOURCES" for -5 and so on.
std::string error_name(cl_int status);

struct ContextImpl {
  DeviceInfo info;
  cl_device_id device = nullptr;
  cl_context context = nullptr;
  cl_command_queue queue = nullptr;
  std::size_t max_work_group = 1;
  bool profile = false;
  std::function<void()> build_notice;  // empty: none was set, or it has been called
  double build_notice_after_s = 1.0;
  double build_s = 0.0;  // total time of all builds so far
  std::vector<KernelTime> times;
  std::unordered_map<std::string, std::size_t> time_index;

  ContextImpl() = default;
  ContextImpl(const ContextImpl&) = delete;
  ContextImpl& operator=(const ContextImpl&) = delete;
  ~ContextImpl();
};

/// Devices with their OpenCL handles, in the order of list_devices().
struct FoundDevice {
  DeviceInfo info;
  cl_device_id id = nullptr;
};
std::vector<FoundDevice> find_devices();

}  // namespace odosplat::compute
