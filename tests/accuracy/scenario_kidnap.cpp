// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/odometry/relocalise/place_index.hpp"
#include "tests/accuracy/disturb/disturb_image.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

struct KidnapFlags {
  Job job;
  std::string other;  // sequence whose images are inserted; empty: no such run
  std::size_t cut = 60;
  std::size_t black = 150;
  std::size_t hand = 30;
  std::size_t foreign = 10;
  double bar_mm = 20.0;
};

/// A script that is disturbed between two steps.
struct Kidnapping {
  std::string name;
  Script script;
  std::size_t begin = 0;  // first disturbed step
  std::size_t end = 0;    // first step after the disturbance
};

/// Leaves out frames in the middle, so that the camera jumps from one frame to the next.
Kidnapping cut_out(const World& world, std::size_t frames) {
  const std::size_t begin = (world.size() - frames) / 2;
  Kidnapping k{std::to_string(frames) + " frames cut out", in_order(world, 0, begin), begin, begin};
  const Script rest = in_order(world, begin + frames, world.size());
  k.script.insert(k.script.end(), rest.begin(), rest.end());
  return k;
}

/// Replaces the images of frames in the middle.
Kidnapping replaced(const World& world, const std::string& name, std::size_t frames,
                    const std::function<GrayImage(std::size_t n)>& image) {
  const std::size_t begin = (world.size() - frames) / 2;
  Kidnapping k{std::to_string(frames) + " " + name, in_order(world, 0, world.size()), begin, begin + frames};
  for (std::size_t i = begin; i < k.end; ++i) {
    k.script[i].blind = true;
    k.script[i].edit = [image, n = i - begin](const GrayImage&) { return image(n); };
  }
  return k;
}

std::vector<Kidnapping> kidnappings(const World& world, const KidnapFlags& flags) {
  // In short sequences a third of the frames on either side is kept.
  const auto fitting = [&world](std::size_t frames) { return std::min(frames, world.size() / 3); };
  const Camera camera = world.camera();
  std::vector<Kidnapping> all{
      cut_out(world, fitting(flags.cut)),
      replaced(world, "black", fitting(flags.black), [camera](std::size_t) { return uniform_image(camera, 0.0); }),
      replaced(world, "of one colour", fitting(flags.hand),
               [camera](std::size_t) { return uniform_image(camera, 0.4); }),
  };
  if (!flags.other.empty()) {
    const Sequence other = Sequence::open(flags.other);
    const std::size_t frames = std::min(fitting(flags.foreign), other.size());
    all.push_back(replaced(world, "of another place", frames,
                           [camera, other](std::size_t n) { return resized_gray(other.gray(n), camera); }));
  }
  return all;
}

void run_kidnap(const apps::Common& common, const KidnapFlags& flags) {
  Output out(flags.job);
  const World world(flags.job);
  apps::OpenedView opened = apps::open_view(common, flags.job.track.method, flags.job.track.map);
  RecoveryBars bars;
  bars.meters = flags.bar_mm / 1000.0;
  for (const Kidnapping& k : kidnappings(world, flags)) {
    const Run run = play(world, opened, flags.job.track, k.script, k.name);
    out.trace(world, k.name, run);
    const std::size_t size = run.frames.size();
    const int recovered = frames_until_recovered(run, k.end, size, bars);
    const std::size_t back = recovered < 0 ? size : k.end + static_cast<std::size_t>(recovered);
    const auto given = std::count_if(run.frames.begin() + static_cast<std::ptrdiff_t>(k.begin),
                                     run.frames.begin() + static_cast<std::ptrdiff_t>(k.end),
                                     [](const PlayedFrame& f) { return f.result.status != TrackStatus::lost; });
    out.add(row_of(world, k.name, judge(run))
                .count("poses_meanwhile", given)
                .count("wrong_meanwhile", wrong_poses(run, k.begin, k.end, bars))
                .count("recovered_in", recovered)
                .count("wrong_until_then", wrong_poses(run, k.end, back, bars))
                .number("ate_after_mm", 1000.0 * judge(run, back, size).ate_m.rmse, 2)
                .flag("pass", recovered >= 0 && recovered <= 15));
  }
  out.write();
}

}  // namespace

void add_kidnap(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(
      app, common, "kidnap",
      "in the middle of the sequence frames are cut out, or their images replaced by black, by one colour, by another "
      "sequence's first: poses given meanwhile, wrong ones (off by more than 0.1 m or 5 deg) then and until recovered, "
      "frames until the error is within the bar and 1 deg for 15 frames (-1: never; at most 15 pass)");
  auto flags = std::make_shared<KidnapFlags>();
  add_job_flags(command, flags->job);
  command->add_option("--other", flags->other, "sequence whose first images are cut in, at this one's size");
  apps::add_number(command, "--cut", flags->cut, {.least = 0, .most = 100000},
                   "frames cut out; these numbers are a third of the sequence at most");
  apps::add_number(command, "--black", flags->black, {.least = 0, .most = 100000}, "frames that are black");
  apps::add_number(command, "--one-colour", flags->hand, {.least = 0, .most = 100000},
                   "frames of one colour, as with a hand over the lens");
  apps::add_number(command, "--foreign", flags->foreign, {.least = 0, .most = 100000}, "frames of --other");
  apps::add_number(command, "--bar", flags->bar_mm, {.least = 0.01, .most = 10000.0},
                   "error that counts as recovered [mm]");
  command->final_callback([&common, flags] { run_kidnap(common, *flags); });
}

}  // namespace odosplat::accuracy
