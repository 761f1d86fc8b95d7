// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "bench_report.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

template <typename Base>
class PlainNames : public Base {
 public:
  void ReportRuns(const std::vector<benchmark::BenchmarkReporter::Run>& runs) override {
    std::vector<benchmark::BenchmarkReporter::Run> plain = runs;
    for (auto& run : plain) run.run_name.time_type.clear();
    Base::ReportRuns(plain);
  }
};

}  // namespace

void run_benchmarks(int argc, char** argv) {
  bool json = false;
  bool file = false;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    json = json || flag == "--benchmark_format=json";
    file = file || flag.rfind("--benchmark_out=", 0) == 0;
  }
  benchmark::Initialize(&argc, argv);
  if (argc > 1) throw InputError(argv[1], "unknown flag");
  PlainNames<benchmark::ConsoleReporter> table;
  PlainNames<benchmark::JSONReporter> text, out;
  benchmark::BenchmarkReporter* display = &table;
  if (json) display = &text;
  benchmark::RunSpecifiedBenchmarks(display, file ? &out : nullptr);
  benchmark::Shutdown();
}

}  // namespace odosplat
