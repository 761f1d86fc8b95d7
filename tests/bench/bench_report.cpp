// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/bench/bench_report.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const std::string appended = "/process_time/real_time";  // appended to every name by the library

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
  std::vector<std::string> flags(argv, argv + argc);
  for (std::string& flag : flags) {
    json = json || flag == "--benchmark_format=json";
    file = file || flag.rfind("--benchmark_out=", 0) == 0;
    // A filter that ends with $ refers to the name as it is reported.
    if (flag.rfind("--benchmark_filter=", 0) == 0 && flag.back() == '$') {
      flag.pop_back();
      flag += appended + "$";
    }
  }
  std::vector<char*> pointers;
  for (std::string& flag : flags) pointers.push_back(flag.data());
  pointers.push_back(nullptr);
  benchmark::Initialize(&argc, pointers.data());
  if (argc > 1) throw InputError(pointers[1], "unknown flag");
  PlainNames<benchmark::ConsoleReporter> table;
  PlainNames<benchmark::JSONReporter> text, out;
  benchmark::BenchmarkReporter* display = &table;
  if (json) display = &text;
  benchmark::RunSpecifiedBenchmarks(display, file ? &out : nullptr);
  benchmark::Shutdown();
}

}  // namespace odosplat
