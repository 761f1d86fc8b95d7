// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// One "key = value" of a file of flags. Numbers and booleans are kept as written. The keys of a table have its name
/// and a dot before them.
struct ConfigEntry {
  std::string key;
  std::vector<std::string> values;
  bool is_array = false;
  std::size_t line = 0;
};

/// Reads the part of TOML that flags need: comments, bare and quoted keys, strings in "" (with escapes) and '',
/// numbers, booleans, arrays of these over any number of lines, tables and dotted keys. Everything else (dates, strings
/// over several lines, inline tables, arrays of tables), a key or table given twice, and what is no TOML is an
/// InputError naming file and line.
std::vector<ConfigEntry> parse_config(const std::string& file, std::string_view text);

/// Gives the command's flags the values that the file has for them, but for those that `words` (the command line)
/// holds: they win. A key with a dot is an option of the library and goes to the command's --set. InputError naming
/// file, line and key: a key that is no flag of the command (with the nearest one), a value that the flag refuses, an
/// array where one value is wanted. To be called before the command line is parsed.
void apply_config(CLI::App& command, const std::vector<std::string>& words, const std::string& file);

}  // namespace odosplat::apps
