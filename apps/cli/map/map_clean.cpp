// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/cli/map/map_commands.hpp"
#include "apps/cli/map/seen_by_flags.hpp"
#include "apps/command/interrupt.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "apps/input/map_formats.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/splat/edit/floaters.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

struct CleanFlags {
  std::string map;
  SeenByFlags seen_by;
  std::string out;
};

std::vector<Floater> find(const Common& common, const CleanFlags& flags, const Map& map) {
  if (flags.seen_by.sequence.path.empty()) return find_floaters(map.gaussians);
  const std::vector<EditView> views = read_seen_by(flags.seen_by, true);
  const compute::Context device = open_device(common);
  Progress progress("clean", static_cast<long>(views.size()));
  std::vector<Floater> floaters = find_floaters(device, map, views, {}, [&](std::size_t k) {
    if (interrupted()) throw Interrupted();
    progress.update(static_cast<long>(k));
  });
  progress.finish();
  print_profile(common, device);
  return floaters;
}

void run(const Common& common, const CleanFlags& flags) {
  constexpr double usual_share = 0.05;
  constexpr double usual_isolated_share = 0.01;
  check_extension(flags.out, map_extensions);
  const MadeFolders made = ensure_output_file(flags.out);
  const Map map = read_map(flags.map);
  const std::vector<Floater> floaters = find(common, flags, map);
  write_map(flags.out, without_floaters(map, floaters));
  const auto counts = count_floaters(floaters);
  const std::size_t removed = floaters.size() - counts[0];
  const double share = static_cast<double>(removed) / static_cast<double>(floaters.size());
  print("%s: %zu of %zu Gaussians removed (%.2f %%)\n", flags.out.c_str(), removed, floaters.size(), 100.0 * share);
  for (std::size_t k = 1; k < counts.size(); ++k) print("  %-18s %zu\n", floater_words[k], counts[k]);
  if (share > usual_share) {
    log_warning(flags.out +
                formatted(": %.0f %% of the map is removed, more than floats in a usual map: ", 100.0 * share) +
                "look at both (view map, eval-depth) before it is used");
  }
  const double isolated =
      static_cast<double>(counts[static_cast<std::size_t>(Floater::isolated)]) / static_cast<double>(floaters.size());
  if (isolated > usual_isolated_share) {
    log_warning(flags.out + formatted(": %.1f %% of the map is removed as isolated: ", 100.0 * isolated) +
                "sparse, distant surfaces may be among them");
  }
}

}  // namespace

void add_map_clean(CLI::App& map, Common& common) {
  CLI::App* command = add_command(map, common, "clean",
                                  "a map without floaters: Gaussians that are almost transparent (opacity below 0.02), "
                                  "huge, isolated, or in free space");
  auto flags = std::make_shared<CleanFlags>();
  command->add_option("MAP", flags->map, std::string("map of Gaussians (") + map_formats + ")")->required();
  add_seen_by_flags(command, flags->seen_by,
                    "remove also what hangs before the surface that these views show (their depth images, else the "
                    "map's depth)");
  command->add_option("--out", flags->out, "map to write (.ply, .splat, .spz or .glb)")->required();
  command->final_callback([&common, flags] { run(common, *flags); });
}

}  // namespace odosplat::apps
