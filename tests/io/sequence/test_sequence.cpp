// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Small synthetic sequences in every layout: what is read, and the messages for bad input.
#include "odosplat/io/sequence/sequence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/io/image/image_bytes.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::TempFolder;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int width = 16;
constexpr int height = 12;
const std::string camera_yaml = "width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\ndepth_scale: 500\n";

// Grey level and raw depth identify the frame.
cv::Mat3b color_of(int k, int w = width, int h = height) {
  return cv::Mat3b(h, w, cv::Vec3b::all(static_cast<uchar>(10 * k + 5)));
}
cv::Mat1w depth_of(int k, int w = width, int h = height) {
  return cv::Mat1w(h, w, static_cast<std::uint16_t>(1000 + 100 * k));
}
int frame_in(const ColorImage& image) {
  return static_cast<int>(std::lround((image(5, 5)[0] * 255.0F - 5.0F) / 10.0F));
}
std::string pose_line(const std::string& stamp, int k) { return stamp + " " + std::to_string(k) + " 2 3 0 0 0 1\n"; }
std::string matrix(int k, const char* end) {
  return "1 0 0 " + std::to_string(k) + end + "0 1 0 2" + end + "0 0 1 3" + end + "0 0 0 1\n";
}

void put_tum(const TempFolder& temp, int frames = 3) {
  std::string colors = "# colour\n";
  std::string depths = "# depth\n";
  std::string truth = "# truth\n";
  for (int k = 0; k < frames; ++k) {
    const std::string stamp = "10." + std::to_string(k) + "00";
    temp.put_image("rgb/" + stamp + ".png", color_of(k));
    temp.put_image("depth/" + stamp + ".png", depth_of(k));
    colors += stamp + " rgb/" + stamp + ".png\n";
    depths += stamp + " depth/" + stamp + ".png\n";
    truth += pose_line(stamp, k);
  }
  temp.put("rgb.txt", colors);
  temp.put("depth.txt", depths);
  temp.put("groundtruth.txt", truth);
  temp.put("camera.yaml", camera_yaml);
}

TEST(SequenceTum, ReadsImagesDepthAndPoses) {
  const TempFolder temp;
  put_tum(temp);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "tum");
  EXPECT_EQ(s.name(), fs::path(temp.path()).filename().string());
  EXPECT_EQ(s.camera(), (Camera{16, 12, 20, 21, 7.5, 5.5}));
  EXPECT_EQ(s.fy_sign(), 1);
  EXPECT_EQ(s.depth_scale(), 500.0);
  EXPECT_NEAR(s.fps(), 10.0, 1e-9);
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s.truth().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i);
    EXPECT_EQ(s.time_text(i), "10." + std::to_string(k) + "00");
    EXPECT_EQ(frame_in(s.color(i)), k);
    EXPECT_NEAR(s.gray(i)(3, 3), (10.0F * static_cast<float>(k) + 5.0F) / 255.0F, 1e-6F);
    ASSERT_TRUE(s.has_depth(i));
    EXPECT_NEAR(s.depth(i)(0, 0), 2.0F + 0.2F * static_cast<float>(k), 1e-6F);
    EXPECT_EQ(s.T_world_camera(i)->translation(), Eigen::Vector3d(k, 2, 3));
  }
  EXPECT_THROW(s.color(3), std::out_of_range);
}

TEST(SequenceTum, DepthValuesOfNoMeaningAreNone) {
  const TempFolder temp;
  put_tum(temp, 1);
  cv::Mat1w raw = depth_of(0);
  raw(0, 0) = 0;
  raw(0, 1) = 65535;
  raw(0, 2) = 65534;
  temp.put_image("depth/10.000.png", raw);
  const DepthImage depth = Sequence::open(temp.path()).depth(0);
  EXPECT_EQ(depth(0, 0), 0.0F);
  EXPECT_EQ(depth(0, 1), 0.0F);
  EXPECT_NEAR(depth(0, 2), 131.068F, 1e-3F);
}

TEST(SequenceTum, WorksWithoutDepthFolder) {
  const TempFolder temp;
  put_tum(temp);
  fs::remove_all(temp / "depth");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.has_depth(0));
  EXPECT_EQ(frame_in(s.color(2)), 2);
  EXPECT_THAT(error_of([&] { s.depth(1); }), HasSubstr("frame 1: has no depth image"));
  fs::remove(temp / "depth.txt");
  EXPECT_FALSE(Sequence::open(temp.path()).has_depth(0));
}

