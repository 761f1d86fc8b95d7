# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Virtual environments with packages of PyPI, for the scripts that compare odosplat with other programs."""
import os
import subprocess
import sys

SKIPPED = 77  # exit status if the other program cannot be installed


def python_with(folder, packages, seconds=300):
    """Returns the interpreter of the virtual environment `folder`, in which the packages ("evo==1.31.1") are installed.

    The environment is created if missing. If the packages cannot be installed, the script prints this and exits with
    SKIPPED.
    """
    python = os.path.join(folder, "bin", "python")
    try:
        if not os.path.exists(python):
            subprocess.run([sys.executable, "-m", "venv", folder], check=True, capture_output=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *packages],
                       check=True, capture_output=True, timeout=seconds)
    except (subprocess.SubprocessError, OSError) as error:
        print(f"skipped: {', '.join(packages)} cannot be installed: {error}")
        sys.exit(SKIPPED)
    return python
