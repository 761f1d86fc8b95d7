// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// exercise_kernels OUT [large]: launches every kernel, in both shells and all variants that the libraries build, on a
// tiny scene (at most 48 x 32 pixels, fewer than 100 Gaussians), or with `large` on one of 160 x 120 pixels and 400
// Gaussians. Writes to OUT a line "launched KERNEL" for each kernel and a line "array NAME VALUES..." for each result.
// The scripts beside it (memory checker, offline compilers, comparison of runtimes) all use this output. Exit status 1:
// the two ways to sort disagree, or the device failed.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/constants.h"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/raster/raster_pairs.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"
#include "odosplat/splat/raster/viewpoint.hpp"
#include "odosplat/splat/train/adam.hpp"
#include "odosplat/splat/train/depth_loss.hpp"
#include "odosplat/splat/train/exposures.hpp"
#include "odosplat/splat/train/losses.hpp"
#include "odosplat/splat/train/surface_terms.hpp"
#include "tests/splat/raster_scenes.hpp"

namespace odosplat {
namespace {

using compute::Buffer;

class Exercise {
 public:
  explicit Exercise(bool large) : large_(large) {
    context_.set_profiling(true);
    const compute::DeviceInfo& device = context_.device();
    std::cout << device.name << " (" << device.platform << ", driver " << device.driver_version << ")" << std::endl;
    if (large) {
      scene_ = overlapping_scene(400, 3, 77);
      scene_.camera = {160, 120, 170.0, 170.0, 79.5, 59.5};
    } else {
      scene_ = overlapping_scene(60, 3, 1);
    }
  }
  void sorts();
  void rasters();
  void losses();
  void training_terms();
  void adam();
  void write(const std::string& path) const;

 private:
  void keep(const std::string& name, const std::vector<float>& values) { arrays_.emplace_back(name, values); }
  void raster(Rasterizer& rasterizer, const std::string& name, const RenderRequest& request);
  Buffer<float> some_gradient(std::size_t n) const;

