// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core/types.hpp>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/compute/context.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/blend_order.hpp"
#include "odosplat/splat/raster/device_gaussians.hpp"
#include "odosplat/splat/sigma_model.hpp"

namespace odosplat {

/// What the depth of a pixel is. w_i = alpha_i T_i, z_i: depth of Gaussian i at the pixel (see DepthKind).
enum class DepthMode {
  expected,  // sum w z / sum w; 0 where no Gaussian touches the pixel
  median,    // z of the Gaussian that takes the transmittance below 0.5; 0 where none does
  blended,   // sum w z, as in the paper: not divided by alpha, no background
  surface  // expected; where its spread is above SURFACE_SPREAD of it, so that two surfaces meet, median (no backward)
};

/// What the depth of a Gaussian at a pixel is.
enum class DepthKind {
  automatic,  // ray_plane; centre for blended (the paper's)
  centre,     // depth of its centre
  ray_plane   // where the ray meets the plane along which the Gaussian is densest: inverse depth linear in the pixel
};

/// How work is laid out on the device; results agree to rounding.
enum class Shell {
  automatic,  // environment variable ODOSPLAT_SHELL (tile or pixel) if set, else tile on CPUs and pixel elsewhere
  tile,       // one work-item a tile of 16 x 16 pixels, vectors of pixels
  pixel       // one work-item a pixel, groups of 16 x 16 with local memory
};

struct RasterizerOptions {
  float dilation = 0.3f;  // added to both variances of a projected Gaussian [px^2], >= 0.01
  bool compensated =
      false;  // opacity times sqrt(det before / det after dilation), as in Mip-Splatting (Yu et al. 2024)
  DepthKind depth_kind = DepthKind::automatic;
  BlendOrder order = BlendOrder::depth;  // of a map: that of its header (MapHeader)
  Shell shell = Shell::automatic;

  void check() const;
};

/// Which images to make; alpha is always made. Without color no spherical harmonics are read.
struct RenderRequest {
  bool color = false;
  bool depth = true;
  bool sigma = false;  // needs depth with mode expected or surface
  DepthMode depth_mode = DepthMode::expected;
  SigmaModel sigma_model = SigmaModel::plain_spread();
  int sh_degree = 3;  // degree used, at most that of the Gaussians
};

/// Images in device memory, row after row; those not asked for have size 0. Buffers are reused from call to call.
struct RenderOutput {
  int width = 0;
  int height = 0;
  compute::Buffer<float> color;  // [3 x H x W] planes R, G, B; at least 0, not clamped to 1; background black
  compute::Buffer<float> depth;  // [H x W] m along the optical axis, 0 = none
  compute::Buffer<float> alpha;  // [H x W] 0..1
  // [H x W] m, by the request's sigma_model, with the spread along the ray sqrt(sum w (z - expected)^2 / sum w) and the
  // mean slope of the Gaussians' planes sum w slope / sum w; 0 where no Gaussian touches the pixel.
  compute::Buffer<float> sigma;
};

/// dL/d(image) for backward, shapes as in RenderOutput. A buffer of size 0 means that L does not depend on that image.
struct OutputGradients {
  compute::Buffer<float> color;
  compute::Buffer<float> depth;
  compute::Buffer<float> alpha;
};

/// Renders Gaussians from a pose, and takes gradients of images back to the Gaussians and to the pose.
/// Source: Kerbl et al. 2023 (EWA projection, front-to-back alpha blending, tiles); exact opacity-aware tile test after
/// Hanson et al. 2024 (Speedy-Splat); ray-plane depth after Zhang et al. 2024 (RaDe-GS).
/// Differs: pixel centres are at integers; alpha is capped at MAX_ALPHA, smaller than MIN_ALPHA is skipped, and a pixel
/// ends once its transmittance is below MIN_TRANSMITTANCE (constants.h); the ray plane's slope is the regression of
/// depth on the pixel, with PLANE_DILATION px^2 added to the projected covariance, so that Gaussians seen edge-on have
/// finite slopes. Gaussians whose centre is nearer than NEAR_DEPTH are not drawn, nor those with non-finite values.
/// Frames: Gaussians in the world, T_world_camera as named. Sizes of images are the camera's, of any value.
/// No Gaussians, or none in view: images of zeros, gradients of zeros, no error.
/// Deterministic: the same input gives the same bits on one device, whatever its threads.
/// Queued on the context's queue (forward waits once, for the number of pairs); read buffers to wait. Not thread safe.
/// Errors: InputError for a bad camera or request, compute::DeviceError from the device.
class Rasterizer {
 public:
  explicit Rasterizer(const compute::Context& context, const RasterizerOptions& options = {});
  ~Rasterizer();
  Rasterizer(Rasterizer&&) noexcept;
  Rasterizer& operator=(Rasterizer&&) noexcept;

  /// Fills `output`. Keeps what backward needs: its own intermediate buffers, and handles of output's buffers, whose
  /// contents the caller must leave alone until then.
  void forward(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
               const RenderRequest& request, RenderOutput& output);

  /// The same at some pixels only, at a fraction of the cost: Gaussians that touch none of them are not projected,
  /// tiles without any are skipped, and in the other tiles only the blocks of 4 x 4 pixels with one are composited
  /// (with Shell::pixel the whole tile). `output` has one value per pixel, in the order given (x: column, y: row):
  /// width = pixels.size(), height = 1. The values are those of forward, to the bit. Pixels may repeat; none: empty
  /// images. No backward after it. Waits twice. Errors: as forward; InputError for a pixel outside the image.
  void forward_pixels(const DeviceGaussians& gaussians, const Camera& camera, const SE3& T_world_camera,
                      const RenderRequest& request, const std::vector<cv::Point>& pixels, RenderOutput& output);

  /// Gradients of the last forward, with the same Gaussians. `gradients` takes the shape of `gaussians`; every value is
  /// overwritten (zero for Gaussians not in view, and for SH above the degree rendered).
  /// A gradient of an image that forward did not make is an InputError. sigma is not differentiated; of median depth
  /// only the chosen Gaussian's own depth is.
  /// pose_gradient, if not null: dL/d xi [1/m, 1/rad] for T_camera_world <- exp(xi) * T_camera_world; waits.
  void backward(const DeviceGaussians& gaussians, const OutputGradients& output_gradients, DeviceGaussians& gradients,
                Vector6d* pose_gradient = nullptr);

  /// After backward: dL/d(u, v) of each projected centre, [N x 2] per px (for densification).
  const compute::Buffer<float>& screen_gradients() const;
  /// After forward: number of tiles each Gaussian touches, [N]; 0: not in view. (After forward_pixels: each of those
  /// kept.)
  const compute::Buffer<std::uint32_t>& tile_counts() const;
  /// After forward or forward_pixels: (Gaussian, tile) pairs.
  std::size_t pairs() const;
  /// The shell in use, never automatic.
  Shell shell() const;
  const RasterizerOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace odosplat
