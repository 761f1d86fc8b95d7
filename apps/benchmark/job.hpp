// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// A process to run once: one step of a benchmark.
struct Job {
  std::string id;                    // "track/icl_1/gaussian/1": name of its folder OUT/jobs/ID, and by which `needs`
                                     // refers to it; words of letters, digits, ., _ and -, separated by /
  std::vector<std::string> command;  // program and arguments; the program "odosplat" is this program itself, which also
                                     // gets --threads and --device
  std::vector<std::string> needs;    // ids of jobs that must have succeeded before
  std::vector<std::string> outputs;  // files that must exist, otherwise the job counts as not run
  std::vector<std::string> reports;  // optional files; if written, they must be complete
  double work = 1.0;                 // estimated seconds on two cores, for the estimate of the time left
};

/// How a job ended, kept in OUT/jobs/ID/record.json.
struct JobRecord {
  std::string id;
  std::string fingerprint;  // of the command and of the jobs it needs: a record with a different one is ignored
  std::string fault;        // empty: it succeeded
  double seconds = 0.0;
  double peak_memory_mb = 0.0;  // resident
};

/// Throws InputError unless it is a job's id as above: ids become parts of paths and of commands.
void check_job_id(const std::string& id);

/// Fingerprints of the jobs of a list, in its order: 16 hexadecimal digits over the command, the program's version and
/// the fingerprints of the jobs it needs. Throws std::logic_error if a needed job does not precede it, InputError for
/// an invalid id.
std::vector<std::string> fingerprints(const std::vector<Job>& jobs);

/// Paths of a job's record and of its output (standard output and error in one file).
std::string record_file(const std::string& out, const std::string& id);
std::string log_file(const std::string& out, const std::string& id);

/// Reads a record. Returns one with an empty id if the file is missing or damaged.
JobRecord read_record(const std::string& out, const std::string& id);
void write_record(const std::string& out, const JobRecord& record);

}  // namespace odosplat::apps
