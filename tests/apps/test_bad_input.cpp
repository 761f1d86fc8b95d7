// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Bad input to the program: one line that names the file and the fault, exit status 2, no incomplete output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "odosplat/io/image/image_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* ply_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n";

void truncate(const fs::path& file, double share) {
  fs::resize_file(file, static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(file))));
}

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    write_tiny_sequence(sequence_, 24);
    write_text(cloud_, std::string(ply_header) + "1 1 1\n2 1 1\n1 2 1\n");
  }

  // Runs the program and checks that it refuses the input as required. `out`: must not exist afterwards.
  void expect_refused(const std::vector<std::string>& words, const std::string& file, const std::string& fault,
                      const fs::path& out = {}) {
    const RunResult result = run_odosplat(words);
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_EQ(result.status, 2) << result.err;
    // Log lines may come before the error, which must be the last line and the only one that begins with "odosplat: ".
    const std::size_t start = result.err.find("odosplat: ");
    ASSERT_NE(start, std::string::npos) << result.err;
    const std::string line = result.err.substr(start);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << line;
    EXPECT_THAT(line, HasSubstr(file));
    EXPECT_THAT(line, testing::ContainsRegex(fault));
    EXPECT_FALSE(!out.empty() && fs::exists(out)) << "half-written " << out;
    for (const auto& entry : fs::recursive_directory_iterator(scratch_.path())) {
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    }
  }
  void expect_cloud_refused(const std::string& file, const std::string& fault) {
    const std::string out = scratch_ / "never.ply";
    expect_refused({"cloud", sequence_, "--every", "1", "--out", out}, file, fault, out);
  }
  // Checks that an unusable frame is left out, with a warning that names the file.
  void expect_cloud_without(const std::string& file, const std::string& fault) {
    const std::string out = scratch_ / "some.ply";
    const RunResult result = run_odosplat({"cloud", sequence_, "--every", "1", "--out", out});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, testing::ContainsRegex("warning: .*" + file + fault));
    EXPECT_TRUE(fs::exists(out));
  }
  void expect_camera_refused(const std::string& yaml, const std::string& fault) {
    write_text(sequence_ + "/camera.yaml", yaml);
    expect_cloud_refused("camera.yaml", fault);
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string cloud_ = scratch_ / "cloud.ply";
};

TEST_F(BadInput, MissingFiles) {
  expect_refused({"check", scratch_ / "nowhere"}, "nowhere", "");
  expect_refused({"eval", scratch_ / "no.txt", "--truth", sequence_ + "/groundtruth.txt"}, "no.txt", "is missing");
  expect_refused({"train", sequence_, "--cloud", scratch_ / "no.ply", "--out", scratch_ / "m.ply"}, "no.ply",
                 "is missing", scratch_ / "m.ply");
  expect_refused({"track", sequence_, "--map", scratch_ / "no.ply", "--out", scratch_ / "run"}, "no.ply", "is missing");
  fs::remove(sequence_ + "/rgb/0005.png");
  expect_cloud_without("0005.png", ": is missing");
  for (const auto& entry : fs::directory_iterator(sequence_ + "/rgb")) fs::remove(entry.path());
  expect_cloud_refused("0000.png", "is missing");
}

TEST_F(BadInput, TruncatedImages) {
  const std::string file = sequence_ + "/rgb/0003.png";
  const std::string whole = read_text(file);
  for (const double share : {0.0, 0.01, 0.5, 0.99}) {
    write_text(file, whole);
    truncate(file, share);
    expect_cloud_without("0003.png", "");
  }
  write_text(file, whole);
  truncate(sequence_ + "/depth/0004.png", 0.7);
  expect_cloud_without("depth/0004.png", "");
  for (const auto& entry : fs::directory_iterator(sequence_ + "/depth")) truncate(entry.path(), 0.5);
  expect_cloud_refused("depth/0000.png", "");
}

TEST_F(BadInput, TruncatedPly) {
  const std::string out = scratch_ / "m.ply";
  const std::vector<std::string> words{"train", sequence_, "--cloud", cloud_, "--out", out};
  write_text(cloud_, std::string(ply_header) + "1 1 1\n2 1 1\n");
  expect_refused(words, "cloud.ply", "promises 3.*2", out);
  write_text(cloud_,
             "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n1 1 1\n");
  expect_refused(words, "cloud.ply", "99999999999", out);
  write_text(cloud_, "ply\nformat ascii 1.0\n");
  expect_refused(words, "cloud.ply", "header", out);
  write_text(cloud_, "not a ply");
  expect_refused(words, "cloud.ply", "PLY", out);
}

