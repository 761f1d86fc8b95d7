// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

/// Forward, backward, forward ...; the frame at a turning point is played once. Times are equally spaced.
Script back_and_forth(const World& world, int passes) {
  Script script;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t k = pass == 0 ? 0 : 1; k < world.size(); ++k) {
      const std::size_t frame = pass % 2 == 0 ? k : world.size() - 1 - k;
      script.push_back({static_cast<double>(script.size()) / world.fps(), frame});
    }
  }
  return script;
}

void run_long_path(const apps::Common& common, const Job& job, int passes) {
  Output out(job);
  const World world(job);
  apps::OpenedView opened = apps::open_view(common, job.track.method, job.track.map);
  const Run run = play(world, opened, job.track, back_and_forth(world, passes), "long path");
  out.trace(world, "long path", run);
  double second = 0.0;
  std::size_t begin = 0;
  for (int pass = 1; pass <= passes; ++pass) {
    const std::size_t end = begin + world.size() - (pass == 1 ? 0 : 1);
    const Judged judged = judge(run, begin, end);
    if (pass == 2) second = judged.ate_m.rmse;
    Row row = row_of(world, "pass " + std::to_string(pass), judged);
    row.number("live_mm", 1000.0 * judged.live_ate_m.rmse, 2)
        .number("resident_mb", run.frames[end - 1].resident_mb, 1)
        .number("over_second", second > 0.0 ? judged.ate_m.rmse / second : std::numeric_limits<double>::infinity(), 3);
    out.add(row);
    begin = end;
  }
  out.write();
}

}  // namespace

void add_long_path(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(app, common, "long-path",
                                        "the sequence forward and backward again and again: ATE and resident memory at "
                                        "the end of every pass, and the ATE "
                                        "over the second pass's (bar: the last at most 1.2)");
  auto job = std::make_shared<Job>();
  auto passes = std::make_shared<int>(10);
  add_job_flags(command, *job);
  apps::add_number(command, "--passes", *passes, {.least = 1, .most = 10000}, "how often through the sequence");
  command->final_callback([&common, job, passes] { run_long_path(common, *job, *passes); });
}

}  // namespace odosplat::accuracy
