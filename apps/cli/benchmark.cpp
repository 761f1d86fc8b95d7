// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/benchmark/gather.hpp"
#include "apps/benchmark/job_runner.hpp"
#include "apps/benchmark/method_recipes.hpp"
#include "apps/benchmark/plan.hpp"
#include "apps/benchmark/report/benchmark_figures.hpp"
#include "apps/benchmark/report/report.hpp"
#include "apps/command/commands.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

struct BenchmarkFlags {
  BenchmarkOptions options;
  RunnerOptions runner;
  std::string job;
  bool plan_only = false;
  bool report_only = false;
};

void print_summary(const BenchmarkResults& results) {
  print("%-12s", "ATE [mm]");
  for (const std::string& method : results.methods) print(" %18s", method.c_str());
  print("\n");
  for (const SequenceFacts& sequence : results.sequences) {
    print("%-12s", sequence.name.c_str());
    for (const std::string& method : results.methods) {
      const auto cell = summarise(results, sequence.name, method);
      const std::string text = cell && cell->runs > 0 ? formatted("%.2f%s", 1000.0 * cell->ate_m.median,
                                                                  cell->coverage.median < 0.995 ? " (part)" : "")
                                                      : "x";
      print(" %18s", text.c_str());
    }
    print("\n");
  }
  if (results.stand_in) print("Stand-ins made by this program, not the data sets of these names.\n");
}

/// Map and cloud that the runs on each sequence use, for the figures.
std::map<std::string, MapFlags> maps_of(const Plan& plan) {
  std::map<std::string, MapFlags> maps;
  for (const PlannedSequence& s : plan.sequences) maps[s.name] = {s.map_file, s.cloud_file};
  return maps;
}

void report(const Common& common, const Plan& plan) {
  const BenchmarkResults results = gather(plan);
  const auto figures = draw_benchmark_figures(common, results, maps_of(plan), plan.options.out);
  write_reports(results, figures, plan.options.out);
  print_summary(results);
  print("%s: report.md, report.html, report.json, tables.csv, tables.tex, speed.csv, speed.tex, figures\n",
        plan.options.out.c_str());
}

void run(const Common& common, BenchmarkFlags flags) {
  const Stopwatch watch;
  flags.runner.device = common.device;
  flags.runner.threads = common.threads;
  const bool go_on = flags.options.suite.empty();
  Plan plan = go_on ? read_plan(flags.options.out) : make_plan(flags.options);
  if (!flags.job.empty()) {
    const std::string fault = run_one_job(plan.options.out, plan.jobs, flags.job, flags.runner, own_program());
    print("%s: %s\n", flags.job.c_str(), fault.empty() ? "done" : fault.c_str());
    return;
  }
  const MadeFolders made = ensure_output_folder(plan.options.out);
  if (!flags.report_only) write_plan(plan);
  if (flags.plan_only) {
    remove_unsettled_records(plan.options.out, plan.jobs, flags.runner.retry_failed);
    print("%s/plan.json: %zu jobs\n", plan.options.out.c_str(), plan.jobs.size());
    return;
  }
  if (!flags.report_only) {
    const RunnerOutcome outcome = run_jobs(plan.options.out, plan.jobs, flags.runner, own_program());
    if (outcome.stopped) {
      log_info("stopped; the same command goes on from here");
      throw Interrupted();
    }
    log_info(std::to_string(outcome.went_through) + " jobs done, " + std::to_string(outcome.failed) +
             " failed, after " + format_duration(watch.seconds()));
  }
  report(common, plan);
}

}  // namespace

void add_benchmark(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "benchmark",
                  "every method on every sequence of a suite: the paper's tables and figures. Run again "
                  "with the same --out it goes on where it was");
  auto flags = std::make_shared<BenchmarkFlags>();
  BenchmarkOptions& o = flags->options;
  RunnerOptions& r = flags->runner;
  std::string methods;
  for (const std::string& name : built_in_methods()) methods += (methods.empty() ? "" : ", ") + name;
  command->add_option(
      "--suite", o.suite,
      "synthetic (stand-ins made here), icl (the paper's recordings, see --root) or a suite file (YAML); "
      "not given: what --out was begun with");
  command->add_option("--out", o.out, "folder for reports, figures, maps and runs")->required();
  command->add_option("--root", o.root, "folder of the recordings (default: the suite file's)");
  command->add_option("--methods", o.methods, methods + ", or the suite's own (default: all but gaussian_no_anchor)")
      ->delimiter(',');
  command->add_option("--sequences", o.sequences, "names, such as icl_1,augm_3 (default: all)")->delimiter(',');
  add_number(command, "--runs", o.runs, {.least = 1, .most = 10000},
             "runs of each method on each sequence, each with a seed of its own");
  command->add_option("--size", o.size, "WIDTHxHEIGHT of stand-ins [px]");
  command->add_option("--mapping", o.mapping,
                      "every: maps of every tenth frame of the tested sequences, as in the paper; split: of other "
                      "sequences than the tested one");
  command->add_flag("--quick", o.quick, "200 frames a sequence and short training");
  add_number(command, "--seed", o.seed, {}, "seed of stand-ins and, with the run's number added, of the methods");
  command->add_option("--cache", o.cache,
                      "folder of stand-ins, shared by benchmarks (default: ODOSPLAT_CACHE_DIR, else "
                      "~/.cache/odosplat, each with /stand-ins)");
  add_number(command, "--jobs", r.jobs, {.least = 0, .most = 1024, .word = "auto"},
             "processes at a time; 0 or auto: one per core");
  add_number(command, "--time-limit", r.time_limit, {.least = 0.0, .most = 1e8, .least_excluded = true},
             "a job is stopped after this time [s]");
  add_number(command, "--memory-limit", r.memory_limit, {.least = 0.0, .most = 1e9, .least_excluded = true},
             "a job is stopped at this resident size [MB]");
  command->add_flag("--retry-failed", r.retry_failed, "run jobs again that failed before");
  command->add_flag("--plan", flags->plan_only, "only write OUT/plan.json, for a scheduler of one's own");
  command->add_option("--job", flags->job, "run one job of OUT/plan.json, by its id");
  command->add_flag("--report", flags->report_only, "only write the reports of what there is");
  command->final_callback([&common, flags] { run(common, *flags); });
}

}  // namespace odosplat::apps
