// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/trainer_options.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {

void require_rate(double rate, const std::string& name) {
  require(rate >= 0.0 && std::isfinite(rate), name, "at least 0");
}

}  // namespace

void TrainerOptions::check() const {
  require(iterations >= 0, "iterations", "at least 0");
  require(coarse_levels >= 0 && coarse_levels <= 4, "coarse_levels", "in 0..4");
  require(coarse_share >= 0.0F && coarse_share <= 1.0F, "coarse_share", "in 0..1");
  require(sh_interval >= 0, "sh_interval", "at least 0");
  require_rate(position_rate, "position_rate");
  require_rate(position_rate_final, "position_rate_final");
  require((position_rate > 0.0) == (position_rate_final > 0.0), "position_rate_final",
          "zero exactly when position_rate is");
  require_rate(scale_rate, "scale_rate");
  require_rate(rotation_rate, "rotation_rate");
  require_rate(opacity_rate, "opacity_rate");
  require_rate(color_rate, "color_rate");
  require_rate(sh_rate, "sh_rate");
  require(color_rate > 0.0 || sh_rate == 0.0, "sh_rate", "0 where color_rate is");
  require(final_share > 0.0 && final_share <= 1.0, "final_share", "above 0, at most 1");
  require(largest_growth == 0.0 || largest_growth >= 1.0, "largest_growth", "0 or at least 1");
  loss.check();
  depth.check();
  surface.check();
  exposure.check();
  densify.check();
  adam.check();
  rasterizer.check();
}

std::vector<std::string> TrainerOptions::describe() const {
  std::vector<std::string> lines;
  const auto add = [&lines](const std::string& name, auto value) {
    std::ostringstream line;
    line << name << ' ' << value;
    lines.push_back(line.str());
  };
  add("iterations", iterations);
  add("seed", seed);
  add("coarse_levels", coarse_levels);
  add("coarse_share", coarse_share);
  add("sh_interval", sh_interval);
  add("position_length", position_length == PositionLength::gaussian_size ? "gaussian_size" : "camera_extent");
  add("position_rate", position_rate);
  add("position_rate_final", position_rate_final);
  add("scale_rate", scale_rate);
  add("rotation_rate", rotation_rate);
  add("opacity_rate", opacity_rate);
  add("color_rate", color_rate);
  add("sh_rate", sh_rate);
  add("final_share", final_share);
  add("largest_growth", largest_growth);
  add("keep_thickness", keep_thickness ? 1 : 0);
  add("ssim_weight", loss.ssim_weight);
  add("depth_weight", depth.weight);
  add("depth_cut", depth.cut);
  add("place_weight", surface.place_weight);
  add("normal_weight", surface.normal_weight);
  add("flatten_weight", surface.flatten_weight);
  add("exposure_rate", exposure.rate);
  add("densify", name_of(densify.method));
  if (densify.method != DensifyMethod::none) {
    add("budget", densify.budget);
    add("densify_from", densify.from);
    add("densify_interval", densify.interval);
    add("densify_until_share", densify.until_share);
    add("dead_opacity", densify.dead_opacity);
    add("densify_growth", densify.growth);
    add("densify_pull", densify.pull);
    add("split_size", densify.split_size);
    add("least_split_px", densify.least_split_px);
    add("most_split_px", densify.most_split_px);
    add("largest_size", densify.largest_size);
    add("reset_interval", densify.reset_interval);
    add("reset_opacity", densify.reset_opacity);
  }
  add("color_term", loss.color_term == ColorTerm::l1 ? "l1" : "squared_l2");
  add("dilation", rasterizer.dilation);
  add("compensated", rasterizer.compensated ? 1 : 0);
  lines.push_back(blend_order_line(rasterizer.order));
  return lines;
}

TrainerOptions TrainerOptions::preset(const std::string& name, int views) {
  TrainerOptions options;
  if (name == "default") {
    // Finer colours make tracking more accurate, and many images need more steps (docs/rules.md).
    constexpr int rounds = 8;
    options.iterations = std::max(4000, rounds * views);
    options.densify.method = DensifyMethod::split;
    options.densify.budget = 150000;
    return options;
  }
  if (name != "paper") throw InputError("preset", "must be default or paper, is \"" + name + "\"");
  options.iterations = 20000;
  options.coarse_levels = 2;
  options.coarse_share = 0.3F;
  options.sh_interval = 1000;
  options.position_length = PositionLength::camera_extent;
  options.position_rate = 1e-4;
  options.position_rate_final = 1e-6;
  options.scale_rate = 5e-3;
  options.rotation_rate = 1e-3;
  options.opacity_rate = 1e-2;
  options.color_rate = 2.5e-2;
  options.sh_rate = 1.25e-4;
  options.final_share = 1.0;
  options.keep_thickness = false;
  options.largest_growth = 0.0;
  options.rasterizer.order = BlendOrder::depth;
  options.depth.weight = 0.0;
  options.surface = {0.0, 0.0, 0.0};
  options.exposure.rate = 0.0;
  options.densify.method = DensifyMethod::split;
  options.densify.until_share = 0.5;
  options.densify.dead_opacity = 0.1;
  options.densify.least_split_px = 0.0;
  options.densify.most_split_px = std::numeric_limits<double>::infinity();
  options.densify.reset_interval = 3000;
  return options;
}

}  // namespace odosplat