TEST(SequenceTum, WorksWithOnePoseOrNone) {
  const TempFolder temp;
  put_tum(temp);
  temp.put("groundtruth.txt", pose_line("10.000", 0));
  const Sequence one = Sequence::open(temp.path());
  EXPECT_EQ(one.truth().size(), 1U);
  EXPECT_TRUE(one.T_world_camera(0));
  EXPECT_FALSE(one.T_world_camera(1));
  fs::remove(temp / "groundtruth.txt");
  const Sequence none = Sequence::open(temp.path());
  EXPECT_TRUE(none.truth().empty());
  EXPECT_FALSE(none.T_world_camera(0));
}

TEST(SequenceTum, AssociatesDepthWithinTwentyMilliseconds) {
  const TempFolder temp;
  put_tum(temp);
  temp.put("depth.txt", "10.019 depth/10.000.png\n10.121 depth/10.100.png\n10.195 depth/10.200.png\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_TRUE(s.has_depth(0));
  EXPECT_FALSE(s.has_depth(1));
  EXPECT_TRUE(s.has_depth(2));
}

TEST(SequenceTum, StampsInAnotherUnitAreNamed) {
  const TempFolder temp;
  put_tum(temp);
  const auto warnings = [&] {
    testing::internal::CaptureStderr();
    Sequence::open(temp.path());
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(warnings(), "");
  temp.put("rgb.txt", "10000000000 rgb/10.000.png\n10100000000 rgb/10.100.png\n10200000000 rgb/10.200.png\n");
  EXPECT_THAT(warnings(), HasSubstr("groundtruth.txt: none of its poses matches an image in time; the stamps of the "
                                    "images look like ns"));
  EXPECT_THAT(warnings(), HasSubstr("s apart (median): their stamps look like ns where seconds are expected"));
}

TEST(SequenceTum, DepthHasThePoseOfItsOwnStamp) {
  const TempFolder temp;
  put_tum(temp);
  temp.put("depth.txt", "10.010 depth/10.000.png\n10.100 depth/10.100.png\n");
  temp.put("groundtruth.txt", pose_line("10.000", 0) + pose_line("10.05", 5) + pose_line("10.1", 9));
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.T_world_camera(0)->translation().x(), 0.0);
  EXPECT_NEAR(s.T_world_depth(0)->translation().x(), 1.0, 1e-6);
  EXPECT_EQ(s.T_world_depth(1)->translation().x(), 9.0);
  EXPECT_FALSE(s.T_world_depth(2));  // no depth and no pose
}

TEST(SequenceTum, NegativeFyReflectsPosesUnlessAsStored) {
  const TempFolder temp;
  put_tum(temp, 1);
  std::string yaml = camera_yaml;
  yaml.replace(yaml.find("fy: 21"), 6, "fy: -21");
  temp.put("camera.yaml", yaml);
  const SE3 stored(so3_exp({0.3, -0.2, 0.5}), Eigen::Vector3d(1, 2, 3));
  const Eigen::Quaterniond& q = stored.rotation();
  char line[256];
  std::snprintf(line, sizeof(line), "10.000 1 2 3 %.17g %.17g %.17g %.17g\n", q.x(), q.y(), q.z(), q.w());
  temp.put("groundtruth.txt", line);
  SequenceOptions options;
  options.as_stored = true;
  const Sequence raw = Sequence::open(temp.path(), options);
  EXPECT_EQ(raw.fy_sign(), -1);
  EXPECT_EQ(raw.camera().fy, 21.0);
  EXPECT_LT((raw.T_world_camera(0)->matrix() - stored.matrix()).norm(), 1e-12);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.fy_sign(), -1);
  EXPECT_EQ(s.camera().fy, 21.0);
  const Eigen::Matrix4d F = Eigen::Vector4d(1, -1, 1, 1).asDiagonal();
  EXPECT_LT((s.T_world_camera(0)->matrix() - F * stored.matrix() * F).norm(), 1e-12);
  EXPECT_LT((s.truth()[0].T_world_camera.matrix() - F * stored.matrix() * F).norm(), 1e-12);
  // The stored pose with fy < 0 and the reflected pose with fy > 0 project a point and its mirror image to the same
  // pixel.
  const Eigen::Vector3d p_world(1.5, 2.5, 6.0);
  const Eigen::Vector3d a = stored.inverse() * p_world;
  const Eigen::Vector3d b = s.T_world_camera(0)->inverse() * Eigen::Vector3d(1.5, -2.5, 6.0);
  EXPECT_NEAR(-21.0 * a.y() / a.z(), 21.0 * b.y() / b.z(), 1e-9);
  EXPECT_NEAR(a.x() / a.z(), b.x() / b.z(), 1e-9);
}

