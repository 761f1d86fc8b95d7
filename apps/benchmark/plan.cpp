// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/plan.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "apps/benchmark/method_recipes.hpp"
#include "apps/benchmark/protocol.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

std::string replaced(std::string text, const std::map<std::string, std::string>& values) {
  for (const auto& [key, value] : values) {
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + value.size())) {
      text.replace(at, key.size(), value);
    }
  }
  return text;
}

/// Builds a plan. Every job is added once, after the jobs it needs.
class Planner {
 public:
  Planner(const BenchmarkOptions& options, const Suite& suite) : options_(options), suite_(suite) {
    out_ = fs::absolute(options.out).lexically_normal().string();
    if (out_.size() > 1 && out_.back() == '/') out_.pop_back();
    plan_.options = options;
    plan_.suite = suite.name;
    plan_.stand_in = suite.stand_in();
    tested_ = chosen_sequences(options, suite);
    plan_.methods = chosen_methods(options, suite);
    plan_.mapping = mapping_in_words(options, plan_.stand_in);
    plan_.quick = quick_in_words(options);
  }

  Plan make() {
    for (const SuiteSequence* s : tested_) plan_.sequences.push_back(sequence(*s));
    for (PlannedSequence& s : plan_.sequences) add_check(s);
    for (PlannedSequence& s : plan_.sequences) {
      for (const std::string& method : plan_.methods) {
        for (int run = 1; run <= options_.runs; ++run) add_run(s, method, run);
      }
      find_files(s);
    }
    return std::move(plan_);
  }

 private:
  bool split() const { return options_.mapping == "split"; }

  void add_job(Job job) {
    if (std::none_of(plan_.jobs.begin(), plan_.jobs.end(), [&](const Job& j) { return j.id == job.id; })) {
      plan_.jobs.push_back(std::move(job));
    }
  }

  /// Plans a sequence and, for a stand-in, the job that renders it.
  PlannedSequence sequence(const SuiteSequence& s) {
    const SuiteScene& scene = suite_.scene(s.scene);
    PlannedSequence planned;
    planned.name = s.name;
    planned.scene = s.scene;
    planned.words = scene.words;
    planned.stand_in = !scene.stand_in.empty();
    if (planned.stand_in) {
      planned.path = cache_folder(options_) + "/" + fs::path(scene.stand_in).stem().string() + "-" + s.walk + "-" +
                     options_.size + "-seed" + std::to_string(options_.seed) +
                     (options_.quick ? "-first" + std::to_string(quick_frames) : "");
      planned.job = "sequence/" + s.name;
      Job job;
      job.id = planned.job;
      job.command = {"odosplat", "synthesize", "--scene",     description(scene), "--walk",
                     s.walk,     "--size",     options_.size, "--seed",           std::to_string(options_.seed),
                     "--out",    planned.path};
      if (options_.quick) append(job.command, {"--frames", std::to_string(quick_frames)});
      job.outputs = {planned.path + "/groundtruth.txt", planned.path + "/rgb.txt"};
      job.work = 0.1 * frames();
      add_job(job);
    } else {
      planned.path = fs::absolute(existing_path(suite_.folder, s.paths, "sequence " + s.name)).string();
      if (options_.quick) planned.frames = "0:" + std::to_string(quick_frames);
      if (split() && of_scene(s.scene).size() == 1) {
        const std::size_t half = Sequence::open(planned.path).size() / 2;
        const std::size_t end = options_.quick ? half + quick_frames : 2 * half + 1;
        planned.frames = std::to_string(half) + ":" + std::to_string(end);
      }
    }
    planned.map = split() ? s.scene + (fold(s) == 0 ? "_b" : "_a") : s.scene;
    return planned;
  }

  std::string description(const SuiteScene& scene) const {
    const fs::path file = fs::path(suite_.folder) / scene.stand_in;
    return fs::is_regular_file(file) ? fs::absolute(file).string() : scene.stand_in;
  }

  double frames() const { return options_.quick ? quick_frames : 1800.0; }

  std::vector<const SuiteSequence*> of_scene(const std::string& scene) const {
    std::vector<const SuiteSequence*> found;
    for (const SuiteSequence& s : suite_.sequences) {
      if (s.scene == scene) found.push_back(&s);
    }
    return found;
  }

