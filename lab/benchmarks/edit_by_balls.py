# SPDX-License-Identifier: GPL-3.0-or-later
"""A trial: a surface follows a wanted thickness along the radii of its medial balls, a Markdown table.

    python3 lab/benchmarks/edit_by_balls.py [spot_low.obj ...]

Each vertex lies on the ball that touches the surface there. If that ball is to have another radius, the vertex moves
along the normal by the difference, so the centres of the balls, and with them the axis, stay where they are. The trial
wants another thickness everywhere, or half as much again in one place, as by a soft brush a tenth of the diagonal wide.
Then the thickness is measured again. Told are the error in percent of what was wanted at the vertices that have a ball
between walls, how far it has moved them in percent of the diagonal, and the pairs of triangles that cross, before and
after. Files are those of the folder MEDIAL_AXIS_TEST_DATA.
"""

import _module
import numpy as np
from numpy.typing import NDArray

medial = _module.load()

from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.settings import Edges, SamplingMode, Settings, ThicknessSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.thickness.thickness import measure_thickness  # noqa: E402
from support import meshes, thick_meshes  # noqa: E402
from support.crossing_triangles import crossing_pairs  # noqa: E402

Array = NDArray[np.float64]
HEADER = [
    "solid",
    "wanted",
    "mean error, %",
    "95th percentile, %",
    "largest move, %",
    "crossing pairs",
]


def lengths_of(mesh: meshes.Mesh) -> Array:
    """(n,) the thickness at each vertex; infinite where nothing is opposite."""
    settings = Settings(sampling=SamplingMode.VERTICES)
    found = measure_thickness(Shape(*mesh), settings, ThicknessSettings(edges=Edges.BALL))
    return found.lengths[: len(mesh[0])]


def normals_of(mesh: meshes.Mesh) -> Array:
    """(n, 3) means of the normals of the triangles at each vertex, by their angles."""
    points, triangles = mesh
    total = np.zeros_like(points)
    for k in range(3):
        a, b, c = (points[triangles[:, (k + i) % 3]] for i in range(3))
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        cosine = ((b - a) * (c - a)).sum(1) / np.linalg.norm(b - a, axis=1)
        angle = np.arccos(np.clip(cosine / np.linalg.norm(c - a, axis=1), -1, 1))
        np.add.at(total, triangles[:, k], normal * angle[:, None])
    return total / np.linalg.norm(total, axis=1)[:, None]


def factors_of(points: Array, diagonal: float) -> dict[str, Array]:
    """(n,) the wanted thickness at each vertex, as a factor of the one there, for each trial."""
    top = points[points[:, 2].argmax()]
    away = np.linalg.norm(points - top, axis=1) / (0.1 * diagonal)
    brush = 1 + 0.5 * np.maximum(0, 1 - away**2) ** 2
    one = np.ones(len(points))
    return {"0.7 everywhere": 0.7 * one, "1.3 everywhere": 1.3 * one, "1.5 by a brush": brush}


def rows_of(name: str, mesh: meshes.Mesh, rounds: int) -> list[list[str]]:
    points, triangles = mesh
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    lengths = lengths_of(mesh)
    before = len(crossing_pairs(points, triangles))
    rows = []
    for wanted, factor in factors_of(points, diagonal).items():
        has_ball = np.isfinite(lengths)
        moved, again = points, lengths
        for _ in range(rounds):
            known = has_ball & np.isfinite(again)
            move = 0.5 * np.where(
                known, factor * np.where(known, lengths, 0) - np.where(known, again, 0), 0
            )
            moved = moved + move[:, None] * normals_of((moved, triangles))
            again = lengths_of((moved, triangles))
        move = np.linalg.norm(moved - points, axis=1)
        judged = has_ball & np.isfinite(again) & (factor != 1)
        off = 100 * np.abs(again[judged] / (factor * lengths)[judged] - 1)
        crossings = len(crossing_pairs(moved, triangles))
        rows.append(
            [
                name,
                wanted,
                f"{off.mean():.2f}",
                f"{np.quantile(off, 0.95):.2f}",
                f"{100 * move.max() / diagonal:.2f}",
                f"{before:,} -> {crossings:,}",
            ]
        )
    return rows


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("files", nargs="*")
    parser.add_argument("--rounds", type=int, default=1, help="moves, each after a measurement")
    wanted = parser.parse_args()
    solids = {"torus": meshes.torus(), "ellipsoid": thick_meshes.ellipsoid(subdivisions=4)}
    for name in wanted.files:
        shape, _ = read_shape(_module.DATA / name)
        solids[name] = shape.points, shape.triangles
    rows = [row for name, mesh in solids.items() for row in rows_of(name, mesh, wanted.rounds)]
    _module.publish(_module.markdown(HEADER, rows), wanted.output)


if __name__ == "__main__":
    main()
