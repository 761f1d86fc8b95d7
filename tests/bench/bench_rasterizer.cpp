// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Times of the rasteriser and of a training step, with the yardstick for comparison. Names:
// WORK/GAUSSIANS/WIDTHxHEIGHT; with a map of the user (bench_scene.hpp) also WORK/map/WIDTHxHEIGHT. Real time is the
// time a user waits; process CPU time divided by the number of cores does not depend on other load of the machine.
// Counters: pairs of Gaussian and tile, and `x_ms`, the time of stage x.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "odosplat/core/random.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/train/trainer.hpp"
#include "tests/bench/bench_report.hpp"
#include "tests/bench/bench_scene.hpp"
#include "tests/bench/yardstick.hpp"

namespace odosplat {
namespace {

constexpr int profiled_runs = 5;
bool failed = false;

void fail(benchmark::State& state, const std::string& why) {
  failed = true;
  state.SkipWithError(why.c_str());
}

RenderRequest color_only() {
  RenderRequest request;
  request.color = true;
  request.depth = false;
  return request;
}

struct Bench {
  explicit Bench(const BenchScene& s) : scene(s), rasterizer(context) { gaussians.upload(context, scene.gaussians); }
  void forward(const RenderRequest& request) {
    rasterizer.forward(gaussians, scene.camera, scene.T_world_camera, request, output);
  }
  /// Times `work`, then its stages in separate runs, because timing every kernel adds a wait for each.
  void run(benchmark::State& state, const std::function<void()>& work) {
    work();
    context.finish();
    for (auto _ : state) {
      work();
      context.finish();
    }
    context.set_profiling(true);
    for (int i = 0; i < profiled_runs; ++i) work();
    for (const compute::StageTime& stage : context.stage_times())
      state.counters[stage.stage + "_ms"] = stage.milliseconds / profiled_runs;
    context.set_profiling(false);
    state.counters["pairs"] = static_cast<double>(rasterizer.pairs());
  }
  compute::Context context = compute::Context::open();
  BenchScene scene;
  Rasterizer rasterizer;
  DeviceGaussians gaussians;
  RenderOutput output;
};

void depth_fwd(benchmark::State& state, const BenchScene& scene) {
  Bench bench(scene);
  bench.run(state, [&] { bench.forward({}); });
}

/// Depth at 2000 pixels distributed uniformly at random.
void sparse_depth(benchmark::State& state, const BenchScene& scene) {
  constexpr int wanted = 2000;
  Bench bench(scene);
  Random random(3);
  std::vector<cv::Point> pixels;
  for (int i = 0; i < wanted; ++i) {
    const double x = random.uniform(0.0, scene.camera.width), y = random.uniform(0.0, scene.camera.height);
    pixels.emplace_back(static_cast<int>(x), static_cast<int>(y));
  }
  RenderRequest request;
  request.sigma = true;
  bench.run(state, [&] {
    bench.rasterizer.forward_pixels(bench.gaussians, scene.camera, scene.T_world_camera, request, pixels, bench.output);
  });
}

void color_fwd(benchmark::State& state, const BenchScene& scene) {
  Bench bench(scene);
  bench.run(state, [&] { bench.forward(color_only()); });
}

void fwd_bwd(benchmark::State& state, const BenchScene& scene) {
  Bench bench(scene);
  OutputGradients gradients;
  gradients.color = compute::Buffer<float>(
      bench.context,
      std::vector<float>(
          static_cast<std::size_t>(3 * scene.camera.width) * static_cast<std::size_t>(scene.camera.height), 1.0F));
  DeviceGaussians result;
  bench.run(state, [&] {
    bench.forward(color_only());
    bench.rasterizer.backward(bench.gaussians, gradients, result);
  });
}

/// Training images rendered from the scene itself, from two poses next to each other.
class RenderedViews : public TrainingViews {
 public:
  explicit RenderedViews(Bench& bench) : camera_(bench.scene.camera) {
    for (const double x : {0.0, 0.02}) {
      poses_.push_back(bench.scene.T_world_camera * SE3(Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}));
      bench.rasterizer.forward(bench.gaussians, camera_, poses_.back(), color_only(), bench.output);
      const std::vector<float> planes = bench.output.color.download();
      ColorImage image(camera_.height, camera_.width);
      for (std::size_t i = 0; i < image.total(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
          image[0][i][static_cast<int>(c)] = std::min(planes[c * image.total() + i], 1.0F);
      }
      images_.push_back(image);
    }
  }
  int count() const override { return static_cast<int>(poses_.size()); }
  Camera camera(int) const override { return camera_; }
  SE3 T_world_camera(int i) const override { return poses_[static_cast<std::size_t>(i)]; }
  ColorImage color(int i) override { return images_[static_cast<std::size_t>(i)]; }

