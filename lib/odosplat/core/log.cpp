// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "odosplat/core/error.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat {
namespace {

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = std::make_shared<spdlog::logger>("odosplat", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    made->set_pattern("%^%l%$: %v");
    return made;
  }();
  return *instance;
}

}  // namespace

void log_debug(const std::string& message) { logger().debug("{}", printable_line(message)); }
void log_info(const std::string& message) { logger().info("{}", printable_line(message)); }
void log_warning(const std::string& message) { logger().warn("{}", printable_line(message)); }
bool logs_info() { return logger().should_log(spdlog::level::info); }

void set_log_level(const std::string& level) {
  if (level == "debug") {
    logger().set_level(spdlog::level::debug);
  } else if (level == "info") {
    logger().set_level(spdlog::level::info);
  } else if (level == "warning") {
    logger().set_level(spdlog::level::warn);
  } else if (level == "off") {
    logger().set_level(spdlog::level::off);
  } else {
    throw InputError("--log", "must be debug, info, warning or off, is " + level);
  }
}

}  // namespace odosplat
