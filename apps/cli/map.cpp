// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/cli/map_quality_json.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
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
  BlendOrder order = BlendOrder::depth;
  std::optional<SigmaModel> sigma;  // none: not calibrated
  std::size_t places = 0;
  std::vector<std::string> settings;  // other lines of the header
  std::optional<MapQuality> quality;  // none: unknown
};

MapInfo read_info(const std::string& path) {
  const Map map = read_map(path);
  const Gaussians& gaussians = map.gaussians;
  MapInfo info;
  info.gaussians = gaussians.size();
  info.sh_degree = gaussians.sh_degree;
  info.bytes = std::filesystem::file_size(path);
  info.least = info.most = Eigen::Vector3f(gaussians.positions.data());
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    const Eigen::Vector3f p(&gaussians.positions[3 * i]);
    info.least = info.least.cwiseMin(p);
    info.most = info.most.cwiseMax(p);
  }
  info.order = map.header.rasterizer.order;
  info.sigma = map.header.sigma;
  info.places = map.header.places.size();
  info.quality = map.header.quality;
  for (const std::string& note : map.header.notes) {
    if (!note.starts_with("sigma_") && !note.starts_with("training_view ") && !note.starts_with("quality_") &&
        !note.starts_with("blend_order ")) {
      info.settings.push_back(note);
    }
  }
  return info;
}

void print_quality(const MapQuality& q) {
  print("quality       %s\n", q.verdict.c_str());
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
  print("blend order   %s\n", info.order == BlendOrder::distance ? "distance" : "depth");
  if (info.sigma) {
    print("sigma         spread %.3g, slope %.3g px, share of depth %.3g, open %.3g\n", info.sigma->spread,
          info.sigma->slope_px, info.sigma->depth_share, info.sigma->open_share);
  } else {
    print("sigma         not calibrated\n");
  }
  print("places        %zu\n", info.places);
  if (info.quality) {
    print_quality(*info.quality);
  } else {
    print("quality       unknown: the file does not say (only train measures it)\n");
  }
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
                              {"blend_order", info.order == BlendOrder::distance ? "distance" : "depth"},
                              {"sigma", nullptr},
                              {"places", info.places},
                              {"quality", nullptr},
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

void add_map(CLI::App& app, Common& common) {
  CLI::App* map = app.add_subcommand("map", "what a map of Gaussians is");
  map->require_subcommand(1);
  CLI::App* info =
      add_command(*map, common, "info", "what a map holds, how it was trained and what it is worth, as its file says");
  auto flags = std::make_shared<MapInfoFlags>();
  info->add_option("MAP", flags->map, "map of Gaussians (PLY, .splat)")->required();
  info->add_flag("--settings", flags->settings, "print the training's settings too");
  info->add_option("--json", flags->json, "the same to write (JSON)");
  info->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
