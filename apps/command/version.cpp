// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/command_line.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/compute/no_device.hpp"

namespace odosplat::apps {
namespace {

const char* compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "an unknown compiler";
#endif
}

}  // namespace

std::string version_text() {
  std::string text = "odosplat " ODOSPLAT_VERSION "\nbuild: ";
  text += compiler();
  text += ", " ODOSPLAT_BUILD_TYPE;
  const std::vector<compute::DeviceInfo> devices = compute::list_devices();
  if (devices.empty()) text += "\ndevice: none; " + compute::no_device_reason();
  for (const compute::DeviceInfo& d : devices) {
    text += "\ndevice " + std::to_string(d.index) + ": " + d.name + " (" + d.platform + ", driver " + d.driver_version +
            ")" + (d.refusal.empty() ? "" : ", refused: " + d.refusal);
  }
  return text;
}

}  // namespace odosplat::apps
