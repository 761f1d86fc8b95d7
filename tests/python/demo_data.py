# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Makes the small demo that the tests use: demo_data.py PROGRAM FOLDER, in place of what the folder holds."""

import pathlib
import shutil
import subprocess
import sys


def make(program: pathlib.Path, folder: pathlib.Path) -> None:
    words = "--size 160x120 --frames 120 --iterations 150 --log warning".split()
    subprocess.run([str(program), "demo", "--out", str(folder), *words], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    shutil.rmtree(sys.argv[2], ignore_errors=True)
    make(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
