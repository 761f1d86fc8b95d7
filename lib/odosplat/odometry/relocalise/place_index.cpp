// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/place_index.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

Camera index_camera(const Camera& camera, int width) {
  camera.check();
  if (camera.width <= width) return camera;
  const double scale = static_cast<double>(width) / camera.width;
  return camera.resized(width, std::max(1, static_cast<int>(std::lround(scale * camera.height))));
}

}  // namespace

void PlaceIndexOptions::check() const {
  require(width >= 64, "places.width", "at least 64 px");
  require(thumbnail_width >= 8 && thumbnail_width <= width, "places.thumbnail_width", "8 to width");
  require(max_shift >= 0 && 2 * max_shift <= thumbnail_width, "places.max_shift", "0 to half of thumbnail_width");
  require(features >= 50, "places.features", "at least 50");
  require(corner_threshold >= 1 && corner_threshold <= 100, "places.corner_threshold", "1 to 100");
  require(ratio > 0.0 && ratio <= 1.0, "places.ratio", "in (0, 1]");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "places.min_coverage", "in [0, 1]");
}

GrayImage resized_gray(const GrayImage& gray, const Camera& camera) {
  if (gray.cols == camera.width && gray.rows == camera.height) return gray;
  GrayImage small;
  cv::resize(gray, small, cv::Size(camera.width, camera.height), 0.0, 0.0, cv::INTER_AREA);
  return small;
}

PlaceIndex::PlaceIndex(const Camera& camera, MapView& map, const std::vector<SE3>& places,
                       const PlaceIndexOptions& options)
    : options_((options.check(), options)), camera_(index_camera(camera, options.width)) {
  for (const SE3& T_world_camera : places) {
    const ViewImages view = map.render(camera_, T_world_camera, {true, false});
    if (view.color.empty() || view.depth.empty()) continue;
    if (cv::countNonZero(view.depth) < options_.min_coverage * static_cast<double>(view.depth.total())) continue;
    PlaceView place;
    place.signature = signature(to_gray(view.color));
    ViewSignature& s = place.signature;
    const cv::Mat1f seen = cv::Mat1f(view.depth > 0.0F);
    cv::Mat1f share;
    cv::resize(seen, share, s.thumbnail.size(), 0.0, 0.0, cv::INTER_AREA);
    s.thumbnail_valid = share > 127.0F;
    // Corners without depth lie on no surface of the map: they are dropped.
    std::vector<cv::Point2f> corners;
    cv::Mat1b descriptors;
    for (int k = 0; k < s.descriptors.rows; ++k) {
      const cv::Point2f& corner = s.corners[static_cast<std::size_t>(k)];
      const double z = view.depth(static_cast<int>(std::lround(corner.y)), static_cast<int>(std::lround(corner.x)));
      if (!(z > 0.0)) continue;
      corners.push_back(corner);
      descriptors.push_back(s.descriptors.row(k));
      place.points_world.push_back(T_world_camera * (z * camera_.ray(corner.x, corner.y)));
    }
    s.corners = std::move(corners);
    s.descriptors = descriptors;
    places_.push_back(T_world_camera);
    views_.push_back(std::move(place));
  }
}

ViewSignature PlaceIndex::signature(const GrayImage& gray) const {
  ViewSignature s;
  const cv::Size size(options_.thumbnail_width,
                      std::max(2, options_.thumbnail_width * camera_.height / std::max(1, camera_.width)));
  cv::resize(gray, s.thumbnail, size, 0.0, 0.0, cv::INTER_AREA);
  cv::GaussianBlur(s.thumbnail, s.thumbnail, cv::Size(3, 3), 0.7, 0.7, cv::BORDER_REPLICATE);
  s.thumbnail_valid = cv::Mat1b(size, uchar{255});
  constexpr int edge = 19;  // a descriptor's patch must lie in the image
  const cv::Ptr<cv::ORB> orb =
      cv::ORB::create(options_.features, 1.2F, 6, edge, 0, 2, cv::ORB::HARRIS_SCORE, 31, options_.corner_threshold);
  cv::Mat1b bytes;
  gray.convertTo(bytes, CV_8U, 255.0);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  orb->detectAndCompute(bytes, cv::noArray(), keypoints, descriptors);
  for (const cv::KeyPoint& keypoint : keypoints) s.corners.push_back(keypoint.pt);
  s.descriptors = descriptors;
  return s;
}

