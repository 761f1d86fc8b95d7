# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence as ListOf, Union

import numpy.typing as npt

from . import _core
from ._sequence import Sequence
from ._types import Frames, ImageArray, PathLike, path_bytes, seed_of


class Cloud(NamedTuple):
    """Points of a place, float32: points [N x 3] m; colors [N x 3] R G B 0..1, or None; normals [N x 3], or None."""

    points: ImageArray
    colors: Optional[ImageArray] = None
    normals: Optional[ImageArray] = None


# A file, a Cloud, or an array of points [N x 3].
CloudLike = Union[PathLike, Cloud, npt.NDArray[Any]]


def cloud_argument(cloud: CloudLike) -> Any:
    """A cloud as the library takes it: bytes of a path, a tuple, or an array."""
    if isinstance(cloud, (str, bytes)) or hasattr(cloud, "__fspath__"):
        return path_bytes(cloud)  # type: ignore[arg-type]
    return cloud


def sequence_list(sequences: Union[Sequence, ListOf[Sequence]]) -> list[Any]:
    """What the library has of each sequence."""
    given = [sequences] if isinstance(sequences, Sequence) else list(sequences)
    for sequence in given:
        if not isinstance(sequence, Sequence):
            raise _core.InputError(f"sequences: must be odosplat.Sequence, has {type(sequence).__name__}")
    return [sequence._held for sequence in given]


def read_cloud(path: PathLike, *, voxel: float = 0.0, remove_outliers: bool = False) -> Cloud:
    """Reads PLY, PCD, LAS or text. voxel [m]: thinned to one point per voxel of this edge, 0: as it is."""
    return Cloud(*_core.read_cloud(path_bytes(path), voxel, remove_outliers))


def write_cloud(path: PathLike, cloud: Union[Cloud, npt.NDArray[Any]]) -> None:
    """Writes a PLY, whole or not at all."""
    _core.write_cloud(path_bytes(path), cloud)


def build_cloud(
    sequences: Union[Sequence, ListOf[Sequence]],
    *,
    every: int = 10,
    frames: Frames = None,
    voxel: float = 0.03,
    remove_outliers: bool = False,
    noise: float = 0.0,
    seed: int = 0,
) -> Cloud:
    """The cloud of sequences' depth images and true poses, as `odosplat cloud` makes it.

    every: use every Nth image; frames: (begin, end) of each sequence. voxel [m]: one point per voxel of this edge.
    noise [m]: standard deviation of simulated range noise, with its seed.
    """
    return Cloud(
        *_core.build_cloud(sequence_list(sequences), every, frames, remove_outliers, voxel, noise, seed_of(seed))
    )
