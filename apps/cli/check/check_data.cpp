// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/check/check_data.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "apps/cli/check/check_camera.hpp"
#include "apps/command/interrupt.hpp"
#include "odosplat/core/checksum.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

ConventionReport check_depth(const Sequence& sequence, const Camera& camera, const std::vector<std::size_t>& frames,
                             const ConventionOptions& options) {
  ConventionInput input;
  input.camera = camera;
  input.fy_sign = sequence.fy_sign();
  input.depth_scale = sequence.depth_scale();
  for (const std::size_t i : frames) input.T_world_camera.push_back(sequence.T_world_depth(i));
  input.depth = [&](std::size_t k) {
    if (interrupted()) throw Interrupted();
    return sequence.depth(frames[k]);
  };
  return check_conventions(input, options);
}

/// Measures the camera where poses and fy are as declared and depth is of the colour camera: through depth of another one
/// the images would ask for a wrong focal length. A wrong camera can look like images that are numbered by one from
/// their poses: if it is found wrong, the conventions are judged with the one that the images ask for.
void check_camera_by_depth(const Sequence& sequence, const std::vector<std::size_t>& frames, const SequenceFlags& flags,
                           const ConventionOptions& options, CheckResults& results) {
  const ConventionReport& given = *results.conventions;
  const bool posed = given.believable && given.winner.fy_sign == given.declared.fy_sign &&
                     given.winner.inverted == given.declared.inverted &&
                     given.winner.depth_scale == given.declared.depth_scale;
  if (!posed || results.registration->registered == false) return;
  // Poses of data with a negative fy are reflected, as other commands read them.
  SequenceFlags as_read = flags;
  as_read.options.as_stored = false;
  results.camera = measure_camera(sequence.fy_sign() < 0 ? Sequence::open(as_read.path, as_read.options) : sequence);
  if (given.as_declared || !results.camera->measured) return;
  const bool wrong = std::any_of(results.camera->findings.begin(), results.camera->findings.end(),
                                 [](const CameraFinding& f) { return f.right == false && f.part != "time offset"; });
  if (!wrong) return;
  const ConventionReport again =
      check_depth(sequence, results.camera->state.corrected(sequence.camera()), frames, options);
  if (!again.as_declared) return;
  results.conventions = again;
  results.with_measured_camera = true;
}

}  // namespace

void check_by_depth(const Sequence& sequence, const SequenceFlags& flags, const ConventionOptions& options,
                    CheckResults& results) {
  const std::vector<std::size_t> frames = frames_with_depth(sequence);
  results.conventions = check_depth(sequence, sequence.camera(), frames, options);
  results.registration = depth_registration(sequence);
  check_camera_by_depth(sequence, frames, flags, options, results);
}

CloudCheckReport check_by_cloud(const Sequence& sequence, PointCloud cloud) {
  CloudCheckInput input;
  input.camera = sequence.camera();
  input.fy_sign = sequence.fy_sign();
  for (std::size_t i = 0; i < sequence.size(); ++i) input.T_world_camera.push_back(sequence.T_world_camera(i));
  input.gray = [&](std::size_t i) {
    if (interrupted()) throw Interrupted();
    return sequence.gray(i);
  };
  input.cloud = std::move(cloud);
  Progress progress("check", 100);
  input.progress = [&](double share) { progress.update(std::lround(100.0 * share)); };
  CloudCheckReport report = check_cloud(input);
  progress.finish();
  return report;
}

TextureSummary texture_of(const Sequence& sequence) {
  constexpr std::size_t most = 100;
  const cv::Size size(320, 240);
  const std::size_t step = std::max<std::size_t>(1, sequence.size() / most);
  std::vector<TextureStatistic> statistics;
  for (std::size_t i = 0; i < sequence.size(); i += step) {
    if (interrupted()) throw Interrupted();
    GrayImage gray = sequence.gray(i);
    if (gray.size() != size) cv::resize(gray, gray, size, 0.0, 0.0, cv::INTER_AREA);
    statistics.push_back(texture_statistic(gray));
  }
  return summarise_texture(statistics);
}

std::string checksum_of(const Sequence& sequence) {
  Checksum sum;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (interrupted()) throw Interrupted();
    for (const std::string& file : {sequence.color_file(i), sequence.depth_file(i)}) {
      if (!file.empty()) sum.add(read_file(file, max_data_bytes));
    }
  }
  for (const StampedPose& pose : sequence.truth()) {
    const Eigen::Vector3d t = pose.T_world_camera.translation();
    const Eigen::Vector3d r = so3_log(pose.T_world_camera.rotation());
    sum.add(formatted("%.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", pose.time, t.x(), t.y(), t.z(), r.x(), r.y(), r.z()));
  }
  return sum.text();
}

}  // namespace odosplat::apps
