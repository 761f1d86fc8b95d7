# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, NamedTuple, Optional, Sequence as ListOf, Union

from . import _core
from ._camera import Camera
from ._map import Map
from ._trajectory import Trajectory
from ._types import AnyImage, DeviceLike, FloatArray, PathLike, PoseLike, device_text, option_lines, path_bytes, seed_of


@dataclass(frozen=True)
class Pose:
    """The result for one image. Use a pose if ``status`` is not "lost" and ``in_map`` is true.

    T_world_camera [4 x 4] and covariance [6 x 6] are None when lost. covariance: of xi = (translation [m], rotation [rad]) in
    T_true = exp(xi) @ T_world_camera, in that order: tx ty tz rx ry rz.
    """

    time: float
    """[s] as given."""
    status: str
    """"ok": tracked from the images before. "relocalised": found without them. "lost"."""
    T_world_camera: Optional[FloatArray]
    covariance: Optional[FloatArray]
    in_map: bool
    """The map confirms this pose, or cannot be compared here but has confirmed one of the last frames."""
    confirmed: Optional[float]
    """Probability, 0..1, that the pose is right, by comparing the image with the map; None: not compared."""
    keyframe: bool
    """Became a keyframe. With background=True that comes later: Tracker.keyframe_times()."""
    inlier_share: float
    """Share of the points in view that agree."""
    map_share: float
    """Share of the image where the map has depth, of the last image that was tried as keyframe."""
    camera_shift: float
    """[m] how far errors of the camera's calibration seem to have moved the pose; part of its covariance."""
    milliseconds: float


class TrackStatistics(NamedTuple):
    """Sums over all images so far."""

    frames: int
    posed: int
    lost: int
    relocalisations: int
    keyframes: int
    confirmed: int
    refused: int
    likely_cause: str
    """What is probably wrong with the camera, by the images; "": nothing significant."""


class Tracker:
    """Finds the poses of a camera's images in a map, in order of time; as `odosplat track`.

    camera: of the images as they come. start: the pose of the first image, or "auto" (the same as None): images are looked up
    in the map until one is found. relocalise: look lost images up in the map. background: for live cameras; keyframes are made
    on a thread of their own while track() goes on, and poses then depend on timing. False: same input, same bits.
    color_order: "rgb", or "bgr" for images of OpenCV; colour images only. seed: of the pixel selector.
    places: poses to look up from, None: where the map's training images were taken.
    options: odometry.* and relocaliser.* of options(). device: see devices().
    """

    def __init__(
        self,
        map: Map,
        camera: Camera,
        start: Union[None, str, PoseLike] = None,
        *,
        color_order: str = "rgb",
        relocalise: bool = True,
        background: bool = False,
        options: Optional[Mapping[str, float]] = None,
        seed: int = 3141592,
        places: Union[None, FloatArray, ListOf[PoseLike]] = None,
        device: DeviceLike = None,
    ) -> None:
        if isinstance(start, str):
            if start != "auto":
                raise _core.InputError(f'start: must be "auto" or a pose, is {start!r}')
            start = None
        if not isinstance(map, Map):
            raise _core.InputError(f"map: must be an odosplat.Map, is {type(map).__name__}")
        self._held = _core.make_tracker(
            map._held,
            camera,
            color_order,
            start,
            relocalise,
            background,
            seed_of(seed),
            places,
            option_lines(options),
            device_text(device),
        )

    def track(self, image: AnyImage, time: float) -> Pose:
        """The pose of the next image, taken at `time` [s], which must grow from call to call.

        image: uint8 or float32 (0..1), [H x W] or [H x W x 3], of the camera's size.
        """
        return Pose(**self._held.track(image, time))

    def finish(self) -> None:
        """With background=True: waits for the keyframe in the making. Else does nothing."""
        self._held.finish()

    def trajectory(self) -> Trajectory:
        """The final estimate of every posed image: later images improve the poses of earlier ones."""
        return Trajectory(*self._held.trajectory())

    def write_trajectory(self, path: PathLike) -> None:
        """The same into a file: the trajectory.txt of `odosplat track`."""
        self._held.write_trajectory(path_bytes(path))

    def keyframe_times(self) -> list[float]:
        """Times of the images that have become keyframes, s."""
        return self._held.keyframe_times()

    def statistics(self) -> TrackStatistics:
        return TrackStatistics(**self._held.statistics())
