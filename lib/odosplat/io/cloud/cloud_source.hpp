// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace odosplat {

/// A file (or bytes in memory) that is open for reading; `name` stands for it in errors, `size` [bytes].
struct CloudInput {
  std::string name;
  std::unique_ptr<std::istream> in;
  std::uint64_t size = 0;

  /// Reads n bytes; throws InputError if the file has fewer.
  void take(char* to, std::size_t n) const;
};

/// Points as stored in the file: including points that are not finite, colours in the file's own range, normals of any
/// length. colors and normals are empty or as long as points.
struct CloudRows {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> colors;
  std::vector<Eigen::Vector3f> normals;

  void clear();
};

/// The possible values for full colour intensity: the smallest of 1, 255 and 65535 within low..high that no value of
/// the file exceeds.
struct ColorRange {
  float low = 255.0F;
  float high = 255.0F;
  bool black_is_none = false;  // true: a file whose colours are all zero counts as one without colours
};

/// Interface of the readers of cloud formats. scan_cloud filters and converts the rows that they return.
class CloudSource {
 public:
  static constexpr std::size_t batch_rows = std::size_t{1} << 16;

  virtual ~CloudSource() = default;
  /// Replaces `rows` by the next rows, at most batch_rows; false at the end. Throws InputError as scan_cloud does.
  virtual bool next(CloudRows& rows) = 0;
  /// nullopt if the file has no colours.
  virtual std::optional<ColorRange> color_range() const = 0;
  /// The word for a row in errors.
  virtual const char* row_word() const { return "point"; }
  /// To be called after the last row: a text about rows beyond those that the header declares ("the header promises 5
  /// points, ..."); empty if there are none. May read from the file.
  virtual std::string left_over() { return {}; }
};

std::unique_ptr<CloudSource> open_ply_source(CloudInput input);
std::unique_ptr<CloudSource> open_pcd_source(CloudInput input);
std::unique_ptr<CloudSource> open_las_source(CloudInput input);
std::unique_ptr<CloudSource> open_text_source(CloudInput input);

}  // namespace odosplat
