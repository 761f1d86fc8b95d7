// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/stamp_guess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "odosplat/core/formatted.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat {
namespace {

struct Unit {
  const char* name;
  double seconds;
};
constexpr std::array<Unit, 4> units{{{"seconds", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};

// Limits for the time between two images or poses [s], wider than those of any camera or tracker.
constexpr double least_step = 1e-4;
constexpr double largest_step = 60.0;
constexpr double usual_step = 1.0 / 30.0;
constexpr double largest_image_step = 10.0;
// Stamps with a smaller step are not in ms, us or ns: in ms, 1 is a rate of 1 kHz.
constexpr double least_raw_step = 0.9;

double median_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return upper_median(std::move(steps));
}

double span(const std::vector<double>& times) { return times.back() - times.front(); }

std::size_t nearest(const std::vector<double>& times, double t) {
  const auto after = std::lower_bound(times.begin(), times.end(), t);
  if (after == times.begin()) return 0;
  if (after == times.end() || t - *(after - 1) <= *after - t)
    return static_cast<std::size_t>(after - times.begin()) - 1;
  return static_cast<std::size_t>(after - times.begin());
}

// Number of stamps of the shorter list that match a stamp of the longer list, each of which is used at most once.
std::size_t matched(std::vector<double> a, std::vector<double> b, double tolerance) {
  if (a.size() > b.size()) std::swap(a, b);
  std::size_t count = 0;
  std::size_t next = 0;
  for (const double t : a) {
    const std::size_t j = nearest(b, t);
    if (j < next || std::abs(b[j] - t) > tolerance) continue;
    next = j + 1;
    ++count;
  }
  return count;
}

std::vector<double> scaled(std::vector<double> times, double factor, double offset = 0.0) {
  for (double& t : times) t = factor * t + offset;
  return times;
}

// Whether stamps with the median step `step` can be in that unit.
bool can_be(const Unit& unit, double step) {
  const double seconds = unit.seconds * step;
  return seconds >= least_step && seconds <= largest_step && (unit.seconds == 1.0 || step >= least_raw_step);
}

bool are_frame_numbers(const std::vector<double>& times) {
  return times.size() > 1 && median_step(times) == 1.0 &&
         std::all_of(times.begin(), times.end(), [](double t) { return t == std::floor(t) && std::abs(t) < 1e8; });
}

std::string number(double value) { return formatted(std::abs(value) < 1e7 ? "%.3f" : "%.0f", value); }

std::string look_like(const std::string& name, const char* unit) {
  return "the stamps of " + name + " look like " + unit;
}

std::string units_by_matching(const NamedStamps& a, const NamedStamps& b, double tolerance) {
  const double step_a = median_step(a.times);
  const double step_b = median_step(b.times);
  const std::size_t shorter = std::min(a.times.size(), b.times.size());
  std::size_t best = std::max<std::size_t>(2, (shorter + 1) / 2);
  double best_oddity = std::numeric_limits<double>::infinity();
  std::string words;
  for (const Unit& unit_a : units) {
    for (const Unit& unit_b : units) {
      if (unit_a.seconds == 1.0 && unit_b.seconds == 1.0) continue;
      if (!can_be(unit_a, step_a) || !can_be(unit_b, step_b)) continue;
      const std::size_t count = matched(scaled(a.times, unit_a.seconds), scaled(b.times, unit_b.seconds), tolerance);
      // Pairs of units with the same ratio match equally well (ms with us, us with ns): of these, the pair whose rate
      // is closest to a usual camera's (30 Hz) is taken.
      const double oddity = std::abs(std::log(unit_a.seconds * step_a / usual_step));
      if (count < best || (count == best && oddity >= best_oddity)) continue;
      best = count;
      best_oddity = oddity;
      const bool wrong_a = unit_a.seconds != 1.0;
      const bool wrong_b = unit_b.seconds != 1.0;
      words = wrong_a ? look_like(a.name, unit_a.name) : look_like(b.name, unit_b.name);
      if (wrong_a && wrong_b) words += ", those of " + b.name + " like " + unit_b.name;
    }
  }
  return words;
}

std::string units_by_span(const NamedStamps& a, const NamedStamps& b) {
  const double span_a = span(a.times);
  const double span_b = span(b.times);
  if (!(span_a > 0.0 && span_b > 0.0)) return "";
  const double thousands = std::log10(span_a / span_b) / 3.0;
  const double whole = std::round(thousands);
  if (whole == 0.0 || std::abs(whole) > 3.0 || std::abs(thousands - whole) > 0.3) return "";
  const Unit& unit = units[static_cast<std::size_t>(std::abs(whole))];
  const NamedStamps& larger = whole > 0.0 ? a : b;
  return can_be(unit, median_step(larger.times)) ? look_like(larger.name, unit.name) : "";
}

std::string offset(const NamedStamps& a, const NamedStamps& b, double tolerance) {
  const double between_starts = b.times.front() - a.times.front();
  const bool overlap = a.times.front() <= b.times.back() && b.times.front() <= a.times.back();
  const std::size_t shorter = std::min(a.times.size(), b.times.size());
  for (const double shift : {between_starts, b.times.back() - a.times.back()}) {
    const std::size_t count = matched(scaled(a.times, 1.0, shift), b.times, tolerance);
    if (2 * count >= shorter && count > 1 && (overlap || shift == between_starts)) {
      return "a constant offset of about " + number(-shift) + " s lies between " + a.name + " and " + b.name;
    }
  }
  if (!overlap) {
    return a.name + " begins at " + number(a.times.front()) + " s, " + b.name + " at " + number(b.times.front()) +
           " s: a constant offset of about " + number(-between_starts) + " s, or two recordings";
  }
  std::vector<double> distances;
  for (const double t : a.times) distances.push_back(std::abs(b.times[nearest(b.times, t)] - t));
  return "the nearest stamps are " + number(upper_median(std::move(distances))) + " s apart (median)";
}

}  // namespace

std::string guess_stamp_fault(const NamedStamps& a, const NamedStamps& b, double tolerance) {
  if (a.times.empty() || b.times.empty()) return "";
  const bool numbers_a = are_frame_numbers(a.times);
  if (numbers_a != are_frame_numbers(b.times)) return look_like(numbers_a ? a.name : b.name, "frame numbers");
  std::string words = units_by_matching(a, b, tolerance);
  if (words.empty()) words = units_by_span(a, b);
  return words.empty() ? offset(a, b, tolerance) : words;
}

std::string unit_of_step(double step) {
  if (!(step >= largest_image_step)) return "";
  for (const Unit& unit : units) {
    if (unit.seconds * step <= 1.0) return unit.name;
  }
  return "";
}

}  // namespace odosplat
