// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <pybind11/stl.h>

#include "apps/input/cloud_files.hpp"
#include "apps/input/sequence_cloud.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/sequences.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"

namespace odosplat::python {
namespace {

py::tuple read(const std::string& path, double voxel, bool remove_outliers) {
  PointCloud cloud;
  {
    const py::gil_scoped_release unlocked;
    cloud = apps::read_cloud(path, voxel, remove_outliers);
  }
  return arrays_of(cloud);
}

void write(const std::string& path, const py::object& value) {
  const PointCloud cloud = cloud_from(value, "cloud");
  const py::gil_scoped_release unlocked;
  write_point_cloud(path, cloud);
}

py::tuple build(const py::list& list, int every, const py::object& frames, bool remove_outliers, double voxel,
                double noise, std::uint64_t seed) {
  require(every >= 1, "every", "at least 1");
  const std::vector<Sequence> sequences = sequences_from(list, "sequences");
  const apps::FrameRange range = frames_from(frames);
  CloudOptions options;
  options.voxel = voxel;
  options.noise = noise;
  options.seed = seed;
  options.check();
  PointCloud cloud;
  {
    const py::gil_scoped_release unlocked;
    cloud = apps::cloud_of_sequences(sequences, options, every, range);
    if (remove_outliers) cloud = apps::without_outliers(cloud);
  }
  return arrays_of(cloud);
}

}  // namespace

void bind_clouds(py::module_& m) {
  m.def("read_cloud", &read);
  m.def("write_cloud", &write);
  m.def("build_cloud", &build);
}

}  // namespace odosplat::python
