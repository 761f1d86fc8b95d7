#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Where single images were taken: a line for each, with its pose or the reason why it has none.

    python relocalise_images.py map.ply camera.yaml a.jpg b.jpg

Needs opencv-python (or opencv-python-headless).
"""

import sys

import cv2
import numpy as np

import odosplat


def main() -> None:
    if len(sys.argv) < 4:
        raise SystemExit(f"usage: {sys.argv[0]} map.ply camera.yaml IMAGE...")
    relocalizer = odosplat.Relocalizer(
        odosplat.Map.read(sys.argv[1]), odosplat.Camera.read(sys.argv[2]), color_order="bgr"
    )
    for name in sys.argv[3:]:
        image = cv2.imread(name)
        if image is None:
            raise SystemExit(f"{name}: cannot be read as an image")
        answer = relocalizer.locate(image)
        if answer.T_world_camera is None:
            print(f"{name}: not found: {answer.reason} (score {answer.score:.2f})")
            continue
        with np.printoptions(precision=4, suppress=True):
            print(f"{name}: at {answer.T_world_camera[:3, 3]} m, probability {answer.probability:.4f}")
    if relocalizer.likely_cause:
        print(relocalizer.likely_cause)


if __name__ == "__main__":
    main()
