// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat {

/// A unit for printing lengths: metres * factor is the value in the unit.
struct LengthUnit {
  double factor = 1.0;
  std::string name = "m";
};

/// Unit in which lengths up to `largest` [m] print with few digits: um below 0.1 mm, mm below 3 cm, cm below 3 m, m,
/// km from 3 km. Not finite or not positive: m.
LengthUnit length_unit(double largest);

/// Round numbers (at steps of 1, 2 or 5 times a power of ten) within low..high, at most max_count >= 2 of them. A range
/// that is empty or not finite gives {low}.
std::vector<double> nice_ticks(double low, double high, int max_count);

/// Smallest 1, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten that is at least value; 1 for value <= 0 or not
/// finite.
double nice_ceiling(double value);

/// Largest 1, 2 or 5 times a power of ten that is at most value; 1 for value <= 0 or not finite.
double nice_floor(double value);

/// Shortest text that distinguishes ticks `step` apart ("0.5", "2"); no "-0".
std::string tick_text(double value, double step);

/// value with about `digits` significant digits, never in exponent form: "0.41", "4.1", "41", "410".
std::string short_number(double value, int digits = 2);

/// A length [m] with a suitable unit: "4.1 mm", "1.2 m". "-" if it is not finite.
std::string length_text(double value, int digits = 2);

}  // namespace odosplat
