// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <array>

#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud_source.hpp"
#include "odosplat/io/ply_body.hpp"

namespace odosplat {
namespace {

using Names = std::array<const char*, 3>;

const PlyHeaderProperty* find_scalar(const PlyHeaderElement& element, const std::string& name) {
  for (const PlyHeaderProperty& p : element.properties) {
    if (p.name == name && !p.is_list) return &p;
  }
  return nullptr;
}

std::optional<Names> first_complete(const PlyHeaderElement& vertex, std::initializer_list<Names> choices) {
  for (const Names& names : choices) {
    if (std::all_of(names.begin(), names.end(), [&](const char* name) { return find_scalar(vertex, name); })) {
      return names;
    }
  }
  return std::nullopt;
}

// Unsigned integers use their range; floats say 0..1 or 0..255 by their values.
ColorRange range_of(PlyType type) {
  const PlyColumn column = make_ply_column(type);
  if (std::holds_alternative<std::vector<std::uint16_t>>(column)) return {65535.0F, 65535.0F};
  const bool is_real =
      std::holds_alternative<std::vector<float>>(column) || std::holds_alternative<std::vector<double>>(column);
  return {is_real ? 1.0F : 255.0F, 255.0F};
}

template <typename Vector>
void interleave(const PlyElement& block, const Names& names, std::vector<Vector>& vectors) {
  using Scalar = typename Vector::Scalar;
  vectors.resize(block.count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::visit(
        [&](const auto& column) {
          for (std::size_t i = 0; i < vectors.size(); ++i) {
            vectors[i][static_cast<Eigen::Index>(axis)] = static_cast<Scalar>(column[i]);
          }
        },
        *block.find(names[axis]));
  }
}

class PlySource : public CloudSource {
 public:
  explicit PlySource(CloudInput input)
      : input_(std::move(input)),
        header_(read_ply_header(input_.name, *input_.in)),
        body_(input_.name, *input_.in, header_, input_.size - static_cast<std::uint64_t>(input_.in->tellg())) {
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                     [](const PlyHeaderElement& e) { return e.name == "vertex"; });
    if (vertex == header_.elements.end()) throw InputError(input_.name, "has no element vertex");
    for (const char* axis : points_) {
      if (!find_scalar(*vertex, axis)) throw InputError(input_.name, "vertex", std::string("has no property ") + axis);
    }
    colors_ = first_complete(*vertex, {Names{"red", "green", "blue"},
                                       Names{"diffuse_red", "diffuse_green", "diffuse_blue"}, Names{"r", "g", "b"}});
    normals_ = first_complete(*vertex, {Names{"nx", "ny", "nz"}});
    if (colors_) {
      range_ = ColorRange{0.0F, 0.0F};
      for (const char* name : *colors_) {
        const ColorRange range = range_of(find_scalar(*vertex, name)->type);
        range_->low = std::max(range_->low, range.low);
        range_->high = std::max(range_->high, range.high);
      }
    }
    for (auto element = header_.elements.begin(); element != vertex; ++element) {
      body_.begin(*element);
      while (body_.next(batch_rows).count > 0) continue;
    }
    body_.begin(*vertex);
  }

  bool next(CloudRows& rows) override {
    rows.clear();
    const PlyElement block = body_.next(batch_rows);
    if (block.count == 0) return false;
    interleave(block, points_, rows.points);
    if (colors_) interleave(block, *colors_, rows.colors);
    if (normals_) interleave(block, *normals_, rows.normals);
    return true;
  }

  std::optional<ColorRange> color_range() const override { return range_; }
  const char* row_word() const override { return "vertex"; }

 private:
  CloudInput input_;
  PlyHeader header_;
  PlyBody body_;
  Names points_{"x", "y", "z"};
  std::optional<Names> colors_;
  std::optional<Names> normals_;
  std::optional<ColorRange> range_;
};

}  // namespace

std::unique_ptr<CloudSource> open_ply_source(CloudInput input) { return std::make_unique<PlySource>(std::move(input)); }

}  // namespace odosplat
