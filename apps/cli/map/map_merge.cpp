// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/cli/map/map_commands.hpp"
#include "apps/cli/train/stages.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/output.hpp"
#include "apps/input/map_formats.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/terminal_text.hpp"
#include "odosplat/splat/edit/merge.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

struct MergeFlags {
  std::vector<std::string> maps;
  bool force = false;
  std::string out;
};

void run(const MergeFlags& flags) {
  if (flags.maps.size() < 2) throw InputError("MAP", "must be two maps or more");
  check_extension(flags.out, map_extensions);
  const MadeFolders made = ensure_output_file(flags.out);
  MergedMap merged;
  std::vector<std::size_t> sizes;
  {
    Stages stages("merge", static_cast<int>(2 * flags.maps.size()));
    std::vector<MergeSource> sources;
    for (const std::string& file : flags.maps) {
      if (interrupted()) throw Interrupted();
      stages.next("reading " + file);
      sources.push_back({printable_line(file), read_map(file)});
      sizes.push_back(sources.back().map.gaussians.size());
    }
    MergeOptions options;
    options.force = flags.force;
    merged = merge_maps(sources, options, [&stages](const std::string& name) {
      if (interrupted()) throw Interrupted();
      stages.next("adding " + name);
    });
  }
  for (const std::string& warning : merged.warnings) log_warning(warning);
  write_map(flags.out, merged.map);
  for (std::size_t k = 0; k < flags.maps.size(); ++k) {
    print("%s: %zu of %zu Gaussians kept", flags.maps[k].c_str(), merged.kept[k], sizes[k]);
    if (k > 0 && merged.overlaps[k - 1].pairs > 0) {
      const MergeOverlap& overlap = merged.overlaps[k - 1];
      print("; %zu on surfaces held before, %.1f mm (%.1f sigma) off them, brightness %+.3f", overlap.pairs,
            1000.0 * overlap.distance_m, overlap.sigmas, overlap.gray);
    }
    print("\n");
  }
  print("%s: %zu Gaussians; quality not measured\n", flags.out.c_str(), merged.map.gaussians.size());
}

}  // namespace

void add_map_merge(CLI::App& map, Common& common) {
  CLI::App* command = add_command(
      map, common, "merge", "one map of several of the same frame: of a surface that two hold, the better is taken");
  auto flags = std::make_shared<MergeFlags>();
  command->add_option("MAP", flags->maps, std::string("maps of one world frame (") + map_formats + "), two or more")
      ->required();
  command->add_flag("--force", flags->force,
                    "merge also maps whose surfaces lie more than 8 sigma apart, whose brightness differs by more than "
                    "0.25 (of 1), or that are blended differently");
  command->add_option("--out", flags->out, "map to write (.ply, .splat, .spz or .glb)")->required();
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
