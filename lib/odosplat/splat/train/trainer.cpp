// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/trainer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>

#include "kernels/constants.h"
#include "odosplat/core/checksum.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/train/view_lengths.hpp"

namespace odosplat {

namespace {

/// Median over the Gaussians of the longest standard deviation [m].
double median_size(const Gaussians& gaussians) {
  std::vector<float> size(gaussians.size());
  for (std::size_t i = 0; i < size.size(); ++i)
    size[i] = *std::max_element(gaussians.log_scales.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                gaussians.log_scales.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
  return std::exp(static_cast<double>(upper_median(std::move(size))));
}

double log_linear(double first, double last, double share) { return first * std::pow(last / first, share); }

void check_input(const Gaussians& initial, const TrainingViews& views) {
  initial.check();
  if (initial.empty()) throw InputError("training", "there are no Gaussians to train");
  if (views.count() == 0) throw InputError("training", "there are no images to train on");
  for (int i = 0; i < views.count(); ++i) {
    views.camera(i).check();
    if (!views.T_world_camera(i).is_finite())
      throw InputError("training", "view " + std::to_string(i), "its pose is not finite");
  }
}

/// A mean over those values that are known (not negative).
double mean_of_known(const std::vector<double>& values) {
  double sum = 0.0;
  int known = 0;
  for (const double value : values) {
    if (value < 0.0) continue;
    sum += value;
    ++known;
  }
  return known > 0 ? sum / known : 0.0;
}

std::string checksum_of_start(const Gaussians& initial, const TrainingViews& views) {
  Checksum sum;
  for (const auto* part :
       {&initial.positions, &initial.log_scales, &initial.rotations, &initial.opacity_logits, &initial.sh})
    sum.add(part->data(), part->size() * sizeof(float));
  for (int i = 0; i < views.count(); ++i) {
    const Eigen::Matrix4d pose = views.T_world_camera(i).matrix();
    const Camera camera = views.camera(i);
    sum.add(pose.data(), sizeof(double) * 16);
    const double numbers[6] = {static_cast<double>(camera.width),
                               static_cast<double>(camera.height),
                               camera.fx,
                               camera.fy,
                               camera.cx,
                               camera.cy};
    sum.add(numbers, sizeof(numbers));
  }
  std::ostringstream text;
  text << views.count() << " views, " << initial.size() << " Gaussians, checksum " << std::hex << sum.value();
  return text.str();
}

}  // namespace

Trainer::Trainer(const compute::Context& context, const TrainerOptions& options, const Gaussians& initial,
                 TrainingViews& views, MapView* surface)
    : options_((options.check(), check_input(initial, views), options)),
      context_(context),
      views_(views),
      targets_(context, views, options.depth.weight > 0.0 ? surface : nullptr, options.depth_cache_mb << 20U),
      rasterizer_(context, options.rasterizer),
      loss_(context, options.loss),
      depth_loss_(context, options.depth),
      surface_terms_(context, options.surface),
      exposures_(context, options.exposure, views.count()),
      positions_(context, options.adam, 3, 3, 0.0F),
      log_scales_(context, options.adam, 3, options.keep_thickness ? 2 : 3, 0.0F),
      rotations_(context, options.adam, 4, 4, 0.0F),
      opacity_logits_(context, options.adam, 1, 1, 0.0F),
      sh_(context, options.adam, 3 * initial.coefficients(), 3,
          options.color_rate > 0.0 ? static_cast<float>(options.sh_rate / options.color_rate) : 0.0F),
      screen_statistics_(compute::Program(context, {"screen_statistics.cl"}).kernel("screen_statistics", "densify")),
      position_length_(options.position_length == PositionLength::gaussian_size ? median_size(initial)
                                                                                : camera_extent(views)),
      densify_sizes_(densify_sizes(options.densify, camera_extent(views), pixel_width(initial, views),
                                   options.largest_growth > 0.0)),
      start_(checksum_of_start(initial, views)),
      psnr_db_(static_cast<std::size_t>(views.count()), -1.0),
      depth_errors_(static_cast<std::size_t>(views.count()), -1.0) {
  gaussians_.upload(context_, initial);
  if (options_.largest_growth > 0.0) {
    std::vector<float> bound = initial.log_scales;
    for (float& log_scale : bound) log_scale += static_cast<float>(std::log(options_.largest_growth));
    largest_log_scales_ = compute::Buffer<float>(context_, bound);
  }
  if (options_.surface.any()) anchors_ = compute::Buffer<float>(context_, surface_anchors(initial));
  if (options_.densify.method == DensifyMethod::split) {
    pulls_ = compute::Buffer<float>(context_, std::vector<float>(initial.size(), 0.0F));
    seen_ = compute::Buffer<float>(context_, std::vector<float>(initial.size(), 0.0F));
  }
}

int Trainer::level_at(int iteration) const {
  const auto coarse_steps = std::lround(static_cast<double>(options_.coarse_share) * options_.iterations);
  if (options_.coarse_levels == 0 || iteration >= coarse_steps) return 0;
  return options_.coarse_levels -
         static_cast<int>(options_.coarse_levels * static_cast<long>(iteration) / coarse_steps);
}

int Trainer::view_at(int iteration) {
  const int count = views_.count();
  if (iteration / count != round_) {
    // The order follows from seed and round alone, so a run can be taken up at any iteration.
    round_ = iteration / count;
    Random random(options_.seed + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(round_ + 1));
    order_.resize(static_cast<std::size_t>(count));
    std::iota(order_.begin(), order_.end(), 0);
    for (std::size_t i = order_.size(); i > 1; --i)
      std::swap(order_[i - 1], order_[random.below(static_cast<std::uint32_t>(i))]);
  }
  return order_[static_cast<std::size_t>(iteration % count)];
}

TrainingStep Trainer::step() {
  if (done()) return last_;
  const auto start = std::chrono::steady_clock::now();
  const int view = view_at(iteration_);
  const int level = level_at(iteration_);
  targets_.load(view, level);
  const Camera& camera = targets_.camera();

  RenderRequest request;
  request.color = true;
  request.depth = with_depth();
  request.sh_degree = options_.sh_interval == 0 ? gaussians_.sh_degree
                                                : std::min(gaussians_.sh_degree, iteration_ / options_.sh_interval);
  rasterizer_.forward(gaussians_, camera, views_.T_world_camera(view), request, rendered_);
  if (exposures_.on()) exposures_.apply(view, rendered_.color, exposed_);
  loss_.evaluate(exposures_.on() ? exposed_ : rendered_.color, targets_.color(), camera.width, camera.height,
                 image_gradients_.color);
  if (exposures_.on()) exposures_.backward(view, rendered_.color, camera.width, camera.height, image_gradients_.color);
  if (with_depth())
    depth_loss_.evaluate(rendered_.depth, targets_.depth(), targets_.depth_weight(), camera.width, camera.height,
                         image_gradients_.depth);
  rasterizer_.backward(gaussians_, image_gradients_, gradients_);
  if (!anchors_.empty()) surface_terms_.add(gaussians_, anchors_, gradients_);
  update();
  ++iteration_;
  last_ = {iteration_, view, level, loss_.value(), with_depth() ? depth_loss_.mean_relative_error() : 0.0};
  if (level == 0) {
    psnr_db_[static_cast<std::size_t>(view)] = last_.value.psnr_db();
    if (with_depth()) depth_errors_[static_cast<std::size_t>(view)] = last_.depth_error;
  }
  guard_.add(iteration_, level, last_.value.psnr_db());
  if (iteration_ % TrainingGuard::interval == 0 || done()) guard();
  if (densifies()) densify();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return last_;
}

void Trainer::guard() {
  const TrainingGuard::Verdict verdict = guard_.judge(done());
  log_debug("step " + std::to_string(iteration_) + ": mean PSNR " + std::to_string(guard_.last_db()) + " dB, " +
            std::to_string(gaussians_.size()) + " Gaussians");
  if (verdict == TrainingGuard::Verdict::best) best_ = state();
  if (verdict != TrainingGuard::Verdict::fallen) return;
  const int fallen_at = iteration_;
  const bool densified =
      undone_ == 0 && options_.densify.method != DensifyMethod::none && fallen_at > options_.densify.from;
  set_state(best_);
  guard_.went_back();
  ++undone_;
  // Without densification the same steps would give the same result again.
  ended_early_ = !densified || iteration_ > options_.densify.until_share * options_.iterations;
  log_warning(formatted("training fell from %.1f to %.1f dB by step %d: restored to step %d", guard_.best_db(),
                        guard_.last_db(), fallen_at, iteration_) +
              (ended_early_ ? ", where training ends" : ", from where training goes on without densification"));
}

void Trainer::update() {
  const double share = options_.iterations > 1 ? static_cast<double>(iteration_) / (options_.iterations - 1) : 0.0;
  const double fade = log_linear(1.0, options_.final_share, share);
  if (options_.position_rate > 0.0)
    positions_.step(gaussians_.positions, gradients_.positions,
                    position_length_ * log_linear(options_.position_rate, options_.position_rate_final, share));
  log_scales_.step(gaussians_.log_scales, gradients_.log_scales, fade * options_.scale_rate);
  if (!largest_log_scales_.empty()) log_scales_.limit(gaussians_.log_scales, largest_log_scales_);
  if (options_.rotation_rate > 0.0)
    rotations_.step(gaussians_.rotations, gradients_.rotations, fade * options_.rotation_rate);
  opacity_logits_.step(gaussians_.opacity_logits, gradients_.opacity_logits, fade * options_.opacity_rate);
  sh_.step(gaussians_.sh, gradients_.sh, fade * options_.color_rate);
  if (!pulls_.empty()) {
    const float scale = 0.5F * static_cast<float>(std::max(targets_.camera().width, targets_.camera().height));
    screen_statistics_(compute::Range::linear(gaussians_.size(), ITEM_GROUP),
                       static_cast<std::int32_t>(gaussians_.size()), rasterizer_.tile_counts(),
                       rasterizer_.screen_gradients(), scale, pulls_, seen_);
  }
}

bool Trainer::densifies() const {
  const DensifyOptions& d = options_.densify;
  if (undone_ > 0 || ended_early_) return false;
  return d.method != DensifyMethod::none && iteration_ >= d.from && iteration_ % d.interval == 0 &&
         iteration_ <= d.until_share * options_.iterations;
}

void Trainer::densify() {
  const DensifyOptions& d = options_.densify;
  // After a reset the opacities mean nothing until every view had its turn (as in the public trainers).
  const bool settled = d.reset_interval == 0 || iteration_ % d.reset_interval > views_.count() + 100;
  Random random(options_.seed ^ (0xd1342543de82ef95ULL * static_cast<std::uint64_t>(iteration_)));
  if (settled || d.method == DensifyMethod::relocate) {
    TrainingRows rows{gaussians_.download(), largest_log_scales_.download(), anchors_.download(), {}};
    rows.from.resize(rows.size());
    std::iota(rows.from.begin(), rows.from.end(), std::int64_t{0});
    if (d.method == DensifyMethod::relocate)
      relocate(rows, d, random);
    else
      clone_and_split(rows, d, densify_sizes_, pulls_.download(), seen_.download(), random);
    gaussians_.upload(context_, rows.gaussians);
    if (!largest_log_scales_.empty()) largest_log_scales_ = compute::Buffer<float>(context_, rows.largest_log_scales);
    if (!anchors_.empty()) anchors_ = compute::Buffer<float>(context_, rows.anchors);
    for (Adam* optimiser : optimisers()) optimiser->rearrange(rows.from);
    if (!pulls_.empty()) {
      pulls_ = compute::Buffer<float>(context_, std::vector<float>(rows.size(), 0.0F));
      seen_ = compute::Buffer<float>(context_, std::vector<float>(rows.size(), 0.0F));
    }
  }
  if (d.method == DensifyMethod::split && d.reset_interval > 0 && iteration_ > d.reset_interval &&
      iteration_ % d.reset_interval < d.interval) {
    reset_opacities();
    guard_.pause(iteration_ + d.reset_interval / 2);
  }
}

void Trainer::reset_opacities() {
  const double opacity = options_.densify.reset_opacity;
  const auto highest = static_cast<float>(std::log(opacity / (1.0 - opacity)));
  std::vector<float> logits = gaussians_.opacity_logits.download();
  for (float& logit : logits) logit = std::min(logit, highest);
  gaussians_.opacity_logits.upload(logits);
  opacity_logits_.rearrange(std::vector<std::int64_t>(logits.size(), -1));
}

std::vector<Adam*> Trainer::optimisers() { return {&positions_, &log_scales_, &rotations_, &opacity_logits_, &sh_}; }

TrainingReport Trainer::report() const {
  TrainingReport report;
  report.iterations = iteration_;
  report.gaussians = gaussians_.size();
  report.seconds = seconds_;
  report.iterations_per_second = seconds_ > 0.0 ? iteration_ / seconds_ : 0.0;
  report.psnr_db = mean_of_known(psnr_db_);
  report.depth_error = mean_of_known(depth_errors_);
  report.undone = undone_;
  return report;
}

}  // namespace odosplat
