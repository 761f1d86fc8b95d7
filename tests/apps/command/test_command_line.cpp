// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Requirements for every command and every flag, tested on the list of commands that the program declares.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "apps/command/command_line.hpp"
#include "apps/command/config_file.hpp"
#include "apps/command/help_text.hpp"
#include "apps/command/nearest_name.hpp"
#include "apps/command/number_flags.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/terminal_text.hpp"
#include "tests/apps/run_program.hpp"

namespace odosplat::apps_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

/// Thrown after a command line was parsed, before the command runs.
struct Read {};

/// The program's commands, none of which is run.
struct Commands {
  CLI::App app;
  apps::Common common;

  Commands() {
    apps::declare_commands(app, common);
    app.parse_complete_callback([] { throw Read(); });
  }
  /// The paths of all commands that can be run: {"eval"}, {"view", "map"}.
  std::vector<Words> paths() {
    std::vector<Words> found;
    const std::function<void(CLI::App*, const Words&)> collect = [&](CLI::App* command, const Words& path) {
      const auto below = command->get_subcommands([](CLI::App*) { return true; });
      if (below.empty()) found.push_back(path);
      for (CLI::App* next : below) {
        Words longer = path;
        longer.push_back(next->get_name());
        collect(next, longer);
      }
    };
    collect(&app, {});
    return found;
  }
  CLI::App* at(const Words& path) {
    CLI::App* command = &app;
    for (const std::string& name : path) command = command->get_subcommand(name);
    return command;
  }
};

void read(Commands& commands, const Words& words) { EXPECT_THROW(apps::parse_command_line(commands.app, words), Read); }

/// The message of the InputError from parsing; empty: none.
std::string fault_of(const Words& words) {
  Commands commands;
  try {
    apps::parse_command_line(commands.app, words);
  } catch (const Read&) {
    return "";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    return e.what();
  }
  ADD_FAILURE() << "neither read nor refused";
  return "";
}

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string long_name(const CLI::Option& option) { return option.get_lnames().empty() ? "" : option.get_lnames()[0]; }

/// A word for each required argument of a command.
Words needed_arguments(CLI::App& command) {
  Words words;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() && option->get_required()) words.push_back("argument");
  }
  return words;
}

/// A word for each required flag of a command.
Words needed_flags(CLI::App& command) {
  Words words;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() && option->get_required()) words.push_back("--" + long_name(*option) + "=value");
  }
  return words;
}

class ConfigFile : public testing::Test {
 protected:
  std::string put(const std::string& text) {
    write_text(file_, text);
    return file_;
  }
  ScratchFolder scratch_;
  std::string file_ = scratch_ / "flags.toml";
};

TEST_F(ConfigFile, GivesFlagsToEveryCommand) {
  for (const Words& path : Commands().paths()) {
    SCOPED_TRACE(testing::PrintToString(path));
    Commands commands;
    CLI::App& command = *commands.at(path);
    std::string text = "# flags\nthreads = 1\nprofile = true\nlog = \"off\"  # quiet\n";
    std::vector<CLI::Option*> required;
    for (CLI::Option* option : command.get_options()) {
      if (option->get_positional() || !option->get_required()) continue;
      text += long_name(*option) + " = \"of the file\"\n";
      required.push_back(option);
    }
    read(commands, path + needed_arguments(command) + Words{"--config", put(text)});
    EXPECT_EQ(commands.common.threads, 1);
    EXPECT_TRUE(commands.common.profile);
    EXPECT_EQ(commands.common.log, "off");
    for (CLI::Option* option : required) EXPECT_EQ(option->results(), Words{"of the file"}) << option->get_name();
  }
}

TEST_F(ConfigFile, UnknownKeysAreNamedWithFileAndLineByEveryCommand) {
  put("threads = 1\n\nthraeds = 2\n");
  for (const Words& path : Commands().paths()) {
    SCOPED_TRACE(testing::PrintToString(path));
    EXPECT_THAT(fault_of(path + Words{"--config=" + file_}),
                AllOf(HasSubstr(file_), HasSubstr("line 3"), HasSubstr("thraeds"), HasSubstr("did you mean threads?")));
  }
}

TEST_F(ConfigFile, ThatIsMissingIsRefusedByEveryCommand) {
  for (const Words& path : Commands().paths()) {
    SCOPED_TRACE(testing::PrintToString(path));
    EXPECT_THAT(fault_of(path + Words{"--config", scratch_ / "none.toml"}),
                AllOf(HasSubstr("none.toml"), HasSubstr("is missing")));
  }
}

