# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy of every mesh of the data folder, by the add-on's own samples or by so many: a Markdown table.

    python3 lab/benchmarks/levels.py [--output table.md] [--meshes hand_closed.obj ...] [--samples 20000]

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


def pieces(faces) -> str:
    return f"{len(faces.generators)}/{facet_pieces(faces)}"


def ends(level) -> str:
    """Tips and junctions of a curve."""
    degree = np.bincount(level.wires.ravel(), minlength=1)
    return f"{np.sum(degree == 1)}/{np.sum(degree > 2)}"


def row(name: str, count: int | None) -> list[str]:
    from medial_axis.core.errors import DegenerateInputError, InvalidInputError

    mesh = messy.load(name, lambda file: _module.DATA / file)
    try:
        made = resampled.of_surface(mesh, count) if count else resampled.by_the_addon(mesh)
        sampled = made.chosen.samples
        start = time.perf_counter()
        hierarchy = sampled.analysis.hierarchy()
    except (DegenerateInputError, InvalidInputError) as refusal:
        return [name, *[""] * (len(HEADER) - 2), f"refused: {refusal}"]
    seconds = time.perf_counter() - start
    bad = len(Levels(hierarchy, sampled.analysis).wrong())
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
    parser.add_argument("--samples", type=int, help="so many of each surface; clouds are left out")
    options = parser.parse_args()
    names = [n for n in options.meshes if not (options.samples and n in messy.CLOUDS)]
    _module.publish(
        _module.markdown(HEADER, [row(name, options.samples) for name in names]), options.output
    )


if __name__ == "__main__":
    main()
