// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/results.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/eval/statistics.hpp"

namespace odosplat::apps {
namespace {

CellSummary::Value value_of(std::vector<double> values) {
  std::ranges::sort(values);
  return {percentile(values, 50.0), values.front(), values.back()};
}

}  // namespace

std::optional<CellSummary> summarise(const BenchmarkResults& results, const std::string& sequence,
                                     const std::string& method) {
  CellSummary summary;
  std::vector<const RunFacts*> good;
  for (const RunFacts& run : results.cells) {
    if (run.sequence != sequence || run.method != method) continue;
    if (run.fault.empty()) {
      good.push_back(&run);
    } else {
      if (summary.failed == 0) summary.fault = run.fault;
      ++summary.failed;
    }
  }
  summary.runs = static_cast<int>(good.size());
  if (summary.runs + summary.failed == 0) return std::nullopt;
  if (good.empty()) return summary;
  const auto over_runs = [&](auto&& quantity) {
    std::vector<double> values;
    values.reserve(good.size());
    for (const RunFacts* run : good) values.push_back(quantity(*run));
    return value_of(std::move(values));
  };
  summary.ate_m = over_runs([](const RunFacts& r) { return r.unaligned.ate_m.rmse; });
  summary.ate_aligned_m = over_runs([](const RunFacts& r) { return r.aligned.ate_m.rmse; });
  summary.live_ate_m = over_runs([](const RunFacts& r) { return r.live_ate_m; });
  summary.ate_max_m = over_runs([](const RunFacts& r) { return r.unaligned.ate_m.max; });
  summary.rte_m = over_runs([](const RunFacts& r) { return r.unaligned.rte_m.rmse; });
  summary.rre_deg = over_runs([](const RunFacts& r) { return r.unaligned.rre_deg.rmse; });
  summary.coverage = over_runs([](const RunFacts& r) { return r.unaligned.coverage; });
  summary.lost = over_runs([](const RunFacts& r) { return static_cast<double>(r.lost); });
  summary.ms_per_frame = over_runs([](const RunFacts& r) { return r.ms_per_frame; });
  summary.p95_ms = over_runs([](const RunFacts& r) { return r.p95_ms; });
  summary.cpu_ms = over_runs([](const RunFacts& r) { return r.cpu_ms; });
  summary.peak_memory_mb = over_runs([](const RunFacts& r) { return r.peak_memory_mb; });
  return summary;
}

std::vector<int> places(const std::vector<std::optional<double>>& values, int decimals) {
  const double units = std::pow(10.0, decimals);
  const auto printed = [&](double value) { return std::llround(value * units); };
  std::vector<int> result(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i] || !std::isfinite(*values[i])) continue;
    const auto better = std::ranges::count_if(values, [&](const std::optional<double>& other) {
      return other && std::isfinite(*other) && printed(*other) < printed(*values[i]);
    });
    if (better < 2) result[i] = static_cast<int>(better) + 1;
  }
  return result;
}

}  // namespace odosplat::apps
