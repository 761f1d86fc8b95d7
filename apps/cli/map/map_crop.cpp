// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "apps/cli/map/map_commands.hpp"
#include "apps/cli/map/seen_by_flags.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/map_formats.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/core/terminal_text.hpp"
#include "odosplat/splat/edit/crop.hpp"
#include "odosplat/splat/edit/edited_header.hpp"
#include "odosplat/splat/kept_gaussians.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

struct CropFlags {
  std::string map;
  std::string box;
  std::string T_world_box;
  bool outside = false;
  SeenByFlags seen_by;
  double margin = 0.0;
  std::string out;
};

/// So many finite numbers, separated by blanks or commas.
std::vector<double> numbers_of(const std::string& flag, const std::string& text, std::size_t count,
                               const std::string& names) {
  std::string blanks = text;
  std::replace(blanks.begin(), blanks.end(), ',', ' ');
  std::istringstream in(blanks);
  std::vector<double> numbers;
  const InputError wrong(flag, "must be \"" + names + "\", is \"" + printable_line(text) + "\"");
  for (std::string word; in >> word;) {
    std::istringstream one(word);
    double value = 0.0;
    if (!(one >> value) || !one.eof() || !std::isfinite(value)) throw wrong;
    numbers.push_back(value);
  }
  if (numbers.size() != count) throw wrong;
  return numbers;
}

std::vector<double> numbers_of_box(const CropFlags& flags) {
  return numbers_of("--box", flags.box, 6, "x0 y0 z0 x1 y1 z1");
}

std::vector<double> numbers_of_T(const CropFlags& flags) {
  return numbers_of("--T", flags.T_world_box, 7, "tx ty tz qx qy qz qw");
}

CropBox box_of(const CropFlags& flags) {
  const std::vector<double> v = numbers_of_box(flags);
  CropBox box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, SE3()};
  try {
    if (!flags.T_world_box.empty()) {
      const std::vector<double> t = numbers_of_T(flags);
      box.T_world_box = SE3(rotation_from_text(Eigen::Quaterniond(t[6], t[3], t[4], t[5])), {t[0], t[1], t[2]});
    }
    box.check();
  } catch (const InputError& e) {
    const std::string words = e.what();
    throw words.starts_with("--") ? e : InputError(words.starts_with("box") ? "--box" : "--T", words);
  }
  return box;
}

std::string words_of(const std::vector<double>& numbers) {
  std::string words;
  for (const double number : numbers) words += formatted(" %.10g", number);
  return words;
}

/// Of the numbers: the text of a flag may hold a line break, which would end the header's line.
std::string box_words(const CropFlags& flags) {
  return std::string(flags.outside ? "outside of" : "inside of") + " box" + words_of(numbers_of_box(flags)) +
         (flags.T_world_box.empty() ? "" : " at" + words_of(numbers_of_T(flags)));
}

std::vector<bool> choose(const Common& common, const CropFlags& flags, const Map& map, std::string& words) {
  if (!flags.box.empty()) {
    std::vector<bool> keep = in_box(map.gaussians, box_of(flags));
    if (flags.outside) keep.flip();
    words = box_words(flags);
    return keep;
  }
  const std::vector<EditView> views = read_seen_by(flags.seen_by, false);
  words = "seen by " + seen_by_words(flags.seen_by, views.size());
  if (flags.margin > 0.0) words += formatted(", margin %g m", flags.margin);
  const compute::Context device = open_device(common);
  Progress progress("crop", static_cast<long>(views.size()));
  std::vector<bool> keep =
      seen_by(device, map.gaussians, map.header.rasterizer, views, flags.margin, [&](std::size_t k) {
        if (interrupted()) throw Interrupted();
        progress.update(static_cast<long>(k));
      });
  progress.finish();
  print_profile(common, device);
  return keep;
}

void run(const Common& common, const CropFlags& flags) {
  if (flags.box.empty() == flags.seen_by.sequence.path.empty()) {
    throw InputError("crop", "needs --box or --seen-by, one of them");
  }
  if (!flags.box.empty()) box_of(flags);  // before a large map is read
  check_extension(flags.out, map_extensions);
  const MadeFolders made = ensure_output_file(flags.out);
  const Map map = read_map(flags.map);
  std::string words;
  const std::vector<bool> keep = choose(common, flags, map, words);
  const auto kept = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), true));
  const std::size_t all = map.gaussians.size();
  if (kept == 0) {
    throw NoResult(flags.map + ": none of its " + std::to_string(all) + " Gaussians is " + words +
                   "; nothing is written (map info prints where they are)");
  }
  const std::string counts = std::to_string(kept) + " of " + std::to_string(all) + " Gaussians";
  write_map(flags.out, {kept_gaussians(map.gaussians, keep), with_edit(map.header, "crop: " + words + ", " + counts)});
  print("%s: %s kept (%.1f %%), %s\n", flags.out.c_str(), counts.c_str(),
        100.0 * static_cast<double>(kept) / static_cast<double>(all), words.c_str());
}

}  // namespace

void add_map_crop(CLI::App& map, Common& common) {
  CLI::App* command = add_command(map, common, "crop", "a part of a map: what lies in a box, or what views see");
  auto flags = std::make_shared<CropFlags>();
  command->add_option("MAP", flags->map, std::string("map of Gaussians (") + map_formats + ")")->required();
  CLI::Option* box =
      command->add_option("--box", flags->box,
                          "\"x0 y0 z0 x1 y1 z1\" [m]: keep the Gaussians whose centres lie in this box, on the axes of "
                          "the world or of --T");
  command
      ->add_option("--T", flags->T_world_box,
                   "\"tx ty tz qx qy qz qw\" [m]: place and orientation of the box's axes, box to world")
      ->needs(box);
  command->add_flag("--outside", flags->outside, "keep what lies outside of the box")->needs(box);
  CLI::Option* seen_by =
      add_seen_by_flags(command, flags->seen_by,
                        "keep what makes up at least a tenth of a pixel (sum of blending weights) of any of these "
                        "views");
  seen_by->excludes(box);
  add_number(command, "--margin", flags->margin, {.least = 0.0, .most = 1000.0},
             "of --seen-by: keep also what lies within this distance [m] of what is seen")
      ->needs(seen_by);
  command->add_option("--out", flags->out, "map to write (.ply, .splat, .spz or .glb)")->required();
  command->final_callback([&common, flags] { run(common, *flags); });
}

}  // namespace odosplat::apps