TEST(SequenceTum, ANamedCameraFileCounts) {
  const TempFolder temp;
  put_tum(temp, 1);
  SequenceOptions options;
  options.camera_file = temp.put("other.yaml", "width: 16\nheight: 12\nfx: 99\nfy: 98\ncx: 7\ncy: 5\nfps: 12.5\n");
  const Sequence s = Sequence::open(temp.path(), options);
  EXPECT_EQ(s.camera().fx, 99.0);
  EXPECT_EQ(s.fps(), 12.5);
  EXPECT_EQ(s.depth_scale(), 5000.0);  // TUM's default, as the file does not state one
  fs::remove(temp / "camera.yaml");
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()); }),
            temp.path() + ": has no camera.yaml; name a camera file (--camera)");
}

TEST(SequenceTum, DistortionIsRemoved) {
  const TempFolder temp;
  put_tum(temp, 1);
  temp.put("camera.yaml", camera_yaml + "distortion: [0.8, 0, 0, 0]\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.color(0)(0, 0), cv::Vec3f::all(0.0F));  // pincushion distortion: not visible
  EXPECT_EQ(s.depth(0)(0, 0), 0.0F);
  EXPECT_GT(s.depth(0)(6, 8), 0.0F);
  EXPECT_EQ(s.color(0).size(), cv::Size(width, height));
}

TEST(SequenceTum, FaultsNameTheFile) {
  const TempFolder temp;
  put_tum(temp);
  const auto open_error = [&] { return error_of([&] { Sequence::open(temp.path()); }); };
  const auto color = temp / "rgb/10.100.png";
  const auto depth = temp / "depth/10.100.png";

  fs::rename(color, temp / "away");
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }), color + ": is missing");
  const std::string bytes = read_file(temp / "away");
  temp.put("rgb/10.100.png", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }), color + ": is truncated");
  temp.put_image("rgb/10.100.png", color_of(1, 8, 6));
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }),
            color + ": is 8x6, " + temp / "camera.yaml" + " is for 16x12");
  temp.put("rgb/10.100.png", bytes);

  temp.put_image("depth/10.100.png", depth_of(1, 8, 6));
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).depth(1); }),
            depth + ": is 8x6, its colour image " + color + " is 16x12");
  fs::remove(depth);
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).depth(1); }), depth + ": is missing");
  temp.put("depth/10.100.png", "no image");
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).depth(1); }), depth + ": is neither PNG nor JPEG");

  temp.put("groundtruth.txt", pose_line("10.000", 0) + "10.1 nan 2 3 0 0 0 1\n");
  EXPECT_FALSE(Sequence::open(temp.path()).T_world_camera(1));
  temp.put("groundtruth.txt", pose_line("10.000", 0) + "nan 1 2 3 0 0 0 1\n");
  EXPECT_EQ(open_error(), temp / "groundtruth.txt" + ": line 2: `nan` is not finite");
  temp.put("groundtruth.txt", pose_line("10.000", 0));
  temp.put("camera.yaml", "width: 16\nheight: 12\nfy: 21\ncx: 7.5\ncy: 5.5\n");
  EXPECT_EQ(open_error(), temp / "camera.yaml" + ": fx: is missing");
  temp.put("camera.yaml", camera_yaml);
  temp.put("rgb.txt", "# nothing\n");
  EXPECT_EQ(open_error(), temp / "rgb.txt" + ": lists no image");
  temp.put("rgb.txt", "10.0\n");
  EXPECT_EQ(open_error(), temp / "rgb.txt" + ": line 1: names no file");
}

