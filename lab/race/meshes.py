# SPDX-License-Identifier: GPL-3.0-or-later
"""The race on meshes: programs get the faces of solids, or as many samples of them as ours takes.

    python3 -m lab.race.meshes [--shapes box wedge ...] [--samples 8000] [--programs NAME ...] [--page table.md]
        [--keep FOLDER]

The solids are those of `support.crisp_solids`, turned at random. What gets faces has the mesh itself, whose vertices
are few; what gets points or normals has the samples of Sampling Surface, with normals of the exact faces.
`meshes.toml` lists ours, `recipes.toml` the others. Distances are in shares of the diagonal, the gap of convex edges
in spacings; the area is that of the output over the exact one. `--keep` writes what was found, for
`lab/pictures/beside_others.py`.
"""

from __future__ import annotations

import argparse
import csv
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from support import crisp_runs, crisp_solids, distance, meshes

from . import judge, product, read_axis, recipes
from .betti import betti
from .run import metered

HEADER = ["solid", "program", "gets", "off mean", "off largest", "missed mean"]
HEADER += ["missed largest", "gap mean", "area", "Betti", "faces"]
OURS = Path(__file__).parent / "meshes.toml"
MARK = "<!-- Below this line stands what `python3 -m lab.race.meshes` measured. -->"
POINTS = 8000  # drawn from the output
BALLS = 5000  # of the exact axis
SHOWN = ("box", "bracket", "cylinder", "ellipsoid")  # on the page; the CSV file has all solids


class Inputs:
    """Files of one solid in a folder: its mesh, and samples of it with normals."""

    def __init__(self, name: str, count: int, folder: Path) -> None:
        self.name, self.solid = name, crisp_solids.solid(name)
        made = crisp_runs.Case(name, count).made(crisp=False)
        self.frame, points = made.frame, made.computation.chosen.samples.points
        self.samples = len(points)
        normals = -self.solid.inward(points @ self.frame) @ self.frame.T
        self.files = {name: folder / f"{name}.{end}" for name, end in _ENDS.items()}
        mesh, _ = crisp_solids.turned(self.solid.mesh, 0)
        meshes.write_off(self.files["mesh"], mesh)
        np.savetxt(self.files["points"], points, fmt="%.17g")
        np.savetxt(self.files["oriented"], np.hstack((points, normals)), fmt="%.17g")


_ENDS = {"mesh": "off", "points": "xyz", "oriented": "xyzn"}


def row(
    recipe: recipes.Recipe, inputs: Inputs, count: int, limit: int, kept: Path | None
) -> list[str]:
    head = [inputs.name, recipe.name, "faces" if recipe.gets == "mesh" else recipe.gets]
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder, recipe.output)
        words = recipe.words({**inputs.files, "output": output, "count": count})
        cost, said = metered(words, Path(folder), limit)
        if cost["exit"] != 0 or not output.exists():
            print(recipe.name, said[-300:], file=sys.stderr)
            return [*head, "failed", *[""] * (len(HEADER) - len(head) - 1)]
        found = read_axis.read(output)
        if kept:
            keep(found, inputs, kept.with_name(f"{kept.name} {recipe.name}.npz"))
        return [*head, *cells(score(inputs, found))]


def keep(found: read_axis.Complex, inputs: Inputs, path: Path) -> None:
    """Write `triangles` (t, 3, 3), `edges` (e, 2, 3) and `points` (p, 3), and those of the `solid`, in its frame."""
    mesh, _ = crisp_solids.turned(inputs.solid.mesh, None)
    np.savez(
        path,
        triangles=judge.triangles_of(found) @ inputs.frame,
        edges=found.vertices[found.edges] @ inputs.frame,
        points=found.vertices[found.points] @ inputs.frame,
        solid=mesh[0][mesh[1]],
    )