TEST_F(ConfigFile, IsSeenByTheProgram) {
  const RunResult wrong = run_odosplat({"devices", "--config", put("jsno = true\n")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("flags.toml: line 1: unknown key jsno"), HasSubstr("did you mean json?")));
  EXPECT_EQ(run_odosplat({"devices", "--config", scratch_ / "none.toml"}).status, 2);
  EXPECT_THAT(run_odosplat({"devices", "--config", put("json = true\n")}).out, testing::StartsWith("["));
  EXPECT_THAT(run_odosplat({"devices", "--config", put("json = false\n")}).out, Not(testing::StartsWith("[")));
}

TEST_F(ConfigFile, FlagsOfTheCommandLineWin) {
  put("every = 3\nout = \"file.ply\"\n");
  for (const Words& words : {Words{"--every", "7"}, Words{"--every=7"}}) {
    Commands commands;
    read(commands, Words{"cloud", "seq", "--config", file_} + words);
    EXPECT_EQ(commands.at({"cloud"})->get_option("--every")->results(), Words{"7"});
    EXPECT_EQ(commands.at({"cloud"})->get_option("--out")->results(), Words{"file.ply"});
  }
}

TEST_F(ConfigFile, ValuesAreHeldToTheFlags) {
  const auto fault = [this](const std::string& line) {
    put("out = \"x.ply\"\n" + line + "\n");
    return fault_of({"cloud", "--config", file_});
  };
  EXPECT_THAT(fault("every = 0"), AllOf(HasSubstr("line 2"), HasSubstr("--every: must be an integer from 1")));
  EXPECT_THAT(fault("every = [1, 2]"), HasSubstr("takes one value"));
  EXPECT_THAT(fault("remove-outliers = 1"), HasSubstr("must be true or false"));
  EXPECT_THAT(fault("config = \"other.toml\""), HasSubstr("--config is for the command line alone"));
  EXPECT_THAT(fault("from = [\"a.ply\", \"b.ply\"]\norigin = [1, 2]"), HasSubstr("--origin"));
  EXPECT_EQ(fault("from = [\"a.ply\", \"b.ply\"]\norigin = [1, -2.5, 3]\nvoxel = 0.05"), "");
  EXPECT_THAT(fault("every = 5\nfrom = \"a.ply\""), HasSubstr("excludes"));
}

TEST(ParseConfig, ReadsTomlAsFarAsFlagsNeedIt) {
  const auto entries = apps::parse_config("f",
                                          "\xef\xbb\xbf# a comment\r\n"
                                          "bare-key_1 = 12 # behind\r\n"
                                          "\"quoted key\" = 'C:\\maps\\a#b.ply'\n"
                                          "  text=\"tab\\t quote\\\" B\\u00fcro \\U0001F3A5\"\n"
                                          "list = [ 1_000,\n  -2.5e3, # in between\n  +inf,\n]\n"
                                          "empty = []\nyes = true");
  ASSERT_EQ(entries.size(), 6U);
  EXPECT_EQ(entries[0].key, "bare-key_1");
  EXPECT_EQ(entries[0].values, Words{"12"});
  EXPECT_EQ(entries[0].line, 2U);
  EXPECT_EQ(entries[1].key, "quoted key");
  EXPECT_EQ(entries[1].values, Words{"C:\\maps\\a#b.ply"});
  EXPECT_EQ(entries[2].values, Words{"tab\t quote\" Büro 🎥"});
  EXPECT_EQ(entries[3].values, (Words{"1000", "-2.5e3", "+inf"}));
  EXPECT_TRUE(entries[3].is_array);
  EXPECT_TRUE(entries[4].values.empty());
  EXPECT_EQ(entries[5].line, 10U);
  EXPECT_TRUE(apps::parse_config("f", "").empty());
  const auto tables = apps::parse_config("f", "a . \"b\" = 1\n[ c.d ] # a table\ne = 2\nf.g = 3\n[h]\n");
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].key, "a.b");
  EXPECT_EQ(tables[1].key, "c.d.e");
  EXPECT_EQ(tables[2].key, "c.d.f.g");
}

TEST(ParseConfig, NamesTheLineOfWhatItDoesNotRead) {
  for (const char* text : {"a",
                           "a =",
                           "= 1",
                           "a = b",
                           "a = 1 2",
                           "a = \"open",
                           "a = 'open\n'",
                           "[train",
                           "[]",
                           "[a.]",
                           "[[a]]",
                           "[a] b",
                           "a. = 1",
                           ".a = 1",
                           "a = [1 2]",
                           "a = [1,",
                           "a = [[1]]",
                           "a = \"\\q\"",
                           "a = \"\\ud800\"",
                           "a = \"\"\"x\"\"\"",
                           "a = { b = 1 }",
                           "a = 2026-11-29T00:00:00Z x",
                           "a = 1\na = 2",
                           "[b]\n[b]",
                           "a.b = 1\n[a]\nb = 2"}) {
    try {
      apps::parse_config("flags.toml", std::string("ok = 1\n\n") + text);
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::ContainsRegex("flags.toml: line [3-5]: ")) << text;
    }
  }
}