TEST(SequenceTum, ImagesOfAnotherSizeThanTheCameraAreFoundAtOpening) {
  const TempFolder temp;
  put_tum(temp);
  const std::string fault = temp / "rgb/10.000.png" + ": is 32x24, " + temp / "camera.yaml" + " is for 16x12";
  temp.put_image("rgb/10.000.png", color_of(0, 32, 24));
  // A single image of another size may be damaged: the others have the camera's size.
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(0); }), fault);
  for (const auto& entry : fs::directory_iterator(temp / "rgb")) {
    temp.put_image("rgb/" + entry.path().filename().string(), color_of(0, 32, 24));
  }
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()); }), fault);
}

// The pixels do not match the size in the header: decoding them would report "is damaged".
TEST(SequenceTum, ImagesAreNotDecodedBeforeTheirSizeIsKnownToBeRight) {
  const TempFolder temp;
  put_tum(temp);
  const std::string color =
      temp.put("rgb/10.100.png", test::png_claiming(read_file(temp / "rgb/10.100.png"), 9000, 9000));
  const std::string wrong = ": is 9000x9000, " + temp / "camera.yaml" + " is for 16x12";
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }), color + wrong);
  temp.put_image("rgb/10.100.png", color_of(1));
  const std::string depth =
      temp.put("depth/10.100.png", test::png_claiming(read_file(temp / "depth/10.100.png"), 9000, 9000));
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).depth(1); }),
            depth + ": is 9000x9000, its colour image " + color + " is 16x12");
  temp.put("camera.yaml", camera_yaml + "vignette: v.png\n");
  const std::string vignette =
      temp.put("v.png", test::png_claiming(test::encoded(".png", cv::Mat1b(12, 16, uchar{200})), 9000, 9000));
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()); }), vignette + wrong);
  temp.put("camera.yaml", camera_yaml + "vignette: /dev/zero\n");
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()); }),
            temp / "camera.yaml" + ": vignette: /dev/zero: is not a regular file but a device");
}

TEST(SequenceOpen, SaysWhatStandsInThePlaceOfAnImage) {
  const TempFolder temp;
  put_tum(temp);
  const std::string image = temp / "rgb/10.100.png";
  std::filesystem::remove(image);
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }), image + ": is missing");
  ASSERT_EQ(mkfifo(image.c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }),
            image + ": is not a regular file but a pipe (FIFO)");
  std::filesystem::remove(image);
  std::filesystem::create_directory(image);
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).color(1); }), image + ": is not a regular file but a folder");
}

TEST(SequenceOpen, LimitsThePixelsOfAnImage) {
  const TempFolder temp;
  put_tum(temp);
  SequenceOptions options;
  options.max_image_pixels = 16 * 12 - 1;
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path(), options); }),
            temp / "camera.yaml" + ": is 16x12, over the limit of 191 pixels (--max-image-pixels)");
  options.max_image_pixels = 16 * 12;
  EXPECT_EQ(Sequence::open(temp.path(), options).color(1).size(), cv::Size(16, 12));
  options.max_image_pixels = 0;
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path(), options); }), HasSubstr("--max-image-pixels"));
}

TEST(SequenceOpen, RefusesPosesInASurveysFrame) {
  const TempFolder temp;
  put_tum(temp);
  std::string truth;
  for (int k = 0; k < 3; ++k) {
    truth += "10." + std::to_string(k) + "00 " + std::to_string(500000 + k) + " 5400000 310 0 0 0 1\n";
  }
  temp.put("groundtruth.txt", truth);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
              testing::AllOf(HasSubstr("is too far from the origin: around 500001 5400000 310"),
                             HasSubstr("an origin such as 500000 5400000 0 off the poses"), HasSubstr("--origin")));
}

TEST(SequenceTum, IsReadByManyThreadsAtOnce) {
  const TempFolder temp;
  put_tum(temp);
  const Sequence s = Sequence::open(temp.path());
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t k = 0; k < 30; ++k) wrong[t] += frame_in(s.color((k + t) % 3)) != static_cast<int>((k + t) % 3);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(wrong, testing::Each(0));
}

