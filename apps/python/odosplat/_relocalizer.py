# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, Optional, Sequence as ListOf, Union

from . import _core
from ._camera import Camera
from ._map import Map
from ._types import AnyImage, DeviceLike, FloatArray, PoseLike, device_text, option_lines


@dataclass(frozen=True)
class Location:
    """Where an image was taken, or why that is not known.

    T_world_camera [4 x 4] and covariance [6 x 6] are None if not found. covariance: as in Pose.
    """

    found: bool
    T_world_camera: Optional[FloatArray]
    covariance: Optional[FloatArray]
    probability: float
    """0..1, that the best pose is right, also if it was refused; 0 where nothing could be compared."""
    score: float
    """-1..1, correlation of image and map at the best pose, also if it was refused."""
    inlier_share: float
    reason: str
    """Why not found; "" if found."""


class Relocalizer:
    """Finds single images in a map, without a start pose; as `odosplat relocalise`.

    Arguments as those of Tracker; options: relocaliser.*. Errors of the camera's calibration are estimated from the images that
    were found so far; an image is refused where they would move its pose by centimetres.
    """

    def __init__(
        self,
        map: Map,
        camera: Camera,
        *,
        color_order: str = "rgb",
        places: Union[None, FloatArray, ListOf[PoseLike]] = None,
        options: Optional[Mapping[str, float]] = None,
        device: DeviceLike = None,
    ) -> None:
        if not isinstance(map, Map):
            raise _core.InputError(f"map: must be an odosplat.Map, is {type(map).__name__}")
        self._held = _core.make_relocalizer(
            map._held, camera, color_order, places, option_lines(options), device_text(device)
        )

    def prepare(self) -> int:
        """Renders the map from its places now rather than in the first locate(). Returns how many see enough of it."""
        return self._held.prepare()

    def locate(self, image: AnyImage) -> Location:
        """Looks one image up: uint8 or float32 (0..1), [H x W] or [H x W x 3], of the camera's size."""
        return Location(**self._held.locate(image))

    @property
    def likely_cause(self) -> str:
        """What is probably wrong with the camera, by the images found so far; "": nothing significant."""
        return self._held.likely_cause()
