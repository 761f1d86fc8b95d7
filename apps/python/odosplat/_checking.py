# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

import json
from typing import Any, Mapping, NamedTuple, Optional, Sequence as ListOf

from . import _core
from ._camera import Camera, camera_of
from ._cloud import CloudLike, cloud_argument
from ._map import Map
from ._sequence import Sequence
from ._types import DeviceLike, device_text


def check(
    sequence: Sequence, cloud: Optional[CloudLike] = None, *, gap: int = 20, pairs: int = 32
) -> Mapping[str, Any]:
    """Whether images, poses, camera, depth and cloud agree with what their files say; as `odosplat check`.

    By depth images, a cloud, or both. Returns what `odosplat check --json` writes: "answer" is "agree", "differ" or
    "undecided", "verdict" one line, "findings" a list. gap, pairs: of the images with depth that are compared.
    """
    held = _held_of(sequence)
    report: Mapping[str, Any] = json.loads(
        _core.check(held, None if cloud is None else cloud_argument(cloud), gap, pairs)
    )
    return report


class Calibration(NamedTuple):
    """A camera that images with poses ask for."""

    camera: Camera
    """What is significant is corrected, the rest is as declared; write() makes the camera.yaml."""
    measured: Mapping[str, Any]
    """Values with standard deviations, as `odosplat calibrate --json` writes them; None: not determined."""
    verdict: str


def calibrate(
    sequence: Sequence,
    *,
    map: Optional[Map] = None,
    cloud: Optional[CloudLike] = None,
    what: ListOf[str] = (),
    pairs: int = 48,
    device: DeviceLike = None,
) -> Calibration:
    """The camera that images with poses ask for, as `odosplat calibrate`; by the depth of a map, a cloud, or the sequence.

    what: some of "focal", "center", "distortion", "time", "line_time", "depth"; the rest stays as declared. Empty: all.
    Raises NoResult if the images do not determine it.
    """
    held = _held_of(sequence)
    fields, measured, verdict = _core.calibrate(
        held,
        None if map is None else map._held,
        None if cloud is None else cloud_argument(cloud),
        list(what),
        pairs,
        device_text(device),
    )
    return Calibration(camera_of(fields), json.loads(measured), verdict)


def _held_of(sequence: Sequence) -> Any:
    if not isinstance(sequence, Sequence):
        raise _core.InputError(f"sequence: must be an odosplat.Sequence, is {type(sequence).__name__}")
    return sequence._held
