# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""What the package ships, and that its documentation is true."""

import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest
from conftest import ROOT

import odosplat


def test_types_are_shipped():
    folder = pathlib.Path(odosplat.__file__).parent
    assert (folder / "py.typed").is_file() and (folder / "_core.pyi").is_file()


def test_the_stub_names_what_the_module_has():
    from odosplat import _core

    stub = (pathlib.Path(odosplat.__file__).parent / "_core.pyi").read_text()
    declared = set(re.findall(r"^(?:def|class) (\w+)", stub, re.M)) | set(re.findall(r"^(\w+): ", stub, re.M))
    has = {name for name in dir(_core) if not name.startswith("__")}
    assert declared == has
    for held in ("HeldMap", "HeldSequence", "HeldTracker", "HeldRelocalizer"):
        methods = set(re.findall(r"^    def (\w+)", stub.split(f"class {held}:")[1].split("\nclass ")[0].split("\ndef ")[0], re.M))
        assert methods == {name for name in vars(getattr(_core, held)) if not name.startswith("_")}


def test_everything_public_is_documented():
    for name in odosplat.__all__:
        value = getattr(odosplat, name)
        if not callable(value):
            continue
        assert inspect.getdoc(value), name
        if inspect.isclass(value):
            for part, member in vars(value).items():
                if not part.startswith("_") and inspect.isfunction(member) and part not in ("fps",):
                    assert member.__doc__ or part in ("statistics", "has_depth"), f"{name}.{part}"


@pytest.mark.skipif(not os.environ.get("ODOSPLAT_MYPY"), reason="ODOSPLAT_MYPY is not set")
def test_the_stubs_pass_mypy():
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, str(ROOT / "apps/python/odosplat")],
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout


def test_the_page_s_code_runs(demo, tmp_path):
    """Every Python block of docs/python.md, in order, with its files replaced by the demo's."""
    page = (ROOT / "docs/python.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    assert len(blocks) >= 3
    code = "\n".join(blocks)
    for name, real in (
        ('"MAPPING"', demo.sequence),
        ('"LIVE"', demo.sequence),
        ('"cloud.ply"', demo.cloud),
        ('"camera.yaml"', demo.sequence / "camera.yaml"),
        ('"map.ply"', tmp_path / "map.ply"),
        ('"trajectory.txt"', tmp_path / "trajectory.txt"),
    ):
        assert name in code, name
        code = code.replace(name, repr(str(real)))
    if "import cv2" in code:
        try:
            import cv2  # noqa: F401
        except ImportError:
            code = FAKE_CV2 + code.replace("import cv2\n", "")
        code = code.replace("cv2.VideoCapture(0)", f'cv2.VideoCapture({str(demo.sequence / "rgb/%06d.png")!r})')
    code = code.replace("odosplat.train(mapping, ", "odosplat.train(mapping, iterations=100, voxel=0.08, cloud=", 1)
    path = tmp_path / "page.py"
    path.write_text(code)
    done = subprocess.run(
        [sys.executable, str(path)], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "trajectory.txt").stat().st_size > 5000


# In place of OpenCV, for the page: the images of the sequence, as cv2.VideoCapture gives those of a pattern.
FAKE_CV2 = """
import numpy as np, odosplat, os, types
class VideoCapture:
    def __init__(self, pattern):
        self.sequence = odosplat.Sequence(os.path.dirname(os.path.dirname(pattern)))
        self.next = 0
    def read(self):
        if self.next == len(self.sequence):
            return False, None
        self.next += 1
        return True, np.rint(255 * self.sequence.color(self.next - 1)[..., ::-1]).astype(np.uint8)
cv2 = types.SimpleNamespace(VideoCapture=VideoCapture)
"""
