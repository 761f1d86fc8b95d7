// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "apps/cli/relocalise/camera_watch.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/no_result.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/input/map_views.hpp"
#include "apps/input/places.hpp"
#include "apps/input/public_options.hpp"
#include "apps/input/sequence_flags.hpp"
#include "apps/input/training_frames.hpp"
#include "apps/input/unreadable_frames.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/eval/statistics.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"

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
  int skip_every = skip_as_map_says;
  std::string range;  // "A:B", empty: all
  std::uint64_t seed = 42;
  std::string json;
  std::string out;
  OptionValues options;
};

/// Result of looking up one image.
struct Row {
  std::size_t frame;
  Relocalization answer;
  std::optional<double> error_m;  // none: not found, or no true pose
  std::optional<double> error_deg;
  bool judged;  // whether there is a true pose
  double seconds;
  double cpu_seconds;  // of all threads; unlike wall time it does not depend on other load of the machine
  PoseByCamera pose;   // of a frame that was found
};

/// Whether at least half of the pixels with depth in a view of the whole map belong to the half that is left out.
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

/// Random frames among those that the map was not made from. With --without-half, only frames of which at least half
/// shows the half that is left out.
std::vector<std::size_t> chosen_frames(const Common& common, const Sequence& sequence, const RelocaliseJob& job) {
  const FrameRange range = job.range.empty() ? FrameRange() : parse_frames(job.range);
  std::vector<std::size_t> frames = frames_not_trained_on(sequence, range, job.skip_every, job.map.map);
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

Row look_up(Relocalizer& relocalizer, CameraWatch& watch_camera, const Sequence& sequence, std::size_t i) {
  const GrayImage image = sequence.gray(i);
  const double cpu_start = cpu_seconds();
  const Stopwatch watch;
  Row row{i, relocalizer.find(image), {}, {}, sequence.T_world_camera(i).has_value(), 0.0, 0.0, {}};
  row.seconds = watch.seconds();
  row.cpu_seconds = cpu_seconds() - cpu_start;
  if (row.answer.found) row.pose = watch_camera.add(image, row.answer.T_world_camera);
  return row;
}

/// Refuses the frames whose pose a wrong camera has moved too far, and compares the others with the truth.
void judge(std::vector<Row>& rows, const CameraWatch& watch_camera, const Sequence& sequence) {
  for (Row& row : rows) {
    if (!row.answer.found) continue;
    const std::string fault = watch_camera.fault_of(row.pose);
    if (!fault.empty()) {
      row.answer.found = false;
      row.answer.T_world_camera = SE3();
      row.answer.reason = fault;
      continue;
    }
    const auto truth = sequence.T_world_camera(row.frame);
    if (!truth) continue;
    const SE3 difference = truth->inverse() * row.answer.T_world_camera;
    row.error_m = difference.translation().norm();
    row.error_deg = difference.angle() * 180.0 / std::numbers::pi;
  }
}

struct Summary {
  int views = 0;
  int found = 0;
  int good = 0;
  int wrong = 0;
  int refused = 0;
  int judged = 0;                   // with a true pose, found or not
  std::vector<double> seconds;      // sorted
  std::vector<double> cpu_seconds;  // sorted
};

Summary summarise(const std::vector<Row>& rows) {
  Summary s;
  for (const Row& row : rows) {
    ++s.views;
    ++(row.answer.found ? s.found : s.refused);
    if (row.judged) ++s.judged;
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

// Null if the value is unknown.
nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nullptr;
}

nlohmann::ordered_json json_of(const Row& row, const Sequence& sequence) {
  nlohmann::ordered_json json{{"frame", row.frame},
                              {"time", sequence.time(row.frame)},
                              {"found", row.answer.found},
                              {"T_world_camera", nullptr},
                              {"score", row.answer.score},
                              {"inlier_share", row.answer.inlier_share},
                              {"seconds", row.seconds},
                              {"reason", row.answer.reason},
                              {"error_m", number_or_null(row.error_m)},
                              {"error_deg", number_or_null(row.error_deg)}};
  if (row.answer.found) {
    const Eigen::Vector3d& t = row.answer.T_world_camera.translation();
    const Eigen::Quaterniond& q = row.answer.T_world_camera.rotation();
    json["T_world_camera"] = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
  }
  return json;
}

/// Poses of the frames that were found, in the order of the sequence.
Trajectory found_poses(std::vector<Row> rows, const Sequence& sequence) {
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.frame < b.frame; });
  Trajectory poses;
  for (const Row& row : rows) {
    if (row.answer.found)
      poses.push_back({sequence.time(row.frame), row.answer.T_world_camera, sequence.time_text(row.frame)});
  }
  return poses;
}

void print_found(const Summary& s) {
  if (s.judged == 0) {
    print("%d views: %d found, - of them within %.0f cm and %.0f deg (no true poses to compare with); %d refused\n",
          s.views, s.found, 100.0 * good_m, good_deg, s.refused);
    return;
  }
  print("%d views: %d found, %d of them within %.0f cm and %.0f deg (%.1f %%), %d beyond %.0f cm; %d refused", s.views,
        s.found, s.good, 100.0 * good_m, good_deg, 100.0 * s.good / s.judged, s.wrong, 100.0 * wrong_m, s.refused);
  if (s.judged < s.views) print("; %d without a true pose, not counted as good or wrong", s.views - s.judged);
  print("\n");
}

