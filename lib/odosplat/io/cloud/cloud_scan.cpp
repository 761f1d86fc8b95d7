// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/cloud_scan.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_source.hpp"
#include "odosplat/io/foreign_format.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {

void CloudInput::take(char* to, std::size_t n) const {
  in->read(to, static_cast<std::streamsize>(n));
  if (static_cast<std::size_t>(in->gcount()) != n) throw InputError(name, "cannot be read");
}

void CloudRows::clear() {
  points.clear();
  colors.clear();
  normals.clear();
}

namespace {

using Opener = std::unique_ptr<CloudSource> (*)(CloudInput);
using MakeInput = std::function<CloudInput()>;

std::string extension_of(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Opener opener_of(const CloudInput& input) {
  std::array<char, 16> start{};
  input.in->read(start.data(), start.size());
  const std::string_view magic(start.data(), static_cast<std::size_t>(input.in->gcount()));
  input.in->clear();
  input.in->seekg(0);
  const std::string_view begin = magic.substr(magic.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  if (begin.starts_with("ply\n") || begin.starts_with("ply\r")) return open_ply_source;
  if (magic.starts_with("LASF")) return open_las_source;
  if (begin.starts_with("# .PCD") || begin.starts_with("VERSION ")) return open_pcd_source;
  refuse_foreign_format(input.name, magic);
  const std::string extension = extension_of(input.name);
  if (extension == ".ply") return open_ply_source;
  if (extension == ".pcd") return open_pcd_source;
  if (extension == ".las" || extension == ".laz") return open_las_source;
  for (const char* text : {".xyz", ".csv", ".txt", ".asc", ".pts"}) {
    if (extension == text) return open_text_source;
  }
  throw InputError(input.name, "is no point cloud of a known format (PLY, PCD, LAS, or text as .xyz .csv .txt)");
}

constexpr double farthest = 1e15;  // [m] beyond, squares of distances approach the range of single precision

// With a tolerance, because colours stored as floats may exceed the full value slightly.
bool exceeds(float value, float full) { return value > full * 1.001F; }

// Reads rows until the value of full colour intensity is determined; 0 if the file has no colours.
float full_color(CloudSource& source, const ColorRange& range) {
  float largest = 0.0F;
  float full = range.low;
  CloudRows rows;
  while (full < range.high && source.next(rows)) {
    for (std::size_t i = 0; i < rows.colors.size(); ++i) {
      if (!rows.points[i].allFinite() || !rows.colors[i].allFinite()) continue;
      largest = std::max(largest, rows.colors[i].maxCoeff());
    }
    for (const float next : {255.0F, 65535.0F}) {
      if (exceeds(largest, full) && next > full && next <= range.high) full = next;
    }
  }
  return range.black_is_none && largest <= 0.0F ? 0.0F : full;
}

// Converts rows as stored in files to finite points with colours in 0..1 and unit normals.
class Cleaner {
 public:
  Cleaner(const std::string& name, const char* row_word, float full)
      : name_(name), row_word_(row_word), full_color_(full) {}

  const CloudBatch& clean(const CloudRows& rows) {
    batch_.points.clear();
    batch_.colors.clear();
    batch_.normals.clear();
    for (std::size_t i = 0; i < rows.points.size(); ++i, ++seen_) {
      if (!rows.points[i].allFinite()) continue;
      if (!(rows.points[i].cwiseAbs().maxCoeff() < farthest)) {
        any_far_ = true;
        continue;
      }
      batch_.points.push_back(rows.points[i]);
      if (full_color_ > 0.0F && !rows.colors.empty()) batch_.colors.push_back(color(rows.colors[i]));
      if (!rows.normals.empty()) batch_.normals.push_back(normal(rows.normals[i]));
    }
    kept_ += batch_.points.size();
    return batch_;
  }

  void finish() const {
    if (kept_ == 0) throw InputError(name_, "holds no point");
    if (kept_ == seen_) return;
    log_warning(name_ + ": " + std::to_string(seen_ - kept_) + " of " + std::to_string(seen_) +
                " points are not finite " + (any_far_ ? "or 1e15 m and more from the origin, " : "") + "and left out");
  }

 private:
  Eigen::Vector3f color(const Eigen::Vector3f& raw) const {
    if (!raw.allFinite() || raw.minCoeff() < 0.0F || exceeds(raw.maxCoeff(), full_color_)) {
      throw InputError(name_, std::string(row_word_) + " " + std::to_string(seen_ + 1),
                       "its colour is negative or not finite");
    }
    return (raw / full_color_).cwiseMin(1.0F);
  }

  static Eigen::Vector3f normal(const Eigen::Vector3f& raw) {
    const float length = raw.norm();
    if (!std::isfinite(length) || length < 1e-6F) return Eigen::Vector3f::Zero();
    return raw / length;
  }

  const std::string& name_;
  const char* row_word_;
  float full_color_;
  std::size_t seen_ = 0;
  std::size_t kept_ = 0;
  bool any_far_ = false;
  CloudBatch batch_;
};

void scan(const std::string& name, const MakeInput& make_input, const CloudSink& sink) {
  CloudInput first = make_input();
  const Opener open = opener_of(first);
  std::unique_ptr<CloudSource> source = open(std::move(first));
  float full = 0.0F;
  if (const std::optional<ColorRange> range = source->color_range()) {
    full = range->high;
    if (range->low != range->high) {
      full = full_color(*source, *range);
      source = open(make_input());
    }
  }
  Cleaner cleaner(name, source->row_word(), full);
  CloudRows rows;
  while (source->next(rows)) {
    const CloudBatch& batch = cleaner.clean(rows);
    if (!batch.points.empty()) sink(batch);
  }
  cleaner.finish();
  const std::string more = source->left_over();
  if (!more.empty()) log_warning(name + ": " + more);
}

}  // namespace

void scan_cloud(const std::string& path, const CloudSink& sink) {
  require_regular_file(path);
  std::error_code error;
  const auto make_input = [&] {
    CloudInput input{path, std::make_unique<std::ifstream>(path, std::ios::binary), 0};
    input.size = std::filesystem::file_size(path, error);
    if (!*input.in || error) throw InputError(path, "cannot be read");
    return input;
  };
  scan(path, make_input, sink);
}

void scan_cloud_bytes(const std::string& name, const std::string& bytes, const CloudSink& sink) {
  const auto make_input = [&] { return CloudInput{name, std::make_unique<std::istringstream>(bytes), bytes.size()}; };
  scan(name, make_input, sink);
}

}  // namespace odosplat
