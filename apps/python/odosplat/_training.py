# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from typing import Any, Callable, Mapping, Optional, Sequence as ListOf, Union

from . import _core
from ._camera import Camera
from ._cloud import CloudLike, cloud_argument, sequence_list
from ._map import Map
from ._sequence import Sequence
from ._types import AnyImage, DeviceLike, FloatArray, Frames, ImageArray, PoseLike, device_text, option_lines, seed_of

# Called after every step with: step, steps, PSNR [dB] (0: not known yet), number of Gaussians.
ProgressCall = Callable[[int, int, float, int], None]


def train(
    sequences: Union[Sequence, ListOf[Sequence]],
    cloud: CloudLike,
    *,
    every: int = 10,
    frames: Frames = None,
    preset: str = "default",
    iterations: Optional[int] = None,
    budget: int = 0,
    densify: Optional[str] = None,
    exposure: Optional[bool] = None,
    depth_weight: Optional[float] = None,
    sh_degree: Optional[int] = None,
    blend_order: Optional[str] = None,
    voxel: float = 0.0,
    remove_outliers: bool = False,
    seed: int = 42,
    options: Optional[Mapping[str, float]] = None,
    device: DeviceLike = None,
    progress: Optional[ProgressCall] = None,
) -> Map:
    """A map from posed images and a cloud of the same place, in one world frame [m].

    The same map, to the bit, as `odosplat train` makes on the same device with the flags of these names
    (`odosplat train --help`).

    cloud: a file, a Cloud, or points [N x 3]. every: train on every Nth image; frames: (begin, end) of each sequence.
    preset: "default" or "paper". iterations: steps of one image each, None: the preset's (4000, and at least 8 for each
    image). budget: most Gaussians, 0: one for each point, and the preset's limit of growth. densify: "none", "relocate" or
    "split". exposure: learn that of each image. blend_order: "distance" or "depth". voxel [m]: thin a file's points.
    options: train.* of options(). progress: called after every step; what it raises ends training.

    Ctrl-C raises KeyboardInterrupt within a step; nothing is kept.
    """
    settings = _settings(every, frames, preset, iterations, budget, densify, exposure, depth_weight, sh_degree)
    settings.update(blend_order=blend_order, voxel=voxel, remove_outliers=remove_outliers, seed=seed_of(seed))
    return Map(
        _core.train(
            sequence_list(sequences),
            cloud_argument(cloud),
            settings,
            option_lines(options),
            device_text(device),
            progress,
        )
    )


def train_on_images(
    images: ListOf[AnyImage],
    T_world_camera: Union[FloatArray, ListOf[PoseLike]],
    camera: Camera,
    cloud: CloudLike,
    *,
    color_order: str = "rgb",
    depths: Optional[ListOf[Optional[ImageArray]]] = None,
    preset: str = "default",
    iterations: Optional[int] = None,
    budget: int = 0,
    densify: Optional[str] = None,
    exposure: Optional[bool] = None,
    depth_weight: Optional[float] = None,
    sh_degree: Optional[int] = None,
    blend_order: Optional[str] = None,
    voxel: float = 0.0,
    remove_outliers: bool = False,
    seed: int = 42,
    options: Optional[Mapping[str, float]] = None,
    device: DeviceLike = None,
    progress: Optional[ProgressCall] = None,
) -> Map:
    """The same from images [H x W x 3] in memory (uint8 or float32), all of one camera, and as many poses.

    color_order: "rgb", or "bgr" for images of OpenCV. depths: measured depth [H x W], float32 m, of each image or None; not
    trained on, but used to calibrate the map's sigma. The map's header does not name training frames.
    """
    settings = _settings(1, None, preset, iterations, budget, densify, exposure, depth_weight, sh_degree)
    settings.update(blend_order=blend_order, voxel=voxel, remove_outliers=remove_outliers, seed=seed_of(seed))
    return Map(
        _core.train_on_images(
            list(images),
            T_world_camera,
            camera,
            color_order,
            None if depths is None else list(depths),
            cloud_argument(cloud),
            settings,
            option_lines(options),
            device_text(device),
            progress,
        )
    )


def _settings(
    every: int,
    frames: Frames,
    preset: str,
    iterations: Optional[int],
    budget: int,
    densify: Optional[str],
    exposure: Optional[bool],
    depth_weight: Optional[float],
    sh_degree: Optional[int],
) -> dict[str, Any]:
    return {
        "every": every,
        "frames": frames,
        "preset": preset,
        "iterations": iterations,
        "budget": budget,
        "densify": densify,
        "exposure": exposure,
        "depth_weight": depth_weight,
        "sh_degree": sh_degree,
    }