std::vector<PlaceMatch> PlaceIndex::match(const ViewSignature& image) const {
  // Comparing corners takes a millisecond or two per place: in a large map it is done for the likeliest places only.
  constexpr std::size_t most_by_corners = 64;
  std::vector<PlaceMatch> matches(places_.size());
  parallel_for(static_cast<int>(places_.size()), 8, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      matches[static_cast<std::size_t>(k)].place = static_cast<std::size_t>(k);
      compare_thumbnails(image, matches[static_cast<std::size_t>(k)]);
    }
  });
  std::vector<std::size_t> order(matches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return matches[a].similarity > matches[b].similarity; });
  order.resize(std::min(order.size(), most_by_corners));
  parallel_for(static_cast<int>(order.size()), 4, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) match_points(image, matches[order[static_cast<std::size_t>(k)]]);
  });
  return matches;
}

void PlaceIndex::compare_thumbnails(const ViewSignature& image, PlaceMatch& match) const {
  const ViewSignature& place = views_[match.place].signature;
  const cv::Mat1f& a = image.thumbnail;
  const cv::Mat1f& b = place.thumbnail;
  const int side = options_.max_shift;
  const int up = side * a.rows / a.cols;
  const int enough = a.rows * a.cols / 3;
  for (int dy = -up; dy <= up; ++dy) {
    for (int dx = -side; dx <= side; ++dx) {
      double n = 0.0;
      double sum_a = 0.0;
      double sum_b = 0.0;
      double aa = 0.0;
      double bb = 0.0;
      double ab = 0.0;
      for (int y = std::max(0, -dy); y < std::min(a.rows, a.rows - dy); ++y) {
        const float* row_a = a[y];
        const float* row_b = b[y + dy];
        const uchar* valid = place.thumbnail_valid[y + dy];
        for (int x = std::max(0, -dx); x < std::min(a.cols, a.cols - dx); ++x) {
          if (valid[x + dx] == 0) continue;
          const double va = row_a[x];
          const double vb = row_b[x + dx];
          n += 1.0;
          sum_a += va;
          sum_b += vb;
          aa += va * va;
          bb += vb * vb;
          ab += va * vb;
        }
      }
      if (n < enough) continue;
      const double variance = (aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n);
      const double similarity = (ab - sum_a * sum_b / n) / std::sqrt(std::max(variance, 1e-12));
      if (similarity <= match.similarity) continue;
      match.similarity = similarity;
      match.shift = {static_cast<double>(dx) * camera_.width / a.cols,
                     static_cast<double>(dy) * camera_.height / a.rows};
    }
  }
}

void PlaceIndex::match_points(const ViewSignature& image, PlaceMatch& match) const {
  const PlaceView& place = views_[match.place];
  if (image.descriptors.rows < 2 || place.signature.descriptors.rows < 2) return;
  const cv::BFMatcher matcher(cv::NORM_HAMMING);
  std::vector<std::vector<cv::DMatch>> nearest;
  matcher.knnMatch(image.descriptors, place.signature.descriptors, nearest, 2);
  for (const auto& pair : nearest) {
    if (pair.size() < 2 || pair[0].distance > options_.ratio * pair[1].distance) continue;
    match.points.push_back({place.points_world[static_cast<std::size_t>(pair[0].trainIdx)],
                            image.corners[static_cast<std::size_t>(pair[0].queryIdx)]});
  }
}

}  // namespace odosplat
