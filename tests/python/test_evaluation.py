# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import json

import numpy as np
import pytest
from conftest import one_line

import odosplat


@pytest.mark.parametrize("align", ["none", "se3", "sim3"])
def test_numbers_are_the_program_s(demo, sequence, program, tmp_path, align):
    estimate = demo.track / "trajectory.txt"
    program.run("eval", estimate, "--truth", demo.sequence, "--align", align, "--delta", 3, "--json", tmp_path / "e.json")
    theirs = json.loads((tmp_path / "e.json").read_text())
    for truth in (sequence, demo.truth):
        result = odosplat.evaluate(estimate, truth, align, delta=3)
        for name in ("ate_m", "rte_m", "rre_deg"):
            assert getattr(result, name)._asdict() == theirs[name]
        for name in ("pairs", "coverage", "coverage_estimate", "coverage_truth", "alignment", "scale"):
            assert getattr(result, name) == theirs[name]
    # Matrices are rounded to quaternions.
    arrays = odosplat.evaluate(odosplat.read_trajectory(estimate), sequence.truth(), align, delta=3)
    assert np.isclose(arrays.ate_m.rmse, result.ate_m.rmse, rtol=1e-9, atol=0.0)
    assert result.doubt == "" and len(result.times) == len(result.position_errors_m) == result.pairs
    assert np.isclose(np.sqrt(np.mean(result.position_errors_m**2)), result.ate_m.rmse)


def trajectory(n=50, shift=0.0):
    poses = np.tile(np.eye(4), (n, 1, 1))
    poses[:, 0, 3] = np.arange(n) * 0.1 + shift
    poses[:, 1, 3] = np.sin(np.arange(n))
    return odosplat.Trajectory(np.arange(n) * 0.1, poses)


def test_arrays_are_compared():
    result = odosplat.evaluate(trajectory(shift=0.02), trajectory())
    assert np.isclose(result.ate_m.rmse, 0.02) and np.isclose(result.ate_m.max, 0.02) and result.rte_m.rmse < 1e-9
    aligned = odosplat.evaluate(trajectory(shift=0.02), trajectory(), "se3")
    assert aligned.ate_m.rmse < 1e-9 and np.isclose(aligned.T_truth_estimate[0, 3], -0.02)
    alone = odosplat.evaluate(trajectory(1), trajectory())
    assert alone.rte_m.rmse is None


def test_what_cannot_be_compared_is_said():
    late = trajectory()
    with pytest.raises(odosplat.NoResult) as error:
        odosplat.evaluate(odosplat.Trajectory(late.times + 100.0, late.T_world_camera), trajectory())
    one_line(error)
    for arguments, words in (
        ((trajectory(), trajectory(), "best"), "best"),
        ((trajectory(), 7), "truth: must be the path"),
        ((trajectory()[1], trajectory()), "estimate: must be the path"),
    ):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.evaluate(*arguments)
        assert words in one_line(error)
    with pytest.raises(odosplat.InputError, match="delta"):
        odosplat.evaluate(trajectory(), trajectory(), delta=0)
