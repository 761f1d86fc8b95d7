// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/public_options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "apps/command/nearest_name.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat::apps {
namespace {

using Options = TunedOptions;
using Field = std::variant<int*, float*, double*>;

// The shortest text that reads back as the same value of that type.
template <typename T>
std::string text_of(T value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
  return {text, end};
}

std::string text_of(const Field& field) {
  return std::visit([](const auto* value) { return text_of(*value); }, field);
}

std::string range_text(const PublicOption& option) { return text_of(option.least) + ".." + text_of(option.most); }

const PublicOption& option_of(const std::string& name) {
  std::vector<std::string> names;
  for (const PublicOption& option : public_options()) {
    if (option.name == name) return option;
    names.push_back(option.name);
  }
  throw InputError("--set",
                   "unknown option " + name + suggestion(nearest_name(name, names)) + "; odosplat options lists them");
}

double value_of(const PublicOption& option, const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const char* begin = text.starts_with("+") && !text.starts_with("+-") ? text.data() + 1 : text.data();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) {
    throw InputError("--set", option.name + ": must be a number, is `" + text + "`");
  }
  if (option.is_whole() && value != std::floor(value)) {
    throw InputError("--set", option.name + ": must be a whole number, is " + text);
  }
  if (value < option.least || value > option.most) {
    throw InputError("--set", option.name + ": must be in " + range_text(option) + ", is " + text);
  }
  return value;
}

}  // namespace

std::string group_words(const std::vector<std::string>& groups) {
  std::string words;
  for (const std::string& group : groups) words += (words.empty() ? "" : ", ") + group + ".*";
  return words;
}

const std::vector<PublicOption>& public_options() {
  static const std::vector<PublicOption> options{
      {"odometry.window.keyframes", "", 3, 20, "keyframes of the window that are adjusted together",
       [](Options& o) -> Field { return &o.odometry.window.max_keyframes; }},
      {"odometry.window.iterations", "", 1, 100, "steps of the window's adjustment for each new keyframe",
       [](Options& o) -> Field { return &o.odometry.optimizer.max_iterations; }},
      {"odometry.window.points", "", 50, 5000, "points of each keyframe in the window's adjustment",
       [](Options& o) -> Field { return &o.odometry.keyframe.window_points.points; }},
      {"odometry.window.anchor_points", "", 50, 10000,
       "points by which a keyframe is aligned with the rendered map (with --anchor on)",
       [](Options& o) -> Field { return &o.odometry.keyframe.window_points.anchor_points; }},
      {"odometry.keyframe.flow", "share of width + height", 0.005, 0.5,
       "image motion, of translation alone, at which a new keyframe is due",
       [](Options& o) -> Field { return &o.odometry.policy.translation_flow; }},
      {"odometry.keyframe.coverage", "", 0.1, 0.95,
       "share of the last keyframe's points in view below which a new one is due",
       [](Options& o) -> Field { return &o.odometry.policy.min_coverage; }},
      {"odometry.align.iterations", "", 1, 200, "steps of a frame's alignment on each level of its pyramid",
       [](Options& o) -> Field { return &o.odometry.aligner.max_iterations; }},
      {"odometry.align.noise", "grey, 0..1", 0.001, 0.2,
       "standard deviation of a residual, against the priors of pose and brightness and in the covariance",
       [](Options& o) -> Field { return &o.odometry.aligner.noise; }},
      {"odometry.accept.inliers", "", 0.05, 0.95, "share of points that must agree for a frame to count as tracked",
       [](Options& o) -> Field { return &o.odometry.accept.min_inliers; }},
      {"odometry.accept.correlation", "", 0.0, 0.9,
       "correlation with the last keyframe below which a frame does not count as tracked",
       [](Options& o) -> Field { return &o.odometry.accept.min_correlation; }},
      {"odometry.confirm.confirmed", "", 0.5, 0.999,
       "probability that the map is seen, from which a pose counts as confirmed (method gaussian)",
       [](Options& o) -> Field { return &o.odometry.confirmation.confirmed; }},
      {"odometry.confirm.contradicted", "", 0.0, 0.5,
       "the same, below which the map contradicts a pose (method gaussian)",
       [](Options& o) -> Field { return &o.odometry.confirmation.contradicted; }},
      {"odometry.confirm.frames", "", 0, 1000,
       "frames without a word of the map after which a pose no longer counts as in the map",
       [](Options& o) -> Field { return &o.odometry.max_unconfirmed; }},
      {"odometry.misfit.translation", "m", 0.001, 10.0,
       "a pose that a wrong camera file moves by more than this is refused",
       [](Options& o) -> Field { return &o.odometry.max_misfit_translation; }},
      {"odometry.misfit.rotation", "rad", 0.001, 3.0, "the same for rotation",
       [](Options& o) -> Field { return &o.odometry.max_misfit_rotation; }},
      {"odometry.memory.keyframes", "", 1, 100000,
       "keyframes that are remembered for the return into the map, at 0.3 MB for 320x240",
       [](Options& o) -> Field { return &o.odometry.memory.capacity; }},
      {"odometry.covariance.frame", "", 0.01, 10000.0, "factor of the covariance of a frame's alignment",
       [](Options& o) -> Field { return &o.odometry.frame_covariance_factor; }},
      {"odometry.covariance.keyframe", "", 0.01, 10000.0, "factor of the covariance of a keyframe in the window",
       [](Options& o) -> Field { return &o.odometry.keyframe_covariance_factor; }},
      {"odometry.prefetch", "images", 0.0, 30.0,
       "with --realtime, the map is rendered at most so many images ahead of the next keyframe",
       [](Options& o) -> Field { return &o.odometry.prefetch_images; }},
      {"relocaliser.candidates", "", 1, 1000, "places that are tried for an image by thumbnail, and as many by corners",
       [](Options& o) -> Field { return &o.relocaliser.candidates; }},
      {"relocaliser.finalists", "", 1, 1000, "poses that are rendered again and verified",
       [](Options& o) -> Field { return &o.relocaliser.finalists; }},
      {"relocaliser.score", "", 0.1, 0.99, "mean correlation with the map below which a pose is refused",
       [](Options& o) -> Field { return &o.relocaliser.min_score; }},
      {"relocaliser.sigma", "m", 0.001, 10.0, "standard deviation of the position above which a pose is refused",
       [](Options& o) -> Field { return &o.relocaliser.max_position_sigma; }},
      {"train.ssim_weight", "", 0.0, 1.0, "share of 1 - SSIM in the loss of an image",
       [](Options& o) -> Field { return &o.train.loss.ssim_weight; }},
      {"train.depth_cut", "", 0.002, 1.0,
       "relative error of depth beyond which another surface is meant (where depth is trained on)",
       [](Options& o) -> Field { return &o.train.depth.cut; }},
      {"train.coarse_levels", "", 0, 4, "levels of half size that training starts on",
       [](Options& o) -> Field { return &o.train.coarse_levels; }},
      {"train.color_rate", "", 1e-6, 1.0, "Adam's rate of colours at the start",
       [](Options& o) -> Field { return &o.train.color_rate; }},
      {"train.densify.until", "", 0.0, 1.0,
       "share of the steps after which no Gaussian is split or added (unless --densify none)",
       [](Options& o) -> Field { return &o.train.densify.until_share; }},
      {"train.start.size", "", 0.05, 5.0, "size of a Gaussian at the start over the distance of its neighbours",
       [](Options& o) -> Field { return &o.start.scale_factor; }},
      {"train.start.opacity", "", 0.01, 0.99, "opacity of a Gaussian at the start",
       [](Options& o) -> Field { return &o.start.opacity; }},
  };
  return options;
}

