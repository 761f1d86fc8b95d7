# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

import os
from typing import Optional

from . import _core
from ._camera import Camera, camera_of
from ._trajectory import Trajectory
from ._types import FloatArray, ImageArray, PathLike, path_bytes


class Sequence:
    """A recorded sequence: images with times and, where the data set has them, depth and poses (docs/data.md).

    path: a folder in a layout that the program reads (TUM, ICL-NUIM, Redwood, 7-Scenes, Replica, COLMAP, nerfstudio, images),
    or a video. layout: "" to detect it. camera: a camera file to use instead of the sequence's own.
    max_image_pixels: larger images are refused before they are decoded.

    Images are decoded when they are asked for, without lens distortion. Indices are 0..len - 1; negative ones count from the
    end. Safe to be used by several threads.
    """

    def __init__(
        self,
        path: PathLike,
        *,
        layout: str = "",
        camera: Optional[PathLike] = None,
        max_image_pixels: Optional[int] = None,
    ) -> None:
        self._held = _core.open_sequence(
            path_bytes(path), layout, b"" if camera is None else path_bytes(camera), max_image_pixels or 0
        )
        size = len(self)
        self._times = [self._held.time(i) for i in range(size)]

    def _index(self, i: int) -> int:
        size = len(self._times)
        if not -size <= i < size:
            raise IndexError(f"{self.name} has {size} images, there is no image {i}")
        return i % size

    def __len__(self) -> int:
        return self._held.size()

    def __repr__(self) -> str:
        return f"<odosplat.Sequence {self.name}, {len(self)} images>"

    @property
    def name(self) -> str:
        """The last part of the path."""
        return os.fsdecode(self._held.name())

    @property
    def layout(self) -> str:
        return self._held.layout()

    @property
    def fps(self) -> float:
        """Images per second, by the camera file or the median of the times' steps."""
        return self._held.fps()

    @property
    def times(self) -> list[float]:
        """Times of all images, s."""
        return list(self._times)

    @property
    def camera(self) -> Camera:
        """The pinhole camera of the images that color(), gray() and depth() give."""
        return camera_of(self._held.camera())

    @property
    def camera_file(self) -> Camera:
        """The camera as its file or the layout declares it, with distortion."""
        return camera_of(self._held.camera_file())

    def time(self, i: int) -> float:
        """Time of an image, s."""
        return self._times[self._index(i)]

    def color(self, i: int) -> ImageArray:
        """[H x W x 3], float32, R G B, 0..1."""
        return self._held.color(self._index(i))

    def gray(self, i: int) -> ImageArray:
        """[H x W], float32, 0..1, ITU-R 601 luma of color(i)."""
        return self._held.gray(self._index(i))

    def has_depth(self, i: int) -> bool:
        return self._held.has_depth(self._index(i))

    def depth(self, i: int) -> ImageArray:
        """[H x W], float32, m, 0 = none. InputError where there is none."""
        return self._held.depth(self._index(i))

    def T_world_camera(self, i: int) -> Optional[FloatArray]:
        """[4 x 4], the true pose of an image; None: not known."""
        return self._held.T_world_camera(self._index(i))

    def T_world_depth(self, i: int) -> Optional[FloatArray]:
        """[4 x 4], the same when its depth image was taken."""
        return self._held.T_world_depth(self._index(i))

    def truth(self) -> Trajectory:
        """The true poses by the images' stamps, to compare estimates with. May be empty."""
        return Trajectory(*self._held.truth())
