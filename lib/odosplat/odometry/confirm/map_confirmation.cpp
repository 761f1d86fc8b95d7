// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/map_confirmation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {
namespace {

/// Distance of every pixel of a square from its middle, along u and along v.
struct Offsets {
  PatchValues u;
  PatchValues v;
  Offsets() {
    constexpr float middle = 0.5F * (patch_side - 1);
    for (int k = 0; k < patch_pixels; ++k) {
      u[k] = static_cast<float>(k % patch_side) - middle;
      const int row = k / patch_side;
      v[k] = static_cast<float>(row) - middle;
    }
  }
};

constexpr int middle_pixel = patch_pixels / 2 + patch_side / 2;

/// The square less its mean and its slope along both sides. Returns its length before it is scaled to 1.
float remove_plane(PatchValues& values) {
  static const Offsets from_middle;
  // Sum of squared distances from the middle over the square, along one side.
  constexpr float moment = patch_pixels * (patch_pixels - 1) / 12.0F;
  const float mean = values.mean();
  const float along_u = (from_middle.u * values).sum() / moment;
  const float along_v = (from_middle.v * values).sum() / moment;
  values -= mean + along_u * from_middle.u + along_v * from_middle.v;
  return std::sqrt(values.square().sum());
}

float length_of_spread(double spread) { return static_cast<float>(patch_side * spread); }

/// Least variance that is assumed of one normalised grey value: that of squares that correlate by 0.97, as in the best
/// maps.
constexpr double least_noise = 1e-3;

/// Least spread that a square is divided by, so that the correlation of two squares that hardly vary is close to 0, not
/// a ratio of rounding errors.
constexpr double least_spread = 0.5 / 255;

/// A square of the image: its correlation with the map, and its length before it is scaled to 1.
struct SeenSquare {
  double correlation;
  float length;
};

/// Share of the squares in which the image shows clearly what the map does not: of those whose texture is far above the
/// image's noise, those that do not correlate. The noise is what the map leaves unexplained in the squares that it
/// explains best.
double share_against(const std::vector<SeenSquare>& squares) {
  constexpr double explained = 0.2;  // share of the squares
  constexpr double clear = 4.0;      // times the noise
  constexpr double unlike = 0.2;     // correlation
  constexpr int enough = 20;
  if (squares.empty()) return 0.0;
  std::vector<double> unexplained;
  unexplained.reserve(squares.size());
  for (const SeenSquare& s : squares) {
    unexplained.push_back(s.length * std::sqrt(std::max(0.0, 1.0 - s.correlation * s.correlation)));
  }
  const auto nth =
      unexplained.begin() + static_cast<std::ptrdiff_t>(explained * static_cast<double>(unexplained.size()));
  std::nth_element(unexplained.begin(), nth, unexplained.end());
  const double least = std::max(clear * *nth, static_cast<double>(length_of_spread(4.0 / 255)));
  int textured = 0;
  int against = 0;
  for (const SeenSquare& s : squares) {
    if (s.length < least) continue;
    ++textured;
    if (s.correlation < unlike) ++against;
  }
  return textured < enough ? 0.0 : static_cast<double>(against) / textured;
}

/// Depth of every pixel of a square; what has none gets the mean of the others. False: too few have.
bool depths_of(const DepthImage& depth, int left, int top, int step, PatchValues& z) {
  constexpr int enough = 6 * patch_pixels / 10;
  float sum = 0.0F;
  int known = 0;
  for (int k = 0; k < patch_pixels; ++k) {
    const float value = depth((top + k / patch_side) * step + step / 2, (left + k % patch_side) * step + step / 2);
    z[k] = value;
    if (!(value > 0.0F)) continue;
    sum += value;
    ++known;
  }
  if (known < enough) return false;
  for (int k = 0; k < patch_pixels; ++k) {
    if (!(z[k] > 0.0F)) z[k] = sum / static_cast<float>(known);
  }
  return true;
}

}  // namespace

