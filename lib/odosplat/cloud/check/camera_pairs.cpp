// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/camera_pairs.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/cloud/check/visible_patches.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat {
namespace {

constexpr int cells_a_row = 28;            // one patch is taken from each cell of this grid
constexpr float least_slope = 4.0F / 255;  // [1/px] gradient of a patch's middle
constexpr float most_bend = 0.015F;        // largest mean deviation of depth from a patch's plane, as a share
constexpr double search_radius = 8.0;      // [px] search radius
constexpr double least_texture = 0.02;     // directions with a smaller eigenvalue of a match's information are not used
constexpr std::size_t least_found = 40;
constexpr double found_share = 0.25;      // of a pair's patches; chance finds fewer
constexpr double derivative_step = 1e-5;  // of numeric derivatives

// A patch whose plane is fitted to the depth at its pixels; none where depth is missing or bent.
std::optional<VisiblePatch> patch_at(const DepthImage& depth, int x, int y) {
  constexpr int least = visible_patch_side * visible_patch_side * 2 / 3;
  Eigen::Matrix3f H = Eigen::Matrix3f::Zero();
  Eigen::Vector3f b = Eigen::Vector3f::Zero();
  std::array<Eigen::Vector4f, visible_patch_side * visible_patch_side> samples;
  int count = 0;
  for (int dy = -patch_reach; dy <= patch_reach; dy += patch_step) {
    for (int dx = -patch_reach; dx <= patch_reach; dx += patch_step) {
      const float z = depth(y + dy, x + dx);
      if (!(z > 0.05F)) continue;
      const Eigen::Vector3f row(1.0F, static_cast<float>(dx), static_cast<float>(dy));
      H += row * row.transpose();
      b += row / z;
      samples[static_cast<std::size_t>(count++)] << row, 1.0F / z;
    }
  }
  if (count < least) return std::nullopt;
  const Eigen::Vector3f plane = H.ldlt().solve(b);
  float squares = 0.0F;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector4f& s = samples[static_cast<std::size_t>(k)];
    const float r = s[3] - s.head<3>().dot(plane);
    squares += r * r;
  }
  const float bend = std::sqrt(squares / static_cast<float>(count));
  if (!(plane[0] > 0.0F && bend <= most_bend * plane[0])) return std::nullopt;
  return VisiblePatch{x, y, plane[0], plane[1], plane[2], 0};
}

float slope_at(const GrayImage& image, int x, int y) {
  return 0.5F * std::hypot(image(y, x + 1) - image(y, x - 1), image(y + 1, x) - image(y - 1, x));
}

// The pixel with the largest gradient of each cell of a grid, where there is depth.
std::vector<VisiblePatch> patches_of(const GrayImage& image, const DepthImage& depth) {
  const int cell = std::max(4, image.cols / cells_a_row);
  std::vector<VisiblePatch> patches;
  for (int top = patch_reach + 1; top + cell < image.rows - patch_reach - 1; top += cell) {
    for (int left = patch_reach + 1; left + cell < image.cols - patch_reach - 1; left += cell) {
      float best = least_slope;
      cv::Point place(-1, -1);
      for (int y = top; y < top + cell; ++y) {
        for (int x = left; x < left + cell; ++x) {
          const float slope = slope_at(image, x, y);
          if (!(slope > best) || !(depth(y, x) > 0.0F)) continue;
          best = slope;
          place = {x, y};
        }
      }
      if (place.x < 0) continue;
      if (const auto patch = patch_at(depth, place.x, place.y)) patches.push_back(*patch);
    }
  }
  return patches;
}

// The patch with its depth multiplied by a factor, given by its logarithm.
VisiblePatch with_depth_factor(VisiblePatch patch, double log_factor) {
  const auto factor = static_cast<float>(std::exp(-log_factor));
  patch.inverse_depth *= factor;
  patch.slope_u *= factor;
  patch.slope_v *= factor;
  return patch;
}

// Where the surface behind a patch's middle is seen in the other image.
struct Prediction {
  Eigen::Vector2d pixel = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  SE3 T_to_from;
};

Prediction predict(const Camera& camera, const PosesOverTime& poses, const CameraState& state, const CameraPair& pair,
                   const SE3& T_to_given, const VisiblePatch& patch) {
  Prediction result;
  const double readout = camera.readout + state.camera.readout;
  const auto time_of = [&](double v) { return state.time_offset + readout * camera.time_of_row(v); };
  const SE3 T_world_from = poses.at(pair.from, time_of(patch.y));
  const Eigen::Vector3d p_from = state.camera.ray(camera, patch.x, patch.y) *
                                 (std::exp(state.depth_factor) / static_cast<double>(patch.inverse_depth));
  double row = 0.5 * (camera.height - 1);
  // The row at which the point appears determines when that row was taken; without a readout time once is enough.
  for (int k = 0; k < (readout == 0.0 ? 1 : 3); ++k) {
    result.T_to_from = T_to_given * poses.at(pair.to, time_of(row)).inverse() * T_world_from;
    const Eigen::Vector3d p_to = result.T_to_from * p_from;
    if (!(p_to.z() > 0.01)) return result;
    result.pixel = state.camera.project(camera, p_to);
    row = std::clamp(result.pixel.y(), 0.0, camera.height - 1.0);
  }
  return result;
}

}  // namespace

PosesOverTime::PosesOverTime(const CameraFitInput& input) : place_(input.times.size(), 0) {
  for (std::size_t i = 0; i < input.times.size(); ++i) {
    if (!input.T_world_camera[i]) continue;
    place_[i] = posed_.size();
    posed_.push_back({input.times[i], *input.T_world_camera[i], ""});
  }
}

