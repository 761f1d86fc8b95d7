// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <limits>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud/cloud_source.hpp"
#include "odosplat/io/cloud/cloud_text_layout.hpp"
#include "odosplat/io/text/text_rows.hpp"

namespace odosplat {
namespace {

class TextSource : public CloudSource {
 public:
  explicit TextSource(CloudInput input) : input_(std::move(input)), lines_(input_.name, *input_.in) {
    layout_ = find_text_layout(input_.name, *input_.in);
    input_.in->clear();
    input_.in->seekg(0);
    for (std::size_t i = 0; i < layout_.lines_before; ++i) lines_.next(line_);
  }

  bool next(CloudRows& rows) override {
    rows.clear();
    while (rows.points.size() < batch_rows && lines_.next(line_)) {
      if (is_comment(line_)) continue;
      split_words(line_, layout_.separator, words_);
      if (words_.size() != layout_.columns) {
        lines_.fail("has " + std::to_string(words_.size()) + " values, must have " + std::to_string(layout_.columns));
      }
      rows.points.push_back(triple<double>(layout_.point));
      if (layout_.color) rows.colors.push_back(color());
      if (layout_.normal) rows.normals.push_back(triple<float>(*layout_.normal));
    }
    held_ += rows.points.size();
    if (rows.points.empty() && layout_.count && held_ < *layout_.count) {
      throw InputError(input_.name, "its first line promises " + std::to_string(*layout_.count) +
                                        " points, the file holds " + std::to_string(held_));
    }
    return !rows.points.empty();
  }

  std::string left_over() override {
    if (!layout_.count || held_ <= *layout_.count) return {};
    return "its first line promises " + std::to_string(*layout_.count) + " points, the file holds " +
           std::to_string(held_) + ", and all are read";
  }

  std::optional<ColorRange> color_range() const override {
    if (!layout_.color) return std::nullopt;
    return ColorRange{1.0F, layout_.has_names ? 65535.0F : 255.0F};
  }

 private:
  template <typename T>
  Eigen::Matrix<T, 3, 1> triple(const TextLayout::Triple& columns) const {
    Eigen::Matrix<T, 3, 1> values;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view word = words_[columns[i]];
      const std::optional<double> value = number_of(word);
      if (!value) lines_.fail("`" + shown(word) + "` is not a number");
      values[static_cast<Eigen::Index>(i)] = static_cast<T>(*value);
    }
    return values;
  }

  Eigen::Vector3f color() const {
    auto value = triple<float>(*layout_.color);
    // Without column names, values above 255 need not be colours.
    const float most = layout_.has_names ? 65535.0F : 255.0F;
    if (!(value.minCoeff() >= 0.0F && value.maxCoeff() <= most)) {
      lines_.fail(std::string("its colour is not in ") + (layout_.has_names ? "0..65535, " : "") + "0..255 or 0..1");
    }
    return value;
  }

  CloudInput input_;
  LineReader lines_;
  TextLayout layout_;
  std::uint64_t held_ = 0;  // rows so far
  std::string line_;
  std::vector<std::string_view> words_;
};

}  // namespace

std::unique_ptr<CloudSource> open_text_source(CloudInput input) {
  return std::make_unique<TextSource>(std::move(input));
}

}  // namespace odosplat
