// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <string>

#include "odosplat/eval/convention_check.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "tests/locations.hpp"

namespace odosplat {
namespace {

struct DataSet {
  const char* name;
  double max_error_mm;  // with the right convention
  bool shift_told;      // whether the set decides a shift of the ids and ...
  bool scale_told;      // ... a wrong depth scale
};

std::ostream& operator<<(std::ostream& out, const DataSet& set) { return out << set.name; }

// The limits are slightly above the errors in the sets' README at a gap of 20 frames: 2.0, 1.0, 0.6, 0.6, 8.7 mm.
const DataSet data_sets[] = {
    {"icl_office_kt3", 2.5, true, true},
    {"icl_office_traj3_frei_png", 1.5, true, true},
    {"aug_icl_livingroom1", 1.0, true, true},
    {"aug_icl_livingroom1_redwood", 1.0, true, true},
    {"7scenes_redkitchen", 10.0, true, true},
    {"7scenes_redkitchen_official", 10.0, false, false},  // twelve frames of slow motion
    {"tum_fr1_rpy_short", 25.0, false, false},            // eight frames, mostly rotation
    {"replica_office0_short", 2.0, false, true},
    // 4 degrees per frame: images overlap too little at the default gap.
    {"hololens_kitchen", 12.0, true, true},
};

// The poses of a TUM sequence at the times of its depth images. Each was taken some 10 ms before its colour image, and
// Sequence gives poses at the times of colour. The difference of a third of a frame would affect the check.
std::vector<std::optional<SE3>> poses_at_depth(const std::string& folder, const Trajectory& truth) {
  std::vector<std::optional<SE3>> poses;
  std::ifstream list(folder + "/depth.txt");
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    const double time = std::stod(line);
    const auto after =
        std::find_if(truth.begin() + 1, truth.end(), [&](const StampedPose& p) { return p.time > time; });
    const auto before = after - 1;
    const double share = (time - before->time) / (after->time - before->time);
    poses.emplace_back(interpolate(before->T_world_camera, after->T_world_camera, share));
  }
  return poses;
}

class ConventionOfData : public testing::TestWithParam<DataSet> {
 protected:
  void SetUp() override {
    const std::string path = test::shared_data() + "/" + GetParam().name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the set is not at " << path;
    SequenceOptions options;
    options.as_stored = true;
    const Sequence sequence = Sequence::open(path, options);
    input_.camera = sequence.camera();
    input_.fy_sign = sequence.fy_sign();
    input_.depth_scale = sequence.depth_scale();
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
      if (!sequence.has_depth(i)) continue;
      frames.push_back(i);
      input_.T_world_camera.push_back(sequence.T_world_camera(i));
    }
    if (std::string(GetParam().name) == "tum_fr1_rpy_short") {
      input_.T_world_camera = poses_at_depth(path, sequence.truth());
    }
    input_.depth = [this, sequence, frames](std::size_t k) {
      const auto [it, is_new] = images_.try_emplace(k);
      if (is_new) it->second = sequence.depth(frames[k]);
      return it->second;
    };
  }

  ConventionInput input_;
  std::map<std::size_t, DepthImage> images_;
};

TEST_P(ConventionOfData, IsAsDeclared) {
  const ConventionReport r = check_conventions(input_);
  EXPECT_TRUE(r.as_declared) << r.verdict << "\n" << convention_table(r, input_.camera);
  EXPECT_LT(1000.0 * r.winner_error_m, GetParam().max_error_mm);
  EXPECT_TRUE(r.findings[0].decided) << r.findings[0].text;
  EXPECT_TRUE(r.findings[1].decided) << r.findings[1].text;
  EXPECT_EQ(r.findings[2].decided, GetParam().shift_told) << convention_table(r, input_.camera);
  EXPECT_EQ(r.findings[3].decided, GetParam().scale_told) << convention_table(r, input_.camera);
}

TEST_P(ConventionOfData, AFlippedFyIsFound) {
  ConventionInput input = input_;
  input.fy_sign = -input.fy_sign;
  const ConventionReport r = check_conventions(input);
  EXPECT_EQ(r.winner.fy_sign, input_.fy_sign);
  EXPECT_THAT(r.verdict, testing::HasSubstr("fy: the data want"));
}

TEST_P(ConventionOfData, ShiftedIdsAreFoundOrCalledOpen) {
  for (const int shift : {-1, 1}) {
    ConventionInput input = input_;
    const auto n = static_cast<std::ptrdiff_t>(input_.T_world_camera.size());
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const std::ptrdiff_t from = i - shift;
      input.T_world_camera[static_cast<std::size_t>(i)] =
          from >= 0 && from < n ? input_.T_world_camera[static_cast<std::size_t>(from)] : std::nullopt;
    }
    const ConventionReport r = check_conventions(input);
    if (GetParam().shift_told) {
      EXPECT_EQ(r.winner.id_shift, shift) << r.verdict;
      EXPECT_TRUE(r.findings[2].decided) << r.verdict;
    } else {
      EXPECT_THAT(r.verdict, testing::HasSubstr("id shift:")) << "neither found nor called open";
    }
  }
}

TEST_P(ConventionOfData, AWrongDepthScaleIsFoundOrCalledOpen) {
  const double wrong = input_.depth_scale == 1000.0 ? 5000.0 : 1000.0;
  ConventionInput input = input_;
  input.depth_scale = wrong;
  input.depth = [&](std::size_t k) { return DepthImage(input_.depth(k) * (input_.depth_scale / wrong)); };
  const ConventionReport r = check_conventions(input);
  if (GetParam().scale_told) {
    EXPECT_EQ(r.winner.depth_scale, input_.depth_scale) << r.verdict;
    EXPECT_TRUE(r.findings[3].decided) << r.verdict;
  } else {
    EXPECT_THAT(r.verdict, testing::HasSubstr("depth scale:")) << "neither found nor called open";
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, ConventionOfData, testing::ValuesIn(data_sets),
                         [](const auto& param_info) { return "set_" + std::string(param_info.param.name); });

}  // namespace
}  // namespace odosplat
