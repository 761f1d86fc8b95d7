// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/suite.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "apps/benchmark/foreign_text.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {

/// data/suites by name of the file; odosplat_embed() in CMakeLists.txt writes it.
const std::map<std::string_view, std::string_view>& suite_texts();

namespace {

namespace fs = std::filesystem;

/// A map of the file, whose keys must be among those it may have.
class Table {
 public:
  Table(const std::string& file, const YAML::Node& node, const std::string& what, const std::vector<std::string>& known)
      : file_(file), node_(node), what_(what) {
    if (!node.IsMap()) fail(node, what + " must be a map of keys and values");
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      if (std::find(known.begin(), known.end(), key) == known.end()) fail(entry.first, what + " has no key " + key);
    }
  }

  std::string word(const char* key, const std::string& missing) const {
    return node_[key] ? as<std::string>(node_[key], key) : missing;
  }
  std::string word(const char* key) const {
    if (!node_[key]) fail(node_, what_ + " lacks " + key);
    return word(key, "");
  }
  double number(const char* key, double missing) const {
    if (!node_[key]) return missing;
    const double value = as<double>(node_[key], key);
    if (!(value >= 0.0 && value < 1e6)) fail(node_[key], std::string(key) + " must not be negative");
    return value;
  }
  /// One word or a list of them; nothing if the key is missing.
  std::vector<std::string> words(const char* key) const {
    if (!node_[key]) return {};
    if (node_[key].IsScalar()) return {word(key)};
    return as<std::vector<std::string>>(node_[key], key);
  }
  /// The maps listed under a key.
  std::vector<YAML::Node> list(const char* key) const {
    if (!node_[key]) return {};
    if (!node_[key].IsSequence()) fail(node_[key], std::string(key) + " must be a list");
    return {node_[key].begin(), node_[key].end()};
  }
  [[noreturn]] void fail(const YAML::Node& at, const std::string& fault) const {
    throw InputError(file_ + ":" + std::to_string(at.Mark().line + 1), fault);
  }
  const YAML::Node& node() const { return node_; }

 private:
  template <typename Value>
  Value as(const YAML::Node& node, const char* key) const {
    try {
      return node.as<Value>();
    } catch (const YAML::Exception&) {
      fail(node, std::string(key) + " of " + what_ + " cannot be read");
    }
  }

  std::string file_;
  YAML::Node node_;
  std::string what_;
};

/// Names become parts of paths and of tables.
std::string checked_name(const Table& table) {
  const std::string name = table.word("name");
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!plain) table.fail(table.node(), "name must be of letters, digits, - and _, is " + name);
  return name;
}

template <typename Named>
void expect_unique(const Table& table, const std::vector<Named>& before, const std::string& name) {
  for (const Named& other : before) {
    if (other.name == name) table.fail(table.node(), name + " is there twice");
  }
}

Suite parse(const std::string& file, const std::string& text) {
  YAML::Node root;
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) throw InputError(file, "holds several YAML documents (`---`), must hold one");
    if (!documents.empty()) root.reset(documents.front());
  } catch (const YAML::Exception& e) {
    throw InputError(file + ":" + std::to_string(e.mark.line + 1), e.msg);
  }
  const Table top(file, root, "the suite", {"suite", "depth_noise", "scenes", "sequences", "methods"});
  Suite suite;
  suite.name = clean_text(top.word("suite"));
  suite.depth_noise = top.word("depth_noise", suite.depth_noise);
  if (suite.depth_noise != "none" && suite.depth_noise != "kinect") {
    top.fail(root["depth_noise"], "depth_noise must be none or kinect");
  }
  for (const YAML::Node& node : top.list("scenes")) {
    const Table table(file, node, "a scene", {"name", "words", "stand_in", "cloud", "voxel", "noise"});
    SuiteScene scene;
    scene.name = checked_name(table);
    expect_unique(table, suite.scenes, scene.name);
    scene.words = clean_text(table.word("words", scene.name));
    scene.stand_in = table.word("stand_in", "");
    scene.cloud = table.words("cloud");
    scene.voxel = table.number("voxel", scene.voxel);
    scene.noise = table.number("noise", scene.noise);
    suite.scenes.push_back(scene);
  }
  for (const YAML::Node& node : top.list("sequences")) {
    const Table table(file, node, "a sequence", {"name", "scene", "walk", "path"});
    SuiteSequence sequence;
    sequence.name = checked_name(table);
    expect_unique(table, suite.sequences, sequence.name);
    sequence.scene = table.word("scene");
    sequence.walk = table.word("walk", "");
    sequence.paths = table.words("path");
    const auto scene = std::find_if(suite.scenes.begin(), suite.scenes.end(),
                                    [&](const SuiteScene& s) { return s.name == sequence.scene; });
    if (scene == suite.scenes.end()) table.fail(node, sequence.name + ": there is no scene " + sequence.scene);
    const bool rendered = !scene->stand_in.empty();
    if (rendered == sequence.walk.empty() || rendered == !sequence.paths.empty()) {
      table.fail(node, sequence.name + (rendered ? " needs a walk and no path: its scene is a stand-in"
                                                 : " needs a path and no walk: its scene is recorded"));
    }
    suite.sequences.push_back(sequence);
  }
  for (const YAML::Node& node : top.list("methods")) {
    const Table table(file, node, "a method", {"name", "command"});
    SuiteMethod method{checked_name(table), table.words("command")};
    expect_unique(table, suite.methods, method.name);
    if (method.command.empty()) table.fail(node, "a method needs a command");
    suite.methods.push_back(method);
  }
  if (suite.sequences.empty()) top.fail(root, "the suite has no sequences");
  return suite;
}

}  // namespace

const SuiteScene& Suite::scene(const std::string& wanted) const {
  for (const SuiteScene& s : scenes) {
    if (s.name == wanted) return s;
  }
  throw InputError(name, "has no scene " + wanted);
}

bool Suite::stand_in() const {
  return std::any_of(sequences.begin(), sequences.end(),
                     [&](const SuiteSequence& s) { return !scene(s.scene).stand_in.empty(); });
}

Suite read_suite(const std::string& name_or_file, const std::string& root) {
  if (!root.empty() && !fs::is_directory(root)) throw InputError("--root", root + " is not a folder");
  const auto text = suite_texts().find(name_or_file + ".yaml");
  const bool built_in = text != suite_texts().end();
  Suite suite = built_in ? parse("suite " + name_or_file, std::string(text->second))
                         : parse(name_or_file, read_file(name_or_file));
  suite.folder = root;
  if (root.empty() && !built_in) suite.folder = fs::path(name_or_file).parent_path().string();
  if (root.empty() && built_in && !suite.stand_in()) {
    throw InputError("--root", "must name the folder of the recordings of suite " + name_or_file +
                                   ": what to download and where to put it is in data/README.md");
  }
  return suite;
}

std::string existing_path(const std::string& folder, const std::vector<std::string>& paths, const std::string& what) {
  std::string tried;
  for (const std::string& path : paths) {
    const fs::path full = folder.empty() ? fs::path(path) : fs::path(folder) / path;  // an absolute path stays
    if (fs::exists(full)) return full.lexically_normal().string();
    tried += (tried.empty() ? "" : ", ") + full.string();
  }
  throw InputError(what, "is not there: looked for " + tried);
}

}  // namespace odosplat::apps
