// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::apps {

/// A figure of the report, or why there is none.
struct ReportFigure {
  std::string file;     // PNG, relative to the report's folder: "figures/association.png"
  std::string title;    // "Trajectories (the paper's Figure 5)"
  std::string caption;  // sentences; contains the label "stand-in" where the picture shows results on stand-ins
  std::string missing;  // why it could not be drawn; empty: the file exists
  bool wide = false;    // many panels: shown across the page; otherwise one column wide
};

}  // namespace odosplat::apps