TEST_F(BadInput, MapWithoutGaussians) {
  // A cloud is not a map; neither is a file with 0 Gaussians.
  expect_refused({"track", sequence_, "--map", cloud_, "--out", scratch_ / "run"}, "cloud.ply", "");
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0",
                           "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"}) {
    header += std::string("property float ") + name + "\n";
  }
  write_text(scratch_ / "empty.ply", header + "end_header\n");
  expect_refused({"track", sequence_, "--map", scratch_ / "empty.ply", "--out", scratch_ / "run"}, "empty.ply",
                 "no Gaussians");
}

TEST_F(BadInput, Poses) {
  const std::string file = sequence_ + "/groundtruth.txt";
  const std::string whole = read_text(file);
  write_text(file, whole + "99.0 nan 0 0 0 0 0 1\n");
  expect_cloud_without("groundtruth.txt", ": 1 of 25 poses are not finite");
  write_text(file, whole + "99.0 1 0 0 0 0 0 0\n");
  expect_cloud_refused("groundtruth.txt", "quaternion");
  write_text(file, whole + "99.0 1 0 0\n");
  expect_cloud_refused("groundtruth.txt", "line 26");
  write_text(file, "# nothing\n");
  expect_cloud_refused("groundtruth.txt", "no pose");
}

TEST_F(BadInput, CameraFile) {
  const std::string good = "width: 160\nheight: 120\nfx: 130\nfy: 130\ncx: 79.5\n";
  expect_camera_refused(good, "cy: is missing");
  expect_camera_refused("width: 160\nheight: 120\nfx: 0\nfy: 130\ncx: 79.5\ncy: 59.5\n", "fx: must be positive");
  expect_camera_refused(good + "cy: about 60\n", "cy: is not a number");
  expect_camera_refused(good + "cy: 59.5\ndistortion: [1, 2]\n", "distortion");
  expect_camera_refused("{", "");
  expect_camera_refused("width: 320\nheight: 240\nfx: 130\nfy: 130\ncx: 79.5\ncy: 59.5\n", "");
}

TEST_F(BadInput, DepthAndColourOfDifferentSizes) {
  const cv::Mat1w small(60, 80, std::uint16_t{5000});
  write_png16(sequence_ + "/depth/0000.png", small);
  expect_cloud_without("0000.png", ".*80x60");
  for (const auto& entry : fs::directory_iterator(sequence_ + "/depth")) write_png16(entry.path().string(), small);
  expect_cloud_refused("0000.png", "80x60.*160x120|160x120.*80x60");
}

TEST_F(BadInput, ImagesAndTextsThatWouldFillTheMemory) {
  const std::string camera = read_text(sequence_ + "/camera.yaml");
  write_text(sequence_ + "/camera.yaml", camera + "vignette: /dev/zero\n");
  expect_cloud_refused("/dev/zero", "is not a regular file");
  write_text(sequence_ + "/camera.yaml", camera);
  const std::string fifo = scratch_ / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& file : {fifo, std::string("/dev/zero")}) {
    expect_refused({"check", sequence_, "--camera", file}, file, "is not a regular file");
    expect_refused({"eval", file, "--truth", sequence_ + "/groundtruth.txt"}, file, "is not a regular file");
    expect_refused({"track", sequence_, "--map", file, "--out", scratch_ / "run"}, file, "is not a regular file");
    expect_refused({"convert", file, scratch_ / "m.ply"}, file, "is not a regular file", scratch_ / "m.ply");
    expect_refused({"synthesize", "--scene", file, "--cloud", scratch_ / "m.ply"}, file, "is not a regular file");
  }
  const std::string out = scratch_ / "never.ply";
  expect_refused({"cloud", sequence_, "--max-image-pixels", "19199", "--out", out}, "160x120", "--max-image-pixels",
                 out);
  expect_refused({"check", sequence_, "--max-image-pixels", "0"}, "--max-image-pixels", "");
}

