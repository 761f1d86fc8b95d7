// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/command/json_text.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/compute/no_device.hpp"

namespace odosplat::apps {
namespace {

const char* word_for(compute::DeviceType type) {
  switch (type) {
    case compute::DeviceType::cpu:
      return "cpu";
    case compute::DeviceType::gpu:
      return "gpu";
    default:
      return "other";
  }
}

void print_table(const std::vector<compute::DeviceInfo>& devices, int chosen) {
  if (devices.empty()) print("no OpenCL device was found; %s\n", compute::no_device_reason().c_str());
  for (const compute::DeviceInfo& d : devices) {
    print("%c %d  %s  [%s, %u units, %.1f GiB]\n     %s, driver %s, %s\n", d.index == chosen ? '*' : ' ', d.index,
          d.name.c_str(), word_for(d.type), d.compute_units, d.memory_gib, d.platform.c_str(), d.driver_version.c_str(),
          d.opencl_version.c_str());
    if (!d.refusal.empty()) print("     refused: %s\n", d.refusal.c_str());
  }
}

void print_json(const std::vector<compute::DeviceInfo>& devices, int chosen) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const compute::DeviceInfo& d : devices) {
    list.push_back({{"index", d.index},
                    {"name", d.name},
                    {"vendor", d.vendor},
                    {"platform", d.platform},
                    {"driver_version", d.driver_version},
                    {"opencl_version", d.opencl_version},
                    {"type", word_for(d.type)},
                    {"compute_units", d.compute_units},
                    {"memory_gib", d.memory_gib},
                    {"usable", d.refusal.empty()},
                    {"refusal", d.refusal},
                    {"chosen", d.index == chosen}});
  }
  print("%s", json_text(list).c_str());
}

}  // namespace

void add_devices(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "devices", "list OpenCL devices; * marks the one that would be used");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print JSON");
  command->final_callback([&common, json] {
    const std::vector<compute::DeviceInfo> devices = compute::list_devices();
    // The list is printed even if no device can be selected automatically; it is an error only if --device names one
    // that does not exist.
    int chosen = -1;
    if (!devices.empty() || !common.device.empty()) {
      try {
        chosen = compute::choose_device(devices, common.device).index;
      } catch (const compute::NoSuchDevice&) {
        if (!common.device.empty()) throw;
      }
    }
    *json ? print_json(devices, chosen) : print_table(devices, chosen);
  });
}

}  // namespace odosplat::apps
