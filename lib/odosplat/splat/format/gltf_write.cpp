// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/splat/format/gltf.hpp"
#include "odosplat/splat/format/gltf_document.hpp"
#include "odosplat/splat/format/quantized.hpp"
#include "odosplat/splat/format/turned.hpp"

namespace odosplat {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The binary part of a file and the JSON that describes it: an accessor an attribute.
class AttributeWriter {
 public:
  explicit AttributeWriter(std::size_t count) : count_(count) {}

  /// Appends values of `width` floats a Gaussian that value(i, to) gives.
  template <typename Value>
  void add(const std::string& attribute, std::size_t width, Value value) {
    begin(attribute, gltf::component_float, width);
    std::vector<float> row(width);
    for (std::size_t i = 0; i < count_; ++i) {
      value(i, row.data());
      for (const float v : row) append_little(bytes, v);
    }
    end();
  }

  /// Red, green, blue and opacity in bytes, as COLOR_0.
  template <typename Value>
  void add_color(Value value) {
    begin("COLOR_0", gltf::component_unsigned_byte, 4);
    accessors.back()["normalized"] = true;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t c = 0; c < 4; ++c) bytes.push_back(static_cast<char>(rounded_byte(255.0F * value(i, c))));
    }
    end();
  }

  std::string bytes;
  OrderedJson views = OrderedJson::array();
  OrderedJson accessors = OrderedJson::array();
  OrderedJson attributes = OrderedJson::object();

 private:
  void begin(const std::string& attribute, int component, std::size_t width) {
    attributes[attribute] = accessors.size();
    accessors.push_back({{"bufferView", views.size()},
                         {"componentType", component},
                         {"count", count_},
                         {"type", width == 1 ? "SCALAR" : "VEC" + std::to_string(width)}});
    begin_ = bytes.size();
  }
  void end() {
    views.push_back({{"buffer", 0},
                     {"byteOffset", begin_},
                     {"byteLength", bytes.size() - begin_},
                     {"target", gltf::target_vertices}});
  }

  std::size_t count_;
  std::size_t begin_ = 0;
};

/// The least and the largest coordinates, which the format demands for positions.
void add_bounds(OrderedJson& accessor, const std::vector<float>& positions) {
  OrderedJson least = OrderedJson::array();
  OrderedJson most = OrderedJson::array();
  for (std::size_t a = 0; a < 3; ++a) {
    float low = positions[a];
    float high = positions[a];
    for (std::size_t at = a; at < positions.size(); at += 3) {
      low = std::min(low, positions[at]);
      high = std::max(high, positions[at]);
    }
    least.push_back(low);
    most.push_back(high);
  }
  accessor["min"] = least;
  accessor["max"] = most;
}

AttributeWriter written_attributes(const Gaussians& g) {
  const auto k = static_cast<std::size_t>(g.coefficients());
  AttributeWriter to(g.size());
  to.bytes.reserve(g.size() * (4 * (11 + 3 * k) + 4));
  to.add("POSITION", 3, [&](std::size_t i, float* row) { std::copy_n(&g.positions[3 * i], 3, row); });
  add_bounds(to.accessors.back(), g.positions);
  to.add_color([&](std::size_t i, std::size_t c) {
    return c < 3 ? 0.5F + sh_constant * g.sh[3 * k * i + c] : opacity_of_logit(g.opacity_logits[i]);
  });
  to.add(gltf::rotation, 4, [&](std::size_t i, float* row) {
    Eigen::Vector4f q(g.rotations[4 * i + 1], g.rotations[4 * i + 2], g.rotations[4 * i + 3], g.rotations[4 * i]);
    q.stableNormalize();
    std::copy_n(q.data(), 4, row);
  });
  to.add(gltf::scale, 3, [&](std::size_t i, float* row) {
    for (std::size_t a = 0; a < 3; ++a) row[a] = std::exp(g.log_scales[3 * i + a]);
  });
  to.add(gltf::opacity, 1, [&](std::size_t i, float* row) { row[0] = opacity_of_logit(g.opacity_logits[i]); });
  for (std::size_t j = 0; j < k; ++j) {
    to.add(gltf::harmonic_attribute(j), 3,
           [&](std::size_t i, float* row) { std::copy_n(&g.sh[3 * (k * i + j)], 3, row); });
  }
  return to;
}

void append_chunk(std::string& file, std::string_view kind, std::string content, char filler) {
  content.resize((content.size() + 3) / 4 * 4, filler);
  append_little(file, static_cast<std::uint32_t>(content.size()));
  file += kind;
  file += content;
}

}  // namespace

std::string glb_bytes(const std::string& name, Gaussians gaussians, const std::vector<std::string>& lines) {
  turn_by_half(gaussians, Axis::z);
  AttributeWriter data = written_attributes(gaussians);
  OrderedJson mesh{{"primitives",
                    {{{"attributes", data.attributes},
                      {"mode", gltf::mode_points},
                      {"extensions",
                       {{gltf::extension,
                         {{"kernel", "ellipse"},
                          {"colorSpace", "srgb_rec709_display"},
                          {"sortingMethod", "cameraDistance"},
                          {"projection", "perspective"}}}}}}}}};
  if (!lines.empty()) mesh["extras"] = {{gltf::extras, lines}};
  const OrderedJson document{{"asset", {{"version", "2.0"}, {"generator", "odosplat"}}},
                             {"extensionsUsed", {gltf::extension}},
                             {"scene", 0},
                             {"scenes", {{{"nodes", {0}}}}},
                             {"nodes", {{{"mesh", 0}}}},
                             {"meshes", {mesh}},
                             {"accessors", data.accessors},
                             {"bufferViews", data.views},
                             {"buffers", {{{"byteLength", data.bytes.size()}}}}};
  const std::string json = document.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  const std::size_t size = gltf::binary_header + 2 * gltf::chunk_header + (json.size() + 3) / 4 * 4 + data.bytes.size();
  if (size > std::numeric_limits<std::uint32_t>::max() - 3) {
    throw InputError(name, "would be larger than 4 GiB, the limit of GLB");
  }
  std::string file(gltf::binary_magic);
  append_little(file, std::uint32_t{2});
  append_little(file, static_cast<std::uint32_t>((size + 3) / 4 * 4));
  append_chunk(file, gltf::json_chunk, json, ' ');
  append_chunk(file, gltf::binary_chunk, std::move(data.bytes), '\0');
  return file;
}

}  // namespace odosplat
