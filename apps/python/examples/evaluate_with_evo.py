#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""The errors of a trajectory by odosplat and by evo, side by side.

    python evaluate_with_evo.py run/trajectory.txt truth.txt [none|se3|sim3]

Both files in TUM format. Needs evo.
"""

import sys

from evo.core import metrics, sync
from evo.tools import file_interface

import odosplat


def main() -> None:
    if len(sys.argv) not in (3, 4):
        raise SystemExit(f"usage: {sys.argv[0]} ESTIMATE TRUTH [none|se3|sim3]")
    align = sys.argv[3] if len(sys.argv) == 4 else "none"
    ours = odosplat.evaluate(sys.argv[1], sys.argv[2], align)
    if ours.doubt:
        print(f"only {ours.doubt}")

    truth = file_interface.read_tum_trajectory_file(sys.argv[2])
    estimate = file_interface.read_tum_trajectory_file(sys.argv[1])
    truth, estimate = sync.associate_trajectories(truth, estimate, max_diff=0.01)
    if align != "none":
        estimate.align(truth, correct_scale=align == "sim3")
    ate = metrics.APE(metrics.PoseRelation.translation_part)
    ate.process_data((truth, estimate))
    rte = metrics.RPE(metrics.PoseRelation.translation_part, delta=1, delta_unit=metrics.Unit.frames)
    rte.process_data((truth, estimate))

    print(f"{'RMSE [mm]':10}{'odosplat':>12}{'evo':>12}")
    for name, mine, theirs in (("ATE", ours.ate_m, ate), ("RTE", ours.rte_m, rte)):
        evo_mm = 1000 * theirs.get_statistic(metrics.StatisticsType.rmse)
        print(f"{name:10}{1000 * (mine.rmse or 0.0):12.6f}{evo_mm:12.6f}")


if __name__ == "__main__":
    main()