TEST(NumericFlags, OfEveryCommandHaveARange) {
  int flags = 0;
  for (const Words& path : Commands().paths()) {
    Commands commands;
    for (const CLI::Option* option : commands.at(path)->get_options()) {
      const std::string type = option->get_type_name();
      const std::string flag = "--" + long_name(*option);
      SCOPED_TRACE(testing::PrintToString(path) + " " + flag);
      for (const char* bare : {"INT", "UINT", "FLOAT"}) {
        EXPECT_FALSE(type.starts_with(bare)) << "numbers are declared by add_number";
      }
      if (type != apps::number_type) continue;
      ++flags;
      for (const char* text : {"nan", "inf", "-inf", "1e400", "12x", "0x10", "one"}) {
        Words words = path + Words{flag + "=" + text};
        for (int i = 1; i < option->get_items_expected_min(); ++i) words.push_back("0");
        EXPECT_THAT(fault_of(words), AllOf(HasSubstr(flag + ": must be "), HasSubstr(text)));
      }
      if (flag == "--origin") continue;
      for (const char* text : {"-1", "-5", "-1e300", "-9223372036854775808", "-99999999999999999999"}) {
        EXPECT_THAT(fault_of(path + Words{flag + "=" + text}), AllOf(HasSubstr(flag + ": must be "), HasSubstr(text)));
      }
    }
  }
  EXPECT_GT(flags, 50);
}

TEST(NumericFlags, TakeWordsForWhatIsNoNumber) {
  Commands commands;
  read(commands, {"devices", "--threads", "all"});
  EXPECT_EQ(commands.common.threads, 0);
  EXPECT_EQ(fault_of({"train", "s", "--cloud", "c", "--out", "o", "--iterations", "preset"}), "");
  EXPECT_EQ(fault_of({"devices", "--threads", "1024"}), "");
  EXPECT_THAT(fault_of({"devices", "--threads", "100000"}), HasSubstr("must be all, or an integer from 0 to 1024"));
}

TEST(NumberWords, SayTheRange) {
  using apps::Bounds;
  EXPECT_EQ(apps::words_for(Bounds<double>{}), "a finite number");
  EXPECT_EQ(apps::words_for(Bounds<double>{.least = 0.0}), "a number of 0 or more");
  EXPECT_EQ(apps::words_for(Bounds<double>{.least = 0.0, .most = 0.5}), "a number from 0 to 0.5");
  EXPECT_EQ(apps::words_for(Bounds<double>{.least = 1.0, .most = 9.0, .least_excluded = true}),
            "a number above 1 and at most 9");
  EXPECT_EQ(apps::words_for(Bounds<std::int64_t>{.least = 0, .most = 3, .word = "auto"}),
            "auto, or an integer from 0 to 3");
}

TEST(Devices, ThatDoNotExistAreRefusedByEveryCommand) {
  for (const Words& path : Commands().paths()) {
    SCOPED_TRACE(testing::PrintToString(path));
    Commands commands;
    CLI::App& command = *commands.at(path);
    const Words words = path + needed_arguments(command) + needed_flags(command) + Words{"--device", "no such device"};
    EXPECT_THROW(apps::parse_command_line(commands.app, words), compute::NoSuchDevice);
  }
}

TEST(Help, FitsEightyColumnsAndIsInOrder) {
  std::vector<Words> paths = Commands().paths();
  paths.push_back({});
  paths.push_back({"view"});
  for (const Words& path : paths) {
    SCOPED_TRACE(testing::PrintToString(path));
    Commands commands;
    CLI::App& command = *commands.at(path);
    const std::string help = command.help();
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(text_columns(line), 80) << line;
    EXPECT_THAT(help, Not(HasSubstr("default: -1")));
    EXPECT_THAT(help, Not(HasSubstr(":{")));
    EXPECT_THAT(help, HasSubstr("--help"));
    if (path.empty() || path == Words{"view"}) continue;
    const std::size_t common = help.find("Common flags:");
    ASSERT_NE(common, std::string::npos);
    bool optional_seen = false;
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional()) continue;
      const std::size_t at =
          help.find("\n  " + std::string(option->get_snames().empty() ? "--" : "-h, --") + long_name(*option));
      ASSERT_NE(at, std::string::npos) << option->get_name();
      EXPECT_EQ(at > common, option->get_group() == apps::common_group) << option->get_name();
      const std::string entry = help.substr(at + 1, help.find("\n  -", at + 1) - at - 1);
      EXPECT_EQ(entry.find("(required)") != std::string::npos, option->get_required()) << entry;
      optional_seen = optional_seen || !option->get_required();
    }
    EXPECT_TRUE(optional_seen);
  }
}

