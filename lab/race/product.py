# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the add-on of this checkout importable as `medial_axis`, and its compiled module as `load()`.

`study()` is the module that is not shipped, `markdown()` makes the tables of the benchmarks.
"""

import sys

from . import ROOT

sys.path.insert(0, str(ROOT / "lab" / "benchmarks"))

import _module

load, study, markdown = _module.load, _module.study, _module.markdown
load()
