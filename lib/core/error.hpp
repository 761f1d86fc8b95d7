// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <stdexcept>
#include <string>

namespace odosplat {

/// Bad input or bad usage: the user can mend it. One line that names the file, the place in it and the fault, as in
/// "camera.yaml: fx: must be positive, is 0". Programs print what() alone and exit with 2.
/// Every other exception is an internal failure (exit 1).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const std::string& file, const std::string& fault) : std::runtime_error(file + ": " + fault) {}
  InputError(const std::string& file, const std::string& place, const std::string& fault)
      : std::runtime_error(file + ": " + place + ": " + fault) {}
};

/// The user asked to stop (Ctrl-C); programs exit with 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Throws InputError("NAME: must be FAULT") unless ok. For check() of option structs.
inline void require(bool ok, const std::string& name, const std::string& fault) {
  if (!ok) throw InputError(name, "must be " + fault);
}

}  // namespace odosplat
