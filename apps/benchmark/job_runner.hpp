// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/benchmark/job.hpp"
#include "apps/benchmark/options.hpp"

namespace odosplat::apps {

/// What became of a list of jobs.
struct RunnerOutcome {
  int went_through = 0;  // now or before
  int failed = 0;        // those that could not run for want of another's result included
  bool stopped = false;  // interrupted: some were not run
};

/// Whether a job need not be run again: its record has its fingerprint and all its outputs are there, or it failed for
/// a reason of its own and failures are not to be tried again.
bool is_settled(const std::string& out, const Job& job, const std::string& fingerprint, bool retry_failed);

/// Runs jobs as processes of their own, several at a time, each once those it needs have gone through, in the order of
/// the list where there is a choice. What is settled already is not run again, so that a stopped benchmark goes on
/// where it was. A job that fails, hangs or takes too much memory takes only those with it that need it. Each job gives
/// a line on standard error. After Ctrl-C the running ones are stopped, and lose at most what they have not kept.
/// program: this program's own file, for jobs of "odosplat".
RunnerOutcome run_jobs(const std::string& out, const std::vector<Job>& jobs, const RunnerOptions& options,
                       const std::string& program);

/// Runs one job of the list, for schedulers that know what it needs; its record says how it went. Returns its fault.
std::string run_one_job(const std::string& out, const std::vector<Job>& jobs, const std::string& id,
                        const RunnerOptions& options, const std::string& program);

/// Takes away the records of all jobs that are not settled: a scheduler that goes by files sees what is left to do.
void remove_unsettled_records(const std::string& out, const std::vector<Job>& jobs, bool retry_failed);

/// A job's record as it counts now: with a fault "needs ..." where something before it failed, "not run yet" if it
/// never ran as it stands in the list.
std::vector<JobRecord> settled_records(const std::string& out, const std::vector<Job>& jobs);

/// Path of this program's own file.
std::string own_program();

}  // namespace odosplat::apps
