# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
import os
import subprocess
import sys

import odosplat

WITHOUT_DEVICE = """
import numpy as np, odosplat
n = 3
made = odosplat.Map.from_arrays(np.zeros((n, 3)), np.zeros((n, 3)), np.ones((n, 4)), np.zeros(n), np.zeros((n, 1, 3)))
assert len(made) == n and odosplat.devices() == []
camera = odosplat.Camera(64, 48, 60.0, 60.0, 31.5, 23.5)
try:
    made.render(camera, np.eye(4))
except odosplat.DeviceError as e:
    print(e)
"""


def run(code: str, **variables: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code], env={**os.environ, **variables}, stdout=subprocess.PIPE, text=True, check=True
    )
    return done.stdout


def test_without_a_device_one_line_says_what_to_install(tmp_path):
    said = run(WITHOUT_DEVICE, OCL_ICD_VENDORS=str(tmp_path) + "/", POCL_CACHE_DIR=str(tmp_path))
    assert said.count("\n") == 1 and "no OpenCL device was found" in said and "pocl-opencl-icd" in said


def test_devices_are_listed_as_by_the_program(program):
    import json

    listed = json.loads(program.run("devices", "--json"))
    assert [d.name for d in odosplat.devices()] == [row["name"] for row in listed]
    assert [d.index for d in odosplat.devices()] == [row["index"] for row in listed]


def test_an_unknown_device_is_refused(demo_map, sequence):
    for device in ("no such device", 99):
        try:
            demo_map.render(sequence.camera, sequence.T_world_camera(0), device=device)
        except odosplat.DeviceError as error:
            assert "no such OpenCL device" in str(error) and "\n" not in str(error)
        else:
            raise AssertionError("rendered")


def test_threads():
    before = odosplat.threads()
    odosplat.set_threads(1)
    assert odosplat.threads() == 1
    odosplat.set_threads(before)
    try:
        odosplat.set_threads(0)
    except odosplat.InputError as error:
        assert "at least 1" in str(error)
    else:
        raise AssertionError("accepted")


def test_the_version_is_the_program_s(program):
    assert odosplat.__version__ in program.run("--version")
