// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/calibrate/calibrate_camera.hpp"

#include <algorithm>
#include <cmath>

#include "apps/cli/calibrate/map_depth.hpp"
#include "apps/cli/check/check_camera.hpp"
#include "apps/command/no_result.hpp"
#include "apps/input/fit_input.hpp"
#include "odosplat/camera/combine_lens.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat::apps {
namespace {

CameraFitOptions options_of(const CalibrationRequest& request, const Sequence& sequence) {
  const auto wanted = [&](const char* part) {
    return request.what.empty() || std::count(request.what.begin(), request.what.end(), part) > 0;
  };
  const bool timed = sequence.poses_by_time();
  if (!timed && !request.what.empty() && (wanted("time") || wanted("line_time"))) {
    throw InputError("--what", "time and line_time need poses with times, which " + sequence.name() + " has not");
  }
  if (!request.by_depth_images && !request.what.empty() && wanted("depth")) {
    throw InputError("--what", "depth is the scale of depth images: a map and a cloud have that of the poses");
  }
  CameraFitOptions options;
  options.focal = wanted("focal");
  options.center = wanted("center");
  options.distortion = wanted("distortion");
  options.time_offset = timed && wanted("time");
  options.readout = timed && wanted("line_time");
  options.depth_scale = request.by_depth_images && wanted("depth");
  options.pairs = request.pairs;
  return options;
}

void require_input(const CalibrationRequest& request, const Sequence& sequence) {
  std::size_t posed = 0;
  for (std::size_t i = 0; i < sequence.size(); ++i) posed += sequence.T_world_camera(i) ? 1 : 0;
  if (posed == 0) throw InputError(sequence.name(), "no image has a pose: they are needed to calibrate its camera");
  if (!request.by_depth_images) return;
  if (frames_with_depth(sequence).empty()) throw InputError(sequence.name(), "has no depth: give --map or --cloud");
  const RegistrationReport registration = depth_registration(sequence);
  if (registration.registered == false) {
    throw NoResult(sequence.name() + ": " + registration.text + "; a map or a cloud will do instead of depth images");
  }
}

/// What of the fit is significant; the rest stays as declared, to the bit.
CameraState significant(const CameraFit& fit, const Camera& declared) {
  constexpr double least_sigmas = 2.0;
  CameraState::Vector state = fit.state.vector();
  for (int k = 0; k < CameraState::size; ++k) {
    if (std::abs(state[k]) <= least_sigmas * fit.sigma[k]) state[k] = 0.0;
  }
  // What has changed is written as a rolling shutter only if that is sure: tracking with the motion of the rows costs
  // time.
  constexpr double sure_sigmas = 4.0;
  constexpr double least_readout = 0.005;  // [s]
  double& readout = state[CameraState::at_readout];
  const double enough = std::max(least_readout, sure_sigmas * fit.sigma[CameraState::at_readout]);
  if (readout != 0.0 && std::abs(declared.readout + readout) < enough) readout = -declared.readout;
  return CameraState::from(state);
}

CameraFile calibrated(const Sequence& sequence, const CameraState& state) {
  CameraFile file = sequence.declared_camera();
  try {
    const Lens lens = combined_lens({file.camera, file.distortion}, sequence.camera(), state.camera);
    file.camera = lens.camera;
    file.distortion = lens.distortion;
  } catch (const InputError& e) {
    throw NoResult(sequence.name() + ": " + e.what() + "; --what focal,time leaves principal point and distortion");
  }
  file.camera.readout += state.camera.readout;
  if (state.depth_factor != 0.0) file.depth_scale /= std::exp(state.depth_factor);
  if (state.time_offset == 0.0) return file;
  const double offset = file.time_offset + state.time_offset;
  const std::size_t before = sequence.posed_with_offset(file.time_offset);
  const std::size_t after = sequence.posed_with_offset(offset);
  if (10 * after >= 9 * before) {
    file.time_offset = offset;
  } else {
    log_warning(sequence.name() + formatted(": the time offset of %.1f ms is not written: with it %zu of %zu images "
                                            "would have no pose, as the poses are too far apart in time",
                                            1000.0 * offset, before - after, before));
  }
  return file;
}

void warn(const Sequence& sequence, const CameraFit& fit) {
  if (fit.error_poses_px > 1.1 * fit.error_before_px) {
    log_warning(sequence.name() +
                formatted(": the poses fit the camera as declared (to %.2f px) better than the one found (%.2f px): "
                          "they were estimated with it, and would have to be estimated anew",
                          fit.error_before_px, fit.error_poses_px));
  }
}

}  // namespace

CameraFit measure_calibration(const Sequence& sequence, const CalibrationRequest& request,
                              const std::function<MapView&()>& map, const std::function<void(double)>& progress) {
  const CameraFitOptions options = options_of(request, sequence);
  require_input(request, sequence);
  CameraFitInput input = camera_fit_input(sequence);
  if (!request.by_depth_images) take_depth_of_map(input, map());
  input.progress = progress;
  CameraFit fit = fit_camera(input, sequence.camera(), options);
  if (!fit.measured) throw NoResult(sequence.name() + ": the camera is not measured: " + fit.reason);
  return fit;
}

CameraFile calibrated_camera(const Sequence& sequence, const CameraFit& fit) {
  constexpr double largest_error_px = 1.0;  // median distance of patches with camera and poses corrected
  if (fit.error_after_px > largest_error_px) {
    throw NoResult(sequence.name() + formatted(": with no camera do images, depth and poses agree (to %.1f px): "
                                               "`odosplat check` may name the cause",
                                               fit.error_after_px));
  }
  CameraFile file = calibrated(sequence, significant(fit, sequence.camera()));
  warn(sequence, fit);
  return file;
}

}  // namespace odosplat::apps
