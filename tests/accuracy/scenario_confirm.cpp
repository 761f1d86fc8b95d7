// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "apps/command/interrupt.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/eval/statistics.hpp"
#include "odosplat/odometry/confirm/map_confirmation.hpp"
#include "odosplat/odometry/frame/motion_model.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"
#include "odosplat/odometry/relocalise/place_index.hpp"
#include "tests/accuracy/disturb/disturb_image.hpp"
#include "tests/accuracy/output.hpp"
#include "tests/accuracy/scenarios.hpp"

namespace odosplat::accuracy {
namespace {

constexpr double smoothing = 0.8;  // [px] as in the odometry

struct ConfirmFlags {
  Job job;
  std::vector<std::string> others;
  std::size_t every = 10;
};

enum class Truth { right, near, wrong };

/// Result of comparing an image with the map at an assumed pose.
struct Pair {
  Truth truth = Truth::right;
  MapEvidence evidence;
};

/// Pairs by kind of disturbance.
using Pairs = std::map<std::string, std::vector<Pair>>;

RenderedView seen_from(const Camera& camera, MapView& map, const SE3& T_world_camera) {
  RenderedView view{T_world_camera, map.render(camera, T_world_camera, {true, true})};
  view.gray = gray_of(camera, view.images, smoothing);
  if (view.gray == nullptr) throw InputError(map.name(), "the map has no colours to compare images with");
  return view;
}

/// A view of the map from one pose, with which images are compared.
class Place {
 public:
  Place(const Camera& camera, MapView& map, const SE3& T_world_camera, Pairs& pairs)
      : camera_(camera),
        view_(seen_from(camera, map, T_world_camera)),
        patches_(camera, view_, smoothing, {}),
        pairs_(pairs) {
    PixelSelector selector(SelectorOptions{});
    PixelSelector weak(weak_selector_options());
    const FramePyramid& rendered = view_.gray->pyramid;
    reference_ = build_reference(rendered, build_gradients(rendered), view_.images, selector, {}, {}, &weak);
  }

  /// Compares an image at a known pose relative to the place.
  void compare(const std::string& kind, Truth truth, const GrayImage& image, const SE3& T_place_camera = {}) {
    const FramePyramid pyramid = build_frame_pyramid(camera_, image, smoothing);
    pairs_[kind].push_back({truth, patches_.compare(pyramid, view_.T_world_camera * T_place_camera)});
  }

  /// Compares an image at the pose near this place where it fits best, as found by tracking, start or look-up. Nothing
  /// is added if the alignment fails everywhere.
  void align(const std::string& kind, const GrayImage& image) {
    if (reference_.empty()) return;
    const FramePyramid pyramid = build_frame_pyramid(camera_, image, smoothing);
    std::vector<SE3> guesses{SE3()};
    for (const double angle : {0.04, 0.12}) {
      for (const SE3& turned : rotated_guesses(SE3(), angle)) guesses.push_back(turned);
    }
    const Alignment found = aligner_.align_best(reference_, pyramid, guesses, {});
    if (!found.finished) return;
    compare(kind, Truth::wrong, image, found.T_target_host.inverse());
  }

 private:
  Camera camera_;
  RenderedView view_;
  ViewPatches patches_;
  TrackingReference reference_;
  ImageAligner aligner_{ImageAlignerOptions{}};
  Pairs& pairs_;
};

void compare_frame(const World& world, std::size_t i, Place& place, const std::vector<Sequence>& others) {
  const Camera camera = world.camera();
  const GrayImage own = world.gray(i);
  place.compare("as it is", Truth::right, own);
  place.compare("noise of 0.05", Truth::right, with_noise(own, 0.05, i));
  place.compare("gain of 1.6", Truth::right, with_gain(own, 1.6));
  place.compare("gamma of 0.6", Truth::right, with_gamma(own, 0.6));
  place.compare("blur of 12 px", Truth::right, with_motion_blur(own, {1.0, 0.3}, 12.0));
  for (const double d : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    char kind[32];
    std::snprintf(kind, sizeof(kind), "%.0f mm to the side", 1000.0 * d);
    const SE3 aside(Eigen::Quaterniond::Identity(), {d, 0.0, 0.0});
    place.compare(kind, d > RecoveryBars().wrong_m ? Truth::wrong : Truth::near, own, aside);
  }
  place.align("mirrored", mirrored(own, 1));
  place.align("upside down", mirrored(own, 0));
  place.align("white noise", with_noise(uniform_image(camera, 0.5), 0.3, i));
  for (std::size_t o = 0; o < others.size(); ++o) {
    for (std::size_t k = 0; k < 4; ++k) {
      const GrayImage image = resized_gray(others[o].gray((7 * i + 31 * k) % others[o].size()), camera);
      place.align("foreign " + others[o].name(), image);
      if (k == 0) place.compare("half foreign", Truth::right, with_right_half(own, image));
    }
  }
}

long count(const std::vector<Pair>& pairs, Confirmation verdict) {
  return std::count_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.evidence.verdict == verdict; });
}

