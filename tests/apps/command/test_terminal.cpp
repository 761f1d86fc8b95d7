// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Output to the terminal, and failures of standard output, of the program cache and of memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"
#include "tests/locations.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

/// Runs a line of shell in which "$@" stands for the program with these words.
RunResult run_by_shell(const std::string& line, const Words& words) {
  Words all{"-c", line, "sh", test::program()};
  all.insert(all.end(), words.begin(), words.end());
  return run_program("/bin/sh", all);
}

/// Number of control characters other than line ends.
long commands_in(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
  });
}

class Terminal : public testing::Test {
 protected:
  void expect_clean(const RunResult& result, const std::string& shown) {
    EXPECT_EQ(commands_in(result.out), 0) << result.out;
    EXPECT_EQ(commands_in(result.err), 0) << result.err;
    EXPECT_THAT(result.out + result.err, HasSubstr(shown));
  }
  ScratchFolder scratch_;
};

TEST_F(Terminal, NamesOnTheCommandLineAreShownEscaped) {
  const std::string name = scratch_ / "a\x1b]0;owned\a\r\n.txt";
  expect_clean(run_odosplat({"eval", name, "--truth", name}), "a\\x1b]0;owned\\x07\\x0d\\x0a.txt");
  expect_clean(run_odosplat({"eval", "a", "--tru\x1b[2Jth", "b"}), "--tru\\x1b[2Jth");
  expect_clean(run_odosplat({"ev\x1b[2Jal"}), "ev\\x1b[2Jal");
  expect_clean(run_odosplat({"devices", "--threads", "\x1b[2J"}), "\\x1b[2J");
  expect_clean(run_odosplat({"eval", scratch_ / "B\xfcro", "--truth", "b"}), "B\\xfcro");
  expect_clean(run_odosplat({"eval", scratch_ / "Büro", "--truth", "b"}), "Büro");
}

TEST_F(Terminal, TextOfFilesIsShownEscaped) {
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty flo\x1b[2Jat y\n";
  write_text(scratch_ / "a.ply", header + "property float z\nend_header\n1 1 1\n");
  expect_clean(run_odosplat({"convert", scratch_ / "a.ply", scratch_ / "b.ply"}), "a.ply");
  write_text(scratch_ / "times.txt", "1 2 3 \x1b[2J 5 6 7 8\n");
  expect_clean(run_odosplat({"eval", scratch_ / "times.txt", "--truth", scratch_ / "times.txt"}), "times.txt");
  const std::string sequence = scratch_ / "seq";
  write_tiny_sequence(sequence, 24);
  write_text(sequence + "/rgb.txt", "0.0 rgb/no\x1b[2J\a.png\n");
  expect_clean(run_odosplat({"check", sequence}), "rgb");
}

TEST_F(Terminal, ResultsNameFilesEscaped) {
  const std::string sequence = scratch_ / "seq\x1b[31m";
  write_tiny_sequence(sequence, 24);
  const RunResult result = run_odosplat({"cloud", sequence, "--every", "1", "--out", scratch_ / "c\x1b[0m.ply"});
  EXPECT_EQ(result.status, 0) << result.err;
  expect_clean(result, "c\\x1b[0m.ply");
  expect_clean(result, "seq\\x1b[31m");
}

TEST_F(Terminal, OutputThatIsNotTakenIsAnError) {
  const std::string truth = scratch_ / "truth.txt";
  write_text(truth, "0.0 0 0 0 0 0 0 1\n1.0 1 0 0 0 0 0 1\n2.0 2 0 1 0 0 0 1\n");
  const std::vector<Words> lines{{"eval", truth, "--truth", truth},
                                 {"devices"},
                                 {"devices", "--json"},
                                 {"synthesize", "--list"},
                                 {"--help"},
                                 {"eval", "--help"},
                                 {"--version"}};
  for (const Words& words : lines) {
    const RunResult result = run_by_shell("exec \"$@\" > /dev/full", words);
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_EQ(result.status, 2);
    // For output by std::endl the reason is no longer known at the end.
    EXPECT_THAT(result.err, testing::MatchesRegex("odosplat: standard output: cannot be written: "
                                                  "(No space left on device|an earlier line failed)\n"));
  }
}

TEST_F(Terminal, WarningLevelSilencesProgressAndDevice) {
  const std::string sequence = scratch_ / "seq";
  write_tiny_sequence(sequence, 24);
  const Words words{"cloud", sequence, "--every", "1", "--out", scratch_ / "c.ply"};
  Words quiet = words;
  quiet.insert(quiet.end(), {"--log", "warning"});
  EXPECT_THAT(run_odosplat(words).err, HasSubstr("24/24"));
  EXPECT_EQ(run_odosplat(quiet).err, "");
}

TEST(Version, NamesVersionBuildAndDevices) {
  const std::string text = run_odosplat({"--version"}).out;
  EXPECT_THAT(text, testing::ContainsRegex("odosplat [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_THAT(text, testing::ContainsRegex("build: (GCC|Clang) [0-9]+.*, [A-Z][A-Za-z]+\n"));
  EXPECT_THAT(text, HasSubstr("device 0: "));
}

TEST(Cache, ThatPoclCannotWriteIsNamed) {
  const ScratchFolder scratch;
  write_text(scratch / "file", "");
  const std::string below = scratch / "file";
  for (const std::string& setting : {"POCL_CACHE_DIR=" + below + "/pocl", "XDG_CACHE_HOME=" + below, "HOME=" + below}) {
    SCOPED_TRACE(setting);
    const std::string line = "unset POCL_CACHE_DIR XDG_CACHE_HOME; " + setting + " exec \"$@\"";
    const RunResult result = run_by_shell(line, {"devices", "--device", "0"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("PoCL cannot write its cache folder " + below), HasSubstr("POCL_CACHE_DIR")));
    EXPECT_THAT(run_by_shell(line, {"devices"}).out, HasSubstr("set POCL_CACHE_DIR"));
  }
}

TEST(Figures, AreWrittenAsTheirNamesSayOrRefused) {
  const ScratchFolder scratch;
  write_text(scratch / "c.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n1 1 1\n2 1 1\n1 2 1\n");
  const auto view = [&](const std::string& name) {
    return run_odosplat({"view", "map", "--cloud", scratch / "c.ply", "--size", "64x48", "--out", scratch / name});
  };
  for (const auto& [name, start] : std::vector<std::pair<std::string, std::string>>{
           {"a.png", "\x89PNG"}, {"a.JPG", "\xff\xd8\xff"}, {"a.pdf", "%PDF"}, {"a.svg", "<svg"}}) {
    const RunResult result = view(name);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(read_text(scratch / name), testing::StartsWith(start)) << name;
  }
  for (const char* name : {"a.html", "a.mp4", "a.gif", "a"}) {
    const RunResult result = view(name);
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_THAT(result.err, HasSubstr(".png, .jpg, .jpeg, .pdf or .svg"));
    EXPECT_FALSE(fs::exists(scratch / name));
  }
}

}  // namespace
}  // namespace odosplat::apps_test
