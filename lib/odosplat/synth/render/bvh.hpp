// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <vector>

namespace odosplat {

/// Points origin + t * direction with t_min < t < t_max; direction need not have unit length.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float t_min = 0.0F;
  float t_max = std::numeric_limits<float>::infinity();
};

/// Where a ray meets a triangle: the point p0 + u (p1 - p0) + v (p2 - p0) at ray parameter t.
struct RayHit {
  int triangle = -1;
  float t = 0.0F;
  float u = 0.0F;
  float v = 0.0F;
};

/// Bounding volume hierarchy over triangles, seen from both sides. Source: binary tree by the binned surface area
/// heuristic (Wald 2007); watertight triangle test (Woop, Benthin, Wald 2013): no ray slips between neighbours that
/// share their corners. No triangles: nothing is ever hit. Immutable; any number of threads may ask.
class Bvh {
 public:
  using Triangle = std::array<Eigen::Vector3f, 3>;

  Bvh() = default;
  /// opaque: as long as triangles; those with 0 do not stop the rays of any(). Empty: all opaque.
  explicit Bvh(const std::vector<Triangle>& triangles, const std::vector<char>& opaque = {});

  /// Nearest hit; false if none. hint: a triangle that is likely to be hit (-1: none); the answer does not depend on it
  /// unless two triangles are hit at the very same t.
  bool closest(const Ray& ray, RayHit& hit, int hint = -1) const;
  /// Four rays that lie close together, at the price of about two: found[i] and hits[i] as closest() has them. All must
  /// start at t_min = 0.
  void closest4(const std::array<Ray, 4>& rays, std::array<RayHit, 4>& hits, std::array<bool, 4>& found,
                int hint = -1) const;
  /// Whether any opaque triangle is hit.
  bool any(const Ray& ray) const;

 private:
  struct Node {          // an inner node has its left child behind it and its right child at `next`
    Eigen::Array4f low;  // x, y, z and a lane that is never the tightest
    Eigen::Array4f high;
    int next = 0;
    int count = 0;  // > 0: a leaf of triangles next .. next + count - 1
  };
  struct Packed {
    Triangle p;
    int index = 0;
    bool opaque = true;
  };
  struct Traversal;
  struct Packet;
  struct Item;

  void build(std::vector<Item>& items, int begin, int end, int depth);
  static bool intersect(const Packed& triangle, const Traversal& ray, float t_max, RayHit& hit);

  std::vector<Node> nodes_;
  std::vector<Packed> triangles_;
  std::vector<int> place_;  // of a triangle's index in triangles_
};

}  // namespace odosplat
