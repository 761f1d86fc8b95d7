// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/python/arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "odosplat/core/error.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::python {
namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k) text += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  return text + ")";
}

std::string type_text(const py::array& array) { return py::str(py::object(array.dtype())).cast<std::string>(); }

/// The value as float64, whatever numbers it has.
py::array_t<double> numbers_from(const py::handle& value, const std::string& name) {
  auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw InputError(name, "must be an array of numbers");
  }
  return array;
}

SE3 pose_of_matrix(const double* m, const std::string& name) {
  const bool last_row = m[12] == 0.0 && m[13] == 0.0 && m[14] == 0.0 && m[15] == 1.0;
  if (!last_row) throw InputError(name, "the last row of a pose must be 0 0 0 1");
  for (int k = 0; k < 12; ++k) {
    if (!std::isfinite(m[k])) throw InputError(name, "must be finite");
  }
  const std::optional<SE3> pose = pose_from_rows(std::vector<double>(m, m + 12));
  if (!pose) throw InputError(name, "must be a rigid motion: its upper left 3x3 part is no rotation");
  return *pose;
}

SE3 pose_of_seven(const double* v, const std::string& name) {
  try {
    const SE3 pose(rotation_from_text(Eigen::Quaterniond(v[6], v[3], v[4], v[5])), Eigen::Vector3d(v[0], v[1], v[2]));
    if (!pose.is_finite()) throw InputError("must be finite");
    return pose;
  } catch (const InputError& e) {
    throw InputError(name, e.what());
  }
}

template <typename Image>
py::array array_of_image(const Image& image, std::vector<py::ssize_t> shape) {
  auto* kept = new Image(image.isContinuous() ? image : Image(image.clone()));
  const py::capsule owner(kept, [](void* held) { delete static_cast<Image*>(held); });
  return py::array(py::dtype::of<float>(), std::move(shape), kept->data, owner);
}

void require_within_0_1(const cv::Mat& image, const std::string& name) {
  constexpr float rounding = 1e-4F;  // of resampled images
  const std::size_t row = static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.channels());
  for (int y = 0; y < image.rows; ++y) {
    const float* values = image.ptr<float>(y);
    for (std::size_t k = 0; k < row; ++k) {
      if (!(values[k] >= -rounding && values[k] <= 1.0F + rounding))
        throw InputError(name, "float32 images must be within 0..1, has " + std::to_string(values[k]));
    }
  }
}

std::vector<Eigen::Vector3f> rows_of_three(const py::handle& value, const std::string& name) {
  const py::array_t<double> array = numbers_from(value, name);
  if (array.ndim() != 2 || array.shape(1) != 3) throw InputError(name, "must be [N x 3], is " + shape_text(array));
  std::vector<Eigen::Vector3f> rows(static_cast<std::size_t>(array.shape(0)));
  const double* data = array.data();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = Eigen::Map<const Eigen::Vector3d>(data + 3 * i).cast<float>();
    if (!rows[i].allFinite()) throw InputError(name, "row " + std::to_string(i), "must be finite");
  }
  return rows;
}

py::object array_of(const std::vector<Eigen::Vector3f>& rows) {
  if (rows.empty()) return py::none();
  py::array_t<float> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  std::memcpy(array.mutable_data(), rows.data(), rows.size() * sizeof(Eigen::Vector3f));
  return array;
}

}  // namespace

SE3 pose_from(const py::handle& value, const std::string& name) {
  const py::array_t<double> array = numbers_from(value, name);
  if (array.ndim() == 2 && array.shape(0) == 4 && array.shape(1) == 4) return pose_of_matrix(array.data(), name);
  if (array.ndim() == 1 && array.shape(0) == 7) return pose_of_seven(array.data(), name);
  throw InputError(name, "must be [4 x 4], or seven numbers tx ty tz qx qy qz qw; is " + shape_text(array));
}