TEST_F(BadInput, CoordinatesOfASurvey) {
  std::string poses;
  for (int k = 0; k < 24; ++k) {
    poses += std::to_string(k) + ".0 " + std::to_string(500000 + k) + " 5000000 100 0 0 0 1\n";
  }
  const std::string far = scratch_ / "far.txt";
  write_text(far, poses);
  const std::string camera = sequence_ + "/camera.yaml";
  const std::string fault = "is too far from the origin.*500000 5000000 0.*--origin";
  const std::vector<std::string> surfels{"--method", "surfel", "--cloud", cloud_};
  auto with_surfels = [&](std::vector<std::string> words) {
    words.insert(words.end(), surfels.begin(), surfels.end());
    return words;
  };
  expect_refused(with_surfels({"render", "--poses", far, "--camera", camera, "--out", scratch_ / "r"}), "far.txt",
                 fault);
  expect_refused({"view", "map", "--cloud", cloud_, "--poses", far, "--out", scratch_ / "m.png"}, "far.txt", fault,
                 scratch_ / "m.png");
  expect_refused(with_surfels({"relocalise", sequence_, "--places", far}), "far.txt", fault);
  // The sequence's own poses, with the time stamps of rgb.txt.
  std::string truth;
  std::istringstream lines(read_text(sequence_ + "/rgb.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    truth += line.substr(0, line.find(' ')) + " 500000 5000000 100 0 0 0 1\n";
  }
  write_text(sequence_ + "/groundtruth.txt", truth);
  expect_cloud_refused("seq", fault);
  expect_refused({"train", sequence_, "--cloud", cloud_, "--out", scratch_ / "m.ply"}, "seq", fault,
                 scratch_ / "m.ply");
  expect_refused(with_surfels({"track", sequence_, "--out", scratch_ / "run"}), "seq", fault);
  expect_refused(with_surfels({"eval-depth", sequence_}), "seq", fault);
  expect_refused({"align", "--poses", sequence_, "--cloud", cloud_, "--points", cloud_, "--out", scratch_ / "a"}, "seq",
                 fault);
}

TEST_F(BadInput, UnknownDevice) {
  expect_refused({"train", sequence_, "--cloud", cloud_, "--out", scratch_ / "m.ply", "--device", "no such thing"},
                 "no such thing", "no such OpenCL device", scratch_ / "m.ply");
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  // A path below a regular file cannot be created by any user, not even root.
  const std::string below = sequence_ + "/rgb.txt/x";
  expect_refused({"cloud", sequence_, "--out", below + ".ply"}, "rgb.txt", "cannot be written");
  expect_refused({"track", sequence_, "--method", "interpolation", "--cloud", cloud_, "--out", below}, "rgb.txt",
                 "cannot be written");
  expect_refused({"demo", "--out", below}, "rgb.txt", "cannot be written");
  expect_refused({"view", "map", "--cloud", cloud_, "--out", below + ".png"}, "rgb.txt", "cannot be written");
}

TEST_F(BadInput, Flags) {
  const std::vector<std::string> track{"track", sequence_, "--cloud", cloud_, "--out", scratch_ / "run"};
  auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = track;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_refused(with({}), "--map", "needed for method gaussian");
  expect_refused(with({"--method", "magic"}), "--method",
                 "must be gaussian, paper, interpolation, surfel or rgbd, is magic");
  expect_refused({"track", sequence_, "--method", "surfel", "--out", scratch_ / "run"}, "--cloud",
                 "needed for method surfel");
  expect_refused(with({"--method", "rgbd", "--depth-noise", "fog"}), "--depth-noise", "fog");
  expect_refused(with({"--method", "interpolation", "--start", "1 2 3"}), "--start", "");
  expect_refused(with({"--method", "interpolation", "--start", "0 0 0 0 0 0 0"}), "--start", "quaternion");
  expect_refused(with({"--method", "interpolation", "--depth-noise", "kinect"}), "--depth-noise",
                 "is not used by method interpolation");
  expect_refused(with({"--method", "surfel", "--depth", "median"}), "--depth", "is not used by method surfel");
  expect_refused({"view", "map", "--out", scratch_ / "x.png"}, "--map", "nothing to draw", scratch_ / "x.png");
  expect_refused({"train", sequence_, "--cloud", cloud_, "--out", scratch_ / "m.txt"}, "m.txt", "must end in .ply",
                 scratch_ / "m.txt");
  expect_refused({"cloud", sequence_, "--out", scratch_ / "c.xyz"}, "c.xyz", "must end in .ply", scratch_ / "c.xyz");
  expect_refused({"view", "map", "--cloud", cloud_, "--out", scratch_ / "x.png", "--size", "big"}, "--size", "big",
                 scratch_ / "x.png");
}

}  // namespace
}  // namespace odosplat::apps_test
