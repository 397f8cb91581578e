# SPDX-License-Identifier: GPL-3.0-or-later
"""Real closed solids as middle surfaces at the defaults, or why not, and what it costs; a Markdown table.

    python3 lab/benchmarks/middles_of_solids.py FOLDER [--only WORD ...]

Files that are no single closed body are passed over. Pieces are those of the sheets, by their edges. The share is the
volume of the sheets, area times thickness, in percent of that of the solid; where walls meet, both count.
"""

import argparse
import time
from pathlib import Path

import _module

_module.load()

from closed_solids import closed_bodies  # noqa: E402
from medial_axis.core.errors import InvalidInputError  # noqa: E402
from medial_axis.core.machine.cache import CACHE  # noqa: E402
from medial_axis.core.mid_surface.mid_surface import mid_surface  # noqa: E402
from medial_axis.core.settings import MidSurfaceSettings, Settings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from support.topology import components  # noqa: E402


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", nargs="+", default=[""])
    wanted = parser.parse_args()
    print("| solid | sheets | pieces | faces | thickness | share, % | s | warnings |")
    print("| --- | --: | --: | --: | --- | --: | --: | --- |")
    for name, points, triangles, _ in closed_bodies(wanted.folder, wanted.only):
        print(row(name, Shape(points, triangles)), flush=True)


def row(name: str, shape: Shape) -> str:
    CACHE.clear()
    start = time.process_time()
    try:
        found = mid_surface(shape, Settings(), MidSurfaceSettings())
    except InvalidInputError as error:
        return f"| {name} | | | | | | {time.process_time() - start:.1f} | {error} |"
    low, high = found.thickness.min(), found.thickness.max()
    cells = [
        name,
        f"{found.sheets:,}",
        f"{components(found.triangles):,}",
        f"{len(found.part):,}",
        f"{low:.3g} to {high:.3g}",
        f"{100 * found.share:.1f}",
        f"{time.process_time() - start:.1f}",
        "; ".join(found.warnings),
    ]
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    main()
