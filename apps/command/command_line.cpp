// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>

#include "apps/command/config_file.hpp"
#include "apps/command/help_text.hpp"
#include "apps/command/nearest_name.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/support.hpp"
#include "odosplat/compute/device.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/io/video/live_address.hpp"

namespace odosplat::apps {
namespace {

// More than the cores of large machines. The limit exists because creating, say, 100 000 threads would fail halfway.
constexpr int most_threads = 1024;

/// The direct subcommand of that name; null if there is none.
CLI::App* command_below(CLI::App& app, const std::string& name) {
  const auto found = app.get_subcommands([&](CLI::App* command) { return command->get_name() == name; });
  return found.empty() ? nullptr : found[0];
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

/// Prefix of an error message: "view map: " for a command, empty for the program itself.
std::string place(const CLI::App& command) {
  std::string names;
  for (const CLI::App* app = &command; app->get_parent() != nullptr; app = app->get_parent()) {
    names.insert(0, app->get_name() + (names.empty() ? "" : " "));
  }
  return names.empty() ? "" : names + ": ";
}

std::string how_to_list(const CLI::App& command) {
  std::string names;
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) names.insert(0, app->get_name() + " ");
  return " (" + names + "--help lists them)";
}

/// A command and the words of the command line that follow its name.
struct Chosen {
  CLI::App* command;
  std::vector<std::string> words;
};

/// Descends through the subcommands that the words name.
Chosen chosen_command(CLI::App& app, const std::vector<std::string>& words) {
  Chosen chosen{&app, words};
  while (!command_names(*chosen.command).empty() && !chosen.words.empty() && !chosen.words[0].starts_with('-')) {
    const std::string& name = chosen.words[0];
    CLI::App* below = command_below(*chosen.command, name);
    if (below == nullptr) {
      throw InputError(place(*chosen.command) + "no such command " + name +
                       suggestion(nearest_name(name, command_names(*chosen.command))) + how_to_list(*chosen.command));
    }
    chosen.command = below;
    chosen.words.erase(chosen.words.begin());
  }
  return chosen;
}

bool asks_for_help(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& w) { return w == "--help" || w == "-h"; });
}

/// The file that --config names; empty: none.
std::string config_file(const std::vector<std::string>& words) {
  const std::string flag = "--config";
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == flag && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with(flag + "=")) return words[i].substr(flag.size() + 1);
  }
  return "";
}

/// The error for a word that no flag and no argument has taken.
InputError unknown_word(const CLI::App& command, const std::string& word) {
  if (!word.starts_with('-'))
    return InputError(place(command) + "takes no more arguments, there is " + shown_address(word));
  std::vector<std::string> flags;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  const std::string flag = word.substr(0, word.find('='));
  return InputError(place(command) + "no such flag " + flag + suggestion(nearest_name(flag, flags)));
}

/// Placeholder in the help for the value of each text flag, the same in all commands.
const std::map<std::string, std::string>& value_words() {
  static const std::map<std::string, std::string> words{
      {"align", "NAME"},        {"anchor", "on|off"},      {"blend-order", "NAME"},
      {"cache", "FOLDER"},      {"camera", "FILE"},        {"cloud", "FILE"},
      {"densify", "NAME"},      {"depth", "NAME"},         {"depth-noise", "NAME"},
      {"depth-use", "NAME"},    {"exposure", "on|off"},    {"frames", "A:B"},
      {"from", "FILE"},         {"guess", "TRANSFORM"},    {"job", "ID"},
      {"json", "FILE"},         {"layout", "NAME"},        {"map", "FILE"},
      {"mapping", "NAME"},      {"method", "NAME"},        {"methods", "NAME,..."},
      {"out", "PATH"},          {"pairs", "FILE"},         {"places", "FILE"},
      {"points", "FILE"},       {"poses", "FILE"},         {"preset", "NAME"},
      {"relocalise", "on|off"}, {"report", "FILE"},        {"root", "FOLDER"},
      {"scene", "NAME|FILE"},   {"sequences", "NAME,..."}, {"size", "WxH"},
      {"start", "POSE"},        {"stream", "WHERE"},       {"suite", "NAME|FILE"},
      {"times", "FILE"},        {"truth", "FILE"},         {"truth-times", "FILE"},
      {"walk", "NAME"},         {"what", "NAME,..."},      {"without-half", "SIDE"},
      {"box", "BOX"},           {"seen-by", "SEQ|FILE"},   {"T", "POSE"}};
  return words;
}

void name_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_lnames().empty() || !option->get_type_name().starts_with("TEXT")) continue;
    const auto word = value_words().find(option->get_lnames()[0]);
    if (word != value_words().end()) option->type_name(word->second);
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) name_values(*command);
}

bool is_output(const std::string& flag) {
  return flag == "--out" || flag == "--json" || flag == "--report" || flag == "OUT";
}

using Options = std::vector<const CLI::Option*>;

/// The options given with values.
Options given_options(const CLI::App& command) {
  Options given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0 && option->get_expected_max() > 0) given.push_back(option);
  }
  return given;
}

/// Refuses empty values: as a rule they come from an unset shell variable, not from the wish for the default.
void check_not_empty(const Options& given) {
  for (const CLI::Option* option : given) {
    for (const std::string& value : option->results()) {
      if (value.empty()) throw InputError(option->get_name(), "is empty");
    }
  }
}

