// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/sog.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/archive/compression.hpp"
#include "odosplat/io/archive/zip_archive.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/webp_image.hpp"
#include "odosplat/io/text/json_text.hpp"
#include "odosplat/splat/broken_rows.hpp"
#include "odosplat/splat/format/quantized.hpp"

namespace odosplat {
namespace {

using Json = nlohmann::json;

constexpr std::size_t palette_row = 64;  // sets of harmonics in a row of the image
constexpr std::size_t most_palette = 65536;
constexpr std::size_t first_quaternion_tag = 252;
constexpr std::size_t bytes_a_gaussian = 17;  // of positions, rotations, scales, colours and opacities in the images
constexpr std::size_t spare_pixels = 65536;
constexpr std::size_t most_centroid_pixels = most_palette * 15;

/// A codebook, or values between two limits in steps of 1/255.
struct ByteValues {
  std::array<float, 256> values{};
  float operator[](std::size_t byte) const { return values[byte]; }
};

/// What meta.json says, with the place in errors.
class Meta {
 public:
  Meta(std::string name, Json json) : name_(std::move(name)), json_(std::move(json)) {}

  const Json& at(const char* group, const char* field) const {
    const auto outer = json_.find(group);
    if (outer == json_.end() || !outer->is_object() || !outer->contains(field)) {
      throw InputError(name_, std::string(group) + "." + field, "is missing");
    }
    return (*outer)[field];
  }

  bool has(const char* field) const { return json_.contains(field); }
  const Json& json() const { return json_; }
  const std::string& name() const { return name_; }

  std::vector<float> numbers(const char* group, const char* field, std::size_t count) const {
    const Json& list = at(group, field);
    std::vector<float> values;
    for (const Json& value : list.is_array() ? list : Json::array({list})) {
      if (value.is_number()) values.push_back(value.get<float>());
    }
    const auto is_finite = [](float v) { return std::isfinite(v); };
    if (values.size() != count || !std::all_of(values.begin(), values.end(), is_finite)) {
      throw InputError(name_, std::string(group) + "." + field, "must be " + std::to_string(count) + " numbers");
    }
    return values;
  }

  std::string file(const char* group, std::size_t index) const {
    const Json& files = at(group, "files");
    if (!files.is_array() || files.size() <= index || !files[index].is_string()) {
      throw InputError(name_, std::string(group) + ".files", "must name the images");
    }
    return files[index].get<std::string>();
  }

  std::size_t whole(const Json& value, const std::string& place, std::size_t most) const {
    if (!value.is_number_integer() || value < 1 || value > most) {
      throw InputError(name_, place, "must be a whole number in 1.." + std::to_string(most));
    }
    return value.get<std::size_t>();
  }

  ByteValues codebook(const char* group) const {
    const Json& list = at(group, "codebook");
    // Early writers left out the first value; the steps of the others continue it.
    const bool lacks_first = list.is_array() && !list.empty() && list[0].is_null();
    const std::vector<float> values = numbers(group, "codebook", lacks_first ? 255 : 256);
    ByteValues book;
    std::copy(values.rbegin(), values.rend(), book.values.rbegin());
    if (lacks_first) book.values[0] = values.front() + (values.front() - values.back()) / 255.0F;
    return book;
  }

 private:
  std::string name_;
  Json json_;
};

ByteValues between(float least, float most) {
  ByteValues book;
  for (std::size_t b = 0; b < 256; ++b) book.values[b] = least + (most - least) * static_cast<float>(b) / 255.0F;
  return book;
}

/// Pixels of an image as one list.
struct Pixels {
  cv::Mat4b image;  // continuous
  const cv::Vec4b& operator[](std::size_t i) const { return image.ptr<cv::Vec4b>()[i]; }
  std::size_t size() const { return image.total(); }
};

/// The files of a map: members of an archive, or beside meta.json.
class SogFiles {
 public:
  SogFiles(std::string name, const std::string& bytes, const ReadSibling& read_sibling)
      : name_(std::move(name)), bytes_(&bytes), read_sibling_(&read_sibling) {
    if (bytes.starts_with("PK")) archive_ = std::make_unique<ZipArchive>(name_, bytes);
    stored_ = bytes.size();
  }

  std::string meta() const {
    if (!archive_) return *bytes_;
    if (!archive_->has("meta.json")) {
      throw InputError(name_, "is a ZIP archive, but holds no map (no meta.json of SOG): unpack it first");
    }
    return archive_->read("meta.json", max_text_bytes);
  }

  /// Every image is read before the first is decoded, so that their sizes are known.
  void load(const std::string& file) {
    const bool loaded =
        std::any_of(contents_.begin(), contents_.end(), [&](const auto& content) { return content.first == file; });
    if (loaded) return;
    std::string content = archive_ ? archive_->read(file, most_bytes() - loaded_) : (*read_sibling_)(file);
    if (!archive_) stored_ += content.size();
    loaded_ += content.size();
    contents_.emplace_back(file, std::move(content));
  }

