# SPDX-License-Identifier: GPL-3.0-or-later
"""The same axis with the same theta and rho, whatever the density of samples: a Markdown table.

    python3 lab/benchmarks/density.py [--output table.md] [--shapes box ...]

Each mesh is sampled evenly at 4,000, 16,000 and 64,000, and at 16,000 with spacings that grow by 10 along x; the
defaults of theta and rho select. Figures are the 95th percentiles of the distances of area-weighted points of one axis
to the other, both ways, in spacings of the sparser samples (at the nearest place of the surface, where they vary).
"""

import sys

import _module
import numpy as np

medial = _module.load()

from support import (  # noqa: E402
    alike,
    meshes,
    resampled,
    topology,
)
from support.shape_meshes import MESHED  # noqa: E402

SHAPES = ("ellipsoid", "slab", "shell", "torus", "capsule", "box", "cylinder", "frustum")
FILES = ("rocker-arm.off", "hand_closed.obj", "fandisk_large.off")
PAIRS = ((4_000, 16_000), (16_000, 64_000), (4_000, 64_000), ("graded", 64_000))
HEADER = ["shape", "4k: facets", "16k", "64k", "graded"]
HEADER += [f"{a} {arrow} {b}" for a, b in (("4k", "16k"), ("16k", "64k"), ("4k", "64k"),
           ("graded", "64k")) for arrow in ("to", "from")]  # fmt: skip


def mesh_of(name: str) -> meshes.Mesh:
    return MESHED[name][1] if name in MESHED else meshes.read(_module.DATA / name)


def axes(mesh: meshes.Mesh) -> tuple[dict, dict]:
    """Axis and spacing, a function of places, of every sampling."""
    found, spacing = {}, {}
    for count in (4_000, 16_000, 64_000):
        found[count] = resampled.of_surface(mesh, count).axis
        even = resampled.spacing(topology.area(*mesh), count)
        spacing[count] = lambda places, even=even: np.full(len(places), even)
    samples, found["graded"] = resampled.graded(medial, mesh, 16_000)
    spacing["graded"] = lambda places: alike.spacings(samples, medial, places)
    return found, spacing


def row(name: str) -> list[str]:
    found, spacing = axes(mesh_of(name))
    cells = [name, *(str(found[key].facets if hasattr(found[key], "facets") else
             len(found[key].generators)) for key in found)]  # fmt: skip
    for a, b in PAIRS:
        cells += [bold(x) for x in alike.mutual(found[a], found[b], spacing[a])]
    print(" | ".join(cells), file=sys.stderr, flush=True)
    return cells


def bold(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio <= 1.0 else f"**{ratio:.2f}**"


def main() -> None:
    parser = _module.parser(__doc__)
    files = [file for file in FILES if (_module.DATA / file).is_file()]
    parser.add_argument("--shapes", nargs="+", default=[*SHAPES, *files])
    options = parser.parse_args()
    rows = [row(name) for name in options.shapes]
    _module.publish(_module.markdown(HEADER, rows), options.output)


if __name__ == "__main__":
    main()
