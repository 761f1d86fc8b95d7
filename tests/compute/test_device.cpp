// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "odosplat/compute/context.hpp"
#include "odosplat/compute/device.hpp"

namespace odosplat::compute {
namespace {

using testing::HasSubstr;

DeviceInfo device(int index, const std::string& name, DeviceType type, const std::string& refusal = "") {
  DeviceInfo info;
  info.index = index;
  info.name = name;
  info.platform = "platform of " + name;
  info.type = type;
  info.refusal = refusal;
  return info;
}

std::string message_of(const std::vector<DeviceInfo>& devices, const std::string& selector) {
  try {
    choose_device(devices, selector);
  } catch (const NoSuchDevice& e) {
    return e.what();
  }
  return "chosen";
}

class Device : public testing::Test {
 protected:
  void SetUp() override {
    const char* old = std::getenv("ODOSPLAT_DEVICE");
    old_ = old != nullptr ? old : "";
    unsetenv("ODOSPLAT_DEVICE");
  }
  // Restores the user's choice for the following tests.
  void TearDown() override {
    if (old_.empty()) {
      unsetenv("ODOSPLAT_DEVICE");
    } else {
      setenv("ODOSPLAT_DEVICE", old_.c_str(), 1);
    }
  }
  std::string old_;
  const std::vector<DeviceInfo> devices_{device(0, "llvmpipe (LLVM 15)", DeviceType::gpu, "it returns wrong pixels"),
                                         device(1, "EPYC", DeviceType::cpu), device(2, "GeForce One", DeviceType::gpu),
                                         device(3, "GeForce Two", DeviceType::gpu)};
};

TEST_F(Device, DefaultIsFirstUsableGpuThenCpu) {
  EXPECT_EQ(choose_device(devices_, "").index, 2);
  EXPECT_EQ(choose_device({devices_[0], devices_[1]}, "").name, "EPYC");
}

TEST_F(Device, SelectorIsIndexOrPartOfName) {
  EXPECT_EQ(choose_device(devices_, "3").index, 3);
  EXPECT_EQ(choose_device(devices_, "two").index, 3);
  EXPECT_EQ(choose_device(devices_, "platform of epyc").index, 1);
}

TEST_F(Device, EnvironmentCountsWhenNothingIsAsked) {
  setenv("ODOSPLAT_DEVICE", "epyc", 1);
  EXPECT_EQ(choose_device(devices_, "").index, 1);
  EXPECT_EQ(choose_device(devices_, "2").index, 2);
}

TEST_F(Device, RefusedOneIsNamedWithReason) {
  EXPECT_THAT(message_of(devices_, "llvmpipe"), HasSubstr("is refused: it returns wrong pixels"));
  EXPECT_THAT(message_of({devices_[0]}, ""), HasSubstr("llvmpipe"));
}

TEST_F(Device, UnknownOneListsWhatThereIs) {
  EXPECT_THAT(message_of(devices_, "9"), HasSubstr("1 EPYC, 2 GeForce One"));
  EXPECT_THAT(message_of({}, ""), HasSubstr("pocl-opencl-icd"));
}

TEST_F(Device, RealOnesAreDescribed) {
  const std::vector<DeviceInfo> real = list_devices();
  ASSERT_FALSE(real.empty()) << "the device tests need an OpenCL runtime: pocl-opencl-icd";
  for (std::size_t i = 0; i < real.size(); ++i) {
    EXPECT_EQ(real[i].index, static_cast<int>(i));
    EXPECT_FALSE(real[i].name.empty());
    EXPECT_FALSE(real[i].driver_version.empty());
    EXPECT_GT(real[i].compute_units, 0U);
  }
}

}  // namespace
}  // namespace odosplat::compute
