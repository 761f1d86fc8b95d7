// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/benchmark_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/benchmark/report/report_table.hpp"
#include "apps/cli/view/view_figures.hpp"
#include "apps/command/interrupt.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "viewer/figures/error_plot.hpp"
#include "viewer/figures/trajectories_figure.hpp"
#include "viewer/figures/trajectory_figure.hpp"
#include "viewer/page.hpp"
#include "viewer/ticks.hpp"

namespace odosplat::apps {
namespace {

using Maps = std::map<std::string, MapFlags>;

const SequenceFacts* find_sequence(const BenchmarkResults& results, const std::string& name) {
  const auto found = std::ranges::find(results.sequences, name, &SequenceFacts::name);
  return found == results.sequences.end() ? nullptr : &*found;
}

/// The first run that succeeded; null if there is none.
const RunFacts* first_run(const BenchmarkResults& results, const std::string& sequence, const std::string& method) {
  const auto found = std::ranges::find_if(results.cells, [&](const RunFacts& run) {
    return run.sequence == sequence && run.method == method && run.fault.empty() && !run.estimate.empty();
  });
  return found == results.cells.end() ? nullptr : &*found;
}

std::string ours(const BenchmarkResults& results) {
  const auto found = std::ranges::find(results.methods, "gaussian");
  return found != results.methods.end() ? *found : results.methods.empty() ? "" : results.methods.front();
}

/// "icl_2 (stand-in)": the label is part of the picture because pictures are passed on without their captions.
std::string labelled(const BenchmarkResults& results, const std::string& name) {
  const SequenceFacts* sequence = find_sequence(results, name);
  const bool stand_in = results.stand_in || (sequence != nullptr && sequence->stand_in);
  return stand_in ? name + " (stand-in)" : name;
}

std::string listed(const BenchmarkResults& results, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + labelled(results, name);
  return text;
}

/// `wanted` if all of them are usable; otherwise the first usable sequences of the results, at most as many as wanted.
std::vector<std::string> chosen(const BenchmarkResults& results, const std::vector<std::string>& wanted,
                                const std::function<bool(const SequenceFacts&)>& usable) {
  std::vector<std::string> all;
  for (const SequenceFacts& sequence : results.sequences) {
    if (sequence.fault.empty() && usable(sequence)) all.push_back(sequence.name);
  }
  const auto has = [&](const std::string& name) { return std::ranges::find(all, name) != all.end(); };
  if (std::ranges::all_of(wanted, has)) return wanted;
  if (all.size() > wanted.size()) all.resize(wanted.size());
  return all;
}

std::vector<std::string> with_maps(const BenchmarkResults& results, const Maps& maps,
                                   const std::vector<std::string>& wanted) {
  return chosen(results, wanted, [&](const SequenceFacts& sequence) {
    const auto found = maps.find(sequence.name);
    return found != maps.end() && !found->second.map.empty() && !found->second.cloud.empty();
  });
}

/// A frame at about `share` (0..1) of the tested part of the sequence, which the truth in the results spans. It lies
/// halfway between two mapping frames (0, 10, 20, ...).
std::size_t frame_at(const Sequence& sequence, const Trajectory& truth, double share) {
  std::size_t begin = 0;
  std::size_t end = sequence.size();
  if (!truth.empty()) {
    while (begin + 1 < end && sequence.time(begin) < truth.front().time - 1e-6) ++begin;
    while (end > begin + 1 && sequence.time(end - 1) > truth.back().time + 1e-6) --end;
  }
  const auto near = begin + static_cast<std::size_t>(share * static_cast<double>(end - begin));
  return std::min(near / 10 * 10 + 5, end - 1);
}

std::string frame_words(const BenchmarkResults& results, const std::string& name, std::size_t frame) {
  return labelled(results, name) + ", frame " + std::to_string(frame);
}

ReportFigure draw_association_figure(const Common& common, const BenchmarkResults& results, const Maps& maps,
                                     const std::string& folder) {
  ReportFigure report{"figures/association.png", "", "", ""};
  const std::vector<std::string> names = with_maps(results, maps, {"icl_1"});
  if (names.empty()) throw InputError("no sequence has both a map and a cloud");
  const Sequence sequence = Sequence::open(find_sequence(results, names[0])->path);
  const MapFlags& flags = maps.at(names[0]);
  ComparedViews views = open_compared_views(common, flags);
  const std::size_t frame = frame_at(sequence, find_sequence(results, names[0])->truth, 0.5);
  AssociationFigure figure = association_figure(views, sequence, frame, flags);
  figure.title = frame_words(results, names[0], frame);
  write_rgb8(folder + "/" + report.file, draw_association(figure));
  report.caption = frame_words(results, names[0], frame) +
                   ". Top: depth by interpolation between the points of the discrete map (left) and rendered from "
                   "Gaussians (right); hatched: no depth. Bottom: those points as the view sees them, and its image.";
  return report;
}

ReportFigure draw_comparison_figure(const Common& common, const BenchmarkResults& results, const Maps& maps,
                                    const std::string& folder) {
  ReportFigure report{"figures/depth.png", "", "", "", true};
  const std::vector<std::string> names = with_maps(results, maps, {"icl_1", "augm_4"});
  if (names.empty()) throw InputError("no sequence has both a map and a cloud");
  CompareFigure figure;
  figure.size.width = 2000;
  std::string words;
  double shape = 0.0;
  for (const std::string& name : names) {
    const Sequence sequence = Sequence::open(find_sequence(results, name)->path);
    const double own_shape = static_cast<double>(sequence.camera().height) / sequence.camera().width;
    if (shape > 0.0 && std::abs(own_shape - shape) > 0.01) continue;  // panels would be stretched
    shape = own_shape;
    ComparedViews views = open_compared_views(common, maps.at(name));
    const std::size_t frame = frame_at(sequence, find_sequence(results, name)->truth, 0.3);
    figure.examples.push_back(compare_example(views, sequence, frame, frame_words(results, name, frame)));
    words += (words.empty() ? "" : "; ") + frame_words(results, name, frame);
  }
  write_rgb8(folder + "/" + report.file, draw_compare(figure));
  report.caption = words +
                   ". Image, depth interpolated between the map's points, depth rendered from Gaussians, true depth; "
                   "below each its error. Hatched: no depth, or no truth to judge it by.";
  return report;
}

ReportFigure draw_trajectories_figure(const BenchmarkResults& results, const std::string& folder) {
  ReportFigure report{"figures/trajectories.png", "", "", ""};
  std::vector<std::string> names;
  write_rgb8(folder + "/" + report.file, benchmark_trajectories(results, names));
  report.caption = listed(results, names) + ": final trajectory of method " + ours(results) +
                   ", first run, against the truth, from above, not aligned.";
  return report;
}

ReportFigure draw_errors_figure(const BenchmarkResults& results, const std::string& folder) {
  ReportFigure report{"figures/errors.png", "", "", "", true};
  write_rgb8(folder + "/" + report.file, benchmark_errors(results));
  report.caption =
      std::string(results.stand_in ? "All sequences: stand-in. " : "") +
      "Distance of the final trajectory's positions from the true ones, first run of each method that went "
      "through, not aligned. The scale is logarithmic where methods differ much.";
  return report;
}

double median_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return upper_median(std::move(values));
}

}  // namespace

