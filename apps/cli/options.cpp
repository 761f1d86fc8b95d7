// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/command/commands.hpp"
#include "apps/command/json_text.hpp"
#include "apps/command/output.hpp"
#include "apps/input/public_options.hpp"

namespace odosplat::apps {
namespace {

std::string options_json() {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const PublicOption& option : public_options()) {
    const auto number = [&option](double value) {
      return option.is_whole() ? nlohmann::ordered_json(static_cast<int>(value)) : nlohmann::ordered_json(value);
    };
    rows.push_back({{"name", option.name},
                    {"default", number(std::stod(option.default_text()))},
                    {"least", number(option.least)},
                    {"most", number(option.most)},
                    {"whole", option.is_whole()},
                    {"unit", option.unit},
                    {"meaning", option.meaning}});
  }
  return json_text(rows);
}

}  // namespace

void add_options(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "options", "options that track, relocalise and train take by --set NAME=VALUE");
  auto json = std::make_shared<bool>(false);
  auto markdown = std::make_shared<bool>(false);
  CLI::Option* as_json = command->add_flag("--json", *json, "as JSON");
  command->add_flag("--markdown", *markdown, "as docs/options.md")->excludes(as_json);
  command->final_callback([json, markdown] {
    print("%s", (*json ? options_json() : *markdown ? options_markdown() : options_table()).c_str());
  });
}

}  // namespace odosplat::apps
