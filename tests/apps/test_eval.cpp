// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// `eval` and `view trajectory` on files and folders of other programs and data sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/run_program.hpp"

namespace odosplat::apps_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr int frames = 24;
const std::string camera_yaml = "width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\ndepth_scale: 1000\n";

// Pose of frame k, in the world frame of the poses that `track` writes.
SE3 pose_of(int k) {
  const double s = 0.1 * k;
  return {so3_exp({0.05 * s, 0.3 * s, -0.1 * s}), Eigen::Vector3d(s, 0.5 * std::sin(s), 0.2 * s * s)};
}
// F T F with F = diag(1, -1, 1), as a pose.
SE3 mirrored(const SE3& T) {
  const Eigen::Matrix4d F = Eigen::Vector4d(1, -1, 1, 1).asDiagonal();
  const Eigen::Matrix4d M = F * T.matrix() * F;
  return {Eigen::Matrix3d(M.topLeftCorner<3, 3>()), Eigen::Vector3d(M.topRightCorner<3, 1>())};
}

std::string numbers(const std::vector<double>& values, const std::string& between) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    char word[40];
    std::snprintf(word, sizeof(word), "%.12g", values[i]);
    text += (i > 0 ? between : "") + word;
  }
  return text;
}
// The first `count` rows of the pose's matrix; every fourth number is followed by `end`.
std::string rows(const SE3& T, int count, const std::string& end) {
  std::string text;
  for (int r = 0; r < count; ++r) {
    const Eigen::RowVector4d row = T.matrix().row(r);
    text += numbers({row[0], row[1], row[2], row[3]}, " ") + (r + 1 < count ? end : "\n");
  }
  return text;
}
std::string tum(const std::string& stamp, const SE3& T) {
  const Eigen::Vector3d& t = T.translation();
  const Eigen::Quaterniond& q = T.rotation();
  return stamp + " " + numbers({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}, " ") + "\n";
}

class Eval : public testing::Test {
 protected:
  // A file of poses of `count` frames from `first` on, moved by 1 cm along x. Times begin at `start` [s] and are
  // written with `per_second` units per second.
  std::string estimate(int first = 0, int count = frames, double per_second = 1.0, double start = 0.0) {
    std::string text;
    for (int k = first; k < first + count; ++k) {
      const SE3 T = pose_of(k);
      char stamp[40];
      std::snprintf(stamp, sizeof(stamp), "%.6f", per_second * (start + k / 30.0));
      text += tum(stamp, SE3(T.rotation(), T.translation() + Eigen::Vector3d(0.01, 0, 0)));
    }
    return put("est.txt", text);
  }
  std::string put(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((scratch_ / name).parent_path());
    write_text(scratch_ / name, text);
    return scratch_ / name;
  }
  void put_image(const std::string& name, int k) {
    std::filesystem::create_directories((scratch_ / name).parent_path());
    write_color(scratch_ / name, ColorImage(12, 16, cv::Vec3f::all(0.02F * static_cast<float>(k))));
  }
  RunResult eval(const std::string& est, const std::string& truth, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"eval", est, "--truth", truth, "--json", json_, "--log", "warning"};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  }
  json report() { return json::parse(read_text(json_)); }

  void expect_all_matched(const std::string& truth) {
    SCOPED_TRACE(truth);
    const RunResult run = eval(estimate(), truth);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(report()["pairs"], frames);
    EXPECT_EQ(report()["coverage"], 1.0);
    EXPECT_NEAR(report()["ate_m"]["max"], 0.01, 1e-6);
    EXPECT_NEAR(report()["rre_deg"]["max"], 0.0, 1e-4);
  }

  ScratchFolder scratch_;
  std::string json_ = scratch_ / "eval.json";
};

