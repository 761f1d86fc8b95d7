// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// What a benchmark is run on: scenes, sequences in them, and methods that the suite brings along.
///
/// A suite is a YAML file; `synthetic` and `icl` are built in (data/suites). Paths are relative to --root, without it
/// to the file's folder; where a list of paths is given, the first that exists counts.
///
///   suite: my_rooms
///   depth_noise: kinect            # none (default): what method rgbd's depth gets before use
///   scenes:
///     - name: kitchen              # sequences of one scene share a world frame
///       words: Kitchen             # for the tables
///       cloud: scan.ply            # or left out: made from the mapping frames' depth
///       voxel: 0.03                # [m] the cloud is thinned to (default 0.03)
///       noise: 0.006               # [m] range noise put on a cloud made from depth (default 0)
///   sequences:
///     - {name: kitchen_1, scene: kitchen, path: seq-01}
///   methods:                       # besides odosplat's own
///     - name: mine
///       command: [./mine, "{sequence}", "{cloud}", "{out}"]    # also {map}, {paper_map}, {seed}
///
/// A method's command writes {out}/trajectory.txt, and {out}/report.json if it can say how long it took; what it needs
/// ({cloud}, {map}, {paper_map}) is made before.
/// A scene with `stand_in: NAME` (a description of `odosplat synthesize`) is rendered here: its sequences have `walk`
/// in place of `path`.
struct SuiteScene {
  std::string name;
  std::string words;
  std::string stand_in;            // description that is rendered; empty: recorded sequences
  std::vector<std::string> cloud;  // files of which the first that exists counts; none: from depth
  double voxel = 0.03;
  double noise = 0.0;
};

struct SuiteSequence {
  std::string name;
  std::string scene;
  std::string walk;                // of a stand-in
  std::vector<std::string> paths;  // of a recording, the first that exists counts
};

struct SuiteMethod {
  std::string name;
  std::vector<std::string> command;
};

struct Suite {
  std::string name;
  std::string folder;  // that paths are relative to
  std::string depth_noise = "none";
  std::vector<SuiteScene> scenes;
  std::vector<SuiteSequence> sequences;
  std::vector<SuiteMethod> methods;

  /// InputError if there is none of that name.
  const SuiteScene& scene(const std::string& name) const;
  bool stand_in() const;
};

/// A built-in suite by its name, else a file. root: see above; empty for a built-in suite of recordings is an
/// InputError that says where its data come from. Every fault is an InputError naming file, line and key.
Suite read_suite(const std::string& name_or_file, const std::string& root);

/// The first of the paths (relative to folder unless absolute) that exists; InputError naming `what` and all of them.
std::string existing_path(const std::string& folder, const std::vector<std::string>& paths, const std::string& what);

}  // namespace odosplat::apps
