// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/raster/rasterizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernels/constants.h"
#include "odosplat/core/error.hpp"
#include "odosplat/splat/raster/pixel_selection.hpp"
#include "odosplat/splat/raster/raster_pairs.hpp"
#include "odosplat/splat/raster/viewpoint.hpp"

namespace odosplat {
namespace {

using compute::Buffer;
using compute::Kernel;
using compute::Program;
using compute::Range;

constexpr int block_pixels = 16;  // pixels that the tile shell handles at once, as a vector
constexpr std::size_t cpu_lanes = 8;
constexpr int splat_floats = 16;  // SPLAT_VECTORS of four
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

// As final_sigma of composite.cl takes them.
std::array<float, 4> squares_of(const SigmaModel& m) {
  return {m.spread * m.spread, m.slope_px * m.slope_px, m.depth_share * m.depth_share, m.open_share * m.open_share};
}

// Number of the mode in raster_common.cl.
int mode_number(bool depth, DepthMode mode) {
  if (!depth) return 0;
  if (mode == DepthMode::expected) return 1;
  if (mode == DepthMode::median) return 2;
  return mode == DepthMode::blended ? 3 : 4;
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
        lanes(shell == Shell::tile ? cpu_lanes : 1),
        program(c, {"raster_common.cl", "projection.cl", "tiles.cl", "project.cl"},
                define("GW", static_cast<int>(lanes))),
        project(program.kernel("project", "project")),
        pairs(c, program, shell == Shell::tile && c.is_cpu()),
        everything{0, Buffer<std::uint32_t>(c, 0), {0, Buffer<std::uint32_t>(c, 0)}} {}

  compute::Context context;
  RasterizerOptions options;
  Shell shell;
  std::size_t lanes;  // Gaussians that an item of the projection takes
  Program program;
  Kernel project;
  RasterPairs pairs;
  std::map<std::string, Kernel> kernels;  // built when first needed, by name and build options

  Buffer<float> splats, boxes, color_gradients, screen_gradients, slots, pose_terms, pose_sums;
  Buffer<std::uint32_t> depth_keys, counts;
  std::unique_ptr<PixelSelection> selection;  // made when first needed
  RenderOutput selected_images;               // whole images, of which only blocks with wanted pixels are made

  // Which Gaussians to draw, all or those listed, and where.
  struct Part {
    std::int32_t select;
    Buffer<std::uint32_t> gaussians;
    WantedTiles tiles;
  };
  Part everything;

  // The last forward.
  bool rendered = false;
  std::size_t count = 0;
  Viewpoint view;
  RenderRequest request;
  RenderOutput output;
  bool ray_plane = false;
  int sh_degree = 0;

  Kernel& kernel(const std::string& name, const std::vector<std::string>& files, const std::string& stage,
                 const std::string& build_options = "") {
    const std::string key = name + build_options;
    auto found = kernels.find(key);
    if (found == kernels.end()) {
      found = kernels.emplace(key, Program(context, files, build_options).kernel(name, stage)).first;
    }
    return found->second;
  }
  std::string shell_options() const {
    return shell == Shell::tile ? define("SHELL_TILE", 1) + define("VW", block_pixels) : define("SHELL_TILE", 0);
  }
  // One work-item for each `lanes` Gaussians.
  Range groups() const { return Range::linear((count + lanes - 1) / lanes, lanes > 1 ? 1 : ITEM_GROUP); }
  void prepare(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
               const RenderRequest& wanted);
  void forward(const DeviceGaussians& gaussians, const Part& part, RenderOutput& out);
  void forward_pixels(const DeviceGaussians& gaussians, const std::vector<cv::Point>& pixels, RenderOutput& out);
  void backward(const DeviceGaussians& gaussians, const OutputGradients& given, DeviceGaussians& gradients,
                bool with_pose);
  Vector6d pose_gradient();
};

void Rasterizer::Impl::forward(const DeviceGaussians& gaussians, const Part& part, RenderOutput& out) {
  const auto n = static_cast<std::int32_t>(count);
  const Range items = Range::linear(count, ITEM_GROUP);
  splats.resize(context, splat_floats * count);
  boxes.resize(context, box_floats * (count + lanes));
  depth_keys.resize(context, count);
  counts.resize(context, count);
  project(groups(), n, part.select, part.gaussians, gaussians.positions, gaussians.log_scales, gaussians.rotations,
          gaussians.opacity_logits, view.pose, view.lens, view.grid, options.dilation,
          std::int32_t{options.compensated}, std::int32_t{ray_plane},
          std::int32_t{options.order == BlendOrder::distance}, part.tiles.sparse, part.tiles.blocks, splats, boxes,
          depth_keys, counts);
  pairs.build(count, lanes, boxes, depth_keys, counts, view.grid, part.tiles);
  if (request.color) {
    kernel("shade", {"raster_common.cl", "sh.cl", "shade.cl"}, "shade", define("SH_DEGREE", sh_degree))(
        items, n, part.select, part.gaussians, gaussians.positions, gaussians.sh,
        std::int32_t{gaussians.coefficients()}, view.pose, counts, splats);
  }
  const std::size_t pixels = view.pixels;
  out.width = view.grid[0];
  out.height = view.grid[1];
  out.color.resize(context, request.color ? 3 * pixels : 0);
  out.depth.resize(context, request.depth ? pixels : 0);
  out.alpha.resize(context, pixels);
  out.sigma.resize(context, request.sigma ? pixels : 0);
  Kernel& composite =
      kernel("composite", {"raster_common.cl", "composite.cl"}, "composite",
             shell_options() + define("WITH_COLOR", request.color) + define("WITH_SIGMA", request.sigma) +
                 define("DEPTH_MODE", mode_number(request.depth, request.depth_mode)));
  const Range range = shell == Shell::tile
                          ? Range::linear(view.tiles, 1)
                          : Range::grid(static_cast<std::size_t>(view.grid[2]) * TILE_WIDTH,
                                        static_cast<std::size_t>(view.grid[3]) * TILE_HEIGHT, TILE_WIDTH, TILE_HEIGHT);
  composite(range, pairs.tile_start(), pairs.list(), splats, view.grid, out.color, out.depth, out.alpha, out.sigma,
            squares_of(request.sigma_model), part.tiles.sparse, part.tiles.blocks);
}

void Rasterizer::Impl::forward_pixels(const DeviceGaussians& gaussians, const std::vector<cv::Point>& pixels,
                                      RenderOutput& out) {
  if (!selection) selection = std::make_unique<PixelSelection>(context, lanes);
  selection->select(gaussians, view, options.dilation, pixels);
  count = selection->size();
  forward(gaussians, {1, selection->gaussians(), selection->tiles()}, selected_images);
  out.width = static_cast<int>(pixels.size());
  out.height = 1;
  selection->pick(selected_images.color, out.color);
  selection->pick(selected_images.depth, out.depth);
  selection->pick(selected_images.alpha, out.alpha);
  selection->pick(selected_images.sigma, out.sigma);
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

  Kernel& composite_backward =
      kernel("composite_backward", {"raster_common.cl", "composite_backward.cl"}, "backward", shell_options() + images);
  const std::size_t group = shell == Shell::tile ? 1 : PIXEL_BATCH;
  if (pairs.size() > 0) {
    composite_backward(Range::linear(view.tiles * group, group), pairs.tile_start(), pairs.list(), pairs.slot(), splats,
                       view.grid, std::int32_t{!given.alpha.empty()}, image(output.color), image(output.depth),
                       output.alpha, image(given.color), image(given.depth), image(given.alpha), slots);
  }
  const auto n = static_cast<std::int32_t>(count);
  const Range items = Range::linear(count, ITEM_GROUP);
  const std::vector<std::string> files = {"raster_common.cl", "projection.cl", "project_backward.cl"};
  kernel("project_backward", files, "backward", images + define("GW", static_cast<int>(lanes)))(
      groups(), n, gaussians.positions, gaussians.log_scales, gaussians.rotations, gaussians.opacity_logits, view.pose,
      view.lens, options.dilation, std::int32_t{options.compensated}, std::int32_t{ray_plane}, counts, pairs.offsets(),
      slots, gradients.positions, gradients.log_scales, gradients.rotations, gradients.opacity_logits, color_gradients,
      screen_gradients, std::int32_t{with_pose}, pose_terms);
  if (color) {
    kernel("shade_backward", {"raster_common.cl", "sh.cl", "shade_backward.cl"}, "backward",
           define("SH_DEGREE", sh_degree))(
        items, n, gaussians.positions, gaussians.sh, std::int32_t{gaussians.coefficients()}, view.pose, counts, splats,
        color_gradients, gradients.positions, gradients.sh, std::int32_t{with_pose}, pose_terms);
  } else {
    gradients.sh.fill_zero();
  }
}

Vector6d Rasterizer::Impl::pose_gradient() {
  Vector6d sum = Vector6d::Zero();
  if (count == 0) return sum;
  const std::size_t chunks = (count + POSE_CHUNK - 1) / POSE_CHUNK;
  pose_sums.resize(context, 6 * chunks);
  kernel("sum_pose_terms", {"pose_sum.cl"}, "backward")(Range::linear(chunks, 1), static_cast<std::int32_t>(count),
                                                        pose_terms, pose_sums);
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

void Rasterizer::Impl::prepare(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
                               const RenderRequest& wanted) {
  camera.check();
  require(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height) <= max_pixels, "image size",
          "at most 2^28 pixels");
  require(T_world_camera.is_finite(), "camera pose", "finite");
  wanted.sigma_model.check();
  require(!wanted.sigma ||
              (wanted.depth && (wanted.depth_mode == DepthMode::expected || wanted.depth_mode == DepthMode::surface)),
          "sigma", "asked for together with expected depth");
  require(wanted.sh_degree >= 0, "sh_degree", "0 or more");
  rendered = false;
  count = gaussians.size();
  view = make_viewpoint(camera, T_world_camera);
  request = wanted;
  sh_degree = std::min(wanted.sh_degree, gaussians.sh_degree);
  ray_plane = options.depth_kind == DepthKind::ray_plane ||
              (options.depth_kind == DepthKind::automatic && wanted.depth_mode != DepthMode::blended);
}

void Rasterizer::forward(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
                         const RenderRequest& request, RenderOutput& output) {
  impl_->prepare(gaussians, camera, T_world_camera, request);
  impl_->forward(gaussians, impl_->everything, output);
  impl_->output = output;
  impl_->rendered = true;
}

void Rasterizer::forward_pixels(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
                                const RenderRequest& request, const std::vector<cv::Point>& pixels,
                                RenderOutput& output) {
  require(pixels.size() <= max_pixels, "pixels", "at most 2^28");
  impl_->prepare(gaussians, camera, T_world_camera, request);
  impl_->forward_pixels(gaussians, pixels, output);
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
  require(output_gradients.depth.empty() || m.request.depth_mode != DepthMode::surface, "depth gradient",
          "of expected, median or blended depth");
  m.backward(gaussians, output_gradients, gradients, pose_gradient != nullptr);
  if (pose_gradient != nullptr) *pose_gradient = m.pose_gradient();
}

const Buffer<float>& Rasterizer::screen_gradients() const { return impl_->screen_gradients; }
const Buffer<std::uint32_t>& Rasterizer::tile_counts() const { return impl_->counts; }
std::size_t Rasterizer::pairs() const { return impl_->pairs.size(); }
Shell Rasterizer::shell() const { return impl_->shell; }
const RasterizerOptions& Rasterizer::options() const { return impl_->options; }

}  // namespace odosplat
