// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/near_origin.hpp"

namespace odosplat {
namespace {

using Positions = std::vector<Eigen::Vector3d>;

// A straight path of this length along x from `start`.
Positions path(const Eigen::Vector3d& start, double length) {
  Positions positions;
  for (int k = 0; k < 101; ++k) positions.emplace_back(start + Eigen::Vector3d(length * k / 100.0, 0.0, 0.0));
  return positions;
}

std::string fault_of(const Positions& positions) {
  try {
    require_near_origin("poses", positions);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(NearOrigin, RefusesWhatSinglePrecisionWouldSpoil) {
  EXPECT_EQ(fault_of(path({500000.25, 5400000.0, 310.0}, 8.0)),
            "poses: is too far from the origin: around 500004.2 5400000 310 single precision goes by steps of 0.5 m; "
            "take an origin such as 500000 5400000 0 off the poses, and the same off the cloud (`odosplat cloud --from "
            "FILE --origin X Y Z`)");
  EXPECT_NE(fault_of(path({0.0, -33000.0, 0.0}, 8.0)), "");
  EXPECT_NE(fault_of({{500000.0, 5400000.0, 0.0}}), "");
  // A few poses at the origin do not change the result.
  Positions mixed = path({500000.0, 5400000.0, 0.0}, 8.0);
  mixed.insert(mixed.begin(), 10, Eigen::Vector3d::Zero());
  EXPECT_NE(fault_of(mixed), "");
  EXPECT_NE(fault_of({{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}}), "");
}

TEST(NearOrigin, LetsPassWhatItDoesNot) {
  EXPECT_EQ(fault_of({}), "");
  EXPECT_EQ(fault_of(path({32000.0, 0.0, 0.0}, 8.0)), "");
  EXPECT_EQ(fault_of(path({0.0, 0.0, 0.0}, 100000.0)), "");        // a long drive
  EXPECT_EQ(fault_of(path({40000.0, 50000.0, 0.0}, 9000.0)), "");  // a room in millimetres
  Positions stray = path({0.0, 0.0, 0.0}, 8.0);
  stray.insert(stray.begin(), 10, Eigen::Vector3d(1e7, 1e7, 1e7));
  EXPECT_EQ(fault_of(stray), "");
}

}  // namespace
}  // namespace odosplat
