// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "benchmark/checksum.hpp"
#include "number_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/eval/convention_check.hpp"
#include "odosplat/eval/texture.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "sequence_flags.hpp"
#include "support.hpp"

namespace odosplat::apps {
namespace {

// Frames with depth, and the poses that the files have for them.
struct DepthFrames {
  std::vector<std::size_t> frames;
  ConventionInput input;
};

DepthFrames depth_frames(const Sequence& sequence) {
  DepthFrames found;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (!sequence.has_depth(i)) continue;
    found.frames.push_back(i);
    found.input.T_world_camera.push_back(sequence.T_world_depth(i));
  }
  if (found.frames.empty()) throw InputError(sequence.name(), "has no depth: nothing to check the conventions by");
  found.input.camera = sequence.camera();
  found.input.fy_sign = sequence.fy_sign();
  found.input.depth_scale = sequence.depth_scale();
  return found;
}

/// Of up to 100 images, evenly over the sequence, brought to the size at which shares are compared.
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

/// Of every file that the sequence lists, and of its true poses as read.
std::string checksum_of(const Sequence& sequence) {
  Checksum sum;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (interrupted()) throw Interrupted();
    for (const std::string& file : {sequence.color_file(i), sequence.depth_file(i)}) {
      if (!file.empty()) sum.add(read_file(file));
    }
  }
  for (const StampedPose& pose : sequence.truth()) {
    char line[200];
    const Eigen::Vector3d t = pose.T_world_camera.translation();
    const Eigen::Vector3d r = so3_log(pose.T_world_camera.rotation());
    std::snprintf(line, sizeof(line), "%.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", pose.time, t.x(), t.y(), t.z(), r.x(),
                  r.y(), r.z());
    sum.add(line);
  }
  return sum.text();
}

void write_json(const std::string& file, const Sequence& sequence, const ConventionReport& report,
                const TextureSummary& texture) {
  const nlohmann::ordered_json json{{"name", sequence.name()},
                                    {"layout", sequence.layout()},
                                    {"frames", sequence.size()},
                                    {"pairs", report.pairs},
                                    {"verdict", report.verdict},
                                    {"texture_share", texture.share},
                                    {"texture_bare_blocks", texture.bare_blocks},
                                    {"checksum", checksum_of(sequence)}};
  write_file_atomically(file, json.dump(2) + "\n");
}

void run(SequenceFlags flags, const ConventionOptions& options, const std::string& json) {
  if (!json.empty()) ensure_output_file(json);
  flags.options.as_stored = true;
  const Sequence sequence = open_sequence(flags);
  DepthFrames frames = depth_frames(sequence);
  frames.input.depth = [&](std::size_t k) {
    if (interrupted()) throw Interrupted();
    return sequence.depth(frames.frames[k]);
  };
  const ConventionReport report = check_conventions(frames.input, options);
  print("%s: layout %s, %zu images, %zu with depth, %dx%d\n", sequence.name().c_str(), sequence.layout().c_str(),
        sequence.size(), frames.frames.size(), sequence.camera().width, sequence.camera().height);
  const std::string gap =
      std::to_string(report.gap) + (report.max_gap > report.gap ? " to " + std::to_string(report.max_gap) : "");
  print("depth of one image reprojected into another %s frames on, %d pairs\n", gap.c_str(), report.pairs);
  print("%s", convention_table(report, sequence.camera()).c_str());
  print("%s\n", report.verdict.c_str());
  const TextureSummary texture = texture_of(sequence);
  print(
      "texture at 320x240: %.1f %% of pixels with a gradient over 8; blocks of 32x32: tenth %.1f, median %.1f, "
      "ninth tenth %.1f %%, %.1f %% of them bare (%d images)\n",
      100.0 * texture.share, 100.0 * texture.block_p10, 100.0 * texture.block_p50, 100.0 * texture.block_p90,
      100.0 * texture.bare_blocks, texture.images);
  if (!json.empty()) write_json(json, sequence, report, texture);
}

}  // namespace

void add_check(CLI::App& app, Common& common) {
  CLI::App* command = add_command(
      app, common, "check", "prove by reprojection which convention of fy, poses, numbering and depth scale holds");
  auto flags = std::make_shared<SequenceFlags>();
  auto options = std::make_shared<ConventionOptions>();
  add_sequence_flags(command, *flags);
  add_number(command, "--gap", options->gap, {.least = 1}, "frames between the two images of a pair");
  add_number(command, "--pairs", options->pairs, {.least = 1, .most = 100000}, "pairs of images");
  auto json = std::make_shared<std::string>();
  command->add_option("--json", *json, "file to write the verdict and a checksum of the sequence's data to");
  command->final_callback([flags, options, json] { run(*flags, *options, *json); });
}

}  // namespace odosplat::apps
