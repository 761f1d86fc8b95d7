// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace odosplat::reference {

/// A number with its derivatives by N inputs (forward-mode differentiation), so that the reference's projection needs
/// no separately derived gradient.
template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> d{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: constants convert
  static Dual input(double v, std::size_t index) {
    Dual x(v);
    x.d[index] = 1.0;
    return x;
  }
  /// f(x) from f and f' at x.
  Dual chain(double f, double slope) const {
    Dual y(f);
    for (std::size_t i = 0; i < N; ++i) y.d[i] = slope * d[i];
    return y;
  }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual y(a.value + b.value);
    for (std::size_t i = 0; i < N; ++i) y.d[i] = a.d[i] + b.d[i];
    return y;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual y(a.value - b.value);
    for (std::size_t i = 0; i < N; ++i) y.d[i] = a.d[i] - b.d[i];
    return y;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual y(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i) y.d[i] = a.d[i] * b.value + a.value * b.d[i];
    return y;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual y(a.value / b.value);
    for (std::size_t i = 0; i < N; ++i) y.d[i] = (a.d[i] - y.value * b.d[i]) / b.value;
    return y;
  }
  Dual operator-() const { return chain(-value, -1.0); }
  friend Dual exp(const Dual& x) { return x.chain(std::exp(x.value), std::exp(x.value)); }
  friend Dual log(const Dual& x) { return x.chain(std::log(x.value), 1.0 / x.value); }
  friend Dual sqrt(const Dual& x) { return x.chain(std::sqrt(x.value), 0.5 / std::sqrt(x.value)); }
};

}  // namespace odosplat::reference
