# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import dataclasses

import numpy as np
import pytest
from conftest import one_line

import odosplat


def test_a_camera_comes_back(tmp_path):
    camera = odosplat.Camera(
        640, 480, 525.25, 524.75, 319.5, 239.5, distortion=(0.1, -0.05, 0.001, -0.002, 0.01), fps=30.0, time_offset=0.01
    )
    path = tmp_path / "camera.yaml"
    camera.write(path)
    assert odosplat.Camera.read(path) == dataclasses.replace(camera, depth_scale=1000.0)
    assert np.array_equal(camera.matrix, [[525.25, 0, 319.5], [0, 524.75, 239.5], [0, 0, 1]])


def test_a_depth_camera_comes_back(tmp_path):
    T = np.eye(4)
    T[0, 3] = 0.025
    camera = odosplat.Camera(
        640, 480, 525, 525, 320, 240, depth_scale=1000.0,
        depth_camera=odosplat.DepthCamera(320, 240, 290, 290, 160, 120, T, 0.002),
    )  # fmt: skip
    path = tmp_path / "camera.yaml"
    camera.write(path)
    read = odosplat.Camera.read(path)
    assert read == camera
    assert np.allclose(read.depth_camera.T_color_depth, T)


@pytest.mark.parametrize("line_time", [3.1e-5, -2.5e-5])
def test_a_rolling_shutter_comes_back(line_time, tmp_path):
    camera = odosplat.Camera(640, 480, 525, 525, 320, 240, depth_scale=1000.0, line_time=line_time)
    path = tmp_path / "camera.yaml"
    camera.write(path)
    assert "line_time" in path.read_text()
    read = odosplat.Camera.read(path)
    assert read.line_time == pytest.approx(line_time, rel=1e-12)
    assert dataclasses.replace(read, line_time=line_time) == camera


def test_a_sequence_has_its_rolling_shutter(demo, tmp_path):
    given = dataclasses.replace(odosplat.Camera.read(demo.sequence / "camera.yaml"), line_time=1e-4)
    given.write(tmp_path / "camera.yaml")
    sequence = odosplat.Sequence(demo.sequence, camera=tmp_path / "camera.yaml")
    assert sequence.camera.line_time == pytest.approx(1e-4)
    assert sequence.camera_file.line_time == pytest.approx(1e-4)


def test_a_vignette_is_found_beside_the_file(tmp_path):
    (tmp_path / "camera.yaml").write_text(
        "width: 4\nheight: 4\nfx: 4\nfy: 4\ncx: 1.5\ncy: 1.5\nvignette: white.png\n"
    )
    with pytest.raises(odosplat.InputError, match="white.png"):
        odosplat.Camera.read(tmp_path / "camera.yaml")
    (tmp_path / "white.png").write_bytes(b"there")
    assert odosplat.Camera.read(tmp_path / "camera.yaml").vignette == str(tmp_path / "white.png")


@pytest.mark.parametrize(
    "change, words",
    [
        ({"fx": 0.0}, "fx"),
        ({"width": -1}, "width"),
        ({"width": "wide"}, "width"),
        ({"distortion": (0.1,)}, "distortion"),
        ({"distortion": (-5.0, 0.0, 0.0, 0.0)}, "distortion"),
        ({"fy_sign": 2}, "fy_sign"),
        ({"fps": -1.0}, "fps"),
        ({"line_time": 0.1}, "line_time"),
        ({"line_time": "slow"}, "line_time"),
    ],
)
def test_implausible_cameras_are_refused(change, words):
    good = odosplat.Camera(640, 480, 525.0, 525.0, 319.5, 239.5)
    with pytest.raises(odosplat.InputError) as error:
        dataclasses.replace(good, **change)
    assert words in one_line(error)
