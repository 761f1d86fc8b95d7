// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>

#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud/cloud_columns.hpp"
#include "odosplat/io/cloud/cloud_source.hpp"
#include "odosplat/io/cloud/ply_body.hpp"
#include "odosplat/io/foreign_format.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

using Triple = CloudColumns::Triple;

// Names of the scalar properties in their order, which are the columns of a block.
std::vector<std::string> scalar_names(const PlyHeaderElement& element) {
  std::vector<std::string> names;
  for (const PlyHeaderProperty& p : element.properties) {
    if (!p.is_list) names.push_back(p.name);
  }
  return names;
}

ColorRange range_of(const PlyHeaderElement& element, const std::string& name) {
  const auto property = std::find_if(element.properties.begin(), element.properties.end(),
                                     [&](const PlyHeaderProperty& p) { return p.name == name; });
  const PlyColumn column = make_ply_column(property->type);
  const bool is_real =
      std::holds_alternative<std::vector<float>>(column) || std::holds_alternative<std::vector<double>>(column);
  return {is_real ? 1.0F : 255.0F, ply_size(property->type) > 1 ? 65535.0F : 255.0F};
}

template <typename Vector>
void interleave(const PlyElement& block, const Triple& columns, std::vector<Vector>& vectors) {
  using Scalar = typename Vector::Scalar;
  vectors.resize(block.count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::visit(
        [&](const auto& column) {
          for (std::size_t i = 0; i < vectors.size(); ++i) {
            vectors[i][static_cast<Eigen::Index>(axis)] = static_cast<Scalar>(column[i]);
          }
        },
        block.properties[columns[axis]].values);
  }
}

class PlySource : public CloudSource {
 public:
  explicit PlySource(CloudInput input)
      : input_(std::move(input)),
        header_(read_ply_header(input_.name, *input_.in)),
        body_(input_.name, *input_.in, header_, input_.size - static_cast<std::uint64_t>(input_.in->tellg())) {
    const auto vertex = std::find_if(header_.elements.cbegin(), header_.elements.cend(),
                                     [](const PlyHeaderElement& e) { return same_word(e.name, "vertex"); });
    if (vertex == header_.elements.cend()) throw InputError(input_.name, "has no element vertex");
    const std::vector<std::string> names = scalar_names(*vertex);
    refuse_packed_ply(input_.name, names);
    columns_ = find_cloud_columns(names);
    if (!columns_.point) {
      for (const char* axis : {"x", "y", "z"}) {
        if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return same_word(name, axis); })) {
          throw InputError(input_.name, "vertex", std::string("has no property ") + axis);
        }
      }
    }
    if (columns_.color) {
      range_ = ColorRange{0.0F, 0.0F};
      for (const std::size_t column : *columns_.color) {
        const ColorRange range = range_of(*vertex, names[column]);
        range_->low = std::max(range_->low, range.low);
        range_->high = std::max(range_->high, range.high);
      }
    }
    for (auto element = header_.elements.cbegin(); element != vertex; ++element) {
      body_.begin(*element);
      while (body_.next(batch_rows).count > 0) continue;
    }
    body_.begin(*vertex);
    behind_ = vertex + 1;
  }

  bool next(CloudRows& rows) override {
    rows.clear();
    const PlyElement block = body_.next(batch_rows);
    if (block.count == 0) return false;
    interleave(block, *columns_.point, rows.points);
    if (columns_.color) interleave(block, *columns_.color, rows.colors);
    if (columns_.normal) interleave(block, *columns_.normal, rows.normals);
    return true;
  }

  std::optional<ColorRange> color_range() const override { return range_; }
  const char* row_word() const override { return "vertex"; }

  // All points have been read; the elements after them (faces) are read to find out whether the file is complete.
  std::string left_over() override {
    try {
      for (auto element = behind_; element != header_.elements.end(); ++element) {
        body_.begin(*element);
        while (body_.next(batch_rows).count > 0) continue;
      }
      return body_.left_over();
    } catch (const InputError& error) {
      std::string fault = error.what();
      if (const std::string file = input_.name + ": "; fault.starts_with(file)) fault.erase(0, file.size());
      return "behind its points the file is damaged (" + fault + ")";
    }
  }

 private:
  CloudInput input_;
  PlyHeader header_;
  PlyBody body_;
  std::vector<PlyHeaderElement>::const_iterator behind_;
  CloudColumns columns_;
  std::optional<ColorRange> range_;
};

}  // namespace

std::unique_ptr<CloudSource> open_ply_source(CloudInput input) { return std::make_unique<PlySource>(std::move(input)); }

}  // namespace odosplat