std::vector<SE3> poses_from(const py::handle& value, const std::string& name) {
  const py::array_t<double> array = numbers_from(value, name);
  const bool matrices = array.ndim() == 3 && array.shape(1) == 4 && array.shape(2) == 4;
  const bool sevens = array.ndim() == 2 && array.shape(1) == 7;
  if (!matrices && !sevens) {
    throw InputError(name, "must be [N x 4 x 4], or [N x 7] of tx ty tz qx qy qz qw; is " + shape_text(array));
  }
  std::vector<SE3> poses;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const std::string place = name + "[" + std::to_string(i) + "]";
    poses.push_back(matrices ? pose_of_matrix(array.data() + 16 * i, place)
                             : pose_of_seven(array.data() + 7 * i, place));
  }
  return poses;
}

Trajectory trajectory_from(const py::handle& times, const py::handle& poses, const std::string& name) {
  const py::array_t<double> stamps = numbers_from(times, name + " times");
  if (stamps.ndim() != 1) throw InputError(name, "times must be [N], are " + shape_text(stamps));
  const std::vector<SE3> all = poses_from(poses, name + " poses");
  if (all.size() != static_cast<std::size_t>(stamps.shape(0))) {
    throw InputError(name,
                     "has " + std::to_string(stamps.shape(0)) + " times and " + std::to_string(all.size()) + " poses");
  }
  Trajectory trajectory;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double time = stamps.data()[i];
    if (!std::isfinite(time)) throw InputError(name, "times must be finite");
    if (!trajectory.empty() && time < trajectory.back().time) throw InputError(name, "times must be ascending");
    trajectory.push_back({time, all[i], ""});
  }
  return trajectory;
}

py::array_t<double> matrix_of(const SE3& pose) {
  py::array_t<double> array({4, 4});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.mutable_data()) = pose.matrix();
  return array;
}

py::array_t<double> matrices_of(const std::vector<SE3>& poses) {
  py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), py::ssize_t{4}, py::ssize_t{4}});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.mutable_data() + 16 * i) = poses[i].matrix();
  }
  return array;
}

py::tuple arrays_of(const Trajectory& trajectory) {
  py::array_t<double> times(static_cast<py::ssize_t>(trajectory.size()));
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    times.mutable_data()[i] = trajectory[i].time;
    poses.push_back(trajectory[i].T_world_camera);
  }
  return py::make_tuple(times, matrices_of(poses));
}

py::array_t<double> array_of(const Matrix6d& matrix) {
  py::array_t<double> array({6, 6});
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(array.mutable_data()) = matrix;
  return array;
}

py::array array_of(const cv::Mat1f& image) { return array_of_image(image, {image.rows, image.cols}); }
py::array array_of(const cv::Mat3f& image) { return array_of_image(image, {image.rows, image.cols, 3}); }

std::vector<float> floats_from(const py::handle& value, const std::string& name,
                               const std::vector<py::ssize_t>& shape) {
  const auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw InputError(name, "must be an array of numbers");
  }
  const auto dimensions = static_cast<py::ssize_t>(shape.size()) + 1;
  if (array.ndim() != dimensions || !std::equal(shape.begin(), shape.end(), array.shape() + 1)) {
    std::string wanted = "[N";
    for (const py::ssize_t size : shape) wanted += " x " + std::to_string(size);
    throw InputError(name, "must be " + wanted + "], is " + shape_text(array));
  }
  return {array.data(), array.data() + array.size()};
}