SE3 PosesOverTime::at(std::size_t image, double seconds) const {
  const StampedPose& at_image = posed_[place_[image]];
  if (seconds == 0.0 || posed_.size() < 2) return at_image.T_world_camera;
  const double time = at_image.time + seconds;
  // The two neighbours between which the time lies; beyond the ends the last two are extrapolated.
  std::size_t before = place_[image];
  if (seconds < 0.0 && before > 0) --before;
  while (before > 0 && posed_[before].time > time) --before;
  while (before + 2 < posed_.size() && posed_[before + 1].time < time) ++before;
  before = std::min(before, posed_.size() - 2);
  if (!(posed_[before + 1].time > posed_[before].time)) return at_image.T_world_camera;
  return pose_between(posed_[before], posed_[before + 1], time);
}

std::vector<CameraPair> camera_pairs(const CameraFitInput& input, const PosesOverTime& poses, const CameraState& state,
                                     double motion, int wanted) {
  constexpr std::size_t farthest = 400;  // images between the two of a pair
  constexpr int grid = 8;                // points a row and column
  constexpr std::size_t least_points = 12;
  const Camera camera = state.corrected(input.camera);
  const double least = motion * camera.width;
  const std::size_t images = input.times.size();
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < images; ++i) {
    if (input.T_world_camera[i] && input.has_depth[i]) usable.push_back(i);
  }
  const std::size_t count = std::min(usable.size(), static_cast<std::size_t>(wanted));
  std::vector<CameraPair> pairs;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = usable[k * usable.size() / count];
    const DepthImage depth = input.depth(from, state);
    if (depth.empty()) continue;
    std::vector<Eigen::Vector3d> points;
    for (int row = 0; row < grid; ++row) {
      for (int column = 0; column < grid; ++column) {
        const int x = (2 * column + 1) * camera.width / (2 * grid);
        const int y = (2 * row + 1) * camera.height / (2 * grid);
        if (depth(y, x) > 0.0F) points.emplace_back(camera.ray(x, y) * static_cast<double>(depth(y, x)));
      }
    }
    if (points.size() < least_points) continue;
    for (std::size_t to = from + 1; to < images && to - from <= farthest; ++to) {
      if (!input.T_world_camera[to]) continue;
      const SE3 T_to_from = poses.at(to, 0.0).inverse() * poses.at(from, 0.0);
      std::vector<double> moves;
      for (const Eigen::Vector3d& p : points) {
        const Eigen::Vector3d q = T_to_from * p;
        if (!(q.z() > 0.05)) continue;
        const Eigen::Vector2d pixel = camera.project(q);
        if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > camera.width - 1 || pixel.y() > camera.height - 1) continue;
        moves.push_back((pixel - camera.project(p)).norm());
      }
      if (2 * moves.size() < points.size()) break;
      if (upper_median(std::move(moves)) < least) continue;
      pairs.push_back({from, to, SE3()});
      break;
    }
  }
  return pairs;
}

std::vector<CameraEquation> camera_equations(const CameraFitInput& input, const PosesOverTime& poses,
                                             const CameraState& state, const CameraPair& pair) {
  const GrayImage from = input.gray(pair.from);
  const GrayImage to = input.gray(pair.to);
  const Camera matching = state.corrected(input.camera);
  const std::vector<VisiblePatch> patches = patches_of(from, input.depth(pair.from, state));

  std::vector<std::array<std::optional<CameraEquation>, 2>> found(patches.size());
  parallel_for(static_cast<int>(patches.size()), 32, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const VisiblePatch& patch = patches[static_cast<std::size_t>(i)];
      const Prediction expected = predict(input.camera, poses, state, pair, pair.T_to_given, patch);
      if (!expected.pixel.allFinite()) continue;
      const auto match = match_patch(with_depth_factor(patch, state.depth_factor), from, to, matching,
                                     expected.T_to_from, search_radius, expected.pixel);
      if (!match) continue;
      Eigen::Matrix<double, 2, CameraState::size + 6> J;
      for (int k = 0; k < J.cols(); ++k) {
        const auto moved = [&](double by) {
          CameraState::Vector v = state.vector();
          Vector6d twist = Vector6d::Zero();
          if (k < CameraState::size) {
            v[k] += by;
          } else {
            twist[k - CameraState::size] = by;
          }
          return predict(input.camera, poses, CameraState::from(v), pair, SE3::exp(twist) * pair.T_to_given, patch)
              .pixel;
        };
        J.col(k) = (moved(derivative_step) - moved(-derivative_step)) / (2.0 * derivative_step);
      }
      if (!J.allFinite()) continue;
      const Eigen::Vector2d away = match->found - expected.pixel;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> texture(match->information);
      for (int k = 0; k < 2; ++k) {
        if (texture.eigenvalues()[k] < least_texture) continue;
        const Eigen::Vector2d direction = texture.eigenvectors().col(k);
        const Eigen::Matrix<double, 1, CameraState::size + 6> row = direction.transpose() * J;
        found[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
            CameraEquation{row.head<CameraState::size>(), row.tail<6>(), direction.dot(away)};
      }
    }
  });
  std::vector<CameraEquation> equations;
  std::size_t matches = 0;
  for (const auto& both : found) {
    if (both[0] || both[1]) ++matches;
    for (const auto& equation : both) {
      if (equation) equations.push_back(*equation);
    }
  }
  if (matches < least_found || found_share * static_cast<double>(patches.size()) > static_cast<double>(matches))
    return {};
  return equations;
}

}  // namespace odosplat
