// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/device.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "odosplat/compute/no_device.hpp"
#include "odosplat/compute/opencl.hpp"

namespace odosplat::compute {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || std::isspace(static_cast<unsigned char>(text.back())) != 0)) {
    text.pop_back();
  }
  const std::size_t start = text.find_first_not_of(" \t");
  return start == std::string::npos ? std::string() : text.substr(start);
}

std::string text_of(cl_device_id id, cl_device_info what) {
  std::size_t size = 0;
  if (clGetDeviceInfo(id, what, 0, nullptr, &size) != CL_SUCCESS) return {};
  std::string text(size, '\0');
  clGetDeviceInfo(id, what, size, text.data(), nullptr);
  return trimmed(text);
}

std::string text_of(cl_platform_id id, cl_platform_info what) {
  std::size_t size = 0;
  if (clGetPlatformInfo(id, what, 0, nullptr, &size) != CL_SUCCESS) return {};
  std::string text(size, '\0');
  clGetPlatformInfo(id, what, size, text.data(), nullptr);
  return trimmed(text);
}

template <typename T>
T value_of(cl_device_id id, cl_device_info what) {
  T value{};
  clGetDeviceInfo(id, what, sizeof(value), &value, nullptr);
  return value;
}

std::string refusal_of(const DeviceInfo& info) {
  const std::string all = lower(info.platform + " " + info.name);
  if (all.find("rusticl") != std::string::npos || all.find("llvmpipe") != std::string::npos) {
    return "Mesa's rusticl on llvmpipe returns wrong pixels; install pocl-opencl-icd for this CPU";
  }
  return {};
}

DeviceInfo describe(cl_device_id id, const std::string& platform, int index) {
  DeviceInfo info;
  info.index = index;
  info.name = text_of(id, CL_DEVICE_NAME);
  info.vendor = text_of(id, CL_DEVICE_VENDOR);
  info.platform = platform;
  info.driver_version = text_of(id, CL_DRIVER_VERSION);
  info.opencl_version = text_of(id, CL_DEVICE_VERSION);
  const auto type = value_of<cl_device_type>(id, CL_DEVICE_TYPE);
  if ((type & CL_DEVICE_TYPE_GPU) != 0) {
    info.type = DeviceType::gpu;
  } else if ((type & CL_DEVICE_TYPE_CPU) != 0) {
    info.type = DeviceType::cpu;
  }
  info.compute_units = value_of<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS);
  info.memory_gib = static_cast<double>(value_of<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE)) / 1073741824.0;
  info.refusal = refusal_of(info);
  return info;
}

std::string names_of(const std::vector<DeviceInfo>& devices) {
  std::string names;
  for (const DeviceInfo& d : devices) names += (names.empty() ? "" : ", ") + std::to_string(d.index) + " " + d.name;
  return names.empty() ? "none; " + no_device_reason() : names;
}

const DeviceInfo* first_usable(const std::vector<DeviceInfo>& devices, DeviceType type) {
  for (const DeviceInfo& d : devices) {
    if (d.type == type && d.refusal.empty()) return &d;
  }
  return nullptr;
}

}  // namespace

void set_cpu_threads(int n) { setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(n).c_str(), 1); }

std::vector<FoundDevice> find_devices() {
  // PoCL aborts if the variable is set but empty.
  if (const char* folder = std::getenv("POCL_CACHE_DIR"); folder != nullptr && *folder == '\0')
    unsetenv("POCL_CACHE_DIR");
  cl_uint platform_count = 0;
  if (clGetPlatformIDs(0, nullptr, &platform_count) != CL_SUCCESS || platform_count == 0) return {};
  std::vector<cl_platform_id> platforms(platform_count);
  check(clGetPlatformIDs(platform_count, platforms.data(), nullptr), "clGetPlatformIDs", "any device");
  std::vector<FoundDevice> found;
  for (const cl_platform_id platform : platforms) {
    cl_uint count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS) continue;
    std::vector<cl_device_id> ids(count);
    check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr), "clGetDeviceIDs", "any device");
    for (const cl_device_id id : ids) {
      found.push_back({describe(id, text_of(platform, CL_PLATFORM_NAME), static_cast<int>(found.size())), id});
    }
  }
  return found;
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> infos;
  for (const FoundDevice& d : find_devices()) infos.push_back(d.info);
  return infos;
}

const DeviceInfo& choose_device(const std::vector<DeviceInfo>& devices, const std::string& selector) {
  std::string wanted = selector;
  std::string asked_by = "--device ";
  if (wanted.empty()) {
    const char* variable = std::getenv("ODOSPLAT_DEVICE");
    wanted = variable != nullptr ? variable : "";
    asked_by = "ODOSPLAT_DEVICE=";
  }
  if (wanted.empty()) {
    if (const DeviceInfo* gpu = first_usable(devices, DeviceType::gpu)) return *gpu;
    if (const DeviceInfo* cpu = first_usable(devices, DeviceType::cpu)) return *cpu;
    for (const DeviceInfo& d : devices) {
      if (!d.refusal.empty()) throw NoSuchDevice("OpenCL device " + d.name + " is refused: " + d.refusal);
    }
    throw NoSuchDevice("no OpenCL device was found; " + no_device_reason());
  }
  const bool is_index = std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const DeviceInfo* refused = nullptr;
  for (const DeviceInfo& d : devices) {
    const bool fits = is_index ? std::to_string(d.index) == wanted
                               : lower(d.name + "\n" + d.platform).find(lower(wanted)) != std::string::npos;
    if (!fits) continue;
    if (d.refusal.empty()) return d;
    refused = &d;
  }
  if (refused != nullptr)
    throw NoSuchDevice(asked_by + wanted + ": " + refused->name + " is refused: " + refused->refusal);
  throw NoSuchDevice(asked_by + wanted + ": no such OpenCL device; there are: " + names_of(devices));
}

}  // namespace odosplat::compute
