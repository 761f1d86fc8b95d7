// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"
#include "odosplat/synth/scene/scene_description.hpp"

namespace odosplat {

/// A parameter of a pattern or a kind of furniture.
struct ParameterRow {
  std::string name;
  std::vector<float> fallback;  // default value, one number per element; empty: a list of triples of any length
  bool needed = false;          // true: must be given; fallback then only defines the number of elements
  float low = 0.0F;
  float high = 1000.0F;
};

/// Numbers that have been checked against their rows, so that every parameter is present.
class Parameters {
 public:
  explicit Parameters(const Numbers& numbers) : numbers_(&numbers) {}

  float number(const std::string& name) const { return list(name)[0]; }
  int integer(const std::string& name) const { return static_cast<int>(list(name)[0]); }
  Eigen::Vector2f pair(const std::string& name) const { return {list(name)[0], list(name)[1]}; }
  Eigen::Vector3f triple(const std::string& name) const { return {list(name)[0], list(name)[1], list(name)[2]}; }
  std::vector<Eigen::Vector3f> triples(const std::string& name) const;

 private:
  const std::vector<float>& list(const std::string& name) const { return numbers_->at(name); }

  const Numbers* numbers_;
};

/// A kind of texture.
struct PatternRow {
  std::string name;
  std::vector<ParameterRow> parameters;
  bool fit = false;  // true: one image fills the surface, whatever its size
  std::function<ColorImage(const Parameters&, int width, int height, std::uint32_t seed)> paint;  // none: no texture
};

/// Parameters that every material has in addition to those of its pattern.
const std::vector<ParameterRow>& material_parameters();
const std::vector<PatternRow>& material_patterns();

/// The parameters and materials of a piece of furniture.
struct FurnitureParts {
  Parameters parameters;
  std::map<std::string, std::vector<int>> materials;  // by place on the piece; indices of the builder's materials

  int material(const std::string& place) const { return materials.at(place)[0]; }
};

/// A kind of furniture. The builder's frame must be set before `add` is called.
struct FurnitureRow {
  std::string name;
  std::vector<ParameterRow> parameters;
  std::vector<std::string> materials;  // places on the piece that need a material
  std::function<void(SceneBuilder&, const FurnitureParts&, Random&)> add;
};

const std::vector<FurnitureRow>& furniture_kinds();

}  // namespace odosplat
