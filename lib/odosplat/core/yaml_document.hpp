// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <optional>
#include <sstream>
#include <string>

#include "odosplat/core/terminal_text.hpp"

namespace odosplat {
namespace detail {

/// Notes whether a document holds anything.
class YamlContent : public YAML::EventHandler {
 public:
  bool any = false;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override { any = true; }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override { any = true; }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    any = true;
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    any = true;
  }
  void OnMapEnd() override {}
};

}  // namespace detail

/// The document of a YAML text (null if it is empty), or none if there are several; empty ones after it do not count.
/// Throws YAML::Exception for what is no YAML. Used in place of YAML::Load, which ignores further documents without an
/// error, and of YAML::LoadAll, which does not return for some texts (", 0,8") and takes all memory.
inline std::optional<YAML::Node> single_yaml_document(const std::string& text) {
  constexpr int most_documents = 16;  // empty ones included, which the parser may find without end
  std::istringstream in(text);
  YAML::Parser parser(in);
  detail::YamlContent content;
  for (int k = 0; parser.HandleNextDocument(content); ++k) {
    if (k == most_documents || (k > 0 && content.any)) return std::nullopt;
    content.any = false;
  }
  return YAML::Load(text);
}

/// The start of a key, or of the parser's message, for an InputError: at most 80 bytes.
inline std::string yaml_excerpt(const std::string& text) { return std::string(cut_to_bytes(text, 80)); }

}  // namespace odosplat
