# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in a Python without Blender: the command line on one mesh, and what ran it.

Arguments: the file that the answer is written to, as JSON, and the folder that the zip was unpacked into.
"""

import json
import platform
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ANSWER, FOLDER = sys.argv[1:]
sys.path[:0] = [str(HERE), FOLDER]

from egg import command_line  # noqa: E402 - it lies in this folder
from medial_axis import cli  # noqa: E402 - it lies in that one

with tempfile.TemporaryDirectory() as private:
    answer = {
        "blender": "none",
        "python": platform.python_version(),
        "numpy": np.__version__,
        "installed": "unpacked",
        "command": command_line(cli.main, Path(private)),
    }
Path(ANSWER).write_text(json.dumps(answer), encoding="utf-8")
