// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/cloud_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/map/cloud_filters.hpp"
#include "odosplat/map/cloud_verdict.hpp"
#include "odosplat/map/visible_patches.hpp"

namespace odosplat {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t least_patches = 40;
constexpr double good_error = 0.35;      // at which no smaller gap is looked at
constexpr double rows_share = 0.6;       // of the work; the fit takes the rest
constexpr std::size_t most_images = 64;  // that are kept in memory

struct Pair {
  std::size_t from = 0;
  std::size_t to = 0;
};

// F T F with F = diag(1, -1, 1): the motion of the mirrored world.
SE3 reflect(const SE3& T) {
  const Eigen::Quaterniond& q = T.rotation();
  const Eigen::Vector3d& t = T.translation();
  return {Eigen::Quaterniond(q.w(), -q.x(), q.y(), -q.z()), Eigen::Vector3d(t.x(), -t.y(), t.z())};
}

PointCloud mirrored(PointCloud cloud) {
  for (Eigen::Vector3f& p : cloud.points) p.y() = -p.y();
  for (Eigen::Vector3f& n : cloud.normals) n.y() = -n.y();
  return cloud;
}

// What is done to all images and to the cloud before anything is compared.
class Material {
 public:
  Material(const CloudCheckInput& input, const CloudCheckOptions& options) : input_(input), camera_(input.camera) {
    while (camera_.width > options.largest_width) {
      camera_ = camera_.level(1);
      ++halvings_;
    }
    cloud_.points = input.cloud.points;
    std::erase_if(cloud_.points, [](const Eigen::Vector3f& p) { return !p.allFinite(); });
    if (cloud_.size() < 4) throw InputError("cloud", "holds too few points to check anything by");
    const double half = extent() / 2000.0;
    for (double voxel = std::max(half, 1e-6); cloud_.size() > static_cast<std::size_t>(options.most_points);
         voxel *= 1.3) {
      cloud_ = voxel_downsample(cloud_, voxel);
    }
    cloud_.normals.clear();
    estimate_normals(cloud_, 12);
    spacings_ = mean_neighbor_distances(cloud_, 6);
    mirrored_ = mirrored(cloud_);
  }

  const Camera& camera() const { return camera_; }
  /// Patches that were found so far.
  std::size_t patches() const { return patches_; }
  void count(std::size_t patches) { patches_ += patches; }
  const std::vector<float>& spacings() const { return spacings_; }
  const PointCloud& cloud(bool is_mirrored) const { return is_mirrored ? mirrored_ : cloud_; }

  const GrayImage& gray(std::size_t image) {
    const auto found = images_.find(image);
    if (found != images_.end()) return found->second;
    if (images_.size() >= most_images) images_.erase(images_.begin());
    GrayImage gray = input_.gray(image);
    if (gray.cols != input_.camera.width || gray.rows != input_.camera.height) {
      throw InputError("image " + std::to_string(image), "is not of the camera's size");
    }
    for (int k = 0; k < halvings_; ++k) gray = halve(gray);
    return images_[image] = gray;
  }

  std::optional<SE3> pose(std::size_t image, const CloudReading& reading) const {
    const auto k = static_cast<std::ptrdiff_t>(image) + reading.id_shift;
    if (k < 0 || k >= static_cast<std::ptrdiff_t>(input_.T_world_camera.size())) return std::nullopt;
    const std::optional<SE3>& stored = input_.T_world_camera[static_cast<std::size_t>(k)];
    if (!stored) return std::nullopt;
    const SE3 T = reading.fy_sign < 0 ? reflect(*stored) : *stored;
    return reading.inverted ? T.inverse() : T;
  }

 private:
  // [m] of the middle 90 % of the points, along the longest axis.
  double extent() const {
    double longest = 0.0;
    for (int a = 0; a < 3; ++a) {
      std::vector<float> values;
      for (const Eigen::Vector3f& p : cloud_.points) values.push_back(p[a]);
      std::sort(values.begin(), values.end());
      const std::size_t cut = values.size() / 20;
      longest = std::max(longest, static_cast<double>(values[values.size() - 1 - cut] - values[cut]));
    }
    return longest;
  }

