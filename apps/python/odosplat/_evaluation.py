# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
from __future__ import annotations

from typing import Any, NamedTuple, Optional, Union

from . import _core
from ._sequence import Sequence
from ._trajectory import TrajectoryLike
from ._types import FloatArray, PathLike, path_bytes


class Statistics(NamedTuple):
    """Of a list of errors; None: there are none."""

    rmse: Optional[float]
    mean: Optional[float]
    median: Optional[float]
    max: Optional[float]
    p99: Optional[float]


class Evaluation(NamedTuple):
    """Errors of an estimate; the numbers of `odosplat eval --json`, and those of evo."""

    ate_m: Statistics
    """Absolute trajectory error [m]: distances of the positions."""
    rte_m: Statistics
    """Relative translation error [m] over `delta` poses."""
    rre_deg: Statistics
    """Relative rotation error [deg]."""
    pairs: int
    """Number of poses that were compared."""
    coverage: float
    coverage_estimate: float
    """Share of the estimate that was compared."""
    coverage_truth: float
    """Share of the frames that were compared."""
    alignment: str
    scale: float
    """Of the alignment; 1 unless sim3."""
    doubt: str
    """One line if less than half of the estimate was compared: do not trust the numbers then. Else ""."""
    T_truth_estimate: FloatArray
    """[4 x 4], the alignment that was applied, without its scale."""
    times: FloatArray
    """[pairs], s, of the compared poses of the estimate."""
    position_errors_m: FloatArray
    """[pairs], one for each of the times."""


def evaluate(
    estimate: Union[PathLike, TrajectoryLike],
    truth: Union[PathLike, Sequence, TrajectoryLike],
    align: str = "none",
    *,
    delta: int = 1,
    all_pairs: bool = False,
    max_time_difference: float = 0.01,
) -> Evaluation:
    """Errors of an estimated trajectory against the true one: files, (times, poses), or a Sequence with true poses.

    align: "none", "se3" or "sim3" (Umeyama). delta: poses between the two of a relative error; all_pairs: from every pose, not
    every delta-th. max_time_difference [s] between compared poses. Raises NoResult if nothing can be compared.
    """
    result = _core.evaluate(
        _argument(estimate), _argument(truth), align, delta, all_pairs, max_time_difference
    )
    for name in ("ate_m", "rte_m", "rre_deg"):
        result[name] = Statistics(**result[name])
    return Evaluation(**result)


def _argument(value: Any) -> Any:
    if isinstance(value, Sequence):
        return value._held
    if isinstance(value, (str, bytes)) or hasattr(value, "__fspath__"):
        return path_bytes(value)
    return tuple(value) if isinstance(value, list) else value
