// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/ticks.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

std::string fixed(double value, int decimals) {
  std::string text = formatted("%.*f", std::clamp(decimals, 0, 12), value);
  // Removes the sign of a negative number that was rounded to zero ("-0.0").
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) return text.substr(1);
  return text;
}

}  // namespace

LengthUnit length_unit(double largest) {
  if (!std::isfinite(largest) || largest <= 0.0) return {};
  if (largest < 1e-4) return {1e6, "um"};
  if (largest < 0.03) return {1e3, "mm"};
  if (largest < 3.0) return {1e2, "cm"};
  if (largest < 3e3) return {};
  return {1e-3, "km"};
}

std::vector<double> nice_ticks(double low, double high, int max_count) {
  if (!std::isfinite(low) || !std::isfinite(high) || !(high > low)) return {low};
  const int count = std::max(max_count, 2);
  double power = std::pow(10.0, std::floor(std::log10((high - low) / count)));
  while (true) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = factor * power;
      const double first = std::ceil(low / step - 1e-9);
      const double last = std::floor(high / step + 1e-9);
      if (last - first + 1.0 > count) continue;
      std::vector<double> ticks;
      for (double k = first; k <= last; k += 1.0) ticks.push_back(k * step);
      if (ticks.empty()) ticks.push_back(low);
      return ticks;
    }
    power *= 10.0;
  }
}

double nice_ceiling(double value) {
  if (!std::isfinite(value) || value <= 0.0) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

double nice_floor(double value) {
  if (!std::isfinite(value) || value <= 0.0) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= value * (1.0 + 1e-9)) return factor * power;
  }
  return power;
}

std::string tick_text(double value, double step) {
  int decimals = 0;
  double scaled = std::abs(step);
  while (decimals < 9 && scaled > 0.0 && std::abs(scaled - std::round(scaled)) > 1e-6 * std::max(scaled, 1e-9)) {
    scaled *= 10.0;
    ++decimals;
  }
  return fixed(value, decimals);
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixed(value, digits - 1 - magnitude);
}

std::string length_text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  const LengthUnit unit = length_unit(std::abs(value));
  return short_number(value * unit.factor, digits) + " " + unit.name;
}

}  // namespace odosplat
