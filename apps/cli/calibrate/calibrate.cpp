// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/cli/calibrate/calibrate_report.hpp"
#include "apps/cli/calibrate/map_depth.hpp"
#include "apps/cli/check/check_camera.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/fit_input.hpp"
#include "apps/input/map_views.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/camera/combine_lens.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_check.hpp"
#include "odosplat/io/camera/camera_file.hpp"

namespace odosplat::apps {
namespace {

const std::vector<std::string> all_parts{"focal", "center", "distortion", "time", "line_time", "depth"};

struct CalibrateFlags {
  SequenceFlags sequence;
  MapFlags map;
  std::vector<std::string> what;  // empty: all
  int pairs = CameraFitOptions().pairs;
  std::string out;
  std::string json;

  bool by_depth_images() const { return map.map.empty() && map.cloud.empty(); }
};

CameraFitOptions options_of(const CalibrateFlags& flags, const Sequence& sequence) {
  const auto wanted = [&](const char* part) {
    return flags.what.empty() || std::count(flags.what.begin(), flags.what.end(), part) > 0;
  };
  const bool timed = sequence.poses_by_time();
  if (!timed && !flags.what.empty() && (wanted("time") || wanted("line_time"))) {
    throw InputError("--what", "time and line_time need poses with times, which " + sequence.name() + " has not");
  }
  if (!flags.by_depth_images() && !flags.what.empty() && wanted("depth")) {
    throw InputError("--what", "depth is the scale of depth images: a map and a cloud have that of the poses");
  }
  CameraFitOptions options;
  options.focal = wanted("focal");
  options.center = wanted("center");
  options.distortion = wanted("distortion");
  options.time_offset = timed && wanted("time");
  options.readout = timed && wanted("line_time");
  options.depth_scale = flags.by_depth_images() && wanted("depth");
  options.pairs = flags.pairs;
  return options;
}

void require_input(const CalibrateFlags& flags, const Sequence& sequence) {
  std::size_t posed = 0;
  for (std::size_t i = 0; i < sequence.size(); ++i) posed += sequence.T_world_camera(i) ? 1 : 0;
  if (posed == 0) throw InputError(sequence.name(), "no image has a pose: they are needed to calibrate its camera");
  if (!flags.by_depth_images()) return;
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
  // A camera that is said to take all rows at once becomes one with a rolling shutter only if that is sure: tracking
  // with the motion of its rows costs time.
  constexpr double sure_sigmas = 4.0;
  constexpr double least_readout = 0.005;  // [s]
  double& readout = state[CameraState::at_readout];
  const double enough = std::max(least_readout, sure_sigmas * fit.sigma[CameraState::at_readout]);
  if (declared.readout == 0.0 && std::abs(readout) < enough) readout = 0.0;
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

void run(const Common& common, const CalibrateFlags& flags) {
  constexpr double largest_error_px = 1.0;  // median distance of patches with camera and poses corrected
  if (flags.json == flags.out) throw InputError("--json", "is the file of --out");
  const MadeFolders made = ensure_output_file(flags.out);
  const MadeFolders made_json = ensure_output_if_given(flags.json);
  const Sequence sequence = open_sequence(flags.sequence);
  const CameraFitOptions options = options_of(flags, sequence);
  require_input(flags, sequence);
  CameraFitInput input = camera_fit_input(sequence);
  OpenedView opened;
  if (!flags.by_depth_images()) {
    opened = open_view(common, flags.map.map.empty() ? "interpolation" : "gaussian", flags.map);
    take_depth_of_map(input, *opened.view);
  }
  Progress progress("calibrate", 100);
  input.progress = [&](double share) { progress.update(std::lround(100.0 * share)); };
  const CameraFit fit = fit_camera(input, sequence.camera(), options);
  progress.finish();
  if (!fit.measured) throw NoResult(sequence.name() + ": the camera is not measured: " + fit.reason);
  print("%s", camera_table(fit, sequence.camera()).c_str());
  if (fit.error_after_px > largest_error_px) {
    throw NoResult(sequence.name() + formatted(": with no camera do images, depth and poses agree (to %.1f px): "
                                               "`odosplat check` may name the cause",
                                               fit.error_after_px));
  }
  const CameraFile file = calibrated(sequence, significant(fit, sequence.camera()));
  check_camera(flags.out, file);
  write_camera_file(flags.out, file);
  if (!flags.json.empty()) write_file_atomically(flags.json, calibration_json(sequence, file, fit));
  warn(sequence, fit);
  print("%s\n%s: fx %.3f fy %.3f cx %.3f cy %.3f px\n", camera_verdict(fit).c_str(), flags.out.c_str(), file.camera.fx,
        file.fy_sign * file.camera.fy, file.camera.cx, file.camera.cy);
}

}  // namespace

void add_calibrate(CLI::App& app, Common& common) {
  CLI::App* command = add_command(
      app, common, "calibrate",
      "the camera that images with poses ask for: focal length, principal point, distortion, time offset, from the "
      "motion of patches between images; their depth is that of a map, a cloud, or the sequence's depth images");
  auto flags = std::make_shared<CalibrateFlags>();
  add_sequence_flags(command, flags->sequence);
  CLI::Option* map = command->add_option("--map", flags->map.map, "depth of the patches: from this map of Gaussians");
  command->add_option("--cloud", flags->map.cloud, "depth of the patches: interpolated in this point cloud")
      ->excludes(map);
  command->add_option("--out", flags->out, "camera.yaml to write")->required();
  command
      ->add_option("--what", flags->what,
                   "some of focal,center,distortion,time,line_time,depth; the rest stays as declared. line_time: the "
                   "readout of a rolling shutter; depth: the scale of depth images (default: all)")
      ->delimiter(',')
      ->expected(1)
      ->check(CLI::IsMember(all_parts));
  add_number(command, "--pairs", flags->pairs, {.least = 16, .most = 10000}, "pairs of images");
  command->add_option("--json", flags->json, "file to write values and standard deviations to");
  command->final_callback([&common, flags] { run(common, *flags); });
}

}  // namespace odosplat::apps