TEST(NearestName, IsWhatWasMeant) {
  const Words names{"track", "train", "render", "eval", "eval-depth"};
  EXPECT_EQ(apps::nearest_name("trian", names), "train");
  EXPECT_EQ(apps::nearest_name("trakc", names), "track");
  EXPECT_EQ(apps::nearest_name("evaldepth", names), "eval-depth");
  EXPECT_EQ(apps::nearest_name("fly", names), "");
  EXPECT_EQ(apps::nearest_name("", names), "");
  EXPECT_EQ(apps::nearest_name(std::string(100000, 'x'), names), "");
}

TEST(Outputs, AreNotWrittenOverWhatTheSameRunReadsOrWrites) {
  const std::string folder = testing::TempDir() + "/odosplat_outputs";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string a = folder + "/a.ply";
  const std::string link = folder + "/link.ply";
  write_text(a, "ply\n");
  std::filesystem::create_hard_link(a, link);
  EXPECT_THAT(fault_of({"map", "info", a, "--json", a}), HasSubstr("is the same file as"));
  EXPECT_THAT(fault_of({"train", "seq", "--cloud", a, "--out", link}), HasSubstr("is the same file as --cloud"));
  EXPECT_THAT(fault_of({"eval", a, "--truth", "seq", "--json", folder + "/./a.ply"}), HasSubstr("is the same file as"));
  EXPECT_THAT(fault_of({"train", "seq", "--cloud", "c.ply", "--out", "new.ply", "--report", "./new.ply"}),
              HasSubstr("is the same file as"));
  EXPECT_EQ(fault_of({"train", "seq", "--cloud", a, "--out", folder + "/new.ply", "--report", folder + "/r.json"}), "");
  EXPECT_EQ(fault_of({"render", "--map", a, "--poses", a, "--camera", a, "--out", folder}), "");
  std::filesystem::remove_all(folder);
}

TEST(Outputs, DoNotGoAmongTheFilesOfAnInput) {
  const std::string folder = testing::TempDir() + "/odosplat_outputs_inside";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder + "/seq/rgb");
  const std::string seq = folder + "/seq";
  const std::string file = seq + "/groundtruth.txt";
  write_text(file, "");
  EXPECT_THAT(fault_of({"eval", "a", "--truth", seq, "--json", file}), HasSubstr("is a file in " + seq));
  EXPECT_THAT(fault_of({"cloud", seq, "--out", seq + "/rgb/../groundtruth.txt"}), HasSubstr("is a file in " + seq));
  EXPECT_THAT(fault_of({"track", seq, "--out", seq + "/."}), HasSubstr("is also read"));
  EXPECT_THAT(fault_of({"convert", file, folder + "/seq/./groundtruth.txt"}), HasSubstr("is the same file as"));
  EXPECT_EQ(fault_of({"track", seq, "--out", seq + "/run"}), "");
  EXPECT_EQ(fault_of({"eval", "a", "--truth", seq, "--json", seq + "/new.json"}), "");
  std::filesystem::remove_all(folder);
}

TEST(Values, AreNotEmpty) {
  EXPECT_THAT(fault_of({"eval", "a", "--truth", "b", "--config", ""}), HasSubstr("--config: is empty"));
  EXPECT_THAT(fault_of({"eval", "a", "--truth", "b", "--device", ""}), HasSubstr("--device: is empty"));
  EXPECT_THAT(fault_of({"eval", "", "--truth", "b"}), HasSubstr("EST: is empty"));
}

TEST(Misspelt, CommandsAndFlagsAreNamedWithTheNearest) {
  EXPECT_THAT(fault_of({"trian"}), AllOf(HasSubstr("no such command trian"), HasSubstr("did you mean train?")));
  EXPECT_THAT(fault_of({"view", "mpa"}), AllOf(HasSubstr("view: no such command mpa"), HasSubstr("did you mean map?")));
  EXPECT_THAT(fault_of({"xyzzy"}), AllOf(HasSubstr("no such command xyzzy"), Not(HasSubstr("did you mean"))));
  EXPECT_THAT(fault_of({}), HasSubstr("a command is needed"));
  EXPECT_THAT(fault_of({"view"}), HasSubstr("view: a command is needed"));
  // The misspelt flag is reported, not the missing one, which follows from it.
  EXPECT_THAT(fault_of({"train", "seq", "--clod", "c.ply", "--out", "m.ply"}),
              AllOf(HasSubstr("train: no such flag --clod"), HasSubstr("did you mean --cloud?")));
  EXPECT_THAT(fault_of({"eval", "a", "--truth", "b", "--jsno=c"}), HasSubstr("did you mean --json?"));
  EXPECT_THAT(fault_of({"eval", "a", "b", "--truth", "c"}), HasSubstr("takes no more arguments, there is b"));
  EXPECT_THAT(fault_of({"eval", "a"}), HasSubstr("eval: --truth is required"));
}

}  // namespace
}  // namespace odosplat::apps_test
