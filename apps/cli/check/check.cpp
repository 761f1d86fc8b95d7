// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "apps/cli/check/check_camera.hpp"
#include "apps/cli/check/check_report.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/checksum.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/eval/convention_check.hpp"
#include "odosplat/eval/texture.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

struct CheckFlags {
  SequenceFlags sequence;
  ConventionOptions conventions;
  std::string cloud;
  double voxel = 0.0;
  std::string json;
  bool keep_going = false;
};

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

CloudCheckReport check_with_cloud(const Sequence& sequence, const CheckFlags& flags) {
  CloudCheckInput input;
  input.camera = sequence.camera();
  input.fy_sign = sequence.fy_sign();
  for (std::size_t i = 0; i < sequence.size(); ++i) input.T_world_camera.push_back(sequence.T_world_camera(i));
  input.gray = [&](std::size_t i) {
    if (interrupted()) throw Interrupted();
    return sequence.gray(i);
  };
  input.cloud = read_cloud(flags.cloud, flags.voxel, false);
  Progress progress("check", 100);
  input.progress = [&](double share) { progress.update(std::lround(100.0 * share)); };
  CloudCheckReport report = check_cloud(input);
  progress.finish();
  return report;
}

/// Texture of up to 100 images, evenly spaced over the sequence and resized to the size at which shares are compared.
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

/// Checksum of every file that the sequence lists and of its true poses as read.
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

/// Measures the camera where poses and fy are as declared and depth is of the colour camera: through depth of another one
/// the images would ask for a wrong focal length. A wrong camera can look like images that are numbered by one from
/// their poses: if it is found wrong, the conventions are judged with the one that the images ask for.
void check_camera_by_depth(const Sequence& sequence, const std::vector<std::size_t>& frames, const CheckFlags& flags,
                           CheckResults& results) {
  const ConventionReport& given = *results.conventions;
  const bool posed = given.believable && given.winner.fy_sign == given.declared.fy_sign &&
                     given.winner.inverted == given.declared.inverted &&
                     given.winner.depth_scale == given.declared.depth_scale;
  if (!posed || results.registration->registered == false) return;
  // Poses of data with a negative fy are reflected, as other commands read them.
  SequenceFlags as_read = flags.sequence;
  as_read.options.as_stored = false;
  results.camera = measure_camera(sequence.fy_sign() < 0 ? open_sequence(as_read) : sequence);
  if (given.as_declared || !results.camera->measured) return;
  const bool wrong = std::any_of(results.camera->findings.begin(), results.camera->findings.end(),
                                 [](const CameraFinding& f) { return f.right == false && f.part != "time offset"; });
  if (!wrong) return;
  const ConventionReport again =
      check_depth(sequence, results.camera->state.corrected(sequence.camera()), frames, flags.conventions);
  if (!again.as_declared) return;
  results.conventions = again;
  results.with_measured_camera = true;
}

void print_depth(const Sequence& sequence, const CheckResults& results) {
  const ConventionReport& report = *results.conventions;
  const std::string gap =
      std::to_string(report.gap) + (report.max_gap > report.gap ? " to " + std::to_string(report.max_gap) : "");
  print("depth of one image reprojected into another %s frames on, %d pairs%s%s\n", gap.c_str(), report.pairs,
        report.gap_reduced ? " (too little overlaps farther apart)" : "",
        results.with_measured_camera ? ", with the camera that the images ask for" : "");
  print("%s", convention_table(report, sequence.camera()).c_str());
  print("%s\n", report.verdict.c_str());
  print("%s\n", results.registration->text.c_str());
  if (!results.camera) return;
  print("%s%s\n", camera_table(*results.camera, sequence.camera()).c_str(), camera_verdict(*results.camera).c_str());
}

