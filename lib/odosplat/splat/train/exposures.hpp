// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <vector>

#include "odosplat/compute/program.hpp"

namespace odosplat {

struct ExposureOptions {
  double rate = 0.0;        // Adam rate of gains and offsets per step, >= 0; 0: every image has the map's own exposure
  double steadiness = 0.1;  // weight of the mean of (gain - 1)^2 and offset^2, >= 0: keeps the map's brightness from
                            // drifting

  /// Throws InputError naming the field.
  void check() const;
};

/// Exposure of every training image: channel c is gain_c * rendered + offset_c, trained with the map, so that the
/// automatic exposure of a camera does not become part of the map's colours. Source: the exposure compensation of Kerbl
/// et al.'s later code and of MonoGS (Matsuki et al. 2024), an affine map per image. Gradients are taken on the device
/// in a fixed order, steps (Adam) on the host. Not thread safe.
class Exposures {
 public:
  static constexpr std::size_t settings = 6;  // gains of R G B, offsets of R G B

  Exposures(const compute::Context& context, const ExposureOptions& options, int views);

  bool on() const { return options_.rate > 0.0; }
  /// rendered [3 x H x W] as view's camera would have taken it. Queued.
  void apply(int view, const compute::Buffer<float>& rendered, compute::Buffer<float>& exposed);
  /// Turns gradient [3 x H x W] by the exposed image into the one by `rendered`, and makes a step of the view's
  /// settings. Waits.
  void backward(int view, const compute::Buffer<float>& rendered, int width, int height,
                compute::Buffer<float>& gradient);
  /// Gains and offsets of a view.
  std::array<double, settings> of(int view) const;

  /// All that a checkpoint needs: per view settings, both moments, steps. check_state and set_state throw InputError
  /// for another size and for numbers that a run of so many iterations cannot have: means of squares that are negative,
  /// or steps of all views that do not add up to one per iteration.
  const std::vector<double>& state() const { return state_; }
  void check_state(const std::vector<double>& state, int iterations) const;
  void set_state(const std::vector<double>& state, int iterations);

 private:
  static constexpr std::size_t row = 3 * settings + 1;
  std::array<float, 8> kernel_settings(int view) const;

  ExposureOptions options_;
  compute::Context context_;
  compute::Kernel expose_, backward_;
  std::vector<double> state_;  // [views x row]
  compute::Buffer<float> rows_;
};

}  // namespace odosplat
