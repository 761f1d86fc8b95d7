// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/layouts.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat {

const std::vector<Layout>& layouts() {
  static const std::vector<Layout> all{
      {"video", "a video file", is_video, index_video},
      {"tum", "rgb.txt, or associations.txt with times", is_tum, index_tum},
      {"icl", "associations.txt", is_icl, index_icl},
      {"redwood", "*-color", is_redwood, index_redwood},
      {"sevenscenes", "frame-*.color.png or seq-*", is_sevenscenes, index_sevenscenes},
      {"replica", "results/frame*", is_replica, index_replica},
      {"colmap", "cameras and images, .bin or .txt, here, in sparse or in sparse/0", is_colmap, index_colmap},
      {"nerfstudio", "transforms.json", is_nerfstudio, index_nerfstudio},
      {"images", "PNG or JPEG files", is_image_folder, index_image_folder},
  };
  return all;
}

const Layout& layout_named(const std::string& name) {
  std::string known;
  for (const Layout& layout : layouts()) {
    if (name == layout.name) return layout;
    known += std::string(known.empty() ? "" : ", ") + layout.name;
  }
  throw InputError("--layout", "`" + name + "` is not known; known are " + known);
}

const Layout& detect_layout(const std::string& path) {
  std::string known;
  for (const Layout& layout : layouts()) {
    if (layout.matches(path)) return layout;
    known += std::string(known.empty() ? "" : ", ") + layout.name + " (" + layout.signature + ")";
  }
  throw InputError(path, "no known layout; known are " + known);
}

}  // namespace odosplat
