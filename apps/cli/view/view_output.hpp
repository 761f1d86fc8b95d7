// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "apps/command/support.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/picture_file.hpp"

namespace CLI {
class App;
}  // namespace CLI

/// Flags and output common to all kinds of `odosplat view`.
namespace odosplat::apps {

struct ViewOutputFlags {
  std::string out;
  std::string size;  // empty: the figure's own
};

/// Declares a kind of view that writes a picture: --out, --size.
CLI::App* add_view_kind(CLI::App* parent, Common& common, const char* name, const char* help, ViewOutputFlags& flags);

/// To be called before anything is computed: checks that the file can be written, and sets figure.size if --size is
/// given.
template <typename Figure>
[[nodiscard]] MadeFolders prepare_picture(const ViewOutputFlags& flags, Figure& figure) {
  check_picture_name(flags.out);
  MadeFolders made = ensure_output_file(flags.out);
  if (flags.size.empty()) return made;
  const Size size = parse_size("--size", flags.size);
  figure.size = {size.width, size.height};
  return made;
}

/// Writes the picture and prints its name.
void save_picture(const ViewOutputFlags& flags, const cv::Mat3b& picture);

/// `odosplat view fly`: a video of a flight through a map.
void add_view_fly(CLI::App* view, Common& common);

/// `odosplat view web`: a page for a browser.
void add_view_web(CLI::App* view, Common& common);

}  // namespace odosplat::apps
