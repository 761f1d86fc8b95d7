// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "tests/locations.hpp"

namespace odosplat::test {

/// A temporary folder, removed when the test ends.
class TempFolder {
 public:
  TempFolder() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("odosplat_io_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

  /// Writes a file and creates its folders; returns its path.
  std::string put(const std::string& name, const std::string& content) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file.string();
  }

  /// Encodes an image in the format of the name's extension.
  std::string put_image(const std::string& name, const cv::Mat& bgr) const {
    std::vector<unsigned char> bytes;
    cv::imencode(name.substr(name.rfind('.')), bgr, bytes);
    return put(name, std::string(bytes.begin(), bytes.end()));
  }

  /// Names of all files below, to check that nothing is left over.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_)) {
      if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), path_).string());
    }
    return names;
  }

 private:
  std::filesystem::path path_;
};

/// Message of the InputError that `call` throws. The test fails if it throws none, or one with several lines.
template <typename Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

/// Copies a folder or file of the shared data; false if it does not exist.
inline bool copy_shared(const std::string& name, const std::string& to) {
  const std::filesystem::path from = std::filesystem::path(shared_data()) / name;
  if (!std::filesystem::exists(from)) return false;
  std::filesystem::create_directories(std::filesystem::path(to).parent_path());
  std::filesystem::copy(from, to, std::filesystem::copy_options::recursive);
  return true;
}

}  // namespace odosplat::test

/// Path of a shared data set; skips the test if it does not exist.
#define SHARED_DATA_OR_SKIP(variable, name)                                  \
  const std::string variable = odosplat::test::shared_data() + "/" + (name); \
  if (!std::filesystem::exists(variable)) GTEST_SKIP() << "no shared data set " << variable
