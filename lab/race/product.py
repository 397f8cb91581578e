# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the add-on of this checkout importable as `medial_axis`, and its compiled module as `load()`."""

import sys

from . import ROOT

sys.path.insert(0, str(ROOT / "lab" / "benchmarks"))

import _module

load = _module.load
load()
