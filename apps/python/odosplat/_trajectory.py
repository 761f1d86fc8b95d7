# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from typing import NamedTuple, Optional, Tuple, Union

from . import _core
from ._types import FloatArray, PathLike, path_bytes


class Trajectory(NamedTuple):
    """Poses over time: times [N] in seconds, ascending; T_world_camera [N x 4 x 4]."""

    times: FloatArray
    T_world_camera: FloatArray


TrajectoryLike = Union[Trajectory, Tuple[FloatArray, FloatArray]]


def read_trajectory(path: PathLike, times: Optional[PathLike] = None) -> Trajectory:
    """Reads TUM, KITTI, EuRoC, Replica, ICL-NUIM or Redwood poses; times: a file of times for formats without."""
    return Trajectory(*_core.read_trajectory(path_bytes(path), b"" if times is None else path_bytes(times)))


def write_trajectory(path: PathLike, trajectory: TrajectoryLike) -> None:
    """Writes TUM format ("time tx ty tz qx qy qz qw", 9 decimals), whole or not at all."""
    times, poses = trajectory
    _core.write_trajectory(path_bytes(path), times, poses)
