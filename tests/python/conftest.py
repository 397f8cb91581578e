# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python tests: no Blender, the compiled module of the checkout."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]  # tools.packaging, tests.parts; support

from support.package import *  # noqa: E402, F403 - fixtures and hooks
from support.package import PACKAGE  # noqa: E402, F401 - for tests
