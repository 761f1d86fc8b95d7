// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/trainer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {

namespace {

/// Median over the Gaussians of the longest standard deviation [m].
double median_size(const Gaussians& gaussians) {
  std::vector<float> size(gaussians.size());
  for (std::size_t i = 0; i < size.size(); ++i)
    size[i] = *std::max_element(gaussians.log_scales.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                gaussians.log_scales.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  return std::exp(static_cast<double>(*middle));
}

/// Largest distance of a camera from the mean of all [m]; 1 where all stand in one place.
double camera_extent(const TrainingViews& views) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < views.count(); ++i) mean += views.T_world_camera(i).translation() / views.count();
  double extent = 0.0;
  for (int i = 0; i < views.count(); ++i)
    extent = std::max(extent, (views.T_world_camera(i).translation() - mean).norm());
  return extent > 0.0 ? extent : 1.0;
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
  add("color_term", loss.color_term == ColorTerm::l1 ? "l1" : "squared_l2");
  add("dilation", rasterizer.dilation);
  add("compensated", rasterizer.compensated ? 1 : 0);
  return lines;
}

TrainerOptions TrainerOptions::preset(const std::string& name) {
  TrainerOptions options;
  if (name == "default") return options;
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
  return options;
}

Trainer::Trainer(const compute::Context& context, const TrainerOptions& options, const Gaussians& initial,
                 TrainingViews& views)
    : options_((options.check(), check_input(initial, views), options)),
      context_(context),
      views_(views),
      rasterizer_(context, options.rasterizer),
      loss_(context, options.loss),
      positions_(context, options.adam, 3, 3, 0.0F),
      log_scales_(context, options.adam, 3, options.keep_thickness ? 2 : 3, 0.0F),
      rotations_(context, options.adam, 4, 4, 0.0F),
      opacity_logits_(context, options.adam, 1, 1, 0.0F),
      sh_(context, options.adam, 3 * initial.coefficients(), 3,
          options.color_rate > 0.0 ? static_cast<float>(options.sh_rate / options.color_rate) : 0.0F),
      position_length_(options.position_length == PositionLength::gaussian_size ? median_size(initial)
                                                                                : camera_extent(views)),
      psnr_db_(static_cast<std::size_t>(views.count()), 0.0),
      psnr_known_(static_cast<std::size_t>(views.count()), false) {
  gaussians_.upload(context_, initial);
  if (options_.largest_growth > 0.0) {
    std::vector<float> bound = initial.log_scales;
    for (float& log_scale : bound) log_scale += static_cast<float>(std::log(options_.largest_growth));
    largest_log_scales_ = compute::Buffer<float>(context_, bound);
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

void Trainer::load_target(int view, int level) {
  ColorImage image = views_.color(view);
  camera_ = views_.camera(view);
  if (image.cols != camera_.width || image.rows != camera_.height)
    throw InputError("training", "view " + std::to_string(view),
                     "its image is " + std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                         ", its camera " + std::to_string(camera_.width) + " x " + std::to_string(camera_.height));
  for (int l = 0; l < level && std::min(image.cols, image.rows) >= 2; ++l) {
    image = halve(image);
    camera_ = camera_.level(1);
  }
  const auto plane = static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.rows);
  planes_.resize(3 * plane);
  bool finite = true;
  for (int y = 0; y < image.rows; ++y) {
    const cv::Vec3f* row = image[y];
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols);
    for (int x = 0; x < image.cols; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = row[x][static_cast<int>(c)];
        finite = finite && std::isfinite(value);
        planes_[c * plane + begin + static_cast<std::size_t>(x)] = value;
      }
    }
  }
  if (!finite)
    throw InputError("training", "view " + std::to_string(view), "its image holds values that are not finite");
  target_.resize(context_, planes_.size());
  target_.upload(planes_);
}

TrainingStep Trainer::step() {
  if (done()) return last_;
  const auto start = std::chrono::steady_clock::now();
  const int view = view_at(iteration_);
  const int level = level_at(iteration_);
  load_target(view, level);

  RenderRequest request;
  request.color = true;
  request.depth = false;
  request.sh_degree = options_.sh_interval == 0 ? gaussians_.sh_degree
                                                : std::min(gaussians_.sh_degree, iteration_ / options_.sh_interval);
  rasterizer_.forward(gaussians_, camera_, views_.T_world_camera(view), request, rendered_);
  loss_.evaluate(rendered_.color, target_, camera_.width, camera_.height, image_gradients_.color);
  rasterizer_.backward(gaussians_, image_gradients_, gradients_);
  update();
  ++iteration_;

  last_ = {iteration_, view, level, loss_.value()};
  if (level == 0) {
    psnr_db_[static_cast<std::size_t>(view)] = last_.value.psnr_db();
    psnr_known_[static_cast<std::size_t>(view)] = true;
  }
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return last_;
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
}

TrainingReport Trainer::report() const {
  TrainingReport report;
  report.iterations = iteration_;
  report.gaussians = gaussians_.size();
  report.seconds = seconds_;
  report.iterations_per_second = seconds_ > 0.0 ? iteration_ / seconds_ : 0.0;
  double sum = 0.0;
  int known = 0;
  for (std::size_t i = 0; i < psnr_db_.size(); ++i) {
    if (!psnr_known_[i]) continue;
    sum += psnr_db_[i];
    ++known;
  }
  report.psnr_db = known > 0 ? sum / known : 0.0;
  return report;
}

}  // namespace odosplat
