#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Has laspy, plyfile and pycolmap write small files and compares what odosplat reads of them with what was written.

compare_with_public_readers.py --odosplat BINARY --venv FOLDER

Clouds in LAS (point formats with 16-bit colours) and PLY (every encoding, colours of several types, names of properties
in both cases) go through `odosplat convert` to PLY, which plyfile reads back; COLMAP models (text and binary, names
with blanks) go through `odosplat align` to a trajectory and a camera file. The writers are installed from PyPI into the
virtual environment --venv, made if missing. Exit 1 on a difference, 77 (skipped) where PyPI is out of reach.
"""
import argparse
import os
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
from venv_packages import python_with, SKIPPED  # noqa: E402

WRITERS = ["laspy==2.6.1", "plyfile==1.1.5", "pycolmap==3.12.5"]
COUNT = 200


def made_cloud():
    """COUNT points [m] and colours 0..65535; one has the maximum, so that readers can recognise the range."""
    import numpy as np
    rng = np.random.default_rng(1)
    points = np.round(rng.uniform(-5.0, 5.0, (COUNT, 3)), 3)
    colors = rng.integers(0, 65536, (COUNT, 3))
    colors[0] = 65535
    return points, colors


def run_odosplat(odosplat, *arguments):
    done = subprocess.run([odosplat, *arguments, "--log", "warning"], check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"odosplat {arguments[0]} ended with {done.returncode}: {done.stderr.strip()}")


def differences_of_cloud(odosplat, source, points, colors, scratch):
    """colors: 0..1, or None if the file has none. The result is written with floats and 8 bits per channel."""
    import numpy as np
    from plyfile import PlyData
    target = os.path.join(scratch, "read.ply")
    run_odosplat(odosplat, "convert", source, target)
    vertex = PlyData.read(target)["vertex"]
    if vertex.count != len(points):
        return [f"{vertex.count} points instead of {len(points)}"]
    faults = []
    found = np.stack([vertex[axis] for axis in "xyz"], axis=1)
    if np.abs(found - points).max() > 1e-6:
        faults.append(f"a point is off by {np.abs(found - points).max():.2e} m")
    names = [p.name for p in vertex.properties]
    if (colors is not None) != ("red" in names):
        return faults + ["colours are " + ("lost" if colors is not None else "made up")]
    if colors is not None:
        found = np.stack([vertex[name] for name in ("red", "green", "blue")], axis=1)
        off = np.abs(found - 255.0 * colors).max()
        if off > 0.501:
            faults.append(f"a colour is off by {off:.2f} of 255")
    return faults


def las_files(folder, points, colors):
    import laspy
    for version, point_format in (("1.2", 0), ("1.2", 2), ("1.2", 3), ("1.4", 6), ("1.4", 7), ("1.4", 8)):
        header = laspy.LasHeader(point_format=point_format, version=version)
        header.scales = [0.001] * 3
        header.offsets = [1.0, -2.0, 0.5]
        las = laspy.LasData(header)
        las.x, las.y, las.z = points.T
        has_colors = point_format in (2, 3, 7, 8)
        if has_colors:
            las.red, las.green, las.blue = colors.T
        path = os.path.join(folder, f"format{point_format}.las")
        las.write(path)
        yield path, colors / 65535.0 if has_colors else None


def ply_files(folder, points, colors):
    import numpy as np
    from plyfile import PlyData, PlyElement
    kinds = (("u1", colors // 257, 255.0), ("u2", colors, 65535.0), ("f4", colors / 65535.0, 1.0))
    for text, order in ((True, "<"), (False, "<"), (False, ">")):
        for kind, values, full in kinds:
            for upper in (False, True):
                names = ("X", "Y", "Z", "Red", "Green", "Blue") if upper else ("x", "y", "z", "red", "green", "blue")
                rows = np.zeros(len(points), dtype=[(n, "f8" if i < 3 else kind) for i, n in enumerate(names)])
                for axis in range(3):
                    rows[names[axis]] = points[:, axis]
                    rows[names[3 + axis]] = values[:, axis]
                path = os.path.join(folder, f"{'text' if text else 'little' if order == '<' else 'big'}_{kind}_{upper}.ply")
                PlyData([PlyElement.describe(rows, "vertex")], text=text, byte_order=order).write(path)
                yield path, values / full


def made_model():
    """A reconstruction and its images: name, camera-to-world rotation (matrix) and position."""
    import numpy as np
    import pycolmap
    rng = random.Random(2)
    model = pycolmap.Reconstruction()
    camera = pycolmap.Camera(model="OPENCV", width=64, height=48,
                             params=[60.0, 61.0, 32.25, 24.5, 0.01, -0.002, 0.001, -0.0015], camera_id=3)
    model.add_camera(camera)
    rig = pycolmap.Rig(rig_id=1)
    rig.add_ref_sensor(camera.sensor_id)
    model.add_rig(rig)
    images = []
    for i in range(1, 7):
        quaternion = np.array([rng.gauss(0.0, 1.0) for _ in range(4)])
        camera_from_world = pycolmap.Rigid3d(pycolmap.Rotation3d(quaternion / np.linalg.norm(quaternion)),
                                             np.array([rng.gauss(0.0, 1.0) for _ in range(3)]))
        image = pycolmap.Image(name=f"walk  one/img {i}.png", camera_id=3, image_id=i)
        image.points2D = pycolmap.Point2DList([pycolmap.Point2D(np.array([1.5, 2.5]))] * (i % 3))
        frame = pycolmap.Frame(frame_id=i, rig_id=1)
        frame.add_data_id(image.data_id)
        frame.rig_from_world = camera_from_world
        image.frame_id = i
        model.add_frame(frame)
        model.add_image(image)
        world_from_camera = camera_from_world.inverse()
        images.append((image.name, world_from_camera.rotation.matrix(), np.array(world_from_camera.translation)))
    for _ in range(500):
        model.add_point3D(np.array([rng.uniform(-3.0, 3.0) for _ in range(3)]), pycolmap.Track(),
                          np.array([200, 100, 50], np.uint8))
    return model, images


def rotation_of(x, y, z, w):
    import numpy as np
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def differences_of_model(odosplat, folder, images, cloud, scratch):
    """The cloud consists of the model's own points, so that align finds the identity except for rounding."""
    import numpy as np
    out = os.path.join(scratch, "aligned")
    run_odosplat(odosplat, "align", "--poses", folder, "--cloud", cloud, "--guess", "1 0 0 0 0 0 0 1", "--out", out)
    faults = []
    with open(os.path.join(out, "groundtruth.txt"), encoding="ascii") as file:
        rows = [[float(word) for word in line.split()] for line in file if not line.startswith("#")]
    with open(os.path.join(out, "rgb.txt"), encoding="ascii") as file:
        listed = [line.split(" ", 1)[1].strip() for line in file if not line.startswith("#")]
    if len(rows) != len(images) or len(listed) != len(images):
        return [f"{len(rows)} poses of {len(listed)} images instead of {len(images)}"]
    for row, path, (name, rotation, position) in zip(rows, listed, images):
        if not path.endswith(name):
            faults.append(f"{path} is not {name}")
        off = max(np.abs(np.array(row[1:4]) - position).max(), np.abs(rotation_of(*row[4:8]) - rotation).max())
        if off > 1e-4:
            faults.append(f"{name}: the pose is off by {off:.2e}")
    with open(os.path.join(out, "camera.yaml"), encoding="ascii") as file:
        camera = dict(line.strip().split(": ", 1) for line in file)
    # The origin of pixel coordinates is the corner of the first pixel in COLMAP, but its centre in odosplat.
    wanted = {"width": 64, "height": 48, "fx": 60.0, "fy": 61.0, "cx": 31.75, "cy": 24.0}
    faults += [f"{key} is {camera[key]}, must be {value}" for key, value in wanted.items() if float(camera[key]) != value]
    if [float(v) for v in camera["distortion"].strip("[]").split(",")][:4] != [0.01, -0.002, 0.001, -0.0015]:
        faults.append(f"distortion is {camera['distortion']}")
    return faults


