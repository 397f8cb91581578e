# SPDX-License-Identifier: GPL-3.0-or-later
"""How many parts, curves and nodes the axes of solids have at some numbers of samples: a Markdown table.

    python3 lab/benchmarks/parts_graph.py [--output table.md] [--solids box wedge] [--samples 8000 32000 128000]
        [--meshes fandisk_large.off]

Solids are sampled as Sampling Surface does, with seed 0 and the default settings. Meshes are files of the data
folder, instead of solids.
"""

import sys

import _module

_module.load()

from medial_axis.core.axis.compute import compute  # noqa: E402  (found through _module)
from medial_axis.core.axis.structure_table import counts_of  # noqa: E402
from medial_axis.core.settings import SamplingMode, Settings  # noqa: E402
from support import meshes, plates  # noqa: E402


def ellipsoid():
    points, triangles = meshes.icosphere(4)
    return points * (3.0, 2.0, 1.0), triangles


SOLIDS = {
    "box": plates.box,
    "wedge": plates.wedge,
    "bracket": plates.bracket,
    "plate": plates.holed_plate,
    "ellipsoid": ellipsoid,
}
HEADER = ["solid", "samples", "sheets", "seams", "rims", "creases", "junctions", "corners"]


def row(name: str, mesh, count: int) -> list[str]:
    settings = Settings(sampling=SamplingMode.SURFACE, samples=count, seed=0)
    counts = counts_of(compute(*mesh, settings).axis.structure)
    found = [name, f"{count:,}", *map(str, counts.values())]
    print(" | ".join(found), file=sys.stderr, flush=True)
    return found


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--solids", nargs="+", default=list(SOLIDS), choices=SOLIDS)
    parser.add_argument("--meshes", nargs="+", help="files of the data folder, instead of solids")
    parser.add_argument("--samples", nargs="+", type=int, default=[8_000, 32_000, 128_000])
    options = parser.parse_args()
    if options.meshes:
        shapes = {name: meshes.read(_module.DATA / name) for name in options.meshes}
    else:
        shapes = {name: SOLIDS[name]() for name in options.solids}
    table = [row(name, mesh, count) for name, mesh in shapes.items() for count in options.samples]
    _module.publish(_module.markdown(HEADER, table), options.output)


if __name__ == "__main__":
    main()
