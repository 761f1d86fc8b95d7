# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Makes the small demo that the tests use: demo_data.py PROGRAM FOLDER, in place of what the folder holds.

Exits with 77 if there is no OpenCL device to make it on.
"""

import json
import pathlib
import shutil
import subprocess
import sys


def make(program: pathlib.Path, folder: pathlib.Path) -> None:
    words = "--size 160x120 --frames 120 --iterations 150 --log warning".split()
    subprocess.run([str(program), "demo", "--out", str(folder), *words], check=True, stdout=subprocess.DEVNULL)


def has_device(program: pathlib.Path) -> bool:
    done = subprocess.run([str(program), "devices", "--json"], check=True, stdout=subprocess.PIPE)
    return bool(json.loads(done.stdout))


if __name__ == "__main__":
    if not has_device(pathlib.Path(sys.argv[1])):
        print("no OpenCL device")
        sys.exit(77)
    shutil.rmtree(sys.argv[2], ignore_errors=True)
    make(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
