// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/adam.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {
constexpr std::size_t lanes = 16;  // elements of a work-item of adam.cl
}

void AdamOptions::check() const {
  require(beta1 >= 0.0F && beta1 < 1.0F, "beta1", "in 0..1");
  require(beta2 >= 0.0F && beta2 < 1.0F, "beta2", "in 0..1");
  require(epsilon > 0.0F, "epsilon", "positive");
}

Adam::Adam(const compute::Context& context, const AdamOptions& options, int stride, int head, float rest_ratio)
    : options_((options.check(), options)),
      context_(context),
      program_(context, {"adam.cl"}),
      step_kernel_(program_.kernel("adam_step", "adam")),
      limit_kernel_(program_.kernel("limit_above", "adam")),
      stride_(stride) {
  require(stride >= 1, "stride", "at least 1");
  require(head >= 0 && head <= stride, "head", "in 0..stride");
  require(rest_ratio >= 0.0F, "rest_ratio", "at least 0");
  std::vector<float> pattern(static_cast<std::size_t>(stride) + lanes);
  for (std::size_t i = 0; i < pattern.size(); ++i)
    pattern[i] = i % static_cast<std::size_t>(stride) < static_cast<std::size_t>(head) ? 1.0F : rest_ratio;
  pattern_ = compute::Buffer<float>(context, pattern);
}

void Adam::step(compute::Buffer<float>& parameters, const compute::Buffer<float>& gradients, double rate) {
  if (parameters.size() != first_.size() || steps_ == 0) {
    first_.resize(context_, parameters.size());
    second_.resize(context_, parameters.size());
    first_.fill_zero();
    second_.fill_zero();
    steps_ = 0;
  }
  ++steps_;
  const double t = static_cast<double>(steps_);
  const double bias1 = 1.0 - std::pow(static_cast<double>(options_.beta1), t);
  const double bias2 = 1.0 - std::pow(static_cast<double>(options_.beta2), t);
  step_kernel_(compute::Range::linear((parameters.size() + lanes - 1) / lanes, 16), parameters, gradients, first_,
               second_, pattern_, static_cast<std::uint32_t>(parameters.size()), static_cast<std::uint32_t>(stride_),
               static_cast<float>(rate), options_.beta1, options_.beta2, static_cast<float>(1.0 / bias1),
               static_cast<float>(1.0 / std::sqrt(bias2)), options_.epsilon);
}

Adam::State Adam::state() const {
  if (steps_ == 0) return {};
  return {first_.download(), second_.download(), steps_};
}

void Adam::set_state(const State& state) {
  require(state.first.size() == state.second.size(), "moments", "of one size");
  steps_ = state.steps;
  first_ = compute::Buffer<float>(context_, state.first);
  second_ = compute::Buffer<float>(context_, state.second);
}

void Adam::rearrange(const std::vector<std::int64_t>& from) {
  if (steps_ == 0) return;
  const auto stride = static_cast<std::size_t>(stride_);
  const State old = state();
  State moved{std::vector<float>(stride * from.size(), 0.0F), std::vector<float>(stride * from.size(), 0.0F), steps_};
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] < 0) continue;
    for (std::size_t k = 0; k < stride; ++k) {
      const std::size_t source = static_cast<std::size_t>(from[i]) * stride + k;
      moved.first[i * stride + k] = old.first.at(source);
      moved.second[i * stride + k] = old.second.at(source);
    }
  }
  set_state(moved);
}

void Adam::limit(compute::Buffer<float>& parameters, const compute::Buffer<float>& bound) {
  require(bound.size() == parameters.size(), "bound", "as large as the parameters");
  limit_kernel_(compute::Range::linear((parameters.size() + lanes - 1) / lanes, 16), parameters, bound,
                static_cast<std::uint32_t>(parameters.size()));
}

}  // namespace odosplat