py::array view_of(const std::vector<float>& data, const std::vector<py::ssize_t>& shape, const py::handle& owner) {
  py::array view(py::dtype::of<float>(), shape, data.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

PointCloud cloud_from(const py::handle& value, const std::string& name) {
  PointCloud cloud;
  if (!py::isinstance<py::tuple>(value)) {
    cloud.points = rows_of_three(value, name);
  } else {
    const auto parts = py::reinterpret_borrow<py::tuple>(value);
    if (parts.size() < 1 || parts.size() > 3) throw InputError(name, "must be (points, colors, normals)");
    cloud.points = rows_of_three(parts[0], name + " points");
    if (parts.size() > 1 && !parts[1].is_none()) cloud.colors = rows_of_three(parts[1], name + " colors");
    if (parts.size() > 2 && !parts[2].is_none()) cloud.normals = rows_of_three(parts[2], name + " normals");
  }
  if (cloud.points.empty()) throw InputError(name, "holds no point");
  for (const auto* other : {&cloud.colors, &cloud.normals}) {
    if (!other->empty() && other->size() != cloud.size())
      throw InputError(name, "colors and normals must be as many as points");
  }
  for (const Eigen::Vector3f& color : cloud.colors) {
    if (color.minCoeff() < 0.0F || color.maxCoeff() > 1.0F) throw InputError(name, "colors must be within 0..1");
  }
  for (Eigen::Vector3f& normal : cloud.normals) {
    if (normal.norm() < 1e-6F) throw InputError(name, "a normal has length 0");
    if (std::abs(normal.norm() - 1.0F) > 1e-5F) normal.normalize();  // others keep their bits
  }
  return cloud;
}

py::tuple arrays_of(const PointCloud& cloud) {
  return py::make_tuple(array_of(cloud.points), array_of(cloud.colors), array_of(cloud.normals));
}

ColorOrder color_order(const std::string& word) {
  if (word == "rgb") return ColorOrder::rgb;
  if (word == "bgr") return ColorOrder::bgr;
  throw InputError("color_order", "must be rgb or bgr (OpenCV's), is " + word);
}

RawImage image_from(const py::handle& value, ColorOrder order, const cv::Size& size, const std::string& name) {
  if (!py::isinstance<py::array>(value)) {
    throw InputError(
        name, "must be a numpy array, is " + py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>());
  }
  const auto given = py::reinterpret_borrow<py::array>(value);
  const bool bytes = py::isinstance<py::array_t<std::uint8_t>>(given);
  if (!bytes && !py::isinstance<py::array_t<float>>(given)) {
    throw InputError(name, "must be uint8 (0..255) or float32 (0..1), is " + type_text(given));
  }
  const bool color = given.ndim() == 3 && given.shape(2) == 3;
  if ((given.ndim() != 2 && !color) || given.shape(0) != size.height || given.shape(1) != size.width) {
    const std::string wanted = std::to_string(size.height) + ", " + std::to_string(size.width);
    throw InputError(name,
                     "must have the camera's shape (" + wanted + ") or (" + wanted + ", 3), has " + shape_text(given));
  }
  const py::array packed = py::array::ensure(given, py::array::c_style);
  RawImage image;
  image.order = order;
  image.pixels.create(size, CV_MAKETYPE(bytes ? CV_8U : CV_32F, color ? 3 : 1));
  std::memcpy(image.pixels.data, packed.data(), static_cast<std::size_t>(packed.nbytes()));
  if (!bytes) require_within_0_1(image.pixels, name);
  return image;
}

DepthImage depth_from(const py::handle& value, const cv::Size& size, const std::string& name) {
  if (!py::isinstance<py::array_t<float>>(value)) throw InputError(name, "must be a float32 array [H x W] in metres");
  const auto packed = py::array_t<float, py::array::c_style>::ensure(value);
  if (packed.ndim() != 2 || packed.shape(0) != size.height || packed.shape(1) != size.width) {
    throw InputError(name, "must have the camera's shape (" + std::to_string(size.height) + ", " +
                               std::to_string(size.width) + "), has " + shape_text(packed));
  }
  DepthImage depth(size);
  std::memcpy(depth.data, packed.data(), static_cast<std::size_t>(packed.nbytes()));
  for (const float z : depth) {
    if (!(std::isfinite(z) && z >= 0.0F)) throw InputError(name, "must be finite and at least 0 (0: none)");
  }
  return depth;
}

}  // namespace odosplat::python
