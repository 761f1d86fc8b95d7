// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/help_text.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <vector>

#include "odosplat/core/terminal_text.hpp"

namespace odosplat::apps {
namespace {

constexpr std::size_t page_width = 80;
constexpr std::size_t text_column = 24;

using Options = std::vector<const CLI::Option*>;

std::size_t columns(const std::string& text) { return static_cast<std::size_t>(text_columns(text)); }

bool is_switch(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// Placeholder for a flag's value: "FILE", "N", "X ...".
std::string value_words(const CLI::Option& option) {
  if (is_switch(option)) return "";
  // CLI11 appends the list of allowed values to the type; the help text already names them.
  std::string type = option.get_type_name();
  type = type.substr(0, type.find(":{"));
  const int least = option.get_items_expected_min();
  std::string words = type;
  for (int i = 1; i < least; ++i) words += " " + type;
  return option.get_items_expected_max() > least ? words + "..." : words;
}

std::string name_of(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true) + (option.get_items_expected_max() > 1 ? "..." : "");
  std::string name;
  for (const std::string& s : option.get_snames()) name += (name.empty() ? "-" : ", -") + s;
  for (const std::string& l : option.get_lnames()) name += (name.empty() ? "--" : ", --") + l;
  const std::string value = value_words(option);
  return value.empty() ? name : name + " " + value;
}

std::string row(const std::string& name, const std::string& words) {
  const std::string text = wrapped(words, text_column, page_width);
  const std::string start = "  " + name;
  if (columns(start) + 2 > text_column) return start + "\n" + text;
  return start + text.substr(columns(start));
}

std::string row(const CLI::Option& option) {
  std::string words = option.get_description();
  const std::string standard = option.get_default_str();
  if (option.get_required()) {
    words += " (required)";
  } else if (!is_switch(option) && !standard.empty() && standard != "[]" && standard != "{}") {
    words += " (default: " + standard + ")";
  }
  return row(name_of(option), words);
}

std::string section(const std::string& title, const Options& options) {
  if (options.empty()) return "";
  std::string text = "\n" + title + ":\n";
  for (const CLI::Option* option : options) text += row(*option);
  return text;
}

/// The command's full name, such as "odosplat view map".
std::string path_of(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : path_of(*app.get_parent()) + " " + app.get_name();
}

std::string usage(const CLI::App& app, const Options& arguments, const Options& flags, bool has_commands) {
  std::string text = "Usage: " + path_of(app);
  if (has_commands) return text + " COMMAND ...\n";
  for (const CLI::Option* argument : arguments) {
    text += argument->get_required() ? " " + name_of(*argument) : " [" + name_of(*argument) + "]";
  }
  for (const CLI::Option* flag : flags) {
    if (flag->get_required()) text += " " + name_of(*flag);
  }
  const std::string lines = wrapped(text + " [flags]", 2, page_width);
  return lines.substr(2);
}

std::string commands_of(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    text += row(command->get_name(), command->get_description());
  }
  return text.empty() ? "" : "\nCommands:\n" + text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string current(indent, ' ');
    bool fresh = true;
    for (std::string word; words >> word;) {
      if (!fresh && columns(current) + 1 + columns(word) > width) {
        out += current + "\n";
        current.assign(indent, ' ');
        fresh = true;
      }
      current += (fresh ? "" : " ") + word;
      fresh = false;
    }
    out += (fresh ? "" : current) + "\n";
  }
  return out;
}

std::string HelpText::make_help(const CLI::App* app, std::string /*name*/, CLI::AppFormatMode /*mode*/) const {
  Options arguments;
  Options own;
  Options common;
  for (const CLI::Option* option : app->get_options()) {
    (option->get_positional() ? arguments : option->get_group() == common_group ? common : own).push_back(option);
  }
  std::stable_partition(own.begin(), own.end(), [](const CLI::Option* o) { return o->get_required(); });
  const std::string commands = commands_of(*app);
  std::string text = wrapped(app->get_description(), 0, page_width) + "\n" +
                     usage(*app, arguments, own, !commands.empty()) + commands + section("Arguments", arguments) +
                     section("Flags", own) + section(common_group, common);
  if (!app->get_footer().empty()) text += "\n" + wrapped(app->get_footer(), 0, page_width);
  return text;
}

}  // namespace odosplat::apps
