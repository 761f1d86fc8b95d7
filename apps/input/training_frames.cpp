// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/training_frames.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <sstream>

#include "apps/command/number_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

constexpr std::size_t usual_every = 10;  // default of train --every

/// Frames begin, begin + every, ... before end, counted from 0; begin is a multiple of every.
struct Progression {
  std::size_t every = 1;
  std::size_t begin = 0;
  std::size_t end = 0;

  bool contains(std::size_t i) const { return every > 0 && i >= begin && i < end && i % every == 0; }
  std::string words() const {
    std::string text = std::to_string(begin) + ", " + std::to_string(begin + every) + ", ...";
    return text + " of frames " + std::to_string(begin) + " to " + std::to_string(end - 1);
  }
};

struct Header {
  bool speaks = false;                 // whether it names training frames
  std::string sequences;               // all sequences that it names
  std::vector<Progression> of_this{};  // training frames of the given sequence
};

Header read_header(const std::string& map, const Sequence& sequence) {
  Header header;
  if (map.empty()) return header;
  for (const std::string& line : read_map_header(map).notes) {
    std::istringstream in(line);
    std::string word;
    if (!(in >> word) || word != training_frames_word) continue;
    Progression p;
    std::size_t size = 0;
    std::string name;
    if (!(in >> p.every >> p.begin >> p.end >> size) || p.every == 0 || !std::getline(in >> std::ws, name))
      throw InputError(map, training_frames_word + (": must be three numbers, a size and a name, is \"" + line + "\""));
    header.speaks = true;
    header.sequences += (header.sequences.empty() ? "" : ", ") + name;
    if (name == sequence.name() && size == sequence.size()) header.of_this.push_back(p);
  }
  return header;
}

}  // namespace

void add_skip_every_flag(CLI::App* command, int& skip_every) {
  add_number(
      command, "--skip-every", skip_every, {.least = 0, .word = "map", .meaning = skip_as_map_says},
      "leave out frames 0, N, 2N ... the map was made from; map: those that its header names, or every 10th if it "
      "names none; 0 or none: leave out none")
      ->transform([](const std::string& text) { return text == "none" ? std::string("0") : text; });
}

std::vector<std::size_t> frames_not_trained_on(const Sequence& sequence, const FrameRange& range, int skip_every,
                                               const std::string& map) {
  std::vector<Progression> skipped;
  const auto every = [&](std::size_t n) { return Progression{n, 0, sequence.size()}; };
  if (skip_every > 0) {
    skipped = {every(static_cast<std::size_t>(skip_every))};
  } else if (skip_every == skip_as_map_says) {
    const Header header = read_header(map, sequence);
    skipped = header.of_this;
    if (!header.speaks) {
      skipped = {every(usual_every)};
      log_info("nothing says which frames the map was made from: left out are " + skipped[0].words() +
               " (--skip-every)");
    } else if (skipped.empty()) {
      log_info("no frame is left out: the map was made from " + header.sequences);
    } else {
      log_info("left out are the frames that the map was made from: " + skipped[0].words());
    }
  }
  std::vector<std::size_t> frames;
  for (std::size_t i = range.begin; i < std::min(range.end, sequence.size()); ++i) {
    if (std::none_of(skipped.begin(), skipped.end(), [&](const Progression& p) { return p.contains(i); }))
      frames.push_back(i);
  }
  return frames;
}

}  // namespace odosplat::apps
