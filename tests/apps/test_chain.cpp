// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// The steps from posed images and a cloud to an evaluated trajectory, as separate program calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

RunResult must_run(const std::vector<std::string>& words) {
  RunResult result = run_odosplat(words);
  EXPECT_EQ(result.status, 0) << testing::PrintToString(words) << "\n" << result.err;
  return result;
}

int lines_of(const fs::path& file) {
  const std::string text = read_text(file);
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

std::string without_lines(std::string text, const std::string& start) {
  for (std::size_t at = 0; (at = text.find("\n" + start)) != std::string::npos;)
    text.erase(at, text.find('\n', at + 1) - at);
  return text;
}

class Chain : public testing::Test {
 protected:
  static constexpr int frames = 40;

  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", frames);
    must_run({"cloud", sequence_, "--every", "5", "--voxel", "0.03", "--noise", "0.002", "--out", cloud_});
    train(map_, "2");
  }
  void train(const std::string& out, const std::string& threads) {
    must_run({"train", sequence_, "--every", "5", "--cloud", cloud_, "--iterations", "40", "--out", out, "--report",
              out + ".json", "--threads", threads});
  }
  std::string track(const std::string& sequence, const std::string& name, std::vector<std::string> more) {
    const std::string out = scratch_ / name;
    std::vector<std::string> words{"track", sequence, "--map", map_, "--cloud", cloud_, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    must_run(words);
    return out;
  }
  double ate(const std::string& run) {
    must_run(
        {"eval", run + "/trajectory.txt", "--truth", sequence_ + "/groundtruth.txt", "--json", run + "/eval.json"});
    const auto json = nlohmann::json::parse(read_text(run + "/eval.json"));
    EXPECT_EQ(json["pairs"], frames);
    EXPECT_EQ(json["coverage"], 1.0);
    for (const char* key : {"ate_m", "rte_m", "rre_deg"}) {
      for (const char* figure : {"rmse", "mean", "median", "max", "p99"}) EXPECT_TRUE(json[key].contains(figure));
    }
    return json["ate_m"]["rmse"];
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string cloud_ = scratch_ / "cloud.ply";
  std::string map_ = scratch_ / "map.ply";
};

TEST_F(Chain, TracksWithEveryDepth) {
  const std::string gaussian = track(sequence_, "gaussian", {});
  EXPECT_LT(ate(gaussian), 0.01);
  const std::string interpolation = track(sequence_, "interpolation", {"--method", "interpolation"});
  EXPECT_LT(ate(interpolation), 0.03);
  const std::string surfel = track(sequence_, "surfel", {"--method", "surfel"});
  EXPECT_LT(ate(surfel), 0.03);
  EXPECT_EQ(nlohmann::json::parse(read_text(surfel + "/report.json"))["method"], "surfel");
  const std::string rgbd = track(sequence_, "rgbd", {"--method", "rgbd"});
  EXPECT_LT(ate(rgbd), 0.03);
  const std::string noisy = track(sequence_, "noisy", {"--method", "rgbd", "--depth-noise", "kinect"});
  EXPECT_LT(ate(noisy), 0.05);
  EXPECT_NE(read_text(noisy + "/trajectory.txt"), read_text(rgbd + "/trajectory.txt"));
  EXPECT_EQ(lines_of(gaussian + "/trajectory.txt"), frames + 1);
  EXPECT_EQ(lines_of(gaussian + "/trajectory_live.txt"), frames + 1);
  EXPECT_EQ(lines_of(gaussian + "/status.csv"), frames + 1);
  const auto report = nlohmann::json::parse(read_text(gaussian + "/report.json"));
  for (const char* key : {"method", "frames", "posed", "lost", "relocalisations", "keyframes", "ms_per_frame",
                          "cpu_ms_per_frame", "stages_ms", "peak_memory_mb", "device", "seed", "version"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["frames"], frames);
  EXPECT_EQ(report["posed"].get<int>() + report["lost"].get<int>(), frames);
}

TEST_F(Chain, AnchorsAsTheMethodDoesUnlessTold) {
  const auto trajectory = [&](const std::string& method, const std::vector<std::string>& anchor) {
    std::vector<std::string> more{"--method", method};
    more.insert(more.end(), anchor.begin(), anchor.end());
    return read_text(
        track(sequence_, method + std::to_string(anchor.size()) + (anchor.empty() ? "" : anchor[1]), more) +
        "/trajectory.txt");
  };
  for (const char* method : {"gaussian", "interpolation"}) {
    const bool by_default = std::string(method) == "gaussian";
    const std::string plain = trajectory(method, {});
    EXPECT_EQ(plain == trajectory(method, {"--anchor", "on"}), by_default) << method;
    EXPECT_EQ(plain == trajectory(method, {"--anchor", "off"}), !by_default) << method;
  }
}

TEST_F(Chain, UsesNoTruthButTheFirstPose) {
  const std::string blind = scratch_ / "blind";
  fs::copy(sequence_, blind, fs::copy_options::recursive);
  fs::remove_all(blind + "/depth");
  std::istringstream truth(read_text(sequence_ + "/groundtruth.txt"));
  std::string first;
  for (std::string line; first.empty() && std::getline(truth, line);) {
    if (line[0] != '#') first = line;
  }
  write_text(blind + "/groundtruth.txt", first + "\n");
  const std::string a = track(sequence_, "a", {});
  const std::string b = track(blind, "b", {});
  EXPECT_EQ(read_text(a + "/trajectory.txt"), read_text(b + "/trajectory.txt"));
  EXPECT_EQ(read_text(a + "/trajectory_live.txt"), read_text(b + "/trajectory_live.txt"));
}

TEST_F(Chain, StartsAnywhere) {
  const std::string run = track(sequence_, "auto", {"--start", "auto"});
  EXPECT_LT(ate(run), 0.01);
  EXPECT_THAT(read_text(run + "/status.csv"), HasSubstr(",relocalised,1,"));
  EXPECT_EQ(nlohmann::json::parse(read_text(run + "/report.json"))["relocalisations"], 1);
  // --places is needed for a map that does not store its training poses.
  const std::string foreign = scratch_ / "foreign.ply";
  write_text(foreign, without_lines(read_text(map_), "comment training_view"));
  EXPECT_THAT(read_text(foreign), testing::Not(HasSubstr("training_view")));
  must_run({"track", sequence_, "--map", foreign, "--start", "auto", "--places", sequence_ + "/groundtruth.txt",
            "--out", scratch_ / "foreign"});
  EXPECT_LT(ate(scratch_ / "foreign"), 0.01);
}

TEST_F(Chain, ConvertKeepsWhatAMapSaysOfItself) {
  const std::string same = scratch_ / "same.ply";
  must_run({"convert", map_, same});
  EXPECT_EQ(read_text(same), read_text(map_));
  EXPECT_THAT(must_run({"convert", map_, scratch_ / "small.splat"}).err, HasSubstr("sorted by distance"));
  const std::string plain = scratch_ / "plain.ply";
  must_run({"convert", scratch_ / "small.splat", plain});
  EXPECT_THAT(read_text(plain), testing::Not(HasSubstr("blend_order")));
}

TEST_F(Chain, LooksUpSingleImages) {
  const std::string json = scratch_ / "found.json";
  const RunResult result =
      must_run({"relocalise", sequence_, "--map", map_, "--views", "6", "--skip-every", "5", "--json", json});
  EXPECT_THAT(result.out, HasSubstr("6 views: 6 found"));
  const auto report = nlohmann::json::parse(read_text(json));
  EXPECT_EQ(report["within_2cm_1deg"], 6);
  EXPECT_EQ(report["beyond_10cm"], 0);
  EXPECT_EQ(report["rows"].size(), 6U);
  for (const auto& row : report["rows"]) EXPECT_NE(row["frame"].get<int>() % 5, 0);
}

TEST_F(Chain, LooksUpImagesWhoseTruePosesNobodyKnows) {
  const Trajectory truth = read_trajectory(sequence_ + "/groundtruth.txt");
  fs::remove(sequence_ + "/groundtruth.txt");
  const std::string json = scratch_ / "found.json";
  const std::string poses = scratch_ / "found.txt";
  const RunResult result = must_run({"relocalise", sequence_, "--map", map_, "--frames", "11:14", "--skip-every",
                                     "none", "--json", json, "--out", poses});
  EXPECT_THAT(result.out, HasSubstr("3 views: 3 found, - of them within"));
  const auto report = nlohmann::json::parse(read_text(json));
  EXPECT_TRUE(report["within_2cm_1deg"].is_null());
  EXPECT_TRUE(report["beyond_10cm"].is_null());
  const Trajectory found = read_trajectory(poses);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found[k].time, truth[11 + k].time, 1e-6);
    EXPECT_LT((found[k].T_world_camera.translation() - truth[11 + k].T_world_camera.translation()).norm(), 0.02);
  }
  for (const auto& row : report["rows"]) {
    const auto k = row["frame"].get<std::size_t>();
    EXPECT_TRUE(row["error_m"].is_null());
    EXPECT_NEAR(row["T_world_camera"][0], truth[k].T_world_camera.translation().x(), 0.02);
    EXPECT_NEAR(row["time"], truth[k].time, 1e-6);
    EXPECT_GT(row["score"], 0.0);
  }
}

TEST_F(Chain, LooksUpNothingWithAWrongCamera) {
  const std::string camera = scratch_ / "camera.yaml";
  for (const double factor : {1.0, 1.1}) {
    CameraFile told = read_camera_file(sequence_ + "/camera.yaml");
    told.camera.fx *= factor;
    told.camera.fy *= factor;
    write_camera_file(camera, told);
    const std::string json = scratch_ / "found.json";
    const RunResult run = run_odosplat({"relocalise", sequence_, "--map", map_, "--camera", camera, "--views", "12",
                                        "--skip-every", "none", "--json", json});
    const auto report = nlohmann::json::parse(read_text(json));
    if (factor == 1.0) {
      EXPECT_EQ(report["found"], 12) << run.out;
      EXPECT_EQ(report["camera"], "");
      continue;
    }
    EXPECT_EQ(report["found"], 0) << run.out;
    EXPECT_THAT(report["rows"].dump(), HasSubstr("the images look as if the focal length were"));
    EXPECT_THAT(
        report["camera"],
        testing::MatchesRegex("the images look as if the focal length were .* shorter than in the camera file"));
    EXPECT_THAT(run.err, HasSubstr("shorter than in the camera file; poses"));
  }
}

TEST_F(Chain, LooksUpNothingThatTheMapDoesNotShow) {
  cv::Mat3b noise(120, 160);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  write_rgb8(sequence_ + "/rgb/0012.png", noise);
  const std::string damaged = sequence_ + "/rgb/0011.png";
  write_text(damaged, read_text(damaged).substr(0, 1000));
  const std::string json = scratch_ / "found.json";
  const RunResult none = run_odosplat(
      {"relocalise", sequence_, "--map", map_, "--frames", "11:13", "--skip-every", "none", "--json", json});
  EXPECT_EQ(none.status, 3) << none.err;
  EXPECT_THAT(none.err, HasSubstr("1 of 2 frames cannot be read, such as " + damaged));
  EXPECT_THAT(none.err, HasSubstr("none of 1 images found"));
  EXPECT_EQ(nlohmann::json::parse(read_text(json))["found"], 0);
  const RunResult depth =
      must_run({"eval-depth", sequence_, "--map", map_, "--frames", "10:14", "--every", "1", "--skip-every", "none"});
  EXPECT_THAT(depth.err, HasSubstr("1 of 4 frames cannot be read, such as " + damaged));
}

TEST_F(Chain, LeavesOutTheFramesThatTheMapNames) {
  const std::string json = scratch_ / "depth.json";
  const RunResult named =
      must_run({"eval-depth", sequence_, "--map", map_, "--frames", "0:10", "--every", "1", "--json", json});
  EXPECT_THAT(named.err, HasSubstr("left out are the frames that the map was made from: 0, 5, ..."));
  EXPECT_EQ(nlohmann::json::parse(read_text(json))["frames"], 8);  // all but 0 and 5
  fs::rename(sequence_, scratch_ / "another");
  const RunResult other =
      must_run({"eval-depth", scratch_ / "another", "--map", map_, "--frames", "0:10", "--every", "1", "--json", json});
  EXPECT_THAT(other.err, HasSubstr("no frame is left out: the map was made from"));
  EXPECT_EQ(nlohmann::json::parse(read_text(json))["frames"], 10);
}

TEST_F(Chain, ThreadsChangeNoBit) {
  train(scratch_ / "map1.ply", "1");
  EXPECT_EQ(read_text(map_), read_text(scratch_ / "map1.ply"));
  const std::string a = track(sequence_, "a", {"--threads", "1"});
  const std::string b = track(sequence_, "b", {"--threads", "3"});
  EXPECT_EQ(read_text(a + "/trajectory.txt"), read_text(b + "/trajectory.txt"));
}

TEST_F(Chain, RenderSaysWhatSixteenBitsCannotHold) {
  const std::string camera = scratch_ / "fine.yaml";
  write_text(camera, "width: 160\nheight: 120\nfx: 130\nfy: 130\ncx: 79.5\ncy: 59.5\ndepth_scale: 200000\n");
  const RunResult run = must_run({"render", "--map", map_, "--poses", sequence_ + "/groundtruth.txt", "--camera",
                                  camera, "--out", scratch_ / "fine", "--what", "depth"});
  EXPECT_THAT(run.err, HasSubstr("pixels lie beyond the 0.328 m that 16 bits at depth_scale 200000 hold: depth 0"));
}

TEST_F(Chain, RendersAndDraws) {
  const std::string out = scratch_ / "render";
  must_run({"render", "--map", map_, "--poses", sequence_ + "/groundtruth.txt", "--camera", sequence_ + "/camera.yaml",
            "--out", out, "--what", "color,depth,alpha,sigma"});
  for (const char* kind : {"color", "depth", "alpha", "sigma"}) {
    EXPECT_TRUE(fs::exists(out + "/" + kind + "/000000.png")) << kind;
    EXPECT_TRUE(fs::exists(out + "/" + kind + "/000039.png")) << kind;
  }
  // Compares the map's rendered depth with the sequence's, in the units of camera.yaml.
  const cv::Mat1w rendered = read_depth_raw(out + "/depth/000003.png");
  const cv::Mat1w truth = read_depth_raw(sequence_ + "/depth/0003.png");
  std::vector<int> differences;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (rendered(y, x) > 0 && truth(y, x) > 0) differences.push_back(std::abs(rendered(y, x) - truth(y, x)));
    }
  }
  ASSERT_GT(differences.size(), truth.total() * 9 / 10);
  std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                   differences.end());
  EXPECT_LT(differences[differences.size() / 2], 5 * 10) << "median error of 10 mm at 5000 units a metre";

  const std::string run = track(sequence_, "run", {});
  must_run({"view", "map", "--map", map_, "--poses", sequence_ + "/groundtruth.txt", "--out", scratch_ / "m.png",
            "--size", "400x300"});
  must_run({"view", "trajectory", run + "/trajectory.txt", "--truth", sequence_ + "/groundtruth.txt", "--map", map_,
            "--out", scratch_ / "t.png", "--size", "640x300"});
  must_run({"view", "depth", sequence_, "--map", map_, "--frame", "7", "--out", scratch_ / "d.png"});
  must_run({"view", "compare", sequence_, "--map", map_, "--cloud", cloud_, "--frame", "3,17", "--out",
            scratch_ / "c.png", "--size", "1200x500"});
  EXPECT_EQ(read_image_size(scratch_ / "m.png"), cv::Size(400, 300));
  EXPECT_EQ(read_image_size(scratch_ / "c.png"), cv::Size(1200, 500));
  const RunResult depth = must_run({"eval-depth", sequence_, "--map", map_, "--json", scratch_ / "depth.json"});
  EXPECT_THAT(depth.out, HasSubstr("selected"));
  const auto json = nlohmann::json::parse(read_text(scratch_ / "depth.json"));
  EXPECT_LT(json["all"]["median_abs_m"], 0.01);
  EXPECT_GT(json["psnr_db"], 15.0);
}

