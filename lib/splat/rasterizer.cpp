// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/rasterizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/kernels/constants.h"
#include "odosplat/splat/raster_pairs.hpp"

namespace odosplat {
namespace {

using compute::Buffer;
using compute::Kernel;
using compute::Program;
using compute::Range;

// Pixels of a row that the tile shell handles at once: on AVX-512, 8 cost 20 to 30 % more.
constexpr int forward_width = 16;
constexpr int backward_width = 16;
constexpr int splat_floats = 12;  // SPLAT_VECTORS of four
constexpr int box_floats = 8;
constexpr std::size_t max_pixels = std::size_t{1} << 28;
static_assert(RasterizerOptions{}.dilation == DILATION);

std::string define(const std::string& name, int value) { return " -D " + name + "=" + std::to_string(value); }

Shell chosen_shell(Shell wanted, const compute::Context& context) {
  if (wanted != Shell::automatic) return wanted;
  if (const char* name = std::getenv("ODOSPLAT_SHELL"); name != nullptr && *name != '\0') {
    if (std::string(name) == "tile") return Shell::tile;
    if (std::string(name) == "pixel") return Shell::pixel;
    throw InputError("ODOSPLAT_SHELL", "must be tile or pixel, is " + std::string(name));
  }
  return context.is_cpu() ? Shell::tile : Shell::pixel;
}

// Number of the mode in raster_common.cl.
int mode_number(bool depth, DepthMode mode) {
  if (!depth) return 0;
  if (mode == DepthMode::expected) return 1;
  return mode == DepthMode::median ? 2 : 3;
}

// What of the camera and the pose the kernels take.
struct Viewpoint {
  std::array<float, 16> pose{};
  std::array<float, 8> lens{};
  std::array<std::int32_t, 4> grid{};  // width, height, tiles a row, rows of tiles
  std::size_t tiles = 0;
};

Viewpoint make_viewpoint(const Camera& camera, const SE3& T_world_camera) {
  Viewpoint view;
  const SE3 T_camera_world = T_world_camera.inverse();
  const Eigen::Matrix3d R = T_camera_world.rotation_matrix();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) view.pose[static_cast<std::size_t>(3 * r + c)] = static_cast<float>(R(r, c));
    view.pose[static_cast<std::size_t>(9 + r)] = static_cast<float>(T_camera_world.translation()[r]);
    view.pose[static_cast<std::size_t>(12 + r)] = static_cast<float>(T_world_camera.translation()[r]);
  }
  const double margin_x = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.width / camera.fx;
  const double margin_y = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.height / camera.fy;
  view.lens = {static_cast<float>(camera.fx),
               static_cast<float>(camera.fy),
               static_cast<float>(camera.cx),
               static_cast<float>(camera.cy),
               static_cast<float>((-0.5 - camera.cx) / camera.fx - margin_x),
               static_cast<float>((camera.width - 0.5 - camera.cx) / camera.fx + margin_x),
               static_cast<float>((-0.5 - camera.cy) / camera.fy - margin_y),
               static_cast<float>((camera.height - 0.5 - camera.cy) / camera.fy + margin_y)};
  const int columns = (camera.width + TILE_WIDTH - 1) / TILE_WIDTH;
  const int rows = (camera.height + TILE_HEIGHT - 1) / TILE_HEIGHT;
  view.grid = {camera.width, camera.height, columns, rows};
  view.tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  return view;
}

}  // namespace

void RasterizerOptions::check() const {
  require(std::isfinite(dilation) && dilation >= 0.01f && dilation <= 100.0f, "dilation", "0.01 to 100 px^2");
}

struct Rasterizer::Impl {
  Impl(const compute::Context& c, const RasterizerOptions& o)
      : context(c),
        options(o),
        shell(chosen_shell(o.shell, c)),
        program(c, {"raster_common.cl", "projection.cl", "project.cl", "tiles.cl"}),
        project(program.kernel("project")),
        pairs(c, program, shell == Shell::tile && c.is_cpu()) {}

  compute::Context context;
  RasterizerOptions options;
  Shell shell;
  Program program;
  Kernel project;
  RasterPairs pairs;
  std::map<std::string, Kernel> kernels;  // built when first needed, by name and build options

  Buffer<float> splats, boxes, colors, color_gradients, screen_gradients, slots, pose_terms, pose_sums;
  Buffer<std::uint32_t> depth_keys;

  // The last forward.
  bool rendered = false;
  std::size_t count = 0;
  Viewpoint view;
  RenderRequest request;
  RenderOutput output;
  bool ray_plane = false;
  int sh_degree = 0;

