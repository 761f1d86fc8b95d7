// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace odosplat::compute {

enum class DeviceType { cpu, gpu, other };

/// The user asked for a device that does not exist or is refused. The message is one line; programs exit with 2.
class NoSuchDevice : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One OpenCL device as `odosplat devices` shows it. `index` is its place in the list, over all platforms, in the order
/// that the OpenCL loader reports; it is what --device INDEX means.
struct DeviceInfo {
  int index = 0;
  std::string name;
  std::string vendor;
  std::string platform;
  std::string driver_version;
  std::string opencl_version;
  DeviceType type = DeviceType::other;
  unsigned compute_units = 0;
  double memory_gib = 0.0;
  std::string refusal;  // why it is not used; empty: usable
};

/// Number of threads of PoCL's CPU device. Has an effect only before devices are listed or opened for the first time,
/// because PoCL starts its threads then. Other runtimes ignore it.
void set_cpu_threads(int n);

/// All devices of all platforms; empty if no OpenCL is installed.
std::vector<DeviceInfo> list_devices();

/// Picks from `devices`: selector is an index, a part of a name (device or platform, case ignored), or empty, which
/// means the environment variable ODOSPLAT_DEVICE, else the first usable GPU, else the first usable CPU.
/// Throws NoSuchDevice when nothing fits, or when what fits is refused (with the reason).
const DeviceInfo& choose_device(const std::vector<DeviceInfo>& devices, const std::string& selector);

}  // namespace odosplat::compute
