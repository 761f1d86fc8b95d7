// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "odosplat/odometry/odometry.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"
#include "odosplat/splat/train/initialize.hpp"
#include "odosplat/splat/train/trainer_options.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace odosplat::apps {

/// The options of the library that users may set by name.
struct TunedOptions {
  OdometryOptions odometry;
  RelocalizerOptions relocaliser;
  TrainerOptions train;
  InitializeOptions start;
};

/// One option. Its row is the only place that defines its name, unit, range and meaning: `odosplat options`,
/// docs/options.md, --set and --config are generated from the rows.
struct PublicOption {
  std::string name;  // "odometry.window.keyframes"; the part before the first dot is its group
  std::string unit;  // "" for shares and counts
  double least = 0.0;
  double most = 0.0;
  std::string meaning;
  std::function<std::variant<int*, float*, double*>(TunedOptions&)> field;

  std::string group() const { return name.substr(0, name.find('.')); }
  bool is_whole() const;
  /// The default as text. Values that were set are formatted in the same way.
  std::string default_text() const;
};

const std::vector<PublicOption>& public_options();

/// Values given by the user for options of some groups.
class OptionValues {
 public:
  OptionValues() = default;
  /// settings: "NAME=VALUE" each; groups: those that the command uses. InputError naming the option if it is unknown
  /// (with the nearest name), belongs to another command, is given twice, or its value is not a number, not whole or
  /// out of range.
  OptionValues(const std::vector<std::string>& settings, const std::vector<std::string>& groups);

  void apply(OdometryOptions& options) const;
  void apply(RelocalizerOptions& options) const;
  void apply(TrainerOptions& options) const;
  void apply(InitializeOptions& options) const;
  bool has(const std::string& group) const;
  /// Names and values as text, in the order given.
  std::vector<std::pair<std::string, std::string>> items() const;

 private:
  void apply_group(const std::string& group, TunedOptions& options) const;

  std::vector<std::pair<const PublicOption*, double>> values_;
};

/// "odometry.*, relocaliser.*" for these groups.
std::string group_words(const std::vector<std::string>& groups);

/// Declares --set NAME=VALUE (may be given several times) for options of these groups; `settings` receives the texts.
void add_set_flag(CLI::App* command, std::vector<std::string>& settings, const std::vector<std::string>& groups);

/// The options as a table for a terminal, and as docs/options.md.
std::string options_table();
std::string options_markdown();

}  // namespace odosplat::apps