void write_report(const std::string& file, const Summary& s, const std::vector<Row>& rows, const Sequence& sequence,
                  std::size_t places, double index_s, const std::string& likely_cause, const OptionValues& options) {
  const auto if_judged = [&](int count) { return s.judged > 0 ? nlohmann::ordered_json(count) : nullptr; };
  nlohmann::ordered_json json{{"views", s.views},
                              {"found", s.found},
                              {"with_truth", s.judged},
                              {"within_2cm_1deg", if_judged(s.good)},
                              {"beyond_10cm", if_judged(s.wrong)},
                              {"refused", s.refused},
                              {"camera", likely_cause},
                              {"places", places},
                              {"index_seconds", index_s},
                              {"seconds", json_of(s.seconds)},
                              {"cpu_seconds", json_of(s.cpu_seconds)},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const auto& [name, value] : options.items()) json["options"][name] = std::stod(value);
  for (const Row& row : rows) json["rows"].push_back(json_of(row, sequence));
  write_file_atomically(file, json_text(json));
}

void run(const Common& common, const RelocaliseJob& job) {
  const MadeFolders made = ensure_output_if_given(job.json);
  const MadeFolders made_for_poses = ensure_output_if_given(job.out);
  const Sequence sequence = open_sequence(job.sequence);
  const std::vector<std::size_t> frames = chosen_frames(common, sequence, job);
  const std::vector<SE3> places = places_of(job.map, job.places);
  OpenedView opened = open_view(common, job.method, job.map);
  if (opened.sensor != nullptr) throw InputError("--method", "rgbd has no map to be found in");
  log_info("rendering the map from " + std::to_string(places.size()) + " places");
  const Stopwatch watch;
  RelocalizerOptions options;
  job.options.apply(options);
  Relocalizer relocalizer(sequence.camera(), *opened.view, places, options);
  const std::size_t kept = relocalizer.prepare();
  const double index_s = watch.seconds();
  std::vector<Row> rows;
  CameraWatch watch_camera(sequence.camera(), *opened.view);
  Progress progress("relocalise", static_cast<long>(frames.size()));
  UnreadableFrames unreadable;
  for (const std::size_t i : frames) {
    if (interrupted()) throw Interrupted();
    try {
      rows.push_back(look_up(relocalizer, watch_camera, sequence, i));
    } catch (const InputError& e) {
      unreadable.add(e.what());
    }
    progress.update(static_cast<long>(rows.size() + unreadable.count()));
  }
  progress.finish();
  unreadable.report(frames.size());
  if (opened.device) print_profile(common, *opened.device);
  judge(rows, watch_camera, sequence);
  if (!watch_camera.likely_cause().empty()) {
    log_warning(sequence.name() + ": " + watch_camera.likely_cause() +
                "; poses that this changes by centimetres are refused");
  }
  const Summary s = summarise(rows);
  print("%zu places of %zu, rendered in %.2f s\n", kept, places.size(), index_s);
  print_found(s);
  print("a view: %.3f s (95 %%: %.3f, most: %.3f); CPU of all threads: %.3f s (95 %%: %.3f, most: %.3f)\n",
        percentile(s.seconds, 50.0), percentile(s.seconds, 95.0), s.seconds.back(), percentile(s.cpu_seconds, 50.0),
        percentile(s.cpu_seconds, 95.0), s.cpu_seconds.back());
  if (!job.out.empty()) write_trajectory(job.out, found_poses(rows, sequence));
  if (!job.json.empty())
    write_report(job.json, s, rows, sequence, kept, index_s, watch_camera.likely_cause(), job.options);
  if (s.found == 0) {
    throw NoResult("none of " + std::to_string(s.views) +
                   " images found: the map does not show what they show, or the camera is wrong");
  }
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
  command->add_option("--frames", job->range, frames_help);
  add_skip_every_flag(command, job->skip_every);
  command
      ->add_option("--without-half", job->map.without_half,
                   "delete the half of the map on that side, and look up frames that showed mostly it")
      ->check(CLI::IsMember({"+x", "-x", "+y", "-y", "+z", "-z"}));
  add_number(command, "--seed", job->seed, {}, "seed of the choice of frames");
  command->add_option("--out", job->out, "trajectory of the frames that were found to write (TUM, T_world_camera)");
  command->add_option("--json", job->json,
                      "report to write (JSON): of every frame found or not, T_world_camera (tx ty tz qx qy qz qw), "
                      "score, and the error where the true pose is known");
  auto settings = std::make_shared<std::vector<std::string>>();
  const std::vector<std::string> groups{"relocaliser"};
  add_set_flag(command, *settings, groups);
  command->final_callback([&common, job, settings, groups] {
    job->options = OptionValues(*settings, groups);
    run(common, *job);
  });
}

}  // namespace odosplat::apps
