# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import csv
import threading

import numpy as np
import pytest
from conftest import first_pose, one_line

import odosplat


def track_all(tracker, sequence, image=None):
    image = image or sequence.gray
    return [tracker.track(image(i), sequence.time(i)) for i in range(len(sequence))]


def table(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


@pytest.fixture(scope="module")
def tracked(demo, demo_map, sequence):
    tracker = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo))
    poses = track_all(tracker, sequence)
    tracker.finish()
    return tracker, poses


def test_the_trajectory_is_the_program_s_to_the_bit(demo, tracked, tmp_path):
    tracker, poses = tracked
    tracker.write_trajectory(tmp_path / "trajectory.txt")
    assert (tmp_path / "trajectory.txt").read_bytes() == (demo.track / "trajectory.txt").read_bytes()
    final = tracker.trajectory()
    read = odosplat.read_trajectory(demo.track / "trajectory.txt")
    assert np.array_equal(final.times, read.times)
    assert np.abs(final.T_world_camera - read.T_world_camera).max() < 1e-8


def test_every_image_is_as_in_the_program_s_tables(demo, tracked):
    tracker, poses = tracked
    live = odosplat.read_trajectory(demo.track / "trajectory_live.txt")
    posed = [pose for pose in poses if pose.status != "lost"]
    assert len(posed) == len(live.times) and np.abs(np.stack([p.T_world_camera for p in posed]) - live.T_world_camera).max() < 1e-8
    rows = table(demo.track / "status.csv")
    assert len(rows) == len(poses)
    keyframes = tracker.keyframe_times()
    for row, pose in zip(rows, poses):
        assert row["status"] == pose.status and int(row["in_map"]) == pose.in_map
        assert row["inlier_share"] == f"{pose.inlier_share:.4f}" and row["map_share"] == f"{pose.map_share:.4f}"
        assert row["confirmed"] == ("" if pose.confirmed is None else f"{pose.confirmed:.4f}")
        assert int(row["keyframe"]) == (pose.time in keyframes) == pose.keyframe
    names = ["tx", "ty", "tz", "rx", "ry", "rz"]
    for row, pose in zip(table(demo.track / "covariance.csv"), posed):
        for i in range(6):
            for j in range(i, 6):
                assert row[f"{names[i]}_{names[j]}"] == f"{pose.covariance[i, j]:.6e}"


def test_poses_are_right_and_their_covariance_too(sequence, tracked):
    _, poses = tracked
    squared = []
    for i, pose in enumerate(poses):
        truth = sequence.T_world_camera(i)
        difference = truth @ np.linalg.inv(pose.T_world_camera)
        xi = np.concatenate([difference[:3, 3], rotation_vector(difference[:3, :3])])
        assert np.linalg.norm(truth[:3, 3] - pose.T_world_camera[:3, 3]) < 0.05
        assert np.allclose(pose.covariance, pose.covariance.T, rtol=1e-6, atol=1e-6 * pose.covariance.max())
        squared.append(xi @ np.linalg.solve(pose.covariance, xi))
    # 6 would be perfect. The map was trained briefly.
    assert 0.1 < np.median(squared) < 60.0
    assert sum(pose.in_map for pose in poses) > 100


def rotation_vector(R):
    """Of a small rotation."""
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2


def test_all_kinds_of_images_give_the_same_bits(demo, demo_map, sequence, tracked):
    _, poses = tracked

    def as_bytes(i):
        return np.rint(255 * sequence.color(i)).astype(np.uint8)

    for order, image in (
        ("rgb", sequence.color),
        ("rgb", as_bytes),
        ("bgr", lambda i: as_bytes(i)[..., ::-1]),
        ("bgr", lambda i: np.asfortranarray(sequence.color(i)[..., ::-1])),
    ):
        tracker = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo), color_order=order)
        for i in range(12):
            pose = tracker.track(image(i), sequence.time(i))
            assert np.array_equal(pose.T_world_camera, poses[i].T_world_camera)
            assert np.array_equal(pose.covariance, poses[i].covariance)
    wrong = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo), color_order="rgb")
    last = [wrong.track(as_bytes(i)[..., ::-1], sequence.time(i)) for i in range(12)][-1]
    assert not np.array_equal(last.T_world_camera, poses[11].T_world_camera)


