// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/python/maps.hpp"

#include <pybind11/stl.h>

#include "apps/cli/map_quality_json.hpp"
#include "apps/command/json_text.hpp"
#include "apps/input/sampled_places.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/cameras.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::python {
namespace {

using Held = std::shared_ptr<HeldMap>;

Held read(const std::string& path) {
  const py::gil_scoped_release unlocked;
  return std::make_shared<HeldMap>(read_map(path));
}

void write(const HeldMap& held, const std::string& path) {
  const py::gil_scoped_release unlocked;
  write_map(path, held.map());
}

Held from_arrays(const py::object& positions, const py::object& log_scales, const py::object& rotations,
                 const py::object& opacity_logits, const py::object& sh, const std::vector<std::string>& notes) {
  Map map;
  Gaussians& g = map.gaussians;
  g.opacity_logits = floats_from(opacity_logits, "opacity_logits", {});
  g.positions = floats_from(positions, "positions", {3});
  g.log_scales = floats_from(log_scales, "log_scales", {3});
  g.rotations = floats_from(rotations, "rotations", {4});
  const py::array array = py::array::ensure(sh);
  if (!array) PyErr_Clear();
  const py::ssize_t coefficients = array && array.ndim() == 3 ? array.shape(1) : 0;
  for (g.sh_degree = 0; g.sh_degree < 3 && g.coefficients() < coefficients;) ++g.sh_degree;
  if (g.coefficients() != coefficients) throw InputError("sh", "must be [N x K x 3] with K = 1, 4, 9 or 16");
  g.sh = floats_from(sh, "sh", {coefficients, 3});
  g.check();
  if (g.empty()) throw InputError("positions", "holds no Gaussian");
  const auto stride = [&](const std::vector<float>& values) { return values.size() / g.size(); };
  for (std::size_t i = 0; i < g.size(); ++i) {
    for (const auto* values : {&g.positions, &g.log_scales, &g.rotations, &g.opacity_logits, &g.sh}) {
      for (std::size_t k = i * stride(*values); k < (i + 1) * stride(*values); ++k) {
        if (!std::isfinite((*values)[k]))
          throw InputError("Gaussian " + std::to_string(i), "has a value that is not finite");
      }
    }
    if (const std::string fault = undrawable_value(g, i); !fault.empty())
      throw InputError("Gaussian " + std::to_string(i), fault);
  }
  map.header = MapHeader::from_notes(notes);
  return std::make_shared<HeldMap>(std::move(map));
}

py::array view(const Held& held, const std::vector<float>& values, std::vector<py::ssize_t> shape) {
  shape.insert(shape.begin(), static_cast<py::ssize_t>(held->map().gaussians.size()));
  return view_of(values, shape, py::cast(held));
}

py::dict render(HeldMap& held, const py::object& camera, const py::object& T_world_camera, const std::string& device,
                const std::string& depth) {
  const Camera pinhole = camera_from(camera).camera;
  const SE3 pose = pose_from(T_world_camera, "T_world_camera");
  ViewImages images;
  {
    const py::gil_scoped_release unlocked;
    images = held.render(device, depth, pinhole, pose);
  }
  py::dict result;
  result["color"] = array_of(images.color);
  result["depth"] = array_of(images.depth);
  result["sigma"] = array_of(images.sigma);
  result["alpha"] = array_of(images.alpha);
  return result;
}

}  // namespace

std::vector<SE3> HeldMap::places() const {
  if (!map_.header.places.empty()) return map_.header.places;
  std::vector<SE3> places = apps::sampled_places(map_.gaussians);
  log_info("the map does not say where it was seen from: " + std::to_string(places.size()) +
           " places are sampled in it; poses of cameras that were there (places) serve better");
  return places;
}

ViewImages HeldMap::render(const std::string& device, const std::string& depth, const Camera& camera,
                           const SE3& T_world_camera) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<GaussianView>& view = views_[{device, depth}];
  if (view == nullptr) view = std::make_unique<GaussianView>(open_device(device), map_, depth_mode(depth));
  return view->render(camera, T_world_camera, {true, true});
}

void bind_maps(py::module_& m) {
  py::class_<HeldMap, Held>(m, "HeldMap")
      .def("write", &write)
      .def("size", [](const HeldMap& held) { return held.map().gaussians.size(); })
      .def("sh_degree", [](const HeldMap& held) { return held.map().gaussians.sh_degree; })
      .def("positions", [](const Held& held) { return view(held, held->map().gaussians.positions, {3}); })
      .def("log_scales", [](const Held& held) { return view(held, held->map().gaussians.log_scales, {3}); })
      .def("rotations", [](const Held& held) { return view(held, held->map().gaussians.rotations, {4}); })
      .def("opacity_logits", [](const Held& held) { return view(held, held->map().gaussians.opacity_logits, {}); })
      .def("sh",
           [](const Held& held) {
             return view(held, held->map().gaussians.sh, {held->map().gaussians.coefficients(), 3});
           })
      .def("notes", [](const HeldMap& held) { return held.map().header.notes; })
      .def("places", [](const HeldMap& held) { return matrices_of(held.map().header.places); })
      .def("quality",
           [](const HeldMap& held) {
             const auto& quality = held.map().header.quality;
             return quality ? apps::json_text(apps::json_of(*quality)) : std::string("null");
           })
      .def("render", &render);
  m.def("read_map", &read);
  m.def("map_from_arrays", &from_arrays);
}

}  // namespace odosplat::python
