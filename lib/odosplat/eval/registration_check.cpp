// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/registration_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/jackknife.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

constexpr int groups = 8;
constexpr int largest_width = 400;         // [px]
constexpr int widest_hole = 8;             // [px]
constexpr float least_jump = 0.05F;        // of the nearer depth
constexpr std::size_t least_edges = 2000;  // of all images
constexpr std::size_t most_edges = 4000;   // of an image
constexpr double least_contrast = 1.15;
constexpr float noise = 2.0F / 255.0F;  // [1/px] gradient of the grey image that may be due to noise

// A depth edge, half a pixel beyond the last pixel of the nearer surface.
struct Edge {
  float u, v;       // [px] from the principal point
  bool horizontal;  // found along a row, so that the colour gradient along the row is used
};

// Strength of an image's gradient along rows and columns, divided by its local mean.
struct Strength {
  cv::Mat1f along_rows;
  cv::Mat1f along_columns;
};

struct Picture {
  std::vector<Edge> edges;
  Strength fine;
  Strength coarse;
};

Strength strength_of(const GrayImage& gray, double blur) {
  GrayImage smooth;
  cv::GaussianBlur(gray, smooth, cv::Size(), blur);
  cv::Mat1f gx;
  cv::Mat1f gy;
  cv::Sobel(smooth, gx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(smooth, gy, CV_32F, 0, 1, 3, 0.125);
  gx = cv::abs(gx);
  gy = cv::abs(gy);
  const cv::Size around(31, 31);
  cv::Mat1f mean;
  Strength strength;
  cv::blur(gx, mean, around);
  cv::divide(gx, mean + noise, strength.along_rows);
  cv::blur(gy, mean, around);
  cv::divide(gy, mean + noise, strength.along_columns);
  // Limited, so that a single strong edge does not outweigh all others.
  strength.along_rows = cv::min(strength.along_rows, 4.0);
  strength.along_columns = cv::min(strength.along_columns, 4.0);
  return strength;
}

// Finds the edges of a row or column, in the order of its pixels.
template <typename At, typename Found>
void scan_line(int length, const At& at, const Found& found) {
  int last = -1;
  for (int k = 0; k < length; ++k) {
    const float z = at(k);
    if (!(z > 0.0F) || !std::isfinite(z)) continue;
    if (last >= 0 && k - last <= widest_hole + 1) {
      const float before = at(last);
      if (std::abs(z - before) > least_jump * std::min(z, before)) {
        found(before < z ? static_cast<float>(last) + 0.5F : static_cast<float>(k) - 0.5F);
      }
    }
    last = k;
  }
}

std::vector<Edge> edges_of(const DepthImage& depth, const Camera& camera) {
  std::vector<Edge> edges;
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (int y = 0; y < depth.rows; ++y) {
    scan_line(
        depth.cols, [&](int x) { return depth(y, x); },
        [&](float x) {
          edges.push_back({x - cx, static_cast<float>(y) - cy, true});
        });
  }
  for (int x = 0; x < depth.cols; ++x) {
    scan_line(
        depth.rows, [&](int y) { return depth(y, x); },
        [&](float y) {
          edges.push_back({static_cast<float>(x) - cx, y - cy, false});
        });
  }
  if (edges.size() <= most_edges) return edges;
  std::vector<Edge> picked;
  for (std::size_t k = 0; k < most_edges; ++k) picked.push_back(edges[k * edges.size() / most_edges]);
  return picked;
}

DepthImage halve_depth(const DepthImage& depth) {
  // The nearest of four depths, so that edges stay at the border of the nearer surface.
  DepthImage half(depth.rows / 2, depth.cols / 2, 0.0F);
  for (int y = 0; y < half.rows; ++y) {
    for (int x = 0; x < half.cols; ++x) {
      for (const float z :
           {depth(2 * y, 2 * x), depth(2 * y, 2 * x + 1), depth(2 * y + 1, 2 * x), depth(2 * y + 1, 2 * x + 1)}) {
        if (z > 0.0F && (half(y, x) == 0.0F || z < half(y, x))) half(y, x) = z;
      }
    }
  }
  return half;
}

struct Placement {
  double scale = 1.0;
  double dx = 0.0;  // [px]
  double dy = 0.0;
};

// One score per group of images and placement.
struct Scores {
  std::vector<Placement> placements;
  std::array<std::vector<double>, groups> sums;
  std::array<double, groups> counts{};

  // The mean score over all groups except `without` (-1: over all groups).
  double mean(std::size_t placement, int without) const {
    double sum = 0.0;
    double count = 0.0;
    for (int g = 0; g < groups; ++g) {
      if (g == without) continue;
      sum += sums[static_cast<std::size_t>(g)][placement];
      count += counts[static_cast<std::size_t>(g)];
    }
    return count > 0.0 ? sum / count : 0.0;
  }

  std::size_t best(int without) const {
    std::size_t at = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < placements.size(); ++k) {
      const double value = mean(k, without);
      if (value > most) {
        most = value;
        at = k;
      }
    }
    return at;
  }
};