def test_a_start_that_is_looked_up_is_the_program_s(demo, demo_map, sequence, program, tmp_path):
    program.run(
        "track", demo.sequence, "--map", demo.map, "--start", "auto", "--frames", ":30", "--seed", 5,
        "--set", "odometry.window.keyframes=5", "--out", tmp_path, "--log", "warning",
    )  # fmt: skip
    tracker = odosplat.Tracker(demo_map, sequence.camera, "auto", seed=5, options={"odometry.window.keyframes": 5})
    first = tracker.track(sequence.color(0), sequence.time(0))
    for i in range(1, 30):
        tracker.track(sequence.color(i), sequence.time(i))
    tracker.write_trajectory(tmp_path / "ours.txt")
    assert (tmp_path / "ours.txt").read_bytes() == (tmp_path / "trajectory.txt").read_bytes()
    assert first.status == "relocalised"
    statistics = tracker.statistics()
    assert statistics.frames == 30 and statistics.posed + statistics.lost == 30 and statistics.keyframes > 0


def test_a_matrix_starts_like_seven_numbers(demo, demo_map, sequence, tracked):
    tracker = odosplat.Tracker(demo_map, sequence.camera, sequence.T_world_camera(0))
    pose = tracker.track(sequence.gray(0), 0.0)
    assert np.allclose(pose.T_world_camera, tracked[1][0].T_world_camera, atol=1e-5)


def test_grey_bytes_are_converted_as_grey_files_are(demo, demo_map, sequence):
    """They give the same bits as three equal channels."""
    found = []
    for channels in (1, 3):
        tracker = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo))
        for i in range(3):
            image = np.rint(255 * sequence.gray(i)).astype(np.uint8)
            pose = tracker.track(image if channels == 1 else np.stack([image] * 3, axis=-1), sequence.time(i))
        found.append(pose.T_world_camera)
    assert np.array_equal(*found)


def test_an_image_of_another_place_is_lost(demo, demo_map, sequence):
    noise = np.random.default_rng(3).random((120, 160), np.float32)
    pose = odosplat.Tracker(demo_map, sequence.camera, "auto").track(noise, 0.0)
    assert pose.status == "lost" and pose.T_world_camera is None and pose.covariance is None and not pose.in_map


def test_in_the_background(demo, demo_map, sequence):
    tracker = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo), background=True)
    poses = track_all(tracker, sequence)
    tracker.finish()
    assert sum(pose.status != "lost" for pose in poses) > 110
    result = odosplat.evaluate(tracker.trajectory(), sequence)
    assert result.ate_m.rmse < 0.05
    assert len(tracker.keyframe_times()) == tracker.statistics().keyframes