  Kernel& kernel(const std::string& name, const std::vector<std::string>& files,
                 const std::string& build_options = "") {
    const std::string key = name + build_options;
    auto found = kernels.find(key);
    if (found == kernels.end()) {
      found = kernels.emplace(key, Program(context, files, build_options).kernel(name)).first;
    }
    return found->second;
  }
  std::string shell_options(int width) const {
    return shell == Shell::tile ? define("SHELL_TILE", 1) + define("VW", width) : define("SHELL_TILE", 0);
  }
  void forward(const DeviceGaussians& gaussians, RenderOutput& out);
  void backward(const DeviceGaussians& gaussians, const OutputGradients& given, DeviceGaussians& gradients,
                bool with_pose);
  Vector6d pose_gradient();
};

void Rasterizer::Impl::forward(const DeviceGaussians& gaussians, RenderOutput& out) {
  const auto n = static_cast<std::int32_t>(count);
  const Range items = Range::linear(count, ITEM_GROUP);
  splats.resize(context, splat_floats * count);
  boxes.resize(context, box_floats * count);
  depth_keys.resize(context, count);
  colors.resize(context, request.color ? 4 * count : 0);
  project(items, n, gaussians.positions, gaussians.log_scales, gaussians.rotations, gaussians.opacity_logits, view.pose,
          view.lens, view.grid, options.dilation, std::int32_t{options.compensated}, std::int32_t{ray_plane}, splats,
          boxes, depth_keys);
  pairs.build(count, boxes, depth_keys, view.grid);
  if (request.color) {
    kernel("shade", {"sh.cl", "shade.cl"}, define("SH_DEGREE", sh_degree))(items, n, gaussians.positions, gaussians.sh,
                                                                           std::int32_t{gaussians.coefficients()},
                                                                           view.pose, pairs.counts(), colors);
  }
  const std::size_t pixels = static_cast<std::size_t>(view.grid[0]) * static_cast<std::size_t>(view.grid[1]);
  out.width = view.grid[0];
  out.height = view.grid[1];
  out.color.resize(context, request.color ? 3 * pixels : 0);
  out.depth.resize(context, request.depth ? pixels : 0);
  out.alpha.resize(context, pixels);
  out.sigma.resize(context, request.sigma ? pixels : 0);
  Kernel& composite =
      kernel("composite", {"raster_common.cl", "composite.cl"},
             shell_options(forward_width) + define("WITH_COLOR", request.color) + define("WITH_SIGMA", request.sigma) +
                 define("DEPTH_MODE", mode_number(request.depth, request.depth_mode)));
  const Range range = shell == Shell::tile
                          ? Range::linear(view.tiles, 1)
                          : Range::grid(static_cast<std::size_t>(view.grid[2]) * TILE_WIDTH,
                                        static_cast<std::size_t>(view.grid[3]) * TILE_HEIGHT, TILE_WIDTH, TILE_HEIGHT);
  composite(range, pairs.tile_start(), pairs.list(), splats, colors, view.grid, out.color, out.depth, out.alpha,
            out.sigma);
}

void Rasterizer::Impl::backward(const DeviceGaussians& gaussians, const OutputGradients& given,
                                DeviceGaussians& gradients, bool with_pose) {
  const bool color = !given.color.empty();
  const bool depth = !given.depth.empty();
  const int slot_floats = 6 + 4 * depth + 3 * color;  // as in raster_common.cl
  const std::string images = define("WITH_COLOR", color) + define("DEPTH_MODE", mode_number(depth, request.depth_mode));
  gradients.resize(context, count, gaussians.sh_degree);
  slots.resize(context, static_cast<std::size_t>(slot_floats) * pairs.size());
  color_gradients.resize(context, color ? 4 * count : 0);
  screen_gradients.resize(context, 2 * count);
  pose_terms.resize(context, with_pose ? 6 * count : 0);
  const Buffer<float> none(context, 0);
  const auto image = [&](const Buffer<float>& b) -> const Buffer<float>& { return b.handle() == nullptr ? none : b; };

  Kernel& composite_backward = kernel("composite_backward", {"raster_common.cl", "composite_backward.cl"},
                                      shell_options(backward_width) + images);
  const std::size_t group = shell == Shell::tile ? 1 : PIXEL_BATCH;
  if (pairs.size() > 0) {
    composite_backward(Range::linear(view.tiles * group, group), pairs.tile_start(), pairs.list(), pairs.slot(), splats,
                       colors, view.grid, std::int32_t{!given.alpha.empty()}, image(output.color), image(output.depth),
                       output.alpha, image(given.color), image(given.depth), image(given.alpha), slots);
  }
  const auto n = static_cast<std::int32_t>(count);
  const Range items = Range::linear(count, ITEM_GROUP);
  const std::vector<std::string> files = {"raster_common.cl", "projection.cl", "project_backward.cl"};
  kernel("project_backward", files, images)(
      items, n, gaussians.positions, gaussians.log_scales, gaussians.rotations, gaussians.opacity_logits, view.pose,
      view.lens, options.dilation, std::int32_t{options.compensated}, std::int32_t{ray_plane}, pairs.counts(),
      pairs.offsets(), slots, gradients.positions, gradients.log_scales, gradients.rotations, gradients.opacity_logits,
      color_gradients, screen_gradients, std::int32_t{with_pose}, pose_terms);
  if (color) {
    kernel("shade_backward", {"sh.cl", "shade_backward.cl"}, define("SH_DEGREE", sh_degree))(
        items, n, gaussians.positions, gaussians.sh, std::int32_t{gaussians.coefficients()}, view.pose, pairs.counts(),
        colors, color_gradients, gradients.positions, gradients.sh, std::int32_t{with_pose}, pose_terms);
  } else {
    gradients.sh.fill_zero();
  }
}

