// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/splat/edit/room_map.hpp"

#include <cmath>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/map_places.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/render/ray_caster.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat::test {
namespace {

struct RoomImages {
  std::vector<EditView> views;
  std::vector<Rendering> images;
};

RoomImages make_images() {
  const Camera camera{160, 120, 90.0, 90.0, 79.5, 59.5};
  const Scene scene = make_box_room(7);
  constexpr int count = 24;
  RoomImages made;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * 3.141592653589793 * k / count;
    const Eigen::Vector3d eye(2.0 - 0.4 * std::cos(angle), 1.5 - 0.3 * std::sin(angle), 1.4);
    const double down = k % 2 == 0 ? 0.15 : 0.5;
    const SE3 T_world_camera = look_at(eye, eye + Eigen::Vector3d(std::cos(angle), std::sin(angle), -down));
    made.images.push_back(render(scene, camera, T_world_camera));
    const DepthImage depth = made.images.back().depth;
    made.views.push_back({camera, T_world_camera, [depth] { return depth; }});
  }
  return made;
}

const RoomImages& room_images() {
  static const RoomImages images = make_images();
  return images;
}

}  // namespace

const std::vector<EditView>& room_views() { return room_images().views; }

Map room_map(std::uint64_t seed, double noise) {
  Random random(seed);
  PointCloud cloud;
  const RoomImages& room = room_images();
  for (std::size_t k = 0; k < room.views.size(); ++k) {
    const EditView& view = room.views[k];
    const Rendering& image = room.images[k];
    for (int y = 1; y < image.depth.rows; y += 2) {
      for (int x = 1; x < image.depth.cols; x += 2) {
        const float z = image.depth(y, x);
        if (!(z > 0.0F)) continue;
        const double range = static_cast<double>(z) + noise * random.normal();
        cloud.points.push_back((view.T_world_camera * Eigen::Vector3d(range * view.camera.ray(x, y))).cast<float>());
        const cv::Vec3f& c = image.color(y, x);
        cloud.colors.emplace_back(c[0], c[1], c[2]);
      }
    }
  }
  // Another seed has other voxels, and so other points.
  const Eigen::Vector3f shift(static_cast<float>(random.uniform()), static_cast<float>(random.uniform()),
                              static_cast<float>(random.uniform()));
  constexpr float voxel = 0.05F;
  for (Eigen::Vector3f& p : cloud.points) p += voxel * shift;
  cloud = voxel_downsample(cloud, static_cast<double>(voxel));
  for (Eigen::Vector3f& p : cloud.points) p -= voxel * shift;
  std::vector<SE3> places;
  for (const EditView& view : room.views) places.push_back(view.T_world_camera);
  std::vector<std::string> notes = place_lines(places);
  for (const std::string& line : SigmaModel{1.0F, 0.1F, 0.002F, 0.01F}.to_lines()) notes.push_back(line);
  return {gaussians_from_cloud(cloud, {}), MapHeader::from_notes(notes)};
}

Map moved(Map map, const Eigen::Vector3f& by) {
  for (std::size_t i = 0; i < map.gaussians.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) map.gaussians.positions[3 * i + a] += by[static_cast<Eigen::Index>(a)];
  }
  return map;
}

Eigen::Vector3f centre(const Gaussians& gaussians, std::size_t i) {
  return Eigen::Vector3f(&gaussians.positions[3 * i]);
}

void add_ball(Gaussians& gaussians, const Eigen::Vector3f& at, float size, float opacity) {
  const std::size_t i = gaussians.size();
  gaussians.resize(i + 1);
  for (std::size_t a = 0; a < 3; ++a) {
    gaussians.positions[3 * i + a] = at[static_cast<Eigen::Index>(a)];
    gaussians.log_scales[3 * i + a] = std::log(size);
  }
  gaussians.rotations[4 * i] = 1.0F;
  gaussians.opacity_logits[i] = std::log(opacity / (1.0F - opacity));
}

}  // namespace odosplat::test