void ConfirmationOptions::check() const {
  require(width >= 2 * patch_side, "confirmation.width", "at least 16 px");
  require(min_texture > 0.0, "confirmation.min_texture", "positive");
  require(min_patches >= 1, "confirmation.min_patches", "at least 1");
  require(min_share >= 0.0 && min_share <= 1.0, "confirmation.min_share", "in [0, 1]");
  require(null_common > 0.0 && null_patch >= 0.0, "confirmation.null_common and null_patch", "positive");
  require(prior > 0.0 && prior < 1.0, "confirmation.prior", "in (0, 1)");
  require(part_prior > 0.0 && part_prior < 1.0, "confirmation.part_prior", "in (0, 1)");
  require(right_against > 0.0, "confirmation.right_against", "positive");
  require(confirmed > 0.0 && confirmed < 1.0, "confirmation.confirmed", "in (0, 1)");
  // The place alike in part keeps these odds whatever the image shows.
  require(confirmed * (1.0 + part_prior * right_against) < 1.0, "confirmation.confirmed",
          "below 1 / (1 + part_prior * right_against)");
  require(contradicted >= 0.0 && contradicted <= confirmed, "confirmation.contradicted", "in [0, confirmed]");
}

double confirmation_probability(double score, int patches, double against, const ConfirmationOptions& options) {
  if (patches == 0) return 0.0;
  const double variance = options.null_common * options.null_common + options.null_patch * options.null_patch / patches;
  // A negative score counts as 0.
  const double s = std::max(0.0, score);
  const double log_null = -0.5 * s * s / variance - 0.5 * std::log(2.0 * std::numbers::pi * variance);
  // Odds of each of the two wrong hypotheses to the right one.
  const double elsewhere = (1.0 - options.prior) / options.prior * std::exp(log_null);
  const double alike_in_part = options.part_prior * options.right_against * std::exp(against / options.right_against);
  return 1.0 / (1.0 + elsewhere + alike_in_part);
}

ViewPatches::ViewPatches(const Camera& camera, const RenderedView& view, double smoothing,
                         const ConfirmationOptions& options)
    : options_(options), T_world_view_(view.T_world_camera) {
  options_.check();
  if (view.images.color.empty()) return;
  const auto seen = view.gray != nullptr ? view.gray : gray_of(camera, view.images, smoothing);
  const FramePyramid& pyramid = seen->pyramid;
  int finest = 0;
  while (finest + 1 < pyramid.levels() && pyramid.cameras[static_cast<std::size_t>(finest)].width > options.width) {
    ++finest;
  }
  for (int number = finest; number < std::min(finest + 2, pyramid.levels()); ++number) {
    const GrayImage& gray = pyramid.gray[static_cast<std::size_t>(number)];
    const Camera& small = pyramid.cameras[static_cast<std::size_t>(number)];
    Level level;
    level.number = number;
    level.cells = (gray.cols / patch_side) * (gray.rows / patch_side);
    for (int top = 0; top + patch_side <= gray.rows; top += patch_side) {
      for (int left = 0; left + patch_side <= gray.cols; left += patch_side) {
        Patch patch;
        if (!depths_of(view.images.depth, left, top, 1 << number, patch.z)) continue;
        for (int k = 0; k < patch_pixels; ++k) {
          const int u = left + k % patch_side;
          const int v = top + k / patch_side;
          const Eigen::Vector3d ray = small.ray(u, v);
          patch.x[k] = static_cast<float>(ray.x()) * patch.z[k];
          patch.y[k] = static_cast<float>(ray.y()) * patch.z[k];
          patch.shape[k] = gray(v, u);
        }
        const float length = remove_plane(patch.shape);
        patch.textured = length >= length_of_spread(options.min_texture);
        patch.shape /= std::max(length, length_of_spread(least_spread));
        level.patches.push_back(patch);
      }
    }
    levels_.push_back(std::move(level));
  }
}

