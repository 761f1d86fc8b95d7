// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/check/check_camera.hpp"
#include "apps/cli/check/check_data.hpp"
#include "apps/cli/check/check_report.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/eval/convention_check.hpp"
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
    check_by_depth(sequence, flags.sequence, flags.conventions, results);
    print_depth(sequence, results);
  }
  if (!flags.cloud.empty()) {
    results.cloud = check_by_cloud(sequence, read_cloud(flags.cloud, flags.voxel, false));
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
