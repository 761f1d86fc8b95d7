// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The result has the same bits for any number of device threads. PoCL reads that number from the environment when it
// starts, so each number is tested in a separate process.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/splat/raster_scenes.hpp"

namespace odosplat {
namespace {

// Adds the bits to an FNV-1a hash.
void add_to_digest(std::uint64_t& digest, const std::vector<float>& values) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  for (std::size_t i = 0; i < values.size() * sizeof(float); ++i) digest = (digest ^ bytes[i]) * 1099511628211ull;
}

std::uint64_t render_digest() {
  const compute::Context& context = test_context();
  RasterScene scene = overlapping_scene(3000, 1, 77);
  scene.camera = {160, 120, 170.0, 170.0, 79.5, 59.5};
  DeviceGaussians gaussians, gradients;
  gaussians.upload(context, scene.gaussians);
  RenderRequest request;
  request.color = true;
  request.sigma = true;
  RenderOutput output;
  Rasterizer rasterizer = make_rasterizer(Shell::tile);
  rasterizer.forward(gaussians, scene.camera, scene.T_world_camera, request, output);
  OutputGradients given;
  given.color = compute::Buffer<float>(context, std::vector<float>(output.color.size(), 0.3f));
  given.depth = compute::Buffer<float>(context, std::vector<float>(output.depth.size(), -0.7f));
  Vector6d pose;
  rasterizer.backward(gaussians, given, gradients, &pose);
  std::uint64_t digest = 14695981039346656037ull;
  for (const compute::Buffer<float>* buffer :
       {&output.color, &output.depth, &output.alpha, &output.sigma, &gradients.positions, &gradients.log_scales,
        &gradients.rotations, &gradients.opacity_logits, &gradients.sh}) {
    add_to_digest(digest, buffer->download());
  }
  for (double v : pose) add_to_digest(digest, {static_cast<float>(v)});
  return digest;
}

TEST(RasterThreads, DigestIsRepeatable) {
  const std::uint64_t digest = render_digest();
  EXPECT_EQ(digest, render_digest());
  std::printf("digest %llx units %u\n", static_cast<unsigned long long>(digest), test_context().device().compute_units);
}

std::string line_of_child(int threads) {
  const std::string command = "POCL_MAX_PTHREAD_COUNT=" + std::to_string(threads) + " /proc/" +
                              std::to_string(getpid()) +
                              "/exe --gtest_filter=RasterThreads.DigestIsRepeatable 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string found;
  char line[256];
  while (std::fgets(line, sizeof(line), pipe) != nullptr) {
    if (std::string(line).rfind("digest ", 0) == 0) found = line;
  }
  pclose(pipe);
  return found;
}

TEST(RasterThreads, BitsDoNotDependOnThreads) {
  if (test_context().device().platform.find("Portable Computing Language") == std::string::npos) {
    GTEST_SKIP() << "only PoCL takes its number of threads from the environment";
  }
  std::vector<std::string> digests, units;
  for (int threads : {1, 2, 5}) {
    const std::string line = line_of_child(threads);
    const std::size_t split = line.find(" units ");
    ASSERT_NE(split, std::string::npos) << "with " << threads << " threads: " << line;
    digests.push_back(line.substr(0, split));
    units.push_back(line.substr(split));
  }
  EXPECT_NE(units[0], units[2]) << "the environment had no effect";
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

}  // namespace
}  // namespace odosplat