void put_icl(const TempFolder& temp) {
  std::string list;
  std::string truth;
  for (int k = 0; k < 12; ++k) {
    const std::string id = std::to_string(k);
    temp.put_image("rgb/" + id + ".png", color_of(k, 640, 480));
    temp.put_image("depth/" + id + ".png", depth_of(k, 640, 480));
    list += id + " depth/" + id + ".png " + id + " rgb/" + id + ".png\n";
    if (k > 0) truth += pose_line(id, k);
  }
  temp.put("associations.txt", list);
  temp.put("traj0.gt.freiburg", truth);
}

TEST(SequenceIcl, ImageKHasThePoseOfStampK) {
  const TempFolder temp;
  put_icl(temp);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "icl");
  EXPECT_EQ(s.camera(), (Camera{640, 480, 481.2, 480.0, 319.5, 239.5}));
  EXPECT_EQ(s.fy_sign(), -1);
  EXPECT_EQ(s.depth_scale(), 5000.0);
  ASSERT_EQ(s.size(), 12U);
  EXPECT_FALSE(s.T_world_camera(0));
  EXPECT_EQ(s.T_world_camera(7)->translation(), Eigen::Vector3d(7, -2, 3));  // reflected
  EXPECT_EQ(frame_in(s.color(10)), 10);
  EXPECT_NEAR(s.depth(10)(0, 0), 0.4F, 1e-6F);
  EXPECT_EQ(s.time_text(3), "0.100000");
  EXPECT_EQ(s.truth().size(), 11U);
  EXPECT_EQ(s.truth()[0].stamp(), "0.033333");
}

TEST(SequenceIcl, ACameraFileWithPositiveFyTurnsReflectionOff) {
  const TempFolder temp;
  put_icl(temp);
  temp.put("camera.yaml", "width: 640\nheight: 480\nfx: 481.2\nfy: 480\ncx: 319.5\ncy: 239.5\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.fy_sign(), 1);
  EXPECT_EQ(s.T_world_camera(7)->translation(), Eigen::Vector3d(7, 2, 3));
  EXPECT_EQ(s.depth_scale(), 5000.0);
}

TEST(SequenceIcl, MatricesWithoutStampsCountFromOne) {
  const TempFolder temp;
  put_icl(temp);
  fs::remove(temp / "traj0.gt.freiburg");
  std::string sim;
  for (int k = 1; k < 12; ++k) sim += "1 0 0 " + std::to_string(k) + "\n0 1 0 2\n0 0 1 3\n\n";
  temp.put("scene.gt.sim", sim);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.T_world_camera(0));
  EXPECT_EQ(s.T_world_camera(7)->translation(), Eigen::Vector3d(7, -2, 3));
}

TEST(SequenceIcl, FaultsNameTheFile) {
  const TempFolder temp;
  put_icl(temp);
  temp.put("traj0.gt.freiburg", "1.5 0 0 0 0 0 0 1\n");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("traj0.gt.freiburg: the stamp 1.5 is not"));
  temp.put("b.gt.freiburg", "1 0 0 0 0 0 0 1\n");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("holds more than one *.gt.freiburg"));
  temp.put("associations.txt", "0.5 depth/0.png 0.5 rgb/0.png\n");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("associations.txt: line 1: the id is not"));
}

TEST(SequenceRedwood, NumbersBindColourDepthAndPose) {
  const TempFolder temp;
  std::string log;
  for (int k = 0; k < 12; ++k) {
    const std::string id = std::to_string(k);
    if (k != 4) temp.put_image("room-color/" + id + ".jpg", color_of(k, 640, 480));
    temp.put_image("room-depth-clean/" + id + ".png", depth_of(k, 640, 480));
    temp.put_image("room-depth-simulated/" + id + ".png", depth_of(20, 640, 480));
    log += id + " " + id + " " + std::to_string(k + 1) + "\n" + matrix(k, "\n");
  }
  temp.put("room-traj.txt", log);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "redwood");
  EXPECT_EQ(s.camera(), (Camera{640, 480, 525, 525, 319.5, 239.5}));
  ASSERT_EQ(s.size(), 11U);
  EXPECT_EQ(frame_in(s.color(4)), 5);
  EXPECT_NEAR(s.depth(4)(0, 0), 1.5F, 1e-6F);
  EXPECT_EQ(s.T_world_camera(9)->translation(), Eigen::Vector3d(10, 2, 3));
  EXPECT_EQ(s.truth().size(), 12U);
  EXPECT_NEAR(s.time(9), 10.0 / 30.0, 1e-12);
  temp.put_image("other-color/1.png", color_of(1));
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("holds more than one *-color folder"));
}