 private:
  Camera camera_;
  std::vector<SE3> poses_;
  std::vector<ColorImage> images_;
};

void train_step(benchmark::State& state, const BenchScene& scene) {
  Bench bench(scene);
  RenderedViews views(bench);
  TrainerOptions options;
  options.iterations = 1 << 20;  // so that the learning rates hardly decrease while it is timed
  options.coarse_levels = 0;     // full size from the start
  Trainer trainer(bench.context, options, scene.gaussians, views);
  bench.run(state, [&] { trainer.step(); });
}

/// Share of pixels whose depths differ by more than rounding explains: those where a Gaussian is at the limit of
/// contributing.
double share_of_different(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += std::abs(a[i] - b[i]) <= 1e-3F ? 0 : 1;
  return static_cast<double>(different) / static_cast<double>(a.size());
}

void yardstick_depth_fwd(benchmark::State& state, const BenchScene& scene) {
  if (!Yardstick::supported()) return state.SkipWithError("the yardstick needs AVX2 and FMA");
  Yardstick yardstick(scene.gaussians, scene.camera, scene.T_world_camera);
  yardstick.render();
  Yardstick::Stages sum;
  double runs = 0.0;
  for (auto _ : state) {
    yardstick.render();
    const Yardstick::Stages stages = yardstick.stages();
    sum.project_ms += stages.project_ms;
    sum.sort_ms += stages.sort_ms;
    sum.bin_ms += stages.bin_ms;
    sum.composite_ms += stages.composite_ms;
    runs += 1.0;
  }
  state.counters["project_ms"] = sum.project_ms / runs;
  state.counters["sort_ms"] = sum.sort_ms / runs;
  state.counters["bin_ms"] = sum.bin_ms / runs;
  state.counters["composite_ms"] = sum.composite_ms / runs;
  state.counters["pairs"] = static_cast<double>(yardstick.pairs());
  Bench bench(scene);
  bench.forward({});
  const double share = share_of_different(yardstick.depth(), bench.output.depth.download());
  state.counters["different"] = share;
  if (share > 1e-3) fail(state, "depth of yardstick and rasteriser differ by over 1 mm in " + std::to_string(share));
}

using Work = void (*)(benchmark::State&, const BenchScene&);
struct Named {
  const char* name;
  Work work;
};
constexpr Named works[] = {{"depth_fwd", depth_fwd},       {"yardstick_depth_fwd", yardstick_depth_fwd},
                           {"sparse_depth", sparse_depth}, {"color_fwd", color_fwd},
                           {"fwd_bwd", fwd_bwd},           {"train_step", train_step}};

void add(const Named& named, const std::string& scene_name, int width, int height,
         const std::function<BenchScene()>& make) {
  const std::string name = named.name + ("/" + scene_name) + "/" + std::to_string(width) + "x" + std::to_string(height);
  benchmark::RegisterBenchmark(name.c_str(),
                               [work = named.work, make](benchmark::State& state) { work(state, make()); })
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

void add_all() {
  for (const auto& [width, height] : {std::pair{320, 240}, {640, 480}}) {
    for (const std::size_t n : {10000, 30000, 100000, 300000, 1000000}) {
      for (const Named& named : works)
        add(named, std::to_string(n), width, height, [n, w = width, h = height] { return random_scene(n, w, h); });
    }
    if (!map_scene(width, height)) continue;
    for (const Named& named : works)
      add(named, "map", width, height, [w = width, h = height] { return *map_scene(w, h); });
  }
}

}  // namespace
}  // namespace odosplat

int main(int argc, char** argv) {
  try {
    odosplat::add_all();
    odosplat::run_benchmarks(argc, argv);
    return odosplat::failed ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "odosplat_bench: %s\n", error.what());
    return 2;
  }
}
