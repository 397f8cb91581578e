# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy of every mesh of the data folder, by the add-on's own samples: a Markdown table.

    python3 tests/benchmarks/levels.py [--output table.md] [--meshes hand_closed.obj ...]

Betti numbers (components, tunnels, cavities) of the inner complex; how many of 16 levels have others, or lack faces
of their own cells, as counted by tests/support/levels.py, which knows the values alone; facets and pieces of facets of
what MEDIAL selects, of the level 0, and of sheets thicker than one and two local spacings; the wires of the level at
one spacing; tips and junctions of the curve skeleton at 0.04 of the diagonal; seconds of the hierarchy, milliseconds
of a level.
"""

import sys
import time

import _module
import numpy as np

medial = _module.load()

from support import messy, resampled  # noqa: E402
from support.levels import Levels, facet_pieces  # noqa: E402

HEADER = ["mesh", "samples", "Betti", "bubbles", "bad levels", "selected", "level 0"]
HEADER += ["1 spacing", "wires", "2 spacings", "tips/junctions", "s", "level ms"]
CHECKED = [
    *({"sheet": s, "limb": c} for s in (0.0, 0.003, 0.01, 0.03) for c in (0.0, 0.04)),
    *({"spacings": s} for s in (0.5, 1.0, 2.0)),
    *({"erosion": s} for s in (0.003, 0.02)),
    {"sheet": 0.01, "erosion": 0.01, "limb": 0.02},
    {"sheet": np.inf},
    {"sheet": np.inf, "limb": np.inf},
]


def pieces(faces) -> str:
    return f"{len(faces.generators)}/{facet_pieces(faces)}"


def ends(level) -> str:
    """Tips and junctions of a curve."""
    degree = np.bincount(level.wires.ravel(), minlength=1)
    return f"{np.sum(degree == 1)}/{np.sum(degree > 2)}"


def row(name: str) -> list[str]:
    from medial_axis.core.errors import DegenerateInputError, InvalidInputError

    mesh = messy.load(name, lambda file: _module.DATA / file)
    try:
        sampled = resampled.by_the_addon(mesh).chosen.samples
        start = time.perf_counter()
        hierarchy = sampled.analysis.hierarchy()
    except (DegenerateInputError, InvalidInputError) as refusal:
        return [name, *[""] * (len(HEADER) - 2), f"refused: {refusal}"]
    seconds = time.perf_counter() - start
    levels = Levels(hierarchy, sampled.analysis)
    alive = [levels.alive(**chosen) for chosen in CHECKED]
    bad = sum(levels.betti(a) != hierarchy.betti or not levels.is_closed(a) for a in alive)
    start = time.perf_counter()
    clean = hierarchy.extract(spacings=1.0)
    one = time.perf_counter() - start
    curve = hierarchy.extract(sheet=np.inf)
    cells = [
        name,
        str(len(sampled.analysis.samples)),
        "{},{},{}".format(*hierarchy.betti),
        str(len(hierarchy.bubbles)),
        str(bad),
        pieces(sampled.analysis.extract(side=medial.Side.INNER)),
        pieces(hierarchy.extract(limb=0.0)),
        pieces(clean),
        str(len(clean.wires)),
        pieces(hierarchy.extract(spacings=2.0)),
        ends(curve),
        f"{seconds:.2f}",
        f"{1000 * one:.0f}",
    ]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def main() -> None:
    parser = _module.parser(__doc__)
    files = [*messy.CLOSED, *messy.OPEN, *messy.CLOUDS]
    present = [file for file in files if (_module.DATA / file).is_file()]
    parser.add_argument("--meshes", nargs="+", default=present)
    options = parser.parse_args()
    _module.publish(
        _module.markdown(HEADER, [row(name) for name in options.meshes]), options.output
    )


if __name__ == "__main__":
    main()