TEST_F(Eval, TakesPosesWithoutTimesForThoseOfAsManyImages) {
  std::string rgb;
  std::string truth;
  std::string kitti;
  put("seq/camera.yaml", camera_yaml);
  for (int k = 0; k < frames; ++k) {
    const std::string id = std::to_string(k);
    char stamp[40];
    std::snprintf(stamp, sizeof(stamp), "%.6f", 100.0 + k / 30.0);
    put_image("seq/rgb/" + id + ".png", k);
    rgb += std::string(stamp) + " rgb/" + id + ".png\n";
    truth += tum(stamp, pose_of(k));
    kitti += rows(pose_of(k), 3, " ");
  }
  put("seq/rgb.txt", rgb);
  put("seq/groundtruth.txt", truth);
  const RunResult run = eval(put("kitti.txt", kitti), scratch_ / "seq");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(report()["pairs"], frames);
  EXPECT_NEAR(report()["ate_m"]["max"], 0.0, 1e-6);
  const RunResult fewer =
      eval(put("kitti.txt", kitti.substr(0, kitti.rfind('\n', kitti.size() - 2) + 1)), scratch_ / "seq");
  EXPECT_EQ(fewer.status, 2);
  EXPECT_THAT(fewer.err, HasSubstr("has no times"));
}

TEST_F(Eval, AnEstimateIsComparedWithThePoseOfTheTimeAtWhichItsImageWasTaken) {
  std::string rgb;
  std::string truth;
  put("seq/camera.yaml", camera_yaml + "time_offset: 0.1\n");  // three images
  for (int k = 0; k < frames; ++k) {
    const std::string id = std::to_string(k);
    char stamp[40];
    std::snprintf(stamp, sizeof(stamp), "%.6f", k / 30.0);
    put_image("seq/rgb/" + id + ".png", k);
    rgb += std::string(stamp) + " rgb/" + id + ".png\n";
    truth += tum(stamp, pose_of(k));
  }
  put("seq/rgb.txt", rgb);
  put("seq/groundtruth.txt", truth);
  const RunResult run = eval(estimate(3, frames - 3, 1.0, -0.1), scratch_ / "seq");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(report()["pairs"], frames - 3);
  EXPECT_EQ(report()["coverage"], 1.0);
  EXPECT_NEAR(report()["ate_m"]["max"], 0.01, 1e-6);
}

TEST_F(Eval, RefusesErrorsThatAreNoNumbers) {
  const std::string truth = put("truth.txt", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  const RunResult run = eval(put("est.txt", "0 1e300 0 0 0 0 0 1\n1 -1e300 0 0 0 0 0 1\n"), truth);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("so large"));
  EXPECT_FALSE(std::filesystem::exists(json_));
}

