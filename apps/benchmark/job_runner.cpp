// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/job_runner.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "apps/benchmark/child_process.hpp"
#include "apps/benchmark/foreign_text.hpp"
#include "apps/benchmark/job_outputs.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

namespace fs = std::filesystem;

const std::string needs_words = "needs ";
constexpr auto poll_interval = std::chrono::milliseconds(50);
constexpr double stop_patience = 20.0;  // [s] for training to write its checkpoint

int cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int jobs_at_a_time(const RunnerOptions& options) { return options.jobs > 0 ? options.jobs : cores(); }

std::vector<std::string> command_of(const Job& job, const RunnerOptions& options, const std::string& program) {
  std::vector<std::string> command = job.command;
  if (command[0] != "odosplat") return command;
  command[0] = program;
  const int threads = options.threads > 0 ? options.threads : std::max(1, cores() / jobs_at_a_time(options));
  command.insert(command.end(), {"--threads", std::to_string(threads)});
  if (!options.device.empty()) command.insert(command.end(), {"--device", options.device});
  return command;
}

/// Removes files left by a different version of the job (another fingerprint): results, which would look valid if the
/// job failed before it rewrote them, and checkpoints from which it cannot continue. Files outside the benchmark's
/// folder are caches that check themselves whether they are valid.
void clear_leftovers(const std::string& out, const Job& job, const std::string& fingerprint) {
  const std::string marker = out + "/jobs/" + job.id + "/started";
  if (fs::exists(marker) && read_file(marker) == fingerprint) return;
  const std::string inside = fs::absolute(out).lexically_normal().string() + "/";
  for (const std::string& file : job.outputs) {
    if (file.rfind(inside, 0) != 0) continue;
    fs::remove(file);
    fs::remove(file + ".checkpoint");
  }
  for (const std::string& file : job.reports) {
    if (file.rfind(inside, 0) == 0) fs::remove(file);
  }
  write_file_atomically(marker, fingerprint);
}

std::unique_ptr<ChildProcess> start(const std::string& out, const Job& job, const std::string& fingerprint,
                                    const RunnerOptions& options, const std::string& program) {
  const std::string log = log_file(out, job.id);
  const MadeFolders made = ensure_output_file(log);
  fs::remove(record_file(out, job.id));
  clear_leftovers(out, job, fingerprint);
  for (const std::string& file : job.outputs) ensure_output_file(file).keep();
  return std::make_unique<ChildProcess>(command_of(job, options, program), log,
                                        ProcessLimits{options.time_limit, options.memory_limit});
}

JobRecord record_of(const Job& job, const std::string& fingerprint, const ProcessEnd& end) {
  JobRecord record{job.id, fingerprint, end.fault, end.seconds, end.peak_memory_mb};
  if (record.fault.empty()) record.fault = output_fault(job);
  return record;
}

/// Keeps the state of all jobs and prints progress.
class Board {
 public:
  Board(const std::vector<Job>& jobs, int at_a_time) : jobs_(jobs), at_a_time_(at_a_time) {
    for (const Job& job : jobs) work_left_ += job.work;
  }

  void settle(const Job& job, bool went_through) {
    (went_through ? through_ : failed_).insert(job.id);
    work_left_ -= job.work;
  }
  void report(const Job& job, const JobRecord& record, bool ran) {
    if (ran) {
      seconds_run_ += record.seconds;
      work_run_ += job.work;
    }
    const std::size_t done = through_.size() + failed_.size();
    const std::string left =
        work_run_ > 0.0 && done < jobs_.size()
            ? ", about " + format_duration(work_left_ * seconds_run_ / work_run_ / at_a_time_) + " left"
            : "";
    const std::string outcome = record.fault.empty()
                                    ? "done in " + format_duration(record.seconds) + ", " +
                                          std::to_string(static_cast<int>(record.peak_memory_mb)) + " MB"
                                    : "FAILED: " + record.fault;
    const std::string line =
        "[" + std::to_string(done) + "/" + std::to_string(jobs_.size()) + "] " + job.id + ": " + outcome + left;
    record.fault.empty() ? log_info(line) : log_warning(line);
  }
  bool settled(const Job& job) const { return through_.count(job.id) > 0 || failed_.count(job.id) > 0; }
  /// The first needed job that failed; empty: none.
  std::string failed_need(const Job& job) const {
    for (const std::string& need : job.needs) {
      if (failed_.count(need) > 0) return need;
    }
    return "";
  }
  bool ready(const Job& job) const {
    return std::all_of(job.needs.begin(), job.needs.end(),
                       [&](const std::string& need) { return through_.count(need) > 0; });
  }
  RunnerOutcome outcome(bool stopped) const {
    return {static_cast<int>(through_.size()), static_cast<int>(failed_.size()), stopped};
  }

 private:
  const std::vector<Job>& jobs_;
  int at_a_time_;
  std::set<std::string> through_;
  std::set<std::string> failed_;
  double work_left_ = 0.0;
  double work_run_ = 0.0;
  double seconds_run_ = 0.0;
};

