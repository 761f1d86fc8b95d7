// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cstdio>
#include <odosplat/compute/device.hpp>
#include <odosplat/odometry/odometry.hpp>
#include <odosplat/splat/gaussian_view.hpp>

int main() {
  const odosplat::Camera camera{640, 480, 525.0, 525.0, 319.5, 239.5};
  camera.check();
  for (const auto& device : odosplat::compute::list_devices()) std::printf("%s\n", device.name.c_str());
  return odosplat::OdometryOptions().window.max_keyframes > 0 ? 0 : 1;
}
