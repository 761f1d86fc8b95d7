# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional, Tuple

import numpy as np

from . import _core
from ._types import FloatArray, PathLike, path_bytes


@dataclass(frozen=True)
class DepthCamera:
    """The camera of depth images that are not registered to the colour images. Without distortion.

    ``T_color_depth`` [4 x 4]: p_color = T_color_depth @ p_depth [m]. ``time_offset`` [s]: as that of a Camera.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    T_color_depth: FloatArray = field(default_factory=lambda: np.eye(4), compare=False)
    time_offset: float = 0.0


@dataclass(frozen=True)
class Camera:
    """A camera, as camera.yaml describes it (docs/formats.md).

    width, height, fx, fy, cx, cy [px], fx and fy positive; pixel (0, 0) is the centre of the top-left pixel.
    distortion: k1 k2 p1 p2 (k3), OpenCV's model; empty: none. ``Tracker``, ``Relocalizer`` and ``train_on_images`` take
    images as the camera gives them and remove distortion (and the vignette) themselves; rendered images and those of a
    ``Sequence`` have none.
    fps [1/s], 0: not given. fy_sign: -1 if the file has a negative fy, so that poses are reflected as they are read.
    depth_scale: units of a 16-bit depth image per metre, None: the layout's. time_offset [s]: an image was taken this much
    after its stamp. line_time [s per row] of a rolling shutter: from one row to the next, negative if the last row is taken
    first, 0: all rows at once; a time and a pose are those of the middle row. gamma of the response, 0: not given.
    vignette: an image file, "": none.
    depth_camera: None if depth images are registered to the colour images.

    Raises InputError for an implausible camera.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: Tuple[float, ...] = ()
    fps: float = 0.0
    fy_sign: int = 1
    depth_scale: Optional[float] = None
    time_offset: float = 0.0
    line_time: float = 0.0
    gamma: float = 0.0
    vignette: str = ""
    depth_camera: Optional[DepthCamera] = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "distortion", tuple(float(value) for value in self.distortion))
        _core.check_camera(self)

    @classmethod
    def read(cls, path: PathLike) -> Camera:
        """Reads a camera.yaml, or a camera file of OpenCV, ROS, Kalibr or EuRoC."""
        return camera_of(_core.read_camera(path_bytes(path)))

    def write(self, path: PathLike) -> None:
        """Writes a camera.yaml, whole or not at all.

        read() gives back the same numbers (depth_scale None: 1000; line_time: to rounding).
        """
        _core.write_camera(path_bytes(path), self)

    @property
    def matrix(self) -> FloatArray:
        """[3 x 3]: pixel = matrix @ (x/z, y/z, 1), without distortion."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])


def camera_of(fields: dict[str, Any]) -> Camera:
    """A camera of the fields that the library gives."""
    depth = fields.pop("depth_camera")
    return Camera(**fields, depth_camera=None if depth is None else DepthCamera(**depth))
