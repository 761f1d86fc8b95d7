#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Poses with covariance of a webcam or a video in a map.

    python track_camera.py 0 --camera camera.yaml --map map.ply         # webcam number 0
    python track_camera.py walk.mp4 --camera camera.yaml --map map.ply

Prints a line for each image: time, status, position [m], its standard deviation [mm], and whether the map confirms it.
Needs opencv-python (or opencv-python-headless).
"""

import argparse
import time

import cv2
import numpy as np

import odosplat


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source", help="number of a webcam, or a video")
    parser.add_argument("--camera", required=True, help="camera.yaml of the images as they come, distortion included")
    parser.add_argument("--map", required=True)
    parser.add_argument("--out", help="trajectory to write at the end")
    flags = parser.parse_args()

    live = flags.source.isdigit()
    images = cv2.VideoCapture(int(flags.source) if live else flags.source)
    if not images.isOpened():
        raise SystemExit(f"{flags.source}: cannot be opened as images")
    camera = odosplat.Camera.read(flags.camera)
    tracker = odosplat.Tracker(odosplat.Map.read(flags.map), camera, "auto", color_order="bgr", background=live)

    fps = camera.fps or images.get(cv2.CAP_PROP_FPS)
    number = 0
    try:
        while True:
            read, bgr = images.read()
            if not read:
                break
            seconds = time.monotonic() if live else number / fps
            number += 1
            pose = tracker.track(bgr, seconds)
            if pose.T_world_camera is None or pose.covariance is None:
                print(f"{seconds:.3f} lost")
                continue
            x, y, z = pose.T_world_camera[:3, 3]
            # A covariance is about the world's origin; at the camera, a turn about the origin moves it, too.
            J = np.hstack([np.eye(3), -cross(pose.T_world_camera[:3, 3])])
            sigma = np.sqrt(np.diag(J @ pose.covariance @ J.T))
            print(
                f"{seconds:.3f} {pose.status} {x:.4f} {y:.4f} {z:.4f} +- "
                f"{1000 * sigma[0]:.1f} {1000 * sigma[1]:.1f} {1000 * sigma[2]:.1f} mm "
                f"{'in the map' if pose.in_map else 'not confirmed'}"
            )
    except KeyboardInterrupt:
        pass
    tracker.finish()
    print(tracker.statistics())
    if flags.out:
        tracker.write_trajectory(flags.out)


def cross(v: np.ndarray) -> np.ndarray:
    """The matrix with cross(v) @ w = v x w."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


if __name__ == "__main__":
    main()
