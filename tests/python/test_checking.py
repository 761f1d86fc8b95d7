# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import json

import pytest
from conftest import one_line

import odosplat


def test_the_check_is_the_program_s(demo, sequence, program, tmp_path):
    program.run(
        "check", demo.sequence, "--cloud", demo.cloud, "--json", tmp_path / "c.json", "--keep-going", "--log", "warning"
    )
    report = odosplat.check(sequence, demo.cloud)
    assert report == json.loads((tmp_path / "c.json").read_text())
    assert report["answer"] in ("agree", "differ", "undecided")


def test_the_calibration_is_the_program_s(demo, sequence, program, tmp_path):
    program.run("calibrate", demo.sequence, "--out", tmp_path / "theirs.yaml", "--json", tmp_path / "c.json", "--what", "focal")
    found = odosplat.calibrate(sequence, what=["focal"])
    found.camera.write(tmp_path / "ours.yaml")
    assert (tmp_path / "ours.yaml").read_text() == (tmp_path / "theirs.yaml").read_text()
    assert found.measured == json.loads((tmp_path / "c.json").read_text())["measured"]
    assert abs(found.camera.fx - 125.0) < 5.0 and found.verdict


def test_what_cannot_be_done_is_said(sequence, demo_map, demo):
    for settings, words in (
        ({"what": ["lens"]}, "what: must be some of"),
        ({"map": demo_map, "cloud": demo.cloud}, "map: and cloud cannot both be given"),
        ({"map": demo_map, "what": ["depth"]}, "what: depth is the scale of depth images"),
    ):
        with pytest.raises(odosplat.InputError) as error:
            odosplat.calibrate(sequence, **settings)
        assert words in one_line(error)
    with pytest.raises(odosplat.InputError, match="sequence: must be an odosplat.Sequence"):
        odosplat.check(str(demo.sequence))
