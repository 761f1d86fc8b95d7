# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from typing import NamedTuple, Union

from . import _core


class Option(NamedTuple):
    """A value that ``options={name: value}`` of Tracker, Relocalizer and train sets."""

    name: str
    default: Union[int, float]
    least: float
    most: float
    unit: str
    meaning: str


def options() -> list[Option]:
    """All options. Tracker takes odometry.* and relocaliser.*, Relocalizer relocaliser.*, train train.* (docs/options.md)."""
    return [Option(**row) for row in _core.options()]
