// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/input/sequence_cloud.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/cloud/cloud_builder.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
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

PointCloud cloud_of_flags(const CloudFlags& flags) {
  std::vector<Sequence> sequences;
  for (const std::string& path : flags.sequences) sequences.push_back(open_sequence({path, flags.layout.options}));
  return cloud_of_sequences(sequences, flags.cloud, flags.every,
                            flags.frames.empty() ? FrameRange() : parse_frames(flags.frames));
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
  PointCloud cloud = flags.from.empty() ? cloud_of_flags(flags) : read_thinned(flags.from, flags.cloud.voxel, origin);
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
