// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Running jobs as processes: a failed job affects only those that need it, and settled jobs are not run again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "apps/benchmark/job_runner.hpp"
#include "odosplat/core/error.hpp"
#include "tests/apps/run_program.hpp"

namespace odosplat::apps {
namespace {

using apps_test::read_text;
using apps_test::ScratchFolder;
using testing::HasSubstr;
using testing::StartsWith;

Job shell_job(const std::string& id, const std::string& script, std::vector<std::string> needs = {}) {
  Job job;
  job.id = id;
  job.command = {"sh", "-c", script};
  job.needs = std::move(needs);
  return job;
}

RunnerOptions two_at_a_time() {
  RunnerOptions options;
  options.jobs = 2;
  options.time_limit = 20.0;
  return options;
}

std::string fault_of(const ScratchFolder& folder, const std::string& id) {
  return read_record(folder.path().string(), id).fault;
}

class JobRunner : public testing::Test {
 protected:
  RunnerOutcome run(const std::vector<Job>& jobs, const RunnerOptions& options = two_at_a_time()) {
    return run_jobs(out, jobs, options, "odosplat-is-not-run-here");
  }
  int lines(const std::string& name) const {
    std::ifstream file(folder / name);
    int count = 0;
    for (std::string line; std::getline(file, line);) ++count;
    return count;
  }
  std::string append(const std::string& name) const { return "echo x >> " + (folder / name).string(); }

