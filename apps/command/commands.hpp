// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

/// The subcommands, one file each. Every add_X declares its command and flags on `app`; the command runs in its
/// callback if it was chosen. Bad input is an InputError, results go to standard output.
namespace odosplat::apps {

/// Flags that every subcommand takes.
struct Common {
  std::string device;  // index or part of a name; empty: ODOSPLAT_DEVICE, else the first GPU, else the first CPU
  int threads = 0;     // 0: all cores
  bool profile = false;
  std::string log = "info";
  std::string config;  // file of flags; empty: none
};

/// Declares a subcommand with the common flags; the common flags are applied before `run` is called.
CLI::App* add_command(CLI::App& app, Common& common, const std::string& name, const std::string& help);

void add_devices(CLI::App& app, Common& common);
void add_calibrate(CLI::App& app, Common& common);
void add_check(CLI::App& app, Common& common);
void add_cloud(CLI::App& app, Common& common);
void add_align(CLI::App& app, Common& common);
void add_convert(CLI::App& app, Common& common);
void add_train(CLI::App& app, Common& common);
void add_map(CLI::App& app, Common& common);
void add_render(CLI::App& app, Common& common);
void add_track(CLI::App& app, Common& common);
void add_relocalise(CLI::App& app, Common& common);
void add_eval(CLI::App& app, Common& common);
void add_eval_depth(CLI::App& app, Common& common);
void add_view(CLI::App& app, Common& common);
void add_benchmark(CLI::App& app, Common& common);
void add_synthesize(CLI::App& app, Common& common);
void add_options(CLI::App& app, Common& common);
void add_demo(CLI::App& app, Common& common);

}  // namespace odosplat::apps