void print_cloud(const Sequence& sequence, const CloudCheckReport& report) {
  print("patches of one image carried by the cloud into another %d frames on, %d pairs; 0: alike, 1: no relation\n",
        report.gap, report.pairs);
  if (report.unit != 1.0) print("the cloud is taken times %.4g\n", 1.0 / report.unit);
  print("%s", cloud_table(report, sequence.camera()).c_str());
  if (report.fit) {
    const CloudFit& fit = *report.fit;
    print(
        "measured by %d patches: cloud %.4f +- %.4f times too large, off by %.3f +- %.3f m, turned by %.2f +- %.2f "
        "deg, fx %.1f +- %.1f px; patches lie %.2f px aside as declared, %.2f px with all of these\n",
        fit.patches, 1.0 / fit.scale.value, fit.scale.sigma / (fit.scale.value * fit.scale.value), fit.offset_m.value,
        fit.offset_m.sigma, fit.turn_deg.value, fit.turn_deg.sigma, fit.focal_px.value, fit.focal_px.sigma,
        fit.error_before_px, fit.error_after_px);
  }
  print("%s\n", report.verdict.c_str());
}

void run(CheckFlags flags) {
  const MadeFolders made = ensure_output_if_given(flags.json);
  flags.sequence.options.as_stored = true;
  const Sequence sequence = open_sequence(flags.sequence);
  const std::vector<std::size_t> frames = frames_with_depth(sequence);
  if (frames.empty() && flags.cloud.empty()) {
    throw InputError(sequence.name(), "has no depth: nothing to check the conventions by; a cloud will do (--cloud)");
  }
  print("%s: layout %s, %zu images, %zu with depth, %dx%d\n", sequence.name().c_str(), sequence.layout().c_str(),
        sequence.size(), frames.size(), sequence.camera().width, sequence.camera().height);
  CheckResults results;
  if (!frames.empty()) {
    results.conventions = check_depth(sequence, sequence.camera(), frames, flags.conventions);
    results.registration = depth_registration(sequence);
    check_camera_by_depth(sequence, frames, flags, results);
    print_depth(sequence, results);
  }
  if (!flags.cloud.empty()) {
    results.cloud = check_with_cloud(sequence, flags);
    print_cloud(sequence, *results.cloud);
  }
  results.texture = texture_of(sequence);
  const TextureSummary& texture = results.texture;
  print(
      "texture at 320x240: %.1f %% of pixels with a gradient over 8; blocks of 32x32: tenth %.1f, median %.1f, "
      "ninth tenth %.1f %%, %.1f %% of them bare (%d images)\n",
      100.0 * texture.share, 100.0 * texture.block_p10, 100.0 * texture.block_p50, 100.0 * texture.block_p90,
      100.0 * texture.bare_blocks, texture.images);
  if (!flags.json.empty()) {
    write_file_atomically(flags.json, check_json(sequence, results, checksum_of(sequence)));
  }
  const CheckAnswer answer = answer_of(results);
  if (answer == CheckAnswer::agree || flags.keep_going) return;
  throw NoResult(sequence.name() + (answer == CheckAnswer::differ
                                        ? ": the data do not agree with what their files say (the verdict is above)"
                                        : ": the data are not shown to agree (the verdict is above)"));
}

}  // namespace

void add_check(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "check",
                  "prove by the images what camera, poses, numbering, times, depth scale and cloud mean; "
                  "ends with 0 if the data agree with their files, with 3 if they do not or do not tell");
  auto flags = std::make_shared<CheckFlags>();
  add_sequence_flags(command, flags->sequence);
  CLI::Option* cloud = command->add_option(
      "--cloud", flags->cloud,
      std::string(cloud_formats) + ": checks images, poses and cloud against one another, no depth needed");
  add_number(command, "--voxel", flags->voxel, {.least = 0.0, .most = 1000.0, .word = "off"},
             "thin the cloud to one point per voxel of this edge [m]; 0 or off: as it is")
      ->needs(cloud);
  add_number(command, "--gap", flags->conventions.gap, {.least = 1},
             "frames between the two images of a pair with depth");
  add_number(command, "--pairs", flags->conventions.pairs, {.least = 1, .most = 100000}, "pairs of images with depth");
  command->add_option("--json", flags->json, "file to write verdict, findings and a checksum of the data to");
  command->add_flag("--keep-going", flags->keep_going,
                    "end with 0 whatever is found: for scripts that read the verdict");
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
