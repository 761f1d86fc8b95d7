#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Opens a map.ply that odosplat wrote in two public readers, plyfile and gsply, and compares what they find.

open_with_public_readers.py --odosplat BINARY --venv FOLDER

Maps of every degree of harmonics are made here as text, written by `odosplat convert`, and must come back from both
readers bit by bit: positions, scales, rotations, opacities, colours and harmonics. The same through .splat and back,
within its quantisation. The readers are installed from PyPI into the virtual environment --venv, made if missing.
Exit 1 on a difference, 77 (skipped) where PyPI is out of reach.
"""
import argparse
import math
import os
import random
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
from venv_packages import python_with, SKIPPED  # noqa: E402

READERS = ["plyfile==1.1.5", "gsply==0.4.6"]
COUNT = 200
SH_CONSTANT = 0.28209479177387814


def float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def names_of(degree):
    rest = 3 * ((degree + 1) ** 2 - 1)
    return (["x", "y", "z"] + [f"f_dc_{i}" for i in range(3)] + [f"f_rest_{i}" for i in range(rest)] + ["opacity"] +
            [f"scale_{i}" for i in range(3)] + [f"rot_{i}" for i in range(4)])


def made_map(degree):
    """Rows of values by name, rounded to float32."""
    rng = random.Random(degree)
    rows = []
    for _ in range(COUNT):
        row = {name: float32(rng.gauss(0.0, 1.0)) for name in names_of(degree)}
        for axis in range(3):
            row[f"scale_{axis}"] = float32(rng.uniform(-6.0, -1.0))
        rows.append(row)
    return rows


def write_text_ply(path, rows):
    names = list(rows[0])
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n")
        file.writelines(f"property float {name}\n" for name in names)
        file.write("end_header\n")
        file.writelines(" ".join(repr(row[name]) for name in names) + "\n" for row in rows)


def read_with_plyfile(path):
    from plyfile import PlyData
    vertex = PlyData.read(path)["vertex"]
    return [{p.name: float(vertex[p.name][i]) for p in vertex.properties} for i in range(vertex.count)]


def read_with_gsply(path):
    import gsply
    data = gsply.plyread(path)
    rows = []
    for i in range(len(data.means)):
        row = {axis: float(data.means[i, a]) for a, axis in enumerate("xyz")}
        row.update({f"f_dc_{c}": float(data.sh0[i, c]) for c in range(3)})
        if data.shN is not None and data.shN.size:
            bands = data.shN.shape[1]
            row.update({f"f_rest_{c * bands + k}": float(data.shN[i, k, c]) for c in range(3) for k in range(bands)})
        row["opacity"] = float(data.opacities.reshape(-1)[i])
        row.update({f"scale_{a}": float(data.scales[i, a]) for a in range(3)})
        row.update({f"rot_{a}": float(data.quats[i, a]) for a in range(4)})
        rows.append(row)
    return rows


def opacity(row):
    return 1.0 / (1.0 + math.exp(-row["opacity"]))


def color(row, channel):
    return min(max(0.5 + SH_CONSTANT * row[f"f_dc_{channel}"], 0.0), 1.0)


def unit_rotation(row):
    q = [row[f"rot_{a}"] for a in range(4)]
    length = math.sqrt(sum(v * v for v in q))
    return [v / length for v in q]


def differences(found, wanted):
    """Names and values must be equal exactly; normals are not compared."""
    if len(found) != len(wanted):
        return [f"{len(found)} Gaussians instead of {len(wanted)}"]
    return [f"Gaussian {i}: {name} is {f.get(name)}, must be {value}" for i, (f, w) in enumerate(zip(found, wanted))
            for name, value in w.items() if f.get(name) != value]


def differences_of_splat(found, wanted):
    """Within the resolution of .splat: half a step of a byte, a whole one for rotations near +1 (127 of 128 fit)."""
    wanted = sorted(wanted, key=lambda row: row["x"])
    found = sorted(found, key=lambda row: row["x"])
    faults = []
    for f, w in zip(found, wanted):
        pairs = [(axis, f[axis], w[axis], 0.0) for axis in "xyz"]
        pairs += [(f"scale_{a}", f[f"scale_{a}"], w[f"scale_{a}"], 1e-6) for a in range(3)]
        pairs += [(f"colour {c}", color(f, c), color(w, c), 0.5001 / 255) for c in range(3)]
        pairs += [("opacity", opacity(f), opacity(w), 0.75 / 255)]
        pairs += [(f"rot_{a}", unit_rotation(f)[a], unit_rotation(w)[a], 2.0 / 128) for a in range(4)]
        faults += [f"{name} is {a}, must be {b}" for name, a, b, most in pairs if not abs(a - b) <= most]
    return faults if len(found) == len(wanted) else [f"{len(found)} Gaussians instead of {len(wanted)}"]


def compare(folder):
    failures = 0
    for degree in range(4):
        wanted = made_map(degree)
        for reader in (read_with_plyfile, read_with_gsply):
            faults = differences(reader(os.path.join(folder, f"map{degree}.ply")), wanted)
            faults += differences_of_splat(reader(os.path.join(folder, f"splat{degree}.ply")), wanted)
            failures += len(faults)
            for fault in faults[:5]:
                print(f"degree {degree}, {reader.__name__}: {fault}")
    print(f"4 maps of {COUNT} Gaussians in 2 readers, and again through .splat: {failures} values differ")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odosplat", help="the program to judge")
    parser.add_argument("--venv", help="folder of the virtual environment for the readers")
    parser.add_argument("--worker", help=argparse.SUPPRESS)  # the folder of the maps
    options = parser.parse_args()
    if options.worker:
        return compare(options.worker)
    if not options.odosplat or not options.venv:
        parser.error("--odosplat and --venv are needed")
    python = python_with(options.venv, READERS)
    with tempfile.TemporaryDirectory() as scratch:
        def path(name):
            return os.path.join(scratch, name)

        for degree in range(4):
            write_text_ply(path(f"text{degree}.ply"), made_map(degree))
            for source, target in ((f"text{degree}.ply", f"map{degree}.ply"), (f"map{degree}.ply", f"m{degree}.splat"),
                                   (f"m{degree}.splat", f"splat{degree}.ply")):
                subprocess.run([options.odosplat, "convert", path(source), path(target), "--log", "off"], check=True,
                               stdout=subprocess.DEVNULL)
        # gsply compiles with numba, whose cache folder is set here.
        environment = dict(os.environ, NUMBA_CACHE_DIR=os.path.join(options.venv, "numba"))
        return subprocess.run([python, os.path.abspath(__file__), "--worker", scratch], check=False,
                              env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
