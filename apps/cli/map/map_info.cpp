// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/cli/map/map_commands.hpp"
#include "apps/cli/map_quality_json.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/map_formats.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/splat/edit/edited_header.hpp"
#include "odosplat/splat/edit/gaussian_shapes.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

struct MapInfoFlags {
  std::string map;
  std::string json;
  bool settings = false;
};

/// Contents of a map file and its header.
struct MapInfo {
  std::size_t gaussians = 0;
  int sh_degree = 0;
  std::uintmax_t bytes = 0;
  Eigen::Vector3f least = Eigen::Vector3f::Zero();  // smallest coordinates of the centres [m]
  Eigen::Vector3f most = Eigen::Vector3f::Zero();
  Eigen::Vector3f middle_least = Eigen::Vector3f::Zero();  // the same without the outer 1 % on each side [m]
  Eigen::Vector3f middle_most = Eigen::Vector3f::Zero();
  float spacing = 0.0F;     // [m] median of the mean distances to the six nearest centres
  float size = 0.0F;        // [m] median of the longest standard deviations
  float flat_share = 0.0F;  // of the Gaussians
  float opacity = 0.0F;     // median
  BlendOrder order = BlendOrder::depth;
  std::optional<SigmaModel> sigma;  // none: not calibrated
  std::size_t places = 0;
  std::vector<std::string> settings;    // other lines of the header
  std::optional<MapQuality> quality;    // none: unknown
  std::vector<std::string> trained_on;  // sequences and frames
  std::vector<std::string> sources;     // of a merged map
  std::vector<std::string> edits;       // by map crop, merge and clean
};

