# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import one_line

import odosplat

ITERATIONS = 40


def test_the_map_is_the_program_s_to_the_bit(demo, sequence, program, tmp_path):
    program.run(
        "train", demo.sequence, "--cloud", demo.cloud, "--voxel", 0.1, "--every", 15, "--frames", "10:100", "--iterations",
        ITERATIONS, "--seed", 7, "--set", "train.color_rate=0.02", "--out", tmp_path / "theirs.ply", "--log", "warning",
    )  # fmt: skip
    steps = []
    made = odosplat.train(
        sequence, demo.cloud, voxel=0.1, every=15, frames=(10, 100), iterations=ITERATIONS, seed=7,
        options={"train.color_rate": 0.02}, progress=lambda *values: steps.append(values),
    )  # fmt: skip
    made.write(tmp_path / "ours.ply")
    assert (tmp_path / "ours.ply").read_bytes() == (tmp_path / "theirs.ply").read_bytes()
    assert [step[0] for step in steps] == list(range(1, ITERATIONS + 1))
    assert steps[-1][1] == ITERATIONS and steps[-1][3] == len(made)
    assert made.quality is not None and made.quality["images"] == 6
    assert len(made.places) > 0


def test_images_in_memory_make_the_same_map(demo, sequence):
    frames = range(0, 120, 20)
    cloud = odosplat.read_cloud(demo.cloud, voxel=0.1)
    settings = {"iterations": ITERATIONS, "seed": 3}
    expected = odosplat.train(sequence, cloud, every=20, **settings)
    bytes_bgr = [np.rint(255 * sequence.color(i)[..., ::-1]).astype(np.uint8) for i in frames]
    poses = np.stack([sequence.T_world_camera(i) for i in frames])
    made = odosplat.train_on_images(
        bytes_bgr, poses, sequence.camera, cloud, color_order="bgr", depths=[sequence.depth(i) for i in frames], **settings
    )
    assert len(made) == len(expected)
    # Poses come as matrices instead of quaternions: the last bits differ.
    assert np.quantile(np.abs(made.positions - expected.positions), 0.99) < 1e-3
    assert np.median(np.abs(made.sh - expected.sh)) < 1e-4


def test_bad_settings_are_named(demo, sequence):
    for settings, words in (
        ({"preset": "best"}, "best"),
        ({"every": 0}, "every"),
        ({"iterations": -1}, "iterations"),
        ({"densify": "more"}, "more"),
        ({"sh_degree": 9}, "degree"),
        ({"options": {"train.colour_rate": 0.1}}, "did you mean train.color_rate"),
        ({"options": {"train.color_rate": 7.0}}, "options: train.color_rate: must be in"),
        ({"options": {"odometry.prefetch": 1.0}}, "no option of this"),
        ({"options": {"train.color_rate": "fast"}}, "must be a number"),
        ({"seed": -1}, "seed"),
        ({"budget": -5}, "budget"),
        ({"exposure": "on"}, "exposure: must be True, False or None"),
        ({"exposure": 1}, "exposure: must be True, False or None"),
    ):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.train(sequence, demo.cloud, **settings)
        assert words in one_line(error), settings
    with pytest.raises(odosplat.InputError, match="no image sees any of its points"):
        odosplat.train(sequence, np.array([[0.0, 0.0, 1000.0]]))
    with pytest.raises(odosplat.InputError, match="sequences: must be odosplat.Sequence"):
        odosplat.train([str(demo.sequence)], demo.cloud)
    image = np.zeros((120, 160, 3), np.uint8)
    for images, poses, words in (
        ([image], np.stack([np.eye(4)] * 2), "as many as images: 1, are 2"),
        ([image[..., 0]], np.eye(4)[None], "images[0]: must have colours"),
        ([image.astype(float)], np.eye(4)[None], "images[0]: must be uint8 (0..255) or float32 (0..1), is float64"),
        ([], np.zeros((0, 4, 4)), "images: there are none"),
    ):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.train_on_images(images, poses, sequence.camera, demo.cloud)
        assert words in one_line(error)


def test_what_progress_raises_ends_training(demo, sequence):
    def stop(step: int, *_: object) -> None:
        if step == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        odosplat.train(sequence, demo.cloud, voxel=0.1, every=30, iterations=100000, progress=stop)


def test_other_threads_run_meanwhile(demo, sequence):
    counted = [0]
    done = threading.Event()

    def count() -> None:
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.002)

    thread = threading.Thread(target=count)
    thread.start()
    start = time.monotonic()
    odosplat.train(sequence, demo.cloud, voxel=0.1, every=30, iterations=20)
    seconds = time.monotonic() - start
    done.set()
    thread.join()
    assert counted[0] > 20 * seconds


INTERRUPTED = """
import signal, sys, odosplat
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    odosplat.train(odosplat.Sequence(sys.argv[1]), sys.argv[2], voxel=0.1, every=30, iterations=1000000,
                   progress=lambda step, *_: step == 2 and print("running", flush=True))
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_ends_training(demo):
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, str(demo.sequence), str(demo.cloud)], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout.readline() == "running\n"
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
        assert time.monotonic() - sent < 60.0
        assert process.wait(30) == 0
    finally:
        process.kill()
