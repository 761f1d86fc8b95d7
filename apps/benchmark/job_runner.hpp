// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/job.hpp"
#include "apps/benchmark/options.hpp"

namespace odosplat::apps {

/// Result of running a list of jobs.
struct RunnerOutcome {
  int went_through = 0;  // in this run or an earlier one
  int failed = 0;        // includes those that could not run because a job they need failed
  bool stopped = false;  // interrupted: some jobs were not run
};

/// Whether a job need not be run again: its record has this fingerprint, and either it succeeded and its outputs are
/// valid, or it failed itself (not because of a job it needs) and retry_failed is false.
bool is_settled(const std::string& out, const Job& job, const std::string& fingerprint, bool retry_failed);

/// Runs jobs as child processes, several at a time. A job starts once all jobs that it needs have succeeded; ready jobs
/// start in the order of the list. Settled jobs are not run again, so that a stopped benchmark can be resumed. When a
/// job fails, exceeds the time limit or the memory limit, only the jobs that need it fail with it. Each finished job
/// prints a line on standard error. After Ctrl-C the running jobs are stopped; they lose at most what they have not
/// saved. program: path of this program, for jobs whose program is "odosplat".
RunnerOutcome run_jobs(const std::string& out, const std::vector<Job>& jobs, const RunnerOptions& options,
                       const std::string& program);

/// Runs one job of the list, for external schedulers that know the dependencies. The result is in its record. Returns
/// its fault.
std::string run_one_job(const std::string& out, const std::vector<Job>& jobs, const std::string& id,
                        const RunnerOptions& options, const std::string& program);

/// Removes the records of all jobs that are not settled, so that a scheduler that looks at files sees what is left to
/// do.
void remove_unsettled_records(const std::string& out, const std::vector<Job>& jobs, bool retry_failed);

/// The record of every job: with the fault "needs ..." if a job that it needs failed, "not run yet" if it has not been
/// run with its current fingerprint.
std::vector<JobRecord> settled_records(const std::string& out, const std::vector<Job>& jobs);

/// Path of this program's executable.
std::string own_program();

}  // namespace odosplat::apps
