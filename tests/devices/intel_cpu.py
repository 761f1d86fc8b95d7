#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""A second OpenCL for the tests: Intel's runtime for CPUs, from PyPI, in a virtual environment of its own.

intel_cpu.py install --venv FOLDER              makes FOLDER, or leaves it as it is if complete
intel_cpu.py run --venv FOLDER -- COMMAND...    runs COMMAND with this runtime and no other, and exits with its status

Exit 77 (skipped), with a line that says why: not x86-64, no PyPI (install); not installed (run).
"""
import argparse
import glob
import os
import platform
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
from venv_packages import python_with, SKIPPED  # noqa: E402

# The first does not declare the second as a dependency, but its compiler loads libsvml and libimf from it.
PACKAGES = ["intel-opencl-rt==2026.2.0", "intel-cmplr-lib-rt==2026.2.0"]


def vendors(venv):
    return os.path.join(venv, "vendors")


def icd(venv):
    return os.path.join(vendors(venv), "intel_cpu.icd")


def installed(venv):
    return os.path.exists(icd(venv))


def install(venv):
    if platform.machine() not in ("x86_64", "AMD64"):
        print(f"skipped: Intel's CPU runtime is for x86-64, this is {platform.machine()}")
        return SKIPPED
    if installed(venv):
        return 0
    python_with(venv, PACKAGES, seconds=600)
    # The package's OpenCL loader would be found before the system's, and it searches for vendors in another place.
    aside = os.path.join(venv, "loader")
    os.makedirs(aside, exist_ok=True)
    for loader in glob.glob(os.path.join(venv, "lib", "libOpenCL.so*")):
        shutil.move(loader, os.path.join(aside, os.path.basename(loader)))
    # The package's .icd contains a path of the machine that it was built on.
    os.makedirs(vendors(venv), exist_ok=True)
    with open(icd(venv) + ".new", "w", encoding="utf-8") as file:
        file.write(os.path.abspath(os.path.join(venv, "lib", "libintelocl.so")) + "\n")
    os.replace(icd(venv) + ".new", icd(venv))
    return 0


def environment(venv):
    paths = [os.path.abspath(os.path.join(venv, "lib"))]
    if os.environ.get("LD_LIBRARY_PATH"):
        paths.append(os.environ["LD_LIBRARY_PATH"])
    found = dict(os.environ, OCL_ICD_VENDORS=os.path.abspath(vendors(venv)), LD_LIBRARY_PATH=":".join(paths))
    found.pop("ODOSPLAT_DEVICE", None)
    return found


def missing(venv):
    """A line with the reason for skipping; None if the runtime is installed."""
    return None if installed(venv) else f"skipped: Intel's CPU runtime is not in {venv}: ./run test installs it from PyPI"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=["install", "run"])
    parser.add_argument("--venv", required=True, help="folder of the virtual environment")
    own, command = sys.argv[1:], []
    if "--" in own:
        own, command = own[:own.index("--")], own[own.index("--") + 1:]
    options = parser.parse_args(own)
    if options.action == "install":
        return install(options.venv)
    if not command:
        parser.error("run needs -- and a command")
    reason = missing(options.venv)
    if reason:
        print(reason)
        return SKIPPED
    return subprocess.run(command, env=environment(options.venv), check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