double sum_of(const Picture& picture, const Strength& strength, const Camera& camera, const Placement& placement) {
  const auto s = static_cast<float>(placement.scale);
  const auto ox = static_cast<float>(camera.cx + placement.dx);
  const auto oy = static_cast<float>(camera.cy + placement.dy);
  const auto right = static_cast<float>(camera.width - 1);
  const auto bottom = static_cast<float>(camera.height - 1);
  double sum = 0.0;
  for (const Edge& edge : picture.edges) {
    const float u = ox + s * edge.u;
    const float v = oy + s * edge.v;
    // An edge outside the image counts with the average strength, so that moving edges out gives no advantage.
    if (!(u >= 0.0F && v >= 0.0F && u <= right && v <= bottom)) {
      sum += 1.0;
      continue;
    }
    sum += bilinear(edge.horizontal ? strength.along_rows : strength.along_columns, u, v);
  }
  return sum;
}

Scores score(const std::vector<Picture>& pictures, bool fine, const Camera& camera, std::vector<Placement> placements) {
  Scores scores;
  scores.placements = std::move(placements);
  for (auto& sums : scores.sums) sums.assign(scores.placements.size(), 0.0);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::size_t group = i * groups / pictures.size();
    scores.counts[group] += static_cast<double>(pictures[i].edges.size());
    parallel_for(static_cast<int>(scores.placements.size()), 32, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const auto at = static_cast<std::size_t>(k);
        scores.sums[group][at] +=
            sum_of(pictures[i], fine ? pictures[i].fine : pictures[i].coarse, camera, scores.placements[at]);
      }
    });
  }
  return scores;
}

std::vector<Placement> grid(const Placement& middle, double scale_range, double scale_step, double range, double step) {
  std::vector<Placement> placements;
  const int scales = static_cast<int>(std::lround(scale_range / scale_step));
  const int shifts = static_cast<int>(std::lround(range / step));
  for (int s = -scales; s <= scales; ++s) {
    for (int y = -shifts; y <= shifts; ++y) {
      for (int x = -shifts; x <= shifts; ++x) {
        placements.push_back({middle.scale + s * scale_step, middle.dx + x * step, middle.dy + y * step});
      }
    }
  }
  return placements;
}

// Largest displacement [px] of an image corner.
double corner_misfit(const Placement& p, const Camera& camera) {
  double most = 0.0;
  for (const double u : {-0.5, camera.width - 0.5}) {
    for (const double v : {-0.5, camera.height - 0.5}) {
      most = std::max(most,
                      std::hypot((p.scale - 1.0) * (u - camera.cx) + p.dx, (p.scale - 1.0) * (v - camera.cy) + p.dy));
    }
  }
  return most;
}

std::vector<Picture> pictures_of(const RegistrationInput& input, const RegistrationOptions& options, Camera& camera) {
  std::vector<Picture> pictures;
  const std::size_t count = std::min(input.images, static_cast<std::size_t>(options.images));
  camera = input.camera;
  int halvings = 0;
  for (; camera.width > largest_width; ++halvings) camera = camera.level(1);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t image = k * input.images / count;
    GrayImage gray = input.gray(image);
    DepthImage depth = input.depth(image);
    const cv::Size size(input.camera.width, input.camera.height);
    if (gray.size() != size || depth.size() != size) {
      throw InputError("image " + std::to_string(image), "is not of the camera's size");
    }
    for (int h = 0; h < halvings; ++h) {
      gray = halve(gray);
      depth = halve_depth(depth);
    }
    pictures.push_back({edges_of(depth, camera), strength_of(gray, 0.8), strength_of(gray, 2.0)});
  }
  return pictures;
}

}  // namespace

