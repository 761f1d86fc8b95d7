// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat::python {

namespace py = pybind11;

// Python's values as the library's, and back. InputError(name, fault) for a type, shape or value that does not fit;
// needs the interpreter's lock.

/// A 4x4 matrix of a rigid motion (its rotation within 1e-3 of one), or seven numbers tx ty tz qx qy qz qw.
SE3 pose_from(const py::handle& value, const std::string& name);
/// [N x 4 x 4] or [N x 7], or a sequence of poses.
std::vector<SE3> poses_from(const py::handle& value, const std::string& name);
/// times [N] in ascending order, and as many poses.
Trajectory trajectory_from(const py::handle& times, const py::handle& poses, const std::string& name);

/// [4 x 4], float64.
py::array_t<double> matrix_of(const SE3& pose);
/// [N x 4 x 4], float64.
py::array_t<double> matrices_of(const std::vector<SE3>& poses);
/// (times [N], poses [N x 4 x 4])
py::tuple arrays_of(const Trajectory& trajectory);
py::array_t<double> array_of(const Matrix6d& matrix);
/// [H x W] and [H x W x 3], float32; the memory is that of the image.
py::array array_of(const cv::Mat1f& image);
py::array array_of(const cv::Mat3f& image);

/// float32 [N x shape...], row by row; copied.
std::vector<float> floats_from(const py::handle& value, const std::string& name, const std::vector<py::ssize_t>& shape);
/// A read-only array over memory that `owner` holds.
py::array view_of(const std::vector<float>& data, const std::vector<py::ssize_t>& shape, const py::handle& owner);

/// (points [N x 3], colors [N x 3] 0..1 or None, normals [N x 3] or None), or points alone.
PointCloud cloud_from(const py::handle& value, const std::string& name);
py::tuple arrays_of(const PointCloud& cloud);

/// Order of the channels of a colour image.
enum class ColorOrder { rgb, bgr };
/// "rgb" or "bgr".
ColorOrder color_order(const std::string& word);

/// An image as it came: uint8, or float32 within 0..1; [H x W] grey or [H x W x 3]. Holds a copy of the pixels.
struct RawImage {
  cv::Mat pixels;  // CV_8UC1, CV_8UC3, CV_32FC1, CV_32FC3
  ColorOrder order = ColorOrder::rgb;
  bool is_gray() const { return pixels.channels() == 1; }
};
/// size: width and height that it must have.
RawImage image_from(const py::handle& value, ColorOrder order, const cv::Size& size, const std::string& name);
/// As the readers of image files convert it, to the bit. Grey images have equal channels.
ColorImage color_of(const RawImage& image);
/// Of a grey float32 image its values, of others the luma of color_of, as grey image files are read.
GrayImage gray_of(const RawImage& image);
/// float32 [H x W] in metres, 0 = none.
DepthImage depth_from(const py::handle& value, const cv::Size& size, const std::string& name);

}  // namespace odosplat::python
