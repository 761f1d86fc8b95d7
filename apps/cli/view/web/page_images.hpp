// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// An image of a page.
struct PageImage {
  std::size_t frame = 0;  // of the page
  std::string name;       // of its file, without folders; empty in videos
  std::string jpeg;
};

/// A sequence's images for a page with these frame times: at most `most` of those that belong to a frame, evenly spread,
/// each reduced so that its longer side has at most `longer_side` pixels, lens distortion removed. Images that cannot
/// be read are left out with one warning. begin, end: the images of the sequence that may be taken. Interrupted if the
/// user asks to stop. InputError if no image belongs to a frame, or none can be read.
std::vector<PageImage> read_page_images(const Sequence& sequence, std::size_t begin, std::size_t end,
                                        const std::vector<double>& times, std::size_t most, int longer_side);

}  // namespace odosplat::apps
