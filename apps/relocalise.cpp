// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "json_text.hpp"
#include "map_views.hpp"
#include "number_flags.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/eval/statistics.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/odometry/relocalizer.hpp"
#include "places.hpp"
#include "sequence_flags.hpp"

namespace odosplat::apps {
namespace {

constexpr double good_m = 0.02;
constexpr double good_deg = 1.0;
constexpr double wrong_m = 0.1;

struct RelocaliseJob {
  SequenceFlags sequence;
  std::string method = "gaussian";
  MapFlags map;
  std::string places;
  int views = 200;
  int skip_every = 10;
  std::uint64_t seed = 42;
  std::string json;
};

/// One image looked up.
struct Row {
  std::size_t frame;
  Relocalization answer;
  std::optional<double> error_m;  // none: not found, or the true pose is not known
  std::optional<double> error_deg;
  double seconds;
  double cpu_seconds;  // of all threads: what it takes on a machine that others use, too
};

/// Whether at least half of what the whole map shows there belongs to the half that is deleted.
bool loses_half(MapView& whole, const Camera& camera, const SE3& T_world_camera, const MapHalf& half) {
  const Camera small = camera.resized(80, 60);
  const ViewImages view = whole.render(small, T_world_camera, {});
  int lost = 0;
  int seen = 0;
  for (int y = 0; y < view.depth.rows; ++y) {
    for (int x = 0; x < view.depth.cols; ++x) {
      const double z = view.depth(y, x);
      if (!(z > 0.0)) continue;
      ++seen;
      if (half.contains((T_world_camera * (z * small.ray(x, y))).cast<float>())) ++lost;
    }
  }
  return 2 * lost >= seen;
}

/// Random frames that are no mapping views.
std::vector<std::size_t> chosen_frames(const Common& common, const Sequence& sequence, const RelocaliseJob& job) {
  const auto skip = static_cast<std::size_t>(job.skip_every);
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (skip == 0 || i % skip != 0) frames.push_back(i);
  }
  Random random(job.seed);
  for (std::size_t k = frames.size(); k > 1; --k) {
    std::swap(frames[k - 1], frames[random.below(static_cast<std::uint32_t>(k))]);
  }
  const auto wanted = static_cast<std::size_t>(job.views);
  if (!job.map.without_half.empty()) {
    MapFlags whole = job.map;
    whole.without_half.clear();
    const MapHalf half = map_half(whole, job.map.without_half);
    const OpenedView opened = open_view(common, job.method, whole);
    std::vector<std::size_t> losing;
    for (const std::size_t i : frames) {
      if (losing.size() == wanted) break;
      const auto pose = sequence.T_world_camera(i);
      if (pose && loses_half(*opened.view, sequence.camera(), *pose, half)) losing.push_back(i);
    }
    frames = losing;
  }
  if (frames.size() > wanted) frames.resize(wanted);
  if (frames.empty()) throw InputError(sequence.name(), "no frame is left to look up");
  return frames;
}

Row look_up(Relocalizer& relocalizer, const Sequence& sequence, std::size_t i) {
  const GrayImage image = sequence.gray(i);
  const double cpu_start = cpu_seconds();
  const Stopwatch watch;
  Row row{i, relocalizer.find(image), {}, {}, 0.0, 0.0};
  row.seconds = watch.seconds();
  row.cpu_seconds = cpu_seconds() - cpu_start;
  const auto truth = sequence.T_world_camera(i);
  if (row.answer.found && truth) {
    const SE3 difference = truth->inverse() * row.answer.T_world_camera;
    row.error_m = difference.translation().norm();
    row.error_deg = difference.angle() * 180.0 / 3.14159265358979323846;
  }
  return row;
}

struct Summary {
  int views = 0;
  int found = 0;
  int good = 0;
  int wrong = 0;
  int refused = 0;
  std::vector<double> seconds;      // sorted
  std::vector<double> cpu_seconds;  // sorted
};

Summary summarise(const std::vector<Row>& rows) {
  Summary s;
  for (const Row& row : rows) {
    ++s.views;
    ++(row.answer.found ? s.found : s.refused);
    if (row.error_m && *row.error_m <= good_m && *row.error_deg <= good_deg) ++s.good;
    if (row.error_m && *row.error_m > wrong_m) ++s.wrong;
    s.seconds.push_back(row.seconds);
    s.cpu_seconds.push_back(row.cpu_seconds);
  }
  std::sort(s.seconds.begin(), s.seconds.end());
  std::sort(s.cpu_seconds.begin(), s.cpu_seconds.end());
  return s;
}

nlohmann::ordered_json json_of(const std::vector<double>& sorted) {
  return {{"median", percentile(sorted, 50.0)}, {"p95", percentile(sorted, 95.0)}, {"max", sorted.back()}};
}

nlohmann::ordered_json json_of(const Row& row) {
  nlohmann::ordered_json json{{"frame", row.frame},        {"found", row.answer.found},
                              {"score", row.answer.score}, {"inlier_share", row.answer.inlier_share},
                              {"seconds", row.seconds},    {"reason", row.answer.reason}};
  if (row.error_m) json["error_m"] = *row.error_m;
  if (row.error_deg) json["error_deg"] = *row.error_deg;
  return json;
}

void run(const Common& common, const RelocaliseJob& job) {
  const MadeFolders made = ensure_output_if_given(job.json);
  const Sequence sequence = open_sequence(job.sequence);
  const std::vector<std::size_t> frames = chosen_frames(common, sequence, job);
  const std::vector<SE3> places = places_of(job.map, job.places);
  OpenedView opened = open_view(common, job.method, job.map);
  if (opened.sensor != nullptr) throw InputError("--method", "rgbd has no map to be found in");
  log_info("rendering the map from " + std::to_string(places.size()) + " places");
  const Stopwatch watch;
  Relocalizer relocalizer(sequence.camera(), *opened.view, places);
  const std::size_t kept = relocalizer.prepare();
  const double index_s = watch.seconds();
  std::vector<Row> rows;
  Progress progress("relocalise", static_cast<long>(frames.size()));
  for (const std::size_t i : frames) {
    if (interrupted()) throw Interrupted();
    rows.push_back(look_up(relocalizer, sequence, i));
    progress.update(static_cast<long>(rows.size()));
  }
  progress.finish();
  if (opened.device) print_profile(common, *opened.device);
  const Summary s = summarise(rows);
  print("%zu places of %zu, rendered in %.2f s\n", kept, places.size(), index_s);
  print("%d views: %d found, %d of them within %.0f cm and %.0f deg (%.1f %%), %d beyond %.0f cm; %d refused\n",
        s.views, s.found, s.good, 100.0 * good_m, good_deg, 100.0 * s.good / s.views, s.wrong, 100.0 * wrong_m,
        s.refused);
  print("a view: %.3f s (95 %%: %.3f, most: %.3f); CPU of all threads: %.3f s (95 %%: %.3f, most: %.3f)\n",
        percentile(s.seconds, 50.0), percentile(s.seconds, 95.0), s.seconds.back(), percentile(s.cpu_seconds, 50.0),
        percentile(s.cpu_seconds, 95.0), s.cpu_seconds.back());
  if (job.json.empty()) return;
  nlohmann::ordered_json json{{"views", s.views},
                              {"found", s.found},
                              {"within_2cm_1deg", s.good},
                              {"beyond_10cm", s.wrong},
                              {"refused", s.refused},
                              {"places", kept},
                              {"index_seconds", index_s},
                              {"seconds", json_of(s.seconds)},
                              {"cpu_seconds", json_of(s.cpu_seconds)},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const Row& row : rows) json["rows"].push_back(json_of(row));
  write_file_atomically(job.json, json_text(json));
}

}  // namespace

void add_relocalise(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "relocalise", "find single images of a sequence in a map, poses withheld");
  auto job = std::make_shared<RelocaliseJob>();
  add_sequence_flags(command, job->sequence);
  add_map_flags(command, job->map);
  command->add_option("--method", job->method, "gaussian, paper or interpolation");
  command->add_option("--places", job->places, places_help);
  add_number(command, "--views", job->views, {.least = 1}, "random frames to look up");
  add_number(command, "--skip-every", job->skip_every, {.least = 0, .word = "none"},
             "leave out frames 0, N, 2N ... the map was made from; 0 or none: leave out none");
  command
      ->add_option("--without-half", job->map.without_half,
                   "delete the half of the map on that side, and look up frames that showed mostly it")
      ->check(CLI::IsMember({"+x", "-x", "+y", "-y", "+z", "-z"}));
  add_number(command, "--seed", job->seed, {}, "seed of the choice of frames");
  command->add_option("--json", job->json, "report to write (JSON)");
  command->final_callback([&common, job] { run(common, *job); });
}

}  // namespace odosplat::apps