cv::Mat3b benchmark_trajectories(const BenchmarkResults& results, std::vector<std::string>& drawn) {
  const std::string method = ours(results);
  drawn = chosen(results, {"icl_2", "icl_3", "augm_2", "augm_4"}, [&](const SequenceFacts& sequence) {
    return !sequence.truth.empty() && first_run(results, sequence.name, method) != nullptr;
  });
  if (drawn.empty()) throw InputError("no run of method " + method + " on a sequence with true poses");
  TrajectoriesFigure figure;
  for (const std::string& name : drawn) {
    const RunFacts& run = *first_run(results, name, method);
    figure.panels.push_back({labelled(results, name) + ": ATE " + length_text(run.unaligned.ate_m.rmse), run.estimate,
                             find_sequence(results, name)->truth, Eigen::Vector3d::Zero()});
  }
  return draw_trajectories(figure);
}

cv::Mat3b benchmark_errors(const BenchmarkResults& results) {
  std::vector<cv::Mat3b> panels;
  for (const SequenceFacts& sequence : results.sequences) {
    if (sequence.truth.empty()) continue;
    ErrorPlot plot;
    // The legend has a row for each method.
    plot.size = {1000, 540 + 35 * static_cast<int>(results.methods.size())};
    plot.words = "position error";
    plot.title = labelled(results, sequence.name);
    double smallest = 0.0;
    double largest = 0.0;
    for (const std::string& method : results.methods) {
      // A method without a run keeps an empty series, so that every method has the same colour in all panels.
      ErrorSeries series{method, {}, {}};
      if (const RunFacts* run = first_run(results, sequence.name, method)) {
        for (const StampedPose& pose : run->estimate) series.times.push_back(pose.time);
        series.errors = position_errors(run->estimate, sequence.truth);
        const double median = median_of(series.errors);
        if (median > 0.0) {
          smallest = smallest > 0.0 ? std::min(smallest, median) : median;
          largest = std::max(largest, median);
        }
      } else {
        series.name += " (no run)";
      }
      plot.series.push_back(std::move(series));
    }
    if (!(largest > 0.0)) continue;
    plot.log_scale = largest > 5.0 * smallest;
    panels.push_back(draw_error_plot(plot));
  }
  if (panels.empty()) throw InputError("no run on a sequence with true poses");
  return tiled(panels, panels.size() > 1 ? 2 : 1);
}

std::vector<ReportFigure> draw_benchmark_figures(const Common& common, const BenchmarkResults& results,
                                                 const std::map<std::string, MapFlags>& maps,
                                                 const std::string& folder) {
  const MadeFolders made = ensure_output_folder(folder + "/figures");
  std::vector<ReportFigure> figures;
  const auto add = [&](const std::string& title, const std::function<ReportFigure()>& draw) {
    if (interrupted()) throw Interrupted();
    try {
      figures.push_back(draw());
      figures.back().title = title;
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      figures.push_back({"", title, "", error.what()});
    }
  };
  add("Depth of a view (the paper's Figure 1)", [&] { return draw_association_figure(common, results, maps, folder); });
  add("Depth against the truth (the paper's Figure 4)",
      [&] { return draw_comparison_figure(common, results, maps, folder); });
  add("Trajectories (the paper's Figure 5)", [&] { return draw_trajectories_figure(results, folder); });
  add("Position error over time", [&] { return draw_errors_figure(results, folder); });
  return figures;
}

}  // namespace odosplat::apps
