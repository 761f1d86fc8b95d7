# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""What the arguments may be, and the one line that refuses others. No device, no data."""

import numpy as np
import pytest
from conftest import one_line

import odosplat


def gaussians(n: int = 5, k: int = 4) -> dict:
    random = np.random.default_rng(1)
    return {
        "positions": random.normal(size=(n, 3)),
        "log_scales": np.full((n, 3), -3.0),
        "rotations": random.normal(size=(n, 4)),
        "opacity_logits": random.normal(size=n),
        "sh": random.normal(size=(n, k, 3)),
    }


def test_poses_are_rigid_motions(tmp_path):
    times = np.array([0.0, 1.0])
    good = np.stack([np.eye(4), np.eye(4)])
    path = tmp_path / "t.txt"
    odosplat.write_trajectory(path, (times, good))
    read = odosplat.read_trajectory(path)
    assert np.array_equal(read.times, times) and np.allclose(read.T_world_camera, good)
    for change, words in (
        (lambda m: m * 2.0, "last row"),
        (lambda m: np.diag([1.0, 1.0, -1.0, 1.0]), "rotation"),
        (lambda m: np.diag([2.0, 1.0, 1.0, 1.0]), "rotation"),
        (lambda m: m + np.nan, "last row"),
    ):
        bad = good.copy()
        bad[1] = change(bad[1])
        with pytest.raises(odosplat.InputError) as error:
            odosplat.write_trajectory(path, (times, bad))
        assert "poses[1]" in one_line(error) and words in one_line(error)
    for bad in (good[:, :3], good[0], np.zeros((2, 6)), "words"):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.write_trajectory(path, (times, bad))
        one_line(error)
    with pytest.raises(odosplat.InputError, match="ascending"):
        odosplat.write_trajectory(path, (times[::-1].copy(), good))
    with pytest.raises(odosplat.InputError, match="3 times and 2 poses"):
        odosplat.write_trajectory(path, (np.arange(3.0), good))


def test_seven_numbers_are_a_pose(tmp_path):
    path = tmp_path / "t.txt"
    odosplat.write_trajectory(path, ([1.5], [[1.0, 2.0, 3.0, 0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]]))
    pose = odosplat.read_trajectory(path).T_world_camera[0]
    assert np.allclose(pose, [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], atol=1e-8)
    with pytest.raises(odosplat.InputError, match="quaternion has length 3"):
        odosplat.write_trajectory(path, ([1.5], [[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0]]))


def test_input_errors_are_value_errors():
    assert issubclass(odosplat.InputError, ValueError)
    assert issubclass(odosplat.DeviceError, RuntimeError)
    assert issubclass(odosplat.NoResult, RuntimeError)


def test_a_map_needs_no_device(tmp_path):
    given = gaussians()
    made = odosplat.Map.from_arrays(**given, notes=["option a 1"])
    path = tmp_path / "map.ply"
    made.write(path)
    read = odosplat.Map.read(path)
    assert len(read) == 5 and "5 Gaussians" in repr(read)
    for name, values in given.items():
        for one in (made, read):
            array = getattr(one, name)
            assert array.dtype == np.float32 and array.shape == values.shape
            assert np.array_equal(array, values.astype(np.float32))
    assert "option a 1" in read.notes
    assert read.quality is None and read.places.shape == (0, 4, 4)
    least, most = read.extent
    assert np.array_equal(least, read.positions.min(axis=0)) and np.array_equal(most, read.positions.max(axis=0))


def test_arrays_of_a_map_are_views_that_cannot_be_written():
    made = odosplat.Map.from_arrays(**gaussians())
    positions = made.positions
    assert not positions.flags.owndata
    assert positions.__array_interface__["data"] == made.positions.__array_interface__["data"]
    with pytest.raises(ValueError):
        positions[0] = 0.0
    expected = positions.copy()
    del made
    assert np.array_equal(positions, expected)