struct Running {
  std::size_t index;
  std::unique_ptr<ChildProcess> process;
};

}  // namespace

bool is_settled(const std::string& out, const Job& job, const std::string& fingerprint, bool retry_failed) {
  const JobRecord record = read_record(out, job.id);
  if (record.id.empty() || record.fingerprint != fingerprint) return false;
  if (record.fault.empty()) return output_fault(job).empty();
  return !retry_failed && record.fault.rfind(needs_words, 0) != 0;
}

RunnerOutcome run_jobs(const std::string& out, const std::vector<Job>& jobs, const RunnerOptions& options,
                       const std::string& program) {
  const SavesWhenInterrupted saves;
  const std::vector<std::string> prints = fingerprints(jobs);
  Board board(jobs, jobs_at_a_time(options));
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (is_settled(out, jobs[i], prints[i], options.retry_failed)) {
      board.settle(jobs[i], read_record(out, jobs[i].id).fault.empty());
    }
  }
  std::vector<Running> running;
  const auto is_running = [&](std::size_t i) {
    return std::any_of(running.begin(), running.end(), [&](const Running& r) { return r.index == i; });
  };
  while (!interrupted()) {
    bool waiting = false;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      const Job& job = jobs[i];
      if (board.settled(job) || is_running(i)) continue;
      waiting = true;
      if (const std::string need = board.failed_need(job); !need.empty()) {
        const JobRecord record{job.id, prints[i], needs_words + need + ", which failed", 0.0, 0.0};
        write_record(out, record);
        board.settle(job, false);
        board.report(job, record, false);
      } else if (static_cast<int>(running.size()) < jobs_at_a_time(options) && board.ready(job)) {
        running.push_back({i, start(out, job, prints[i], options, program)});
      }
    }
    if (!waiting && running.empty()) break;
    std::this_thread::sleep_for(poll_interval);
    for (auto r = running.begin(); r != running.end();) {
      const std::optional<ProcessEnd> end = r->process->poll();
      if (!end) {
        ++r;
        continue;
      }
      const Job& job = jobs[r->index];
      const JobRecord record = record_of(job, prints[r->index], *end);
      r = running.erase(r);
      if (interrupted()) continue;  // not recorded: it may have been stopped by the same Ctrl-C
      write_record(out, record);
      board.settle(job, record.fault.empty());
      board.report(job, record, true);
    }
  }
  const bool stopped = interrupted();
  for (Running& r : running) r.process->stop(stop_patience);
  return board.outcome(stopped);
}

std::string run_one_job(const std::string& out, const std::vector<Job>& jobs, const std::string& id,
                        const RunnerOptions& options, const std::string& program) {
  const SavesWhenInterrupted saves;
  const std::vector<std::string> prints = fingerprints(jobs);
  const auto found = std::find_if(jobs.begin(), jobs.end(), [&](const Job& job) { return job.id == id; });
  if (found == jobs.end()) throw InputError("--job", "the plan has no job " + clean_text(id));
  const std::string& print = prints[static_cast<std::size_t>(found - jobs.begin())];
  if (is_settled(out, *found, print, options.retry_failed)) return read_record(out, id).fault;
  for (const std::string& need : found->needs) {
    const JobRecord before = read_record(out, need);
    if (before.id.empty() || !before.fault.empty()) {
      std::string fault = needs_words + need + (before.id.empty() ? ", which has not run" : ", which failed");
      write_record(out, {id, print, fault, 0.0, 0.0});
      return fault;
    }
  }
  const auto process = start(out, *found, print, options, program);
  while (true) {
    if (interrupted()) {
      process->stop(stop_patience);
      throw Interrupted();
    }
    if (const std::optional<ProcessEnd> end = process->poll()) {
      const JobRecord record = record_of(*found, print, *end);
      write_record(out, record);
      return record.fault;
    }
    std::this_thread::sleep_for(poll_interval);
  }
}

void remove_unsettled_records(const std::string& out, const std::vector<Job>& jobs, bool retry_failed) {
  const std::vector<std::string> prints = fingerprints(jobs);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!is_settled(out, jobs[i], prints[i], retry_failed)) fs::remove(record_file(out, jobs[i].id));
  }
}

std::vector<JobRecord> settled_records(const std::string& out, const std::vector<Job>& jobs) {
  const std::vector<std::string> prints = fingerprints(jobs);
  std::vector<JobRecord> records;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    JobRecord record = read_record(out, jobs[i].id);
    if (record.id.empty() || record.fingerprint != prints[i]) record = {jobs[i].id, prints[i], "not run yet", 0.0, 0.0};
    if (record.fault.empty()) record.fault = output_fault(jobs[i]);
    records.push_back(record);
  }
  return records;
}

std::string own_program() { return fs::read_symlink("/proc/self/exe").string(); }

}  // namespace odosplat::apps
