// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat::apps {

/// What a benchmark is run on: scenes, sequences in them, and methods that the suite defines.
///
/// A suite is a YAML file; `synthetic` and `icl` are built in (data/suites). Paths are relative to --root, or
/// without it to the file's folder. Where a list of paths is given, the first that exists is used.
///
///   suite: my_rooms
///   depth_noise: kinect            # none (default): noise added to the depth that method rgbd uses
///   scenes:
///     - name: kitchen              # sequences of one scene share a world frame
///       words: Kitchen             # name for the tables
///       cloud: scan.ply            # or left out: made from the mapping frames' depth
///       voxel: 0.03                # [m] voxel edge that the cloud is thinned to (default 0.03)
///       noise: 0.006               # [m] range noise added to a cloud made from depth (default 0)
///   sequences:
///     - {name: kitchen_1, scene: kitchen, path: seq-01}
///   methods:                       # in addition to odosplat's own
///     - name: mine
///       command: [./mine, "{sequence}", "{cloud}", "{out}"]    # also {map}, {paper_map}, {seed}
///
/// A method's command writes {out}/trajectory.txt, and optionally {out}/report.json with its times. The inputs that it
/// names ({cloud}, {map}, {paper_map}) are made before it runs.
/// A scene with `stand_in: NAME` (a description of `odosplat synthesize`) is rendered by this program: its
/// sequences have `walk` instead of `path`.
struct SuiteScene {
  std::string name;
  std::string words;
  std::string stand_in;            // description that is rendered; empty: the sequences are recorded
  std::vector<std::string> cloud;  // candidate files, the first that exists is used; none: made from depth
  double voxel = 0.03;
  double noise = 0.0;
};

struct SuiteSequence {
  std::string name;
  std::string scene;
  std::string walk;                // of a stand-in: walk that is rendered
  std::vector<std::string> paths;  // of a recording: candidate folders, the first that exists is used
};

struct SuiteMethod {
  std::string name;
  std::vector<std::string> command;
};

struct Suite {
  std::string name;
  std::string folder;  // folder that paths are relative to
  std::string depth_noise = "none";
  std::vector<SuiteScene> scenes;
  std::vector<SuiteSequence> sequences;
  std::vector<SuiteMethod> methods;

  /// InputError if there is no scene of that name.
  const SuiteScene& scene(const std::string& name) const;
  bool stand_in() const;
};

/// Reads a built-in suite by its name, otherwise a file. root: see above; if it is empty for a built-in suite of
/// recordings, the InputError says where to get the data. Every fault is an InputError naming file, line and key.
Suite read_suite(const std::string& name_or_file, const std::string& root);

/// The first of the paths (relative to folder unless absolute) that exists; InputError naming `what` and all of them if
/// none does.
std::string existing_path(const std::string& folder, const std::vector<std::string>& paths, const std::string& what);

}  // namespace odosplat::apps
