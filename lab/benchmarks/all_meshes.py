# SPDX-License-Identifier: GPL-3.0-or-later
"""The axis of every mesh of the data folder, whole and damaged, by way of the add-on: a Markdown table.

    python3 lab/benchmarks/all_meshes.py [--output table.md] [--meshes spot_low.obj ...] [--sampling NAME] [--worst]

With the add-on's defaults and the form Raw. Outside: vertices of the axis outside the mesh by crossings of a
ray, for meshes that are closed. Spike: the longest distance of a vertex whose ball the surface does not hold firmly
(both sides of the surface are seen at less than 45 degrees) from the nearest one where it does, relative to the
radius there. Seconds of processor time, both cores together. What was said: the add-on's warnings, or its refusal.
The data folder is MEDIAL_AXIS_TEST_DATA; meshes of it that are not there are left out.
"""

import sys
import time

import _module

medial = _module.load()

from support import (  # noqa: E402
    crossings,
    messy,
    resampled,
    spikes,
)
from support.levels import facet_pieces  # noqa: E402

HEADER = ["mesh", "triangles", "open edges", "sampling", "samples", "facets", "pieces", "outside"]
HEADER += ["spike", "s", "what was said"]


def row(name: str, sampling: str, worst: bool) -> list[str]:
    from medial_axis.core.errors import DegenerateInputError, InvalidInputError
    from medial_axis.core.settings import SamplingMode

    vertices, triangles = messy.load(name, lambda file: _module.DATA / file)
    gaps = medial.open_edges(vertices, triangles) if len(triangles) else 0
    start = time.process_time()
    try:
        result = resampled.by_the_addon((vertices, triangles), sampling=SamplingMode[sampling])
    except (DegenerateInputError, InvalidInputError) as refusal:
        return [name, str(len(triangles)), str(gaps), *[""] * 7, f"refused: {refusal}"]
    seconds = time.process_time() - start
    axis, samples = result.axis, result.chosen.samples
    closed = len(triangles) > 0 and gaps == 0
    outside = ~crossings.inside(axis.vertices, vertices, triangles) if closed else None
    length = spikes.lengths(axis, samples.points)
    if worst and axis.facets:
        print(spikes.worst(axis, samples.points, samples.kinds, length), file=sys.stderr)
        if outside is not None and outside.any():
            print("outside:", file=sys.stderr)
            print(spikes.worst(axis, samples.points, samples.kinds, outside * axis.radius))
    cells = [
        name,
        str(len(triangles)),
        str(gaps),
        result.chosen.sampling.value.lower(),
        str(result.points),
        str(axis.facets),
        str(facet_pieces(axis)),
        str(outside.sum()) if closed else "",
        f"{length.max():.2f}" if axis.facets else "",
        f"{seconds:.1f}",
        "; ".join(result.warnings),
    ]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def present() -> list[str]:
    files = [*messy.CLOSED, *messy.OPEN, *messy.CLOUDS]
    damaged = [name for name, (file, _) in messy.DAMAGED.items() if (_module.DATA / file).is_file()]
    return [file for file in files if (_module.DATA / file).is_file()] + damaged + [*messy.MADE]


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--meshes", nargs="+", default=present())
    parser.add_argument("--sampling", default="AUTOMATIC")
    parser.add_argument("--worst", action="store_true", help="print where the worst facets are")
    options = parser.parse_args()
    rows = [row(name, options.sampling, options.worst) for name in options.meshes]
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