void report_kinds(const World& world, const Pairs& all, Output& out) {
  for (const auto& [kind, pairs] : all) {
    std::vector<double> scores;
    std::vector<double> against;
    for (const Pair& pair : pairs) {
      if (pair.evidence.verdict == Confirmation::none) continue;
      scores.push_back(pair.evidence.score);
      against.push_back(pair.evidence.against);
    }
    std::sort(scores.begin(), scores.end());
    std::sort(against.begin(), against.end());
    const Truth truth = pairs.front().truth;
    out.add(Row()
                .text("set", world.name())
                .text("images", kind)
                .text("pose", truth == Truth::right  ? "right"
                              : truth == Truth::near ? "near"
                                                     : "wrong")
                .count("pairs", static_cast<long>(pairs.size()))
                .count("confirmed", count(pairs, Confirmation::confirmed))
                .count("undecided", count(pairs, Confirmation::undecided))
                .count("contradicted", count(pairs, Confirmation::contradicted))
                .count("none", count(pairs, Confirmation::none))
                .number("score_min", scores.empty() ? 0.0 : scores.front(), 3)
                .number("score_median", percentile(scores, 50.0), 3)
                .number("score_max", scores.empty() ? 0.0 : scores.back(), 3)
                .number("against_min", against.empty() ? 0.0 : against.front(), 3)
                .number("against_median", percentile(against, 50.0), 3)
                .number("against_max", against.empty() ? 0.0 : against.back(), 3));
  }
}

/// Precision and recall for different thresholds of the probability for confirmation. Pairs with nearly right poses are
/// ignored.
void report_curve(const World& world, const Pairs& all, Output& out) {
  for (const double least : {0.01, 0.1, 0.5, 0.9, 0.99, 0.999}) {
    long right = 0;
    long right_confirmed = 0;
    long wrong = 0;
    long wrong_confirmed = 0;
    for (const auto& [kind, pairs] : all) {
      for (const Pair& pair : pairs) {
        if (pair.truth == Truth::near) continue;
        const bool confirmed = pair.evidence.verdict != Confirmation::none && pair.evidence.probability >= least;
        (pair.truth == Truth::right ? right : wrong) += 1;
        (pair.truth == Truth::right ? right_confirmed : wrong_confirmed) += confirmed ? 1 : 0;
      }
    }
    const long confirmed = std::max(1L, right_confirmed + wrong_confirmed);
    out.add(Row()
                .text("set", world.name())
                .number("probability", least, 5)
                .number("recall", static_cast<double>(right_confirmed) / static_cast<double>(std::max(1L, right)), 4)
                .number("precision", static_cast<double>(right_confirmed) / static_cast<double>(confirmed), 4)
                .count("wrong_confirmed", wrong_confirmed)
                .count("wrong", wrong));
  }
}

void run_confirm(const apps::Common& common, const ConfirmFlags& flags) {
  Output out(flags.job);
  const World world(flags.job);
  apps::OpenedView opened = apps::open_view(common, flags.job.track.method, flags.job.track.map);
  std::vector<Sequence> others;
  for (const std::string& other : flags.others) others.push_back(Sequence::open(other));
  Pairs pairs;
  for (std::size_t i = 0; i < world.size(); i += flags.every) {
    if (apps::interrupted()) throw Interrupted();
    Place place(world.camera(), *opened.view, world.T_world_camera(i), pairs);
    compare_frame(world, i, place, others);
  }
  report_kinds(world, pairs, out);
  report_curve(world, pairs, out);
  out.write();
}

}  // namespace

void add_confirm(CLI::App& app, apps::Common& common) {
  CLI::App* command = apps::add_command(
      app, common, "confirm",
      "what the map says of right poses (disturbed images too), of poses to the side, and of images of other places, "
      "mirrored and of noise where these fit best: verdicts, scores, and precision and recall over the probability");
  auto flags = std::make_shared<ConfirmFlags>();
  add_job_flags(command, flags->job);
  command->add_option("--other", flags->others, "sequences of other places, shown at this one's size");
  apps::add_number(command, "--every", flags->every, {.least = 1, .most = 1000000}, "every n-th frame");
  command->final_callback([&common, flags] { run_confirm(common, *flags); });
}

}  // namespace odosplat::accuracy
