// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/job_outputs.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/benchmark/foreign_text.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

namespace fs = std::filesystem;

std::string fault_of(const std::string& file) {
  std::error_code error;
  const std::string extension = fs::path(file).extension().string();
  if (!fs::is_regular_file(file, error)) return file + " is not a regular file";
  if (extension != ".txt" && extension != ".json") return "";
  if (fs::file_size(file, error) > most_result_bytes || error) return file + " is too large";
  if (extension != ".json") return "";
  try {
    const auto json = nlohmann::json::parse(read_file(file, most_result_bytes), nullptr, false);
    return json.is_object() ? "" : file + " is damaged: it is no JSON object";
  } catch (const InputError& e) {
    return e.what();
  }
}

bool is_there(const std::string& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

std::string first_fault(const Job& job) {
  for (const std::string& file : job.outputs) {
    if (!is_there(file)) return file + " is missing";
    if (std::string fault = fault_of(file); !fault.empty()) return fault;
  }
  for (const std::string& file : job.reports) {
    if (!is_there(file)) continue;
    if (std::string fault = fault_of(file); !fault.empty()) return fault;
  }
  return "";
}

}  // namespace

std::string output_fault(const Job& job) {
  constexpr std::size_t longest = 500;  // the path included
  return clean_text(first_fault(job), longest);
}

}  // namespace odosplat::apps
