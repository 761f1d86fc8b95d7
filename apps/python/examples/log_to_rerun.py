#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Tracks a sequence and logs map, images, poses and their certainty to rerun.

    python log_to_rerun.py LIVE --map map.ply --save run.rrd       # rerun run.rrd shows it
    python log_to_rerun.py LIVE --map map.ply                      # opens the viewer

Needs rerun-sdk.
"""

import argparse

import numpy as np
import rerun as rr

import odosplat


def log_map(name: str, shown: odosplat.Map, most: int = 200_000) -> None:
    """The Gaussians' centres in their colour from anywhere (degree 0)."""
    opaque = np.flatnonzero(shown.opacity_logits > -2.0)[:most]
    colors = np.clip(0.5 + 0.28209479 * shown.sh[opaque, 0], 0.0, 1.0)
    sizes = np.exp(shown.log_scales[opaque]).max(axis=1)
    rr.log(name, rr.Points3D(shown.positions[opaque], colors=colors, radii=sizes), static=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sequence")
    parser.add_argument("--map", required=True)
    parser.add_argument("--save", help="file to write instead of opening the viewer")
    flags = parser.parse_args()

    rr.init("odosplat", spawn=not flags.save)
    if flags.save:
        rr.save(flags.save)
    rr.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    shown = odosplat.Map.read(flags.map)
    log_map("world/map", shown)

    sequence = odosplat.Sequence(flags.sequence)
    camera = sequence.camera
    rr.log(
        "world/camera/image",
        rr.Pinhole(image_from_camera=camera.matrix, width=camera.width, height=camera.height),
        static=True,
    )
    tracker = odosplat.Tracker(shown, camera, "auto")
    for i in range(len(sequence)):
        color = sequence.color(i)
        pose = tracker.track(color, sequence.time(i))
        rr.set_time("time", duration=pose.time)
        rr.log("world/camera/image", rr.Image((255 * color).astype(np.uint8)))
        rr.log("status/in_map", rr.Scalars(float(pose.in_map)))
        if pose.T_world_camera is None or pose.covariance is None:
            rr.log("world/camera", rr.Clear(recursive=False))
            continue
        T = pose.T_world_camera
        rr.log("world/camera", rr.Transform3D(translation=T[:3, 3], mat3x3=T[:3, :3]))
        rr.log("status/rotation_sigma_deg", rr.Scalars(np.degrees(np.sqrt(np.trace(pose.covariance[3:, 3:])))))
    tracker.finish()
    path = tracker.trajectory()
    rr.log("world/path", rr.LineStrips3D([path.T_world_camera[:, :3, 3]]), static=True)
    print(tracker.statistics())


if __name__ == "__main__":
    main()
