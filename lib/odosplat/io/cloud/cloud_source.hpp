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

  /// Reads n bytes; InputError if the file does not give them.
  void take(char* to, std::size_t n) const;
};

/// Points as the file has them: not finite ones too, colours in the file's own range, normals of any length. colors and
/// normals are empty or as long as points.
struct CloudRows {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> colors;
  std::vector<Eigen::Vector3f> normals;

  void clear();
};

/// What a full colour may be: of 1, 255 and 65535 the first in low..high that no value of the file exceeds.
struct ColorRange {
  float low = 255.0F;
  float high = 255.0F;
  bool black_is_none = false;  // a file whose colours are all zero has none
};

/// One format's reader; scan_cloud makes the best of what it gives.
class CloudSource {
 public:
  static constexpr std::size_t batch_rows = std::size_t{1} << 16;

  virtual ~CloudSource() = default;
  /// Replaces `rows` by the next at most batch_rows; false at the end. InputError as scan_cloud says.
  virtual bool next(CloudRows& rows) = 0;
  /// Nothing if the file has no colours.
  virtual std::optional<ColorRange> color_range() const = 0;
  /// What errors call a row.
  virtual const char* row_word() const { return "point"; }
  /// Behind the last row: what the file holds beyond what its header promises, as "the header promises 5 points, ...";
  /// empty if it holds no more. May read on.
  virtual std::string left_over() { return {}; }
};

std::unique_ptr<CloudSource> open_ply_source(CloudInput input);
std::unique_ptr<CloudSource> open_pcd_source(CloudInput input);
std::unique_ptr<CloudSource> open_las_source(CloudInput input);
std::unique_ptr<CloudSource> open_text_source(CloudInput input);

}  // namespace odosplat