TEST_F(Chain, CheckNamesTheFault) {
  EXPECT_THAT(must_run({"check", sequence_, "--gap", "10"}).out, testing::Not(HasSubstr("the data want")));
  const std::string camera = "width: 160\nheight: 120\nfx: 130\nfy: 130\ncx: 79.5\ncy: 59.5\n";
  write_text(sequence_ + "/camera.yaml", camera);
  const RunResult assumed = must_run({"check", sequence_, "--gap", "10"});
  const std::string said = "names no depth_scale: 5000 units per metre are assumed";
  ASSERT_THAT(assumed.err, HasSubstr(said));
  EXPECT_EQ(assumed.err.find(said), assumed.err.rfind(said));
  write_text(sequence_ + "/camera.yaml", camera + "depth_scale: 1000\n");
  EXPECT_THAT(run_odosplat({"check", sequence_, "--gap", "10"}).out,
              HasSubstr("depth scale: the data want 5000, the file says 1000 (depths are read 5 times too large)"));
  write_text(sequence_ + "/camera.yaml",
             "width: 160\nheight: 120\nfx: 130\nfy: -130\ncx: 79.5\ncy: 59.5\ndepth_scale: 5000\n");
  const RunResult flipped = run_odosplat({"check", sequence_, "--gap", "10"});
  EXPECT_THAT(flipped.out, HasSubstr("fy"));
  EXPECT_EQ(flipped.status, 3);
  EXPECT_THAT(flipped.err, HasSubstr("do not agree"));
  EXPECT_EQ(run_odosplat({"check", sequence_, "--gap", "10", "--keep-going"}).status, 0);
  write_text(sequence_ + "/camera.yaml",
             "width: 160\nheight: 120\nfx: 143\nfy: 143\ncx: 79.5\ncy: 59.5\ndepth_scale: 5000\n");
  const RunResult longer = run_odosplat({"check", sequence_, "--gap", "10"});
  EXPECT_THAT(longer.out, HasSubstr("focal length: the images want 1"));
  EXPECT_EQ(longer.status, 3);
}