/// Refuses to write into a folder that is read, or to replace a file in it: the layout decides which of its files are
/// read, so any of them may be an input.
void check_not_among_inputs(const std::string& output, const std::string& value, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  const std::string advice = ": take another place";
  if (fs::is_directory(value, error)) {
    if (fs::equivalent(value, folder, error)) throw InputError(output, value + " is also read" + advice);
    return;
  }
  if (!fs::is_regular_file(value, error)) return;
  for (fs::path at = fs::canonical(value, error).parent_path();; at = at.parent_path()) {
    if (fs::equivalent(at, folder, error)) {
      throw InputError(output, value + " is a file in " + folder + ", which is read" + advice);
    }
    if (at == at.parent_path()) return;
  }
}

/// Refuses an output file that the same command also reads or writes under another flag: it would be overwritten,
/// whether the run succeeds or fails.
void check_outputs(const Options& given) {
  namespace fs = std::filesystem;
  const auto same = [](const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::is_regular_file(a, error) && fs::is_regular_file(b, error)) return fs::equivalent(a, b, error);
    return !fs::is_directory(a, error) && !fs::is_directory(b, error) &&
           fs::absolute(a, error).lexically_normal() == fs::absolute(b, error).lexically_normal();
  };
  for (const CLI::Option* output : given) {
    if (!is_output(output->get_name())) continue;
    for (const CLI::Option* other : given) {
      if (other == output) continue;
      for (const std::string& value : other->results()) {
        std::error_code error;
        if (!is_output(other->get_name()) && !fs::exists(value, error)) continue;
        if (same(value, output->results().front())) {
          throw InputError(output->get_name(), output->results().front() + " is the same file as " + other->get_name() +
                                                   "; one would be written over the other");
        }
        if (!is_output(other->get_name())) {
          check_not_among_inputs(output->get_name(), output->results().front(), value);
        }
      }
    }
  }
}

/// Checks that --device names an existing device, also for commands that do not use one.
void check_device(const Common& common) {
  if (!common.device.empty()) compute::choose_device(compute::list_devices(), common.device);
}

}  // namespace

CLI::App* add_command(CLI::App& app, Common& common, const std::string& name, const std::string& help) {
  CLI::App* command = app.add_subcommand(name, help);
  command->formatter(std::make_shared<HelpText>());
  command->option_defaults()->always_capture_default();
  command->set_help_flag("-h,--help", "print this and exit")->group(common_group);
  command->add_option("--device", common.device, "OpenCL device: its index in odosplat devices, or a part of its name")
      ->type_name("DEVICE")
      ->default_str("ODOSPLAT_DEVICE, else first GPU, else first CPU")
      ->group(common_group);
  add_number(command, "--threads", common.threads, {.least = 0, .most = most_threads, .word = "all"},
             "CPU threads; 0 or all: one per core")
      ->group(common_group);
  command->add_flag("--profile", common.profile, "print the device's time, stage by stage and kernel by kernel")
      ->group(common_group);
  command->add_option("--log", common.log, "debug, info, warning (no progress either) or off")
      ->type_name("LEVEL")
      ->group(common_group);
  command
      ->add_option(
          "--config", common.config,
          "TOML file of flags, a line each: flag = value, and below them options as --set takes them: NAME = VALUE, or "
          "tables; the command line wins")
      ->type_name("FILE")
      ->group(common_group);
  command->parse_complete_callback([&common, command] {
    const Options given = given_options(*command);
    check_not_empty(given);
    check_outputs(given);
    set_log_level(common.log);
    if (common.threads > 0) {
      set_threads(common.threads);
      compute::set_cpu_threads(common.threads);
    }
    check_device(common);
  });
  return command;
}

void declare_commands(CLI::App& app, Common& common) {
  app.description("odosplat: localise a camera in a map of 3-D Gaussians");
  app.name("odosplat");
  app.set_help_flag("-h,--help", "print this and exit; odosplat COMMAND --help tells a command's flags");
  app.set_version_flag("--version", version_text, "print version, build and OpenCL devices and exit");
  app.formatter(std::make_shared<HelpText>());
  app.require_subcommand(1);
  add_devices(app, common);
  add_check(app, common);
  add_calibrate(app, common);
  add_cloud(app, common);
  add_align(app, common);
  add_convert(app, common);
  add_train(app, common);
  add_map(app, common);
  add_render(app, common);
  add_track(app, common);
  add_relocalise(app, common);
  add_eval(app, common);
  add_eval_depth(app, common);
  add_view(app, common);
  add_benchmark(app, common);
  add_synthesize(app, common);
  add_options(app, common);
  add_demo(app, common);
  name_values(app);
}

void parse_command_line(CLI::App& app, const std::vector<std::string>& words) {
  const Chosen chosen = chosen_command(app, words);
  if (!asks_for_help(chosen.words)) {
    if (const std::string file = config_file(chosen.words); !file.empty()) {
      apply_config(*chosen.command, chosen.words, file);
    }
  }
  // CLI11 takes the words from the end of the vector.
  std::vector<std::string> backwards(words.rbegin(), words.rend());
  try {
    app.parse(backwards);
  } catch (const CLI::Success&) {
    throw;
  } catch (const CLI::ParseError& e) {
    // A misspelt flag is reported first, because it is the cause of other errors, such as a missing required flag.
    const std::vector<std::string> unknown = chosen.command->remaining();
    if (!unknown.empty()) throw unknown_word(*chosen.command, unknown[0]);
    if (!command_names(*chosen.command).empty()) {
      throw InputError(place(*chosen.command) + "a command is needed" + how_to_list(*chosen.command));
    }
    throw InputError(place(*chosen.command) + e.what());
  }
}

}  // namespace odosplat::apps
