// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/gather.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "apps/benchmark/foreign_text.hpp"
#include "apps/benchmark/job_outputs.hpp"
#include "apps/benchmark/job_runner.hpp"
#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::apps {
namespace {

using Json = nlohmann::json;
using Faults = std::map<std::string, std::string>;  // by job id, of jobs that have a fault

/// A file of keys and values, which another program may have written.
class Report {
 public:
  explicit Report(std::string file) : file_(std::move(file)) {
    json_ = Json::parse(read_file(file_, most_result_bytes), nullptr, false);
    if (!json_.is_object()) throw InputError(file_, "is damaged: it is no JSON object");
  }

  bool has(const char* key) const { return json_.contains(key); }
  double number(const char* key, double missing) const { return number_of(json_, key, missing); }
  /// The same for a count.
  int count(const char* key, int missing) const {
    constexpr double most = 1e9;
    const double value = number(key, missing);
    if (!(value >= 0.0 && value <= most)) throw InputError(file_, key, "must be a count");
    return static_cast<int>(value);
  }
  /// The number `key` of the object `outer`.
  double number(const char* outer, const char* key) const {
    const Json& inner = json_.at(outer);
    if (!inner.is_object()) throw InputError(file_, outer, "must be an object");
    return number_of(inner, key, 0.0);
  }
  std::string words(const char* key, const std::string& missing = "") const {
    const auto found = json_.find(key);
    if (found == json_.end()) return missing;
    if (!found->is_string()) throw InputError(file_, key, "must be a text");
    return clean_text(found->get<std::string>());
  }

 private:
  double number_of(const Json& json, const char* key, double missing) const {
    const auto found = json.find(key);
    if (found == json.end()) return missing;
    if (!found->is_number()) throw InputError(file_, key, "must be a number");
    return found->get<double>();
  }

