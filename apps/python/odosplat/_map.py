# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

import json
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._camera import Camera
from ._types import DeviceLike, FloatArray, ImageArray, PathLike, PoseLike, device_text, path_bytes


class Rendering(NamedTuple):
    """A map seen from a pose, float32 images of the camera's size.

    color [H x W x 3]: R G B, 0..1, on black. depth [H x W]: m, 0 where the map has none. sigma [H x W]: m, standard deviation
    of depth, 0 where depth is 0. alpha [H x W]: share of the pixel that the map covers, 0..1.
    """

    color: ImageArray
    depth: ImageArray
    sigma: ImageArray
    alpha: ImageArray


class Map:
    """A map of 3D Gaussians. It never changes; its arrays are read-only views of the map's own memory, without copies.

    It may be used by several threads and trackers at a time.
    """

    def __init__(self, held: _core.HeldMap) -> None:
        """For the package itself; use read(), from_arrays() or train()."""
        self._held = held

    @classmethod
    def read(cls, path: PathLike) -> Map:
        """Reads Gaussians of any program for 3D Gaussian Splatting: .ply, packed .ply, .splat, .spz, .glb, .gltf or .sog."""
        return cls(_core.read_map(path_bytes(path)))

    @classmethod
    def from_arrays(
        cls,
        positions: npt.ArrayLike,
        log_scales: npt.ArrayLike,
        rotations: npt.ArrayLike,
        opacity_logits: npt.ArrayLike,
        sh: npt.ArrayLike,
        notes: Sequence[str] = (),
    ) -> Map:
        """A map of copies of these arrays, in the shapes and units of the properties of the same names."""
        return cls(_core.map_from_arrays(positions, log_scales, rotations, opacity_logits, sh, list(notes)))

    def write(self, path: PathLike) -> None:
        """Writes a .ply, .splat, .spz or .glb, by the name's extension, whole or not at all; only .ply keeps all bits."""
        self._held.write(path_bytes(path))

    def __len__(self) -> int:
        return self._held.size()

    def __repr__(self) -> str:
        return f"<odosplat.Map of {len(self)} Gaussians>"

    @property
    def positions(self) -> ImageArray:
        """[N x 3], m, in the world's frame."""
        return self._held.positions()

    @property
    def log_scales(self) -> ImageArray:
        """[N x 3], natural logarithm of the standard deviations [m] along each Gaussian's own axes."""
        return self._held.log_scales()

    @property
    def rotations(self) -> ImageArray:
        """[N x 4], quaternions w x y z, world <- own axes, of any length but zero."""
        return self._held.rotations()

    @property
    def opacity_logits(self) -> ImageArray:
        """[N], opacity = 1 / (1 + exp(-logit))."""
        return self._held.opacity_logits()

    @property
    def sh(self) -> ImageArray:
        """[N x K x 3], colour = max(0, 0.5 + sum_k basis_k(direction) sh[k]); K = (degree + 1)^2, degree 0..3."""
        return self._held.sh()

    @property
    def extent(self) -> Tuple[FloatArray, FloatArray]:
        """Least and largest coordinates of the positions, [3] each, m."""
        return self.positions.min(axis=0).astype(np.float64), self.positions.max(axis=0).astype(np.float64)

    @property
    def notes(self) -> list[str]:
        """The lines of the file's header: how the map was trained, from which frames, and what is known of it."""
        return self._held.notes()

    @property
    def places(self) -> FloatArray:
        """[N x 4 x 4], T_world_camera of the training images, thinned; where the map can be looked from. May be empty."""
        return self._held.places()

    @property
    def quality(self) -> Optional[Mapping[str, Any]]:
        """What training found the map to be worth ("good", "verdict", "psnr_db", ...); None: unknown."""
        found: Optional[Mapping[str, Any]] = json.loads(self._held.quality())
        return found

    def render(
        self, camera: Camera, T_world_camera: PoseLike, *, depth: str = "surface", device: DeviceLike = None
    ) -> Rendering:
        """The map seen from a pose, by a pinhole camera: the camera's distortion is not applied.

        depth: "surface", "expected", "median" or "blended" (docs/formats.md). The first call on a device compiles its
        programs, which takes seconds once.
        """
        images = self._held.render(camera, T_world_camera, device_text(device), depth)
        return Rendering(**images)
