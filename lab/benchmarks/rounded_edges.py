# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the smooth surface is from solids whose edges are rounded by rows of faces: a Markdown table.

    python3 lab/benchmarks/rounded_edges.py [--output table.md] [--count 8000]

In percent of the radius of the edges for prisms, of half the side for boxes, and of the radius of rods, which have
64 sides. At the rounded edges facets of rods lie between true circles, so only patches can reach the surface.
"""

import _module
import numpy as np

medial = _module.load()

from support import rounded  # noqa: E402


def shapes():
    """Name, mesh, distance from the exact surface, and the length that this is measured by."""
    for name, corners in rounded.OUTLINES.items():
        mesh = rounded.rounded_prism(np.array(corners), 0.04, 5)
        yield f"prism {name}", mesh, rounded.off_rounded_prism, (corners, 0.04), 0.04
    for radius in (0.1, 0.2, 0.4, 0.6):
        for rows in (2, 3, 4, 8):
            mesh = rounded.rounded_box((1, 1, 1), radius, rows)
            yield (
                f"box {radius}, {rows} rows",
                mesh,
                rounded.off_rounded_box,
                ((1, 1, 1), radius),
                1,
            )
    for edge in (0.05, 0.1, 0.2, 0.3, 1.0):
        for rows in (2, 4, 6):
            mesh = rounded.rod(4, edge, rows, 64)
            yield f"rod {edge}, {rows} rows", mesh, rounded.off_rod, (4, edge), 1


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--count", type=int, default=8000)
    wanted = parser.parse_args()
    found = []
    for name, mesh, off, details, unit in shapes():
        points = medial.sample_surface(*mesh, count=wanted.count, smooth=True).points
        far = 100 * off(points, *details) / unit
        found.append([name, f"{far.max():.1f}", f"{np.percentile(far, 99):.2f}"])
    _module.publish(_module.markdown(["solid", "most", "99 %"], found), wanted.output)


if __name__ == "__main__":
    main()
