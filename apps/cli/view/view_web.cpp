// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/view/view_output.hpp"
#include "apps/cli/view/web/packed_map.hpp"
#include "apps/cli/view/web/page_images.hpp"
#include "apps/cli/view/web/page_paths.hpp"
#include "apps/cli/view/web/web_page.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/map_formats.hpp"
#include "apps/input/sequence_flags.hpp"
#include "apps/input/truth.hpp"
#include "odosplat/core/base64.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/most_visible.hpp"
#include "viewer/color_map.hpp"

namespace odosplat::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_gaussians = 300'000;    // without --budget
constexpr std::size_t largest_budget = 1'000'000;  // textures of the browser
constexpr std::size_t most_frames = 200'000;       // on the time line

struct WebFlags {
  std::string map;
  std::vector<std::string> poses;
  std::string times;
  TruthFlags truth;
  std::string sequence;
  std::string alignment = "none";
  std::string out;
  std::string title;
  std::optional<std::size_t> budget;
  int sh_degree = 3;
  std::size_t images = 100;
  int image_size = 320;
};

/// The sequence of --sequence, with the images that may be taken.
struct ShownSequence {
  Sequence sequence;
  std::size_t begin;
  std::size_t end;
};

std::optional<ShownSequence> open_shown(const WebFlags& flags) {
  if (flags.sequence.empty()) return std::nullopt;
  const FrameRange range = flags.truth.frames.empty() ? FrameRange() : parse_frames(flags.truth.frames);
  Sequence sequence = open_sequence(SequenceFlags{flags.sequence, flags.truth.sequence.options});
  const std::size_t end = std::min(range.end, sequence.size());
  if (range.begin >= end) {
    throw InputError("--frames", "is " + flags.truth.frames + ", the sequence has " + std::to_string(sequence.size()));
  }
  return ShownSequence{std::move(sequence), range.begin, end};
}

/// Flags that would have no effect.
void check_used(const WebFlags& flags) {
  if (flags.sequence.empty() && flags.truth.sequence.path.empty()) {
    if (!flags.truth.frames.empty()) throw InputError("--frames", "needs --sequence or --truth");
    if (!flags.truth.sequence.options.layout.empty()) throw InputError("--layout", "needs --sequence or --truth");
    if (flags.truth.sequence.options.max_image_pixels != SequenceOptions().max_image_pixels) {
      throw InputError("--max-image-pixels", "needs --sequence or --truth");
    }
    if (flags.poses.empty() && !flags.truth.sequence.options.camera_file.empty()) {
      throw InputError("--camera", "needs --sequence, --poses or --truth");
    }
  }
  if (flags.truth.sequence.path.empty() && flags.alignment != "none") throw InputError("--align", "needs --truth");
  if (flags.poses.empty() && !flags.times.empty()) throw InputError("--times", "needs --poses");
  if (flags.truth.sequence.path.empty() && !flags.truth.times.empty())
    throw InputError("--truth-times", "needs --truth");
}

std::optional<Camera> camera_of(const WebFlags& flags, const std::optional<ShownSequence>& shown) {
  if (shown) return shown->sequence.camera();
  if (!flags.truth.sequence.options.camera_file.empty()) {
    return read_camera_file(flags.truth.sequence.options.camera_file).camera;
  }
  return std::nullopt;
}

Json json_of(const std::optional<Camera>& camera) {
  if (!camera) return nullptr;
  return {{"width", camera->width}, {"height", camera->height}, {"fx", camera->fx},
          {"fy", camera->fy},       {"cx", camera->cx},         {"cy", camera->cy}};
}

std::vector<SE3> known_cameras(const std::vector<PageRun>& runs, const Trajectory& truth, const MapHeader& header) {
  std::vector<SE3> cameras;
  for (const PageRun& run : runs) {
    for (const StampedPose& pose : run.estimate) cameras.push_back(pose.T_world_camera);
  }
  if (cameras.empty()) {
    for (const StampedPose& pose : truth) cameras.push_back(pose.T_world_camera);
  }
  return cameras.empty() ? header.places : cameras;
}

