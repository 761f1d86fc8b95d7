// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/benchmark/plan.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {

namespace fs = std::filesystem;

void BenchmarkOptions::check() const {
  if (suite.empty()) throw InputError("--suite", "must be synthetic, icl or a file");
  if (out.empty()) throw InputError("--out", "is needed");
  if (runs < 1 || runs > 100) throw InputError("--runs", "must be 1 to 100, is " + std::to_string(runs));
  if (mapping != "every" && mapping != "split") throw InputError("--mapping", "must be every or split, is " + mapping);
  parse_size("--size", size);
}

std::string cache_folder(const BenchmarkOptions& options) {
  const auto set = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  fs::path folder;
  if (!options.cache.empty()) {
    folder = options.cache;
  } else if (const std::string own = set("ODOSPLAT_CACHE_DIR"); !own.empty() && own != "off") {
    folder = fs::path(own) / "stand-ins";
  } else if (const std::string xdg = set("XDG_CACHE_HOME"); !xdg.empty()) {
    folder = fs::path(xdg) / "odosplat/stand-ins";
  } else if (const std::string home = set("HOME"); !home.empty()) {
    folder = fs::path(home) / ".cache/odosplat/stand-ins";
  } else {
    throw InputError("--cache", "must name a folder for the stand-ins: HOME is not set");
  }
  return fs::absolute(folder).lexically_normal().string();
}

namespace {

/// A path may contain any bytes, JSON text only UTF-8: a path that is not UTF-8 is written as an object with its bytes.
nlohmann::ordered_json path_json(const std::string& path) {
  try {
    static_cast<void>(nlohmann::ordered_json(path).dump());
    return path;
  } catch (const nlohmann::json::exception&) {
    return {{"bytes", std::vector<unsigned char>(path.begin(), path.end())}};
  }
}

std::string path_of(const nlohmann::json& json) {
  if (json.is_string()) return json.get<std::string>();
  const auto bytes = json.at("bytes").get<std::vector<unsigned char>>();
  return {bytes.begin(), bytes.end()};
}

}  // namespace

void write_plan(const Plan& plan) {
  const BenchmarkOptions& o = plan.options;
  nlohmann::ordered_json json;
  // Absolute, because a scheduler may continue from this file in another working directory.
  const auto absolute = [](const std::string& path) {
    return path_json(path.empty() ? path : fs::absolute(path).string());
  };
  json["options"] = {{"suite", fs::is_regular_file(o.suite) ? absolute(o.suite) : path_json(o.suite)},
                     {"root", absolute(o.root)},
                     {"cache", absolute(o.cache)},
                     {"methods", o.methods},
                     {"sequences", o.sequences},
                     {"runs", o.runs},
                     {"size", o.size},
                     {"quick", o.quick},
                     {"mapping", o.mapping},
                     {"seed", o.seed}};
  json["jobs"] = nlohmann::ordered_json::array();
  for (const Job& job : plan.jobs) {
    json["jobs"].push_back({{"id", job.id},
                            {"needs", job.needs},
                            {"record", record_file(o.out, job.id)},
                            {"command", job.command},
                            {"outputs", job.outputs},
                            {"work_s", job.work}});
  }
  write_file_atomically(o.out + "/plan.json", json_text(json, 1));
}

Plan read_plan(const std::string& out) {
  const std::string file = out + "/plan.json";
  if (!fs::exists(file)) throw InputError(out, "holds no plan.json: no benchmark was begun there");
  BenchmarkOptions o;
  o.out = out;
  try {
    const auto json = nlohmann::json::parse(read_file(file)).at("options");
    o.suite = path_of(json.at("suite"));
    o.root = path_of(json.at("root"));
    o.cache = path_of(json.at("cache"));
    o.methods = json.at("methods").get<std::vector<std::string>>();
    o.sequences = json.at("sequences").get<std::vector<std::string>>();
    o.runs = json.at("runs");
    o.size = json.at("size");
    o.quick = json.at("quick");
    o.mapping = json.at("mapping");
    o.seed = json.at("seed");
  } catch (const nlohmann::json::exception& e) {
    throw InputError(file, std::string("is damaged: ") + e.what());
  }
  return make_plan(o);
}

}  // namespace odosplat::apps