MapEvidence ViewPatches::compare(const Level& level, const FramePyramid& image, const SE3& T_camera_view) const {
  const auto number = static_cast<std::size_t>(level.number);
  const GrayImage& gray = image.gray[number];
  const Camera& camera = image.cameras[number];
  Eigen::Matrix3f R = T_camera_view.rotation().toRotationMatrix().cast<float>();
  Eigen::Vector3f t = T_camera_view.translation().cast<float>();
  const bool rolling = !image.row_motion.isZero(0.0);
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  // Pixels at the edge of a view from the same pose are projected to the edge but for rounding.
  constexpr float rounding = 0.01F;
  const float right = static_cast<float>(gray.cols - 1) + rounding;
  const float bottom = static_cast<float>(gray.rows - 1) + rounding;
  MapEvidence evidence;
  int in_view = 0;
  double sum = 0.0;
  std::vector<SeenSquare> squares;
  squares.reserve(level.patches.size());
  for (const Patch& patch : level.patches) {
    if (rolling) {
      const SE3 T_rows_view = at_its_row(T_camera_view, camera, patch.point(middle_pixel), image.row_motion);
      R = T_rows_view.rotation().toRotationMatrix().cast<float>();
      t = T_rows_view.translation().cast<float>();
    }
    const PatchValues z = R(2, 0) * patch.x + R(2, 1) * patch.y + R(2, 2) * patch.z + t.z();
    if (!(z.minCoeff() > 0.01F)) continue;
    const PatchValues u = fx * (R(0, 0) * patch.x + R(0, 1) * patch.y + R(0, 2) * patch.z + t.x()) / z + cx;
    const PatchValues v = fy * (R(1, 0) * patch.x + R(1, 1) * patch.y + R(1, 2) * patch.z + t.y()) / z + cy;
    if (!(u.minCoeff() >= -rounding && v.minCoeff() >= -rounding && u.maxCoeff() <= right && v.maxCoeff() <= bottom))
      continue;
    ++in_view;
    PatchValues values;
    for (int k = 0; k < patch_pixels; ++k) values[k] = bilinear(gray, u[k], v[k]);
    const float length = remove_plane(values);
    if (!patch.textured && length < length_of_spread(options_.min_texture)) continue;
    const auto product = static_cast<double>((patch.shape * values).sum());
    squares.push_back({product / std::max(length, length_of_spread(least_spread)), length});
    sum += squares.back().correlation;
  }
  evidence.share = static_cast<double>(in_view) / std::max(1, level.cells);
  evidence.patches = static_cast<int>(squares.size());
  if (evidence.patches > 0) evidence.score = sum / evidence.patches;
  evidence.against = share_against(squares);
  return evidence;
}