def test_distortion_is_removed(demo, demo_map, sequence, tracked):
    """Images of a lens are tracked as those without it, because the tracker removes the distortion."""
    camera = odosplat.Camera(160, 120, 125.0, 125.0, 79.5, 59.5, distortion=(-0.15, 0.03, 0.0, 0.0))
    v, u = np.mgrid[0:120, 0:160].astype(np.float64)
    x, y = (u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy
    # The ray of each distorted pixel, by fixed-point iteration.
    a, b = x.copy(), y.copy()
    for _ in range(50):
        r2 = a * a + b * b
        a, b = x / (1 - 0.15 * r2 + 0.03 * r2**2), y / (1 - 0.15 * r2 + 0.03 * r2**2)
    us, vs = camera.fx * a + camera.cx, camera.fy * b + camera.cy

    def distorted(i):
        image = sequence.gray(i)
        u0, v0 = np.clip(us.astype(int), 0, 158), np.clip(vs.astype(int), 0, 118)
        du, dv = np.clip(us - u0, 0, 1), np.clip(vs - v0, 0, 1)
        top = image[v0, u0] * (1 - du) + image[v0, u0 + 1] * du
        bottom = image[v0 + 1, u0] * (1 - du) + image[v0 + 1, u0 + 1] * du
        return (top * (1 - dv) + bottom * dv).astype(np.float32)

    errors = {}
    for name, lens in (("removed", camera), ("ignored", sequence.camera)):
        tracker = odosplat.Tracker(demo_map, lens, first_pose(demo), relocalise=False)
        for i in range(40):
            tracker.track(distorted(i), sequence.time(i))
        path = tracker.trajectory()
        errors[name] = odosplat.evaluate(path, sequence).ate_m.rmse if len(path.times) > 20 else np.inf
    assert errors["removed"] < 0.03
    assert errors["removed"] < 0.5 * errors["ignored"]


GOOD = np.zeros((120, 160), np.float32)


@pytest.mark.parametrize(
    "image, words",
    [
        (GOOD.astype(np.float64), "image: must be uint8 (0..255) or float32 (0..1), is float64"),
        (GOOD.astype(np.int32), "is int32"),
        (GOOD.astype(bool), "is bool"),
        (GOOD[:-1], "image: must have the camera's shape (120, 160) or (120, 160, 3), has (119, 160)"),
        (GOOD.T, "has (160, 120)"),
        (np.zeros((120, 160, 4), np.uint8), "has (120, 160, 4)"),
        (np.zeros((120, 160, 1), np.uint8), "has (120, 160, 1)"),
        (np.full((120, 160), 255.0, np.float32), "must be within 0..1, has 255"),
        (np.full((120, 160), np.nan, np.float32), "must be within 0..1, has nan"),
        (None, "image: must be a numpy array, is NoneType"),
        (GOOD.tolist(), "image: must be a numpy array, is list"),
    ],
)
def test_wrong_images_are_refused(tracked_once, image, words):
    with pytest.raises(odosplat.InputError) as error:
        tracked_once.track(image, 1000.0)
    assert words in one_line(error)


@pytest.fixture(scope="module")
def tracked_once(demo, demo_map, sequence):
    tracker = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo))
    tracker.track(sequence.gray(0), 0.0)
    return tracker


def test_wrong_arguments_are_refused(demo, demo_map, sequence, tracked_once):
    for time, words in ((0.0, "must grow"), (-1.0, "must grow"), (np.nan, "finite"), (np.inf, "finite")):
        with pytest.raises(odosplat.InputError) as error:
            tracked_once.track(sequence.gray(1), time)
        assert words in one_line(error)
    camera = sequence.camera
    for arguments, settings, words in (
        ((demo_map, camera, "truth"), {}, 'start: must be "auto" or a pose'),
        ((demo_map, camera, np.eye(3)), {}, "start: must be [4 x 4]"),
        ((demo_map, camera), {"color_order": "brg"}, "color_order: must be rgb or bgr"),
        ((demo_map, camera), {"options": {"odometry.window.keyframes": 2.5}}, "must be a whole number"),
        ((demo_map, camera), {"options": {"train.color_rate": 0.1}}, "options: train.color_rate is no option"),
        ((demo_map, camera, np.eye(4)), {"relocalise": False, "options": {"relocaliser.score": 0.6}}, "not used"),
        ((demo_map, "camera.yaml"), {}, "camera: must be an odosplat.Camera"),
        ((str(demo.map), camera), {}, "map: must be an odosplat.Map"),
        ((demo_map, odosplat.Camera(4, 4, 4.0, 4.0, 1.5, 1.5)), {}, ""),
    ):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.Tracker(*arguments, **settings)
        assert words in one_line(error)


def test_two_trackers_in_two_threads(demo, demo_map, sequence, tracked):
    found: dict = {}

    def work(name: int) -> None:
        tracker = odosplat.Tracker(demo_map, sequence.camera, first_pose(demo))
        found[name] = [tracker.track(sequence.gray(i), sequence.time(i)).T_world_camera for i in range(20)]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for poses in found.values():
        assert all(np.array_equal(T, pose.T_world_camera) for T, pose in zip(poses, tracked[1]))
    assert len(found) == 2