/// Value below which a share of the values lies.
float quantile(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void add_shapes(const Gaussians& gaussians, MapInfo& info) {
  constexpr double outer = 0.01;
  const GaussianShapes shapes = gaussian_shapes(gaussians);
  info.least = info.most = shapes.cloud.points.front();
  for (const Eigen::Vector3f& p : shapes.cloud.points) {
    info.least = info.least.cwiseMin(p);
    info.most = info.most.cwiseMax(p);
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<float> along;
    along.reserve(shapes.size());
    for (const Eigen::Vector3f& p : shapes.cloud.points) along.push_back(p[axis]);
    info.middle_least[axis] = quantile(along, outer);
    info.middle_most[axis] = quantile(std::move(along), 1.0 - outer);
  }
  info.spacing = upper_median(shapes.spacings);
  info.size = upper_median(shapes.length);
  info.opacity = upper_median(shapes.opacities);
  info.flat_share =
      static_cast<float>(std::count(shapes.flat.begin(), shapes.flat.end(), 1)) / static_cast<float>(shapes.size());
}

/// "every 10th of frames 0 to 1099 of icl_office_kt3 (1100)" for a line of training frames; the line itself if it is
/// not of that form.
std::string frames_words(const std::string& line) {
  std::istringstream in(line);
  std::string word;
  std::string name;
  std::size_t every = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size = 0;
  if (!(in >> word >> every >> begin >> end >> size) || end == 0 || !std::getline(in >> std::ws, name)) return line;
  const std::string which = every == 1 ? "all" : "one in " + std::to_string(every);
  return which + formatted(" of frames %zu to %zu of %s (%zu frames)", begin, end - 1, name.c_str(), size);
}

/// The lines that begin with a word, without it.
std::vector<std::string> lines_of(const MapHeader& header, const std::string& word) {
  std::vector<std::string> lines;
  for (const std::string& note : header.notes) {
    if (note.starts_with(word)) lines.push_back(note.substr(word.size()));
  }
  return lines;
}

/// Of lines "K NAME: ..." and "K LINE" on the sources of a merged map those that say what a source was.
std::vector<std::string> source_words(const MapHeader& header) {
  std::vector<std::string> words;
  for (const std::string& line : lines_of(header, "source ")) {
    if (line.find(" Gaussians; quality ") != std::string::npos) words.push_back(line);
  }
  return words;
}

MapInfo read_info(const std::string& path) {
  const Map map = read_map(path);
  const Gaussians& gaussians = map.gaussians;
  MapInfo info;
  info.gaussians = gaussians.size();
  info.sh_degree = gaussians.sh_degree;
  info.bytes = map_file_size(path);
  add_shapes(gaussians, info);
  info.order = map.header.rasterizer.order;
  info.sigma = map.header.sigma;
  info.places = map.header.places.size();
  info.quality = map.header.quality;
  for (const std::string& note : map.header.notes) {
    if (!note.starts_with("sigma_") && !note.starts_with("training_view ") && !note.starts_with("quality_") &&
        !note.starts_with("blend_order ") && !note.starts_with("training_frames ") && !note.starts_with("edit ")) {
      info.settings.push_back(note);
    }
  }
  for (const std::string& note : map.header.notes) {
    if (note.starts_with("training_frames ")) info.trained_on.push_back(frames_words(note));
  }
  info.sources = source_words(map.header);
  info.edits = edits_of(map.header);
  return info;
}

void print_quality(const MapQuality& q, bool edited) {
  print("quality       %s%s\n", q.verdict.c_str(), edited ? " (before the edits below)" : "");
  if (q.images == 0) return;  // a verdict alone, of a merged map
  print("  images      %d, median PSNR %.2f dB, %d disagree with the rest\n", q.images, q.psnr_db, q.odd_images);
  if (q.depth_error_m >= 0.0) {
    print("  depth       %.1f mm off the cloud's (%.2f %% of it), median of the images' medians\n",
          1000.0 * q.depth_error_m, 100.0 * q.depth_error_share);
  } else {
    print("  depth       not compared with a cloud\n");
  }
  print("  cloud       %.1f %% of it in no image, the rest in %.0f images (median)\n", 100.0 * q.coverage.unseen_share,
        q.coverage.images_a_point);
  print("  directions ");
  for (std::size_t k = 0; k < direction_names.size(); ++k)
    print(" %s %.0f %%", direction_names[k], 100.0 * q.coverage.directions[k]);
  print(" looked in by an image\n");
}

void print_info(const std::string& path, const MapInfo& info, bool settings) {
  print("%s\n", path.c_str());
  print("Gaussians     %zu, colours of SH degree %d\n", info.gaussians, info.sh_degree);
  print("bytes         %ju\n", info.bytes);
  const Eigen::Vector3f size = info.most - info.least;
  print("bounds [m]    %.2f %.2f %.2f to %.2f %.2f %.2f (%.2f x %.2f x %.2f)\n", info.least.x(), info.least.y(),
        info.least.z(), info.most.x(), info.most.y(), info.most.z(), size.x(), size.y(), size.z());
  const Eigen::Vector3f middle = info.middle_most - info.middle_least;
  print("  98 %% of it    %.2f %.2f %.2f to %.2f %.2f %.2f (%.2f x %.2f x %.2f), along each axis\n",
        info.middle_least.x(), info.middle_least.y(), info.middle_least.z(), info.middle_most.x(), info.middle_most.y(),
        info.middle_most.z(), middle.x(), middle.y(), middle.z());
  print("spacing       %.1f mm; standard deviation %.1f mm, opacity %.2f (medians), %.0f %% flat\n",
        1000.0F * info.spacing, 1000.0F * info.size, info.opacity, 100.0F * info.flat_share);
  print("blend order   %s\n", info.order == BlendOrder::distance ? "distance" : "depth");
  if (info.sigma) {
    print("sigma         spread %.3g, slope %.3g px, share of depth %.3g, open %.3g\n", info.sigma->spread,
          info.sigma->slope_px, info.sigma->depth_share, info.sigma->open_share);
  } else {
    print("sigma         not calibrated\n");
  }
  print("places        %zu\n", info.places);
  if (info.quality) {
    print_quality(*info.quality, !info.edits.empty() && info.quality->images > 0);
  } else if (!info.sources.empty()) {
    print("quality       not measured since the map was merged (eval-depth compares it with depth images)\n");
  } else {
    print("quality       unknown: the file does not say (only train measures it)\n");
  }
  for (const std::string& line : info.trained_on) print("trained on    %s\n", line.c_str());
  for (const std::string& line : info.sources) print("source        %s\n", line.c_str());
  for (const std::string& line : info.edits) print("edited        %s\n", line.c_str());
  print("settings      %zu%s\n", info.settings.size(), settings ? "" : " lines of the header (--settings shows them)");
  if (!settings) return;
  for (const std::string& line : info.settings) print("  %s\n", line.c_str());
}

nlohmann::ordered_json json_of(const MapInfo& info) {
  const auto row = [](const Eigen::Vector3f& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  nlohmann::ordered_json json{{"gaussians", info.gaussians},
                              {"sh_degree", info.sh_degree},
                              {"bytes", info.bytes},
                              {"bounds_m", {{"least", row(info.least)}, {"most", row(info.most)}}},
                              {"middle_m", {{"least", row(info.middle_least)}, {"most", row(info.middle_most)}}},
                              {"spacing_m", info.spacing},
                              {"size_m", info.size},
                              {"opacity", info.opacity},
                              {"flat_share", info.flat_share},
                              {"blend_order", info.order == BlendOrder::distance ? "distance" : "depth"},
                              {"sigma", nullptr},
                              {"places", info.places},
                              {"quality", nullptr},
                              {"trained_on", info.trained_on},
                              {"sources", info.sources},
                              {"edits", info.edits},
                              {"settings", info.settings}};
  if (info.sigma)
    json["sigma"] = {{"spread", info.sigma->spread},
                     {"slope_px", info.sigma->slope_px},
                     {"depth_share", info.sigma->depth_share},
                     {"open_share", info.sigma->open_share}};
  if (info.quality) json["quality"] = apps::json_of(*info.quality);
  return json;
}

void run(const MapInfoFlags& flags) {
  const MadeFolders made = ensure_output_if_given(flags.json);
  const MapInfo info = read_info(flags.map);
  print_info(flags.map, info, flags.settings);
  if (!flags.json.empty()) write_file_atomically(flags.json, json_text(json_of(info)));
}

}  // namespace

void add_map_info(CLI::App& map, Common& common) {
  CLI::App* info =
      add_command(map, common, "info", "what a map holds, how it was trained and what it is worth, as its file says");
  auto flags = std::make_shared<MapInfoFlags>();
  info->add_option("MAP", flags->map, std::string("map of Gaussians (") + map_formats + ")")->required();
  info->add_flag("--settings", flags->settings, "print the training's settings too");
  info->add_option("--json", flags->json, "the same to write (JSON)");
  info->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