TEST(SequenceSevenScenes, IsFoundFromTheSceneAndTheSequence) {
  const TempFolder temp;
  for (int k = 0; k < 3; ++k) {
    const std::string stem = "redkitchen/seq-01/frame-00000" + std::to_string(k);
    temp.put_image(stem + ".color.png", color_of(k, 640, 480));
    temp.put_image(stem + ".depth.png", depth_of(k, 640, 480));
    temp.put(stem + ".pose.txt", matrix(k, "\n"));
  }
  for (const char* path : {"redkitchen", "redkitchen/seq-01", "redkitchen/seq-01/"}) {
    const Sequence s = Sequence::open(temp / path);
    EXPECT_EQ(s.layout(), "sevenscenes");
    EXPECT_EQ(s.camera(), (Camera{640, 480, 525, 525, 320, 240}));
    ASSERT_EQ(s.size(), 3U);
    // The pose is of the depth camera, which is 2.6 cm to the left of the colour camera and turned by 0.65 degrees.
    const SE3 T_depth_color = SE3(Eigen::Quaterniond::Identity(), {2, 2, 3}).inverse() * *s.T_world_camera(2);
    EXPECT_NEAR(T_depth_color.translation().norm(), 0.02564, 1e-5);
    EXPECT_GT(T_depth_color.translation().x(), 0.025);
    EXPECT_NEAR(T_depth_color.angle() * 180.0 / 3.14159265, 0.669, 0.01);
    const DepthImage depth = s.depth(2);
    ASSERT_EQ(depth.size(), cv::Size(640, 480));
    EXPECT_NEAR(depth(240, 320), 1.2F, 0.01F);
    EXPECT_EQ(depth(240, 639), 0.0F);  // the colour camera sees more
  }
  EXPECT_EQ(Sequence::open(temp / "redkitchen/seq-01/").name(), "seq-01");
  temp.put("redkitchen/seq-01/frame-000001.pose.txt", "1 0 0 0\n0 no 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_EQ(error_of([&] { Sequence::open(temp / "redkitchen"); }),
            temp / "redkitchen/seq-01/frame-000001.pose.txt" + ": line 2: `no` is not a number");
  fs::create_directories(temp / "redkitchen/seq-02");
  EXPECT_EQ(error_of([&] { Sequence::open(temp / "redkitchen"); }),
            temp / "redkitchen" + ": holds several sequences, name one: seq-01, seq-02");
}

TEST(SequenceReplica, ReadsItsCameraFromTheFolderOrAbove) {
  const TempFolder temp;
  const std::string json =
      R"({"camera": {"w": 16, "h": 12, "fx": 20.0, "fy": 20, "cx": 7.5, "cy": 5.5, "scale": 1000}})";
  for (int k = 0; k < 2; ++k) {
    temp.put_image("office0/results/frame00000" + std::to_string(k) + ".jpg", color_of(k));
    temp.put_image("office0/results/depth00000" + std::to_string(k) + ".png", depth_of(k));
  }
  temp.put("office0/traj.txt", matrix(0, " ") + matrix(1, " ") + matrix(2, " "));
  temp.put("cam_params.json", json);
  const Sequence s = Sequence::open(temp / "office0");
  EXPECT_EQ(s.layout(), "replica");
  EXPECT_EQ(s.camera(), (Camera{16, 12, 20, 20, 7.5, 5.5}));
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s.truth().size(), 3U);
  EXPECT_EQ(s.T_world_camera(1)->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(s.depth(1)(0, 0), 1.1F, 1e-6F);
  const auto fault = [&](const std::string& text) {
    temp.put("office0/cam_params.json", text);
    return error_of([&] { Sequence::open(temp / "office0"); });
  };
  const std::string file = temp / "office0/cam_params.json";
  EXPECT_THAT(fault("{\n"), StartsWith(file + ": line 2, column 1: is not JSON: "));
  EXPECT_EQ(fault("[]"), file + ": is not a JSON object");
  EXPECT_EQ(fault("{}"), file + ": camera: is missing");
  EXPECT_EQ(fault(R"({"camera": {"w": 16}})"), file + ": h: is missing");
  EXPECT_EQ(fault(R"({"camera": {"w": "16", "h": 12}})"), file + ": w: is not a number");
  std::string zero = json;
  EXPECT_THAT(fault(zero.replace(zero.find("20.0"), 4, "0")), StartsWith(file + ": fx: must be positive"));
  fs::remove(file);
  fs::remove(temp / "cam_params.json");
  EXPECT_THAT(error_of([&] { Sequence::open(temp / "office0"); }), HasSubstr("has no camera.yaml"));
}

