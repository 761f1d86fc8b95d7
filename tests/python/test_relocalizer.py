# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import json

import numpy as np
import pytest
from conftest import one_line

import odosplat


@pytest.fixture(scope="module")
def relocalizer(demo_map, sequence):
    return odosplat.Relocalizer(demo_map, sequence.camera)


def test_images_are_found_with_covariance(relocalizer, sequence):
    assert relocalizer.prepare() > 0
    found = 0
    for i in range(5, 120, 12):
        answer = relocalizer.locate(sequence.color(i))
        if not answer.found:
            assert answer.reason and answer.T_world_camera is None and answer.covariance is None
            continue
        found += 1
        assert answer.reason == "" and answer.probability > 0.9 and 0.5 < answer.score <= 1.0
        offset = np.linalg.norm(answer.T_world_camera[:3, 3] - sequence.T_world_camera(i)[:3, 3])
        assert offset < 0.1
        assert (np.linalg.eigvalsh(answer.covariance) > 0).all()
    assert found >= 5
    assert relocalizer.likely_cause == ""


def test_answers_are_the_program_s(demo, demo_map, sequence, program, tmp_path):
    program.run(
        "relocalise", demo.sequence, "--map", demo.map, "--views", 6, "--skip-every", "none", "--json", tmp_path / "r.json",
        "--log", "warning",
    )  # fmt: skip
    relocalizer = odosplat.Relocalizer(demo_map, sequence.camera)
    for row in json.loads((tmp_path / "r.json").read_text())["rows"]:
        answer = relocalizer.locate(sequence.gray(row["frame"]))
        assert answer.score == row["score"] and answer.inlier_share == row["inlier_share"]
        assert answer.found == row["found"] and answer.reason == row["reason"]
        if answer.found:
            assert np.array_equal(answer.T_world_camera[:3, 3], row["T_world_camera"][:3])


def test_other_images_are_not_found(relocalizer, sequence):
    answer = relocalizer.locate(np.zeros((120, 160), np.uint8))
    assert not answer.found and answer.reason == "the image has almost no contrast" and answer.probability == 0.0
    answer = relocalizer.locate(np.random.default_rng(1).random((120, 160), np.float32))
    assert not answer.found and answer.reason
    with pytest.raises(odosplat.InputError) as error:
        relocalizer.locate(np.zeros((10, 10), np.uint8))
    assert "image: must have the camera's shape" in one_line(error)


def test_a_map_that_does_not_say_where_it_was_seen_from(demo_map, sequence):
    bare = odosplat.Map.from_arrays(
        demo_map.positions, demo_map.log_scales, demo_map.rotations, demo_map.opacity_logits, demo_map.sh
    )
    assert len(bare.places) == 0
    given = odosplat.Relocalizer(bare, sequence.camera, places=demo_map.places)
    assert given.prepare() == odosplat.Relocalizer(demo_map, sequence.camera).prepare()
    assert odosplat.Relocalizer(bare, sequence.camera).prepare() > 0
