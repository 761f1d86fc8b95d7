// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command/interrupt.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/input/sequence_flags.hpp"
#include "apps/input/unreadable_frames.hpp"
#include "odosplat/cloud/cloud_builder.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {
namespace {

struct CloudFlags {
  std::vector<std::string> sequences;  // all in one world frame
  SequenceFlags layout;
  std::vector<std::string> from;
  std::vector<double> origin{0.0, 0.0, 0.0};
  std::string out;
  int every = 10;
  std::string frames;
  bool remove_outliers = false;
  CloudOptions cloud;
};

void add_frames(const Sequence& sequence, const CloudFlags& flags, CloudBuilder& builder) {
  const FrameRange range = flags.frames.empty() ? FrameRange() : parse_frames(flags.frames);
  const std::vector<std::size_t> frames = posed_frames(sequence, flags.every, range);
  Progress progress("cloud " + sequence.name(), static_cast<long>(frames.size()));
  long done = 0;
  UnreadableFrames unreadable;
  for (const std::size_t i : frames) {
    if (interrupted()) throw Interrupted();
    if (sequence.has_depth(i) && sequence.T_world_depth(i)) {
      DepthImage depth;
      ColorImage color;
      try {
        depth = sequence.depth(i);
        color = sequence.color(i);
      } catch (const InputError& e) {
        unreadable.add(e.what());
        depth.release();
      }
      if (!depth.empty()) builder.add(depth, color, sequence.camera(), *sequence.T_world_depth(i));
    }
    progress.update(++done, std::to_string(builder.voxels()) + " points");
  }
  progress.finish();
  unreadable.report(frames.size());
}

PointCloud cloud_of_sequences(const CloudFlags& flags) {
  CloudBuilder builder(flags.cloud);
  for (const std::string& path : flags.sequences)
    add_frames(open_sequence({path, flags.layout.options}), flags, builder);
  PointCloud cloud = builder.finish();
  if (cloud.size() == 0) throw InputError(flags.sequences[0], "no frame has both a pose and depth");
  return cloud;
}

std::vector<std::string> notes_of(const Eigen::Vector3d& origin) {
  if (origin.isZero(0.0)) return {};
  return {formatted("origin taken off %.15g %.15g %.15g", origin.x(), origin.y(), origin.z())};
}

void run(const CloudFlags& flags) {
  if (flags.sequences.empty() && flags.from.empty()) throw InputError("SEQ", "or --from is needed");
  check_extension(flags.out, {".ply"});
  const MadeFolders made = ensure_output_file(flags.out);
  const Eigen::Vector3d origin(flags.origin[0], flags.origin[1], flags.origin[2]);
  PointCloud cloud =
      flags.from.empty() ? cloud_of_sequences(flags) : read_thinned(flags.from, flags.cloud.voxel, origin);
  if (flags.remove_outliers) cloud = without_outliers(cloud);
  write_point_cloud(flags.out, cloud, notes_of(origin));
  print("%s: %zu points\n", flags.out.c_str(), cloud.size());
}

}  // namespace

void add_cloud(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "cloud",
                                  "make a point cloud from sequences' depth and true poses, or from other clouds");
  auto flags = std::make_shared<CloudFlags>();
  CLI::Option* sequence = command->add_option("SEQ", flags->sequences, "sequences in one world frame");
  add_layout_flags(command, flags->layout);
  CLI::Option* from = command->add_option("--from", flags->from,
                                          std::string(cloud_formats) + " to thin instead; may be given several times");
  from->excludes(sequence)->expected(1)->take_all();
  for (const char* of_sequence : {"--layout", "--camera", "--max-image-pixels"})
    from->excludes(command->get_option(of_sequence));
  command->add_option("--out", flags->out, "cloud to write (PLY)")->required();
  from->excludes(add_number(command, "--every", flags->every, {.least = 1}, "use every Nth frame"));
  from->excludes(command->add_option("--frames", flags->frames, frames_help));
  add_number(command, "--voxel", flags->cloud.voxel, {.least = 0.0, .most = 1000.0, .least_excluded = true},
             "edge of the voxels that keep one point each, their mean [m]");
  add_numbers(command, "--origin", flags->origin, 3, 3, {},
              "X Y Z [m] taken off every point of --from before it is rounded to single precision, to bring survey "
              "coordinates near; take the same off the poses")
      ->needs(from);
  command->add_flag("--remove-outliers", flags->remove_outliers, outliers_help);
  from->excludes(add_number(command, "--noise", flags->cloud.noise, {.least = 0.0, .most = 1000.0},
                            "standard deviation of simulated range noise [m]"));
  from->excludes(add_number(command, "--seed", flags->cloud.seed, {}, "seed of the noise"));
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
