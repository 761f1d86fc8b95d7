// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command/support.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

void run_plain(const apps::Common& common, const Job& job) {
  Output out(job);
  const World world(job);
  apps::OpenedView opened = apps::open_view(common, job.track.method, job.track.map);
  const Run run = play(world, opened, job.track, in_order(world, 0, world.size()), "plain");
  out.trace(world, "plain", run);
  const Judged judged = judge(run);
  out.add(row_of(world, "plain", judged)
              .number("live_mm", 1000.0 * judged.live_ate_m.rmse, 2)
              .number("rte_mm", 1000.0 * judged.rte_m.rmse, 2)
              .number("rre_deg", judged.rre_deg.rmse, 4)
              .count("keyframes", run.statistics.keyframes)
              .count("anchored", run.statistics.anchored)
              .number("cpu_ms", run.cpu_ms, 1)
              .number("wall_ms", run.wall_ms, 1)
              .number("peak_mb", apps::peak_memory_mb(), 0));
  const Consistency c = consistency(run);
  out.add(Row()
              .text("set", world.name())
              .text("scenario", "uncertainty")
              .number("nees_mean", c.all.mean, 2)
              .number("nees_median", c.all.median, 2)
              .number("nees_p99", c.all.p99, 1)
              .number("nees_max", c.all.max, 1)
              .number("keyframes_mean", c.keyframes.mean, 2)
              .number("keyframes_median", c.keyframes.median, 2)
              .number("between_mean", c.between.mean, 2)
              .number("between_median", c.between.median, 2)
              .count("beyond", static_cast<long>(c.beyond.count))
              .number("beyond_mean", c.beyond.mean, 2)
              .number("beyond_median", c.beyond.median, 2)
              .number("above_16.8", c.above_99, 3)
              .number("below_5.35", c.below_median, 3));
  out.write();
}

}  // namespace

void add_plain(CLI::App& app, apps::Common& common) {
  CLI::App* command =
      apps::add_command(app, common, "plain",
                        "the sequence as it is: ATE of the final and of the live poses, RTE, RRE, CPU time of all "
                        "threads a frame divided "
                        "by two, time by the clock, peak memory; and the normalised pose error squared (6 expected)");
  auto job = std::make_shared<Job>();
  add_job_flags(command, *job);
  command->final_callback([&common, job] { run_plain(common, *job); });
}

}  // namespace odosplat::accuracy
