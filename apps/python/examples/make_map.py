#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""A map from a cloud and posed images: of a sequence, or of image files with a list of poses.

    python make_map.py MAPPING --cloud cloud.ply --out map.ply
    python make_map.py MAPPING --out map.ply                        # the cloud from the sequence's depth images
    python make_map.py --images a.png b.png c.png --poses poses.txt --camera camera.yaml --cloud cloud.ply --out map.ply

poses.txt: a line "time tx ty tz qx qy qz qw" for each image, camera to world. The last form needs opencv-python.
"""

import argparse

import odosplat


def show(step: int, steps: int, psnr_db: float, gaussians: int) -> None:
    if step % 100 == 0 or step == steps:
        print(f"\r{step}/{steps}  {psnr_db:.1f} dB  {gaussians} Gaussians", end="", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sequence", nargs="?", help="a sequence with poses")
    parser.add_argument("--images", nargs="+", help="image files instead of a sequence")
    parser.add_argument("--poses", help="of the image files")
    parser.add_argument("--camera", help="camera.yaml of the image files")
    parser.add_argument("--cloud", help="point cloud of the same place [m]")
    parser.add_argument("--every", type=int, default=10, help="of a sequence: train on every Nth image")
    parser.add_argument("--iterations", type=int, help="steps of training (default: the preset's)")
    parser.add_argument("--out", required=True)
    flags = parser.parse_args()

    if flags.sequence:
        sequence = odosplat.Sequence(flags.sequence)
        cloud = flags.cloud or odosplat.build_cloud(sequence, every=flags.every)
        made = odosplat.train(sequence, cloud, every=flags.every, iterations=flags.iterations, progress=show)
    else:
        if not (flags.images and flags.poses and flags.camera and flags.cloud):
            parser.error("without a sequence, --images, --poses, --camera and --cloud are needed")
        import cv2

        images = [cv2.imread(name) for name in flags.images]
        missing = [name for name, image in zip(flags.images, images) if image is None]
        if missing:
            raise SystemExit(f"{missing[0]}: cannot be read as an image")
        made = odosplat.train_on_images(
            images,
            odosplat.read_trajectory(flags.poses).T_world_camera,
            odosplat.Camera.read(flags.camera),
            flags.cloud,
            color_order="bgr",
            iterations=flags.iterations,
            progress=show,
        )
    made.write(flags.out)
    print(f"\n{flags.out}: {len(made)} Gaussians; the map is {made.quality['verdict']}")


if __name__ == "__main__":
    main()
