// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>

#include "apps/input/public_options.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::apps {

void add_set_flag(CLI::App* command, std::vector<std::string>& settings, const std::vector<std::string>& groups) {
  command
      ->add_option("--set", settings,
                   "NAME=VALUE: an option of " + group_words(groups) +
                       " (odosplat options lists them); may be given several times")
      ->type_name("NAME=VALUE")
      ->check(CLI::Validator(
          [groups](const std::string& setting) -> std::string {
            try {
              OptionValues({setting}, groups);
            } catch (const InputError& e) {
              const std::string fault = e.what();  // the parser adds the flag's name itself
              return fault.substr(std::string("--set: ").size());
            }
            return "";
          },
          "", "option"))
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

}  // namespace odosplat::apps
