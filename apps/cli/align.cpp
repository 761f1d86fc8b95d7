// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <numbers>

#include "apps/command/interrupt.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/cloud/sim3_icp.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/sequence/moved_sequence.hpp"
#include "odosplat/io/trajectory/similarity_file.hpp"

namespace odosplat::apps {
namespace {

struct AlignFlags {
  SequenceFlags poses;
  std::string cloud;
  std::string points;
  std::string guess;
  std::string pairs;
  std::string out;
  Sim3IcpOptions icp;
};

Similarity first_guess(const AlignFlags& flags) {
  if (!flags.guess.empty()) return parse_similarity("--guess", flags.guess);
  if (flags.pairs.empty()) return {};
  const PointPairs pairs = parse_point_pairs(flags.pairs, read_file(flags.pairs));
  try {
    return align_points(pairs.source, pairs.target, true);
  } catch (const InputError& e) {
    throw InputError(flags.pairs, e.what());
  }
}

PointCloud points_of(const AlignFlags& flags, const Sequence& sequence) {
  if (!flags.points.empty()) return read_point_cloud(flags.points);
  if (!sequence.has_sparse_points()) {
    throw InputError(flags.poses.path, "has no sparse points to align by; give --points, a cloud in the poses' frame");
  }
  return sequence.sparse_points();
}

void print_result(const AlignFlags& flags, const Sim3IcpResult& r, std::size_t frames) {
  const Similarity& S = r.cloud_from_points;
  print("scale %.6f, turned by %.3f deg, moved by %.4f m\n", S.scale,
        S.T_target_source.angle() * 180.0 / std::numbers::pi, S.T_target_source.translation().norm());
  print("transform (s tx ty tz qx qy qz qw) %s\n", similarity_text(S).c_str());
  print("%d of %d points (%.1f %%) within %g m of the cloud: median %.4f m, RMSE %.4f m, %d iterations\n", r.inliers,
        r.points, 100.0 * r.inlier_share, flags.icp.inlier, r.median_m, r.rmse_m, r.iterations);
  print("%s: %zu posed images in the cloud's frame\n", flags.out.c_str(), frames);
}

void run(const AlignFlags& flags) {
  const MadeFolders made = ensure_output_folder(flags.out);
  const Similarity guess = first_guess(flags);
  const Sequence sequence = open_sequence(flags.poses);
  posed_frames(sequence, 1);
  const PointCloud points = points_of(flags, sequence);
  const PointCloud cloud = read_point_cloud(flags.cloud);
  log_info("aligning " + std::to_string(points.size()) + " points with " + std::to_string(cloud.size()) +
           " of the cloud");
  const Sim3IcpResult result = align_to_cloud(points.points, cloud, guess, flags.icp);
  if (interrupted()) throw Interrupted();
  if (!result.fault.empty()) throw InputError(flags.poses.path, "cannot be aligned with " + flags.cloud, result.fault);
  write_file_atomically(flags.out + "/transform.txt",
                        "# s tx ty tz qx qy qz qw: p_cloud = s * (R(q) * p_poses) + t  [m]\n" +
                            similarity_text(result.cloud_from_points) + "\n");
  const std::size_t frames = write_moved_sequence(flags.out, sequence, result.cloud_from_points);
  print_result(flags, result, frames);
}

constexpr const char* footer =
    "Sparse points of the poses' frame (COLMAP's points3D, the ply_file_path of a transforms.json, or --points) are "
    "laid "
    "on the cloud by scale, rotation and translation, starting from --guess, from --pairs or, without both, from where "
    "they are. About 20 cm, 10 degrees and 10 % of scale are near enough in a room. A result that cannot be trusted is "
    "refused.\n"
    "\n"
    "--out gets a sequence for train, track and eval: groundtruth.txt in the cloud's frame, rgb.txt with the posed "
    "images "
    "by absolute path, camera.yaml with the lens distortion; and transform.txt. Depth images, if the sequence has any, "
    "are taken to be in the unit of its poses and are scaled with them: depth.txt names them, camera.yaml's "
    "depth_scale "
    "is divided by the scale. Where depth is in metres already and the poses are not, delete depth.txt.";

}  // namespace

void add_align(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "align", "bring posed images of another frame and scale to a cloud");
  auto flags = std::make_shared<AlignFlags>();
  command->add_option("--poses", flags->poses.path, "sequence with poses: a COLMAP model, a transforms.json, ...")
      ->required();
  add_layout_flags(command, flags->poses);
  command->add_option("--cloud", flags->cloud, "point cloud of the place [m] (PLY)")->required();
  command->add_option("--points", flags->points, "points in the poses' frame (PLY), instead of the sequence's own");
  CLI::Option* guess = command->add_option("--guess", flags->guess,
                                           "\"s tx ty tz qx qy qz qw\": p_cloud = s * R(q) * p_poses + t, roughly");
  command
      ->add_option("--pairs", flags->pairs,
                   "file of three or more places in both frames, \"x y z X Y Z\" a line, poses' frame first")
      ->excludes(guess);
  command->add_option("--out", flags->out, "folder for the sequence in the cloud's frame and transform.txt")
      ->required();
  const Bounds<double> length{.least = 0.0, .most = 10000.0, .least_excluded = true};
  add_number(command, "--radius", flags->icp.radius, length, "how far off the points may be at the start [m]");
  add_number(command, "--inlier", flags->icp.inlier, length,
             "distance from the cloud up to which a point lies on it [m]");
  add_number(command, "--min-inliers", flags->icp.min_inliers, {.least = 0.0, .most = 1.0},
             "share of such points below which the result is refused");
  add_number(command, "--max-change", flags->icp.max_change, {.least = 1.0, .most = 1000.0, .least_excluded = true},
             "factor by which the scale may leave the guess");
  command->footer(footer);
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
