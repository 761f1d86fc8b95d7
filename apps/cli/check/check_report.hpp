// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>

#include "odosplat/cloud/check/camera_fit.hpp"
#include "odosplat/cloud/check/cloud_check.hpp"
#include "odosplat/eval/convention_check.hpp"
#include "odosplat/eval/registration_check.hpp"
#include "odosplat/eval/texture.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Results of `odosplat check`; an empty result: not requested, or the sequence has no data for it.
struct CheckResults {
  std::optional<ConventionReport> conventions;     // by depth images
  std::optional<RegistrationReport> registration;  // by depth images
  std::optional<CameraFit> camera;                 // by depth images
  bool with_measured_camera = false;               // conventions are judged with that camera, not the declared one
  std::optional<CloudCheckReport> cloud;
  TextureSummary texture;
};

/// Overall result.
/// differ: a difference is found, or no hypothesis fits the data
/// undecided: no difference is found, but the data do not show that they agree
enum class CheckAnswer { agree, differ, undecided };

CheckAnswer answer_of(const CheckResults& results);

/// One line of all verdicts.
std::string verdict_of(const CheckResults& results);

/// The content of the file for --json. checksum: of the sequence's data.
std::string check_json(const Sequence& sequence, const CheckResults& results, const std::string& checksum);

}  // namespace odosplat::apps
