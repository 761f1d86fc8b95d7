// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "apps/input/public_options.hpp"
#include "odosplat/core/error.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"
#include "tests/locations.hpp"

namespace odosplat::apps_test {
namespace {

using apps::OptionValues;
using apps::public_options;
using apps::PublicOption;
using apps::TunedOptions;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> all_groups{"odometry", "relocaliser", "train"};

double value_in(const PublicOption& option, TunedOptions& options) {
  return std::visit([](const auto* field) { return static_cast<double>(*field); }, option.field(options));
}

TunedOptions defaults() {
  TunedOptions options;
  options.train = TrainerOptions::preset("default");
  options.start = InitializeOptions::preset("default");
  return options;
}

TunedOptions with(const std::string& setting) {
  const OptionValues values({setting}, all_groups);
  TunedOptions options = defaults();
  values.apply(options.odometry);
  values.apply(options.relocaliser);
  values.apply(options.train);
  values.apply(options.start);
  return options;
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

std::string fault_of(const std::vector<std::string>& settings, const std::vector<std::string>& groups = all_groups) {
  try {
    OptionValues(settings, groups);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Options, EachHasItsOwnNameAndField) {
  std::set<std::string> names;
  std::set<const void*> fields;
  TunedOptions options = defaults();
  for (const PublicOption& option : public_options()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_TRUE(
        fields.insert(std::visit([](auto* field) -> const void* { return field; }, option.field(options))).second)
        << option.name;
    EXPECT_GE(value_in(option, options), option.least) << option.name;
    EXPECT_LE(value_in(option, options), option.most) << option.name;
    EXPECT_FALSE(option.meaning.empty());
  }
}

// The library accepts the whole range in the table, and --set changes only this field.
TEST(Options, ValuesOfTheWholeRangeAreTaken) {
  for (const PublicOption& option : public_options()) {
    for (const double value : {option.least, option.most}) {
      SCOPED_TRACE(option.name + " " + text_of(value));
      TunedOptions options = with(option.name + "=" + text_of(value));
      EXPECT_NEAR(value_in(option, options), value, 1e-6 * value);
      EXPECT_NO_THROW(options.odometry.check());
      EXPECT_NO_THROW(options.relocaliser.check());
      EXPECT_NO_THROW(options.train.check());
      EXPECT_NO_THROW(options.start.check());
      TunedOptions untouched = defaults();
      for (const PublicOption& other : public_options()) {
        if (other.name == option.name) continue;
        EXPECT_EQ(value_in(other, options), value_in(other, untouched)) << other.name;
      }
    }
  }
}

// The fields by name, written a second time: a row that is bound to another field fails.
TEST(Options, NamesAreBoundToTheirFields) {
  TunedOptions o;
  const std::map<std::string, const void*> expected{
      {"odometry.window.keyframes", &o.odometry.window.max_keyframes},
      {"odometry.window.iterations", &o.odometry.optimizer.max_iterations},
      {"odometry.window.points", &o.odometry.keyframe.window_points.points},
      {"odometry.window.anchor_points", &o.odometry.keyframe.window_points.anchor_points},
      {"odometry.keyframe.flow", &o.odometry.policy.translation_flow},
      {"odometry.keyframe.coverage", &o.odometry.policy.min_coverage},
      {"odometry.align.iterations", &o.odometry.aligner.max_iterations},
      {"odometry.align.noise", &o.odometry.aligner.noise},
      {"odometry.accept.inliers", &o.odometry.accept.min_inliers},
      {"odometry.accept.correlation", &o.odometry.accept.min_correlation},
      {"odometry.confirm.confirmed", &o.odometry.confirmation.confirmed},
      {"odometry.confirm.contradicted", &o.odometry.confirmation.contradicted},
      {"odometry.confirm.frames", &o.odometry.max_unconfirmed},
      {"odometry.misfit.translation", &o.odometry.max_misfit_translation},
      {"odometry.misfit.rotation", &o.odometry.max_misfit_rotation},
      {"odometry.memory.keyframes", &o.odometry.memory.capacity},
      {"odometry.covariance.frame", &o.odometry.frame_covariance_factor},
      {"odometry.covariance.keyframe", &o.odometry.keyframe_covariance_factor},
      {"odometry.prefetch", &o.odometry.prefetch_images},
      {"relocaliser.candidates", &o.relocaliser.candidates},
      {"relocaliser.finalists", &o.relocaliser.finalists},
      {"relocaliser.score", &o.relocaliser.min_score},
      {"relocaliser.sigma", &o.relocaliser.max_position_sigma},
      {"train.ssim_weight", &o.train.loss.ssim_weight},
      {"train.depth_cut", &o.train.depth.cut},
      {"train.coarse_levels", &o.train.coarse_levels},
      {"train.color_rate", &o.train.color_rate},
      {"train.densify.until", &o.train.densify.until_share},
      {"train.start.size", &o.start.scale_factor},
      {"train.start.opacity", &o.start.opacity},
  };
  EXPECT_EQ(expected.size(), public_options().size());
  for (const PublicOption& option : public_options()) {
    ASSERT_EQ(expected.count(option.name), 1U) << option.name;
    EXPECT_EQ(std::visit([](auto* field) -> const void* { return field; }, option.field(o)), expected.at(option.name))
        << option.name;
  }
}

// Reports contain exactly the values that were used.
TEST(Options, ValuesAreRecordedAsTheyAre) {
  const OptionValues values({"odometry.align.noise=0.0196078431", "train.start.opacity=0.1"}, all_groups);
  EXPECT_EQ(values.items()[0].second, "0.0196078431");
  EXPECT_EQ(values.items()[1].second, "0.1");
  for (const PublicOption& option : public_options()) {
    TunedOptions set = with(option.name + "=" + option.default_text());
    TunedOptions untouched = defaults();
    EXPECT_EQ(value_in(option, set), value_in(option, untouched)) << option.name;
  }
}

TEST(Options, BadSettingsAreNamed) {
  EXPECT_EQ(fault_of({"odometry.window.keyframes=5", "train.ssim_weight=0.1"}), "");
  EXPECT_THAT(fault_of({"odometry.window.keyframe=5"}),
              AllOf(HasSubstr("unknown option"), HasSubstr("did you mean odometry.window.keyframes?")));
  EXPECT_THAT(fault_of({"odometry.window.keyframes"}), HasSubstr("NAME=VALUE"));
  EXPECT_THAT(fault_of({"odometry.window.keyframes=5.5"}), HasSubstr("whole number"));
  EXPECT_THAT(fault_of({"odometry.window.keyframes=1"}), HasSubstr("3..20"));
  EXPECT_EQ(fault_of({"train.ssim_weight=+0.5"}), "");
  for (const char* text : {"nan", "inf", "", "0.5x", "0,5", "+-1", "0x1"}) {
    EXPECT_THAT(fault_of({std::string("train.ssim_weight=") + text}), HasSubstr("must be a number")) << text;
  }
  EXPECT_THAT(fault_of({"odometry.window.keyframes=5", "odometry.window.keyframes=6"}), HasSubstr("twice"));
  EXPECT_THAT(fault_of({"train.ssim_weight=0.1"}, {"odometry", "relocaliser"}),
              AllOf(HasSubstr("no option of this command"), HasSubstr("odometry.*, relocaliser.*")));
}

TEST(Options, ThePageIsWhatTheProgramPrints) {
  const RunResult page = run_odosplat({"options", "--markdown"});
  ASSERT_EQ(page.status, 0) << page.err;
  EXPECT_EQ(page.out, read_text(std::filesystem::path(test::source_dir()) / "docs/options.md"))
      << "odosplat options --markdown > docs/options.md";
  const RunResult json = run_odosplat({"options", "--json"});
  EXPECT_THAT(json.out, AllOf(HasSubstr("\"odometry.window.keyframes\""), HasSubstr("\"default\": 7,")));
}

TEST(Options, AreSeenByTheCommands) {
  const ScratchFolder scratch;
  write_tiny_sequence(scratch / "seq", 24);
  const std::string sequence = scratch / "seq";
  const std::string cloud = scratch / "cloud.ply";
  ASSERT_EQ(run_odosplat({"cloud", sequence, "--every", "3", "--voxel", "0.05", "--out", cloud}).status, 0);
  const auto train = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"train", sequence,       "--every", "3",     "--cloud",
                                   cloud,   "--iterations", "60",      "--out", scratch / name};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  };
  ASSERT_EQ(train("map.ply", {}).status, 0);
  ASSERT_EQ(train("other.ply", {"--set", "train.start.opacity=0.5", "--set", "train.ssim_weight=0"}).status, 0);
  EXPECT_NE(read_text(scratch / "map.ply"), read_text(scratch / "other.ply"));
  EXPECT_THAT(read_text(scratch / "other.ply").substr(0, 20000), HasSubstr("option train.start.opacity 0.5"));

  const auto track = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"track", sequence, "--map", scratch / "map.ply", "--out", scratch / name};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  };
  ASSERT_EQ(track("run", {}).status, 0);
  ASSERT_EQ(track("set", {"--set", "odometry.covariance.frame=9"}).status, 0);
  EXPECT_EQ(read_text(scratch / "run/trajectory.txt"), read_text(scratch / "set/trajectory.txt"));
  EXPECT_NE(read_text(scratch / "run/covariance.csv"), read_text(scratch / "set/covariance.csv"));
  EXPECT_THAT(read_text(scratch / "set/report.json"), HasSubstr("\"odometry.covariance.frame\": 9.0"));

