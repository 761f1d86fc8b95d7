// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/similarity.hpp"
#include "odosplat/splat/broken_rows.hpp"
#include "odosplat/splat/format/gltf.hpp"
#include "odosplat/splat/format/gltf_document.hpp"
#include "odosplat/splat/format/quantized.hpp"
#include "odosplat/splat/format/spz.hpp"
#include "odosplat/splat/format/turned.hpp"
#include "odosplat/splat/kept_gaussians.hpp"

namespace odosplat {
namespace {

using Json = nlohmann::json;
using gltf::Document;

constexpr std::array<const char*, 2> spz_extensions{"KHR_gaussian_splatting_compression_spz_2",
                                                    "KHR_gaussian_splatting_compression_spz"};
constexpr double most_shear = 1e-3;  // of a node's matrix, relative to its scale
constexpr int most_node_depth = 256;
constexpr std::size_t most_repeats =
    64;  // Gaussians take up to this many times the file's bytes: nodes may repeat them

/// The member of an object; nullptr if the value is no object or has none.
const Json* member(const Json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

const Json* splat_extension(const Json& primitive) {
  const Json* extensions = member(primitive, "extensions");
  return extensions == nullptr ? nullptr : member(*extensions, gltf::extension);
}

/// The buffer view of an SPZ file; nullptr if the primitive has its values in accessors.
const Json* spz_view(const Json& extension) {
  const Json* extensions = member(extension, "extensions");
  if (extensions == nullptr) return nullptr;
  for (const char* name : spz_extensions) {
    if (const Json* found = member(*extensions, name)) return member(*found, "bufferView");
  }
  return nullptr;
}

/// Numbers of an array of a node, as doubles.
std::vector<double> numbers(const Document& document, const Json& values, std::size_t count, const std::string& place) {
  std::vector<double> list;
  if (values.is_array()) {
    for (const Json& value : values) {
      if (value.is_number() && std::isfinite(value.get<double>())) list.push_back(value.get<double>());
    }
  }
  if (list.size() != count || values.size() != count) {
    document.fail(place, "must be " + std::to_string(count) + " numbers");
  }
  return list;
}

/// What a node does to its content: its matrix, or translation, rotation and scale.
Eigen::Matrix4d node_matrix(const Document& document, const Json& node, const std::string& place) {
  if (const Json* matrix = member(node, "matrix")) {
    const std::vector<double> m = numbers(document, *matrix, 16, place + ".matrix");
    return Eigen::Map<const Eigen::Matrix4d>(m.data());  // column after column, as the format has it
  }
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  if (const Json* translation = member(node, "translation")) {
    const std::vector<double> t = numbers(document, *translation, 3, place + ".translation");
    T.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  }
  if (const Json* rotation = member(node, "rotation")) {
    const std::vector<double> q = numbers(document, *rotation, 4, place + ".rotation");
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(turn.norm() > 0.5 && turn.norm() < 2.0)) document.fail(place + ".rotation", "must be of length 1");
    T.rotate(turn.normalized());
  }
  if (const Json* scale = member(node, "scale")) {
    const std::vector<double> s = numbers(document, *scale, 3, place + ".scale");
    T.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return T.matrix();
}

/// The similarity that a matrix is. Gaussians cannot be sheared or mirrored, and a scale that is not the same in all
/// directions would change the directions of their axes.
Similarity similarity_of(const Document& document, const Eigen::Matrix4d& matrix, const std::string& place) {
  const Eigen::Matrix3d part = matrix.topLeftCorner<3, 3>();
  const double determinant = part.determinant();
  if (!(determinant > 0.0)) document.fail(place, "mirrors the Gaussians, or gives them no size, which is not read");
  const double scale = std::cbrt(determinant);
  const Eigen::Matrix3d R = part / scale;
  if (!(R * R.transpose()).isIdentity(most_shear)) {
    document.fail(place, "shears the Gaussians or scales them differently along its axes, which is not read");
  }
  return {scale, SE3(Eigen::Quaterniond(R).normalized(), matrix.topRightCorner<3, 1>())};
}

int degree_of_attributes(const Json& attributes) {
  int degree = 0;
  while (degree < 3 &&
         attributes.contains(gltf::harmonic_attribute(static_cast<std::size_t>(sh_coefficients(degree))))) {
    ++degree;
  }
  return degree;
}

/// Standard deviations, or their logarithms in files of the extension's drafts.
void take_scales(const Document& document, std::vector<float> scales, Gaussians& g) {
  // A few broken values do not change the meaning of the others: those Gaussians are left out later.
  const auto below = std::count_if(scales.begin(), scales.end(), [](float s) { return s < 0.0F; });
  const bool are_logarithms = 10 * below > static_cast<std::ptrdiff_t>(scales.size());
  if (are_logarithms) {
    log_warning(document.name() + ": has sizes below 0: they are read as logarithms, which drafts of " +
                gltf::extension + " stored");
  } else {
    for (float& s : scales) s = s == 0.0F ? zero_log_scale : std::log(s);
  }
  g.log_scales = std::move(scales);
}

Gaussians gaussians_of_accessors(Document& document, const Json& primitive, const std::string& place) {
  const Json* attributes = member(primitive, "attributes");
  if (attributes == nullptr || !attributes->is_object()) document.fail(place + ".attributes", "must be an object");
  std::size_t count = 0;
  const auto values = [&](const std::string& attribute, std::size_t width) {
    const auto found = attributes->find(attribute);
    if (found == attributes->end()) document.fail(place, "has no attribute " + attribute);
    std::vector<float> list = document.accessor(*found, width, place + ".attributes." + attribute);
    if (attribute == "POSITION") count = list.size() / width;
    if (list.size() != count * width) {
      document.fail(place, attribute + " has " + std::to_string(list.size() / width) + " values, POSITION has " +
                               std::to_string(count));
    }
    return list;
  };
  Gaussians g;
  g.sh_degree = degree_of_attributes(*attributes);
  g.positions = values("POSITION", 3);
  g.rotations = values(gltf::rotation, 4);
  take_scales(document, values(gltf::scale, 3), g);
  g.opacity_logits = values(gltf::opacity, 1);
  const auto k = static_cast<std::size_t>(g.coefficients());
  g.sh.resize(3 * k * count);
  for (std::size_t j = 0; j < k; ++j) {
    const std::vector<float> colors = values(gltf::harmonic_attribute(j), 3);
    for (std::size_t i = 0; i < count; ++i) std::copy_n(&colors[3 * i], 3, &g.sh[3 * (k * i + j)]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::rotate(&g.rotations[4 * i], &g.rotations[4 * i + 3], &g.rotations[4 * i] + 4);  // w comes first
    g.opacity_logits[i] = logit_of_opacity(g.opacity_logits[i]);                         // NaN outside 0..1
  }
  return g;
}

Gaussians gaussians_of_primitive(Document& document, const Json& primitive, const std::string& place) {
  const Json& extension = *splat_extension(primitive);
  if (const Json* view = spz_view(extension)) {
    const std::string where = place + ".extensions";
    ForeignMap map = parse_spz(document.name() + ": " + where, std::string(document.view(*view, where)));
    turn_by_half(map.gaussians, Axis::z);  // to the axes of glTF
    return std::move(map.gaussians);
  }
  return gaussians_of_accessors(document, primitive, place);
}

/// Gathers the Gaussians of a scene.
class SceneReader {
 public:
  /// Without `with_gaussians`, only the lines are read, and whether nodes move the map.
  SceneReader(Document& document, bool with_gaussians) : document_(document), with_gaussians_(with_gaussians) {}

  void read() {
    const Json& json = document_.json();
    const Json* scenes = member(json, "scenes");
    if (scenes == nullptr || !scenes->is_array() || scenes->empty()) {
      const Json* meshes = member(json, "meshes");
      const std::size_t count = meshes != nullptr && meshes->is_array() ? meshes->size() : 0;
      for (std::size_t i = 0; i < count; ++i) read_mesh(i, Eigen::Matrix4d::Identity(), "meshes");
      return;
    }
    const Json* number = member(json, "scene");
    const Json& scene = document_.element("scenes", number == nullptr ? Json(0) : *number, "scene");
    read_nodes(scene, "scenes[].nodes", "nodes", Eigen::Matrix4d::Identity(), 0);
  }

  Gaussians gaussians;
  std::vector<std::string> lines;
  bool is_moved = false;
  std::size_t lists_of_lines = 0;

 private:
  void read_nodes(const Json& parent, const std::string& place, const char* name, const Eigen::Matrix4d& T, int depth) {
    const Json* nodes = member(parent, name);
    if (nodes == nullptr) return;
    if (!nodes->is_array()) document_.fail(place, "must be a list");
    if (depth > most_node_depth) document_.fail(place, "nodes contain each other, or are nested too deeply");
    for (const Json& index : *nodes) {
      const Json& node = document_.element("nodes", index, place);
      if (++visited_ > most_nodes) document_.fail(place, "the scene has too many nodes");
      const std::string here = "nodes[" + std::to_string(index.get<std::size_t>()) + "]";
      const Eigen::Matrix4d T_node = T * node_matrix(document_, node, here);
      if (const Json* mesh = member(node, "mesh")) read_mesh(*mesh, T_node, here);
      read_nodes(node, here + ".children", "children", T_node, depth + 1);
    }
  }

  void read_mesh(const Json& index, const Eigen::Matrix4d& T, const std::string& from) {
    const Json& mesh = document_.element("meshes", index, from + ".mesh");
    const std::string here = "meshes[" + std::to_string(index.get<std::size_t>()) + "]";
    const Json* primitives = member(mesh, "primitives");
    if (primitives == nullptr || !primitives->is_array()) document_.fail(here + ".primitives", "must be a list");
    bool has_gaussians = false;
    for (std::size_t p = 0; p < primitives->size(); ++p) {
      if (splat_extension((*primitives)[p]) == nullptr) continue;  // meshes and points of other kinds
      has_gaussians = true;
      is_moved = is_moved || !T.isIdentity(0.0);
      if (!with_gaussians_) continue;
      Gaussians part =
          gaussians_of_primitive(document_, (*primitives)[p], here + ".primitives[" + std::to_string(p) + "]");
      if (!T.isIdentity(0.0)) move_gaussians(part, similarity_of(document_, T, from));
      add(part, here);
    }
    if (has_gaussians) take_lines(mesh, here);
  }

  void add(const Gaussians& part, const std::string& place) {
    const int degree = std::max(part.sh_degree, gaussians.sh_degree);
    const std::size_t width = sizeof(float) * (11 + 3 * static_cast<std::size_t>(sh_coefficients(degree)));
    if ((gaussians.size() + part.size()) * width / most_repeats > document_.stored()) {
      document_.fail(place, "the scene repeats its Gaussians too often");
    }
    append_gaussians(gaussians, part);
  }

  void take_lines(const Json& mesh, const std::string& place) {
    const Json* extras = member(mesh, "extras");
    const Json* list = extras == nullptr ? nullptr : member(*extras, gltf::extras);
    if (list == nullptr) return;
    ++lists_of_lines;
    lines = gltf_lines_of(*list, place);
  }

  std::vector<std::string> gltf_lines_of(const Json& list, const std::string& place) const {
    std::vector<std::string> found;
    for (const Json& line : list) {
      if (!line.is_string()) document_.fail(place + ".extras." + gltf::extras, "must be a list of lines");
      for (std::string& text : split_lines(line.get<std::string>())) found.push_back(std::move(text));
    }
    return found;
  }

  static constexpr int most_nodes = 100'000;
  Document& document_;
  bool with_gaussians_;
  int visited_ = 0;
};

/// Lines that hold for the map only where it was trained.
bool is_of_place(const std::string& line) { return line.starts_with("training_view ") || line.starts_with("quality_"); }

std::vector<std::string> valid_lines(const std::string& name, SceneReader& scene) {
  std::vector<std::string> lines = std::move(scene.lines);
  if (scene.lists_of_lines > 1) {
    log_warning(name + ": holds several maps of odosplat: what their headers say is left out");
    return {};
  }
  if (scene.is_moved && std::erase_if(lines, is_of_place) > 0) {
    log_warning(name + ": a node moves the map: where it was trained from and its quality are left out");
  }
  return lines;
}

}  // namespace

ForeignMap parse_gltf(const std::string& name, const std::string& bytes, const ReadSibling& read_sibling) {
  Document document(name, bytes, read_sibling);
  SceneReader scene(document, true);
  scene.read();
  Gaussians& g = scene.gaussians;
  if (g.empty()) throw InputError(name, std::string("holds no Gaussians (") + gltf::extension + ") in its scene");
  BrokenRows broken(name, g.size());
  const auto check = [&](const std::vector<float>& values, std::size_t width, const char* what) {
    for (std::size_t at = 0; at < values.size(); ++at) {
      if (!std::isfinite(values[at])) broken.add(at / width, what);
    }
  };
  check(g.positions, 3, "its position is not finite");
  check(g.log_scales, 3, "its scale is negative or not finite");
  check(g.rotations, 4, "its rotation is not finite");
  check(g.opacity_logits, 1, "its opacity is not in 0..1");
  check(g.sh, 3 * static_cast<std::size_t>(g.coefficients()), "its colour is not finite");
  broken.leave_out(g);
  turn_by_half(g, Axis::z);
  return {std::move(g), valid_lines(name, scene)};
}

std::vector<std::string> gltf_lines(const std::string& name, const std::string& bytes) {
  Document document(name, bytes, [](const std::string&) { return std::string(); });
  SceneReader scene(document, false);
  scene.read();
  return valid_lines(name, scene);
}

}  // namespace odosplat