TEST_F(Eval, TakesASequenceInEveryLayout) {
  std::string images = "";
  std::string rgb;
  std::string truth;
  std::string icl_list;
  std::string icl_truth;
  std::string log;
  std::string replica;
  std::string colmap;
  json nerf{{"w", 16}, {"h", 12}, {"fl_x", 20.0}, {"fl_y", 21.0}, {"cx", 8.0}, {"cy", 6.0}};
  for (const char* folder : {"tum", "icl", "redwood", "scenes", "replica"}) {
    put(std::string(folder) + "/camera.yaml", camera_yaml);
  }
  for (int k = 0; k < frames; ++k) {
    const SE3 T = pose_of(k);
    const std::string id = std::to_string(k);
    char stamp[40];
    std::snprintf(stamp, sizeof(stamp), "%.6f", k / 30.0);
    put_image("tum/rgb/" + id + ".png", k);
    rgb += std::string(stamp) + " rgb/" + id + ".png\n";
    truth += tum(stamp, T);
    put_image("icl/rgb/" + id + ".png", k);
    icl_list += id + " depth/" + id + ".png " + id + " rgb/" + id + ".png\n";
    icl_truth += tum(id, mirrored(T));
    put_image("redwood/room-color/" + id + ".png", k);
    log += id + " " + id + " 0\n" + rows(T, 4, "\n");
    put_image("scenes/seq-01/frame-" + id + ".color.png", k);
    put("scenes/seq-01/frame-" + id + ".pose.txt", rows(T, 4, "\n"));
    put_image("replica/results/frame" + id + ".png", k);
    replica += rows(T, 4, " ");
    put_image("colmap/images/" + id + ".png", k);
    put_image("nerf/images/" + id + ".png", k);
  }
  // Listed in another order than that of the names, as these programs do.
  for (int j = 0; j < frames; ++j) {
    const int k = (7 * j) % frames;
    const SE3 T = pose_of(k).inverse();
    const Eigen::Quaterniond& q = T.rotation();
    const Eigen::Vector3d& t = T.translation();
    colmap += std::to_string(j + 1) + " " + numbers({q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}, " ") + " 1 " +
              std::to_string(k) + ".png\n\n";
    const Eigen::Matrix4d gl = pose_of(k).matrix() * Eigen::Vector4d(1, -1, -1, 1).asDiagonal();
    json matrix;
    for (int r = 0; r < 4; ++r) matrix.push_back({gl(r, 0), gl(r, 1), gl(r, 2), gl(r, 3)});
    nerf["frames"].push_back({{"file_path", "images/" + std::to_string(k) + ".png"}, {"transform_matrix", matrix}});
  }
  put("tum/rgb.txt", rgb);
  put("tum/groundtruth.txt", truth);
  put("icl/associations.txt", icl_list);
  put("icl/traj0.gt.freiburg", icl_truth);
  put("icl/camera.yaml", "width: 16\nheight: 12\nfx: 20\nfy: -21\ncx: 7.5\ncy: 5.5\n");
  put("redwood/room-traj.txt", log);
  put("replica/traj.txt", replica);
  put("colmap/cameras.txt", "1 PINHOLE 16 12 20 21 8 6\n");
  put("colmap/images.txt", colmap);
  put("nerf/transforms.json", nerf.dump());
  for (const char* name : {"tum", "tum/groundtruth.txt", "icl", "redwood", "scenes", "scenes/seq-01", "replica",
                           "colmap", "nerf", "nerf/transforms.json"}) {
    expect_all_matched(scratch_ / name);
  }

  // An estimate of only some of the frames.
  RunResult run = eval(estimate(6, 6), scratch_ / "icl");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(report()["coverage_estimate"], 1.0);
  EXPECT_EQ(report()["coverage_truth"], 0.25);
  EXPECT_EQ(report()["coverage"], 0.25);
  run = eval(estimate(6, 6), scratch_ / "icl", {"--frames", "6:12"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(report()["coverage"], 1.0);

  EXPECT_THAT(eval(estimate(), scratch_ / "tum/groundtruth.txt", {"--frames", "0:5"}).err,
              HasSubstr("--frames: needs a sequence as --truth"));
  EXPECT_THAT(eval(estimate(), scratch_ / "tum", {"--frames", "40:50"}).err, HasSubstr("the sequence has 24"));
  EXPECT_THAT(eval(estimate(), scratch_ / "tum", {"--truth-times", "x"}).err,
              HasSubstr("--truth-times: is for a file"));
  std::filesystem::remove(scratch_ / "tum/groundtruth.txt");
  run = eval(estimate(), scratch_ / "tum");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("has no true poses"));
}

TEST_F(Eval, UnderHalfMatchedEndsWith3AndTheReason) {
  std::string text;
  for (int k = 0; k < frames; ++k) text += tum(std::to_string(k / 30.0), pose_of(k));
  const std::string truth = put("truth.txt", text);
  for (const auto& [factor, unit] : {std::pair{1e3, "ms"}, std::pair{1e9, "ns"}}) {
    const RunResult run = eval(estimate(0, frames, factor), truth);
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("1 of 24 poses of the estimate"));
    EXPECT_THAT(run.err, HasSubstr(std::string("the stamps of the estimate look like ") + unit));
    EXPECT_THAT(run.out, HasSubstr("coverage 4.2 %"));
    EXPECT_LT(report()["coverage"], 0.05);
    EXPECT_LT(report()["coverage_truth"], 0.05);
  }
  std::filesystem::remove(json_);
  const RunResult none = eval(estimate(0, frames, 1.0, 5000.0), truth);
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("0 of 24 poses"));
  EXPECT_THAT(none.err, HasSubstr("a constant offset of about 5000.000 s"));
  EXPECT_FALSE(std::filesystem::exists(json_));
}