  // A file of flags, with a table or a dotted key, has the same effect; the command line takes precedence.
  write_text(scratch / "flags.toml", "seed = 3141592\n[odometry.covariance]\nframe = 9\n");
  ASSERT_EQ(track("file", {"--config", scratch / "flags.toml"}).status, 0);
  EXPECT_EQ(read_text(scratch / "file/covariance.csv"), read_text(scratch / "set/covariance.csv"));
  write_text(scratch / "flags.toml", "odometry.covariance.frame = 4\n");
  EXPECT_THAT(track("none", {"--relocalise", "off", "--set", "relocaliser.score=0.9"}).err,
              HasSubstr("relocaliser.*: is not used"));
  const auto look_up = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"relocalise", sequence, "--map", scratch / "map.ply", "--json", scratch / "l.json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  };
  const RunResult strict = look_up({"--set", "relocaliser.score=0.99", "--set", "relocaliser.sigma=0.001"});
  EXPECT_THAT(strict.out, HasSubstr(" 0 found"));
  EXPECT_EQ(strict.status, 3);
  EXPECT_THAT(read_text(scratch / "l.json"), HasSubstr("\"relocaliser.score\": 0.99"));
  ASSERT_EQ(track("both", {"--config", scratch / "flags.toml", "--set", "odometry.covariance.frame=9"}).status, 0);
  EXPECT_EQ(read_text(scratch / "both/covariance.csv"), read_text(scratch / "set/covariance.csv"));
}