def write_png(path):
    import struct
    import zlib

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 64, 48, 8, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress((b"\0" + b"\x80" * 64) * 48)) + chunk(b"IEND", b""))


def compare(odosplat, scratch):
    failures = 0
    compared = 0

    def judge(what, faults):
        nonlocal failures, compared
        compared += 1
        failures += len(faults)
        for fault in faults[:5]:
            print(f"{what}: {fault}")

    points, colors = made_cloud()
    for files in (las_files, ply_files):
        for path, wanted in files(scratch, points, colors):
            judge(os.path.basename(path), differences_of_cloud(odosplat, path, points, wanted, scratch))
    model, images = made_model()
    cloud = os.path.join(scratch, "points.ply")
    model.export_PLY(cloud)
    for kind in ("text", "binary"):
        folder = os.path.join(scratch, kind)
        os.makedirs(folder)
        (model.write_text if kind == "text" else model.write_binary)(folder)
        for name, _, _ in images:
            write_png(os.path.join(folder, "images", name))
        judge(f"COLMAP model, {kind}", differences_of_model(odosplat, folder, images, cloud, scratch))
    print(f"{compared} files of laspy, plyfile and pycolmap: {failures} differences")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--odosplat", help="the program to judge", required=True)
    parser.add_argument("--venv", help="folder of the virtual environment for the writers", required=True)
    parser.add_argument("--worker", help=argparse.SUPPRESS)  # the folder to work in
    options = parser.parse_args()
    if options.worker:
        return compare(options.odosplat, options.worker)
    python = python_with(options.venv, WRITERS)
    with tempfile.TemporaryDirectory() as scratch:
        return subprocess.run([python, os.path.abspath(__file__), "--odosplat", os.path.abspath(options.odosplat), "--venv",
                               options.venv, "--worker", scratch], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
