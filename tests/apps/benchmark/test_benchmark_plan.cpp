// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Reading suites and planning their jobs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/benchmark/plan.hpp"
#include "odosplat/core/error.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps {
namespace {

using apps_test::ScratchFolder;
using apps_test::write_text;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string fault_of(const ScratchFolder& folder, const std::string& text) {
  write_text(folder / "suite.yaml", text);
  try {
    read_suite((folder / "suite.yaml").string(), "");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

const char* const two_rooms = R"(suite: rooms
scenes:
  - {name: kitchen, noise: 0.01}
  - {name: hall, words: Hall, cloud: [missing.ply, hall.ply]}
sequences:
  - {name: k1, scene: kitchen, path: k1}
  - {name: k2, scene: kitchen, path: k2}
  - {name: h1, scene: hall, path: [elsewhere, h1]}
methods:
  - {name: mine, command: [./mine, "{sequence}", "--cloud={cloud}", "{out}/x", "{seed}"]}
)";

class BenchmarkPlan : public testing::Test {
 protected:
  BenchmarkPlan() {
    write_text(folder / "suite.yaml", two_rooms);
    write_text(folder / "hall.ply", "");
    for (const char* name : {"k1", "k2", "h1"}) std::filesystem::create_directory(folder / name);
    options.suite = (folder / "suite.yaml").string();
    options.out = (folder / "out").string();
  }
  const Job& job(const Plan& plan, const std::string& id) const {
    const auto found = std::find_if(plan.jobs.begin(), plan.jobs.end(), [&](const Job& j) { return j.id == id; });
    if (found == plan.jobs.end()) throw std::runtime_error("no job " + id);
    return *found;
  }
  std::string words(const Plan& plan, const std::string& id) const {
    std::string text;
    for (const std::string& word : job(plan, id).command) text += word + " ";
    return text;
  }

  ScratchFolder folder;
  BenchmarkOptions options;
};

TEST(Suite, FaultsNameFileLineAndKey) {
  const ScratchFolder folder;
  EXPECT_THAT(fault_of(folder, "suite: [\n"), HasSubstr("suite.yaml:"));
  EXPECT_THAT(fault_of(folder, "scenes: []\n"), HasSubstr("lacks suite"));
  EXPECT_THAT(fault_of(folder, "suite: a\nscene: []\n"), HasSubstr("suite.yaml:2: the suite has no key scene"));
  EXPECT_THAT(fault_of(folder, "suite: a\n"), HasSubstr("has no sequences"));
  EXPECT_THAT(fault_of(folder, "suite: a\nscenes: [{name: a/b}]\n"), HasSubstr("must be of letters"));
  EXPECT_THAT(fault_of(folder, "suite: a\nscenes: [{name: a}]\nsequences:\n- {name: s, scene: b, path: x}\n"),
              HasSubstr("suite.yaml:4: s: there is no scene b"));
  EXPECT_THAT(fault_of(folder, "suite: a\nscenes: [{name: a}]\nsequences:\n- {name: s, scene: a, walk: w}\n"),
              HasSubstr("needs a path"));
  EXPECT_THAT(fault_of(folder, "suite: a\nscenes: [{name: a, stand_in: r}]\nsequences:\n- {name: s, scene: a}\n"),
              HasSubstr("needs a walk"));
  EXPECT_THAT(fault_of(folder, "suite: a\nscenes: [{name: a, voxel: -1}]\n"), HasSubstr("voxel must not be negative"));
  EXPECT_THAT(fault_of(folder, "suite: a\ndepth_noise: fog\n"), HasSubstr("none or kinect"));
  const std::string twice = "suite: a\nscenes: [{name: a}]\nsequences:\n- {name: s, scene: a, path: x}\n";
  EXPECT_EQ(fault_of(folder, twice), "");
  EXPECT_THAT(fault_of(folder, twice + "- {name: s, scene: a, path: x}\n"), HasSubstr("s is listed twice"));
}

TEST(Suite, TheBuiltInOnesHaveThePapersEightSequences) {
  const std::vector<std::string> names{"icl_1", "icl_2", "icl_3", "icl_4", "augm_1", "augm_2", "augm_3", "augm_4"};
  for (const char* suite_name : {"synthetic", "icl"}) {
    const ScratchFolder folder;
    const Suite suite = read_suite(suite_name, folder.path().string());
    std::vector<std::string> found;
    for (const SuiteSequence& s : suite.sequences) found.push_back(s.name);
    EXPECT_EQ(found, names);
  }
  EXPECT_TRUE(read_suite("synthetic", "").stand_in());
  EXPECT_THROW(read_suite("icl", ""), InputError);
}

TEST_F(BenchmarkPlan, OneMapASceneSharedByItsSequences) {
  const Plan plan = make_plan(options);
  EXPECT_EQ(plan.runs.size(), 3U * 6U);
  EXPECT_EQ(plan.maps.size(), 4U);  // for each of two scenes one of the default and one of the paper's preset
  EXPECT_THAT(words(plan, "map/kitchen"), HasSubstr("/k1 "));
  EXPECT_THAT(words(plan, "map/kitchen"), HasSubstr("/k2 "));
  EXPECT_THAT(words(plan, "cloud/kitchen"), HasSubstr("--noise 0.01"));
  EXPECT_THAT(words(plan, "cloud/hall"), HasSubstr("--from " + (folder / "hall.ply").string()));
  EXPECT_THAT(job(plan, "track/k2/gaussian/1").needs, Contains("map/kitchen"));
  EXPECT_THAT(words(plan, "track/h1/paper/1"), HasSubstr("maps/hall_paper.ply"));
  EXPECT_THAT(job(plan, "track/h1/rgbd/1").needs, IsEmpty());
  const auto prints = fingerprints(plan.jobs);  // throws if a job precedes one that it needs
  EXPECT_EQ(prints.size(), plan.jobs.size());
}

TEST_F(BenchmarkPlan, SplitKeepsTestedSequencesOutOfTheirMaps) {
  options.mapping = "split";
  apps_test::write_tiny_sequence(folder / "h1", 21);  // planning reads its number of frames
  const Plan plan = make_plan(options);
  EXPECT_THAT(words(plan, "track/k1/gaussian/1"), HasSubstr("maps/kitchen_b.ply"));
  EXPECT_THAT(words(plan, "map/kitchen_b"), HasSubstr("/k2 "));
  EXPECT_THAT(words(plan, "map/kitchen_b"), Not(HasSubstr("/k1 ")));
  EXPECT_THAT(words(plan, "map/kitchen_a"), Not(HasSubstr("/k2 ")));
  EXPECT_THAT(words(plan, "cloud/kitchen_a"), Not(HasSubstr("/k2 ")));
  // A scene with one sequence: the map is made of its first half and tested on its second.
  EXPECT_THAT(words(plan, "map/hall_b"), HasSubstr("--frames 0:10"));
  EXPECT_THAT(words(plan, "track/h1/gaussian/1"), HasSubstr("--frames 10:21"));
}

TEST_F(BenchmarkPlan, AMethodOfTheSuiteGetsItsPlaceholders) {
  const Plan plan = make_plan(options);
  const std::vector<std::string> expected{"./mine", (folder / "k1").string(),
                                          "--cloud=" + (folder / "out/clouds/kitchen.ply").string(),
                                          (folder / "out/runs/k1/mine/1/x").string(), "1"};
  EXPECT_EQ(job(plan, "track/k1/mine/1").command, expected);
  EXPECT_THAT(job(plan, "track/k1/mine/1").needs, Contains("cloud/kitchen"));
}

TEST_F(BenchmarkPlan, ChoicesAreTakenAndWrongOnesNamed) {
  options.methods = {"gaussian_no_anchor", "rgbd"};
  options.sequences = {"h1"};
  options.runs = 3;
  const Plan plan = make_plan(options);
  EXPECT_EQ(plan.runs.size(), 6U);
  EXPECT_EQ(plan.maps.size(), 1U);
  EXPECT_THAT(words(plan, "track/h1/rgbd/3"), HasSubstr("--seed 3"));
  options.methods = {"orb_slam"};
  EXPECT_THROW(make_plan(options), InputError);
  options.methods = {"rgbd", "rgbd"};
  EXPECT_THROW(make_plan(options), InputError);
  options.methods = {};
  options.sequences = {"h2"};
  EXPECT_THROW(make_plan(options), InputError);
  options.sequences = {};
  options.mapping = "all";
  EXPECT_THROW(make_plan(options), InputError);
  options.mapping = "every";
  options.runs = 0;
  EXPECT_THROW(make_plan(options), InputError);
}

TEST_F(BenchmarkPlan, IsMadeAgainFromItsFile) {
  options.runs = 2;
  options.quick = true;
  const Plan plan = make_plan(options);
  write_plan(plan);
  const Plan again = read_plan(options.out);
  EXPECT_EQ(fingerprints(again.jobs), fingerprints(plan.jobs));
  EXPECT_THROW(read_plan((folder / "nothing").string()), InputError);
}

TEST_F(BenchmarkPlan, AMissingRecordingIsNamed) {
  std::filesystem::remove_all(folder / "h1");
  try {
    make_plan(options);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("sequence h1"));
    EXPECT_THAT(e.what(), HasSubstr("elsewhere"));
  }
}

TEST_F(BenchmarkPlan, PathsNeedNotBeUtf8) {
  const std::filesystem::path data = folder / "caf\xe9";
  std::filesystem::create_directory(data);
  for (const char* name : {"k1", "k2", "h1", "hall.ply"}) std::filesystem::rename(folder / name, data / name);
  std::filesystem::rename(folder / "suite.yaml", data / "suite.yaml");
  options.suite = (data / "suite.yaml").string();
  options.root = data.string();
  options.out = (data / "out").string();
  const Plan plan = make_plan(options);
  write_plan(plan);
  const Plan again = read_plan(options.out);
  EXPECT_EQ(again.options.suite, options.suite);
  EXPECT_EQ(again.options.root, options.root);
  ASSERT_EQ(again.jobs.size(), plan.jobs.size());
  EXPECT_EQ(fingerprints(again.jobs), fingerprints(plan.jobs));
}

}  // namespace
}  // namespace odosplat::apps