def score(inputs: Inputs, found: read_axis.Complex) -> dict[str, Any]:
    solid, spacing = inputs.solid, inputs.solid.spacing(inputs.samples)
    off = solid.off_axis(judge.points_of(found, spacing, POINTS) @ inputs.frame)
    corners = solid.off_axis(found.vertices @ inputs.frame)
    pieces = judge.simplices_of(found) @ inputs.frame
    missed = distance.to_triangles(solid.centres(BALLS), pieces)
    gap = distance.to_triangles(solid.edges, pieces).mean() / spacing if len(solid.edges) else None
    area = judge.areas(judge.triangles_of(found)).sum()
    return {
        "off": (off.mean() / solid.diagonal, max(off.max(), corners.max()) / solid.diagonal),
        "missed": (missed.mean() / solid.diagonal, missed.max() / solid.diagonal),
        "gap": gap,
        "area": None if solid.area is None else area / solid.area,
        "betti": betti(found),
        "faces": found.faces,
    }


def cells(found: dict[str, Any]) -> list[str]:
    lengths = [f"{x:.1e}" for x in (*found["off"], *found["missed"])]
    ratios = ["" if x is None else f"{x:.3g}" for x in (found["gap"], found["area"])]
    numbers = "" if found["betti"] is None else ", ".join(map(str, found["betti"]))
    return [*lengths, *ratios, numbers, str(found["faces"])]


def programs(count: int, names: list[str] | None = None) -> list[recipes.Recipe]:
    """Ours with faces first; then all others that are on this machine, or those that are named."""
    known = [r for r in (*recipes.read(OURS), *recipes.read()) if names is None or r.name in names]
    return [recipe for recipe in known if not recipe.missing() and count <= recipe.largest]


def measured(
    name: str, count: int, limit: int, names: list[str] | None = None, folder: Path | None = None
) -> list[list[str]]:
    """A row for each program."""
    kept = folder and folder / name  # the beginning of the names of its files
    with tempfile.TemporaryDirectory() as made:
        inputs = Inputs(name, count, Path(made))
        rows = []
        for recipe in programs(count, names):
            rows.append(row(recipe, inputs, count, limit, kept))
            print(" | ".join(rows[-1]), file=sys.stderr, flush=True)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    shapes = ["box", "wedge", "blunt", "bracket", "cylinder", "plate", "ellipsoid"]
    parser.add_argument("--shapes", nargs="+", default=shapes, choices=crisp_solids.NAMES)
    parser.add_argument("--samples", type=int, default=8000)
    parser.add_argument("--limit", type=int, default=300, help="seconds that a program may take")
    parser.add_argument("--programs", nargs="+", help="names of both lists; default: all")
    parser.add_argument(
        "--page", type=Path, help="also write the means there, below the mark, and a CSV file"
    )
    parser.add_argument("--keep", type=Path, help="a folder for what the programs found")
    options = parser.parse_args()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    given = options.samples, options.limit, options.programs, options.keep
    rows = [row for name in options.shapes for row in measured(name, *given)]
    print(product.markdown(HEADER, rows))
    if options.page:
        publish(rows, options.page)


def publish(rows: list[list[str]], page: Path) -> None:
    """All rows into a CSV file next to the page; the means below its mark. What is above the mark stays."""
    with page.with_suffix(".csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *rows])
    above = page.read_text(encoding="utf-8").partition(MARK)[0] if page.exists() else ""
    page.write_text(f"{above}{MARK}\n\n{means(rows)}", encoding="utf-8")


def means(rows: list[list[str]]) -> str:
    """A row for each program: the mean distances off the axis and of what it missed, for the solids of the page."""
    cells = [dict(zip(HEADER, row, strict=True)) for row in rows if row[0] in SHOWN]
    found = {
        (x["program"], x["solid"]): f"{x['off mean']}, {x['missed mean']}".removesuffix(", ")
        for x in cells
    }
    solids = list(dict.fromkeys(x["solid"] for x in cells))
    names = dict.fromkeys(x["program"] for x in cells)
    body = [[name, *(found.get((name, solid), "") for solid in solids)] for name in names]
    return product.markdown(["program", *solids], body)


if __name__ == "__main__":
    main()
