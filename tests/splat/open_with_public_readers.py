#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Opens maps that odosplat wrote in public readers, and maps that public writers wrote in odosplat.

open_with_public_readers.py --odosplat BINARY --venv FOLDER

Maps of every degree of harmonics are made here as text, written by `odosplat convert`, and must come back from plyfile
and gsply bit by bit: positions, scales, rotations, opacities, colours and harmonics. The same within the formats' steps
  through .splat and back,
  .glb in pygltflib, whose values and axes are compared with the map's,
  .spz in gsply and in gaussforge (which has the reference code of SPZ),
  .spz of gsply (versions 3 and 4) and of gaussforge (2, 3 and 4), packed PLY of gsply and SOG of gaussforge in odosplat.
gsply and gaussforge leave the axes of SPZ as they are, those of a PLY; the format's are turned about x by half a turn,
and so is what they find in ours, and we in theirs.
The packages are installed from PyPI into the virtual environment --venv, made if missing. Exit 1 on a difference, 77
(skipped) where PyPI is out of reach.
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

READERS = ["plyfile==1.1.5", "gsply==0.4.6", "zstandard==0.25.0", "pygltflib==1.16.5", "gaussforge==0.6.0"]
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
    return rows_of_gsply(gsply.plyread(path))


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


# Axes of which a coefficient of harmonics (m from -l to l, degree after degree) is odd, as in kernels/sh.cl.
ODD_AXES = ["", "y", "z", "x", "xy", "yz", "", "xz", "", "y", "xyz", "y", "z", "x", "z", "x"]


def turned(row, axes):
    """The Gaussian after half a turn that changes the signs of these two axes."""
    row = dict(row)
    for a, axis in enumerate("xyz"):
        if axis in axes:
            row[axis] = -row[axis]
            row[f"rot_{a + 1}"] = -row[f"rot_{a + 1}"]
    bands = sum(name.startswith("f_rest_") for name in row) // 3
    for k in range(bands):
        if sum(axis in ODD_AXES[k + 1] for axis in axes) % 2 == 1:
            for c in range(3):
                row[f"f_rest_{c * bands + k}"] *= -1.0
    return row


def differences_within(found, wanted, steps):
    """steps: the most by which a value may differ, by the beginning of its name; "opacity" counts in 0..1."""
    if len(found) != len(wanted):
        return [f"{len(found)} Gaussians instead of {len(wanted)}"]
    faults = []
    for w in wanted:  # formats may change the order
        f = min(found, key=lambda row: sum((row[axis] - w[axis]) ** 2 for axis in "xyz"))
        pairs = [(name, f[name], w[name]) for name in w if not name.startswith("rot_") and name != "opacity"]
        pairs.append(("opacity", opacity(f), opacity(w)))
        a, b = unit_rotation(f), unit_rotation(w)
        sign = math.copysign(1.0, sum(x * y for x, y in zip(a, b)))
        pairs += [(f"rot_{i}", sign * a[i], b[i]) for i in range(4)]
        for name, value, must in pairs:
            step = next(most for start, most in steps.items() if name.startswith(start))
            if not abs(value - must) <= step:
                faults.append(f"{name} is {value}, must be {must} within {step}")
    return faults


# Half a step each, a whole one of harmonics that are clamped to -1..127/128; the largest component of a rotation, which is not stored, is up to three times as wrong.
SPZ_STEPS = {"x": 0.51 / 4096, "y": 0.51 / 4096, "z": 0.51 / 4096, "f_dc": 0.51 / (255 * 0.15), "f_rest": 1.01 / 128,
             "opacity": 0.51 / 255, "scale": 0.51 / 16, "rot": 1.53 / (511 * math.sqrt(2))}
# Other writers keep 5 bits of degree 1 and 4 of the others, truncated or rounded. Version 2 restores w from bytes of x y
# z, however small it is: from 1 - |xyz|^2, which is wrong by up to 0.02.
OTHER_SPZ_STEPS = {**SPZ_STEPS, "x": 1.01 / 4096, "y": 1.01 / 4096, "z": 1.01 / 4096, "f_rest": 16.1 / 128,
                   "scale": 1.01 / 16, "opacity": 1.01 / 255, "f_dc": 1.01 / (255 * 0.15)}