  compute::Context context_ = compute::Context::open();
  bool large_;
  RasterScene scene_;
  std::vector<std::pair<std::string, std::vector<float>>> arrays_;
};

Buffer<float> Exercise::some_gradient(std::size_t n) const {
  Random random(n);
  std::vector<float> values(n);
  for (float& v : values) v = static_cast<float>(random.uniform(-1.0, 1.0));
  return {context_, values};
}

// Scan and sort over chunks and over groups, and both ways to sort pairs.
void Exercise::sorts() {
  const std::size_t n = large_ ? 5000 : 70;
  std::vector<std::uint32_t> orders[2], sums[2];
  for (const compute::Layout layout : {compute::Layout::chunks, compute::Layout::groups}) {
    Random random(9);
    std::vector<std::uint32_t> values(n);
    for (std::uint32_t& v : values) v = random.below(1000);
    const Buffer<std::uint32_t> keys(context_, values);
    Buffer<std::uint32_t> out;
    const bool groups = layout == compute::Layout::groups;
    compute::Scan(context_, layout).exclusive(keys, n, out);
    sums[groups] = out.download();
    compute::RadixSort(context_, layout).sort(keys, n, out, 10);
    orders[groups] = out.download();
  }
  if (orders[0] != orders[1] || sums[0] != sums[1]) throw std::runtime_error("sort over chunks and groups disagree");
  // Projects with one Gaussian per item, then sorts the pairs in both ways: normally the counting sort is used only on
  // CPUs.
  const compute::Program program(context_, {"raster_common.cl", "projection.cl", "tiles.cl", "project.cl"}, "-D GW=1");
  const Viewpoint view = make_viewpoint(scene_.camera, scene_.T_world_camera);
  DeviceGaussians gaussians;
  gaussians.upload(context_, scene_.gaussians);
  const std::size_t count = gaussians.size();
  const WantedTiles all{0, Buffer<std::uint32_t>(context_, 0)};
  const Buffer<float> splats(context_, 16 * count), boxes(context_, 8 * (count + 1));
  const Buffer<std::uint32_t> none(context_, 0), depth_keys(context_, count), counts(context_, count);
  program.kernel("project")(compute::Range::linear(count, ITEM_GROUP), static_cast<std::int32_t>(count),
                            std::int32_t{0}, none, gaussians.positions, gaussians.log_scales, gaussians.rotations,
                            gaussians.opacity_logits, view.pose, view.lens, view.grid, 0.3F, std::int32_t{0},
                            std::int32_t{1}, std::int32_t{0}, all.sparse, all.blocks, splats, boxes, depth_keys,
                            counts);
  std::vector<std::uint32_t> lists[2], slots[2];
  for (const bool long_chunks : {false, true}) {
    RasterPairs pairs(context_, program, long_chunks);
    pairs.build(count, 1, boxes, depth_keys, counts, view.grid, all);
    lists[long_chunks] = pairs.list().download();
    slots[long_chunks] = pairs.slot().download();
  }
  if (lists[0].empty() || lists[0] != lists[1] || slots[0] != slots[1]) {
    throw std::runtime_error("radix sort and counting sort disagree");
  }
  keep("pairs", std::vector<float>(lists[0].begin(), lists[0].end()));
}

void Exercise::raster(Rasterizer& rasterizer, const std::string& name, const RenderRequest& request) {
  DeviceGaussians gaussians;
  gaussians.upload(context_, scene_.gaussians);
  RenderOutput output;
  rasterizer.forward(gaussians, scene_.camera, scene_.T_world_camera, request, output);
  keep(name + ".color", output.color.download());
  keep(name + ".depth", output.depth.download());
  keep(name + ".alpha", output.alpha.download());
  keep(name + ".sigma", output.sigma.download());
  // The same at some pixels only, one of them twice.
  const int width = scene_.camera.width, height = scene_.camera.height;
  const std::vector<cv::Point> places{{0, 0}, {width - 1, height - 1}, {width / 2, height / 2}, {3, 5}, {3, 5}};
  RenderOutput some;
  Rasterizer(context_, rasterizer.options())
      .forward_pixels(gaussians, scene_.camera, scene_.T_world_camera, request, places, some);
  keep(name + ".some_alpha", some.alpha.download());
  if (request.sigma) return;  // sigma has no gradient: the backward pass is the same as without it
  OutputGradients given;
  given.color = some_gradient(output.color.size());
  if (request.depth_mode != DepthMode::surface) given.depth = some_gradient(output.depth.size());
  given.alpha = some_gradient(output.alpha.size());
  DeviceGaussians gradients;
  Vector6d pose;
  rasterizer.backward(gaussians, given, gradients, &pose);
  keep(name + ".d_positions", gradients.positions.download());
  keep(name + ".d_log_scales", gradients.log_scales.download());
  keep(name + ".d_rotations", gradients.rotations.download());
  keep(name + ".d_opacity_logits", gradients.opacity_logits.download());
  keep(name + ".d_sh", gradients.sh.download());
  keep(name + ".d_pose", std::vector<float>(pose.begin(), pose.end()));
}

// All combinations of requested images; the degree of the harmonics varies.
void Exercise::rasters() {
  for (const Shell shell : {Shell::tile, Shell::pixel}) {
    RasterizerOptions options;
    options.shell = shell;
    options.compensated = shell == Shell::pixel;
    Rasterizer rasterizer(context_, options);
    RenderRequest request;
    request.sh_degree = 0;
    for (const bool color : {false, true}) {
      request.color = color;
      for (const DepthMode mode : {DepthMode::expected, DepthMode::median, DepthMode::blended, DepthMode::surface}) {
        for (const bool depth : {false, true}) {
          if (!depth && mode != DepthMode::expected) continue;
          for (const bool sigma : {false, true}) {
            if (sigma && (!depth || (mode != DepthMode::expected && mode != DepthMode::surface))) continue;
            request.depth = depth;
            request.depth_mode = mode;
            request.sigma = sigma;
            const std::string name = std::string(shell == Shell::tile ? "tile" : "pixel") + (color ? ".rgb" : "") +
                                     (depth ? ".mode" + std::to_string(static_cast<int>(mode)) : "") +
                                     (sigma ? ".sigma" : "");
            raster(rasterizer, name, request);
            if (color) request.sh_degree = (request.sh_degree + 1) % 4;
          }
        }
      }
    }
  }
}

void Exercise::losses() {
  const int width = scene_.camera.width, height = scene_.camera.height;
  const std::size_t n = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Random random(8);
  std::vector<float> a(n), b(n);
  for (float& v : a) v = static_cast<float>(random.uniform(0.0, 1.0));
  for (float& v : b) v = static_cast<float>(random.uniform(0.0, 1.0));
  for (const ColorTerm term : {ColorTerm::l1, ColorTerm::squared_l2}) {
    LossOptions options;
    options.color_term = term;
    ImageLoss loss(context_, options);
    Buffer<float> gradient;
    loss.evaluate(Buffer<float>(context_, a), Buffer<float>(context_, b), width, height, gradient);
    const std::string name = term == ColorTerm::l1 ? "loss.l1" : "loss.l2";
    keep(name + ".gradient", gradient.download());
    keep(name + ".value", {static_cast<float>(loss.value().loss), static_cast<float>(loss.value().ssim)});
  }
}

// The terms of training other than the image loss.
void Exercise::training_terms() {
  const int width = scene_.camera.width, height = scene_.camera.height;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Random random(10);
  std::vector<float> depth(pixels), target(pixels), weight(pixels, 0.5F);
  for (std::size_t i = 0; i < pixels; ++i) {
    target[i] = static_cast<float>(random.uniform(1.0, 2.0));
    depth[i] = i % 7 == 0 ? 0.0F : target[i] * static_cast<float>(random.uniform(0.97, 1.03));
  }
  DepthLoss depth_loss(context_, {});
  Buffer<float> gradient;
  depth_loss.evaluate({context_, depth}, {context_, target}, {context_, weight}, width, height, gradient);
  keep("depth_loss.gradient", gradient.download());

  Exposures exposures(context_, {1e-3, 0.1}, 1);
  const Buffer<float> rendered = some_gradient(3 * pixels);
  Buffer<float> exposed, by_exposed = some_gradient(3 * pixels);
  exposures.apply(0, rendered, exposed);
  exposures.backward(0, rendered, width, height, by_exposed);
  keep("exposed", exposed.download());
  keep("exposed.gradient", by_exposed.download());

  DeviceGaussians gaussians, gradients;
  gaussians.upload(context_, scene_.gaussians);
  gradients.upload(context_, scene_.gaussians);
  SurfaceTerms(context_, {1.0, 1.0, 1.0}).add(gaussians, {context_, surface_anchors(scene_.gaussians)}, gradients);
  keep("surface_terms.d_rotations", gradients.rotations.download());

  const std::size_t n = gaussians.size();
  Buffer<float> pulls = some_gradient(n), seen = some_gradient(n);
  const Buffer<std::uint32_t> counts(context_, std::vector<std::uint32_t>(n, 1));
  compute::Program(context_, {"screen_statistics.cl"})
      .kernel("screen_statistics")(compute::Range::linear(n, ITEM_GROUP), static_cast<std::int32_t>(n), counts,
                                   some_gradient(2 * n), 1.0F, pulls, seen);
  keep("pulls", pulls.download());
}

void Exercise::adam() {
  Adam adam(context_, {}, 5, 2, 0.1F);
  Buffer<float> parameters = some_gradient(103);
  for (int i = 0; i < 2; ++i) adam.step(parameters, some_gradient(103), 0.01);
  keep("adam.step", parameters.download());
  adam.limit(parameters, some_gradient(103));
  keep("adam.limit", parameters.download());
}

void Exercise::write(const std::string& path) const {
  std::ofstream out(path);
  for (const compute::KernelTime& time : context_.kernel_times()) out << "launched " << time.name << "\n";
  out << std::setprecision(9);
  for (const auto& [name, values] : arrays_) {
    out << "array " << name;
    for (const float v : values) out << ' ' << v;
    out << "\n";
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace
}  // namespace odosplat

int main(int argc, char** argv) {
  if (argc != 2 && !(argc == 3 && std::strcmp(argv[2], "large") == 0)) {
    std::cerr << "exercise_kernels OUT [large]\n";
    return 2;
  }
  try {
    odosplat::Exercise exercise(argc == 3);
    exercise.sorts();
    exercise.rasters();
    exercise.losses();
    exercise.training_terms();
    exercise.adam();
    exercise.write(argv[1]);
  } catch (const std::exception& e) {
    std::cerr << "exercise_kernels: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