@pytest.mark.parametrize(
    "name, value, words",
    [
        ("positions", np.zeros((4, 3)), "positions"),
        ("positions", np.zeros((5, 2)), "positions: must be [N x 3], is (5, 2)"),
        ("positions", np.zeros((5, 3, 1)), "positions: must be [N x 3], is (5, 3, 1)"),
        ("log_scales", np.zeros((5, 1, 3)), "log_scales: must be [N x 3]"),
        ("rotations", np.ones((5, 2, 2)), "rotations: must be [N x 4], is (5, 2, 2)"),
        ("opacity_logits", np.zeros((5, 1)), "opacity_logits: must be [N], is (5, 1)"),
        ("rotations", np.zeros((5, 4)), "Gaussian 0: its rotation has length 0"),
        ("log_scales", np.full((5, 3), 80.0), "Gaussian 0"),
        ("opacity_logits", np.full(5, np.nan), "not finite"),
        ("sh", np.zeros((5, 5, 3)), "sh: must be [N x K x 3] with K = 1, 4, 9 or 16"),
        ("sh", np.zeros((5, 3, 4)), "sh: must be [N x K x 3]"),
        ("sh", np.zeros((5, 4, 4)), "sh: must be [N x 4 x 3], is (5, 4, 4)"),
        ("sh", np.zeros((5, 1, 12)), "sh: must be [N x 1 x 3]"),
        ("sh", np.zeros((4, 4, 3)), "sh"),
        ("sh", np.zeros((5, 3)), "must be [N x K x 3]"),
    ],
)
def test_a_map_that_cannot_be_drawn_is_refused(name, value, words):
    given = gaussians()
    given[name] = value
    with pytest.raises(odosplat.InputError) as error:
        odosplat.Map.from_arrays(**given)
    assert words in one_line(error)


def test_files_are_named(tmp_path):
    for read in (odosplat.Map.read, odosplat.Sequence, odosplat.Camera.read, odosplat.read_cloud, odosplat.read_trajectory):
        with pytest.raises(odosplat.InputError) as error:
            read(tmp_path / "nothing")
        assert "nothing" in one_line(error)
    with pytest.raises(odosplat.InputError, match="path"):
        odosplat.Map.read(7)
    with pytest.raises(odosplat.InputError, match="nowhere"):
        odosplat.Map.from_arrays(**gaussians()).write("/proc/nowhere/map.ply")


def test_names_of_any_bytes(tmp_path):
    path = bytes(tmp_path) + b"/\xff.ply"
    odosplat.Map.from_arrays(**gaussians()).write(path)
    assert len(odosplat.Map.read(path)) == 5
    with pytest.raises(odosplat.InputError, match="\ufffe*missing|exist|such|regular") as error:
        odosplat.Map.read(bytes(tmp_path) + b"/\xfe.ply")
    one_line(error)


def test_clouds_come_back(tmp_path):
    random = np.random.default_rng(2)
    points = random.normal(size=(50, 3)).astype(np.float32)
    colors = (random.integers(0, 256, size=(50, 3)) / 255).astype(np.float32)
    path = tmp_path / "cloud.ply"
    odosplat.write_cloud(path, odosplat.Cloud(points, colors))
    read = odosplat.read_cloud(path)
    assert np.array_equal(read.points, points) and np.allclose(read.colors, colors, atol=1e-6) and read.normals is None
    odosplat.write_cloud(path, points)
    assert odosplat.read_cloud(path).colors is None
    assert len(odosplat.read_cloud(path, voxel=100.0).points) <= 8
    for bad, words in (
        (points[:, :2], "must be [N x 3]"),
        (odosplat.Cloud(points, colors[:7]), "as many as points"),
        (odosplat.Cloud(points, 255 * colors), "within 0..1"),
        (points[:0], "no point"),
        (points + np.nan, "finite"),
    ):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.write_cloud(path, bad)
        assert words in one_line(error)


def test_options_are_listed():
    listed = odosplat.options()
    assert {option.name.split(".")[0] for option in listed} == {"odometry", "relocaliser", "train"}
    for option in listed:
        assert option.least <= option.default <= option.most and option.meaning
