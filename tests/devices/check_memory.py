#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Runs every kernel under oclgrind, which interprets it and watches its memory.

check_memory.py --exercise BINARY --kernels FOLDER --work FOLDER

Exit 1 if oclgrind reports anything (reads and writes out of bounds, also of private and local arrays; races between
items; misuse of the API), or if a kernel of FOLDER was not launched: then tests/devices/exercise_kernels.cpp lacks it.
Exit 77 (skipped) where oclgrind is missing.

Of a pointer that is `restrict` in an inline function, oclgrind 21.10 knows no meaning and refuses the kernel: the word is
taken out, which changes no access. --uninitialized is not asked for: it calls sums uninitialised that are not.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys

SKIPPED = 77
KERNEL = re.compile(r"\b(?:__)?kernel\s+(?:__attribute__\s*\(\(.*?\)\)\)?\s*)?void\s+(\w+)\s*\(", re.S)


def kernel_names(folder):
    names = {}
    for file in sorted(os.listdir(folder)):
        if file.endswith(".cl"):
            with open(os.path.join(folder, file), encoding="utf-8") as text:
                code = re.sub(r"/\*.*?\*/|//[^\n]*", "", text.read(), flags=re.S)
            words = len(re.findall(r"\b(?:__)?kernel\b", code))
            found = KERNEL.findall(code)
            if words != len(found):
                raise SystemExit(f"{file}: {words} kernels, but the names of {len(found)} were understood")
            names.update((name, file) for name in found)
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--exercise", required=True, help="exercise_kernels")
    parser.add_argument("--kernels", required=True, help="folder of the .cl files")
    parser.add_argument("--work", required=True, help="folder for results")
    options = parser.parse_args()
    if not shutil.which("oclgrind"):
        print("skipped: no oclgrind (package oclgrind)")
        return SKIPPED
    os.makedirs(options.work, exist_ok=True)
    empty = os.path.join(options.work, "no_vendors")
    os.makedirs(empty, exist_ok=True)
    log = os.path.join(options.work, "oclgrind.log")
    out = os.path.join(options.work, "oclgrind.txt")
    for file in (log, out):
        if os.path.exists(file):
            os.remove(file)
    environment = dict(os.environ, OCL_ICD_VENDORS=empty, ODOSPLAT_CACHE_DIR="off")
    environment.pop("ODOSPLAT_DEVICE", None)
    environment.pop("ODOSPLAT_SHELL", None)
    done = subprocess.run(["oclgrind", "--data-races", "--check-api", "--max-errors", "20", "--log", log,
                           "--build-options", "-D restrict=", options.exercise, out], env=environment, check=False)
    report = ""
    if os.path.exists(log):
        with open(log, encoding="utf-8", errors="replace") as file:
            report = file.read().strip()
    if report:
        print(report)
    if done.returncode != 0 or report:
        print(f"FAILED: oclgrind has reported faults (exit status {done.returncode})")
        return 1
    with open(out, encoding="utf-8") as file:
        launched = {line.split()[1] for line in file if line.startswith("launched ")}
    names = kernel_names(options.kernels)
    missing = sorted(set(names) - launched)
    for name in missing:
        print(f"FAILED: kernel {name} of {names[name]} is not launched by exercise_kernels")
    print(f"{len(names)} kernels, {len(missing)} not launched, no fault reported")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