TEST(SequenceImages, AreInNaturalOrder) {
  const TempFolder temp;
  for (int k = 0; k < 12; ++k) {
    if (k != 3) temp.put_image(std::to_string(k) + (k % 2 == 0 ? ".png" : ".JPG"), color_of(k));
  }
  SequenceOptions options;
  options.camera_file = temp.put("calibration/c.yaml", camera_yaml + "fps: 20\n");
  const Sequence s = Sequence::open(temp.path(), options);
  EXPECT_EQ(s.layout(), "images");
  ASSERT_EQ(s.size(), 11U);
  EXPECT_EQ(frame_in(s.color(3)), 4);
  EXPECT_EQ(frame_in(s.color(10)), 11);
  EXPECT_NEAR(s.time(10), 0.5, 1e-12);
  EXPECT_FALSE(s.has_depth(0));
  EXPECT_FALSE(s.T_world_camera(0));
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("has no camera.yaml"));
}

TEST(SequenceVideo, FramesAreTheSameInAnyOrder) {
  const TempFolder temp;
  const std::string path = temp / "clip.avi";
  cv::VideoWriter writer(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 12.0, {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int k = 0; k < 9; ++k) writer.write(color_of(k, 64, 48));
  writer.release();
  SequenceOptions options;
  options.camera_file = temp.put("c.yaml", "width: 64\nheight: 48\nfx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\n");
  const Sequence s = Sequence::open(path, options);
  EXPECT_EQ(s.layout(), "video");
  EXPECT_EQ(s.name(), "clip.avi");
  ASSERT_EQ(s.size(), 9U);
  EXPECT_NEAR(s.fps(), 12.0, 1e-6);
  EXPECT_NEAR(s.time(6), 0.5, 1e-9);
  for (const std::size_t i : {0U, 1U, 2U, 8U, 3U, 4U, 0U, 7U}) EXPECT_EQ(frame_in(s.color(i)), static_cast<int>(i));
  EXPECT_EQ(error_of([&] { Sequence::open(path); }), path + ": a video needs a camera file (--camera)");
  options.camera_file = temp.put("d.yaml", camera_yaml);
  EXPECT_EQ(error_of([&] { Sequence::open(path, options); }),
            path + ": is 64x48, " + temp / "d.yaml" + " is for 16x12");
  const std::string text = temp.put("text1.txt", "no video");
  testing::internal::CaptureStderr();
  EXPECT_EQ(error_of([&] { Sequence::open(text, options); }), text + ": is not a video that can be read");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(SequenceOpen, SaysWhatItKnows) {
  const TempFolder temp;
  EXPECT_EQ(error_of([&] { Sequence::open(temp / "none"); }), temp / "none" + ": is missing");
  const std::string unknown = error_of([&] { Sequence::open(temp.path()); });
  EXPECT_THAT(unknown, StartsWith(temp.path() + ": no known layout"));
  for (const char* layout :
       {"tum", "icl", "redwood", "sevenscenes", "replica", "colmap", "nerfstudio", "images", "video"}) {
    EXPECT_THAT(unknown, HasSubstr(layout));
    SequenceOptions options;
    options.layout = layout;
    options.check();
    EXPECT_THROW(Sequence::open(temp.path(), options), InputError) << layout;
  }
  SequenceOptions options;
  options.layout = "kitti";
  EXPECT_THAT(error_of([&] { options.check(); }), HasSubstr("`kitti` is not known; known are"));
}

}  // namespace
}  // namespace odosplat