  /// Half of a split that the sequence belongs to: 0 and 1 alternate over the sequences of a scene.
  std::size_t fold(const SuiteSequence& s) const {
    const auto all = of_scene(s.scene);
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), &s) - all.begin()) % 2;
  }

  /// Sequences that a map is made of.
  struct Sources {
    Words paths;
    Words jobs;
    std::string frames;
  };

  Sources sources(const PlannedSequence& tested) {
    Sources sources;
    const SuiteSequence& own = *std::find_if(suite_.sequences.begin(), suite_.sequences.end(),
                                             [&](const SuiteSequence& s) { return s.name == tested.name; });
    const auto all = of_scene(tested.scene);
    for (const SuiteSequence* s : all) {
      const bool taken = split() ? all.size() == 1 || fold(*s) != fold(own)
                                 : std::find(tested_.begin(), tested_.end(), s) != tested_.end();
      if (!taken) continue;
      const PlannedSequence planned = sequence(*s);
      sources.paths.push_back(planned.path);
      if (!planned.job.empty()) sources.jobs.push_back(planned.job);
      sources.frames = planned.frames;
    }
    if (split() && all.size() == 1) {
      const std::size_t half = Sequence::open(tested.path).size() / 2;
      sources.frames = (options_.quick && half > quick_frames ? std::to_string(half - quick_frames) : "0") + ":" +
                       std::to_string(half);
    }
    return sources;
  }

  /// File of the cloud that the sequence's map is made of, and the job that makes it.
  std::pair<std::string, std::string> cloud(const PlannedSequence& tested) {
    const SuiteScene& scene = suite_.scene(tested.scene);
    const bool shared = !scene.stand_in.empty() || !scene.cloud.empty();  // one cloud for both maps of a split
    const std::string name = shared ? tested.scene : tested.map;
    Job job;
    job.id = "cloud/" + name;
    job.outputs = {out_ + "/clouds/" + name + ".ply"};
    job.work = 10.0;
    if (!scene.stand_in.empty()) {
      job.command = {"odosplat", "synthesize",  "--scene", description(scene), "--seed", std::to_string(options_.seed),
                     "--cloud",  job.outputs[0]};
    } else if (!scene.cloud.empty()) {
      const std::string file = existing_path(suite_.folder, scene.cloud, "the cloud of scene " + scene.name);
      job.command = {
          "odosplat", "cloud",       "--from", fs::absolute(file).string(), "--voxel", number_text(scene.voxel),
          "--out",    job.outputs[0]};
    } else {
      const Sources made_of = sources(tested);
      job.command = {"odosplat", "cloud"};
      append(job.command, made_of.paths);
      append(job.command, {"--every", std::to_string(mapping_step), "--voxel", number_text(scene.voxel), "--noise",
                           number_text(scene.noise), "--out", job.outputs[0]});
      if (!made_of.frames.empty()) append(job.command, {"--frames", made_of.frames});
      job.needs = made_of.jobs;
    }
    add_job(job);
    return {job.outputs[0], job.id};
  }

  /// File of the map that the sequence is tested in, and the job that makes it.
  std::pair<std::string, std::string> map(const PlannedSequence& tested, const std::string& preset) {
    PlannedMap planned;
    planned.name = tested.map;
    planned.preset = preset;
    const std::string stem = tested.map + (preset == "default" ? "" : "_" + preset);
    planned.file = out_ + "/maps/" + stem + ".ply";
    planned.report = out_ + "/maps/" + stem + ".json";
    planned.job = "map/" + stem;
    const auto known =
        std::find_if(plan_.maps.begin(), plan_.maps.end(), [&](const PlannedMap& m) { return m.job == planned.job; });
    if (known != plan_.maps.end()) return {known->file, known->job};
    const auto [cloud_file, cloud_job] = cloud(tested);
    const Sources made_of = sources(tested);
    Job job;
    job.id = planned.job;
    job.command = {"odosplat", "train"};
    append(job.command, made_of.paths);
    append(job.command, {"--cloud", cloud_file, "--every", std::to_string(mapping_step), "--resume", "--out",
                         planned.file, "--report", planned.report});
    if (!made_of.frames.empty()) append(job.command, {"--frames", made_of.frames});
    int iterations = options_.quick ? quick_iterations : 0;
    if (preset == "paper") {
      append(job.command, {"--preset", "paper", "--budget", std::to_string(paper_budget)});
      if (!options_.quick) iterations = paper_iterations;
    }
    if (iterations > 0) append(job.command, {"--iterations", std::to_string(iterations)});
    job.needs = made_of.jobs;
    job.needs.push_back(cloud_job);
    job.outputs = {planned.file, planned.report};
    job.work = options_.quick ? 60.0 : 200.0;
    add_job(job);
    plan_.maps.push_back(planned);
    return {planned.file, planned.job};
  }

  /// Sets the files of the sequence's own map and cloud if the plan has jobs that make them.
  void find_files(PlannedSequence& s) const {
    for (const Job& job : plan_.jobs) {
      if (job.id == "map/" + s.map) s.map_file = job.outputs[0];
      if (job.id == "cloud/" + s.map || job.id == "cloud/" + s.scene) s.cloud_file = job.outputs[0];
    }
  }

  void add_check(PlannedSequence& s) {
    Job job;
    job.id = "check/" + s.name;
    s.check_job = job.id;
    s.check_file = out_ + "/checks/" + s.name + ".json";
    job.command = {"odosplat", "check", s.path, "--keep-going", "--json", s.check_file};
    job.outputs = {s.check_file};
    if (!s.job.empty()) job.needs = {s.job};
    job.work = 5.0;
    add_job(job);
  }

  void add_run(const PlannedSequence& s, const std::string& method, int run) {
    PlannedRun planned;
    planned.sequence = s.name;
    planned.method = method;
    planned.run = run;
    planned.seed = options_.seed + static_cast<std::uint64_t>(run) - 1;
    planned.folder = out_ + "/runs/" + s.name + "/" + method + "/" + std::to_string(run);
    planned.job = "track/" + s.name + "/" + method + "/" + std::to_string(run);
    Job job;
    job.id = planned.job;
    if (!s.job.empty()) job.needs.push_back(s.job);
    if (const MethodRecipe* own = method_recipe(method)) {
      job.command = {"odosplat", "track", s.path, "--out", planned.folder, "--seed", std::to_string(planned.seed)};
      append(job.command, own->flags);
      if (!s.frames.empty()) append(job.command, {"--frames", s.frames});
      if (method == "rgbd" && suite_.depth_noise != "none") {
        append(job.command, {"--depth-noise", suite_.depth_noise});
      }
      if (own->map || own->paper_map) {
        const auto [file, map_job] = map(s, own->paper_map ? "paper" : "default");
        append(job.command, {"--map", file});
        job.needs.push_back(map_job);
      }
      if (own->cloud) {
        const auto [file, cloud_job] = cloud(s);
        append(job.command, {"--cloud", file});
        job.needs.push_back(cloud_job);
      }
    } else {
      add_own_command(*own_method(suite_, method), s, planned, job);
    }
    job.outputs = {planned.folder + "/trajectory.txt"};
    job.reports = {planned.folder + "/report.json", planned.folder + "/trajectory_live.txt"};
    job.work = 0.008 * frames();
    add_job(job);
    plan_.runs.push_back(planned);
  }

  void add_own_command(const SuiteMethod& method, const PlannedSequence& s, const PlannedRun& planned, Job& job) {
    std::map<std::string, std::string> values{
        {"{sequence}", s.path}, {"{out}", planned.folder}, {"{seed}", std::to_string(planned.seed)}};
    const auto wants = [&](const char* key) {
      return std::any_of(method.command.begin(), method.command.end(),
                         [&](const std::string& word) { return word.find(key) != std::string::npos; });
    };
    const auto made = [&](const char* key, const std::pair<std::string, std::string>& file_and_job) {
      values[key] = file_and_job.first;
      job.needs.push_back(file_and_job.second);
    };
    if (wants("{cloud}")) made("{cloud}", cloud(s));
    if (wants("{map}")) made("{map}", map(s, "default"));
    if (wants("{paper_map}")) made("{paper_map}", map(s, "paper"));
    for (const std::string& word : method.command) job.command.push_back(replaced(word, values));
    // A program with a relative path is looked up beside the suite's file.
    const fs::path program = fs::path(suite_.folder) / job.command[0];
    if (job.command[0].find('/') != std::string::npos && fs::exists(program)) {
      job.command[0] = fs::absolute(program).lexically_normal().string();
    }
  }

  const BenchmarkOptions& options_;
  const Suite& suite_;
  std::string out_;
  std::vector<const SuiteSequence*> tested_;
  Plan plan_;
};

}  // namespace

Plan make_plan(const BenchmarkOptions& options) {
  options.check();
  return Planner(options, read_suite(options.suite, options.root)).make();
}

}  // namespace odosplat::apps