MisfitSystem ViewPatches::misfit(const FramePyramid& image, const SE3& T_camera_world, const Vector6d& velocity,
                                 const CameraCorrection& correction, int coarse, double min_patch) const {
  MisfitSystem system;
  if (levels_.empty()) return system;
  const Level& level = levels_[std::min(static_cast<std::size_t>(coarse), levels_.size() - 1)];
  const GrayImage& gray = image.gray[static_cast<std::size_t>(level.number)];
  const Camera& camera = image.cameras[static_cast<std::size_t>(level.number)];
  const SE3 T_camera_view = T_camera_world * T_world_view_;
  const auto to_full_size = static_cast<double>(1 << level.number);
  PatchValues values;
  PatchValues along_u;
  PatchValues along_v;
  double squares = 0.0;
  double weights = 0.0;
  double flow = 0.0;
  for (const Patch& patch : level.patches) {
    if (!patch.textured) continue;
    bool inside = true;
    Eigen::Matrix<double, 2, MisfitSystem::size> jacobian;
    const Eigen::Vector3d center = T_camera_view * patch.point(middle_pixel);
    if (!(center.z() > 0.01)) continue;
    // When the square's rows were taken, as a share of the readout time.
    const double rows = std::clamp(camera.time_of_row(camera.project(center).y()), -0.5, 0.5);
    const SE3 T_rows_view = SE3::exp(rows * (correction.readout * velocity + image.row_motion)) * T_camera_view;
    const Eigen::Matrix3d R = T_rows_view.rotation().toRotationMatrix();
    const Eigen::Vector3d& t = T_rows_view.translation();
    for (int i = 0; i < patch_pixels && inside; ++i) {
      const Eigen::Vector3d p = R * patch.point(i) + t;
      inside = p.z() > 0.01;
      if (!inside) break;
      const Eigen::Vector2d pixel = correction.project(camera, p);
      inside = pixel.x() >= 1.0 && pixel.y() >= 1.0 && pixel.x() <= gray.cols - 2 && pixel.y() <= gray.rows - 2;
      if (!inside) break;
      const auto uf = static_cast<float>(pixel.x());
      const auto vf = static_cast<float>(pixel.y());
      values[i] = bilinear(gray, uf, vf);
      along_u[i] = bilinear(gray, uf + 0.5F, vf) - bilinear(gray, uf - 0.5F, vf);
      along_v[i] = bilinear(gray, uf, vf + 0.5F) - bilinear(gray, uf, vf - 0.5F);
      if (i != middle_pixel) continue;
      const double x = p.x() / p.z();
      const double y = p.y() / p.z();
      const double r2 = x * x + y * y;
      jacobian.leftCols<6>() = correction.stretch(r2) * projection_jacobian(camera, p);
      jacobian.col(6) = Eigen::Vector2d(camera.fx * x, camera.fy * y) * (1.0 + correction.radial * r2);
      jacobian.col(7) = Eigen::Vector2d(camera.fx, 0.0);
      jacobian.col(8) = Eigen::Vector2d(0.0, camera.fy);
      jacobian.col(9) = Eigen::Vector2d(camera.fx * x, camera.fy * y) * (1.0 + correction.focal) * r2;
      jacobian.col(10) = rows * jacobian.leftCols<6>() * velocity;
    }
    if (!inside) continue;
    const float length = remove_plane(values);
    if (length < length_of_spread(options_.min_texture)) continue;
    remove_plane(along_u);
    remove_plane(along_v);
    values /= length;
    along_u /= length;
    along_v /= length;
    const auto correlation = static_cast<double>((values * patch.shape).sum());
    const auto u_along = static_cast<double>((values * along_u).sum());
    const auto v_along = static_cast<double>((values * along_v).sum());
    if (correlation < min_patch) continue;
    // Derivatives of the normalised values by the shift: the image's, less their component along the values themselves.
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (int i = 0; i < patch_pixels; ++i) {
      const double value = values[i];
      const Eigen::Vector2d g(along_u[i] - u_along * value, along_v[i] - v_along * value);
      A += g * g.transpose();
      b += g * (static_cast<double>(patch.shape[i]) - value);
    }
    const double weight = correlation * correlation;
    system.information += weight * jacobian.transpose() * A * jacobian;
    system.vector += weight * jacobian.transpose() * b;
    squares += weight * 2.0 * (1.0 - correlation);
    weights += weight * (patch_pixels - 3);
    flow += (jacobian.leftCols<6>() * velocity).squaredNorm();
    ++system.patches;
  }
  system.noise = weights > 0.0 ? std::max(least_noise, squares / weights) : 1.0;
  if (system.patches > 0) system.flow = to_full_size * std::sqrt(flow / system.patches);
  return system;
}

MapEvidence ViewPatches::compare(const FramePyramid& image, const SE3& T_world_camera) const {
  const SE3 T_camera_view = T_world_camera.inverse() * T_world_view_;
  MapEvidence best;
  double against = 0.0;
  for (const Level& level : levels_) {
    MapEvidence evidence = compare(level, image, T_camera_view);
    if (evidence.patches < options_.min_patches || evidence.share < options_.min_share) {
      best.share = std::max(best.share, evidence.share);
      continue;
    }
    // What speaks against the pose on the finer level does so on the coarser one, too.
    against = std::max(against, evidence.against);
    evidence.against = against;
    evidence.probability = confirmation_probability(evidence.score, evidence.patches, against, options_);
    evidence.verdict = evidence.probability >= options_.confirmed     ? Confirmation::confirmed
                       : evidence.probability < options_.contradicted ? Confirmation::contradicted
                                                                      : Confirmation::undecided;
    if (best.verdict == Confirmation::none || evidence.probability > best.probability) best = evidence;
    if (evidence.verdict == Confirmation::confirmed) break;
  }
  return best;
}

}  // namespace odosplat