void RegistrationOptions::check() const {
  require(images >= 1, "images", "at least 1");
  require(max_scale_change >= 0.0 && max_scale_change < 0.5, "max_scale_change", "in 0..0.5");
  require(max_shift >= 0.0 && max_shift < 0.5, "max_shift", "in 0..0.5");
  require(tolerance > 0.0, "tolerance", "positive");
  require(clear >= tolerance, "clear", "at least the tolerance");
}

RegistrationReport check_registration(const RegistrationInput& input, const RegistrationOptions& options) {
  options.check();
  input.camera.check();
  RegistrationReport report;
  Camera camera;
  const std::vector<Picture> pictures = pictures_of(input, options, camera);
  for (const Picture& picture : pictures) report.edges += picture.edges.size();
  if (report.edges < least_edges) {
    report.text = "colour and depth: not decidable, depth has too few edges (" + std::to_string(report.edges) + ")";
    return report;
  }
  const double pixels_before = static_cast<double>(input.camera.width) / camera.width;
  const Scores wide =
      score(pictures, false, camera, grid({}, options.max_scale_change, 0.02, options.max_shift * camera.width, 2.0));
  const Scores near = score(pictures, true, camera, grid(wide.placements[wide.best(-1)], 0.02, 0.005, 2.0, 0.5));
  const std::size_t best = near.best(-1);
  const Placement& found = near.placements[best];
  std::vector<double> scales;
  std::vector<double> shifts_x;
  std::vector<double> shifts_y;
  std::vector<double> misfits;
  for (int g = 0; g < groups; ++g) {
    if (near.counts[static_cast<std::size_t>(g)] == 0.0) continue;
    const Placement& p = near.placements[near.best(g)];
    scales.push_back(p.scale);
    shifts_x.push_back(p.dx);
    shifts_y.push_back(p.dy);
    misfits.push_back(corner_misfit(p, camera));
  }
  // The sigmas are at least as large as the resolution of the search grid allows.
  report.scale = found.scale;
  report.scale_sigma = std::max(0.0025, jackknife_sigma(scales));
  report.shift_px = pixels_before * Eigen::Vector2d(found.dx, found.dy);
  report.shift_sigma_px = pixels_before * Eigen::Vector2d(std::max(0.25, jackknife_sigma(shifts_x)),
                                                          std::max(0.25, jackknife_sigma(shifts_y)));
  const Scores declared = score(pictures, true, camera, {Placement{}});
  report.contrast = near.mean(best, -1);
  report.declared_contrast = declared.mean(0, -1);
  const double misfit = corner_misfit(found, camera);
  const double misfit_sigma = std::max(0.25, jackknife_sigma(misfits));
  const std::string text = formatted(
      "depth's edges are found in the colour images at %.3f +- %.3f times their distance from the principal "
      "point, shifted by %.1f +- %.1f, %.1f +- %.1f px: %.1f px off in the corner",
      report.scale, report.scale_sigma, report.shift_px.x(), report.shift_sigma_px.x(), report.shift_px.y(),
      report.shift_sigma_px.y(), pixels_before * misfit);
  if (report.contrast < least_contrast) {
    report.text = "colour and depth: not decidable, colour shows no edges where depth does";
  } else if (misfit > options.clear * camera.width && misfit > options.sure * misfit_sigma &&
             report.declared_contrast - 1.0 < 0.5 * (report.contrast - 1.0)) {
    report.registered = false;
    report.text = "colour and depth are not of one camera: " + text +
                  " (another focal length, or depth that is not registered to colour: see depth_camera of camera.yaml)";
  } else if (misfit <= options.tolerance * camera.width) {
    report.registered = true;
    report.text = "colour and depth are of one camera: " + text;
  } else {
    report.text = "colour and depth: not decidable whether they are from exactly the same camera, " + text;
  }
  return report;
}

}  // namespace odosplat
