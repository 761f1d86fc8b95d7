// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

using Vec = Eigen::Vector3f;

/// Squared distance from p to a triangle. Source: Ericson, Real-Time Collision Detection (2005), 5.1.5.
float squared_distance(const Vec& p, const Bvh::Triangle& t) {
  const Vec ab = t[1] - t[0];
  const Vec ac = t[2] - t[0];
  const Vec ap = p - t[0];
  const float d1 = ab.dot(ap);
  const float d2 = ac.dot(ap);
  if (d1 <= 0.0F && d2 <= 0.0F) return ap.squaredNorm();
  const Vec bp = p - t[1];
  const float d3 = ab.dot(bp);
  const float d4 = ac.dot(bp);
  if (d3 >= 0.0F && d4 <= d3) return bp.squaredNorm();
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Vec cp = p - t[2];
  const float d5 = ab.dot(cp);
  const float d6 = ac.dot(cp);
  if (d6 >= 0.0F && d5 <= d6) return cp.squaredNorm();
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F) {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1])).squaredNorm();
  }
  const float scale = 1.0F / (va + vb + vc);
  return (ap - vb * scale * ab - vc * scale * ac).squaredNorm();
}

struct Box {
  Vec low, high;
};

}  // namespace

Clearance clearance(const Scene& scene, const Trajectory& path, double reach) {
  const std::vector<SceneTriangle>& triangles = scene.content().triangles;
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const SceneTriangle& t : triangles) {
    boxes.push_back({t.p_world[0].cwiseMin(t.p_world[1]).cwiseMin(t.p_world[2]),
                     t.p_world[0].cwiseMax(t.p_world[1]).cwiseMax(t.p_world[2])});
  }
  std::vector<float> nearest(path.size());
  parallel_for(static_cast<int>(path.size()), 16, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec p = path[i].T_world_camera.translation().cast<float>();
      float best = static_cast<float>(reach * reach);
      for (std::size_t j = 0; j < boxes.size(); ++j) {
        const Vec outside = (boxes[j].low - p).cwiseMax(p - boxes[j].high).cwiseMax(0.0F);
        if (outside.squaredNorm() < best) best = std::min(best, squared_distance(p, triangles[j].p_world));
      }
      nearest[i] = best;
    }
  });
  const auto least = std::min_element(nearest.begin(), nearest.end());
  if (least == nearest.end()) return {reach, 0};
  return {std::sqrt(static_cast<double>(*least)), static_cast<std::size_t>(least - nearest.begin())};
}

}  // namespace odosplat
