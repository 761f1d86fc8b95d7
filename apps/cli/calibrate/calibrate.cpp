// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/cli/calibrate/calibrate_camera.hpp"
#include "apps/cli/calibrate/calibrate_report.hpp"
#include "apps/cli/check/check_camera.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/map_views.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/error.hpp"
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

void run(const Common& common, const CalibrateFlags& flags) {
  if (flags.json == flags.out) throw InputError("--json", "is the file of --out");
  const MadeFolders made = ensure_output_file(flags.out);
  const MadeFolders made_json = ensure_output_if_given(flags.json);
  const Sequence sequence = open_sequence(flags.sequence);
  const CalibrationRequest request{flags.what, flags.pairs, flags.by_depth_images()};
  OpenedView opened;
  Progress progress("calibrate", 100);
  const CameraFit fit = measure_calibration(
      sequence, request,
      [&]() -> MapView& {
        opened = open_view(common, flags.map.map.empty() ? "interpolation" : "gaussian", flags.map);
        return *opened.view;
      },
      [&](double share) { progress.update(std::lround(100.0 * share)); });
  progress.finish();
  print("%s", camera_table(fit, sequence.camera()).c_str());
  const CameraFile file = calibrated_camera(sequence, fit);
  check_camera(flags.out, file);
  write_camera_file(flags.out, file);
  if (!flags.json.empty()) write_file_atomically(flags.json, calibration_json(sequence, file, fit));
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