/// Mean of the cameras' upward axes (-y); null if they have none in common.
Json up_of(const std::vector<SE3>& cameras) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SE3& T_world_camera : cameras) sum -= T_world_camera.rotation_matrix().col(1);
  if (cameras.empty() || sum.norm() < 0.3 * static_cast<double>(cameras.size())) return nullptr;
  sum.normalize();
  // Hand-held cameras are not level; the map's axis is, if one is near.
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(sum[axis]) > 0.9) sum = Eigen::Vector3d::Unit(axis) * (sum[axis] > 0.0 ? 1.0 : -1.0);
  }
  return {sum.x(), sum.y(), sum.z()};
}

VisibleGaussians kept_gaussians(const WebFlags& flags, const Map& map, const std::vector<SE3>& cameras) {
  const std::size_t count = map.gaussians.size();
  if (!flags.budget && count > most_gaussians) {
    throw InputError(flags.map, "has " + std::to_string(count) + " Gaussians, a page takes " +
                                    std::to_string(most_gaussians) + ": --budget N keeps the N most visible");
  }
  VisibleGaussians kept = most_visible(map.gaussians, cameras, flags.budget.value_or(most_gaussians));
  if (kept.rows.empty()) throw InputError(flags.map, "has no Gaussian that is ever drawn");
  return kept;
}

Json json_of_map(const WebFlags& flags, const Map& map, const PackedMap& packed, const VisibleGaussians& kept) {
  return {{"name", std::filesystem::path(flags.map).filename().string()},
          {"count", packed.count},
          {"total", map.gaussians.size()},
          {"thinned", kept.share < 1.0},
          {"share", kept.share},
          {"degree", packed.sh_degree},
          {"map_degree", map.gaussians.sh_degree},
          {"order", map.header.rasterizer.order == BlendOrder::distance ? "distance" : "depth"},
          {"dilation", map.header.rasterizer.dilation},
          {"compensated", map.header.rasterizer.compensated},
          {"chunk", PackedMap::chunk}};
}

Json colors_of_page() {
  constexpr int steps = 64;
  Json scale = Json::array();
  for (int i = 0; i < steps; ++i) {
    const Rgb color = scale_color(ColorScale::error, static_cast<double>(i) / (steps - 1));
    scale.push_back({color[0], color[1], color[2]});
  }
  return scale;
}

Json json_of(const std::vector<PageImage>& images) {
  Json list = Json::array();
  for (const PageImage& image : images) {
    list.push_back({{"frame", image.frame}, {"name", image.name}, {"jpeg", base64(image.jpeg)}});
  }
  return list;
}

std::string megabytes(std::size_t bytes) { return formatted("%.2f MB", 1e-6 * static_cast<double>(bytes)); }

std::string words_of_map(const Json& map) {
  std::string words = std::to_string(map["count"].get<std::size_t>()) + " Gaussians, SH degree " +
                      std::to_string(map["degree"].get<int>());
  if (map["degree"] != map["map_degree"]) {
    words += " (reduced from " + std::to_string(map["map_degree"].get<int>()) + ")";
  }
  if (map["thinned"].get<bool>()) {
    words += formatted(", of %zu: %.1f %% of the visibility", map["total"].get<std::size_t>(),
                       100.0 * map["share"].get<double>());
  }
  return words;
}

struct PagePaths {
  std::vector<PageRun> runs;
  Trajectory truth;
};

PagePaths read_paths(const WebFlags& flags) {
  PagePaths paths;
  paths.runs = read_page_runs(flags.poses, flags.times, flags.truth, alignment_from_name(flags.alignment));
  if (paths.runs.empty()) {
    paths.truth = read_true_poses(flags.truth);
  } else {
    // That of the run that takes longest.
    for (PageRun& run : paths.runs) {
      if (run.truth.size() > paths.truth.size()) paths.truth = run.truth;
    }
  }
  if (!paths.truth.empty()) require_near_origin(flags.truth.sequence.path, paths.truth);
  return paths;
}

