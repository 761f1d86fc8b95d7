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

/// Intersection of a ray and a triangle: the point p0 + u (p1 - p0) + v (p2 - p0) at ray parameter t.
struct RayHit {
  int triangle = -1;
  float t = 0.0F;
  float u = 0.0F;
  float v = 0.0F;
};

/// Bounding volume hierarchy over triangles, which are hit from both sides. Source: binary tree by the binned surface
/// area heuristic (Wald 2007); watertight triangle test (Woop, Benthin, Wald 2013), so that no ray passes between
/// neighbours that share corners. Without triangles nothing is hit. Immutable; any number of threads may use it.
class Bvh {
 public:
  using Triangle = std::array<Eigen::Vector3f, 3>;

  Bvh() = default;
  /// opaque: as long as triangles; any() ignores those with 0. Empty: all are opaque.
  explicit Bvh(const std::vector<Triangle>& triangles, const std::vector<char>& opaque = {});

  /// Nearest hit; false if there is none. hint: a triangle that is likely to be hit (-1: none), which only affects
  /// speed, unless two triangles are hit at exactly the same t.
  bool closest(const Ray& ray, RayHit& hit, int hint = -1) const;
  /// The same as closest() for four rays that lie close together, at the cost of about two. All must have t_min = 0.
  void closest4(const std::array<Ray, 4>& rays, std::array<RayHit, 4>& hits, std::array<bool, 4>& found,
                int hint = -1) const;
  /// Whether the ray hits any opaque triangle.
  bool any(const Ray& ray) const;

 private:
  struct Node {          // an inner node's left child is the next node, its right child is at `next`
    Eigen::Array4f low;  // x, y, z and an unused lane that never limits the interval
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
  std::vector<int> place_;  // position in triangles_ of each triangle's index
};

}  // namespace odosplat
