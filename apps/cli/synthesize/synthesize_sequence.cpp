// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/synthesize/synthesize_sequence.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "apps/command/interrupt.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"

namespace odosplat::apps {
namespace {

namespace fs = std::filesystem;

std::string file_of(const char* kind, std::size_t frame) { return formatted("%s/%06zu.png", kind, frame); }

MadeFolders claim_folder(const SyntheticSequence& sequence) {
  MadeFolders made = ensure_output_folder(sequence.folder);
  const std::string stamp = sequence.folder + "/settings.txt";
  if (fs::exists(stamp) && read_file(stamp) == sequence.what) return made;
  if (!sequence.replace && fs::exists(stamp)) {
    throw InputError(sequence.folder, "holds frames of other settings (settings.txt): take another folder");
  }
  if (!sequence.replace && fs::exists(sequence.folder + "/rgb")) {
    throw InputError(sequence.folder, "holds images of another origin: take another folder");
  }
  fs::remove_all(sequence.folder + "/rgb");
  fs::remove_all(sequence.folder + "/depth");
  write_file_atomically(stamp, sequence.what);
  return made;
}

void write_frame(const SyntheticSequence& sequence, const Scene& scene, std::size_t k) {
  const SyntheticCamera& c = sequence.camera;
  const double time = sequence.truth[k].time;
  const int frame = static_cast<int>(k);
  const Rendering ideal = render_moving(scene, c.camera, sequence.T_world_camera_at, time, c.shutter);
  const DepthImage depth = c.kinect ? sense_kinect_depth(ideal.depth, c.camera, c.depth, frame) : ideal.depth;
  write_depth(sequence.folder + "/" + file_of("depth", k), depth, synthetic_depth_units);
  write_color(sequence.folder + "/" + file_of("rgb", k), sense_color(ideal.color, c.color, frame, time));
}

void write_lists(const SyntheticSequence& sequence) {
  std::string rgb = "# time file\n";
  std::string depth = "# time file\n";
  for (std::size_t k = 0; k < sequence.truth.size(); ++k) {
    rgb += sequence.truth[k].stamp() + " " + file_of("rgb", k) + "\n";
    depth += sequence.truth[k].stamp() + " " + file_of("depth", k) + "\n";
  }
  CameraFile file;
  file.camera = sequence.camera.camera;
  // From the middle of the first row to that of the last, where a camera's readout is of all rows.
  const double rows = std::max(2, file.camera.height);
  file.camera.readout = sequence.camera.shutter.readout_s * rows / (rows - 1.0);
  file.depth_scale = synthetic_depth_units;
  file.fps = sequence.truth.size() > 1 ? 1.0 / (sequence.truth[1].time - sequence.truth[0].time) : 30.0;
  write_camera_file(sequence.folder + "/camera.yaml", file);
  write_trajectory(sequence.folder + "/groundtruth.txt", sequence.truth);
  write_file_atomically(sequence.folder + "/depth.txt", depth);
  write_file_atomically(sequence.folder + "/rgb.txt", rgb);
}

}  // namespace

int write_synthetic_sequence(const SyntheticSequence& sequence, const std::function<const Scene&()>& scene) {
  const MadeFolders made = claim_folder(sequence);
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < sequence.truth.size(); ++k) {
    // Colour is written after depth, so a frame with colour is complete.
    if (!fs::exists(sequence.folder + "/" + file_of("rgb", k))) missing.push_back(k);
  }
  if (!missing.empty()) {
    const Scene& world = scene();
    const auto total = static_cast<int>(missing.size());
    // One frame per thread, so that the compression of the files runs in parallel too.
    const int batch = 2 * threads();
    Progress progress("render frames", total);
    for (int first = 0; first < total; first += batch) {
      if (interrupted()) throw Interrupted();
      const int count = std::min(batch, total - first);
      parallel_for(count, 1, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) write_frame(sequence, world, missing[static_cast<std::size_t>(first + i)]);
      });
      progress.update(first + count);
    }
  }
  write_lists(sequence);
  return static_cast<int>(missing.size());
}

SceneDescription open_scene(const std::string& scene) {
  if (scene.find_first_of("./") == std::string::npos) return built_in_scene(scene);
  return parse_scene(scene, read_file(scene));
}

}  // namespace odosplat::apps