GLB_STEPS = {"x": 0.0, "y": 0.0, "z": 0.0, "f_dc": 0.0, "f_rest": 0.0, "opacity": 1e-6, "scale": 1e-5, "rot": 1e-6}
# 200 Gaussians are one chunk of a packed PLY: steps of its range, which is below 8 m and 8 for colours.
PACKED_STEPS = {"x": 8 / 2047, "y": 8 / 1023, "z": 8 / 2047, "f_dc": 8 / 255, "f_rest": 0.51 * 8 / 256 + 0.02,
                "opacity": 0.6 / 255, "scale": 8 / 1023, "rot": 3 / (1023 * math.sqrt(2))}


def clamped(rows):
    """Colours in the range of SPZ."""
    def value(name, v):
        if name.startswith("f_dc_"):
            return min(max(v, -0.5 / 0.15), 0.5 / 0.15)
        return min(max(v, -1.0), 127 / 128) if name.startswith("f_rest_") else v

    return [{name: value(name, v) for name, v in row.items()} for row in rows]


def with_unit_rotations(rows):
    """What writers expect that do not normalise rotations themselves."""
    return [{**row, **{f"rot_{a}": float32(v) for a, v in enumerate(unit_rotation(row))}} for row in rows]


def rows_of_gsply(data):
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


def rows_of_gaussforge(path, format_name):
    """What gaussforge makes of a file, through a PLY: it cannot hand over maps of degree 0 otherwise."""
    import gaussforge
    with open(path, "rb") as file:
        made = gaussforge.GaussForge().convert(file.read(), format_name, "ply")
    if "error" in made:
        sys.exit(f"gaussforge does not read {path}: {made['error']}")
    with open(path + ".forged.ply", "wb") as file:
        file.write(made["data"])
    return read_with_plyfile(path + ".forged.ply")