  std::string file_;
  Json json_;
};

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const auto colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string machine() { return processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores"; }

/// True poses of the tested images, with the images' time stamps.
Trajectory truth_of_images(const Sequence& sequence, const FrameRange& range) {
  Trajectory truth;
  for (std::size_t i = range.begin; i < std::min(range.end, sequence.size()); ++i) {
    if (const auto pose = sequence.T_world_camera(i)) truth.push_back({sequence.time(i), *pose, sequence.time_text(i)});
  }
  return truth;
}

SequenceFacts sequence_facts(const PlannedSequence& planned, const Faults& faults) {
  SequenceFacts facts;
  facts.name = planned.name;
  facts.scene = planned.scene;
  facts.words = planned.words;
  facts.path = planned.path;
  facts.stand_in = planned.stand_in;
  if (const auto fault = faults.find(planned.job); fault != faults.end()) {
    facts.fault = fault->second;
    return facts;
  }
  try {
    const Sequence sequence = Sequence::open(planned.path);
    const FrameRange range = planned.frames.empty() ? FrameRange() : parse_frames(planned.frames);
    const std::size_t end = std::min(range.end, sequence.size());
    facts.frames = static_cast<int>(end - std::min(range.begin, end));
    facts.width = sequence.camera().width;
    facts.height = sequence.camera().height;
    facts.truth = truth_of_images(sequence, range);
    if (facts.truth.size() > 1) facts.seconds = facts.truth.back().time - facts.truth.front().time;
    for (std::size_t i = 1; i < facts.truth.size(); ++i) {
      facts.length_m +=
          (facts.truth[i].T_world_camera.translation() - facts.truth[i - 1].T_world_camera.translation()).norm();
    }
    if (const auto fault = faults.find(planned.check_job); fault != faults.end()) {
      facts.convention = "check: " + fault->second;
    } else {
      const Report check(planned.check_file);
      facts.convention = check.words("verdict");
      facts.checksum = check.words("checksum");
      facts.texture = check.number("texture_share", -1.0);
    }
  } catch (const InputError& e) {
    facts.fault = clean_text(e.what());
  }
  return facts;
}

MapFacts map_facts(const PlannedMap& planned, const Faults& faults) {
  MapFacts facts;
  facts.name = planned.name;
  facts.preset = planned.preset;
  if (const auto fault = faults.find(planned.job); fault != faults.end()) {
    facts.fault = fault->second;
    return facts;
  }
  try {
    const Report report(planned.report);
    facts.gaussians = static_cast<std::size_t>(report.count("gaussians", 0));
    facts.iterations = report.count("iterations", 0);
    facts.seconds = report.number("seconds", 0.0);
    facts.psnr_db = report.number("psnr_db", 0.0);
    facts.peak_memory_mb = report.number("peak_memory_mb", 0.0);
  } catch (const InputError& e) {
    facts.fault = clean_text(e.what());
  }
  return facts;
}

/// Reads a run's report.json if there is one: external programs need not write it.
void read_report(const PlannedRun& planned, const JobRecord& record, RunFacts& facts) {
  const std::string file = planned.folder + "/report.json";
  facts.peak_memory_mb = record.peak_memory_mb;
  if (!std::filesystem::exists(file)) return;
  const Report report(file);
  facts.frames = report.count("frames", facts.frames);
  facts.posed = report.count("posed", facts.posed);
  facts.lost = report.count("lost", std::max(0, facts.frames - facts.posed));
  facts.relocalisations = report.count("relocalisations", 0);
  if (report.has("ms_per_frame")) {
    facts.ms_per_frame = report.number("ms_per_frame", "median");
    facts.p95_ms = report.number("ms_per_frame", "p95");
  }
  facts.cpu_ms = report.number("cpu_ms_per_frame", 0.0);
  facts.peak_memory_mb = report.number("peak_memory_mb", facts.peak_memory_mb);
}

EvalResult judged(const Trajectory& estimate, const Trajectory& truth, TrajectoryAlignment alignment) {
  EvalOptions options;
  options.alignment = alignment;
  options.frames = truth.size();
  return evaluate(estimate, truth, options);
}

RunFacts run_facts(const PlannedRun& planned, const SequenceFacts& sequence, const JobRecord& record) {
  RunFacts facts;
  facts.sequence = planned.sequence;
  facts.method = planned.method;
  facts.run = planned.run;
  facts.seed = planned.seed;
  facts.fault = record.fault.empty() ? sequence.fault : record.fault;
  if (!facts.fault.empty()) return facts;
  try {
    PoseFile estimate = read_pose_file(planned.folder + "/trajectory.txt");
    if (estimate.stamps != StampKind::times) throw InputError("trajectory.txt", "its poses have no times");
    facts.estimate = std::move(estimate.poses);
    facts.frames = static_cast<int>(sequence.truth.size());
    facts.posed = static_cast<int>(facts.estimate.size());
    facts.lost = facts.frames - facts.posed;
    read_report(planned, record, facts);
    facts.unaligned = judged(facts.estimate, sequence.truth, TrajectoryAlignment::none);
    if (!facts.unaligned.doubt.empty()) throw InputError("trajectory.txt", "only " + facts.unaligned.doubt);
    facts.aligned = facts.unaligned;
    // An alignment is undetermined if the poses are too few or all on one line: then the unaligned result is reported.
    try {
      facts.aligned = judged(facts.estimate, sequence.truth, TrajectoryAlignment::se3);
    } catch (const InputError&) {
      facts.aligned = facts.unaligned;
    }
    const std::string live = planned.folder + "/trajectory_live.txt";
    facts.live_ate_m = facts.unaligned.ate_m.rmse;
    if (std::filesystem::exists(live)) {
      facts.live_ate_m = judged(read_trajectory(live), sequence.truth, TrajectoryAlignment::none).ate_m.rmse;
    }
  } catch (const InputError& e) {
    facts.fault = clean_text(e.what());
  }
  return facts;
}

/// OpenCL device that the runs used, according to their reports.
std::string device_of(const Plan& plan) {
  for (const PlannedRun& run : plan.runs) {
    const std::string file = run.folder + "/report.json";
    if (!std::filesystem::exists(file)) continue;
    try {
      std::string device = Report(file).words("device", "none");
      if (device != "none") return device;
    } catch (const InputError&) {
      // The fault is reported in the run's own row.
    }
  }
  return "none";
}

std::string command_of(const BenchmarkOptions& o, const Plan& plan) {
  std::string command = "odosplat benchmark --suite " + o.suite;
  if (!o.root.empty()) command += " --root " + o.root;
  if (plan.stand_in) command += " --size " + o.size;
  const auto list = [&](const char* flag, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) command += (i == 0 ? std::string(" ") + flag + " " : ",") + words[i];
  };
  list("--methods", o.methods);
  list("--sequences", o.sequences);
  if (o.runs > 1) command += " --runs " + std::to_string(o.runs);
  if (o.mapping != "every") command += " --mapping " + o.mapping;
  if (o.quick) command += " --quick";
  if (o.seed != 1) command += " --seed " + std::to_string(o.seed);
  return command + " --out DIR";
}

}  // namespace

BenchmarkResults gather(const Plan& plan) {
  BenchmarkResults results;
  results.suite = plan.suite;
  results.stand_in = plan.stand_in;
  results.mapping = plan.mapping;
  results.split = plan.options.mapping == "split";
  results.quick = plan.quick;
  results.methods = plan.methods;
  results.runs = plan.options.runs;
  results.machine = machine();
  results.device = device_of(plan);
  results.version = ODOSPLAT_VERSION;
  results.command = command_of(plan.options, plan);

  std::map<std::string, JobRecord> records;
  Faults faults;
  for (JobRecord& record : settled_records(plan.options.out, plan.jobs)) {
    if (!record.fault.empty()) faults[record.id] = record.fault;
    records[record.id] = std::move(record);
  }
  for (const PlannedSequence& s : plan.sequences) results.sequences.push_back(sequence_facts(s, faults));
  for (const PlannedMap& m : plan.maps) results.maps.push_back(map_facts(m, faults));
  for (const PlannedRun& run : plan.runs) {
    const auto sequence = std::find_if(results.sequences.begin(), results.sequences.end(),
                                       [&](const SequenceFacts& s) { return s.name == run.sequence; });
    results.cells.push_back(run_facts(run, *sequence, records.at(run.job)));
  }
  return results;
}

}  // namespace odosplat::apps
