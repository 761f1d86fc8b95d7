// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/config_file.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <set>

#include "apps/command/nearest_name.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {
namespace {

bool is_key_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

void append_utf8(std::string& out, std::uint32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
    return;
  }
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  const std::uint32_t lead = more == 1 ? 0xC0 : more == 2 ? 0xE0 : 0xF0;
  out += static_cast<char>(lead | code >> (6 * more));
  for (int i = more - 1; i >= 0; --i) out += static_cast<char>(0x80U | (code >> (6 * i) & 0x3FU));
}

class Reader {
 public:
  Reader(const std::string& file, std::string_view text) : file_(file), text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  std::vector<ConfigEntry> entries() {
    std::vector<ConfigEntry> entries;
    std::set<std::string> seen;
    std::set<std::string> tables;
    for (skip_lines(); !text_.empty(); skip_lines()) {
      if (next() == '[') {
        table_ = table();
        if (!tables.insert(table_).second) fail("the table [" + table_ + "] is given twice");
        if (seen.count(table_) > 0) fail(table_ + " is a value above, it cannot be a table too");
        continue;
      }
      entries.push_back(entry());
      if (!seen.insert(entries.back().key).second) {
        throw InputError(file_, "line " + std::to_string(entries.back().line), entries.back().key + " is given twice");
      }
    }
    return entries;
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(file_, "line " + std::to_string(line_), fault);
  }
  char next() const { return text_.empty() ? '\n' : text_.front(); }
  void take(std::size_t n = 1) { text_.remove_prefix(n); }

  void skip_blanks() {
    while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\t' || text_.starts_with("\r\n"))) take();
  }
  void skip_comment() {
    if (next() == '#') take(std::min(text_.find('\n'), text_.size()));
  }
  void skip_lines() {
    for (skip_blanks(); !text_.empty() && (next() == '\n' || next() == '#'); skip_blanks()) {
      skip_comment();
      if (text_.empty()) return;
      take();
      ++line_;
    }
  }

  /// A key of one or more parts separated by dots; empty if there is none.
  std::string key() {
    std::string whole;
    for (bool more = true; more;) {
      std::string part;
      if (next() == '"' || next() == '\'') {
        part = quoted();
      } else {
        for (; !text_.empty() && is_key_character(text_.front()); take()) part += text_.front();
      }
      if (part.empty()) return "";
      whole += part;
      skip_blanks();
      more = next() == '.';
      if (!more) break;
      whole += '.';
      take();
      skip_blanks();
    }
    return whole;
  }

  /// The name of a table; the entries that follow belong to it.
  std::string table() {
    take();
    if (next() == '[') fail("arrays of tables are not read");
    skip_blanks();
    std::string name = key();
    if (name.empty() || next() != ']') fail("must be [table]");
    take();
    skip_blanks();
    skip_comment();
    if (next() != '\n') fail("there is more behind [" + name + "]");
    return name;
  }

  ConfigEntry entry() {
    ConfigEntry e;
    e.line = line_;
    e.key = key();
    if (e.key.empty() || next() != '=') fail("must be flag = value");
    if (!table_.empty()) e.key = table_ + "." + e.key;
    take();
    skip_blanks();
    if (next() == '[') {
      e.is_array = true;
      e.values = array();
    } else {
      e.values = {value()};
    }
    skip_blanks();
    skip_comment();
    if (next() != '\n') fail(e.key + ": there is more behind its value");
    return e;
  }

  std::vector<std::string> array() {
    std::vector<std::string> values;
    take();
    for (skip_lines(); next() != ']'; skip_lines()) {
      if (text_.empty()) fail("an array has no end");
      values.push_back(value());
      skip_lines();
      if (next() == ',') {
        take();
      } else if (next() != ']') {
        fail("values of an array need a comma between them");
      }
    }
    take();
    return values;
  }

  std::string value() {
    if (next() == '"' || next() == '\'') return quoted();
    std::string word;
    while (!text_.empty() && std::string_view(" \t\r\n,]#").find(text_.front()) == std::string_view::npos) {
      word += text_.front();
      take();
    }
    if (word == "true" || word == "false") return word;
    if (word.starts_with("{")) fail("inline tables are not read");
    const bool number =
        !word.empty() && std::string_view("+-.0123456789in").find(word[0]) != std::string_view::npos &&
        std::all_of(word.begin(), word.end(), [](char c) { return is_key_character(c) || c == '.' || c == '+'; });
    if (!number) fail(word.empty() ? "a value is missing" : "text needs quotes: \"" + word + "\"");
    word.erase(std::remove(word.begin(), word.end(), '_'), word.end());
    return word;
  }

