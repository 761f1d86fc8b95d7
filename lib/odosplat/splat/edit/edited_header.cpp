// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/edited_header.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/map_places.hpp"

namespace odosplat {
namespace {

const std::string edit_word = "edit ";
const std::string source_word = "source ";
const std::string frames_word = "training_frames ";

bool begins_with_any(const std::string& line, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return line.starts_with(word); });
}

/// Lines of which the merged header has its own.
bool is_made_anew(const std::string& line) { return begins_with_any(line, {"sigma_", "quality_", "training_view "}); }

/// Lines on what the Gaussians are to be rendered with: the first map's.
bool is_of_rasterizer(const std::string& line) {
  return begins_with_any(line, {"blend_order ", "dilation ", "compensated "});
}

bool holds(const std::vector<std::string>& lines, const std::string& line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

std::vector<std::string> merged_sigma(const std::vector<HeaderSource>& sources) {
  SigmaModel most{0.0F, 0.0F, 0.0F, 0.0F};
  bool known = false;
  for (const HeaderSource& source : sources) {
    const SigmaModel model = source.header.sigma.value_or(SigmaModel());
    known = known || source.header.sigma.has_value();
    for (const auto factor :
         {&SigmaModel::spread, &SigmaModel::slope_px, &SigmaModel::depth_share, &SigmaModel::open_share}) {
      most.*factor = std::max(most.*factor, model.*factor);
    }
  }
  return known ? most.to_lines() : std::vector<std::string>();
}

std::vector<std::string> merged_places(const std::vector<HeaderSource>& sources) {
  std::vector<SE3> places;
  for (const HeaderSource& source : sources) {
    places.insert(places.end(), source.header.places.begin(), source.header.places.end());
  }
  return place_lines(thinned_places(places));
}

std::string words_on(const HeaderSource& source) {
  return source.name + ": " + std::to_string(source.kept) + " of " + std::to_string(source.gaussians) +
         " Gaussians; quality " + (source.header.quality ? source.header.quality->verdict : "unknown");
}

}  // namespace

MapHeader with_edit(const MapHeader& header, const std::string& what) {
  MapHeader edited = header;
  edited.notes.push_back(edit_word + what);
  return edited;
}

std::vector<std::string> edits_of(const MapHeader& header) {
  std::vector<std::string> edits;
  for (const std::string& note : header.notes) {
    if (note.starts_with(edit_word)) edits.push_back(note.substr(edit_word.size()));
  }
  return edits;
}

MapHeader merged_header(const std::vector<HeaderSource>& sources) {
  require(!sources.empty(), "sources", "at least one");
  std::vector<std::string> notes;
  std::vector<std::string> of_sources;
  std::vector<std::string> frames;
  std::string names;
  std::string doubts;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const HeaderSource& source = sources[k];
    const std::string begin = source_word + std::to_string(k + 1) + " ";
    names += (k == 0 ? "" : k + 1 < sources.size() ? ", " : " and ") + source.name;
    of_sources.push_back(begin + words_on(source));
    if (source.header.quality && !source.header.quality->good) {
      doubts += (doubts.empty() ? "" : "; ") + source.name + " is " + source.header.quality->verdict;
    }
    for (const std::string& line : source.header.notes) {
      if (is_made_anew(line)) continue;
      if (line.starts_with(frames_word)) {
        if (!holds(frames, line)) frames.push_back(line);
        continue;
      }
      const bool common = !begins_with_any(line, {edit_word, source_word}) &&
                          std::all_of(sources.begin(), sources.end(),
                                      [&](const HeaderSource& other) { return holds(other.header.notes, line); });
      if (common || (k == 0 && is_of_rasterizer(line))) {
        if (k == 0) notes.push_back(line);
      } else {
        of_sources.push_back(begin + line);
      }
    }
  }
  const auto add = [&notes](const std::vector<std::string>& lines) {
    notes.insert(notes.end(), lines.begin(), lines.end());
  };
  add(of_sources);
  if (!doubts.empty()) notes.push_back("quality_verdict doubtful: it was merged, and " + doubts);
  add(merged_places(sources));
  add(frames);
  add(merged_sigma(sources));
  notes.push_back(edit_word + "merge: " + names);
  return MapHeader::from_notes(std::move(notes));
}

}  // namespace odosplat
