// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "odosplat/compute/build_notice.hpp"
#include "odosplat/compute/program.hpp"

namespace odosplat::compute {
namespace {

using testing::HasSubstr;

constexpr const char* scale_text = R"(
__kernel void scale(__global const float* restrict in, __global float* restrict out, float factor, int n) {
  const int i = (int)get_global_id(0);
  if (i < n) out[i] = factor * in[i];
})";

class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("odosplat_cache_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    const char* old = std::getenv("ODOSPLAT_CACHE_DIR");
    old_ = old != nullptr ? old : "";
    setenv("ODOSPLAT_CACHE_DIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    if (old_.empty()) {
      unsetenv("ODOSPLAT_CACHE_DIR");
    } else {
      setenv("ODOSPLAT_CACHE_DIR", old_.c_str(), 1);
    }
  }
  std::filesystem::path kernels() const { return folder_ / "kernels"; }
  std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> found;
    if (!std::filesystem::exists(kernels())) return found;
    for (const auto& e : std::filesystem::directory_iterator(kernels())) found.push_back(e.path());
    return found;
  }
  std::vector<float> run_scale(float factor) {
    Kernel kernel = Program::from_text(context_, scale_text).kernel("scale");
    const Buffer<float> in(context_, std::vector<float>{1.0F, 2.0F, 3.0F});
    const Buffer<float> out(context_, 3);
    kernel(Range::linear(3, 64), in, out, factor, std::int32_t{3});
    return out.download();
  }
  Context context_ = Context::open();
  std::filesystem::path folder_;
  std::string old_;
};

TEST_F(ProgramTest, RunsWithTypedArguments) { EXPECT_EQ(run_scale(2.0F), (std::vector<float>{2.0F, 4.0F, 6.0F})); }

TEST_F(ProgramTest, BinaryIsKeptOnDiskAndUsedAgain) {
  run_scale(1.0F);
  ASSERT_EQ(entries().size(), 1U);
  const auto written = std::filesystem::last_write_time(entries()[0]);
  EXPECT_EQ(run_scale(3.0F), (std::vector<float>{3.0F, 6.0F, 9.0F}));
  EXPECT_EQ(std::filesystem::last_write_time(entries()[0]), written);
}

TEST_F(ProgramTest, LongBuildsAreAnnouncedOnce) {
  Context context = Context::open();
  int notices = 0;
  set_build_notice(
      context, [&notices] { ++notices; }, 0.0);
  Program::from_text(context, scale_text);
  EXPECT_EQ(notices, 1);
  Program::from_text(context, scale_text, "-DOTHER");
  EXPECT_EQ(notices, 1) << "once for a context";
  Context again = Context::open();
  set_build_notice(
      again, [&notices] { ++notices; }, 0.0);
  Program::from_text(again, scale_text);
  EXPECT_EQ(notices, 1) << "what the cache holds is not built";
  set_build_notice(
      again, [&notices] { ++notices; }, 3600.0);
  Program::from_text(again, scale_text, "-DLAST");
  EXPECT_EQ(notices, 1) << "nobody waited long";
}

TEST_F(ProgramTest, OptionsAreInTheKey) {
  run_scale(1.0F);
  Program::from_text(context_, scale_text, "-D X=1");
  EXPECT_EQ(entries().size(), 2U);
}

TEST_F(ProgramTest, BrokenCacheEntryIsRebuilt) {
  run_scale(1.0F);
  const std::filesystem::path entry = entries().at(0);
  const auto size = std::filesystem::file_size(entry);
  for (const std::uintmax_t cut : {std::uintmax_t{0}, std::uintmax_t{10}, size / 2, size - 1}) {
    std::filesystem::resize_file(entry, cut);
    EXPECT_EQ(run_scale(2.0F), (std::vector<float>{2.0F, 4.0F, 6.0F})) << "cut to " << cut;
    EXPECT_EQ(std::filesystem::file_size(entry), size);
  }
  std::fstream file(entry, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(size - 20));
  file.write("garbage", 7);
  file.close();
  EXPECT_EQ(run_scale(2.0F), (std::vector<float>{2.0F, 4.0F, 6.0F}));
}

