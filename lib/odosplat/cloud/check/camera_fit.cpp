// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/camera_fit.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/cloud/check/camera_solver.hpp"
#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

using StateVector = CameraState::Vector;

constexpr int least_pairs = 8;
constexpr int unknown_count = CameraState::size;
// Standard deviations before any image is compared, in the vector's order: focal length, principal point (as shares of
// the focal length), radial distortion, readout [s], depth factor, time offset [s].
const StateVector camera_prior{0.2, 0.05, 0.05, 0.2, 0.03, 0.1, 0.1};
// A value is not determined if its sigma is more than this share of the prior's.
constexpr double determined_share = 0.3;
// Floors of the sigmas: errors of patches and planes that more patches do not reduce.
const StateVector sigma_floor{0.0015, 0.001, 0.001, 0.002, 0.001, 0.002, 0.001};
constexpr double held_deviation = 1e-7;  // prior of what stays as declared
constexpr int most_rounds = 8;           // per stage
constexpr double settled_sigmas = 0.25;  // a step of less than this ends a stage
constexpr double most_pose_m = 0.09;     // noise of the poses beyond which the camera cannot be told from it
constexpr double most_pose_rad = 0.09;

// From small to large motions between the images, so that patches stay within the search radius of a wrong camera.
struct MotionStage {
  double motion;  // as a share of the image's width
  int pairs;
};

std::array<MotionStage, 4> stages_of(const CameraFitOptions& options) {
  const int few = std::max(2 * least_pairs, options.pairs / 2);
  return {{{0.03, few}, {0.06, few}, {0.12, options.pairs}, {0.2, options.pairs}}};
}

bool measure(const CameraFitInput& input, const PosesOverTime& poses, const StateVector& state,
             std::vector<PairPart>& parts) {
  for (PairPart& part : parts) {
    part.equations = camera_equations(input, poses, CameraState::from(state), part.pair);
    part.change.setZero();
  }
  std::erase_if(parts, [](const PairPart& part) { return part.equations.empty(); });
  return parts.size() >= static_cast<std::size_t>(least_pairs);
}

StateVector sigma_of(const CameraStep& last, const std::array<Estimated, unknown_count>& estimated) {
  StateVector sigma = StateVector::Zero();
  for (int k = 0; k < unknown_count; ++k) {
    if (estimated[static_cast<std::size_t>(k)] != Estimated::yes) continue;
    std::vector<double> without;
    for (const StateVector& value : last.without) without.push_back(value[k]);
    sigma[k] = with_sigma(0.0, std::sqrt(last.covariance(k, k)), sigma_floor[k], without).sigma;
  }
  return sigma;
}

bool settled(const CameraStep& step, const StateVector& sigma) {
  return (step.value.cwiseAbs().array() <= settled_sigmas * sigma.array()).all();
}

/// The state of the fit after its last stage.
struct FitRun {
  std::string failure;  // empty: none
  std::vector<PairPart> parts;
  StateVector total = StateVector::Zero();
  CameraStep last;
};

