// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/check/check_report.hpp"

#include <nlohmann/json.hpp>

#include "apps/cli/check/check_camera.hpp"
#include "apps/command/json_text.hpp"

namespace odosplat::apps {
namespace {

using Json = nlohmann::ordered_json;

// Upper limit of a focal length's standard deviation, as a share of the focal length: a less certain estimate is not
// reported.
constexpr double most_focal_sigma = 0.02;

Json or_null(const std::optional<bool>& value) { return value ? Json(*value) : Json(nullptr); }

Json finding(const std::string& part, const std::string& by, const std::optional<bool>& right,
             const std::string& reason) {
  return {{"part", part}, {"by", by}, {"as_declared", or_null(right)}, {"reason", reason}};
}

Json findings_of(const CheckResults& results) {
  Json list = Json::array();
  if (results.conventions) {
    for (const ConventionFinding& f : results.conventions->findings) {
      std::optional<bool> right;
      if (results.conventions->believable && f.decided) right = f.as_declared;
      list.push_back(finding(f.part, "depth", right, f.text));
    }
  }
  if (results.registration) {
    list.push_back(finding("registration", "depth", results.registration->registered, results.registration->text));
  }
  if (results.camera) {
    for (const CameraFinding& f : results.camera->findings) list.push_back(finding(f.part, "depth", f.right, f.text));
  }
  if (results.cloud) {
    for (const CloudFinding& f : results.cloud->findings) list.push_back(finding(f.part, "cloud", f.right, f.text));
  }
  return list;
}

// Depth images show the poses of the depth camera, the cloud those of the colour camera; depth is preferred if both
// decide.
std::optional<bool> poses_inverted(const CheckResults& results) {
  if (results.conventions && results.conventions->believable && results.conventions->findings[1].decided) {
    return results.conventions->winner.inverted;
  }
  if (results.cloud && results.cloud->believable) {
    for (const CloudFinding& f : results.cloud->findings) {
      if (f.part == "poses" && f.right) return results.cloud->winner.inverted;
    }
  }
  return std::nullopt;
}

std::optional<Measured> color_focal(const Sequence& sequence, const CheckResults& results) {
  const double declared = sequence.camera().fx;
  std::optional<Measured> focal;
  if (results.camera && results.camera->measured && results.camera->findings.front().right) {
    focal = results.camera->focal_px(sequence.camera());
    // The comparison of depth edges with image edges does not use the poses.
  } else if (results.registration && results.registration->registered) {
    focal = Measured{declared * results.registration->scale, declared * results.registration->scale_sigma};
  } else if (results.cloud && results.cloud->fit) {
    focal = results.cloud->fit->focal_px;
  }
  if (focal && focal->sigma > most_focal_sigma * declared) focal.reset();
  return focal;
}

Json declared_of(const Sequence& sequence) {
  const Camera& camera = sequence.camera();
  return {{"fx", camera.fx},
          {"fy", sequence.fy_sign() * camera.fy},
          {"poses_inverted", false},
          {"id_shift", 0},
          {"depth_scale", sequence.depth_scale()}};
}

int pairs_of(const CheckResults& results) {
  if (results.conventions) return results.conventions->pairs;
  return results.cloud ? results.cloud->pairs : 0;
}

const char* word_of(CheckAnswer answer) {
  if (answer == CheckAnswer::agree) return "agree";
  return answer == CheckAnswer::differ ? "differ" : "undecided";
}

}  // namespace

CheckAnswer answer_of(const CheckResults& results) {
  bool undecided = false;
  if (results.conventions) {
    if (!results.conventions->as_declared) return CheckAnswer::differ;
  }
  if (results.registration && results.registration->registered == false) return CheckAnswer::differ;
  if (results.camera) {
    for (const CameraFinding& f : results.camera->findings) {
      if (f.right == false) return CheckAnswer::differ;
    }
  }
  if (results.cloud) {
    if (results.cloud->answer == CloudAnswer::differ) return CheckAnswer::differ;
    undecided = results.cloud->answer == CloudAnswer::undecided;
  }
  return undecided ? CheckAnswer::undecided : CheckAnswer::agree;
}

std::string verdict_of(const CheckResults& results) {
  std::string verdict;
  const auto add = [&](const std::string& text) { verdict += (verdict.empty() ? "" : "; ") + text; };
  if (results.conventions) {
    add((results.cloud ? "by depth: " : "") + results.conventions->verdict +
        (results.with_measured_camera ? " with the camera that the images ask for" : ""));
  }
  if (results.registration && results.registration->registered != true) add(results.registration->text);
  if (results.camera && results.camera->measured) add(camera_verdict(*results.camera));
  if (results.cloud) add((results.conventions ? "by the cloud: " : "") + results.cloud->verdict);
  return verdict;
}

std::string check_json(const Sequence& sequence, const CheckResults& results, const std::string& checksum) {
  const std::optional<Measured> focal = color_focal(sequence, results);
  const Json camera =
      results.camera && results.camera->measured ? camera_fit_json(*results.camera, sequence.camera()) : Json(nullptr);
  const Json json{
      {"name", sequence.name()},
      {"layout", sequence.layout()},
      {"frames", sequence.size()},
      {"pairs", pairs_of(results)},
      {"answer", word_of(answer_of(results))},
      {"verdict", verdict_of(results)},
      {"declared", declared_of(sequence)},
      {"color_focal_px", focal ? Json(focal->value) : Json(nullptr)},
      {"color_focal_sigma_px", focal ? Json(focal->sigma) : Json(nullptr)},
      {"depth_registered", results.registration ? or_null(results.registration->registered) : Json(nullptr)},
      {"camera", camera},
      {"time_offset_s",
       camera.is_null() || camera["time_offset_s"].is_null() ? Json(nullptr) : camera["time_offset_s"]["value"]},
      {"poses_inverted", or_null(poses_inverted(results))},
      {"findings", findings_of(results)},
      {"texture_share", results.texture.share},
      {"texture_bare_blocks", results.texture.bare_blocks},
      {"checksum", checksum}};
  return json_text(json);
}

}  // namespace odosplat::apps
