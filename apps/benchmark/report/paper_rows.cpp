// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/report/results.hpp"

namespace odosplat::apps {

const std::vector<PaperRow>& paper_rows() {
  static const std::vector<PaperRow> rows{
      {"icl_1", "DSL", 0.185, 0.017, 0.405},
      {"icl_1", "RGBD-DSO", 0.346, 0.006, 0.158},
      {"icl_1", "MonoGS", 0.044, 0.027, 1.258},
      {"icl_1", "GS-DSO", 0.027, 0.002, 0.108},
      {"icl_1", "interpolation", 0.650, 0.007, 0.139},
      {"icl_2", "DSL", 0.047, 0.006, 0.130},
      {"icl_2", "RGBD-DSO", 0.010, 0.001, 0.020},
      {"icl_2", "MonoGS", 0.148, 0.072, 2.237},
      {"icl_2", "GS-DSO", 0.008, 0.001, 0.026},
      {"icl_2", "interpolation", 0.087, 0.001, 0.025},
      {"icl_3", "DSL", 0.009, 0.001, 0.035},
      {"icl_3", "RGBD-DSO", 0.064, 0.002, 0.043},
      {"icl_3", "MonoGS", 0.278, 0.038, 1.044},
      {"icl_3", "GS-DSO", 0.012, 0.001, 0.022},
      {"icl_3", "interpolation", 0.121, 0.002, 0.031},
      {"icl_4", "DSL", 0.281, 0.022, 0.668},
      {"icl_4", "RGBD-DSO", 0.088, 0.002, 0.105},
      {"icl_4", "MonoGS", 0.996, 0.064, 1.615},
      {"icl_4", "GS-DSO", 0.029, 0.003, 0.183},
      {"icl_4", "interpolation", 1.305, 0.010, 0.503},
      {"augm_1", "DSL", 1.534, 0.031, 0.924},
      {"augm_1", "RGBD-DSO", 1.258, 0.009, 0.216},
      {"augm_1", "MonoGS", 1.396, 0.134, 4.214},
      {"augm_1", "GS-DSO", 1.239, 0.012, 0.259},
      {"augm_1", "interpolation", 2.088, 0.010, 0.318},
      {"augm_2", "DSL", 0.020, 0.002, 0.052},
      {"augm_2", "RGBD-DSO", 0.014, 0.002, 0.038},
      {"augm_2", "MonoGS", 1.310, 0.162, 3.384},
      {"augm_2", "GS-DSO", 0.014, 0.002, 0.035},
      {"augm_2", "interpolation", 0.529, 0.009, 0.264},
      {"augm_3", "DSL", -1.0, -1.0, -1.0},
      {"augm_3", "RGBD-DSO", 1.382, 0.016, 0.830},
      {"augm_3", "MonoGS", 1.481, 0.178, 4.695},
      {"augm_3", "GS-DSO", 1.519, 0.008, 0.223},
      {"augm_3", "interpolation", 2.337, 0.013, 0.277},
      {"augm_4", "DSL", 0.055, 0.012, 0.305},
      {"augm_4", "RGBD-DSO", 0.061, 0.004, 0.146},
      {"augm_4", "MonoGS", 2.282, 0.141, 5.157},
      {"augm_4", "GS-DSO", 0.043, 0.002, 0.067},
      {"augm_4", "interpolation", -1.0, -1.0, -1.0},
  };
  return rows;
}

}  // namespace odosplat::apps