  /// Bytes of the archive, or of meta.json and the images that were loaded.
  std::size_t stored() const { return stored_; }

  /// The image of a file that was loaded, of 4 times the pixels needed and `spare` more at most.
  Pixels image(const std::string& file, std::size_t least_pixels, std::size_t spare = spare_pixels) const {
    const auto found =
        std::find_if(contents_.begin(), contents_.end(), [&](const auto& content) { return content.first == file; });
    const std::string where = name_ + ": " + file;
    const auto most = static_cast<std::int64_t>(4 * least_pixels + spare);
    Pixels pixels{parse_lossless_webp(where, found->second, most)};
    if (pixels.size() < least_pixels) {
      throw InputError(where, "has " + std::to_string(pixels.size()) + " pixels, must have " +
                                  std::to_string(least_pixels) + " at least");
    }
    return pixels;
  }

 private:
  /// Of all images of an archive together, as stored in it: WebP is compressed already, so that DEFLATE gains little.
  std::uint64_t most_bytes() const { return 16 * std::uint64_t{bytes_->size()} + (1U << 20U); }

  std::string name_;
  const std::string* bytes_;
  const ReadSibling* read_sibling_;
  std::uint64_t loaded_ = 0;
  std::unique_ptr<ZipArchive> archive_;
  std::vector<std::pair<std::string, std::string>> contents_;
  std::size_t stored_ = 0;
};

class SogReader {
 public:
  SogReader(Meta meta, SogFiles& files) : meta_(std::move(meta)), files_(files) {
    const Json version = meta_.json().value("version", Json());
    is_first_ = version.is_null() || version == 1;
    if (!is_first_ && version != 2) throw InputError(meta_.name(), "version", "is not read: only 1 and 2 are");
    count_ = is_first_ ? meta_.whole(first_of(meta_.at("means", "shape")), "means.shape", most_count)
                       : meta_.whole(meta_.json().value("count", Json()), "count", most_count);
    for (const char* group : {"means", "quats", "scales", "sh0"}) files_.load(meta_.file(group, 0));
    files_.load(meta_.file("means", 1));
    if (meta_.has("shN")) {
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) files_.load(meta_.file("shN", i));
    }
    require_plausible_size(meta_.name(), count_ * std::uint64_t{bytes_a_gaussian}, files_.stored());
  }

  Gaussians read() {
    Gaussians g;
    g.resize(count_);
    faults_.assign(count_, nullptr);
    read_positions(g);
    read_rotations(g);
    read_scales(g);
    if (meta_.has("shN")) read_harmonics(g);
    read_colors(g);
    BrokenRows broken(meta_.name(), g.size());
    for (std::size_t i = 0; i < g.size(); ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        if (!std::isfinite(g.positions[3 * i + a])) broken.add(i, "its position is not finite");
      }
      if (faults_[i] != nullptr) broken.add(i, faults_[i]);
    }
    broken.leave_out(g);
    return g;
  }

 private:
  static constexpr std::size_t most_count = std::size_t{1} << 28U;  // the largest WebP image has so many pixels

  static Json first_of(const Json& list) { return list.is_array() && !list.empty() ? list[0] : Json(); }

  std::vector<ByteValues> ranges(const char* group, std::size_t count) const {
    const std::vector<float> least = meta_.numbers(group, "mins", count);
    const std::vector<float> most = meta_.numbers(group, "maxs", count);
    std::vector<ByteValues> books;
    for (std::size_t a = 0; a < count; ++a) books.push_back(between(least[a], most[a]));
    return books;
  }

