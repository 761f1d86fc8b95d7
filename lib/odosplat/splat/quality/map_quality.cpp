// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/map_quality.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat {

namespace {

// Chosen, not fitted: well below what maps of real rooms reach.
constexpr double least_psnr_db = 20.0;
constexpr double most_depth_share = 0.03;
// Images that are unrelated to the points: another place or wrong poses, rather than a wrong camera.
constexpr double no_relation = 0.7;
constexpr int least_images = 3;
constexpr double short_share = 0.5;  // of the preset's iterations
constexpr double most_odd_share = 0.2;
constexpr double most_unseen_share = 0.9;

template <typename Member>
std::vector<double> known(const std::vector<ViewQuality>& views, Member member) {
  std::vector<double> values;
  for (const ViewQuality& view : views)
    if (view.*member >= 0.0) values.push_back(view.*member);
  return values;
}

/// 1.4826 times the median distance from the median.
double robust_deviation(std::vector<double> values, double middle) {
  for (double& value : values) value = std::abs(value - middle);
  return 1.4826 * upper_median(std::move(values), -1.0);
}

}  // namespace

void mark_odd(std::vector<ViewQuality>& views) {
  constexpr double deviations = 5.0;
  constexpr double least_fall_db = 4.0;
  constexpr double least_factor = 3.0;
  std::vector<double> psnr;
  psnr.reserve(views.size());
  for (const ViewQuality& view : views) psnr.push_back(view.psnr_db);
  const double usual_psnr = upper_median(psnr, -1.0);
  const double fall = std::max(least_fall_db, deviations * robust_deviation(psnr, usual_psnr));
  const std::vector<double> depth = known(views, &ViewQuality::depth_error_share);
  const double usual_depth = upper_median(depth, -1.0);
  const double most_depth =
      std::max(least_factor * usual_depth, usual_depth + deviations * robust_deviation(depth, usual_depth));
  for (ViewQuality& view : views)
    view.odd = !(view.psnr_db >= usual_psnr - fall) || (!depth.empty() && view.depth_error_share > most_depth);
}

namespace {

struct Judgement {
  bool inconsistent = false;
  bool unlike = false;  // low PSNR, or depth off the cloud's
  bool odd = false;
  bool unseen = false;
  std::string faults;

  void add(const std::string& fault) { faults += (faults.empty() ? "" : ", ") + fault; }
};

std::string likely_cause(const MapQuality& q, const Judgement& j, const std::optional<GeometryDoubt>& doubt,
                         const TrainingEvidence& t) {
  std::string causes;
  const auto add = [&](const std::string& cause) { causes += (causes.empty() ? "" : "; or ") + cause; };
  if (doubt) {
    add(doubt->hypothesis.words());
  } else if (j.inconsistent && q.consistency > no_relation) {
    add("a cloud of another place, a rotated cloud, or poses of other images");
  } else if (j.inconsistent) {
    add("the calibration of another camera, depth that is not registered to colour, a rotated or shifted cloud, or "
        "wrong poses");
  }
  // A short training does not make images disagree with a cloud.
  const bool of_training = j.unlike && !j.inconsistent && !j.unseen;
  const bool cut_short = t.iterations >= 0 && t.iterations < short_share * t.usual_iterations;
  if (of_training && cut_short) {
    add("training stopped after " + std::to_string(t.iterations) + " of the preset's " +
        std::to_string(t.usual_iterations) + " iterations");
  }
  if (of_training && t.budget > 0 && t.gaussians >= t.budget && t.budget < t.points) {
    add("a budget of " + std::to_string(t.budget) + " Gaussians for a cloud of " + std::to_string(t.points) +
        " points");
  }
  if (j.odd) add("wrong poses of those images, or things that moved");
  if (j.unseen) add("most of the cloud lies outside the images");
  return causes.empty() ? "; cause unknown: the images show no error of cloud, poses or camera"
                        : "; likely cause: " + causes;
}

std::string count_of(int images) { return std::to_string(images) + (images == 1 ? " image" : " images"); }

}  // namespace

MapQuality judge_map(const std::vector<ViewQuality>& views, const CloudCoverage& coverage, double consistency,
                     const std::optional<GeometryDoubt>& doubt, const TrainingEvidence& training) {
  MapQuality q;
  std::vector<double> psnr;
  psnr.reserve(views.size());
  for (const ViewQuality& view : views) psnr.push_back(view.psnr_db);
  q.psnr_db = upper_median(psnr, -1.0);
  q.depth_error_m = upper_median(known(views, &ViewQuality::depth_error_m), -1.0);
  q.depth_error_share = upper_median(known(views, &ViewQuality::depth_error_share), -1.0);
  q.images = static_cast<int>(views.size());
  q.odd_images =
      static_cast<int>(std::count_if(views.begin(), views.end(), [](const ViewQuality& v) { return v.odd; }));
  q.coverage = coverage;
  q.consistency = consistency;

  const std::string decibels = formatted("%.1f dB", q.psnr_db) + " on the " + count_of(q.images) + " it was trained on";
  Judgement j;
  j.inconsistent = doubt || consistency > most_unexplained;
  j.unlike = !(q.psnr_db >= least_psnr_db) || q.depth_error_share > most_depth_share;
  j.odd = q.odd_images > most_odd_share * q.images;
  j.unseen = coverage.unseen_share > most_unseen_share;
  if (!(q.psnr_db >= least_psnr_db)) j.add("only " + decibels);
  if (j.inconsistent)
    j.add("the images disagree on the colours of the cloud's points (" + formatted("%.0f %%", 100.0 * consistency) +
          " of the variance)");
  if (q.depth_error_share > most_depth_share)
    j.add("its depth is " + formatted("%.1f %%", 100.0 * q.depth_error_share) + " off the cloud's");
  if (j.odd) j.add(std::to_string(q.odd_images) + " of " + count_of(q.images) + " disagree with the rest");
  if (j.unseen) j.add("no image sees " + formatted("%.0f %%", 100.0 * coverage.unseen_share) + " of the cloud");
  if (!j.faults.empty() && training.iterations != 0) {
    q.verdict = "doubtful: " + j.faults + likely_cause(q, j, doubt, training);
    return q;
  }
  if (training.iterations == 0) {
    q.verdict = "not judged: no step of training was done (" + formatted("%.1f dB", q.psnr_db) + " on " +
                count_of(q.images) + ")";
    if (j.inconsistent) q.verdict += likely_cause(q, j, doubt, {});
    return q;
  }
  if (q.images < least_images) {
    q.verdict = "not judged: it was trained on " + count_of(q.images) + " only, which a map of any geometry can fit (" +
                formatted("%.1f dB", q.psnr_db) + ")";
    return q;
  }
  q.good = true;
  q.verdict = "good: " + decibels;
  if (q.depth_error_m >= 0.0)
    q.verdict += ", depth within " + formatted("%.1f mm", 1000.0 * q.depth_error_m) + " of the cloud's";
  if (q.odd_images > 0)
    q.verdict +=
        ", but " + std::to_string(q.odd_images) + " of " + std::to_string(q.images) + " images disagree with the rest";
  if (coverage.unseen_share > 0.1)
    q.verdict += ", but no image sees " + formatted("%.0f %%", 100.0 * coverage.unseen_share) + " of the cloud";
  return q;
}

}  // namespace odosplat
