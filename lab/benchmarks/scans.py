# SPDX-License-Identifier: GPL-3.0-or-later
"""Noisy points of ten exact shapes or of meshes, as they are and prepared: a Markdown table.

    python3 lab/benchmarks/scans.py [--output table.md] [--shapes torus ...] [--noise 0.5 ...] [--picture scans.png]
    python3 lab/benchmarks/scans.py --meshes

With several seeds the numbers are means over them, and Betti numbers become how many seeds have the right ones.
The second command takes the shared closed meshes instead, with 20,000 samples each, and leaves distances out.

Each shape has some 8,000 even samples, moved by Gaussian errors in all coordinates; the noise is their standard
deviation in spacings, and a spacing the median distance of a clean sample to its nearest neighbour. Measured: the noise
that was found. Betti: pieces, loops and cavities of Clean with Prepare Off and Automatic, bold where they are not those
of the solid. o->t and t->o: mean distance of the vertices of the prepared axis to the exact one, and back, in percent
of the diagonal. Named: every wrong number of the prepared result comes with a sentence that names noise, layers,
outliers, openings, or inside as a guess.
"""

import sys
import time
from pathlib import Path

import _module
import numpy as np
from scipy.spatial import cKDTree

MEDIAL = _module.load()

from medial_axis.core.axis.compute import compute  # noqa: E402
from medial_axis.core.errors import MedialAxisError  # noqa: E402
from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.settings import Prepare, Settings  # noqa: E402
from support.shapes import SHAPES, Cyclide, HoledPlate, RoundCone  # noqa: E402

BALL, RING = (1, 0, 0), (1, 1, 0)
PLATE = HoledPlate()
SOLIDS = {
    **{name: (SHAPES[name], BALL) for name in ("ellipsoid", "oblate", "slab", "box", "capsule")},
    **{name: (SHAPES[name], RING) for name in ("torus", "knot")},
    "round cone": (RoundCone(), BALL),
    "cyclide": (Cyclide(), RING),
    "holed plate": (PLATE, PLATE.betti),
}
NOISE = (0.0, 0.25, 0.5, 1.0)
MESHES = ["3holes.off", "dilo.off", "hand_closed.obj", "knot1.off", "mannequin.off"]
MESHES += ["rocker-arm.off", "screwdriver.off", "spot_low.obj"]
COUNT, COUNT_OF_MESHES = 8000, 20_000
DRAWN = 4000
# Parts of the sentences that name a cause of wrong numbers.
CAUSES = (
    "noise of about",
    "do not fit each other",
    "points lie in",
    "alone",
    "the surface ends at",
)
CAUSES += ("do not tell one solid",)
HEADER = ["shape", "seed", "noise", "measured", "Betti, off", "Betti, prepared", "kept"]
HEADER += ["o->t mean %", "t->o mean %", "seconds", "named"]
OVERALL = ["shape", "noise", "measured", "right, off", "right, prepared", "kept", *HEADER[7:]]
NO_FACES = np.zeros((0, 3), np.int32)


class Meshed:
    """The samples and the topology of a mesh."""

    def __init__(self, name: str) -> None:
        self._shape = read_shape(_module.DATA / name)[0]

    def sample(self, count: int, seed: int) -> np.ndarray:
        shape = self._shape
        return MEDIAL.sample_surface(shape.points, shape.triangles, count=count, seed=seed).points

    @property
    def betti(self) -> tuple[int, int, int]:
        return MEDIAL.solid_betti(self._shape.points, self._shape.triangles)


def noisy(shape, noise: float, seed: int, count: int = COUNT) -> tuple[np.ndarray, float]:
    """Samples with errors, and their spacing before."""
    clean = shape.sample(count, seed)
    spacing = float(np.median(cKDTree(clean).query(clean, 2)[0][:, 1]))
    errors = np.random.default_rng((seed, 1)).normal(size=clean.shape)
    return clean + errors * noise * spacing, spacing


def betti_of(points: np.ndarray, prepare: Prepare):
    """The computation, or None, and a cell about its topology."""
    try:
        found = compute(points, NO_FACES, Settings(prepare=prepare))
    except MedialAxisError as error:
        return None, type(error).__name__
    return found, str(found.axis.level.betti)


