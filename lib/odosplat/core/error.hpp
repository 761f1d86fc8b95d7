// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <stdexcept>
#include <string>

#include "odosplat/core/terminal_text.hpp"

namespace odosplat {

/// Bad input or bad usage, which the user can correct. The message is one line that names the file, the place in it and
/// the fault, for example "camera.yaml: fx: must be positive, is 0"; what it quotes of a damaged file is escaped
/// (escaped_line), so that neither a line end nor a zero byte ends it. Programs print only what() and exit with 2.
/// Exceptions of other types are internal failures (exit 1).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(escaped_line(message)) {}
  InputError(const std::string& file, const std::string& fault) : InputError(file + ": " + fault) {}
  InputError(const std::string& file, const std::string& place, const std::string& fault)
      : InputError(file + ": " + place + ": " + fault) {}
};

/// The user asked to stop (Ctrl-C); programs exit with 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Throws InputError("NAME: must be FAULT") unless ok. Used by check() of option structs.
inline void require(bool ok, const std::string& name, const std::string& fault) {
  if (!ok) throw InputError(name, "must be " + fault);
}

}  // namespace odosplat
