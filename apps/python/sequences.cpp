// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/python/sequences.hpp"

#include <pybind11/stl.h>

#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/cameras.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::python {
namespace {

HeldSequence open(const std::string& path, const std::string& layout, const std::string& camera_file,
                  std::int64_t max_image_pixels) {
  const py::gil_scoped_release unlocked;
  SequenceOptions options;
  options.layout = layout;
  options.camera_file = camera_file;
  if (max_image_pixels > 0) options.max_image_pixels = max_image_pixels;
  options.check();
  return {Sequence::open(path, options), path, options};
}

py::object pose_or_none(const std::optional<SE3>& pose) { return pose ? py::object(matrix_of(*pose)) : py::none(); }

template <typename Image>
py::array image(const HeldSequence& held, std::size_t i, Image (Sequence::*read)(std::size_t) const) {
  Image image;
  {
    const py::gil_scoped_release unlocked;
    image = (held.sequence.*read)(i);
  }
  return array_of(image);
}

py::dict camera_of(const Sequence& sequence) {
  CameraFile pinhole;
  pinhole.camera = sequence.camera();
  pinhole.fps = sequence.fps();
  return fields_of(pinhole);
}

Trajectory read(const std::string& path, const std::string& times) {
  const py::gil_scoped_release unlocked;
  return read_trajectory(path, times);
}

}  // namespace

std::vector<Sequence> sequences_from(const py::list& list, const std::string& name) {
  std::vector<Sequence> sequences;
  for (const py::handle& item : list) sequences.push_back(item.cast<const HeldSequence&>().sequence);
  if (sequences.empty()) throw InputError(name, "holds no sequence");
  return sequences;
}

void bind_sequences(py::module_& m) {
  py::class_<HeldSequence>(m, "HeldSequence")
      .def("name", [](const HeldSequence& held) { return py::bytes(held.sequence.name()); })
      .def("layout", [](const HeldSequence& held) { return held.sequence.layout(); })
      .def("size", [](const HeldSequence& held) { return held.sequence.size(); })
      .def("fps", [](const HeldSequence& held) { return held.sequence.fps(); })
      .def("camera", [](const HeldSequence& held) { return camera_of(held.sequence); })
      .def("camera_file", [](const HeldSequence& held) { return fields_of(held.sequence.declared_camera()); })
      .def("time", [](const HeldSequence& held, std::size_t i) { return held.sequence.time(i); })
      .def("color", [](const HeldSequence& held, std::size_t i) { return image(held, i, &Sequence::color); })
      .def("gray", [](const HeldSequence& held, std::size_t i) { return image(held, i, &Sequence::gray); })
      .def("has_depth", [](const HeldSequence& held, std::size_t i) { return held.sequence.has_depth(i); })
      .def("depth", [](const HeldSequence& held, std::size_t i) { return image(held, i, &Sequence::depth); })
      .def("T_world_camera",
           [](const HeldSequence& held, std::size_t i) { return pose_or_none(held.sequence.T_world_camera(i)); })
      .def("T_world_depth",
           [](const HeldSequence& held, std::size_t i) { return pose_or_none(held.sequence.T_world_depth(i)); })
      .def("truth", [](const HeldSequence& held) { return arrays_of(held.sequence.truth()); });
  m.def("open_sequence", &open);
  m.def("read_trajectory",
        [](const std::string& path, const std::string& times) { return arrays_of(read(path, times)); });
  m.def("write_trajectory", [](const std::string& path, const py::object& times, const py::object& poses) {
    write_trajectory(path, trajectory_from(times, poses, "trajectory"));
  });
}

}  // namespace odosplat::python