def rows_of_glb(path):
    """Attributes by pygltflib, as rows of a PLY in the axes of glTF."""
    import numpy
    from pygltflib import GLTF2
    gltf = GLTF2().load(path)
    primitive = gltf.meshes[0].primitives[0]
    assert primitive.mode == 0 and primitive.extensions["KHR_gaussian_splatting"]["kernel"] == "ellipse"
    assert gltf.extensionsUsed == ["KHR_gaussian_splatting"]
    blob = gltf.binary_blob()

    def values(attribute):
        accessor = gltf.accessors[getattr(primitive.attributes, attribute)]
        view = gltf.bufferViews[accessor.bufferView]
        data = numpy.frombuffer(blob, "<f4", view.byteLength // 4, view.byteOffset)
        return data.reshape(accessor.count, -1)

    names = [name for name in vars(primitive.attributes) if ":SH_DEGREE_" in name]
    colors = [values(name) for name in names]  # written degree after degree
    positions, rotations = values("POSITION"), values("KHR_gaussian_splatting:ROTATION")
    scales, opacities = values("KHR_gaussian_splatting:SCALE"), values("KHR_gaussian_splatting:OPACITY")
    accessor = gltf.accessors[primitive.attributes.POSITION]
    assert numpy.allclose(accessor.min, positions.min(0)) and numpy.allclose(accessor.max, positions.max(0))
    rows = []
    for i in range(len(positions)):
        row = {axis: float(positions[i, a]) for a, axis in enumerate("xyz")}
        row.update({f"f_dc_{c}": float(colors[0][i, c]) for c in range(3)})
        bands = len(colors) - 1
        row.update({f"f_rest_{c * bands + k}": float(colors[k + 1][i, c]) for c in range(3) for k in range(bands)})
        row["opacity"] = math.log(opacities[i, 0] / (1.0 - opacities[i, 0]))
        row.update({f"scale_{a}": math.log(scales[i, a]) for a in range(3)})
        row.update({f"rot_{a}": float(rotations[i, (a + 3) % 4]) for a in range(4)})
        rows.append(row)
    return rows


def made_by_others(folder):
    """Files of the maps by other writers, to be read by odosplat: name, and the axes that its reader turns."""
    import gaussforge
    import gsply
    forge = gaussforge.GaussForge()
    for degree in range(4):
        source = os.path.join(folder, f"unit{degree}.ply")
        with open(source, "rb") as file:
            data = file.read()
        for version in (3, 4):
            gsply.write_spz(os.path.join(folder, f"gsply{version}_{degree}.spz"), gsply.plyread(source), version=version)
        for version in (2, 3, 4):
            with open(os.path.join(folder, f"forge{version}_{degree}.spz"), "wb") as file:
                file.write(forge.convert(data, "ply", "spz", spz_version=version)["data"])
        gsply.plywrite(os.path.join(folder, f"packed{degree}.ply"), gsply.plyread(source), compressed=True)
        with open(os.path.join(folder, f"forge{degree}.sog"), "wb") as file:
            file.write(forge.convert(data, "ply", "sog")["data"])
    return 0


OTHERS = ([f"gsply{version}_{{}}.spz" for version in (3, 4)] + [f"forge{version}_{{}}.spz" for version in (2, 3, 4)] +
          ["packed{}.compressed.ply", "forge{}.sog"])


def compare(folder):
    import gsply
    failures = 0

    def judge(what, faults):
        nonlocal failures
        failures += len(faults)
        for fault in faults[:5]:
            print(f"{what}: {fault}")

    def path(name):
        return os.path.join(folder, name)

    for degree in range(4):
        wanted = made_map(degree)
        for reader in (read_with_plyfile, read_with_gsply):
            what = f"degree {degree}, {reader.__name__}"
            judge(what, differences(reader(path(f"map{degree}.ply")), wanted))
            judge(what, differences_of_splat(reader(path(f"splat{degree}.ply")), wanted))
        judge(f"degree {degree}, .glb in pygltflib",
              differences_within([turned(row, "xy") for row in rows_of_glb(path(f"m{degree}.glb"))], wanted, GLB_STEPS))
        in_range = clamped(wanted)
        for what, found in (("gsply", rows_of_gsply(gsply.read_spz(path(f"m{degree}.spz")))),
                            ("gaussforge", rows_of_gaussforge(path(f"m{degree}.spz"), "spz"))):
            judge(f"degree {degree}, .spz in {what}",
                  differences_within([turned(row, "yz") for row in found], in_range, SPZ_STEPS))
        for name in OTHERS:
            name = name.format(degree)
            found = read_with_plyfile(path(name + ".ply"))
            steps = PACKED_STEPS
            rows = wanted
            if name.endswith(".spz"):
                found = [turned(row, "yz") for row in found]
                steps = {**OTHER_SPZ_STEPS, "rot": 0.16} if name.startswith("forge2") else OTHER_SPZ_STEPS
                rows = in_range
            elif name.endswith(".sog"):
                steps = {**PACKED_STEPS, "f_rest": 2.0, "scale": 5 / 255,
                         "rot": 3 / (255 * math.sqrt(2))}
            judge(f"{name} in odosplat", differences_within(found, rows, steps))
    print(f"4 maps of {COUNT} Gaussians in 4 readers, and of 2 writers in {len(OTHERS)} formats: {failures} values differ")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odosplat", help="the program to judge")
    parser.add_argument("--venv", help="folder of the virtual environment for the readers")
    parser.add_argument("--worker", help=argparse.SUPPRESS)  # the folder of the maps
    parser.add_argument("--write", action="store_true", help=argparse.SUPPRESS)  # instead of comparing
    options = parser.parse_args()
    if options.worker:
        return made_by_others(options.worker) if options.write else compare(options.worker)
    if not options.odosplat or not options.venv:
        parser.error("--odosplat and --venv are needed")
    python = python_with(options.venv, READERS)
    with tempfile.TemporaryDirectory() as scratch:
        def path(name):
            return os.path.join(scratch, name)

        def convert(source, target):
            subprocess.run([options.odosplat, "convert", path(source), path(target), "--log", "off"], check=True,
                           stdout=subprocess.DEVNULL)

        # gsply compiles with numba, whose cache folder is set here.
        environment = dict(os.environ, NUMBA_CACHE_DIR=os.path.join(options.venv, "numba"))

        def worker(*flags):
            return subprocess.run([python, os.path.abspath(__file__), "--worker", scratch, *flags], check=False,
                                  env=environment).returncode

        for degree in range(4):
            write_text_ply(path(f"text{degree}.ply"), made_map(degree))
            write_text_ply(path(f"unit_text{degree}.ply"), with_unit_rotations(made_map(degree)))
            convert(f"unit_text{degree}.ply", f"unit{degree}.ply")
            for source, target in ((f"text{degree}.ply", f"map{degree}.ply"), (f"map{degree}.ply", f"m{degree}.splat"),
                                   (f"m{degree}.splat", f"splat{degree}.ply"), (f"map{degree}.ply", f"m{degree}.glb"),
                                   (f"map{degree}.ply", f"m{degree}.spz")):
                convert(source, target)
        if worker("--write") != 0:
            return 1
        for degree in range(4):
            for name in OTHERS:
                convert(name.format(degree), name.format(degree) + ".ply")
        return worker()


if __name__ == "__main__":
    sys.exit(main())
