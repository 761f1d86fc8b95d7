// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/upper_median.hpp"
#include "tests/accuracy/disturb/disturb_image.hpp"
#include "tests/accuracy/disturb/disturbances.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/rules.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

struct AblateFlags {
  Job job;
  std::vector<std::string> rules;  // empty: all
  std::vector<std::string> under{"plain"};
  DisturbanceOptions strength;
  int seeds = 3;
  bool together = false;
};

/// What one comparison leaves out.
struct Left {
  std::string name;
  OptionEdit off;
  double gain = 1.0;  // of the images
};

/// The compared measures of a run; for all of them lower is better.
struct Figures {
  double ate_mm = 0.0;
  double lost = 0.0;
  double wrong = 0.0;  // frames reported as tracked in the map with a wrong pose, as defined by RecoveryBars
  double nees = 0.0;   // mean squared normalised error
  double cpu_ms = 0.0;
};

Figures figures_of(const Run& run) {
  const Judged judged = judge(run);
  const RecoveryBars bars;
  Figures figures;
  const double nothing = std::numeric_limits<double>::infinity();
  figures.ate_mm = judged.ate_m.count > 0 ? 1000.0 * judged.ate_m.rmse : nothing;
  figures.lost = static_cast<double>(judged.lost);
  figures.wrong = wrong_in_map(run, bars);
  figures.nees = consistency(run).all.mean;
  figures.cpu_ms = run.cpu_ms;
  return figures;
}

double median_of(const std::vector<Figures>& runs, double Figures::*figure) {
  std::vector<double> values;
  for (const Figures& run : runs) values.push_back(run.*figure);
  return upper_median(values);
}

/// Largest minus smallest value.
double spread_of(const std::vector<Figures>& runs, double Figures::*figure) {
  const auto [least, most] = std::minmax_element(
      runs.begin(), runs.end(), [figure](const Figures& a, const Figures& b) { return a.*figure < b.*figure; });
  return (*most).*figure - (*least).*figure;
}

/// A rule's row: the medians of runs without it, and whether it pays: without it more frames are lost or wrong, or the
/// ATE grows by more than the larger of both spreads.
Row row_without(const World& world, const std::string& under, const std::string& rule, const std::vector<Figures>& off,
                const std::vector<Figures>& on) {
  const double ate_off = median_of(off, &Figures::ate_mm);
  const double ate_on = median_of(on, &Figures::ate_mm);
  const double spread = std::max(spread_of(off, &Figures::ate_mm), spread_of(on, &Figures::ate_mm));
  const bool pays = ate_off > ate_on + spread || median_of(off, &Figures::lost) > median_of(on, &Figures::lost) ||
                    median_of(off, &Figures::wrong) > median_of(on, &Figures::wrong);
  return Row()
      .text("set", world.name())
      .text("under", under)
      .text("without", rule)
      .number("ate_mm", ate_off, 2)
      .number("spread_mm", spread_of(off, &Figures::ate_mm), 2)
      .number("ratio", ate_off / ate_on, 3)
      .number("lost", median_of(off, &Figures::lost), 0)
      .number("wrong", median_of(off, &Figures::wrong), 0)
      .number("nees", median_of(off, &Figures::nees), 1)
      .number("cpu_ms", median_of(off, &Figures::cpu_ms), 1)
      .flag("pays", pays);
}

constexpr const char* covered = "covered";

/// All frames; under "covered" the images of a quarter of them are black, 20 frames in a row.
Script script_of(const World& world, const std::string& under,
                 const std::function<ImageEdit(std::size_t frame)>& edit) {
  Script script = in_order(world, 0, world.size(), edit);
  if (under != covered) return script;
  constexpr std::size_t period = 80;
  constexpr std::size_t open = 60;
  for (std::size_t k = 0; k < script.size(); ++k) {
    if (k % period < open) continue;
    script[k].blind = true;
    script[k].edit = [&world](const GrayImage&) { return uniform_image(world.camera(), 0.0); };
  }
  return script;
}

