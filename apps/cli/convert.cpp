// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/cloud_files.hpp"
#include "apps/input/map_formats.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/text/text_words.hpp"
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
  check_extension(flags.out, map_extensions);
  const MadeFolders made = ensure_output_file(flags.out);
  if (is_map_file(flags.in)) {
    convert_map(flags);
  } else if (const std::string extension = std::filesystem::path(flags.out).extension(); same_word(extension, ".ply")) {
    convert_cloud(flags);
  } else {
    throw InputError(flags.in, "holds no Gaussians, which " + extension + " is made of");
  }
}

}  // namespace

void add_convert(CLI::App& app, Common& common) {
  CLI::App* command =
      add_command(app, common, "convert", "convert maps of Gaussians and point clouds between file formats");
  auto flags = std::make_shared<ConvertFlags>();
  command->add_option("IN", flags->in, std::string("map of Gaussians (") + map_formats + ") or " + cloud_formats)
      ->required();
  command
      ->add_option("OUT", flags->out,
                   "map (.ply; .glb; .spz, in a tenth of the space; .splat, which keeps no view dependence) or cloud "
                   "(.ply) to write")
      ->required();
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
