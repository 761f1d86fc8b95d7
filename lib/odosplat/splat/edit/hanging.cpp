// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Gaussians that hang in free space: before the surface that views show.
#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/edit/floaters.hpp"
#include "odosplat/splat/edit/gaussian_shapes.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/kept_gaussians.hpp"

namespace odosplat {
namespace {

constexpr int vote_chunk = 1024;
constexpr float least_depth = 0.05F;  // [m] as the rasteriser's

/// How often a Gaussian was seen before the surface, and on it.
struct Votes {
  int before = 0;
  int on = 0;
};

/// Nearest depth [m] in the 3 x 3 pixels around (x, y); 0 if fewer than five have depth, as at the border of what was
/// measured.
float nearest_depth(const DepthImage& depth, int x, int y) {
  constexpr int least = 5;
  float nearest = std::numeric_limits<float>::infinity();
  int count = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, depth.rows - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, depth.cols - 1); ++u) {
      if (!(depth(v, u) > 0.0F)) continue;
      nearest = std::min(nearest, depth(v, u));
      ++count;
    }
  }
  return count >= least ? nearest : 0.0F;
}

void vote(const GaussianShapes& shapes, const std::vector<float>& margins, const EditView& view,
          const DepthImage& depth, const FloaterOptions& options, std::vector<Votes>& votes) {
  const SE3 T_camera_world = view.T_world_camera.inverse();
  parallel_for(static_cast<int>(shapes.size()), vote_chunk, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Eigen::Vector3d p_camera = T_camera_world * shapes.cloud.points[i].cast<double>();
      const auto z = static_cast<float>(p_camera.z());
      if (!(z > least_depth)) continue;
      const Eigen::Vector2d pixel = view.camera.project(p_camera);
      if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= view.camera.width - 1.0 &&
            pixel.y() <= view.camera.height - 1.0))
        continue;
      const float surface =
          nearest_depth(depth, static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
      if (!(surface > 0.0F)) continue;
      const float margin = std::max(margins[i], static_cast<float>(options.free_share) * z);
      if (z < surface - margin) {
        ++votes[i].before;
      } else if (z <= surface + margin) {
        ++votes[i].on;
      }
    }
  });
}

}  // namespace

std::vector<Floater> find_floaters(const compute::Context& context, const Map& map, const std::vector<EditView>& views,
                                   const FloaterOptions& options, const ViewNotice& notice) {
  std::vector<Floater> floaters = find_floaters(map.gaussians, options);
  std::vector<std::size_t> rows;
  std::vector<bool> keep(floaters.size());
  for (std::size_t i = 0; i < floaters.size(); ++i) {
    keep[i] = floaters[i] == Floater::none;
    if (keep[i]) rows.push_back(i);
  }
  if (rows.empty()) return floaters;
  const Map rest{kept_gaussians(map.gaussians, keep), map.header};
  const GaussianShapes shapes = gaussian_shapes(rest.gaussians);
  const float middle = upper_median(shapes.spacings);
  std::vector<float> margins;
  for (const float spacing : shapes.spacings) {
    margins.push_back(static_cast<float>(options.free_spacings) * std::min(spacing, middle));
  }
  GaussianView rendered(context, rest);
  std::vector<Votes> votes(rows.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    const EditView& view = views[k];
    DepthImage depth = view.depth ? view.depth() : DepthImage();
    if (depth.empty()) depth = rendered.render(view.camera, view.T_world_camera, {}).depth;
    vote(shapes, margins, view, depth, options, votes);
    if (notice) notice(k + 1);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (votes[i].before >= options.least_views && votes[i].before > options.views_for_one * votes[i].on) {
      floaters[rows[i]] = Floater::hanging;
    }
  }
  return floaters;
}

}  // namespace odosplat