/// The chosen rules, each by itself or all in one.
std::vector<Left> left_out(const AblateFlags& flags) {
  std::vector<Left> each;
  for (const Rule& rule : rules()) {
    if (flags.rules.empty() || std::count(flags.rules.begin(), flags.rules.end(), rule.name) > 0) {
      each.push_back({rule.name, rule.off, rule.gain});
    }
  }
  if (!flags.together) return each;
  Left all;
  for (const Left& one : each) {
    all.name.append(all.name.empty() ? "" : " + ").append(one.name);
    all.gain *= one.gain;
  }
  all.off = [each](OdometryOptions& options) {
    for (const Left& one : each) one.off(options);
  };
  return {all};
}

/// Runs one condition: for every seed with all rules, then without each of the rules. undamaged: the map as it is,
/// opened when it is first needed.
void ablate(const apps::Common& common, const World& world, const AblateFlags& flags, const std::string& under,
            std::optional<apps::OpenedView>& undamaged, Output& out) {
  const std::vector<Left> chosen = left_out(flags);
  std::vector<Figures> on;
  std::vector<std::vector<Figures>> off(chosen.size());
  const DamagedMaps folder;
  for (int n = 0; n < flags.seeds; ++n) {
    apps::TrackJob job = flags.job.track;
    job.seed += static_cast<std::uint64_t>(n);
    const auto edit = image_disturbance(under, world, flags.strength, job.seed);
    std::optional<apps::OpenedView> damaged;
    if (const MapEdit damage = map_disturbance(under, flags.strength, job.seed); damage) {
      double share = 0.0;
      damaged = apps::open_view(common, job.method, edited_map(job.map, damage, folder.path(), share));
    } else if (!undamaged) {
      undamaged = apps::open_view(common, job.method, job.map);
    }
    apps::OpenedView& opened = damaged ? *damaged : *undamaged;
    const auto run_of = [&](const std::string& rule, const OptionEdit& option, double gain) {
      const auto scaled = [edit, gain](std::size_t frame) -> ImageEdit {
        const ImageEdit before = edit ? edit(frame) : ImageEdit();
        if (gain == 1.0) return before;
        return [before, gain](const GrayImage& image) { return with_gain(before ? before(image) : image, gain); };
      };
      const std::string label = under + ", seed " + std::to_string(n + 1) + ", " + rule;
      const Run run = play(world, opened, job, script_of(world, under, scaled), label, option);
      out.trace(world, label, run);
      return figures_of(run);
    };
    on.push_back(run_of("all rules", {}, 1.0));
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      off[k].push_back(run_of("without " + chosen[k].name, chosen[k].off, chosen[k].gain));
    }
  }
  out.add(row_without(world, under, "-", on, on));
  for (std::size_t k = 0; k < chosen.size(); ++k) out.add(row_without(world, under, chosen[k].name, off[k], on));
}

void run_ablate(const apps::Common& common, const AblateFlags& flags) {
  Output out(flags.job);
  const World world(flags.job);
  std::optional<apps::OpenedView> undamaged;
  for (const std::string& under : flags.under) ablate(common, world, flags, under, undamaged, out);
  out.write();
}

}  // namespace

void add_ablate(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(
      app, common, "ablate",
      "the odometry's rules switched off, one at a time: medians over seeds of ATE, its spread, lost frames, wrong "
      "poses that count as in the map, normalised error squared and CPU time; a rule pays if without it more "
      "frames are lost or wrong, or ATE grows by more than the spread");
  auto flags = std::make_shared<AblateFlags>();
  std::vector<std::string> rule_names;
  for (const Rule& rule : rules()) rule_names.emplace_back(rule.name);
  std::vector<std::string> conditions{"plain", covered};
  for (const auto* names : {&image_disturbances(), &map_disturbances()}) {
    conditions.insert(conditions.end(), names->begin(), names->end());
  }
  add_job_flags(command, flags->job);
  command->add_option("--rules", flags->rules, "the rules in question, by their names (default: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(rule_names));
  command
      ->add_option(
          "--under", flags->under,
          "plain; covered: no light for 20 frames of every 80; or disturbances as of `disturb`: one after the other")
      ->delimiter(',')
      ->check(CLI::IsMember(conditions));
  apps::add_number(command, "--seeds", flags->seeds, {.least = 1, .most = 100},
                   "runs with seeds from --seed on: of the pixel selector and of the disturbance");
  command->add_flag("--together", flags->together, "all of --rules switched off at once, not one at a time");
  add_disturbance_flags(command, flags->strength);
  command->final_callback([&common, flags] { run_ablate(common, *flags); });
}

}  // namespace odosplat::accuracy
