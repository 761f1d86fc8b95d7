// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// What a run of training keeps in a checkpoint, and how it goes on from there.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/train/trainer.hpp"

namespace odosplat {

namespace {

// Names of the optimisers' entries, in the order of Trainer::optimisers().
const char* const optimiser_names[] = {"positions", "log_scales", "rotations", "opacity_logits", "sh"};

const std::string best_prefix = "best/";  // entries of the state that the guard goes back to

bool within(std::int64_t value, std::int64_t least, std::int64_t most) { return value >= least && value <= most; }

template <typename T>
bool all_finite(const std::vector<T>& values) {
  return std::all_of(values.begin(), values.end(), [](T v) { return std::isfinite(v); });
}

bool none_negative(const std::vector<float>& values) {
  return std::none_of(values.begin(), values.end(), [](float v) { return v < 0.0F; });
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::string Trainer::fingerprint() const {
  std::string text;
  for (const std::string& line : options_.describe()) text += line + "\n";
  return text + start_ + "\n";
}

Checkpoint Trainer::checkpoint() const {
  Checkpoint c = state();
  c.put_text("settings", fingerprint());
  c.put("guard", guard_.state());
  c.put("undone", std::vector<std::int64_t>{undone_, ended_early_ ? 1 : 0});
  c.put_all(best_prefix, best_);
  return c;
}

Checkpoint Trainer::state() const {
  Checkpoint c;
  c.put("progress", std::vector<std::int64_t>{iteration_, last_.view, last_.level});
  c.put("last", std::vector<double>{last_.value.loss, last_.value.l1, last_.value.mse, last_.value.ssim,
                                    last_.depth_error, seconds_});
  c.put("psnr_db", psnr_db_);
  c.put("depth_errors", depth_errors_);
  c.put("exposures", exposures_.state());
  const Gaussians g = gaussians_.download();
  c.put("gaussians/positions", g.positions);
  c.put("gaussians/log_scales", g.log_scales);
  c.put("gaussians/rotations", g.rotations);
  c.put("gaussians/opacity_logits", g.opacity_logits);
  c.put("gaussians/sh", g.sh);
  c.put("largest_log_scales", largest_log_scales_.download());
  c.put("anchors", anchors_.download());
  c.put("pulls", pulls_.download());
  c.put("seen", seen_.download());
  const Adam* adams[] = {&positions_, &log_scales_, &rotations_, &opacity_logits_, &sh_};
  for (std::size_t i = 0; i < std::size(adams); ++i) {
    const std::string name = std::string("adam/") + optimiser_names[i];
    const Adam::State state = adams[i]->state();
    c.put(name + "/first", state.first);
    c.put(name + "/second", state.second);
    c.put(name + "/steps", std::vector<std::int64_t>{state.steps});
  }
  return c;
}

void Trainer::resume(const Checkpoint& c) {
  const std::vector<std::string> theirs = lines_of(c.get_text("settings"));
  const std::vector<std::string> ours = lines_of(fingerprint());
  const auto [a, b] = std::mismatch(theirs.begin(), theirs.end(), ours.begin(), ours.end());
  if (a != theirs.end() || b != ours.end())
    throw InputError("checkpoint", "was written by another run: it has \"" + (a != theirs.end() ? *a : "nothing") +
                                       "\", this run has \"" + (b != ours.end() ? *b : "nothing") + "\"");
  const auto undone = c.get<std::int64_t>("undone");
  require(undone.size() == 2 && within(undone[0], 0, options_.iterations) && within(undone[1], 0, 1), "undone",
          "two counts that a run can have");
  Checkpoint best = c.behind(best_prefix);
  const auto guard = c.get<double>("guard");
  guard_.set_state(guard);
  const double most_levels = options_.coarse_levels;
  require(guard[0] <= most_levels && guard[3] <= most_levels && guard[1] <= 2 * TrainingGuard::interval, "guard",
          "the state of a guard of this run");
  if (!best.empty()) set_state(best);  // refuses a damaged one before it is needed
  set_state(c);
  best_ = std::move(best);
  undone_ = static_cast<int>(undone[0]);
  ended_early_ = undone[1] == 1;
}

void Trainer::set_state(const Checkpoint& c) {
  const auto progress = c.get<std::int64_t>("progress");
  const auto last = c.get<double>("last");
  const auto psnr = c.get<double>("psnr_db");
  const auto depth_errors = c.get<double>("depth_errors");
  require(progress.size() == 3 && last.size() == 6 && psnr.size() == psnr_db_.size() &&
              depth_errors.size() == depth_errors_.size(),
          "checkpoint", "of this version of odosplat");
  require(within(progress[0], 0, options_.iterations) && within(progress[1], 0, views_.count() - 1) &&
              within(progress[2], 0, options_.coarse_levels),
          "progress", "iteration, view and level of this run");
  const auto known = [](double error) { return error >= 0.0 || error == -1.0; };  // -1: not yet
  require(all_finite(psnr) && all_finite(depth_errors) && last[5] >= 0.0 &&
              std::all_of(depth_errors.begin(), depth_errors.end(), known),
          "last", "numbers that a run can have");
  const auto iterations = static_cast<int>(progress[0]);
  const auto exposures = c.get<double>("exposures");
  exposures_.check_state(exposures, iterations);
  Gaussians g;
  g.sh_degree = gaussians_.sh_degree;
  g.positions = c.get<float>("gaussians/positions");
  g.log_scales = c.get<float>("gaussians/log_scales");
  g.rotations = c.get<float>("gaussians/rotations");
  g.opacity_logits = c.get<float>("gaussians/opacity_logits");
  g.sh = c.get<float>("gaussians/sh");
  g.check();
  require(!g.empty(), "gaussians", "at least one");
  for (const auto* part : {&g.positions, &g.log_scales, &g.rotations, &g.opacity_logits, &g.sh})
    require(all_finite(*part), "gaussians", "finite");
  const auto rows_of = [&](const std::string& name, std::size_t row, bool wanted) {
    auto values = c.get<float>(name);
    require(values.size() == (wanted ? row * g.size() : 0) && all_finite(values), name,
            "finite, one row a Gaussian where the run has them");
    return values;
  };
  struct Rows {
    compute::Buffer<float>* buffer;
    std::vector<float> values;
  };
  std::vector<Rows> rows;
  rows.push_back({&largest_log_scales_, rows_of("largest_log_scales", 3, !largest_log_scales_.empty())});
  rows.push_back({&anchors_, rows_of("anchors", 8, !anchors_.empty())});
  rows.push_back({&pulls_, rows_of("pulls", 1, !pulls_.empty())});
  rows.push_back({&seen_, rows_of("seen", 1, !seen_.empty())});
  for (std::size_t i = 2; i < rows.size(); ++i) {
    require(none_negative(rows[i].values), i == 2 ? "pulls" : "seen", "at least 0");
    require(i == 2 || std::all_of(rows[i].values.begin(), rows[i].values.end(),
                                  [&](float v) { return v == std::floor(v) && v <= static_cast<float>(iterations); }),
            "seen", "numbers of iterations of this run");
  }
  const std::vector<Adam*> adams = optimisers();
  const auto is_on = [&](std::size_t i) {
    if (adams[i] == &positions_) return options_.position_rate > 0.0;
    return adams[i] != &rotations_ || options_.rotation_rate > 0.0;
  };
  std::vector<Adam::State> moments;
  for (std::size_t i = 0; i < adams.size(); ++i) {
    const std::string name = std::string("adam/") + optimiser_names[i];
    const auto steps = c.get<std::int64_t>(name + "/steps");
    // An optimiser whose rate is zero never steps, the others step in every iteration.
    const bool stepped = is_on(i) && iterations > 0;
    require(steps.size() == 1 && steps[0] == (stepped ? iterations : 0), name + "/steps",
            "the number of iterations, " + std::to_string(stepped ? iterations : 0));
    const auto row = static_cast<std::size_t>(adams[i]->stride());
    const auto second = rows_of(name + "/second", row, stepped);
    require(none_negative(second), name + "/second", "means of squares, which are not negative");
    moments.push_back({rows_of(name + "/first", row, stepped), second, static_cast<long>(steps[0])});
  }
  exposures_.set_state(exposures, iterations);
  gaussians_.upload(context_, g);
  for (const Rows& part : rows)
    if (!part.buffer->empty()) *part.buffer = compute::Buffer<float>(context_, part.values);
  for (std::size_t i = 0; i < adams.size(); ++i) adams[i]->set_state(moments[i]);
  psnr_db_ = psnr;
  depth_errors_ = depth_errors;
  iteration_ = iterations;
  round_ = -1;
  last_ = {iteration_, static_cast<int>(progress[1]), static_cast<int>(progress[2]), {}, last[4]};
  last_.value = {last[0], last[1], last[2], last[3]};
  seconds_ = std::max(seconds_, last[5]);
}

}  // namespace odosplat
