# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Types of arguments, and what several parts of the package convert."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core

PathLike = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
# [4 x 4], or tx ty tz qx qy qz qw.
PoseLike = Union[npt.NDArray[np.float64], Sequence[float], Sequence[Sequence[float]]]
FloatArray = npt.NDArray[np.float64]
ImageArray = npt.NDArray[np.float32]
# uint8 or float32.
AnyImage = npt.NDArray[Any]
DeviceLike = Union[None, str, int]
Frames = Optional[Tuple[int, Optional[int]]]


def path_bytes(path: PathLike) -> bytes:
    """The bytes of a file's name, whatever they are."""
    try:
        return os.fsencode(path)
    except TypeError:
        raise _core.InputError(f"path: must be a string or a path, is {type(path).__name__}") from None


def device_text(device: DeviceLike) -> str:
    """The device as the library selects it: an index, a part of a name, or empty."""
    if device is None:
        return ""
    if isinstance(device, bool) or not isinstance(device, (str, int)):
        raise _core.InputError(f"device: must be an index or a part of a name, is {type(device).__name__}")
    return str(device)


def option_lines(options: Optional[Mapping[str, float]]) -> list[str]:
    """Options as NAME=VALUE; repr() of a number reads back as the same one."""
    lines = []
    for name, value in (options or {}).items():
        if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
            raise _core.InputError(f"options: {name}: must be a number, is {type(value).__name__}")
        number = int(value) if isinstance(value, (int, np.integer)) else float(value)
        lines.append(f"{name}={number!r}")
    return lines


def seed_of(seed: int) -> int:
    """A seed of 64 bits."""
    if not isinstance(seed, (int, np.integer)) or isinstance(seed, bool) or not 0 <= int(seed) < 2**64:
        raise _core.InputError(f"seed: must be a whole number in 0..2^64 - 1, is {seed!r}")
    return int(seed)
