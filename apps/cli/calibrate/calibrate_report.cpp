// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/calibrate/calibrate_report.hpp"

#include <nlohmann/json.hpp>

#include "apps/cli/check/check_camera.hpp"
#include "apps/command/json_text.hpp"

namespace odosplat::apps {

std::string calibration_json(const Sequence& sequence, const CameraFile& written, const CameraFit& fit) {
  const nlohmann::ordered_json camera{{"width", written.camera.width},
                                      {"height", written.camera.height},
                                      {"fx", written.camera.fx},
                                      {"fy", written.fy_sign * written.camera.fy},
                                      {"cx", written.camera.cx},
                                      {"cy", written.camera.cy},
                                      {"distortion", written.distortion},
                                      {"time_offset", written.time_offset},
                                      {"depth_scale", written.depth_scale},
                                      {"readout_s", written.camera.readout}};
  return json_text(
      {{"name", sequence.name()}, {"camera", camera}, {"measured", camera_fit_json(fit, sequence.camera())}});
}

}  // namespace odosplat::apps
