# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of real meshes and scans, which are not in the repository; what needs them is skipped by name without."""

import os
from pathlib import Path

# Without the variable a name that no folder has, so that messages say what is missing.
DATA = Path(os.environ.get("MEDIAL_AXIS_TEST_DATA") or "MEDIAL_AXIS_TEST_DATA")
