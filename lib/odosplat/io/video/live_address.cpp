// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/live_address.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>

namespace odosplat {
namespace {

/// Position behind "scheme://"; npos if the text does not begin with one.
std::size_t behind_scheme(const std::string& text) {
  const std::size_t colon = text.find("://");
  if (colon == std::string::npos || colon == 0 || std::isalpha(static_cast<unsigned char>(text[0])) == 0) {
    return std::string::npos;
  }
  const bool scheme = std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  });
  return scheme ? colon + 3 : std::string::npos;
}

bool suggests_a_secret(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* part : {"pass", "pwd", "token", "secret", "key", "auth", "sig", "cred"}) {
    if (name.find(part) != std::string::npos) return true;
  }
  return false;
}

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Masks user:password@. A password may hold characters that belong to the path if it was not escaped; then the @ comes
/// behind the first slash, and what follows the first colon is no port.
std::string without_password(const std::string& text, std::size_t begin) {
  const std::size_t path = std::min(text.find_first_of("/?#", begin), text.size());
  const std::size_t colon = text.find(':', begin);
  if (colon == std::string::npos || colon >= path) return text;
  std::size_t at = text.rfind('@', path);
  if (at == std::string::npos || at < colon) {
    at = text.rfind('@');
    const bool escaped = at == std::string::npos || at < path || is_number(text.substr(colon + 1, path - colon - 1));
    if (escaped) return text;
  }
  return text.substr(0, colon + 1) + "***" + text.substr(at);
}

std::string without_secret_parameters(const std::string& text) {
  std::size_t at = text.find('?');
  if (at == std::string::npos) return text;
  std::string shown = text.substr(0, at + 1);
  for (++at; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("&;", at), text.size());
    const std::size_t equals = text.find('=', at);
    if (equals < end && suggests_a_secret(text.substr(at, equals - at))) {
      shown += text.substr(at, equals + 1 - at) + "***";
    } else {
      shown += text.substr(at, end - at);
    }
    if (end < text.size()) shown += text[end];
    at = end + 1;
  }
  return shown;
}

}  // namespace

LiveKind live_kind(const std::string& source) {
  if (source == "-") return LiveKind::pipe;
  if (behind_scheme(source) != std::string::npos) return LiveKind::network;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(source, error);
  if (std::filesystem::is_fifo(status)) return LiveKind::pipe;
  return std::filesystem::is_character_file(status) ? LiveKind::device : LiveKind::none;
}

std::string shown_address(const std::string& source) {
  const std::size_t begin = behind_scheme(source);
  return begin == std::string::npos ? source : without_secret_parameters(without_password(source, begin));
}

}  // namespace odosplat