TEST_F(Chain, ChecksWithACloudInPlaceOfDepth) {
  const std::string report = scratch_ / "check.json";
  must_run({"check", sequence_, "--cloud", cloud_, "--gap", "10", "--json", report});
  auto json = nlohmann::json::parse(read_text(report));
  EXPECT_NE(json["depth_registered"], false) << json.dump(2);
  EXPECT_EQ(json["poses_inverted"], false);
  EXPECT_EQ(json["declared"]["fy"], 130.0);
  EXPECT_TRUE(json.contains("color_focal_px") && json.contains("color_focal_sigma_px"));
  EXPECT_NEAR(json["color_focal_px"].get<double>(), 130.0, 2.0);

  fs::remove(sequence_ + "/depth.txt");
  const RunResult without = run_odosplat({"check", sequence_});
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, HasSubstr("--cloud"));
  // Inverted poses, as written by many tools.
  Trajectory truth = read_trajectory(sequence_ + "/groundtruth.txt");
  for (StampedPose& pose : truth) pose.T_world_camera = pose.T_world_camera.inverse();
  write_trajectory(sequence_ + "/groundtruth.txt", truth);
  const RunResult inverted = run_odosplat({"check", sequence_, "--cloud", cloud_, "--json", report});
  EXPECT_EQ(inverted.status, 3) << inverted.err;
  EXPECT_THAT(inverted.out, HasSubstr("poses: the images want inverted, the files say as stored"));
  json = nlohmann::json::parse(read_text(report));
  EXPECT_EQ(json["poses_inverted"], true);
  EXPECT_TRUE(json["depth_registered"].is_null());
  const auto finding = std::find_if(json["findings"].begin(), json["findings"].end(),
                                    [](const auto& f) { return f["part"] == "poses"; });
  ASSERT_NE(finding, json["findings"].end());
  EXPECT_EQ((*finding)["as_declared"], false);
  EXPECT_THAT((*finding)["reason"].get<std::string>(), HasSubstr("inverted"));
}

}  // namespace
}  // namespace odosplat::apps_test
