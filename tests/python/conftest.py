# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Data of the tests: the demo of the program, small. Tests that need the program are skipped without it.

ODOSPLAT_PROGRAM: the program odosplat; else that of build/release. ODOSPLAT_PYTEST_DATA: a folder for the demo, which is
kept; else a temporary one.
"""

import os
import pathlib
import subprocess
from typing import NamedTuple

import demo_data
import pytest

import odosplat

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Program:
    def __init__(self, path: pathlib.Path) -> None:
        self.path = path

    def run(self, *words: object) -> str:
        done = subprocess.run(
            [str(self.path), *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout


class Demo(NamedTuple):
    """A room: its sequence with depth and true poses, its cloud, a map trained briefly, and the program's track."""

    folder: pathlib.Path
    sequence: pathlib.Path
    cloud: pathlib.Path
    map: pathlib.Path
    truth: pathlib.Path
    track: pathlib.Path


@pytest.fixture(scope="session")
def program() -> Program:
    path = pathlib.Path(os.environ.get("ODOSPLAT_PROGRAM", ROOT / "build/release/bin/odosplat"))
    if not path.is_file():
        pytest.skip(f"no program {path}")
    if not odosplat.devices():
        pytest.skip("no OpenCL device")
    return Program(path)


@pytest.fixture(scope="session")
def demo(program: Program, tmp_path_factory: pytest.TempPathFactory) -> Demo:
    given = os.environ.get("ODOSPLAT_PYTEST_DATA")
    folder = pathlib.Path(given) if given else tmp_path_factory.mktemp("demo")
    if not (folder / "table.txt").is_file():
        demo_data.make(program.path, folder)
    sequence = folder / "sequence"
    return Demo(
        folder, sequence, folder / "cloud.ply", folder / "map.ply", sequence / "groundtruth.txt", folder / "gaussian"
    )


@pytest.fixture(scope="session")
def sequence(demo: Demo) -> odosplat.Sequence:
    return odosplat.Sequence(demo.sequence)


@pytest.fixture(scope="session")
def demo_map(demo: Demo) -> odosplat.Map:
    return odosplat.Map.read(demo.map)


def first_pose(demo: Demo) -> list:
    """tx ty tz qx qy qz qw of the first image, as the file has them: what `--start truth` takes."""
    for line in demo.truth.read_text().splitlines():
        if not line.startswith("#"):
            return [float(word) for word in line.split()[1:]]
    raise AssertionError("no pose")


def one_line(error: pytest.ExceptionInfo) -> str:
    text = str(error.value)
    assert text and "\n" not in text
    return text
