# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin walls with and without pairs of samples: Betti numbers and area of the axis, a Markdown table.

    python3 lab/benchmarks/thin_walls.py [--samples 4000] [--solids plate:0.001 ...] [--plain] [--automatic]

Each solid is turned at random and rounded to float32. The levels are those of the form Clean with crisp places. The
area is a share of the true one, with the sheets into the edges of flat walls; `middle` is the true share of the sheets
in the middle of the walls alone, which is all that samples far sparser than the wall find. `--plain` adds the same
samplings without pairs, `--automatic` the sampling of the product at its defaults.
"""

import argparse
import time
from collections.abc import Callable

import _module
import numpy as np

medial = _module.load()

from medial_axis import library  # noqa: E402
from support import thin_solids  # noqa: E402

SOLIDS = (
    *(f"plate:{t}" for t in ("0.1", "0.01", "0.001", "0.0001", "0.00001")),
    *(f"{name}:0.002" for name in ("profile_t", "cross", "profile_i", "profile_l", "stairs")),
    *(f"{name}:0.002" for name in ("fin", "cup", "tube")),
    *(f"shell:{t}" for t in ("0.01", "0.001")),
    "wedge:2",
)
ROUND = ("cup", "tube", "shell")  # these are sampled on the smooth surface


def solid_of(words: str) -> thin_solids.ThinSolid:
    name, size = words.split(":")
    return getattr(thin_solids, name)(float(size))


def level_of(mesh: thin_solids.Mesh, count: int, pairs: bool, smooth: bool) -> tuple[int, object]:
    """The number of samples, and the level, of one sampling."""
    points, triangles = mesh
    samples = medial.sample_surface(points, triangles, count=count, smooth=smooth, pairs=pairs)
    analysis = medial.MedialAnalysis(samples.points, triangles, vertices=points)
    faces = medial.Faces(points, triangles, samples.triangle, smooth=smooth)
    hierarchy = analysis.hierarchy(
        bodies=1, faces=faces, partners=samples.partner if pairs else None
    )
    level = hierarchy.extract(crisp=True, spacings=1.0, limb=0.04, relaxed=True, round_limbs=True)
    return len(samples.points), level


def automatic(mesh: thin_solids.Mesh) -> tuple[int, object, tuple[int, int, int]]:
    found = library.compute(*mesh, side="inner")
    return len(found.chosen.samples.points), found.axis, tuple(found.axis.level.betti)


def area_of(axis: object) -> float:
    places, offsets, corners = axis.vertices, axis.face_offsets, axis.face_vertices
    if len(offsets) < 2:
        return 0.0
    first = np.repeat(corners[offsets[:-1]], np.diff(offsets))
    following = np.roll(corners, -1)
    following[offsets[1:] - 1] = corners[offsets[:-1]]
    doubled = np.cross(places[corners] - places[first], places[following] - places[first])
    return 0.5 * float(np.linalg.norm(np.add.reduceat(doubled, offsets[:-1]), axis=1).sum())


def row(words: str, how: str, solid: thin_solids.ThinSolid, measure: Callable) -> str:
    start = time.perf_counter()
    count, axis, betti = measure()
    seconds = time.perf_counter() - start
    right = "" if betti == solid.betti else "**"
    whole = solid.area + solid.into_edges
    shares = [f"{area / whole:.3f}" if solid.area else "" for area in (area_of(axis), solid.area)]
    cells = [words, how, f"{count:,}", f"{right}{betti}{right}", str(solid.betti), *shares]
    return f"| {' | '.join([*cells, f'{seconds:.1f}'])} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=4000)
    parser.add_argument("--solids", nargs="+", default=SOLIDS)
    parser.add_argument("--plain", action="store_true")
    parser.add_argument("--automatic", action="store_true")
    wanted = parser.parse_args()
    print("| solid | sampling | samples | Betti | true | area | middle | s |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for words in wanted.solids:
        solid = solid_of(words)
        mesh, smooth = thin_solids.turned(solid.mesh), words.split(":")[0] in ROUND
        for pairs in (True, False) if wanted.plain else (True,):
            how = "pairs" if pairs else "blue noise"

            def one(mesh=mesh, pairs=pairs, smooth=smooth):
                count, level = level_of(mesh, wanted.samples, pairs, smooth)
                return count, level, tuple(level.betti)

            print(row(words, how, solid, one), flush=True)
        if wanted.automatic:
            measure = lambda mesh=mesh: automatic(mesh)
            print(row(words, "Automatic", solid, measure), flush=True)


if __name__ == "__main__":
    main()
