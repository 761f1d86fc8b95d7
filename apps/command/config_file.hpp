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

/// One "key = value" of a file of flags. Numbers and booleans are kept as written. A key within a table is prefixed
/// with the table's name and a dot.
struct ConfigEntry {
  std::string key;
  std::vector<std::string> values;
  bool is_array = false;
  std::size_t line = 0;
};

/// Reads the subset of TOML that flags need: comments, bare and quoted keys, strings in "" (with escapes) and '',
/// numbers, booleans, arrays of these over any number of lines, tables and dotted keys. Other TOML (dates, multi-line
/// strings, inline tables, arrays of tables), a key or table given twice, and text that is not TOML are an InputError
/// naming file and line.
std::vector<ConfigEntry> parse_config(const std::string& file, std::string_view text);

/// Sets the command's flags to the values in the file, except for flags in `words` (the command line), which take
/// precedence. A key with a dot is an option of the library and is passed to the command's --set. InputError naming
/// file, line and key: a key that is no flag of the command (with the nearest one), a value that the flag refuses, an
/// array where one value is expected. To be called before the command line is parsed.
void apply_config(CLI::App& command, const std::vector<std::string>& words, const std::string& file);

}  // namespace odosplat::apps
