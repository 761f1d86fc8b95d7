#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Measures what each map format costs: size, time, memory, and what a map loses through it.

measure_formats.py --odosplat BINARY --map map.ply --work FOLDER [--sequence SEQ] [--copies N] [OTHER...]

Writes the map in every format that odosplat writes and reads it back; OTHER are the same map as other programs wrote it.
With --sequence, tracks the whole sequence in each map, evaluates the trajectory and compares depth. With --copies, the
map is repeated N times, each 100 m from the last, to measure large ones. Prints the rows of docs/formats.md's tables.
Times are seconds of processor time, so that other programs on the machine matter less.
"""
import argparse
import json
import os
import re
import subprocess
import sys


def run(words):
    """Processor time [s] and peak memory [MB] of a command."""
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    errors = child.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(words)} failed:\n{errors}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def repeated(path, copies, out):
    """A PLY as odosplat writes it, its Gaussians repeated, shifted along x."""
    import array
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    head = data[:end].decode()
    count = int(re.search(r"element vertex (\d+)", head).group(1))
    width = len(re.findall(r"property float", head))
    with open(out, "wb") as file:
        file.write(head.replace(f"element vertex {count}", f"element vertex {count * copies}").encode())
        for copy in range(copies):
            values = array.array("f", data[end:end + 4 * width * count])
            values[0::width] = array.array("f", [x + 100.0 * copy for x in values[0::width]])
            file.write(values.tobytes())
    return out


def measured(options, path):
    row = {"MB": os.path.getsize(path) / 1e6}
    row["read s"], row["read MB"] = run([options.odosplat, "map", "info", path])
    if not options.sequence:
        return row
    base = os.path.join(options.work, os.path.basename(path) + "_run")
    run([options.odosplat, "track", options.sequence, "--map", path, "--out", base, "--log", "warning"])
    run([options.odosplat, "eval", os.path.join(base, "trajectory.txt"), "--truth", options.sequence, "--json",
         base + ".eval.json"])
    run([options.odosplat, "eval-depth", options.sequence, "--map", path, "--json", base + ".depth.json", "--log",
         "warning"])
    with open(base + ".eval.json", encoding="utf-8") as file:
        row["ATE mm"] = 1000 * json.load(file)["ate_m"]["rmse"]
    with open(base + ".depth.json", encoding="utf-8") as file:
        depth = json.load(file)
    row["depth mm"] = 1000 * depth["all"]["median_abs_m"]
    row["PSNR dB"] = depth["psnr_db"]
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odosplat", required=True)
    parser.add_argument("--map", required=True, help="PLY that odosplat wrote")
    parser.add_argument("--work", required=True, help="folder for the files")
    parser.add_argument("--sequence")
    parser.add_argument("--copies", type=int, default=1)
    parser.add_argument("others", nargs="*", help="the same map as other programs wrote it")
    options = parser.parse_args()
    os.makedirs(options.work, exist_ok=True)
    source = options.map
    if options.copies > 1:
        source = repeated(options.map, options.copies, os.path.join(options.work, "repeated.ply"))
    rows = []
    for name in ["map.ply", "map.glb", "map.spz", "map.splat"]:
        path = os.path.join(options.work, name)
        seconds, memory = run([options.odosplat, "convert", source, path])
        rows.append((name, {"write s": seconds, "write MB": memory, **measured(options, path)}))
        print(name, rows[-1][1], flush=True)
    for path in options.others:
        rows.append((os.path.basename(path), measured(options, path)))
        print(path, rows[-1][1], flush=True)
    columns = list(dict.fromkeys(key for _, row in rows for key in row))
    print("| map | " + " | ".join(columns) + " |\n|---" * 1 + "|---" * len(columns) + "|")
    for name, row in rows:
        print(f"| {name} | " + " | ".join(f"{row[c]:.2f}" if c in row else "-" for c in columns) + " |")


if __name__ == "__main__":
    sys.exit(main())
