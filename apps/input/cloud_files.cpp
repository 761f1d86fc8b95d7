// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/cloud_files.hpp"

#include <cmath>

#include "apps/command/interrupt.hpp"
#include "apps/command/support.hpp"
#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/cloud/cloud_thinner.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/cloud/cloud_scan.hpp"

namespace odosplat::apps {

PointCloud read_thinned(const std::vector<std::string>& files, double voxel, const Eigen::Vector3d& origin) {
  constexpr double report_every = 2.0;  // [s]
  CloudThinner thinner(voxel, origin);
  std::string names;
  Stopwatch since_report;
  for (const std::string& file : files) {
    scan_cloud(file, [&](const CloudBatch& batch) {
      if (interrupted()) throw Interrupted();
      thinner.add(batch);
      if (since_report.seconds() < report_every) return;
      log_info(file + ": " + std::to_string(thinner.points()) + " points read");
      since_report = Stopwatch();
    });
    names += (names.empty() ? "" : ", ") + file;
  }
  PointCloud cloud = thinner.finish(names);
  if (cloud.size() == 0) throw InputError(names, "holds no point");
  log_info(std::to_string(thinner.points()) + " points thinned to " + std::to_string(cloud.size()));
  return cloud;
}

PointCloud read_cloud(const std::string& file, double voxel, bool drop_outliers) {
  require(voxel >= 0.0 && std::isfinite(voxel), "voxel", "finite, at least 0 [m]");
  const PointCloud cloud = voxel > 0.0 ? read_thinned({file}, voxel, Eigen::Vector3d::Zero()) : read_point_cloud(file);
  return drop_outliers ? without_outliers(cloud) : cloud;
}

PointCloud without_outliers(const PointCloud& cloud) {
  PointCloud kept = remove_outliers(cloud);
  log_info(std::to_string(cloud.size() - kept.size()) + " of " + std::to_string(cloud.size()) +
           " points are outliers and dropped");
  return kept;
}

}  // namespace odosplat::apps
