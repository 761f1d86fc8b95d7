// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace odosplat {

/// Bad input or bad usage, which the user can correct. The message is one line that names the file, the place in it and
/// the fault, for example "camera.yaml: fx: must be positive, is 0". Programs print only what() and exit with 2.
/// Exceptions of other types are internal failures (exit 1).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(without_zeros(message)) {}
  InputError(const std::string& file, const std::string& fault) : InputError(file + ": " + fault) {}
  InputError(const std::string& file, const std::string& place, const std::string& fault)
      : InputError(file + ": " + place + ": " + fault) {}

 private:
  // what() is a C string and would end at the first zero byte, which a damaged file may contain. Zero bytes are
  // therefore written as \x00, as terminal_text.hpp escapes them.
  static std::string without_zeros(std::string text) {
    for (std::size_t at = text.find('\0'); at != std::string::npos; at = text.find('\0', at)) {
      text.replace(at, 1, "\\x00");
    }
    return text;
  }
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