TEST(Options, FaultsInAFileNameItsLine) {
  const ScratchFolder scratch;
  const auto fault = [&](const std::string& text, const std::string& command) {
    write_text(scratch / "flags.toml", text);
    std::vector<std::string> words{command, "--config", scratch / "flags.toml"};
    const RunResult run = run_odosplat(words);
    EXPECT_EQ(run.status, 2) << text;
    return run.err;
  };
  EXPECT_THAT(fault("[odometry.window]\nkeyframe = 3\n", "track"),
              AllOf(HasSubstr("flags.toml: line 2"), HasSubstr("did you mean odometry.window.keyframes?")));
  EXPECT_THAT(fault("odometry.window.keyframes = 1\n", "track"), AllOf(HasSubstr("line 1"), HasSubstr("3..20")));
  EXPECT_THAT(fault("odometry.window.keyframes = 1\n", "track"), Not(HasSubstr("--set")));
  EXPECT_THAT(fault("odometry.window.keyframes = 5\n", "devices"), HasSubstr("no options to set"));
  EXPECT_THAT(fault("[odometry.window]\nkeyframes = 5\nseed = 7\n", "track"),
              AllOf(HasSubstr("line 3"), HasSubstr("flags stand above the first [table]")));
  EXPECT_THAT(fault("set = [\"odometry.window.keyframes=5\"]\n", "track"), HasSubstr("write NAME = VALUE"));
  EXPECT_THAT(fault("seed = 1\n[seed]\n", "track"), HasSubstr("seed is a value above"));
  EXPECT_THAT(fault("a = { b = 1 }\n", "track"), HasSubstr("inline tables are not read"));
  EXPECT_THAT(fault("odometry.window.keyframes = [5]\n", "track"), HasSubstr("not an array"));
  EXPECT_THAT(fault("[a]\nx = 1\n[a]\n", "track"), HasSubstr("line 3"));
}

}  // namespace
}  // namespace odosplat::apps_test