  const CloudCheckInput& input_;
  Camera camera_;
  int halvings_ = 0;
  PointCloud cloud_;  // with normals
  PointCloud mirrored_;
  std::vector<float> spacings_;
  std::map<std::size_t, GrayImage> images_;
  std::size_t patches_ = 0;
};

// Pairs of images that have poses under every shift that is tried, or as they are numbered at least.
std::vector<Pair> choose_pairs(const Material& material, std::size_t images, int gap, int wanted, int max_shift) {
  const auto distance = static_cast<std::size_t>(gap);
  std::vector<Pair> possible;
  for (const int shift : {max_shift, 0}) {
    const auto usable = [&](std::size_t i) {
      for (const int s : {-shift, 0, shift}) {
        if (!material.pose(i, {1, false, false, s})) return false;
      }
      return true;
    };
    for (std::size_t i = 0; i + distance < images; ++i) {
      if (usable(i) && usable(i + distance)) possible.push_back({i, i + distance});
    }
    if (!possible.empty()) break;
  }
  const std::size_t count = std::min(possible.size(), static_cast<std::size_t>(wanted));
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < count; ++k) pairs.push_back(possible[k * possible.size() / count]);
  return pairs;
}

CloudRow measure(Material& material, const CloudReading& reading, const std::vector<Pair>& pairs,
                 const CloudCheckOptions& options) {
  CloudRow row;
  row.reading = reading;
  std::vector<double> errors;
  std::size_t tried = 0;
  for (const Pair& pair : pairs) {
    row.pair_errors.push_back(not_a_number);
    const std::optional<SE3> from = material.pose(pair.from, reading);
    const std::optional<SE3> to = material.pose(pair.to, reading);
    if (!from || !to) continue;
    ++tried;
    const GrayImage image = material.gray(pair.from);
    const GrayImage other = material.gray(pair.to);
    const std::vector<VisiblePatch> patches = visible_patches(material.cloud(reading.mirrored), material.spacings(),
                                                              image, material.camera(), *from, options.patches);
    const SE3 T_other_image = to->inverse() * *from;
    std::vector<std::optional<double>> differences(patches.size());
    parallel_for(static_cast<int>(patches.size()), 64, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        differences[at] = patch_difference(patches[at], image, other, material.camera(), T_other_image);
      }
    });
    std::vector<double> seen;
    for (const std::optional<double>& d : differences) {
      if (d) seen.push_back(*d);
    }
    material.count(patches.size());
    if (patches.empty()) continue;
    const double overlap = static_cast<double>(seen.size()) / static_cast<double>(patches.size());
    row.overlap += overlap / static_cast<double>(pairs.size());
    if (seen.size() < least_patches || overlap < options.min_overlap) continue;
    row.pair_errors.back() = median_of(std::move(seen));
    errors.push_back(row.pair_errors.back());
  }
  row.tried = 2 * tried >= pairs.size();
  if (!errors.empty() && 2 * errors.size() >= pairs.size()) row.relative_error = median_of(std::move(errors));
  return row;
}

// Every reading without shift, then shifts of the best of them and of what is declared.
std::vector<CloudRow> measure_all(Material& material, const CloudReading& declared, const std::vector<Pair>& pairs,
                                  const CloudCheckOptions& options, const std::function<void(double)>& progress) {
  const double foreseen = 8.0 + 4.0 * options.max_shift;
  std::vector<CloudRow> rows;
  const auto add = [&](const CloudReading& reading) {
    rows.push_back(measure(material, reading, pairs, options));
    if (progress) progress(rows_share * static_cast<double>(rows.size()) / foreseen);
  };
  for (const int sign : {declared.fy_sign, -declared.fy_sign}) {
    for (const bool is_mirrored : {false, true}) {
      for (const bool inverted : {false, true}) {
        add({sign, is_mirrored, inverted, 0});
      }
    }
  }
  const CloudReading best = std::min_element(rows.begin(), rows.end(), [](const CloudRow& a, const CloudRow& b) {
                              return a.relative_error < b.relative_error;
                            })->reading;
  std::vector<CloudReading> shifted{best};
  if (!(best == declared)) shifted.push_back(declared);
  for (CloudReading reading : shifted) {
    for (int shift = 1; shift <= options.max_shift; ++shift) {
      for (const int signed_shift : {-shift, shift}) {
        reading.id_shift = signed_shift;
        add(reading);
      }
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const CloudRow& a, const CloudRow& b) { return a.relative_error < b.relative_error; });
  return rows;
}

