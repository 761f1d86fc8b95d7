// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/eval_depth.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command/interrupt.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/unreadable_frames.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/eval/image_metrics.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/points/pixel_selector.hpp"

namespace odosplat::apps {
namespace {

// Mask of the pixels that the odometry would select in this image.
cv::Mat1b selected_mask(PixelSelector& selector, const GrayImage& gray, const Camera& camera) {
  constexpr int wanted = 2000;
  const std::vector<GradientImage> gradients = build_gradients(build_frame_pyramid(camera, gray));
  cv::Mat1b mask(gray.size(), uchar{0});
  for (const cv::Point& p : selector.select(gradients, {}, wanted)) mask(p) = 255;
  return mask;
}

std::vector<std::size_t> judged_frames(const Sequence& sequence, const EvalDepthJob& job) {
  const FrameRange range = job.frames.empty() ? FrameRange() : parse_frames(job.frames);
  std::vector<std::size_t> frames = frames_not_trained_on(sequence, range, job.skip_every, job.map.map);
  std::erase_if(frames, [&](std::size_t i) { return !sequence.T_world_camera(i) || !sequence.has_depth(i); });
  std::vector<std::size_t> thinned;
  for (std::size_t k = 0; k < frames.size(); k += static_cast<std::size_t>(job.every)) thinned.push_back(frames[k]);
  if (thinned.empty()) throw InputError(sequence.name(), "no frame with pose and depth is left to judge");
  return thinned;
}

void print_row(const char* region, const DepthErrors& e) {
  if (e.valid_share > 0.0) {
    print("%-10s%12.2f%12.2f%12.2f%12.2f", region, 1000.0 * e.median_abs_m, 1000.0 * e.rmse_m, 1000.0 * e.p90_m,
          1000.0 * e.mean_m);
  } else {
    print("%-10s%12s%12s%12s%12s", region, "-", "-", "-", "-");
  }
  print("%11.2f%%", 100.0 * e.valid_share);
  if (e.with_sigma > 0)
    print("%10.1f%%%10.1f%%%10.1f%%", 100.0 * e.within_sigmas[0], 100.0 * e.within_sigmas[1],
          100.0 * e.within_sigmas[2]);
  print("\n");
}

nlohmann::ordered_json json_of(const DepthErrors& e) {
  return {{"median_abs_m", e.median_abs_m},
          {"rmse_m", e.rmse_m},
          {"p90_m", e.p90_m},
          {"mean_m", e.mean_m},
          {"valid_share", e.valid_share},
          {"within_1_sigma", e.within_sigmas[0]},
          {"within_2_sigma", e.within_sigmas[1]},
          {"within_3_sigma", e.within_sigmas[2]}};
}

}  // namespace

EvalDepthOutcome evaluate_depth(const Common& common, const EvalDepthJob& job) {
  const Sequence sequence = open_sequence(job.sequence);
  const std::vector<std::size_t> frames = judged_frames(sequence, job);
  OpenedView opened = open_view(common, job.method, job.map, job.depth_noise);
  PixelSelector selector{SelectorOptions()};
  DepthMetrics all;
  DepthMetrics selected;
  DepthMetrics edges;
  EvalDepthOutcome outcome;
  ViewRequest request;
  request.color = true;
  Progress progress("eval-depth", static_cast<long>(frames.size()));
  UnreadableFrames unreadable;
  for (const std::size_t i : frames) {
    if (interrupted()) throw Interrupted();
    DepthImage truth;
    ColorImage color;
    try {
      truth = sequence.depth(i);
      color = sequence.color(i);
      opened.show_frame(sequence, i);
    } catch (const InputError& e) {
      unreadable.add(e.what());
      continue;
    }
    const ViewImages images = opened.view->render(sequence.camera(), *sequence.T_world_camera(i), request);
    all.add(images.depth, truth, {}, images.sigma);
    selected.add(images.depth, truth, selected_mask(selector, to_gray(color), sequence.camera()), images.sigma);
    edges.add(images.depth, truth, depth_edge_mask(truth), images.sigma);
    if (!images.color.empty()) {
      outcome.psnr_db += psnr_db(images.color, color);
      outcome.ssim += ssim(images.color, color);
    }
    progress.update(++outcome.frames);
    if (images.color.empty()) outcome.psnr_db = outcome.ssim = std::numeric_limits<double>::quiet_NaN();
  }
  progress.finish();
  unreadable.report(frames.size());
  outcome.all = all.result();
  outcome.selected = selected.result();
  outcome.edges = edges.result();
  outcome.psnr_db /= outcome.frames;
  outcome.ssim /= outcome.frames;
  if (opened.device) print_profile(common, *opened.device);
  return outcome;
}

void add_eval_depth(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "eval-depth", "errors of a map's depth against a sequence's, at true poses");
  auto job = std::make_shared<EvalDepthJob>();
  add_sequence_flags(command, job->sequence);
  add_map_flags(command, job->map);
  command->add_option("--method", job->method, method_names());
  add_depth_noise_flag(command, job->depth_noise);
  add_number(command, "--every", job->every, {.least = 1}, "judge every Nth of the frames");
  command->add_option("--frames", job->frames, frames_help);
  add_skip_every_flag(command, job->skip_every);
  command->add_option("--json", job->json, "report to write (JSON)");
  command->final_callback([&common, job] {
    check_flags_of_method(job->method, job->map, job->depth_noise);
    const MadeFolders made = ensure_output_if_given(job->json);
    const EvalDepthOutcome o = evaluate_depth(common, *job);
    if (!(o.all.valid_share > 0.0) || !std::isfinite(o.all.rmse_m)) {
      throw NoResult("no pixel of " + std::to_string(o.frames) +
                     " frames has a depth of the map to be compared with the sequence's: the map is elsewhere or shows "
                     "nothing, or the camera file is wrong");
    }
    print("%-10s%12s%12s%12s%12s%12s", "[mm]", "median", "RMSE", "90 %", "mean", "valid");
    if (o.all.with_sigma > 0) print("%11s%11s%11s", "1 sigma", "2 sigma", "3 sigma");
    print("\n");
    print_row("all", o.all);
    print_row("selected", o.selected);
    print_row("edges", o.edges);
    print("%d frames", o.frames);
    if (std::isfinite(o.psnr_db)) print(", PSNR %.2f dB, SSIM %.4f", o.psnr_db, o.ssim);
    print("\n");
    if (job->json.empty()) return;
    nlohmann::ordered_json json{
        {"all", json_of(o.all)}, {"selected", json_of(o.selected)}, {"edges", json_of(o.edges)}, {"frames", o.frames}};
    // JSON has no NaN: null if the map has no colour.
    json["psnr_db"] = std::isfinite(o.psnr_db) ? nlohmann::ordered_json(o.psnr_db) : nullptr;
    json["ssim"] = std::isfinite(o.ssim) ? nlohmann::ordered_json(o.ssim) : nullptr;
    write_file_atomically(job->json, json_text(json));
  });
}

}  // namespace odosplat::apps