TEST_F(Eval, KittiWithoutTimesNeedsEquallyManyPoses) {
  std::string all;
  std::string key;
  std::string all_times;
  std::string key_times;
  for (int k = 0; k < frames; ++k) {
    all += rows(pose_of(k), 3, " ");
    all_times += std::to_string(k / 10.0) + "\n";
    if (k % 6 != 0) continue;
    key += rows(pose_of(k), 3, " ");
    key_times += std::to_string(k / 10.0) + "\n";
  }
  const std::string truth = put("truth.txt", all);
  const std::string est = put("est.txt", key);
  EXPECT_EQ(eval(truth, truth).status, 0);
  RunResult run = eval(est, truth);
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("holds 4 poses without times"));
  EXPECT_THAT(run.err, HasSubstr("--truth-times"));
  run = eval(est, truth, {"--times", put("k.txt", key_times), "--truth-times", put("a.txt", all_times)});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(report()["pairs"], 4);
  EXPECT_LT(report()["ate_m"]["max"], 1e-6);
  EXPECT_EQ(eval(estimate(), truth).status, 2);
}

TEST_F(Eval, ReadsEurocTables) {
  std::string narrow;
  for (int k = 0; k < frames; ++k) {
    const SE3 T = pose_of(k);
    const Eigen::Vector3d& t = T.translation();
    const Eigen::Quaterniond& q = T.rotation();
    narrow += std::to_string(1403636580000000000LL + 50000000LL * k) + "," +
              numbers({t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}, ",") + "\n";
  }
  std::string wide;
  for (const char c : narrow) wide += c == '\n' ? ",0,0,0,0,0,0,0,0,0\n" : std::string(1, c);
  std::string est;
  for (int k = 0; k < frames; ++k) {
    char stamp[40];
    std::snprintf(stamp, sizeof(stamp), "%.6f", 1403636580.0 + 0.05 * k);
    est += tum(stamp, pose_of(k));
  }
  put("est.txt", est);
  for (const std::string& table : {narrow, wide}) {
    const RunResult run = eval(scratch_ / "est.txt", put("data.csv", table));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(report()["pairs"], frames);
    EXPECT_LT(report()["ate_m"]["max"], 1e-6);
    EXPECT_LT(report()["rre_deg"]["max"], 1e-4);
  }
}

int lost_pixels(const std::string& picture) {
  int count = 0;
  const ColorImage image = read_color(picture);
  for (const cv::Vec3f& p : image(cv::Rect(0, 0, image.cols, image.rows * 2 / 3))) {
    count +=
        std::abs(p[0]) < 0.05F && std::abs(p[1] - 90.0F / 255.0F) < 0.05F && std::abs(p[2] - 220.0F / 255.0F) < 0.05F;
  }
  return count;
}

TEST_F(Eval, OnlyImagesThatWereToBePosedAreDrawnAsLost) {
  std::string rgb;
  std::string truth;
  std::string status = "time,status,keyframe,inlier_share,milliseconds,map_share,in_map\n";
  for (int k = 0; k < frames; ++k) {
    const std::string stamp = std::to_string(k / 30.0);
    put_image("seq/rgb/" + std::to_string(k) + ".png", k);
    rgb += stamp + " rgb/" + std::to_string(k) + ".png\n";
    truth += tum(stamp, pose_of(k));
    if (k < 16) status += stamp + (k < 8 ? ",ok" : ",lost") + ",0,1,1,1,1\n";
  }
  put("seq/rgb.txt", rgb);
  put("seq/groundtruth.txt", truth);
  put("seq/camera.yaml", camera_yaml);
  const std::string est = estimate(0, 8);
  const auto lost = [&](const std::string& truth_path, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"view",  "trajectory",       est,      "--truth", truth_path,
                                   "--out", scratch_ / "v.png", "--size", "600x450"};
    words.insert(words.end(), more.begin(), more.end());
    const RunResult run = run_odosplat(words);
    EXPECT_EQ(run.status, 0) << run.err;
    return lost_pixels(scratch_ / "v.png");
  };
  EXPECT_EQ(lost(scratch_ / "seq/groundtruth.txt"), 0) << "of which images it is is not known";
  const int all = lost(scratch_ / "seq");
  EXPECT_GT(all, 50);
  EXPECT_EQ(lost(scratch_ / "seq", {"--frames", "0:8"}), 0);
  put("status.csv", status);
  const int run = lost(scratch_ / "seq");
  EXPECT_GT(run, 20);
  EXPECT_LT(run, all);
  EXPECT_EQ(lost(scratch_ / "seq/groundtruth.txt"), run);
}

}  // namespace
}  // namespace odosplat::apps_test
