// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat::test {

/// Writes a COLMAP model as COLMAP does, to test the readers. Implemented from the format's description, independently
/// of the readers.
struct ColmapModel {
  struct Camera {
    std::uint32_t id;
    int model;  // COLMAP's number of the model
    const char* name;
    std::uint64_t width;
    std::uint64_t height;
    std::vector<double> parameters;
  };
  struct Image {
    std::uint32_t id;
    SE3 T_camera_world;
    std::uint32_t camera;
    std::string name;
    int pixels = 0;  // number of observed pixels
  };
  std::vector<Camera> cameras;
  std::vector<Image> images;
  PointCloud points;

  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.17g", value);
    return text;
  }

  std::string cameras_text() const {
    std::string text = "# Camera list with one line of data per camera:\n";
    for (const Camera& c : cameras) {
      text += std::to_string(c.id) + " " + c.name + " " + std::to_string(c.width) + " " + std::to_string(c.height);
      for (const double p : c.parameters) text += " " + number(p);
      text += "\n";
    }
    return text;
  }
  std::string images_text() const {
    std::string text = "# Image list with two lines of data per image:\n";
    for (const Image& i : images) {
      const Eigen::Quaterniond& q = i.T_camera_world.rotation();
      const Eigen::Vector3d& t = i.T_camera_world.translation();
      text += std::to_string(i.id);
      for (const double v : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) text += " " + number(v);
      text += " " + std::to_string(i.camera) + " " + i.name + "\n";
      for (int k = 0; k < i.pixels; ++k) text += (k > 0 ? " " : "") + number(1.5 + k) + " 2.5 -1";
      text += "\n";
    }
    return text;
  }
  std::string points_text() const {
    std::string text = "# 3D point list with one line of data per point:\n";
    for (std::size_t k = 0; k < points.size(); ++k) {
      text += std::to_string(k + 1);
      for (int a = 0; a < 3; ++a) text += " " + number(points.points[k][a]);
      for (int a = 0; a < 3; ++a) text += " " + std::to_string(byte_of(points.colors[k][a]));
      text += " 0.5 1 0 2 0\n";
    }
    return text;
  }

  std::string cameras_binary() const {
    std::string bytes = word<std::uint64_t>(cameras.size());
    for (const Camera& c : cameras) {
      bytes += word<std::uint32_t>(c.id) + word<std::uint32_t>(static_cast<std::uint32_t>(c.model)) +
               word<std::uint64_t>(c.width) + word<std::uint64_t>(c.height);
      for (const double p : c.parameters) bytes += real(p);
    }
    return bytes;
  }
  std::string images_binary() const {
    std::string bytes = word<std::uint64_t>(images.size());
    for (const Image& i : images) {
      const Eigen::Quaterniond& q = i.T_camera_world.rotation();
      const Eigen::Vector3d& t = i.T_camera_world.translation();
      bytes += word<std::uint32_t>(i.id);
      for (const double v : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) bytes += real(v);
      bytes += word<std::uint32_t>(i.camera) + i.name + std::string(1, '\0');
      bytes += word<std::uint64_t>(static_cast<std::uint64_t>(i.pixels));
      for (int k = 0; k < i.pixels; ++k) bytes += real(1.5 + k) + real(2.5) + word<std::uint64_t>(~std::uint64_t{0});
    }
    return bytes;
  }
  std::string points_binary() const {
    std::string bytes = word<std::uint64_t>(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      bytes += word<std::uint64_t>(k + 1);
      for (int a = 0; a < 3; ++a) bytes += real(points.points[k][a]);
      for (int a = 0; a < 3; ++a) bytes += static_cast<char>(byte_of(points.colors[k][a]));
      bytes += real(0.5) + word<std::uint64_t>(2);
      for (const std::uint32_t entry : {1U, 0U, 2U, 0U}) bytes += word<std::uint32_t>(entry);
    }
    return bytes;
  }

 private:
  static int byte_of(float color) { return static_cast<int>(255.0F * color + 0.5F); }
  template <typename T>
  static std::string word(T value) {
    std::string bytes;
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
    return bytes;
  }
  static std::string real(double value) { return word(std::bit_cast<std::uint64_t>(value)); }
};

}  // namespace odosplat::test
