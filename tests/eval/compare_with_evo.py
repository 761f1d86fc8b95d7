#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Compares `odosplat eval` with the public tool evo on the same trajectory files.

compare_with_evo.py --odosplat BINARY --data FOLDER --venv FOLDER   runs both, exit 1 if a figure differs by more than 1e-6
compare_with_evo.py --record --data FOLDER --venv FOLDER            writes evo's figures as evo_figures.hpp to stdout

FOLDER of --data holds the trajectories of evo's own test data. evo is installed from PyPI into the virtual environment
--venv, made if missing. Exit 77 (skipped) where the data are absent or PyPI is out of reach.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
from venv_packages import python_with, SKIPPED  # noqa: E402

EVO = "evo==1.38.1"
# name, ground truth, estimate; KITTI files contain matrices without times.
SETS = [
    ("fr2_desk_orb", "fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt"),
    ("fr2_desk_orb_mono", "fr2_desk_groundtruth.txt", "fr2_desk_ORB_kf_mono.txt"),
    ("fr1_xyz_rgbdslam", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam.txt"),
    ("fr1_xyz_drift", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam_drift.txt"),
    ("fr1_xyz_drift_short", "freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam_drift_short.txt"),
    ("fr1_rpy_dvo", "tum_fr1_rpy_groundtruth.txt", "tum_fr1_rpy_dvo_cpu_estimate.txt"),
    ("kitti_00_orb", "KITTI_00_gt.txt", "KITTI_00_ORB.txt"),
]
ALIGNMENTS = ("none", "se3", "sim3")
DELTAS = ((1, False), (10, False), (10, True))
KEYS = ("rmse", "mean", "median", "max", "p99")


def evo_figures(folder):
    """All cases: a list of dictionaries. Runs inside the virtual environment."""
    import copy

    import numpy as np
    from evo.core import metrics, sync
    from evo.core.units import Unit
    from evo.tools import file_interface

    def summary(metric, data):
        metric.process_data(data)
        e = np.asarray(metric.error)
        return {"rmse": metric.get_statistic(metrics.StatisticsType.rmse),
                "mean": metric.get_statistic(metrics.StatisticsType.mean),
                "median": metric.get_statistic(metrics.StatisticsType.median),
                "max": metric.get_statistic(metrics.StatisticsType.max), "p99": float(np.percentile(e, 99))}

    cases = []
    for name, truth_file, estimate_file in SETS:
        kitti = name.startswith("kitti")
        read = file_interface.read_kitti_poses_file if kitti else file_interface.read_tum_trajectory_file
        truth = read(os.path.join(folder, truth_file))
        estimate = read(os.path.join(folder, estimate_file))
        if not kitti:
            truth, estimate = sync.associate_trajectories(truth, estimate, max_diff=0.01)
        for alignment in ALIGNMENTS:
            aligned = copy.deepcopy(estimate)
            scale = 1.0
            if alignment != "none":
                scale = float(aligned.align(truth, correct_scale=alignment == "sim3")[2])
            data = (truth, aligned)
            ate = summary(metrics.APE(metrics.PoseRelation.translation_part), data)
            for delta, all_pairs in DELTAS:
                relative = dict(delta=delta, delta_unit=Unit.frames, all_pairs=all_pairs)
                cases.append({
                    "name": name, "truth": truth_file, "estimate": estimate_file, "alignment": alignment,
                    "delta": delta, "all_pairs": all_pairs, "pairs": truth.num_poses, "scale": scale, "ate_m": ate,
                    "rte_m": summary(metrics.RPE(metrics.PoseRelation.translation_part, **relative), data),
                    "rre_deg": summary(metrics.RPE(metrics.PoseRelation.rotation_angle_deg, **relative), data)})
    return cases


def header_text(cases):
    def statistics(s):
        return "{" + ", ".join(f"{s[k]:.15g}" for k in KEYS) + "}"

    lines = ["// SPDX-License-Identifier: Apache-2.0", "// Copyright 2026 The odosplat authors",
             f"// Written by compare_with_evo.py --record with {EVO} (PyPI): its APE (translation part) and RPE (translation",
             "// part, rotation angle in degrees; delta in frames), p99 by numpy.percentile. Do not edit.", "#pragma once",
             "", "#include <cstddef>", "", "namespace odosplat {", "",
             "struct EvoStatistics {", "  double " + ", ".join(KEYS) + ";", "};", "",
             "struct EvoFigures {", "  const char* truth;", "  const char* estimate;", "  const char* alignment;",
             "  int delta;", "  bool all_pairs;", "  std::size_t pairs;", "  double scale;",
             "  EvoStatistics ate_m, rte_m, rre_deg;", "};", "", "inline constexpr EvoFigures evo_figures[] = {"]
    for c in cases:
        lines.append(f'    {{"{c["truth"]}", "{c["estimate"]}", "{c["alignment"]}", {c["delta"]}, '
                     f'{str(c["all_pairs"]).lower()}, {c["pairs"]}, {c["scale"]:.15g}, {statistics(c["ate_m"])}, '
                     f'{statistics(c["rte_m"])}, {statistics(c["rre_deg"])}}},')
    return "\n".join(lines + ["};", "", "}  // namespace odosplat", ""])


def run_odosplat(binary, folder, case, out):
    command = [binary, "eval", os.path.join(folder, case["estimate"]), "--truth", os.path.join(folder, case["truth"]),
               "--align", case["alignment"], "--delta", str(case["delta"]), "--json", out]
    subprocess.run(command + (["--all-pairs"] if case["all_pairs"] else []), check=True, stdout=subprocess.DEVNULL)
    with open(out, encoding="utf-8") as file:
        return json.load(file)


def compare(binary, folder, cases):
    worst = 0.0
    failures = 0
    with tempfile.TemporaryDirectory() as scratch:
        for case in cases:
            ours = run_odosplat(binary, folder, case, os.path.join(scratch, "eval.json"))
            pairs = [("pairs", ours["pairs"], case["pairs"]), ("scale", ours["scale"], case["scale"])]
            for group in ("ate_m", "rte_m", "rre_deg"):
                pairs += [(f"{group} {key}", ours[group][key], case[group][key]) for key in KEYS]
            for what, mine, evos in pairs:
                difference = abs(mine - evos)
                worst = max(worst, difference)
                if not difference <= 1e-6:
                    failures += 1
                    print(f"{case['estimate']} {case['alignment']} delta {case['delta']}"
                          f"{' all pairs' if case['all_pairs'] else ''}: {what}: odosplat {mine:.9g}, evo {evos:.9g}")
    print(f"{len(cases)} cases, largest difference {worst:.2g}, {failures} figures differ by more than 1e-6")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odosplat", help="the program to judge")
    parser.add_argument("--data", required=True, help="folder of the trajectories")
    parser.add_argument("--venv", required=True, help="folder of the virtual environment for evo")
    parser.add_argument("--record", action="store_true", help="write evo's figures as a C++ header")
    parser.add_argument("--worker", help=argparse.SUPPRESS)  # the file that the figures are written to
    options = parser.parse_args()
    if options.worker:
        with open(options.worker, "w", encoding="utf-8") as file:
            json.dump(evo_figures(options.data), file)
        return 0
    if not options.record and not options.odosplat:
        parser.error("--odosplat is missing")
    if not os.path.exists(os.path.join(options.data, SETS[0][1])):
        print(f"skipped: no trajectories in {options.data}")
        return SKIPPED
    python = python_with(options.venv, [EVO])
    environment = dict(os.environ, HOME=options.venv)  # evo writes settings into the home folder
    with tempfile.TemporaryDirectory() as scratch:
        figures = os.path.join(scratch, "figures.json")
        subprocess.run([python, os.path.abspath(__file__), "--worker", figures, "--data", options.data, "--venv",
                        options.venv], check=True, stdout=subprocess.DEVNULL, env=environment)
        with open(figures, encoding="utf-8") as file:
            cases = json.load(file)
    if options.record:
        sys.stdout.write(header_text(cases))
        return 0
    return compare(options.odosplat, options.data, cases)


if __name__ == "__main__":
    sys.exit(main())
