// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/python/cameras.hpp"

#include <pybind11/stl.h>

#include <filesystem>

#include "apps/python/bindings.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/camera/camera_file.hpp"

namespace odosplat::python {
namespace {

template <typename Value>
Value attribute(const py::handle& camera, const char* field, const std::string& name) {
  if (!py::hasattr(camera, field)) throw InputError(name, "must be an odosplat.Camera");
  try {
    return camera.attr(field).cast<Value>();
  } catch (const py::cast_error&) {
    throw InputError(name, field, "is of the wrong type");
  }
}

Camera pinhole_from(const py::handle& camera, const std::string& name) {
  return {attribute<int>(camera, "width", name), attribute<int>(camera, "height", name),
          attribute<double>(camera, "fx", name), attribute<double>(camera, "fy", name),
          attribute<double>(camera, "cx", name), attribute<double>(camera, "cy", name)};
}

py::dict fields_of(const Camera& camera) {
  py::dict fields;
  fields["width"] = camera.width;
  fields["height"] = camera.height;
  fields["fx"] = camera.fx;
  fields["fy"] = camera.fy;
  fields["cx"] = camera.cx;
  fields["cy"] = camera.cy;
  return fields;
}

py::dict read_camera(const std::string& path) {
  CameraFile file = read_camera_file(path);
  if (!file.vignette.empty()) {
    file.vignette = std::filesystem::absolute(vignette_path(file, path)).lexically_normal().string();
  }
  return python::fields_of(file);
}

}  // namespace

CameraFile camera_from(const py::handle& camera, const std::string& name) {
  CameraFile file;
  file.camera = pinhole_from(camera, name);
  file.camera.readout = attribute<double>(camera, "line_time", name) * file.camera.height;
  file.fy_sign = attribute<int>(camera, "fy_sign", name);
  if (file.fy_sign != 1 && file.fy_sign != -1) throw InputError(name, "fy_sign", "must be 1 or -1");
  file.distortion = attribute<std::vector<double>>(camera, "distortion", name);
  if (!file.distortion.empty() && file.distortion.size() != 4 && file.distortion.size() != 5) {
    throw InputError(name, "distortion", "must be k1 k2 p1 p2, or k1 k2 p1 p2 k3");
  }
  const auto depth_scale = attribute<std::optional<double>>(camera, "depth_scale", name);
  file.has_depth_scale = depth_scale.has_value();
  if (depth_scale) file.depth_scale = *depth_scale;
  file.fps = attribute<double>(camera, "fps", name);
  file.time_offset = attribute<double>(camera, "time_offset", name);
  file.gamma = attribute<double>(camera, "gamma", name);
  file.vignette = attribute<std::string>(camera, "vignette", name);
  if (const py::object depth = camera.attr("depth_camera"); !depth.is_none()) {
    const std::string part = name + " depth_camera";
    file.depth_camera = DepthCamera{pinhole_from(depth, part), pose_from(depth.attr("T_color_depth"), part),
                                    attribute<double>(depth, "time_offset", part)};
  }
  check_camera(name, file);
  return file;
}

py::dict fields_of(const CameraFile& file) {
  py::dict fields = fields_of(file.camera);
  fields["distortion"] = py::tuple(py::cast(file.distortion));
  fields["fps"] = file.fps;
  fields["fy_sign"] = file.fy_sign;
  fields["depth_scale"] = file.has_depth_scale ? py::object(py::float_(file.depth_scale)) : py::none();
  fields["time_offset"] = file.time_offset;
  fields["line_time"] = file.camera.readout / file.camera.height;
  fields["gamma"] = file.gamma;
  fields["vignette"] = file.vignette;
  fields["depth_camera"] = py::none();
  if (file.depth_camera) {
    py::dict depth = fields_of(file.depth_camera->camera);
    depth["T_color_depth"] = matrix_of(file.depth_camera->T_color_depth);
    depth["time_offset"] = file.depth_camera->time_offset;
    fields["depth_camera"] = depth;
  }
  return fields;
}

ImageInput::ImageInput(const CameraFile& camera, ColorOrder order)
    : camera_(camera.camera),
      order_(order),
      correction_(camera, vignette_of(camera, "camera", ImageLimit::default_max_pixels)) {}

ColorImage ImageInput::color(const RawImage& image) const { return correction_.color(color_of(image)); }

GrayImage ImageInput::gray(const RawImage& image) const {
  return correction_.is_identity() ? gray_of(image) : to_gray(color(image));
}

void bind_cameras(py::module_& m) {
  m.def("read_camera", &read_camera);
  m.def("write_camera",
        [](const std::string& path, const py::handle& camera) { write_camera_file(path, camera_from(camera)); });
  m.def("check_camera", [](const py::handle& camera) { camera_from(camera); });
}

}  // namespace odosplat::python
