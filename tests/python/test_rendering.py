# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import threading

import numpy as np
import pytest
from conftest import one_line

import odosplat


def test_a_view_looks_like_the_image(demo_map, sequence):
    pose = sequence.T_world_camera(35)
    view = demo_map.render(sequence.camera, pose)
    assert view.color.shape == (120, 160, 3) and view.depth.shape == view.sigma.shape == view.alpha.shape == (120, 160)
    assert all(image.dtype == np.float32 for image in view)
    assert np.mean((view.color - sequence.color(35)) ** 2) < 0.01
    seen = view.depth > 0
    assert seen.mean() > 0.9
    assert np.median(np.abs(view.depth - sequence.depth(35))[seen]) < 0.02
    assert (view.sigma[seen] > 0).all() and view.alpha.max() <= 1.0
    again = demo_map.render(sequence.camera, pose)
    assert all(np.array_equal(a, b) for a, b in zip(view, again))


def test_pictures_are_the_program_s(demo, demo_map, sequence, program, tmp_path):
    pose = sequence.T_world_camera(35)
    expected = demo_map.render(sequence.camera, pose, depth="expected").depth
    assert not np.array_equal(expected, demo_map.render(sequence.camera, pose).depth)
    with pytest.raises(odosplat.InputError) as error:
        demo_map.render(sequence.camera, pose, depth="nearest")
    one_line(error)


def test_several_threads_render_one_map(demo_map, sequence):
    expected = [demo_map.render(sequence.camera, sequence.T_world_camera(i)).depth for i in (0, 40)]
    found: dict = {}

    def work(i: int) -> None:
        found[i] = [demo_map.render(sequence.camera, sequence.T_world_camera(i)).depth for _ in range(4)]

    threads = [threading.Thread(target=work, args=(i,)) for i in (0, 40)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for i, depth in zip((0, 40), expected):
        assert all(np.array_equal(depth, other) for other in found[i])
