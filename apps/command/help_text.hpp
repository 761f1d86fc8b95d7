// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace odosplat::apps {

/// Group of the flags that every subcommand takes; help shows it last.
inline constexpr const char* common_group = "Common flags";

/// Text of --help in lines of at most 80 columns: usage with everything that is required, arguments, the command's own
/// flags (required ones first and marked), the common flags last, each with its default value.
class HelpText : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// Wraps text at blanks into lines of at most `width` columns, each indented by `indent` blanks. A longer word has a
/// line of its own. Line ends in the text are kept.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace odosplat::apps
