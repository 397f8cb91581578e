# SPDX-License-Identifier: GPL-3.0-or-later
"""The centre line of a scanned vessel with an aneurysm, and that of the same vessel with a wall, which Fill gives.

    python3 lab/benchmarks/walled_vessel.py [MESH] [--output table.md]

MESH is an open lumen; without it the vessel of Debian's package gmsh-doc is taken. Solidify gives it walls outward, so
that the inner faces of each solid are the lumen itself. Distances are those of 50 places on each piece of one line from
the other, in radii there: mean, 95th percentile, largest, the larger one of both directions.
"""

from __future__ import annotations

import gzip
import tempfile
from collections.abc import Iterator
from pathlib import Path

import _module
import numpy as np

_module.load()

import medial_axis  # noqa: E402  (found through _module)
from medial_axis.core.settings import Fill, Settings, SkeletonSettings, SolidifySettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.skeleton.compute import compute_skeleton  # noqa: E402
from medial_axis.core.skeleton.skeleton import Skeleton  # noqa: E402
from medial_axis.core.solidify.solidify import solidify  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402

VESSEL = Path("/usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz")
WALLS, PLACES = (0.2, 0.4, 0.8, 1.2), 50
HEADER = ["wall", "faces", "branches", "ends", "loops", "distance in radii", "radius off"]


def vessel(file: Path) -> Shape:
    if file.suffix != ".gz":
        return medial_axis.read(str(file))
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder, file.stem)
        plain.write_bytes(gzip.decompress(file.read_bytes()))
        return medial_axis.read(str(plain))


def places_on(line: Skeleton) -> tuple[np.ndarray, np.ndarray]:
    share = np.linspace(0.0, 1.0, PLACES)[:, None, None]
    start, end = line.edges.T
    balls = np.column_stack((line.points, line.radius))
    found = ((1.0 - share) * balls[start] + share * balls[end]).reshape(-1, 4)
    return found[:, :3], found[:, 3]


def apart(one: Skeleton, other: Skeleton) -> tuple[np.ndarray, np.ndarray]:
    """The distances of places on a line from another one, and the differences of the radii, in radii."""
    (places, radius), (others, beyond) = places_on(one), places_on(other)
    away, nearest = cKDTree(others).query(places)
    return away / radius, abs(radius - beyond[nearest]) / radius


def rows(file: Path) -> Iterator[list[str]]:
    lumen = vessel(file)
    line = compute_skeleton(lumen, Settings(), SkeletonSettings()).skeleton
    yield row("none", len(lumen.triangles), line, line)
    for wall in WALLS:
        solid = solidify(lumen, SolidifySettings(thickness=wall, offset=1.0))
        shape = Shape(solid.vertices, solid.triangles)
        found = compute_skeleton(shape, Settings(), SkeletonSettings(fill=Fill.INSIDE)).skeleton
        yield row(f"{wall:g}", len(shape.triangles), found, line)


def row(wall: str, faces: int, line: Skeleton, lumen: Skeleton) -> list[str]:
    both = [apart(line, lumen), apart(lumen, line)]
    away = [max(figure(one) for one, _ in both) for figure in (np.mean, _most, np.max)]
    off = max(_most(radius) for _, radius in both)
    counts = (line.count, line.tips, line.loops)
    return [
        wall, f"{faces:,}", *map(str, counts), ", ".join(f"{x:.3f}" for x in away), f"{off:.3f}"
    ]  # fmt: skip


def _most(values: np.ndarray) -> float:
    return float(np.quantile(values, 0.95))


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("mesh", nargs="?", type=Path, default=VESSEL, metavar="MESH")
    words = parser.parse_args()
    _module.tell(HEADER, rows(words.mesh), words.output)


if __name__ == "__main__":
    main()
