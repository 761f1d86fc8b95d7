// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// An OpenGL 3.2 core context without a window or X server, current in the thread that created it until it is
/// destroyed. Tried in this order: a GPU among EGL's devices (EGL_EXT_platform_device), Mesa's surfaceless platform
/// (software, EGL_MESA_platform_surfaceless), any other EGL device. Several may exist at a time, also in several
/// threads. Throws std::runtime_error that names each attempt and why it failed.
class EglContext {
 public:
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void make_current();
  /// The platform that was used: "EGL device 0", "Mesa surfaceless".
  const std::string& platform() const { return platform_; }

 private:
  // EGL's handles as plain pointers, because EGL's header includes those of X.
  bool try_display(void* display, const std::string& platform, std::string& faults);

  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;
  std::string platform_;
};

}  // namespace odosplat