FitRun run_stages(const CameraFitInput& input, const PosesOverTime& poses, const CameraFitOptions& options,
                  const std::array<Estimated, unknown_count>& estimated) {
  StateVector prior;
  for (int k = 0; k < unknown_count; ++k) {
    const bool free = estimated[static_cast<std::size_t>(k)] == Estimated::yes;
    prior[k] = 1.0 / std::pow(free ? camera_prior[k] : held_deviation, 2);
  }
  FitRun run;
  const std::array<MotionStage, 4> stages = stages_of(options);
  double work = 0.0;
  double done = 0.0;
  for (const MotionStage& stage : stages) work += stage.pairs;
  for (const MotionStage& stage : stages) {
    if (input.progress) input.progress(done / work);
    done += stage.pairs;
    std::vector<PairPart> parts;
    for (const CameraPair& pair : camera_pairs(input, poses, CameraState::from(run.total), stage.motion, stage.pairs)) {
      parts.emplace_back();
      parts.back().pair = pair;
    }
    // So much motion is not there: what was found with less of it counts.
    if (parts.size() < static_cast<std::size_t>(least_pairs)) break;
    bool ends = false;
    for (int round = 0; round < most_rounds && !ends; ++round) {
      if (!measure(input, poses, run.total, parts)) {
        run.failure = "too few patches are found again in other images";
        return run;
      }
      run.last = solve_camera(parts, prior, run.total);
      for (int k = 0; k < unknown_count; ++k) {
        if (estimated[static_cast<std::size_t>(k)] != Estimated::yes) run.last.value[k] = 0.0;
      }
      run.total += run.last.value;
      for (PairPart& part : parts) part.pair.T_to_given = SE3::exp(part.change) * part.pair.T_to_given;
      ends = settled(run.last, sigma_of(run.last, estimated));
    }
    run.parts = std::move(parts);
  }
  if (run.parts.empty()) {
    run.failure = "too few images with depth and texture see the same places from different ones";
  } else if (!measure(input, poses, run.total, run.parts)) {
    run.failure = "too few patches are found again in other images";
  } else if (run.last.noise.meters > most_pose_m || run.last.noise.radians > most_pose_rad) {
    run.failure = "the poses are off by too much";
  }
  return run;
}

/// Distances before and after, from the measurements at the final state.
void set_errors(CameraFit& fit, const FitRun& run) {
  std::vector<Vector6d> none;
  std::vector<Vector6d> given;
  for (const PairPart& part : run.parts) {
    none.emplace_back(Vector6d::Zero());
    given.emplace_back(-part.pair.T_to_given.log());
    fit.distances += static_cast<int>(part.equations.size());
  }
  fit.pairs = static_cast<int>(run.parts.size());
  fit.error_after_px = median_distance(run.parts, StateVector::Zero(), none);
  fit.error_poses_px = median_distance(run.parts, StateVector::Zero(), given);
  fit.error_before_px = median_distance(run.parts, -run.total, given);
}

/// Whether values are as declared, from their differences, sigmas and tolerances.
class Judge {
 public:
  Judge(CameraFit& fit, double sure) : fit_(fit), sure_(sure) {}

  void add(const char* part, const std::vector<int>& places, double tolerance, const std::string& wrong) {
    CameraFinding finding{part, true, ""};
    bool held = true;
    bool differs = false;
    for (const int k : places) {
      const Estimated estimated = fit_.estimated[static_cast<std::size_t>(k)];
      held = held && estimated == Estimated::held;
      const double departure = std::abs(fit_.state.vector()[k]);
      differs = differs || (departure > tolerance && departure > sure_ * fit_.sigma[k]);
      if (estimated == Estimated::open || sure_ * fit_.sigma[k] > 3.0 * tolerance) finding.right.reset();
    }
    if (held) return;
    if (differs) finding.right = false;
    if (differs) finding.text = std::string(part) + ": " + wrong;
    if (!finding.right) finding.text = std::string(part) + ": the images do not determine it";
    fit_.findings.push_back(std::move(finding));
  }

 private:
  CameraFit& fit_;
  double sure_;
};

double corner_reach(const Camera& camera) {
  const double radius = 0.5 * std::hypot(camera.width / camera.fx, camera.height / camera.fy);
  return camera.fx * radius * radius * radius;
}

