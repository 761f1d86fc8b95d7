// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <set>

#include "odosplat/synth/scene/catalogue.hpp"
#include "odosplat/synth/scene/scene_description.hpp"
#include "odosplat/synth/scene/yaml_reader.hpp"

namespace odosplat {
namespace {

constexpr double far = 1000.0;  // [m] limit for all coordinates of a scene

std::vector<float> numbers_of(const YamlPart& part, std::size_t count, double low, double high) {
  std::vector<float> values = part.numbers(low, high);
  if (values.size() != count) part.fail("needs " + std::to_string(count) + (count == 1 ? " number" : " numbers"));
  return values;
}

Eigen::Vector3f triple_of(const YamlPart& part, double low, double high) {
  const std::vector<float> v = numbers_of(part, 3, low, high);
  return {v[0], v[1], v[2]};
}

/// The parameters of `rows`, from `part` or by default.
void read_parameters(const YamlPart& part, const std::vector<ParameterRow>& rows, Numbers& numbers) {
  for (const ParameterRow& row : rows) {
    if (!part.has(row.name)) {
      if (row.needed) part.at(row.name);
      numbers[row.name] = row.fallback;
    } else if (row.fallback.empty()) {
      const YamlPart list = part.at(row.name);
      numbers[row.name] = list.numbers(row.low, row.high);
      if (numbers[row.name].size() % 3 != 0 || numbers[row.name].empty())
        list.fail("needs a multiple of three numbers");
    } else {
      numbers[row.name] = numbers_of(part.at(row.name), row.fallback.size(), row.low, row.high);
    }
  }
}

void add_names(std::vector<std::string>& known, const std::vector<ParameterRow>& rows) {
  for (const ParameterRow& row : rows) known.push_back(row.name);
}

template <class Row>
Row row_of(const YamlPart& word, const std::vector<Row>& rows) {
  const std::string name = word.text();
  std::string names;
  for (const Row& row : rows) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + row.name;
  }
  word.fail("must be one of " + names);
}

class SceneReader {
 public:
  SceneReader(const std::string& name, const std::string& text) : root_(name, text) { scene_.name = name; }

  SceneDescription read() {
    root_.refuse_other_keys({"size", "floor", "ceiling", "skirting", "walls", "sky", "exposure", "materials",
                             "furniture", "lidar", "walks"});
    scene_.size = triple_of(root_.at("size"), 0.1, far);
    read_materials();
    scene_.floor = material_of(root_.at("floor"));
    scene_.ceiling = material_of(root_.at("ceiling"));
    if (root_.has("skirting")) scene_.skirting = material_of(root_.at("skirting"));
    read_walls();
    if (root_.has("sky")) scene_.sky_radiance = static_cast<float>(root_.at("sky").number(0.0, 1000.0));
    if (root_.has("exposure")) scene_.exposure = static_cast<float>(root_.at("exposure").number(0.001, 1000.0));
    if (root_.has("furniture")) {
      for (const YamlPart& item : root_.at("furniture").items()) read_furniture(item);
    }
    if (root_.has("lidar")) {
      for (const YamlPart& item : root_.at("lidar").items()) {
        scene_.scan_places.push_back(triple_of(item, -far, far).cast<double>());
      }
    }
    if (root_.has("walks")) {
      for (const std::string& name : root_.at("walks").keys()) read_walk(name, root_.at("walks").at(name));
    }
    return scene_;
  }

 private:
  void read_materials() {
    for (const std::string& name : root_.at("materials").keys()) {
      const YamlPart part = root_.at("materials").at(name);
      MaterialDescription material;
      material.name = name;
      const PatternRow pattern =
          part.has("pattern") ? row_of(part.at("pattern"), material_patterns()) : material_patterns()[0];
      material.pattern = pattern.name;
      std::vector<std::string> known{"pattern"};
      add_names(known, material_parameters());
      add_names(known, pattern.parameters);
      part.refuse_other_keys(known);
      read_parameters(part, material_parameters(), material.numbers);
      read_parameters(part, pattern.parameters, material.numbers);
      scene_.materials.push_back(material);
      names_.insert(name);
    }
  }

  std::string material_of(const YamlPart& word) const {
    std::string name = word.text();
    if (names_.count(name) == 0) word.fail("there is no material " + name);
    return name;
  }

  void read_walls() {
    static const std::array<std::string, 4> names{"west", "east", "south", "north"};
    const YamlPart walls = root_.at("walls");
    walls.refuse_other_keys({names.begin(), names.end()});
    for (std::size_t i = 0; i < names.size(); ++i) {
      const YamlPart part = walls.at(names[i]);
      part.refuse_other_keys({"material", "windows"});
      WallDescription& wall = scene_.walls[i];
      wall.material = material_of(part.at("material"));
      if (!part.has("windows")) continue;
      const float length = i < 2 ? scene_.size.y() : scene_.size.x();
      float from = 0.0F;
      for (const YamlPart& item : part.at("windows").items()) {
        wall.windows.push_back(read_window(item, length, from));
        from = wall.windows.back().at + wall.windows.back().width;
      }
    }
  }