void run(const WebFlags& flags) {
  check_extension(flags.out, {".html", ".htm"});
  check_used(flags);
  const MadeFolders made = ensure_output_file(flags.out);
  const Map map = read_map(flags.map);
  const PagePaths paths = read_paths(flags);
  const std::optional<ShownSequence> shown = open_shown(flags);
  std::vector<double> image_times;
  for (std::size_t i = shown ? shown->begin : 0; shown && i < shown->end; ++i) {
    image_times.push_back(shown->sequence.time(i));
  }
  const std::vector<double> times = page_times(paths.runs, paths.truth, image_times);
  if (times.size() > most_frames) {
    throw InputError("--poses", formatted("have %zu frames, a page takes %zu", times.size(), most_frames));
  }
  const std::vector<SE3> cameras = known_cameras(paths.runs, paths.truth, map.header);
  const VisibleGaussians kept = kept_gaussians(flags, map, cameras);
  const PackedMap packed = pack_map(map.gaussians, kept.rows, flags.sh_degree);
  std::vector<PageImage> images;
  if (shown && flags.images > 0) {
    images = read_page_images(shown->sequence, shown->begin, shown->end, times, flags.images, flags.image_size);
  }

  PageNumbers numbers;
  WebPage page;
  page.title = flags.title.empty() ? std::filesystem::path(flags.map).filename().string() : flags.title;
  std::vector<float> relative;
  for (const double time : times) relative.push_back(static_cast<float>(time - times.front()));
  page.data = {{"title", page.title},
               {"version", ODOSPLAT_VERSION},
               {"map", json_of_map(flags, map, packed, kept)},
               {"camera", json_of(camera_of(flags, shown))},
               {"up", up_of(cameras)},
               {"start", times.empty() ? "" : formatted("%.6f", times.front())},
               {"times", numbers.add(relative)},
               {"alignment", flags.alignment},
               {"runs", Json::array()},
               {"truth", paths.truth.empty() ? Json() : json_of_truth(paths.truth, times, numbers)},
               {"images", json_of(images)},
               {"scale", colors_of_page()}};
  for (const PageRun& one : paths.runs) page.data["runs"].push_back(json_of_run(one, times, numbers));
  page.map = page_block(packed.bytes);
  page.numbers = page_block(numbers.bytes());
  const std::string html = html_of(page);
  write_file_atomically(flags.out, html);
  std::size_t image_bytes = 0;
  for (const PageImage& image : images) image_bytes += image.jpeg.size();
  print("%s: %s\n", flags.out.c_str(), megabytes(html.size()).c_str());
  print("map: %s, %s\n", words_of_map(page.data["map"]).c_str(), megabytes(page.map.size()).c_str());
  print("frames: %zu, with %zu images, %s; runs: %zu\n", times.size(), images.size(),
        megabytes(image_bytes * 4 / 3).c_str(), paths.runs.size());
}

}  // namespace

void add_view_web(CLI::App* view, Common& common) {
  CLI::App* command =
      add_command(*view, common, "web", "a page for the browser: the map, paths, images and errors in one HTML file");
  auto flags = std::make_shared<WebFlags>();
  command->add_option("--map", flags->map, std::string("map of Gaussians (") + map_formats + ")")->required();
  command->add_option("--poses", flags->poses, "estimated trajectories: files, or folders that track wrote")
      ->type_name("FILE|FOLDER");
  command->add_option("--times", flags->times, "times of --poses, one a line, for formats without times");
  add_truth_flags(command, flags->truth);
  CLI::Option* sequence =
      command->add_option("--sequence", flags->sequence, "sequence of the images, in any of the known layouts")
          ->type_name("SEQ");
  command->get_option("--frames")
      ->description(std::string("of --sequence, and of a sequence as --truth: ") + frames_help);
  command->get_option("--camera")
      ->description("camera.yaml to use instead of the sequences' own; without --sequence, the camera of the paths");
  command->add_option(
      "--align", flags->alignment,
      "how estimates are aligned with the truth before errors are computed, as in eval: none, se3, sim3");
  command->add_option("--out", flags->out, "page to write: .html")->required();
  command->add_option("--title", flags->title, "one line (default: the map's name)");
  add_number(command, "--budget", flags->budget, {.least = 1, .most = largest_budget, .word = "all"},
             "Gaussians that the page takes, the most visible ones; all: maps of up to 300 000 as they are, others are "
             "refused");
  add_number(command, "--sh-degree", flags->sh_degree, {.least = 0, .most = 3},
             "degree of the colours' spherical harmonics at most; the page says if it is reduced");
  add_number(command, "--images", flags->images, {.least = 0, .most = 2000},
             "images of --sequence, evenly spread over the frames; 0: none")
      ->needs(sequence);
  add_number(command, "--image-size", flags->image_size, {.least = 32, .most = 4096},
             "longer side of the images [px] at most")
      ->needs(sequence);
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