Vector6d Rasterizer::Impl::pose_gradient() {
  Vector6d sum = Vector6d::Zero();
  if (count == 0) return sum;
  const std::size_t chunks = (count + POSE_CHUNK - 1) / POSE_CHUNK;
  pose_sums.resize(context, 6 * chunks);
  kernel("sum_pose_terms", {"pose_sum.cl"})(Range::linear(chunks, 1), static_cast<std::int32_t>(count), pose_terms,
                                            pose_sums);
  const std::vector<float> sums = pose_sums.download();
  for (std::size_t i = 0; i < sums.size(); ++i) sum[static_cast<Eigen::Index>(i % 6)] += static_cast<double>(sums[i]);
  return sum;
}

Rasterizer::Rasterizer(const compute::Context& context, const RasterizerOptions& options) {
  options.check();
  impl_ = std::make_unique<Impl>(context, options);
}
Rasterizer::~Rasterizer() = default;
Rasterizer::Rasterizer(Rasterizer&&) noexcept = default;
Rasterizer& Rasterizer::operator=(Rasterizer&&) noexcept = default;

void Rasterizer::forward(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
                         const RenderRequest& request, RenderOutput& output) {
  camera.check();
  require(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height) <= max_pixels, "image size",
          "at most 2^28 pixels");
  require(T_world_camera.is_finite(), "camera pose", "finite");
  require(!request.sigma || (request.depth && request.depth_mode == DepthMode::expected), "sigma",
          "asked for together with expected depth");
  require(request.sh_degree >= 0, "sh_degree", "0 or more");
  Impl& m = *impl_;
  m.rendered = false;
  m.count = gaussians.size();
  m.view = make_viewpoint(camera, T_world_camera);
  m.request = request;
  m.sh_degree = std::min(request.sh_degree, gaussians.sh_degree);
  m.ray_plane = m.options.depth_kind == DepthKind::ray_plane ||
                (m.options.depth_kind == DepthKind::automatic && request.depth_mode != DepthMode::blended);
  m.forward(gaussians, output);
  m.output = output;
  m.rendered = true;
}

void Rasterizer::backward(const DeviceGaussians& gaussians, const OutputGradients& output_gradients,
                          DeviceGaussians& gradients, Vector6d* pose_gradient) {
  Impl& m = *impl_;
  require(m.rendered, "backward", "called after forward");
  require(gaussians.size() == m.count, "gaussians of backward", "those of the last forward");
  const std::size_t pixels = m.output.alpha.size();
  const auto fits = [](const Buffer<float>& given, std::size_t size) { return given.empty() || given.size() == size; };
  require(fits(output_gradients.color, m.request.color ? 3 * pixels : 0), "color gradient",
          "of the size of the image rendered");
  require(fits(output_gradients.depth, m.request.depth ? pixels : 0), "depth gradient",
          "of the size of the image rendered");
  require(fits(output_gradients.alpha, pixels), "alpha gradient", "of the size of the image rendered");
  m.backward(gaussians, output_gradients, gradients, pose_gradient != nullptr);
  if (pose_gradient != nullptr) *pose_gradient = m.pose_gradient();
}

const Buffer<float>& Rasterizer::screen_gradients() const { return impl_->screen_gradients; }
const Buffer<std::uint32_t>& Rasterizer::tile_counts() const { return impl_->pairs.counts(); }
std::size_t Rasterizer::pairs() const { return impl_->pairs.size(); }
Shell Rasterizer::shell() const { return impl_->shell; }
const RasterizerOptions& Rasterizer::options() const { return impl_->options; }

}  // namespace odosplat