bool PublicOption::is_whole() const {
  TunedOptions options;
  return std::holds_alternative<int*>(field(options));
}

std::string PublicOption::default_text() const {
  TunedOptions options;
  options.train = TrainerOptions::preset("default");
  options.start = InitializeOptions::preset("default");
  return text_of(field(options));
}

OptionValues::OptionValues(const std::vector<std::string>& settings, const std::vector<std::string>& groups) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw InputError("--set", "must be NAME=VALUE, is " + setting);
    const std::string name = setting.substr(0, equals);
    const PublicOption& option = option_of(name);
    if (std::find(groups.begin(), groups.end(), option.group()) == groups.end()) {
      throw InputError("--set", option.name + " is no option of this command, which has " + group_words(groups));
    }
    for (const auto& [other, value] : values_) {
      if (other == &option) throw InputError("--set", option.name + " is given twice");
    }
    values_.emplace_back(&option, value_of(option, setting.substr(equals + 1)));
  }
}

std::vector<std::pair<std::string, std::string>> OptionValues::items() const {
  std::vector<std::pair<std::string, std::string>> items;
  for (const auto& [option, value] : values_) {
    TunedOptions options;
    apply_group(option->group(), options);
    items.emplace_back(option->name, text_of(option->field(options)));
  }
  return items;
}

bool OptionValues::has(const std::string& group) const {
  return std::any_of(values_.begin(), values_.end(), [&](const auto& row) { return row.first->group() == group; });
}

void OptionValues::apply_group(const std::string& group, TunedOptions& options) const {
  for (const auto& [option, value] : values_) {
    if (option->group() != group) continue;
    std::visit([v = value](auto* field) { *field = static_cast<std::remove_pointer_t<decltype(field)>>(v); },
               option->field(options));
  }
}

void OptionValues::apply(OdometryOptions& options) const {
  TunedOptions all;
  all.odometry = options;
  apply_group("odometry", all);
  options = all.odometry;
}

void OptionValues::apply(RelocalizerOptions& options) const {
  TunedOptions all;
  all.relocaliser = options;
  apply_group("relocaliser", all);
  options = all.relocaliser;
}

void OptionValues::apply(TrainerOptions& options) const {
  TunedOptions all;
  all.train = options;
  apply_group("train", all);
  options = all.train;
}

void OptionValues::apply(InitializeOptions& options) const {
  TunedOptions all;
  all.start = options;
  apply_group("train", all);
  options = all.start;
}

std::string options_table() {
  std::string text;
  for (const PublicOption& option : public_options()) {
    text += formatted("%-30s %-10s %-14s %s\n    %s\n", option.name.c_str(), option.default_text().c_str(),
                      range_text(option).c_str(), option.unit.c_str(), option.meaning.c_str());
  }
  return text;
}

std::string options_markdown() {
  std::string text =
      "# Options\n\n"
      "`odosplat options` prints these. `--set NAME=VALUE` sets one, as often as needed; in a `--config` file a line\n"
      "`NAME = VALUE` does, or `KEY = VALUE` below a table `[odometry.window]`. `track` takes `odometry.*` and\n"
      "`relocaliser.*`, `relocalise` takes `relocaliser.*`, `train` takes `train.*` (defaults: those of\n"
      "`--preset default`; `--preset paper` has its own). What has a flag of its own (`--help`) is not repeated here.\n"
      "This page is `odosplat options --markdown`.\n\n"
      "| option | default | range | unit | meaning |\n|---|---|---|---|---|\n";
  for (const PublicOption& option : public_options()) {
    text += "| `" + option.name + "` | " + option.default_text() + " | " + range_text(option) + " | " + option.unit +
            " | " + option.meaning + " |\n";
  }
  return text;
}

}  // namespace odosplat::apps