  ScratchFolder folder;
  const std::string out = folder.path().string();
};

TEST_F(JobRunner, RunsEachAfterWhatItNeeds) {
  const std::string file = (folder / "order").string();
  const RunnerOutcome outcome =
      run({shell_job("a", "sleep 0.2; echo a >> " + file), shell_job("b", "echo b >> " + file, {"a"}),
           shell_job("c", "echo c >> " + file, {"b"})});
  EXPECT_EQ(outcome.went_through, 3);
  EXPECT_EQ(outcome.failed, 0);
  EXPECT_EQ(read_text(file), "a\nb\nc\n");
}

TEST_F(JobRunner, ACrashTakesOnlyWhatNeedsItWithIt) {
  const RunnerOutcome outcome = run({shell_job("crash", "kill -SEGV $$"), shell_job("child", "true", {"crash"}),
                                     shell_job("other", "true"), shell_job("bad", "echo oh no >&2; exit 3")});
  EXPECT_EQ(outcome.went_through, 1);
  EXPECT_EQ(outcome.failed, 3);
  EXPECT_THAT(fault_of(folder, "crash"), StartsWith("killed by signal 11"));
  EXPECT_EQ(fault_of(folder, "child"), "needs crash, which failed");
  EXPECT_EQ(fault_of(folder, "bad"), "exit 3: oh no");
  EXPECT_EQ(fault_of(folder, "other"), "");
}

TEST_F(JobRunner, StopsWhatHangsWithItsChildren) {
  RunnerOptions options = two_at_a_time();
  options.time_limit = 0.5;
  const std::string file = (folder / "late").string();
  run({shell_job("hang", "(sleep 2; echo late > " + file + ") & wait"), shell_job("quick", "true")}, options);
  EXPECT_THAT(fault_of(folder, "hang"), HasSubstr("time limit"));
  EXPECT_EQ(fault_of(folder, "quick"), "");
  run({shell_job("later", "sleep 2.2")});
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(JobRunner, StopsWhatFillsItsMemory) {
  RunnerOptions options = two_at_a_time();
  options.memory_limit = 100.0;
  Job glutton;
  glutton.id = "glutton";
  glutton.command = {"tail", "/dev/zero"};  // reads one endless line into memory
  run({glutton, shell_job("quick", "true")}, options);
  EXPECT_THAT(fault_of(folder, "glutton"), HasSubstr("memory limit of 100 MB"));
  EXPECT_EQ(fault_of(folder, "quick"), "");
}

TEST_F(JobRunner, AProgramThatIsNotThereIsAFault) {
  Job job;
  job.id = "none";
  job.command = {"/no/such/program"};
  EXPECT_EQ(run({job}).failed, 1);
  EXPECT_THAT(fault_of(folder, "none"), HasSubstr("/no/such/program cannot be run"));
}

TEST_F(JobRunner, SettledJobsAreNotRunAgain) {
  const std::vector<Job> jobs{shell_job("good", append("good")), shell_job("bad", append("bad") + "; exit 1")};
  run(jobs);
  run(jobs);
  EXPECT_EQ(lines("good"), 1);
  EXPECT_EQ(lines("bad"), 1);
  RunnerOptions options = two_at_a_time();
  options.retry_failed = true;
  run(jobs, options);
  EXPECT_EQ(lines("good"), 1);
  EXPECT_EQ(lines("bad"), 2);
}

TEST_F(JobRunner, AChangedCommandRunsAgainWithAllThatNeedsIt) {
  run({shell_job("a", append("a")), shell_job("b", append("b"), {"a"}), shell_job("c", append("c"))});
  run({shell_job("a", append("a") + " # changed"), shell_job("b", append("b"), {"a"}), shell_job("c", append("c"))});
  EXPECT_EQ(lines("a"), 2);
  EXPECT_EQ(lines("b"), 2);
  EXPECT_EQ(lines("c"), 1);
}

TEST_F(JobRunner, AMissingOutputIsAFaultAndALostOneRunsTheJobAgain) {
  Job job = shell_job("writes", append("count"));
  job.outputs = {(folder / "never").string()};
  run({job});
  EXPECT_THAT(fault_of(folder, "writes"), HasSubstr("is missing"));
  Job other = shell_job("made", append("made"));
  other.outputs = {(folder / "made").string()};
  run({other});
  std::filesystem::remove(folder / "made");
  run({other});
  EXPECT_EQ(lines("made"), 1);
}

TEST_F(JobRunner, OutputsOfAnotherVersionAreTakenAwayBefore) {
  Job job = shell_job("writes", append("result"));
  job.outputs = {(folder / "result").string()};
  run({job});
  job.command.back() = "true # does not write any more";
  run({job});
  EXPECT_THAT(fault_of(folder, "writes"), HasSubstr("is missing"));
}

TEST_F(JobRunner, OneJobAloneWaitsForWhatItNeeds) {
  const std::vector<Job> jobs{shell_job("a", "true"), shell_job("b", append("b"), {"a"})};
  EXPECT_EQ(run_one_job(out, jobs, "b", two_at_a_time(), "-"), "needs a, which has not run");
  EXPECT_EQ(run_one_job(out, jobs, "a", two_at_a_time(), "-"), "");
  EXPECT_EQ(run_one_job(out, jobs, "b", two_at_a_time(), "-"), "");
  EXPECT_EQ(lines("b"), 1);
  EXPECT_THROW(run_one_job(out, jobs, "c", two_at_a_time(), "-"), InputError);
}

TEST_F(JobRunner, RecordsOfAnotherPlanAreTakenAway) {
  const std::vector<Job> jobs{shell_job("a", "true"), shell_job("b", "true")};
  run(jobs);
  remove_unsettled_records(out, {shell_job("a", "true"), shell_job("b", "true # changed")}, false);
  EXPECT_TRUE(std::filesystem::exists(record_file(out, "a")));
  EXPECT_FALSE(std::filesystem::exists(record_file(out, "b")));
}

TEST_F(JobRunner, ADamagedRecordCountsAsNone) {
  const std::vector<Job> jobs{shell_job("a", append("a"))};
  run(jobs);
  apps_test::write_text(record_file(out, "a"), "{\"finger");
  EXPECT_EQ(settled_records(out, jobs).at(0).fault, "not run yet");
  run(jobs);
  EXPECT_EQ(lines("a"), 2);
}

TEST_F(JobRunner, WordsOfOtherProgramsNeedNotBeUtf8) {
  run({shell_job("latin", "printf 'caf\\351\\n'; exit 1"),
       shell_job("long", "printf 'x'; for i in $(seq 150); do printf '\\303\\251'; done; exit 1"),
       shell_job("escape", "printf 'red \\033[31m'; exit 1")});
  EXPECT_EQ(fault_of(folder, "latin"), "exit 1: caf?");
  EXPECT_THAT(fault_of(folder, "long"), testing::EndsWith("\xc3\xa9..."));
  EXPECT_EQ(fault_of(folder, "escape"), "exit 1: red ?[31m");
}

TEST_F(JobRunner, OutputsAreRegularFilesOfSomeSize) {
  const auto fault = [&](const std::string& id, const std::string& script) {
    Job job = shell_job(id, "cd " + out + "; " + script);
    job.outputs = {out + "/" + id + ".txt"};
    EXPECT_EQ(run({job}).failed, 1);
    return fault_of(folder, id);
  };
  EXPECT_THAT(fault("pipe", "mkfifo pipe.txt"), HasSubstr("pipe.txt is not a regular file"));
  EXPECT_THAT(fault("zero", "ln -s /dev/zero zero.txt"), HasSubstr("zero.txt is not a regular file"));
  EXPECT_THAT(fault("huge", "truncate -s 300M huge.txt"), HasSubstr("huge.txt is too large"));
}

TEST_F(JobRunner, ADamagedReportIsAFaultAndRunsTheJobAgain) {
  const std::string report = (folder / "report.json").string();
  Job job = shell_job("cut", append("cut") + "; printf '{\"frames\": 1' > " + report);
  job.reports = {report};
  EXPECT_EQ(run({job}).failed, 1);
  EXPECT_THAT(fault_of(folder, "cut"), HasSubstr("report.json is damaged"));
  run({job});
  EXPECT_EQ(lines("cut"), 1) << "it would only do the same again";
  job = shell_job("whole", append("whole") + "; printf '{\"frames\": 1}' > " + report);
  job.reports = {report};
  EXPECT_EQ(run({job}).failed, 0);
  apps_test::write_text(report, "{\"fra");
  EXPECT_THAT(settled_records(out, {job}).at(0).fault, HasSubstr("report.json is damaged"));
  EXPECT_EQ(run({job}).failed, 0);
  EXPECT_EQ(lines("whole"), 2);
}

TEST_F(JobRunner, IdsThatAShellOrAPathWouldObeyAreRefused) {
  for (const char* id : {"", "a b", "a`touch x`", "$(x)", "../a", "a//b", "a/", "a/./b", "caf\xc3\xa9"}) {
    EXPECT_THROW(check_job_id(id), InputError) << id;
    EXPECT_THROW(run({shell_job(id, "true")}), InputError) << id;
  }
  check_job_id("track/icl_1/a.b-C/1");
}

class JobChildren : public JobRunner {
 protected:
  /// A shell command that starts a sleeping process in its own session and continues once that has written its process
  /// id.
  std::string leave_a_child() const {
    return "cd " + out + "; setsid sh -c 'echo $$ > pid_; mv pid_ pid; exec sleep 60' & " + "while [ ! -e " + out +
           "/pid ]; do sleep 0.01; done; ";
  }
  pid_t child() const {
    pid_t pid = 0;
    std::ifstream(folder / "pid") >> pid;
    return pid;
  }
  bool is_gone_soon() const {
    for (int i = 0; i < 200; ++i) {
      if (child() > 0 && kill(child(), 0) != 0 && errno == ESRCH) return true;
      usleep(20000);
    }
    return false;
  }
};

TEST_F(JobChildren, EndWithTheirJob) {
  EXPECT_EQ(run({shell_job("leaves", leave_a_child())}).went_through, 1);
  EXPECT_TRUE(is_gone_soon());
}

TEST_F(JobChildren, EndAtTheLimit) {
  RunnerOptions options = two_at_a_time();
  options.time_limit = 1.0;
  EXPECT_EQ(run({shell_job("hangs", leave_a_child() + "sleep 60")}, options).failed, 1);
  EXPECT_THAT(fault_of(folder, "hangs"), HasSubstr("time limit"));
  EXPECT_TRUE(is_gone_soon());
}

TEST_F(JobChildren, CountForTheMemory) {
  RunnerOptions options = two_at_a_time();
  options.memory_limit = 100.0;
  run({shell_job("glutton", "setsid tail /dev/zero & wait")}, options);
  EXPECT_THAT(fault_of(folder, "glutton"), HasSubstr("memory limit of 100 MB"));
}

TEST_F(JobChildren, EndWhenTheRunnerIsKilled) {
  const pid_t runner = fork();
  if (runner == 0) {
    run_jobs(out, {shell_job("hangs", leave_a_child() + "sleep 60")}, two_at_a_time(), "-");
    _exit(0);
  }
  while (!exists(folder / "pid")) usleep(10000);
  kill(runner, SIGKILL);
  waitpid(runner, nullptr, 0);
  EXPECT_TRUE(is_gone_soon());
}

}  // namespace
}  // namespace odosplat::apps
