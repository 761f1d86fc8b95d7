// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Playing by time stamps: pauses, stamps in other units, a stop while waiting.
#include "apps/cli/track/playback.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps {
namespace {

using testing::HasSubstr;

class PlaybackTest : public testing::Test {
 protected:
  PlaybackTest() { apps_test::write_tiny_sequence(scratch_ / "seq", 24); }

  /// A sequence of images with these time stamps.
  Sequence sequence(const std::vector<std::string>& stamps) const {
    std::string list;
    for (std::size_t i = 0; i < stamps.size(); ++i) list += stamps[i] + " rgb/000" + std::to_string(i) + ".png\n";
    apps_test::write_text(scratch_ / "seq/rgb.txt", list);
    return Sequence::open((scratch_ / "seq").string());
  }
  static std::size_t frames_played(Playback& playback) {
    std::size_t frames = 0;
    while (playback.next([] { return false; })) frames += 1 + playback.dropped();
    return frames;
  }

  apps_test::ScratchFolder scratch_;
};

TEST_F(PlaybackTest, KeepsToTheStamps) {
  Playback playback(sequence({"10.0", "10.1", "10.2", "10.3"}), {});
  const Stopwatch watch;
  EXPECT_EQ(frames_played(playback), 4U);
  EXPECT_GT(watch.seconds(), 0.28);
  EXPECT_LT(watch.seconds(), 2.0);
}

TEST_F(PlaybackTest, ShortensALongPause) {
  Playback playback(sequence({"10.0", "10.1", "110.0", "110.1"}), {});
  const Stopwatch watch;
  EXPECT_EQ(frames_played(playback), 4U);
  EXPECT_GT(watch.seconds(), 1.1);
  EXPECT_LT(watch.seconds(), 5.0);
}

TEST_F(PlaybackTest, RefusesStampsInOtherUnits) {
  const auto fault = [](const Sequence& sequence) -> std::string {
    try {
      const Playback playback(sequence, {});
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(fault(sequence({"1000", "1033", "1066", "1100"})), HasSubstr("milliseconds?"));
  EXPECT_THAT(fault(sequence({"1000000", "1033000", "1066000", "1100000"})), HasSubstr("microseconds?"));
  EXPECT_THAT(
      fault(sequence({"1403636579763555584", "1403636579813555456", "1403636579863555584", "1403636579913555456"})),
      HasSubstr("nanoseconds?"));
}

TEST_F(PlaybackTest, StopsWhileItWaits) {
  Playback playback(sequence({"10.0", "40.0", "40.1", "40.2"}), {});
  const auto never = [] { return false; };
  EXPECT_EQ(playback.next(never), 0U);
  const Stopwatch watch;
  EXPECT_FALSE(playback.next([&] { return watch.seconds() > 0.2; }));
  EXPECT_LT(watch.seconds(), 1.2);
}

}  // namespace
}  // namespace odosplat::apps
