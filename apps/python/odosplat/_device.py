# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from dataclasses import dataclass

from . import _core


@dataclass(frozen=True)
class Device:
    """An OpenCL device. Its index, or a part of its name or platform, selects it (``device=``)."""

    index: int
    name: str
    vendor: str
    platform: str
    driver_version: str
    opencl_version: str
    type: str
    """"cpu", "gpu" or "other"."""
    compute_units: int
    memory_gib: float
    refusal: str
    """Why it is not used; "": it can be."""


def devices() -> list[Device]:
    """All OpenCL devices; empty if no OpenCL is installed.

    By default (``device=None``) the environment variable ODOSPLAT_DEVICE selects one, else the first GPU, else the first CPU.
    """
    return [Device(**row) for row in _core.devices()]


def set_threads(n: int) -> None:
    """Number of threads of the library and, before the first device is listed or used, of PoCL's CPU device.

    Results are the same bits for any number.
    """
    _core.set_threads(n)


def threads() -> int:
    """Number of threads of the library."""
    return _core.threads()


def set_log_level(level: str) -> None:
    """What goes to standard error: "debug", "info" (with progress bars), "warning" (the default) or "off"."""
    _core.set_log_level(level)


_core.set_log_level("warning")
