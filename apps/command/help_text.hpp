// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace odosplat::apps {

/// Group of the flags that every subcommand takes; help shows it last.
inline constexpr const char* common_group = "Common flags";

/// What --help prints, in lines of at most 80 columns: usage with everything that is required, arguments, the command's
/// own flags (required ones first and marked), the common flags last; each with its default as a value.
class HelpText : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// Text in lines of at most `width` columns, broken at blanks, each behind `indent` blanks; a word that is longer has a
/// line of its own. Line ends in the text stay.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width);

}  // namespace odosplat::apps
