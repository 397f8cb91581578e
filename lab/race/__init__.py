# SPDX-License-Identifier: GPL-3.0-or-later
"""The race: programs that compute medial axes, solids whose axes are known exactly, and one judge.

    python3 -m lab.race

`solids` says what is known, `read_axis` and `betti` read and count what a program wrote, `judge` scores it;
`recipes.toml` lists the programs, `run` runs them, `compare` and `page` make docs/lab/benchmark.md. `meshes` is the
race on meshes, with the measures of `support.crisp_solids`.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

if str(ROOT / "tests") not in sys.path:  # for `support`
    sys.path.insert(0, str(ROOT / "tests"))