// Whether the images that the pairs begin with show texture where the cloud is seen, under the best row.
bool is_textured(Material& material, const CloudReading& reading, const std::vector<Pair>& pairs) {
  std::size_t textured = 0;
  for (const Pair& pair : pairs) {
    const std::optional<SE3> pose = material.pose(pair.from, reading);
    if (!pose) continue;
    const std::vector<VisiblePatch> patches =
        visible_patches(material.cloud(reading.mirrored), material.spacings(), material.gray(pair.from),
                        material.camera(), *pose, static_cast<int>(least_patches));
    textured += patches.size() >= least_patches;
  }
  return 2 * textured >= pairs.size();
}

std::optional<CloudFit> fit_reading(Material& material, const CloudCheckInput& input, const CloudReading& reading,
                                    int gap, const CloudCheckOptions& options) {
  CloudFitInput fit;
  fit.camera = material.camera();
  for (std::size_t i = 0; i < input.T_world_camera.size(); ++i) {
    if (const std::optional<SE3> pose = material.pose(i, reading)) {
      fit.images.push_back(i);
      fit.T_world_camera.push_back(*pose);
    }
  }
  fit.gray = [&](std::size_t i) { return material.gray(i); };
  fit.cloud = &material.cloud(reading.mirrored);
  fit.spacings = &material.spacings();
  fit.progress = [&](double share) {
    if (input.progress) input.progress(rows_share + (1.0 - rows_share) * share);
  };
  CloudFit result = fit_cloud(fit, {gap, options.pairs, options.patches / 2});
  if (result.patches == 0) return std::nullopt;
  const double factor = input.camera.fx / material.camera().fx;
  result.focal_px = {factor * result.focal_px.value, factor * result.focal_px.sigma};
  return result;
}

}  // namespace

void CloudCheckOptions::check() const {
  require(gap >= 1, "gap", "at least 1 frame");
  require(pairs >= 1, "pairs", "at least 1");
  require(max_shift >= 0, "max_shift", "at least 0 frames");
  require(patches >= 100, "patches", "at least 100");
  require(min_overlap > 0.0 && min_overlap <= 1.0, "min_overlap", "in 0..1");
  require(max_error > 0.0, "max_error", "positive");
  require(most_points >= 100, "most_points", "at least 100");
  require(largest_width >= 32, "largest_width", "at least 32 pixels");
}

CloudCheckReport check_cloud(const CloudCheckInput& input, const CloudCheckOptions& options) {
  options.check();
  input.camera.check();
  require(input.fy_sign == 1 || input.fy_sign == -1, "fy_sign", "+1 or -1");
  const auto posed = std::count_if(input.T_world_camera.begin(), input.T_world_camera.end(),
                                   [](const std::optional<SE3>& pose) { return pose.has_value(); });
  if (posed < 2) throw InputError("sequence", "has " + std::to_string(posed) + " images with pose, 2 are needed");
  Material material(input, options);
  CloudCheckReport report;
  report.declared = {input.fy_sign, false, false, 0};
  const auto images = input.T_world_camera.size();
  const auto longest = static_cast<int>(std::max<std::size_t>(1, images / 3));
  for (int gap = std::min(options.gap, longest); gap >= 1; gap /= 2) {
    const std::vector<Pair> pairs = choose_pairs(material, images, gap, options.pairs, options.max_shift);
    if (pairs.empty()) continue;
    std::vector<CloudRow> rows = measure_all(material, report.declared, pairs, options, input.progress);
    if (report.rows.empty() || rows.front().relative_error < report.rows.front().relative_error) {
      report.textured = is_textured(material, rows.front().reading, pairs);
      report.rows = std::move(rows);
      report.gap = gap;
      report.pairs = static_cast<int>(pairs.size());
    }
    // Without any patch the length of the gap changes nothing.
    if (report.rows.front().relative_error <= good_error || material.patches() == 0) break;
  }
  if (report.rows.empty()) throw InputError("sequence", "no two images with pose are near each other in the list");
  choose_reading(report, options.max_error);
  if (report.believable) report.fit = fit_reading(material, input, report.winner, report.gap, options);
  judge_cloud(report, options, input.camera);
  return report;
}

}  // namespace odosplat