def row(name: str, noise: float, seed: int) -> list[str]:
    if name in SOLIDS:
        shape, truth = SOLIDS[name]
        points, spacing = noisy(shape, noise, seed)
    else:
        shape = Meshed(name)
        truth = shape.betti
        points, spacing = noisy(shape, noise, seed, COUNT_OF_MESHES)
    raw, was = betti_of(points, Prepare.OFF)
    start = time.process_time()
    found, now = betti_of(points, Prepare.AUTOMATIC)
    seconds = time.process_time() - start
    cells = [bold(was, raw, truth), bold(now, found, truth)]
    if found is None:
        return [name, str(seed), f"{noise:g}", "", *cells, "", "", "", f"{seconds:.1f}", ""]
    scan = found.chosen.scan
    distances = distances_of(found.axis.vertices, shape, points) if name in SOLIDS else ("", "")
    named = any(cause in warning for warning in found.warnings for cause in CAUSES)
    wrong = found.axis.level.betti != truth
    return [
        *(name, str(seed), f"{noise:g}", f"{scan.noise * scan.spacing / spacing:.3f}", *cells),
        *(f"{scan.kept:,}", *distances, f"{seconds:.1f}"),
        ("yes" if named else "**no**") if wrong else "",
    ]


def summary(rows: list[list[str]]) -> list[list[str]]:
    """One row for all seeds of a shape and a noise."""
    groups: dict[tuple[str, str], list[list[str]]] = {}
    for cells in rows:
        groups.setdefault((cells[0], cells[2]), []).append(cells)
    found = []
    for (name, noise), group in groups.items():
        means = [
            np.mean([float(c[k].replace(",", "") or "nan") for c in group]) for k in (3, 6, 7, 8, 9)
        ]
        right = [str(sum("**" not in c[k] for c in group)) for k in (4, 5)]
        numbers = [f"{means[0]:.3f}", *right, f"{means[1]:,.0f}", *(f"{m:.2f}" for m in means[2:4])]
        named = {c[10] for c in group if c[10]}
        found.append([name, noise, *numbers, f"{means[4]:.1f}", ", ".join(sorted(named))])
    return found


def distances_of(vertices: np.ndarray, shape, points: np.ndarray) -> tuple[str, str]:
    """Mean distances to the exact axis, and back, in percent of the diagonal."""
    diagonal = np.linalg.norm(np.ptp(points, axis=0)) / 100
    to_truth = shape.axis_distance(vertices).mean() / diagonal
    back = cKDTree(vertices).query(shape.axis_points(4000))[0].mean() / diagonal
    return f"{to_truth:.2f}", f"{back:.2f}"


def bold(text: str, found, truth: tuple[int, int, int]) -> str:
    right = found is not None and found.axis.level.betti == truth
    return text if right else f"**{text}**"


def draw(path: Path, names: list[str], noise: float = 0.5) -> None:
    """Columns of shapes: above the axis of the points as they are, below that of the prepared ones."""
    sys.path.insert(0, str(_module.ROOT / "lab/pictures"))
    from scan_sheet import drawn, png

    columns = []
    for name in names:
        points, _ = noisy(SOLIDS[name][0], noise, 1, DRAWN)
        both = [drawn(points, prepare, name) for prepare in (Prepare.OFF, Prepare.AUTOMATIC)]
        columns.append(np.concatenate(both))
    path.write_bytes(png(np.concatenate(columns, axis=1)))


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--shapes", nargs="+", choices=list(SOLIDS), default=list(SOLIDS))
    parser.add_argument("--meshes", action="store_true")
    parser.add_argument("--noise", nargs="+", type=float, default=NOISE)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument(
        "--picture", type=Path, help="draw the axes before and after to this file instead"
    )
    wanted = parser.parse_args()
    if wanted.picture:
        draw(wanted.picture, wanted.shapes)
        return
    rows = []
    for name in MESHES if wanted.meshes else wanted.shapes:
        for noise in wanted.noise:
            for seed in range(1, wanted.seeds + 1):
                rows.append(row(name, noise, seed))
                print(*rows[-1], file=sys.stderr, flush=True)
    table = _module.markdown(HEADER, rows)
    if wanted.seeds > 1:
        table = _module.markdown(OVERALL, summary(rows))
    print(table)
    if wanted.output:
        wanted.output.write_text(table, encoding="utf-8")


if __name__ == "__main__":
    main()