  std::string quoted() {
    const char quote = next();
    if (text_.starts_with(std::string(3, quote))) fail("text over several lines is not read");
    std::string value;
    for (take(); next() != quote; take()) {
      if (text_.empty() || next() == '\n') fail("a text has no closing quote");
      if (quote == '"' && next() == '\\') {
        take();
        append_escape(value);
      } else {
        value += next();
      }
    }
    take();
    return value;
  }

  /// Appends the character that an escape stands for. On entry the character after the backslash is next; the escape's
  /// last character is left for the caller to take.
  void append_escape(std::string& value) {
    constexpr std::string_view names = "btnfr\"\\";
    constexpr std::string_view meanings = "\b\t\n\f\r\"\\";
    if (const std::size_t i = names.find(next()); i != std::string_view::npos) {
      value += meanings[i];
      return;
    }
    const std::size_t digits = next() == 'u' ? 4 : next() == 'U' ? 8 : 0;
    std::uint32_t code = 0;
    const char* begin = text_.data() + 1;
    const bool whole =
        digits > 0 && text_.size() > digits && std::from_chars(begin, begin + digits, code, 16).ptr == begin + digits;
    if (!whole || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) fail("a text has an unknown escape");
    append_utf8(value, code);
    take(digits);
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t line_ = 1;
  std::string table_;  // table of the current entries; empty: none
};

std::vector<std::string> flags_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

bool given(const std::vector<std::string>& words, const std::string& key) {
  const std::string flag = "--" + key;
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return word == flag || word.starts_with(flag + "="); });
}

// Whether the command line sets the option of that name: --set NAME=VALUE or --set=NAME=VALUE.
bool set_by(const std::vector<std::string>& words, const std::string& name) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return word.starts_with(name + "=") || word.starts_with("--set=" + name + "=");
  });
}

void set_option(CLI::Option& option, const ConfigEntry& entry) {
  const bool is_switch = option.get_items_expected_max() == 0;
  if (is_switch && (entry.is_array || (entry.values[0] != "true" && entry.values[0] != "false"))) {
    throw CLI::ValidationError("--" + entry.key, "must be true or false");
  }
  // A flag that may be given several times takes an array, one value for each time.
  const bool repeats = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  if (entry.is_array && option.get_items_expected_max() == 1 && !repeats) {
    throw CLI::ValidationError("--" + entry.key, "takes one value, not an array");
  }
  const int count = static_cast<int>(entry.values.size());
  if (!is_switch &&
      (count < option.get_items_expected_min() || (count > option.get_items_expected_max() && !repeats))) {
    throw CLI::ValidationError("--" + entry.key, "does not take " + std::to_string(count) + " values");
  }
  option.add_result(entry.values);
  option.run_callback();
}

}  // namespace

std::vector<ConfigEntry> parse_config(const std::string& file, std::string_view text) {
  return Reader(file, text).entries();
}

void apply_config(CLI::App& command, const std::vector<std::string>& words, const std::string& file) {
  for (ConfigEntry entry : parse_config(file, read_file(file))) {
    const std::string line = "line " + std::to_string(entry.line);
    if (entry.key == "set") throw InputError(file, line, "set is for the command line; write NAME = VALUE");
    const std::string written = entry.key;
    if (entry.key.find('.') != std::string::npos) {  // an option of the library: belongs to --set
      if (set_by(words, entry.key)) continue;
      if (command.get_option_no_throw("--set") == nullptr) {
        throw InputError(file, line, "unknown key " + entry.key + ": this command has no options to set");
      }
      if (entry.is_array) throw InputError(file, line, entry.key + ": takes one value, not an array");
      entry.values = {entry.key + "=" + entry.values[0]};
      entry.key = "set";
    }
    CLI::Option* option = command.get_option_no_throw("--" + entry.key);
    if (option == nullptr || entry.key == "config" || entry.key == "help") {
      const bool known = option != nullptr;
      throw InputError(file, line,
                       known ? "--" + entry.key + " is for the command line alone"
                             : "unknown key " + entry.key + suggestion(nearest_name(entry.key, flags_of(command))));
    }
    if (entry.key != "set" && given(words, entry.key)) continue;
    try {
      set_option(*option, entry);
    } catch (const CLI::ParseError& e) {
      if (written == entry.key) throw InputError(file, line, e.what());
      const std::string last = written.substr(written.rfind('.') + 1);
      const bool is_flag = command.get_option_no_throw("--" + last) != nullptr;
      std::string fault = e.what();
      if (fault.starts_with("--set: ")) fault = fault.substr(7);
      throw InputError(file, line, fault + (is_flag ? "; flags stand above the first [table]" : ""));
    }
  }
}

}  // namespace odosplat::apps
