# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import numpy as np
import pytest
from conftest import one_line

import odosplat


def test_images_depth_times_and_poses(demo, sequence):
    assert len(sequence) == 120 and sequence.name == "sequence" and sequence.layout == "tum"
    assert sequence.camera == odosplat.Camera(160, 120, 125.0, 125.0, 79.5, 59.5, fps=30.0)
    assert sequence.camera_file.depth_scale == 5000.0
    color, gray, depth = sequence.color(7), sequence.gray(7), sequence.depth(7)
    assert color.shape == (120, 160, 3) and gray.shape == depth.shape == (120, 160)
    assert color.dtype == gray.dtype == depth.dtype == np.float32
    assert np.allclose(gray, color @ np.array([0.299, 0.587, 0.114], np.float32), atol=1e-5)
    assert 0.3 < np.median(depth) < 10.0
    rows = np.loadtxt(demo.truth)
    truth = sequence.truth()
    assert np.array_equal(truth.times, rows[:, 0])
    assert np.allclose(truth.T_world_camera[:, :3, 3], rows[:, 1:4])
    assert np.allclose(sequence.T_world_camera(7), truth.T_world_camera[7])
    assert sequence.time(-1) == sequence.times[119] == rows[-1, 0]


def test_the_depth_reprojects(sequence):
    """Poses, depth and camera in one frame: a pixel of image 0 has the depth that image 8 shows in its place."""
    camera = sequence.camera
    v, u = np.mgrid[10:110:5, 10:150:5]
    z = sequence.depth(0)[v, u]
    p = np.stack([(u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z, np.ones_like(z)], axis=-1)
    q = p @ (np.linalg.inv(sequence.T_world_camera(8)) @ sequence.T_world_camera(0)).T
    u8 = np.rint(camera.fx * q[..., 0] / q[..., 2] + camera.cx).astype(int)
    v8 = np.rint(camera.fy * q[..., 1] / q[..., 2] + camera.cy).astype(int)
    inside = (u8 >= 0) & (u8 < 160) & (v8 >= 0) & (v8 < 120)
    assert inside.mean() > 0.5
    error = np.abs(sequence.depth(8)[v8[inside], u8[inside]] - q[..., 2][inside])
    assert np.median(error) < 0.01


def test_what_is_not_there(demo, sequence):
    with pytest.raises(IndexError, match="no image 120"):
        sequence.color(120)
    with pytest.raises(odosplat.InputError) as error:
        odosplat.Sequence(demo.sequence, layout="none")
    assert one_line(error).startswith("layout: ")


def test_the_cloud_is_the_program_s(demo, sequence, program, tmp_path):
    program.run("cloud", demo.sequence, "--every", 20, "--voxel", 0.05, "--noise", 0.01, "--out", tmp_path / "theirs.ply")
    odosplat.write_cloud(tmp_path / "ours.ply", odosplat.build_cloud(sequence, every=20, voxel=0.05, noise=0.01))
    assert (tmp_path / "ours.ply").read_bytes() == (tmp_path / "theirs.ply").read_bytes()
    with pytest.raises(odosplat.InputError, match="every"):
        odosplat.build_cloud(sequence, every=0)
    with pytest.raises(odosplat.InputError, match="frames"):
        odosplat.build_cloud(sequence, frames=(5, 5))