  void read_positions(Gaussians& g) const {
    const std::vector<float> least = meta_.numbers("means", "mins", 3);
    const std::vector<float> most = meta_.numbers("means", "maxs", 3);
    const Pixels low = files_.image(meta_.file("means", 0), count_);
    const Pixels high = files_.image(meta_.file("means", 1), count_);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        const int c = static_cast<int>(a);
        const double share = (low[i][c] + 256.0 * high[i][c]) / 65535.0;
        const double logarithm = least[a] + (double{most[a]} - least[a]) * share;
        g.positions[3 * i + a] = static_cast<float>(std::copysign(std::expm1(std::abs(logarithm)), logarithm));
      }
    }
  }

  void read_rotations(Gaussians& g) {
    const Pixels pixels = files_.image(meta_.file("quats", 0), count_);
    for (std::size_t i = 0; i < count_; ++i) {
      float* q = &g.rotations[4 * i];
      if (pixels[i][3] < first_quaternion_tag) {
        faults_[i] = "the mark of its rotation is not in 252..255";
        continue;
      }
      const std::size_t largest = pixels[i][3] - first_quaternion_tag;
      int channel = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        if (a == largest) continue;
        q[a] = sqrt_half * (static_cast<float>(pixels[i][channel++]) / 127.5F - 1.0F);
      }
      restore_largest(q, largest);
    }
  }

  void read_scales(Gaussians& g) const {
    const Pixels pixels = files_.image(meta_.file("scales", 0), count_);
    const std::vector<ByteValues> books =
        is_first_ ? ranges("scales", 3) : std::vector<ByteValues>(3, meta_.codebook("scales"));
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t a = 0; a < 3; ++a) g.log_scales[3 * i + a] = books[a][pixels[i][static_cast<int>(a)]];
    }
  }

  void read_colors(Gaussians& g) const {
    const Pixels pixels = files_.image(meta_.file("sh0", 0), count_);
    const std::vector<ByteValues> books =
        is_first_ ? ranges("sh0", 4) : std::vector<ByteValues>(3, meta_.codebook("sh0"));
    const auto width = 3 * static_cast<std::size_t>(g.coefficients());
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t c = 0; c < 3; ++c) g.sh[width * i + c] = books[c][pixels[i][static_cast<int>(c)]];
      g.opacity_logits[i] =
          is_first_ ? books[3][pixels[i][3]] : logit_of_opacity_byte(static_cast<float>(pixels[i][3]));
    }
  }

  void read_harmonics(Gaussians& g) {
    const std::string centroids_file = meta_.file("shN", 0);
    const Pixels labels = files_.image(meta_.file("shN", 1), count_);
    // Version 1 does not say the degree: the width of the image does.
    const Pixels centroids = files_.image(centroids_file, 1, most_centroid_pixels);
    const auto columns = static_cast<std::size_t>(centroids.image.cols);
    g.sh_degree =
        is_first_ ? degree_of_width(columns) : static_cast<int>(meta_.whole(meta_.at("shN", "bands"), "shN.bands", 3));
    const auto rest = static_cast<std::size_t>(g.coefficients() - 1);
    const std::size_t palette = is_first_ ? palette_row * static_cast<std::size_t>(centroids.image.rows)
                                          : meta_.whole(meta_.at("shN", "count"), "shN.count", most_palette);
    if (columns != palette_row * rest || centroids.size() < (palette + palette_row - 1) / palette_row * columns) {
      throw InputError(meta_.name(), "shN", centroids_file + " is not of the size that bands and count demand");
    }
    const ByteValues book = is_first_ ? ranges("shN", 1)[0] : meta_.codebook("shN");
    g.sh.assign(3 * (rest + 1) * count_, 0.0F);
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t label = labels[i][0] + std::size_t{256} * labels[i][1];
      if (label >= palette) {
        faults_[i] = "its set of harmonics is missing";
        continue;
      }
      const std::size_t first = label / palette_row * columns + label % palette_row * rest;
      for (std::size_t j = 0; j < rest; ++j) {
        const cv::Vec4b& pixel = centroids[first + j];
        for (int c = 0; c < 3; ++c) g.sh[3 * ((rest + 1) * i + 1 + j) + static_cast<std::size_t>(c)] = book[pixel[c]];
      }
    }
  }

  int degree_of_width(std::size_t columns) const {
    for (int degree = 1; degree <= 3; ++degree) {
      if (columns == palette_row * static_cast<std::size_t>(sh_coefficients(degree) - 1)) return degree;
    }
    throw InputError(meta_.name(), "shN", "the image of the harmonics has a width that fits no degree");
  }

  Meta meta_;
  SogFiles& files_;
  bool is_first_ = false;
  std::size_t count_ = 0;
  std::vector<const char*> faults_;  // of a Gaussian; nullptr: none was found
};

std::vector<std::string> lines_of_meta(const Json& meta) {
  const Json is_antialiased = meta.value("antialias", Json());
  return is_antialiased == true ? std::vector<std::string>{"compensated 1"} : std::vector<std::string>{};
}

}  // namespace

ForeignMap parse_sog(const std::string& name, const std::string& bytes, const ReadSibling& read_sibling) {
  SogFiles files(name, bytes, read_sibling);
  Json json = parse_json_object(name, files.meta());
  ForeignMap map;
  map.lines = lines_of_meta(json);
  map.gaussians = SogReader(Meta(name, std::move(json)), files).read();
  return map;
}

std::vector<std::string> sog_lines(const std::string& name, const std::string& bytes) {
  const ReadSibling none = [](const std::string&) { return std::string(); };
  return lines_of_meta(parse_json_object(name, SogFiles(name, bytes, none).meta()));
}

}  // namespace odosplat
