# SPDX-License-Identifier: GPL-3.0-or-later
"""Real closed solids: whether the axis has the Betti numbers of their faces, and what it costs; a Markdown table.

    python3 lab/benchmarks/closed_solids.py FOLDER [--only WORD ...] [--option NAME=VALUE ...]

Files that are no single closed body are passed over. The Betti numbers of the faces say nothing where parts overlap.
`--option` sets fields of `Settings` by their names in Python.
"""

import argparse
import ast
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import _module
import numpy as np

medial = _module.load()

from medial_axis import library  # noqa: E402

_TAG = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
_ENDINGS = (".stl", ".obj", ".3mf", ".ply", ".off")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", nargs="+", default=[""])
    parser.add_argument("--option", nargs="+", default=[])
    wanted = parser.parse_args()
    options = {name: _value(word) for name, _, word in (o.partition("=") for o in wanted.option)}
    print("| solid | faces | Betti of faces | Betti | samples | left out | s | topology |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, points, triangles, betti in closed_bodies(wanted.folder, wanted.only):
        print(row(name, points, triangles, betti, options), flush=True)


def closed_bodies(
    folder: Path, words: list[str]
) -> Iterator[tuple[str, np.ndarray, np.ndarray, tuple]]:
    """Name, points, triangles and Betti numbers of each file with one of the words that is a single closed body."""
    for path in sorted(folder.iterdir(), key=lambda path: path.name.lower()):
        if path.suffix.lower() not in _ENDINGS or not any(word in path.name for word in words):
            continue
        points, triangles = welded(*read(path))
        betti = medial.solid_betti(points, triangles) if len(triangles) else None
        if betti is not None and betti[0] == 1:
            yield path.name, points, triangles, betti


def row(name: str, points: np.ndarray, triangles: np.ndarray, betti: tuple, options: dict) -> str:
    start = time.process_time()
    found = library.compute(points, triangles, side="inner", **options)
    seconds = time.process_time() - start
    samples, own = found.chosen.samples, tuple(found.axis.level.betti)
    mark = "" if own == betti else "**"
    count = f"{len(samples.points):,}"
    cells = [name, f"{len(triangles):,}", str(betti), f"{mark}{own}{mark}", count]
    return f"| {' | '.join([*cells, str(samples.buried), f'{seconds:.1f}', found.topology])} |"


def read(path: Path) -> tuple[np.ndarray, np.ndarray]:
    if path.suffix.lower() == ".3mf":
        parts = list(_parts(path))
        starts = np.cumsum([0, *(len(points) for points, _ in parts)])
        shifted = [rows + start for (_, rows), start in zip(parts, starts)]
        return np.concatenate([points for points, _ in parts]), np.concatenate(shifted)
    shape = library.read(path)
    return shape.points, shape.triangles


def _parts(path: Path) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """The meshes of a 3MF file; their placing does not matter where there is one."""
    with zipfile.ZipFile(path) as file:
        for name in file.namelist():
            if not name.endswith(".model"):
                continue
            for mesh in ElementTree.fromstring(file.read(name)).iter(_TAG + "mesh"):
                points = [[float(v.get(k)) for k in "xyz"] for v in mesh.iter(_TAG + "vertex")]
                rows = [
                    [int(t.get(k)) for k in ("v1", "v2", "v3")]
                    for t in mesh.iter(_TAG + "triangle")
                ]
                yield np.array(points).reshape(-1, 3), np.array(rows, np.int32).reshape(-1, 3)


def welded(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The mesh with one row for equal vertices, and without triangles that use one twice."""
    points, rows = np.unique(points, axis=0, return_inverse=True)
    triangles = rows.reshape(-1)[triangles].astype(np.int32)
    a, b, c = triangles.T
    return points, triangles[(a != b) & (b != c) & (c != a)]


def _value(word: str) -> object:
    try:
        return ast.literal_eval(word)
    except ValueError:
        return word


if __name__ == "__main__":
    main()
