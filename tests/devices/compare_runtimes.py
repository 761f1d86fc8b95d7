#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Do two OpenCL runtimes give the same images and gradients?

compare_runtimes.py --exercise BINARY --venv FOLDER --work FOLDER     the default device against Intel's CPU runtime
compare_runtimes.py FILE FILE                                         two results of `exercise_kernels OUT large`

Differences are relative to the largest value of each array. Runtimes round differently (fused or not, order of a vector's
sum), so values differ by about 1e-6; and a pixel whose alpha is within that of 1/255 has a Gaussian more or less, which
moves it by up to 1/255 of a colour, and its depth by as much as the Gaussian is away. Hence: sorted indices are equal;
of each image at most 2 values in 1000 differ by more than 1e-5; of each array of gradients, where a pixel is a small
part of a sum and needles have slopes that magnify rounding, at most 1 in 100 by more than 1e-5 and none by more than
1e-3; half of all values by less than 1e-6. Exit 1 where that does not hold, 77 (skipped) without the second runtime.
"""
import argparse
import math
import os
import subprocess
import sys

import intel_cpu

SMALL = 1e-5
TYPICAL = 1e-6
LARGEST_OF_GRADIENTS = 1e-3


def read(path):
    arrays = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            word, name, *values = line.split()
            if word == "array":
                if name in arrays:
                    raise SystemExit(f"{path}: {name} is listed twice")
                arrays[name] = [float(v) for v in values]
    return arrays


def differences(a, b):
    size = max(abs(v) for v in a) or 1.0
    found = [abs(x - y) / size for x, y in zip(a, b)]
    return sorted(d if math.isfinite(d) else math.inf for d in found)


def faults_of(name, d):
    beyond = sum(v > SMALL for v in d)
    if name == "pairs":
        return ["sorted indices differ"] if d[-1] > 0.0 else []
    faults = []
    gradients = ".d_" in name
    allowed = len(d) // 100 if gradients else len(d) // 500
    if beyond > allowed:
        faults.append(f"{beyond} of {len(d)} values differ by more than {SMALL:g}, {allowed} may")
    if gradients and d[-1] > LARGEST_OF_GRADIENTS:
        faults.append(f"largest difference {d[-1]:.1e} is beyond {LARGEST_OF_GRADIENTS:g}")
    if d[len(d) // 2] > TYPICAL and len(d) > 10:
        faults.append(f"median difference {d[len(d) // 2]:.1e} is beyond {TYPICAL:g}")
    return faults


def compare(first, second):
    a, b = read(first), read(second)
    if set(a) != set(b) or not a:
        print(f"FAILED: {first} and {second} hold different arrays")
        return 1
    failures = compared = beyond = 0
    worst = {"images": 0.0, "gradients": 0.0}
    for name, values in a.items():
        if len(values) != len(b[name]):
            failures += 1
            print(f"FAILED: {name}: {len(values)} values and {len(b[name])}")
            continue
        if not values:
            continue
        d = differences(values, b[name])
        compared += len(d)
        beyond += sum(v > SMALL for v in d)
        kind = "gradients" if ".d_" in name else "images"
        worst[kind] = max(worst[kind], d[-1])
        for fault in faults_of(name, d):
            failures += 1
            print(f"FAILED: {name}: {fault}")
    print(f"{compared} values in {len(a)} arrays: {beyond} differ by more than {SMALL:g}; largest difference "
          f"{worst['images']:.1e} of images, {worst['gradients']:.1e} of gradients; {failures} faults")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", help="two files to compare")
    parser.add_argument("--exercise", help="exercise_kernels")
    parser.add_argument("--venv", help="virtual environment of intel_cpu.py")
    parser.add_argument("--work", help="folder for results")
    options = parser.parse_args()
    if len(options.files) == 2:
        return compare(*options.files)
    if options.files or not (options.exercise and options.venv and options.work):
        parser.error("either two files, or --exercise, --venv and --work")
    reason = intel_cpu.missing(options.venv)
    if reason:
        print(reason)
        return intel_cpu.SKIPPED
    os.makedirs(options.work, exist_ok=True)
    files = [os.path.join(options.work, name) for name in ("default.txt", "intel.txt")]
    for file, environment in zip(files, (None, intel_cpu.environment(options.venv))):
        subprocess.run([options.exercise, file, "large"], check=True, env=environment)
    return compare(*files)


if __name__ == "__main__":
    sys.exit(main())