  WindowDescription read_window(const YamlPart& part, float length, float from) const {
    part.refuse_other_keys({"at", "width", "sill", "height", "depth", "daylight", "frame"});
    WindowDescription w;
    w.at = static_cast<float>(part.at("at").number(0.01, far));
    w.width = static_cast<float>(part.at("width").number(0.1, far));
    w.sill = static_cast<float>(part.at("sill").number(0.01, far));
    w.height = static_cast<float>(part.at("height").number(0.1, far));
    if (part.has("depth")) w.depth = static_cast<float>(part.at("depth").number(0.08, 2.0));
    w.daylight = triple_of(part.at("daylight"), 0.0, 10000.0);
    w.frame = material_of(part.at("frame"));
    if (w.at <= from) part.at("at").fail("windows of a wall must go from left to right and not touch");
    if (w.at + w.width >= length) part.at("width").fail("the window ends outside its wall");
    if (w.sill + w.height >= scene_.size.z()) part.at("height").fail("the window ends above its wall");
    return w;
  }

  void read_furniture(const YamlPart& part) {
    FurnitureDescription thing;
    const FurnitureRow row = row_of(part.at("kind"), furniture_kinds());
    thing.kind = row.name;
    std::vector<std::string> known{"kind", "at", "turn", "materials"};
    add_names(known, row.parameters);
    part.refuse_other_keys(known);
    thing.at = triple_of(part.at("at"), -far, far);
    if (part.has("turn")) thing.turn_deg = static_cast<float>(part.at("turn").number(-360.0, 360.0));
    read_parameters(part, row.parameters, thing.numbers);
    if (!row.materials.empty()) {
      const YamlPart materials = part.at("materials");
      materials.refuse_other_keys(row.materials);
      for (const std::string& place : row.materials) thing.materials[place] = material_of(materials.at(place));
    }
    scene_.furniture.push_back(thing);
  }

  void read_walk(const std::string& name, const YamlPart& part) {
    part.refuse_other_keys({"frames", "fps", "length_m", "loop", "turn_m", "tremor_m", "tremor_deg", "max_speed",
                            "max_turn_deg", "seed", "sensor", "waypoints"});
    WalkDescription walk;
    walk.name = name;
    WalkOptions& o = walk.options;
    o.frames = part.at("frames").integer(2, 1000000);
    o.length_m = part.at("length_m").number(0.001, 1e6);
    auto read = [&](const char* key, double& value, double low, double high) {
      if (part.has(key)) value = part.at(key).number(low, high);
    };
    read("fps", o.fps, 0.1, 1000.0);
    read("turn_m", o.turn_m, 0.001, 100.0);
    read("tremor_m", o.tremor_m, 0.0, 0.05);
    read("tremor_deg", o.tremor_deg, 0.0, 5.0);
    read("max_speed", o.max_speed, 0.001, 100.0);
    read("max_turn_deg", o.max_turn_deg, 0.001, 180.0);
    if (part.has("loop")) o.loop = part.at("loop").boolean();
    if (part.has("seed")) o.seed = static_cast<std::uint64_t>(part.at("seed").integer(0, 1000000));
    if (part.has("sensor")) {
      const YamlPart sensor = part.at("sensor");
      sensor.refuse_other_keys({"noise", "exposure_swing", "shutter_ms", "readout_ms"});
      auto say = [&](const char* key, double& value, double high) {
        if (sensor.has(key)) value = sensor.at(key).number(0.0, high);
      };
      say("noise", walk.sensor.noise, 0.5);
      say("exposure_swing", walk.sensor.exposure_swing, 0.9);
      say("shutter_ms", walk.sensor.shutter_ms, 1000.0);
      say("readout_ms", walk.sensor.readout_ms, 1000.0);
    }
    // A waypoint is eye x, y, z and target x, y, z.
    for (const YamlPart& item : part.at("waypoints").items()) {
      const std::vector<float> v = numbers_of(item, 6, -far, far);
      Waypoint w;
      w.eye = Eigen::Vector3f(v[0], v[1], v[2]).cast<double>();
      w.target = Eigen::Vector3f(v[3], v[4], v[5]).cast<double>();
      if ((w.target - w.eye).norm() < 0.2) item.fail("the target is nearer than 0.2 m to the eye");
      walk.waypoints.push_back(w);
    }
    if (walk.waypoints.size() < (o.loop ? 3U : 2U)) part.at("waypoints").fail("needs at least 2, or 3 for a loop");
    scene_.walks.push_back(walk);
  }

  YamlPart root_;
  SceneDescription scene_;
  std::set<std::string> names_;
};

}  // namespace

const WalkDescription& SceneDescription::walk(const std::string& walk_name) const {
  std::string names;
  for (const WalkDescription& w : walks) {
    if (w.name == walk_name) return w;
    names += (names.empty() ? "" : ", ") + w.name;
  }
  throw InputError(name, "has no walk " + walk_name + (names.empty() ? "" : ": there are " + names));
}

SceneDescription parse_scene(const std::string& name, const std::string& text) {
  return SceneReader(name, text).read();
}

}  // namespace odosplat