void judge(CameraFit& fit, const Camera& camera, const CameraFitOptions& o) {
  Judge judge(fit, o.sure);
  const Measured focal = fit.focal_px(camera);
  judge.add("focal length", {CameraState::at_focal}, o.focal_tolerance,
            formatted("the images want %.2f +- %.2f px, the files say %.2f", focal.value, focal.sigma, camera.fx));
  const Measured u = fit.center_u_px(camera);
  const Measured v = fit.center_v_px(camera);
  judge.add("principal point", {CameraState::at_center_u, CameraState::at_center_v},
            o.center_tolerance * camera.width / camera.fx,
            formatted("the images want %.1f +- %.1f, %.1f +- %.1f px, the files say %.1f, %.1f", u.value, u.sigma,
                      v.value, v.sigma, camera.cx, camera.cy));
  const Measured corner = fit.corner_shift_px(camera);
  judge.add("distortion", {CameraState::at_radial}, o.radial_tolerance * camera.width / corner_reach(camera),
            formatted("the images are distorted by %.1f +- %.1f px in the corners beyond what the files say",
                      corner.value, corner.sigma));
  const Measured factor = fit.depth_factor();
  judge.add(
      "depth scale", {CameraState::at_depth_factor}, o.depth_tolerance,
      formatted("depth is to be multiplied by %.3f +- %.3f to have the unit of the poses", factor.value, factor.sigma));
  const double offset = fit.state.time_offset;
  judge.add("time offset", {CameraState::at_time_offset}, o.time_tolerance,
            formatted("the images were taken %.1f +- %.1f ms %s the times of their poses", 1000.0 * std::abs(offset),
                      1000.0 * fit.sigma[CameraState::at_time_offset], offset > 0.0 ? "after" : "before"));
}

}  // namespace

void CameraFitOptions::check() const {
  require(pairs >= 2 * least_pairs, "pairs", "at least 16");
  require(focal_tolerance >= 0.0 && center_tolerance >= 0.0 && radial_tolerance >= 0.0 && depth_tolerance >= 0.0 &&
              time_tolerance >= 0.0,
          "tolerances", "at least 0");
  require(sure > 0.0, "sure", "positive");
}

Measured CameraFit::focal_px(const Camera& camera) const {
  return {camera.fx * (1.0 + state.camera.focal), camera.fx * sigma[CameraState::at_focal]};
}
Measured CameraFit::center_u_px(const Camera& camera) const {
  return {camera.cx + camera.fx * state.camera.center_u, camera.fx * sigma[CameraState::at_center_u]};
}
Measured CameraFit::center_v_px(const Camera& camera) const {
  return {camera.cy + camera.fy * state.camera.center_v, camera.fy * sigma[CameraState::at_center_v]};
}
Measured CameraFit::corner_shift_px(const Camera& camera) const {
  return {state.camera.radial * corner_reach(camera), sigma[CameraState::at_radial] * corner_reach(camera)};
}
Measured CameraFit::readout_s(const Camera& camera) const {
  return {camera.readout + state.camera.readout, sigma[CameraState::at_readout]};
}
Measured CameraFit::depth_factor() const {
  const double factor = std::exp(state.depth_factor);
  return {factor, factor * sigma[CameraState::at_depth_factor]};
}

CameraFit fit_camera(const CameraFitInput& input, const Camera& declared, const CameraFitOptions& options) {
  options.check();
  const PosesOverTime poses(input);
  CameraFit fit;
  const bool wanted[unknown_count] = {options.focal,   options.center,      options.center,     options.distortion,
                                      options.readout, options.depth_scale, options.time_offset};
  for (std::size_t k = 0; k < fit.estimated.size(); ++k) {
    fit.estimated[k] = wanted[k] ? Estimated::yes : Estimated::held;
  }
  for (;;) {
    const FitRun run = run_stages(input, poses, options, fit.estimated);
    fit.reason = run.failure;
    if (!run.failure.empty()) return fit;
    fit.sigma = sigma_of(run.last, fit.estimated);
    const StateVector shares = fit.sigma.cwiseQuotient(camera_prior);
    int worst = 0;
    if (shares.maxCoeff(&worst) > determined_share) {
      fit.estimated[static_cast<std::size_t>(worst)] = Estimated::open;
      continue;
    }
    fit.state = CameraState::from(run.total);
    if (!settled(run.last, fit.sigma)) {
      fit.reason = "the estimate does not settle";
      return fit;
    }
    fit.measured = true;
    fit.pose_error_m = run.last.noise.meters;
    fit.pose_error_deg = degrees_per_radian * run.last.noise.radians;
    set_errors(fit, run);
    judge(fit, declared, options);
    return fit;
  }
}

}  // namespace odosplat
