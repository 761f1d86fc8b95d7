// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command/json_text.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/truth.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/eval/evaluate.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

struct EvalFlags {
  std::string estimate;
  TruthFlags truth;
  std::string alignment = "none";
  std::string json;
  std::string estimate_times;
  EvalOptions options;
};

/// Null if there are no values.
nlohmann::ordered_json json_of(const Statistics& s) {
  if (s.count == 0) {
    return {{"rmse", nullptr}, {"mean", nullptr}, {"median", nullptr}, {"max", nullptr}, {"p99", nullptr}};
  }
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"max", s.max}, {"p99", s.p99}};
}

nlohmann::ordered_json json_of(const EvalResult& result, const std::string& alignment) {
  return {{"ate_m", json_of(result.ate_m)},
          {"rte_m", json_of(result.rte_m)},
          {"rre_deg", json_of(result.rre_deg)},
          {"pairs", result.pairs},
          {"coverage", result.coverage},
          {"coverage_estimate", result.coverage_estimate},
          {"coverage_truth", result.coverage_truth},
          {"alignment", alignment},
          {"scale", result.truth_from_estimate.scale}};
}

EvalResult evaluate_or_say_why(const JudgedTrajectory& judged, const EvalOptions& options) {
  try {
    return evaluate(judged.estimate, judged.truth, options);
  } catch (const NothingMatched& e) {
    throw NoResult(e.what());
  }
}

/// Prints "-" if there are no values, which is not the same as errors of zero.
void print_row(const char* name, const Statistics& s, double unit, const char* format) {
  print("%-10s", name);
  for (const double value : {s.rmse, s.mean, s.median, s.max, s.p99}) {
    if (s.count > 0) {
      print(format, value * unit);
    } else {
      print("%12s", "-");
    }
  }
  print("\n");
}

void run(EvalFlags& flags) {
  flags.options.alignment = alignment_from_name(flags.alignment);
  const MadeFolders made = ensure_output_if_given(flags.json);
  const JudgedTrajectory judged = read_judged(flags.estimate, flags.estimate_times, flags.truth);
  const EvalResult result = evaluate_or_say_why(judged, flags.options);
  print("%-10s%12s%12s%12s%12s%12s\n", "", "RMSE", "mean", "median", "max", "99 %");
  print_row("ATE [mm]", result.ate_m, 1000.0, " %11.3f");
  print_row("RTE [mm]", result.rte_m, 1000.0, " %11.3f");
  print_row("RRE [deg]", result.rre_deg, 1.0, " %11.4f");
  print("%zu pairs, coverage %.1f %% (of the estimate %.1f %%, of the truth %.1f %%), alignment %s", result.pairs,
        100.0 * result.coverage, 100.0 * result.coverage_estimate, 100.0 * result.coverage_truth,
        flags.alignment.c_str());
  if (result.alignment == TrajectoryAlignment::sim3) print(", scale %.6f", result.truth_from_estimate.scale);
  print("\n");
  if (!flags.json.empty()) write_file_atomically(flags.json, json_text(json_of(result, flags.alignment)));
  if (!result.doubt.empty()) throw NoResult("only " + result.doubt);
}

}  // namespace

void add_eval(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "eval", "errors of an estimated trajectory: ATE, RTE, RRE");
  auto flags = std::make_shared<EvalFlags>();
  command->add_option("EST", flags->estimate, "estimated trajectory (TUM, KITTI, EuRoC or Redwood log)")->required();
  add_truth_flags(command, flags->truth)->required();
  command->add_option("--align", flags->alignment, "none, se3 or sim3 (Umeyama)");
  add_number(command, "--delta", flags->options.delta, {.least = 1},
             "frames between the two poses of a relative error");
  command->add_flag("--all-pairs", flags->options.all_pairs, "relative errors from every pose, not every delta-th");
  add_number(command, "--max-time-difference", flags->options.max_time_difference, {.least = 0.0, .most = 1e6},
             "between matched poses [s]");
  command->add_option("--times", flags->estimate_times, "times of EST, one a line, for formats without times");
  command->add_option("--json", flags->json, "report to write (JSON)");
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
