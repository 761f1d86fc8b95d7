// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// What a run of training keeps in a checkpoint, and how it goes on from there.
#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/trainer.hpp"

namespace odosplat {

namespace {

// Names of the optimisers' entries, in the order of Trainer::optimisers().
const char* const optimiser_names[] = {"positions", "log_scales", "rotations", "opacity_logits", "sh"};

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
  Checkpoint c;
  c.put_text("settings", fingerprint());
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
  const auto progress = c.get<std::int64_t>("progress");
  const auto last = c.get<double>("last");
  Gaussians g;
  g.sh_degree = gaussians_.sh_degree;
  g.positions = c.get<float>("gaussians/positions");
  g.log_scales = c.get<float>("gaussians/log_scales");
  g.rotations = c.get<float>("gaussians/rotations");
  g.opacity_logits = c.get<float>("gaussians/opacity_logits");
  g.sh = c.get<float>("gaussians/sh");
  g.check();
  const auto psnr = c.get<double>("psnr_db");
  const auto depth_errors = c.get<double>("depth_errors");
  require(progress.size() == 3 && last.size() == 6 && psnr.size() == psnr_db_.size() &&
              depth_errors.size() == depth_errors_.size(),
          "checkpoint", "of this version of odosplat");
  gaussians_.upload(context_, g);
  exposures_.set_state(c.get<double>("exposures"));
  const auto restore = [&](compute::Buffer<float>& buffer, const char* name, std::size_t row) {
    const auto values = c.get<float>(name);
    if (buffer.empty()) return;
    require(values.size() == row * g.size(), name, "of one row a Gaussian");
    buffer = compute::Buffer<float>(context_, values);
  };
  restore(largest_log_scales_, "largest_log_scales", 3);
  restore(anchors_, "anchors", 8);
  restore(pulls_, "pulls", 1);
  restore(seen_, "seen", 1);
  const std::vector<Adam*> adams = optimisers();
  for (std::size_t i = 0; i < adams.size(); ++i) {
    const std::string name = std::string("adam/") + optimiser_names[i];
    const auto steps = c.get<std::int64_t>(name + "/steps");
    require(steps.size() == 1, name, "one number of steps");
    adams[i]->set_state({c.get<float>(name + "/first"), c.get<float>(name + "/second"), static_cast<long>(steps[0])});
  }
  psnr_db_ = psnr;
  depth_errors_ = depth_errors;
  iteration_ = static_cast<int>(progress[0]);
  round_ = -1;
  last_ = {iteration_, static_cast<int>(progress[1]), static_cast<int>(progress[2]), {}, last[4]};
  last_.value = {last[0], last[1], last[2], last[3]};
  seconds_ = last[5];
}

}  // namespace odosplat
