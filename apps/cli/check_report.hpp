// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>

#include "odosplat/cloud/check/cloud_check.hpp"
#include "odosplat/eval/convention_check.hpp"
#include "odosplat/eval/registration_check.hpp"
#include "odosplat/eval/texture.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// What `odosplat check` found out; none: not asked, or nothing to ask by.
struct CheckResults {
  std::optional<ConventionReport> conventions;     // by depth images
  std::optional<RegistrationReport> registration;  // by depth images
  std::optional<CloudCheckReport> cloud;
  TextureSummary texture;
};

/// What all of it comes to. differ: something is found to differ, or nothing fits. undecided: nothing is, but the data
/// do not show that they agree.
enum class CheckAnswer { agree, differ, undecided };

CheckAnswer answer_of(const CheckResults& results);

/// One line of all verdicts.
std::string verdict_of(const CheckResults& results);

/// The content of --json. checksum: of the sequence's data.
std::string check_json(const Sequence& sequence, const CheckResults& results, const std::string& checksum);

}  // namespace odosplat::apps