TEST_F(ProgramTest, UnwritableCacheIsNoError) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  EXPECT_EQ(run_scale(2.0F), (std::vector<float>{2.0F, 4.0F, 6.0F}));
}

TEST_F(ProgramTest, BuildErrorCarriesDeviceOptionsAndLog) {
  try {
    Program::from_text(context_, "__kernel void broken() { undeclared_name = 1; }", "-D MARK=7");
    FAIL() << "built";
  } catch (const DeviceError& e) {
    EXPECT_THAT(e.what(), HasSubstr("clBuildProgram"));
    EXPECT_THAT(e.what(), HasSubstr(context_.device().name));
    EXPECT_THAT(e.what(), HasSubstr("-D MARK=7"));
    EXPECT_THAT(e.what(), HasSubstr("undeclared_name"));
  }
}

TEST_F(ProgramTest, WrongCallsAreNamed) {
  const Program program = Program::from_text(context_, scale_text);
  EXPECT_THROW(program.kernel("nothing"), DeviceError);
  Kernel kernel = program.kernel("scale");
  const Buffer<float> b(context_, 1);
  EXPECT_THROW(kernel(Range::linear(1, 1), b, b), DeviceError);
  EXPECT_THROW(kernel(Range::linear(1, 1 << 20), b, b, 1.0F, std::int32_t{1}), DeviceError);
}

TEST_F(ProgramTest, ProfilingCountsLaunches) {
  context_.set_profiling(true);
  run_scale(1.0F);
  run_scale(1.0F);
  ASSERT_EQ(context_.kernel_times().size(), 1U);
  EXPECT_EQ(context_.kernel_times()[0].name, "scale");
  EXPECT_EQ(context_.kernel_times()[0].launches, 2);
  EXPECT_EQ(context_.kernel_times()[0].stage, "scale");
  context_.reset_kernel_times();
  EXPECT_TRUE(context_.kernel_times().empty());
}

TEST_F(ProgramTest, ProfilingSumsTheKernelsOfAStage) {
  const Program program = Program::from_text(context_, scale_text);
  Kernel own = program.kernel("scale"), first = program.kernel("scale", "work"), second = first;
  Buffer<float> in(context_, std::vector<float>{1.0F}), out(context_, 1);
  context_.set_profiling(true);
  for (Kernel* kernel : {&first, &own, &second}) (*kernel)(Range::linear(1, 1), in, out, 2.0F, std::int32_t{1});
  const std::vector<StageTime> stages = context_.stage_times();
  ASSERT_EQ(stages.size(), 2U);
  EXPECT_EQ(stages[0].stage, "work");
  EXPECT_EQ(stages[0].launches, 2);
  ASSERT_EQ(stages[0].kernels.size(), 1U);
  EXPECT_EQ(stages[0].kernels[0].milliseconds, stages[0].milliseconds);
  EXPECT_EQ(stages[1].stage, "scale");
  EXPECT_EQ(stages[1].launches, 1);
}

TEST(BufferTest, TooLittleMemoryIsAnErrorAndNoAbort) {
  const Context context = Context::open();
  if (!context.is_cpu()) GTEST_SKIP() << "a limit of this process does not reach a GPU's memory";
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &old), 0);
  rlimit little = old;
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  little.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (32U << 20U);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  std::string fault;
  try {
    Buffer<float> buffer(context, std::size_t{1} << 26U);
    buffer.fill_zero();
    context.finish();
  } catch (const DeviceError& e) {
    fault = e.what();
  }
  setrlimit(RLIMIT_AS, &old);
  EXPECT_THAT(fault, HasSubstr("too little memory"));
}

TEST(BufferTest, EmptyAndGrowing) {
  const Context context = Context::open();
  Buffer<std::uint32_t> buffer(context, 0);
  EXPECT_TRUE(buffer.download().empty());
  buffer.resize(context, 3);
  buffer.upload({1, 2, 3});
  buffer.resize(context, 2);
  EXPECT_EQ(buffer.download(), (std::vector<std::uint32_t>{1, 2}));
  Buffer<std::uint32_t> copy;
  copy.copy_from(context, buffer);
  buffer.fill_zero();
  EXPECT_EQ(copy.download(), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(buffer.download(), (std::vector<std::uint32_t>{0, 0}));
}

}  // namespace
}  // namespace odosplat::compute
