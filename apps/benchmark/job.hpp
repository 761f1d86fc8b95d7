// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// A process to run once: one step of a benchmark.
struct Job {
  std::string id;                    // "track/icl_1/gaussian/1": names its folder OUT/jobs/ID and what others wait for;
                                     // words of letters, digits, ., _ and -, with / between them
  std::vector<std::string> command;  // program and arguments; the program "odosplat" is this one, which is also told
                                     // device and threads
  std::vector<std::string> needs;    // ids of jobs that must have gone through before
  std::vector<std::string> outputs;  // files without which it counts as not run, whatever its record says
  std::vector<std::string> reports;  // files that it may write as well, and that then must be whole
  double work = 1.0;                 // about how much there is to do, for the time left; seconds on two cores
};

/// How a job ended, kept in OUT/jobs/ID/record.json.
struct JobRecord {
  std::string id;
  std::string fingerprint;  // of the command and of what it needs: a record with another one does not count
  std::string fault;        // empty: it went through
  double seconds = 0.0;
  double peak_memory_mb = 0.0;  // resident
};

/// Throws InputError unless it is a job's id as above: ids become parts of paths and of commands.
void check_job_id(const std::string& id);

/// Fingerprint of every job of a list (in its order): 16 hexadecimal digits over command, program version and the
/// fingerprints of what the job needs. Throws std::logic_error if a need is not in front of it, InputError for an id.
std::vector<std::string> fingerprints(const std::vector<Job>& jobs);

/// Where a job's record, and its output (standard output and error together), are kept.
std::string record_file(const std::string& out, const std::string& id);
std::string log_file(const std::string& out, const std::string& id);

/// Reads a record; one with an empty id if there is none or it is damaged.
JobRecord read_record(const std::string& out, const std::string& id);
void write_record(const std::string& out, const JobRecord& record);

}  // namespace odosplat::apps
