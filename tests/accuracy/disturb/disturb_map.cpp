// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/disturb/disturb_map.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "odosplat/core/random.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::accuracy {
namespace {

using Points = Eigen::Map<const Eigen::Matrix3Xf>;

/// Keeps the rows (of `width` values) without a mark.
template <typename T>
void keep_unmarked(std::vector<T>& values, std::size_t width, const std::vector<std::uint8_t>& marked) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] != 0) continue;
    for (std::size_t c = 0; c < width; ++c) values[kept * width + c] = values[i * width + c];
    ++kept;
  }
  values.resize(kept * width);
}

/// Applies the edit to the positions. Returns the marks of the rows to remove; share: of rows moved or removed.
std::vector<std::uint8_t> apply(const MapEdit& edit, std::span<float> positions, double& share) {
  const std::vector<float> before(positions.begin(), positions.end());
  std::vector<std::uint8_t> gone = edit(positions);
  const std::size_t n = positions.size() / 3;
  gone.resize(n, 0);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool moved = !std::equal(&before[3 * i], &before[3 * i] + 3, &positions[3 * i]);
    if (moved || gone[i] != 0) ++changed;
  }
  share = n > 0 ? static_cast<double>(changed) / static_cast<double>(n) : 0.0;
  return gone;
}

}  // namespace

std::vector<std::uint8_t> in_random_balls(std::span<const float> positions, double share, double radius,
                                          std::uint64_t seed) {
  const std::size_t n = positions.size() / 3;
  std::vector<std::uint8_t> marked(n, 0);
  const auto wanted = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(n));
  const Points points(positions.data(), 3, static_cast<Eigen::Index>(n));
  const auto squared_radius = static_cast<float>(radius * radius);
  Random random(seed);
  for (std::size_t count = 0; count < wanted;) {
    const Eigen::Vector3f center = points.col(random.below(static_cast<std::uint32_t>(n)));
    for (std::size_t i = 0; i < n; ++i) {
      if (marked[i] != 0) continue;
      if ((points.col(static_cast<Eigen::Index>(i)) - center).squaredNorm() > squared_radius) continue;
      marked[i] = 1;
      ++count;
    }
  }
  return marked;
}

std::size_t move_random_pieces(std::span<float> positions, const MoveOptions& options, std::uint64_t seed) {
  const std::size_t n = positions.size() / 3;
  if (n == 0) return 0;
  const std::vector<float> original(positions.begin(), positions.end());
  const Points points(original.data(), 3, static_cast<Eigen::Index>(n));
  Eigen::Map<Eigen::Matrix3Xf> moved(positions.data(), 3, static_cast<Eigen::Index>(n));
  const auto half = static_cast<float>(options.edge / 2.0);
  Random random(seed);
  std::vector<Eigen::Vector3f> centers;
  std::size_t count = 0;
  constexpr int most_tries = 1000;
  for (int attempt = 0; attempt < most_tries && static_cast<int>(centers.size()) < options.pieces; ++attempt) {
    const Eigen::Vector3f center = points.col(random.below(static_cast<std::uint32_t>(n)));
    // Centres two edges apart, so that no point is in two pieces.
    const auto near = [&](const Eigen::Vector3f& other) { return (center - other).norm() < 4.0F * half; };
    if (std::any_of(centers.begin(), centers.end(), near)) continue;
    centers.push_back(center);
    const Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3f step = (options.distance * direction.normalized()).cast<float>();
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      if ((points.col(i) - center).cwiseAbs().maxCoeff() > half) continue;
      moved.col(i) += step;
      ++count;
    }
  }
  return count;
}

apps::MapFlags edited_map(const apps::MapFlags& flags, const MapEdit& edit, const std::string& folder, double& share) {
  apps::MapFlags edited = flags;
  if (!flags.cloud.empty()) {
    PointCloud cloud = read_point_cloud(flags.cloud);
    static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
    const std::span<float> positions(cloud.points.empty() ? nullptr : cloud.points[0].data(), 3 * cloud.size());
    const std::vector<std::uint8_t> gone = apply(edit, positions, share);
    keep_unmarked(cloud.colors, 1, gone);
    keep_unmarked(cloud.normals, 1, gone);
    keep_unmarked(cloud.points, 1, gone);
    edited.cloud = folder + "/cloud.ply";
    write_point_cloud(edited.cloud, cloud);
  }
  if (!flags.map.empty()) {
    Map map = read_map(flags.map);
    Gaussians& gaussians = map.gaussians;
    const std::vector<std::uint8_t> gone = apply(edit, gaussians.positions, share);
    keep_unmarked(gaussians.positions, 3, gone);
    keep_unmarked(gaussians.log_scales, 3, gone);
    keep_unmarked(gaussians.rotations, 4, gone);
    keep_unmarked(gaussians.sh, 3 * static_cast<std::size_t>(gaussians.coefficients()), gone);
    keep_unmarked(gaussians.opacity_logits, 1, gone);
    edited.map = folder + "/map.ply";
    write_map(edited.map, map);
  }
  return edited;
}

}  // namespace odosplat::accuracy
