// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Effects of signals on commands that check for interrupts and on those that do not.
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "apps/command/interrupt.hpp"
#include "apps/command/run_program.hpp"
#include "apps/command/support.hpp"

namespace odosplat::apps {
namespace {

[[noreturn]] void wait_and_exit(double seconds, int status) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  _exit(status);
}

class Signals : public testing::Test {
 protected:
  // catch_interrupts() starts a thread: the death tests must not fork while it runs.
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(Signals, EndWhatDoesNotAsk) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Stopwatch watch;
    EXPECT_EXIT(
        {
          std::signal(SIGHUP, SIG_DFL);
          catch_interrupts();
          raise(signal);
          wait_and_exit(20.0, 0);
        },
        testing::ExitedWithCode(130), "interrupted");
    EXPECT_LT(watch.seconds(), 10.0) << signal;
  }
}

TEST_F(Signals, LeaveTimeToSave) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        const SavesWhenInterrupted saves;
        raise(SIGINT);
        wait_and_exit(1.5, interrupted() ? 7 : 8);
      },
      testing::ExitedWithCode(7), "");
}

TEST_F(Signals, EndWhatHasSavedAndGoesOn) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        {
          const SavesWhenInterrupted saves;
          raise(SIGINT);
        }
        wait_and_exit(20.0, 0);
      },
      testing::ExitedWithCode(130), "interrupted");
}

TEST_F(Signals, EndAtOnceTheSecondTime) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        const SavesWhenInterrupted saves;
        raise(SIGINT);
        raise(SIGTERM);
        wait_and_exit(20.0, 0);
      },
      testing::ExitedWithCode(130), "");
}

TEST_F(Signals, OfAClosingTerminalMayComeTwice) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_DFL);
        catch_interrupts();
        const SavesWhenInterrupted saves;
        raise(SIGHUP);
        raise(SIGHUP);
        wait_and_exit(0.1, 7);
      },
      testing::ExitedWithCode(7), "");
}

TEST_F(Signals, AreIgnoredUnderNohup) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        catch_interrupts();
        raise(SIGHUP);
        wait_and_exit(0.1, interrupted() ? 8 : 7);
      },
      testing::ExitedWithCode(7), "");
}

TEST_F(Signals, GiveTheirStatusToWhatWasAboutToEnd) {
  EXPECT_EXIT(
      {
        const auto declare = [](CLI::App& app) { app.add_subcommand("work")->callback([] { raise(SIGINT); }); };
        std::string program = "program";
        std::string work = "work";
        std::vector<char*> words(1, program.data());
        words.push_back(work.data());
        _exit(run_program(declare, 2, words.data()));
      },
      testing::ExitedWithCode(130), "interrupted");
}

}  // namespace
}  // namespace odosplat::apps
