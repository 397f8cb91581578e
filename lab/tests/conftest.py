# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests of the laboratory: fixtures and options are those of the Python tests."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests"), str(ROOT / "tests" / "python")]

from support.package import *  # noqa: E402, F403 - fixtures and hooks
