// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Rasteriser on the scene of the measured notes: uniform centres on the screen, depths 1..5 m, opacity 0.5, round
// Gaussians of 2 px standard deviation, so that cost depends on the count and the size of the image alone.
#include <benchmark/benchmark.h>

#include <cmath>

#include "odosplat/core/random.hpp"
#include "odosplat/splat/rasterizer.hpp"

namespace odosplat {
namespace {

Camera camera_of(const benchmark::State& state) {
  const auto width = static_cast<int>(state.range(1));
  const auto height = static_cast<int>(state.range(2));
  const double f = 525.0 * width / 640.0;
  return {width, height, f, f, 0.5 * width - 0.5, 0.5 * height - 0.5};
}

Gaussians random_scene(std::size_t n, const Camera& camera) {
  Random random(1);
  Gaussians g;
  g.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = random.uniform(1.0, 5.0);
    const Eigen::Vector3d p =
        z * camera.ray(random.uniform(-0.5, camera.width - 0.5), random.uniform(-0.5, camera.height - 0.5));
    for (int k = 0; k < 3; ++k) {
      g.positions[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(p[k]);
      g.log_scales[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(std::log(2.0 * z / camera.fx));
      g.sh[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(random.uniform(-1.0, 1.0));
    }
    g.rotations[4 * i] = 1.0F;
    g.opacity_logits[i] = 0.0F;
  }
  return g;
}

struct Bench {
  explicit Bench(const benchmark::State& state) : camera(camera_of(state)), rasterizer(context) {
    gaussians.upload(context, random_scene(static_cast<std::size_t>(state.range(0)), camera));
  }
  void forward(const RenderRequest& request) {
    rasterizer.forward(gaussians, camera, SE3(), request, output);
    context.finish();
  }
  compute::Context context = compute::Context::open();
  Camera camera;
  Rasterizer rasterizer;
  DeviceGaussians gaussians;
  RenderOutput output;
};

void depth_fwd(benchmark::State& state) {
  Bench bench(state);
  bench.forward({});
  for (auto _ : state) bench.forward({});
  state.counters["pairs"] = static_cast<double>(bench.rasterizer.pairs());
}

void color_fwd(benchmark::State& state) {
  Bench bench(state);
  RenderRequest request;
  request.color = true;
  request.depth = false;
  bench.forward(request);
  for (auto _ : state) bench.forward(request);
}

void fwd_bwd(benchmark::State& state) {
  Bench bench(state);
  RenderRequest request;
  request.color = true;
  request.depth = false;
  bench.forward(request);
  OutputGradients gradients;
  gradients.color.resize(bench.context, bench.output.color.size());
  gradients.color.upload(std::vector<float>(bench.output.color.size(), 1.0F));
  DeviceGaussians result;
  bench.rasterizer.backward(bench.gaussians, gradients, result);
  for (auto _ : state) {
    bench.rasterizer.forward(bench.gaussians, bench.camera, SE3(), request, bench.output);
    bench.rasterizer.backward(bench.gaussians, gradients, result);
    bench.context.finish();
  }
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int n : {10000, 30000, 100000, 300000, 1000000}) {
    b->Args({n, 640, 480});
    if (n <= 100000) b->Args({n, 320, 240});
  }
  // Real time for what a user waits; process CPU time for what a busy machine cannot distort.
  b->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(depth_fwd)->Apply(sizes);
BENCHMARK(color_fwd)->Apply(sizes);
BENCHMARK(fwd_bwd)->Apply(sizes);

}  // namespace
}  // namespace odosplat
