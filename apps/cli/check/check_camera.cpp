// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/check/check_camera.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/command/interrupt.hpp"
#include "apps/input/fit_input.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/progress.hpp"

namespace odosplat::apps {
namespace {

/// "cx 319.50 +- 0.20 px", "cx as declared", "cx not determined".
std::string value_text(const CameraFit& fit, int place, const char* name, const Measured& value, int decimals,
                       const char* unit) {
  switch (fit.estimated[static_cast<std::size_t>(place)]) {
    case Estimated::held:
      return formatted("%s as declared", name);
    case Estimated::open:
      return formatted("%s not determined", name);
    case Estimated::yes:
      break;
  }
  return formatted("%s %.*f +- %.*f%s", name, decimals, value.value, decimals, value.sigma, unit);
}

nlohmann::ordered_json value_json(const CameraFit& fit, int place, double value, double sigma) {
  if (fit.estimated[static_cast<std::size_t>(place)] != Estimated::yes) return nullptr;
  return {{"value", value}, {"sigma", sigma}};
}

}  // namespace

std::vector<std::size_t> frames_with_depth(const Sequence& sequence) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (sequence.has_depth(i)) frames.push_back(i);
  }
  return frames;
}

RegistrationReport depth_registration(const Sequence& sequence) {
  const std::vector<std::size_t> frames = frames_with_depth(sequence);
  RegistrationInput input;
  input.camera = sequence.camera();
  input.images = frames.size();
  input.gray = [&](std::size_t k) {
    if (interrupted()) throw Interrupted();
    return sequence.gray(frames[k]);
  };
  input.depth = [&](std::size_t k) { return sequence.depth(frames[k]); };
  return check_registration(input);
}

CameraFit measure_camera(const Sequence& sequence) {
  CameraFitInput input = camera_fit_input(sequence);
  CameraFitOptions options;
  options.time_offset = sequence.poses_by_time();
  options.readout = sequence.poses_by_time();
  Progress progress("camera", 100);
  input.progress = [&](double share) { progress.update(std::lround(100.0 * share)); };
  CameraFit fit = fit_camera(input, sequence.camera(), options);
  progress.finish();
  return fit;
}

std::string camera_table(const CameraFit& fit, const Camera& camera) {
  if (!fit.measured) return "";
  using State = CameraState;
  const Measured readout{1000.0 * fit.readout_s(camera).value, 1000.0 * fit.readout_s(camera).sigma};
  const Measured offset{1000.0 * fit.state.time_offset, 1000.0 * fit.sigma[State::at_time_offset]};
  return formatted("camera by %d measured distances of patches in %d pairs of images: ", fit.distances, fit.pairs) +
         value_text(fit, State::at_focal, "fx", fit.focal_px(camera), 2, " px") + ", " +
         value_text(fit, State::at_center_u, "cx", fit.center_u_px(camera), 2, " px") + ", " +
         value_text(fit, State::at_center_v, "cy", fit.center_v_px(camera), 2, " px") + ", " +
         value_text(fit, State::at_radial, "distortion in the corners", fit.corner_shift_px(camera), 2, " px") + ", " +
         value_text(fit, State::at_readout, "readout", readout, 1, " ms") + ", " +
         value_text(fit, State::at_time_offset, "images after poses", offset, 1, " ms") + ", " +
         value_text(fit, State::at_depth_factor, "depth times", fit.depth_factor(), 4, "") +
         formatted(
             "\npatches lie %.2f px aside as declared, %.2f px with that camera, %.2f px with the poses corrected too; "
             "two images' relative pose is off by %.1f mm, %.2f deg\n",
             fit.error_before_px, fit.error_poses_px, fit.error_after_px, 1000.0 * fit.pose_error_m,
             fit.pose_error_deg);
}

std::string camera_verdict(const CameraFit& fit) {
  if (!fit.measured) return "camera: not measured, " + fit.reason;
  std::string wrong;
  std::string open;
  for (const CameraFinding& f : fit.findings) {
    if (f.right == false) wrong += (wrong.empty() ? "" : "; ") + f.text;
    if (!f.right) open += (open.empty() ? "" : ", ") + f.part;
  }
  return (wrong.empty() ? "the camera is as declared" : wrong) +
         (open.empty() ? "" : "; not determined by the images: " + open);
}

nlohmann::ordered_json camera_fit_json(const CameraFit& fit, const Camera& camera) {
  using State = CameraState;
  const Measured focal = fit.focal_px(camera);
  const Measured u = fit.center_u_px(camera);
  const Measured v = fit.center_v_px(camera);
  const Measured factor = fit.depth_factor();
  const Measured readout = fit.readout_s(camera);
  return {{"pairs", fit.pairs},
          {"distances", fit.distances},
          {"fx_px", value_json(fit, State::at_focal, focal.value, focal.sigma)},
          {"cx_px", value_json(fit, State::at_center_u, u.value, u.sigma)},
          {"cy_px", value_json(fit, State::at_center_v, v.value, v.sigma)},
          {"radial", value_json(fit, State::at_radial, fit.state.camera.radial, fit.sigma[State::at_radial])},
          {"readout_s", value_json(fit, State::at_readout, readout.value, readout.sigma)},
          {"time_offset_s",
           value_json(fit, State::at_time_offset, fit.state.time_offset, fit.sigma[State::at_time_offset])},
          {"depth_factor", value_json(fit, State::at_depth_factor, factor.value, factor.sigma)},
          {"pose_error_m", fit.pose_error_m},
          {"pose_error_deg", fit.pose_error_deg},
          {"error_px", fit.error_before_px},
          {"error_with_camera_px", fit.error_poses_px},
          {"error_with_camera_and_poses_px", fit.error_after_px}};
}

}  // namespace odosplat::apps
