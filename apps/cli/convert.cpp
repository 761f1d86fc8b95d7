// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/cloud_files.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

struct ConvertFlags {
  std::string in;
  std::string out;
};

void convert_map(const ConvertFlags& flags) {
  const Map map = read_map(flags.in);
  log_info("writing " + std::to_string(map.gaussians.size()) + " Gaussians");
  write_map(flags.out, map);
  print("%s: %zu Gaussians\n", flags.out.c_str(), map.gaussians.size());
}

void convert_cloud(const ConvertFlags& flags) {
  const PointCloud cloud = read_point_cloud(flags.in);
  log_info("writing " + std::to_string(cloud.size()) + " points");
  write_point_cloud(flags.out, cloud);
  print("%s: %zu points\n", flags.out.c_str(), cloud.size());
}

void run(const ConvertFlags& flags) {
  check_extension(flags.out, {".ply", ".splat"});
  const MadeFolders made = ensure_output_file(flags.out);
  if (is_map_file(flags.in)) {
    convert_map(flags);
  } else if (is_splat_path(flags.out)) {
    throw InputError(flags.in, "holds no Gaussians, which .splat is made of");
  } else {
    convert_cloud(flags);
  }
}

}  // namespace

void add_convert(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "convert", "convert maps of Gaussians and point clouds between file formats");
  auto flags = std::make_shared<ConvertFlags>();
  command->add_option("IN", flags->in, std::string("map of Gaussians (PLY, .splat) or ") + cloud_formats)->required();
  command->add_option("OUT", flags->out, "map (.ply; .splat keeps no view dependence) or cloud (.ply) to write")
      ->required();
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
