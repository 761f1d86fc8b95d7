// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Localises a camera in a map of Gaussians and prints one line per image: time, pose of the camera in the map's frame,
// status.
//   odosplat_example SOURCE camera.yaml map.ply tx ty tz qx qy qz qw
// SOURCE is the number of a camera ("0"), a video file, or a pattern for the images of a folder ("rgb/%06d.png"). The
// numbers after the map are the camera's pose at the first image [m]. Images must be free of lens distortion.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <exception>
#include <odosplat/compute/context.hpp>
#include <odosplat/core/error.hpp>
#include <odosplat/io/camera/camera_file.hpp>
#include <odosplat/odometry/odometry.hpp>
#include <odosplat/splat/gaussian_view.hpp>
#include <odosplat/splat/map_file.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>

namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int run(const std::string& source, char** words) {
  const bool live = std::all_of(source.begin(), source.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  cv::VideoCapture images;
  if (live) {
    images.open(std::stoi(source));
  } else {
    images.open(source);
  }
  if (!images.isOpened()) throw odosplat::InputError(source, "cannot be opened as images");
  const odosplat::CameraFile camera = odosplat::read_camera_file(words[0]);
  double v[7];
  for (int k = 0; k < 7; ++k) v[k] = std::stod(words[2 + k]);
  const odosplat::SE3 T_world_camera_start(Eigen::Quaterniond(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]});

  const odosplat::compute::Context device = odosplat::compute::Context::open();
  odosplat::GaussianView map(device, odosplat::read_map(words[1]));
  odosplat::OdometryOptions options;
  options.background = live;  // a camera does not wait; recorded images do, so their poses are reproducible
  odosplat::Odometry odometry(camera.camera, map, options, T_world_camera_start);

  const double fps = camera.fps > 0.0 ? camera.fps : 30.0;
  cv::Mat bgr;
  for (int k = 0; images.read(bgr); ++k) {
    const double time = live ? seconds_now() : k / fps;
    cv::Mat gray8;
    odosplat::GrayImage gray;
    cv::cvtColor(bgr, gray8, cv::COLOR_BGR2GRAY);
    gray8.convertTo(gray, CV_32F, 1.0 / 255.0);
    const odosplat::TrackResult result = odometry.track(gray, time);
    const Eigen::Vector3d& t = result.T_world_camera.translation();
    const Eigen::Quaterniond& q = result.T_world_camera.rotation();
    std::printf("%.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %s\n", time, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(),
                to_string(result.status).c_str());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 11) {
    std::fprintf(stderr, "usage: %s SOURCE camera.yaml map.ply tx ty tz qx qy qz qw\n", argv[0]);
    return 2;
  }
  try {
    return run(argv[1], argv + 2);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
