# SPDX-License-Identifier: GPL-3.0-or-later
"""How often is the thickness of random solids wrong in silence? A Markdown table.

    python3 lab/benchmarks/random_walls.py --trials 20

Each solid is measured in a random pose, at the origin and 1e5 of its sizes away. A judge that shares nothing with the
add-on looks at the thinnest places and at random ones: it compares balls with every face of the solid, or of one with
many more sides that stands for a round one. A length is too small if the largest ball there is larger, and too large if
that ball lies between walls and is smaller. A trial is wrong if a place is, and silent if no warning comes with it.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import _module
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

medial = _module.load()

from medial_axis.core.errors import MedialAxisError  # noqa: E402
from medial_axis.core.settings import Settings, ThicknessSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.thickness.measurement import Measurement  # noqa: E402
from medial_axis.core.thickness.thickness import measure_thickness  # noqa: E402
from support import meshes, thick_meshes, thin_solids  # noqa: E402
from support.meshes import Mesh  # noqa: E402

Array = NDArray[np.float64]
Longs = NDArray[np.int64]
AWAY = (0.0, 1e5)
ROUND = 160  # sides, at least, of the solid that stands for a round one
JUDGED = 25  # places of each kind
OWN = math.cos(math.radians(15.0))  # faces of its own surface that look so much as a place does
OPPOSITE, SURELY = -0.5, -0.53
BY_FACES, BY_SAMPLES = 0.03, 0.1  # a length is wrong if it is off by more, as a share


@dataclass(frozen=True)
class Trial:
    """A mesh, the faces of the true solid, and the smooth surface of which each of them is a part."""

    mesh: Mesh
    truth: Mesh
    surface: Longs
    slack: float = 0.0  # so far the smooth surface of the mesh may be from the true one
    smooth: bool = True


# --- solids


def slack_of(around: int) -> float:
    """Half of how far a circle of radius 1 is from its polygon, which says no better what circle is meant."""
    return (1.0 - math.cos(math.pi / around)) / 2.0


def ring_faces(rings: int, around: int, closed: bool) -> tuple[NDArray[np.int32], Longs]:
    """Triangles between rings of points that follow each other, and the row of rings of each."""
    i = np.arange(around)
    j = np.roll(i, -1)
    triangles = []
    for k in range(rings if closed else rings - 1):
        a, b = k * around, (k + 1) % rings * around
        triangles.append(
            np.stack(((a + i, a + j, b + j), (a + i, b + j, b + i)), 0).transpose(0, 2, 1)
        )
    found = np.concatenate(triangles).reshape(-1, 3).astype(np.int32)
    return found, np.repeat(np.arange(len(triangles)), 2 * around)


def turned_part(rng: np.random.Generator) -> Trial:
    """Two to five random rings, at which the profile bends by more than any smooth surface does."""
    around = int(rng.integers(12, 65))
    while True:
        rings = int(rng.integers(2, 6))
        radii, steps = rng.uniform(0.3, 1.0, rings), rng.uniform(0.15, 0.7, rings)
        profile = np.column_stack((radii, np.cumsum(steps)))
        outline = np.concatenate(([(0.0, profile[0, 1])], profile, [(0.0, profile[-1, 1])]))
        way = np.arctan2(*np.diff(outline, axis=0).T)
        if (np.abs(np.diff(way)) > math.radians(40.0)).all():
            break

    def made(sides: int) -> tuple[Mesh, Longs]:
        mesh = thick_meshes.lathe([tuple(row) for row in outline], sides)
        return mesh, np.repeat(np.arange(rings + 1), [sides, *[2 * sides] * (rings - 1), sides])

    return Trial(made(around)[0], *made(around * math.ceil(ROUND / around)), slack_of(around))


def pipe(rng: np.random.Generator) -> Trial:
    """A hollow tube with flat ring caps: straight, tapered or bent, of a circle or an ellipse."""
    around, rows = int(rng.integers(12, 65)), int(rng.choice((1, 1, 4)))
    wall, height = rng.uniform(0.03, 0.3), rng.uniform(0.5, 3.0)
    flat, taper = (rng.uniform(0.5, 1.0), 1.0) if rng.integers(2) else (1.0, rng.uniform(0.5, 1.0))
    bend = rng.uniform(0.3, 1.5) if rng.integers(2) else 0.0
    rows = 16 if bend else rows

    def made(sides: int, rows: int) -> tuple[Mesh, Longs]:
        angle = 2 * np.pi * np.arange(sides) / sides
        share = np.linspace(0.0, 1.0, rows + 1)
        points = []
        for s, less in [(s, 0.0) for s in share] + [(s, wall) for s in share[::-1]]:
            size = 1.0 + (taper - 1.0) * s
            x, y = (size - less) * np.cos(angle), (flat * size - less * flat) * np.sin(angle)
            away = height / bend if bend else 0.0
            across, along = (x + 1.5 + away, bend * s) if bend else (x, height * s)
            points.append(
                np.column_stack((across * np.cos(along), y, across * np.sin(along)))
                if bend
                else np.column_stack((x, y, np.full(sides, along)))
            )
        triangles, row = ring_faces(len(points), sides, True)
        points = np.concatenate(points)
        if np.linalg.det(points[triangles]).sum() < 0:
            triangles = triangles[:, ::-1]
        surface = np.where(row < rows, 0, np.where(row == rows, 1, np.where(row <= 2 * rows, 2, 3)))
        return (points, triangles), surface

    finer = math.ceil(ROUND / around)
    fine = made(around * finer, 2 * rows if bend else rows)
    return Trial(made(around, rows)[0], *fine, slack_of(around))


def open_part(rng: np.random.Generator) -> Trial:
    """A cylinder or cone of which one lid or both are missing."""
    around, low, high = int(rng.integers(12, 65)), rng.uniform(0.5, 1.0), rng.uniform(0.5, 1.0)
    outline = [(0.0, 0.0), (low, 0.0), (high, rng.uniform(1.0, 4.0))]
    outline.append((0.0, outline[-1][1]))
    without = rng.integers(1, 3)

    def made(sides: int) -> tuple[Mesh, Longs]:
        return thick_meshes.lathe(outline, sides), np.repeat(
            np.arange(3), (sides, 2 * sides, sides)
        )

    (points, triangles), surface = made(around)
    kept = surface != 2 if without == 1 else surface == 1
    used, triangles = np.unique(triangles[kept], return_inverse=True)
    mesh = points[used], triangles.reshape(-1, 3).astype(np.int32)
    return Trial(mesh, *made(around * math.ceil(ROUND / around)), slack_of(around))


def flat_faces(mesh: Mesh) -> Trial:
    """A solid of flat faces: what lies in one plane is one surface."""
    corners = mesh[0][mesh[1]]
    normals = unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    planes = np.column_stack((normals, (normals * corners[:, 0]).sum(axis=1))).round(7)
    surface = np.unique(planes, axis=0, return_inverse=True)[1].ravel()
    return Trial(mesh, mesh, surface, smooth=False)


def polyhedron(rng: np.random.Generator) -> Trial:
    """A plate over a polygon with rims that slant, or the hull of a few points, flattened, whose edges are sharp."""
    if rng.integers(2):
        sides, thick = int(rng.integers(3, 9)), rng.uniform(0.05, 0.5)
        angle = 2 * np.pi * (np.arange(sides) + rng.uniform(-0.3, 0.3, sides)) / sides
        circle = np.column_stack((np.cos(angle), np.sin(angle)))
        smaller = 1.0 - thick / math.tan(math.radians(rng.uniform(35.0, 85.0)))
        points = np.concatenate(
            [
                np.column_stack((r * circle, np.full(sides, z)))
                for r, z in ((1.0, 0.0), (smaller, thick))
            ]
        )
    else:
        points = rng.normal(size=(int(rng.integers(6, 16)), 3)) * (1.0, 1.0, rng.uniform(0.05, 1.0))
    hull = ConvexHull(points)
    beside = hull.equations[hull.neighbors, :3]
    facing = (hull.equations[:, None, :3] * beside).sum(axis=2)
    if ((facing > math.cos(math.radians(40.0))) & (facing < 1 - 1e-9)).any():
        return polyhedron(rng)
    triangles = hull.simplices.astype(np.int32)
    inward = (
        np.cross(*np.diff(points[triangles], axis=1).transpose(1, 0, 2)) * hull.equations[:, :3]
    ).sum(axis=1) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return flat_faces((points, triangles))


def assembly(rng: np.random.Generator) -> Trial:
    """Two to four boxes that overlap."""
    boxes = []
    low = np.zeros(3)
    for _ in range(int(rng.integers(2, 5))):
        size = rng.uniform(0.15, 1.0, 3)
        boxes.append((tuple(low), tuple(low + size)))
        low = low + rng.uniform(0.2, 0.8, 3) * size
    parts = [thick_meshes.block(*np.subtract(b, a), tuple(np.add(a, b) / 2)) for a, b in boxes]
    return replace(flat_faces(thin_solids.union(*boxes)), mesh=meshes.join(*parts))


def open_assembly(rng: np.random.Generator) -> Trial:
    """The same, where one triangle is missing."""
    trial = assembly(rng)
    points, triangles = trial.mesh
    return replace(trial, mesh=(points, np.delete(triangles, rng.integers(len(triangles)), axis=0)))


CLASSES: dict[str, Callable[[np.random.Generator], Trial]] = {
    "turned parts": turned_part,
    "polyhedra": polyhedron,
    "pipes": pipe,
    "open parts": open_part,
    "overlapping boxes": assembly,
    "the same, open": open_assembly,
}


# --- the judge


def unit(vectors: Array) -> Array:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300)


def feet_on(place: Array, corners: Array) -> tuple[Array, Array]:
    """(m, 3) the nearest place of each triangle, and (m,) how far it is."""
    a, b, c = corners.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    square = np.maximum((normal * normal).sum(axis=1), 1e-300)
    best = place - (((place - a) * normal).sum(axis=1) / square)[:, None] * normal
    inside = np.ones(len(a), bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(q - p, best - p) * normal).sum(axis=1) >= 0
    away = np.where(inside, np.linalg.norm(place - best, axis=1), np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        share = ((place - p) * (q - p)).sum(axis=1) / np.maximum(((q - p) ** 2).sum(axis=1), 1e-300)
        foot = p + np.clip(share, 0, 1)[:, None] * (q - p)
        length = np.linalg.norm(place - foot, axis=1)
        nearer = length < away
        best[nearer], away = foot[nearer], np.where(nearer, length, away)
    return best, away


class Judge:
    """Balls inside the true solid, each compared with all of its faces."""

    def __init__(self, trial: Trial) -> None:
        points, triangles = trial.truth
        self.corners, self.surface = points[triangles], trial.surface
        a, b, c = self.corners.transpose(1, 0, 2)
        self.normals = unit(np.cross(b - a, c - a))
        ways = [unit(np.roll(self.corners, -k, axis=1) - self.corners) for k in (1, 2)]
        angles = np.arccos(np.clip((ways[0] * ways[1]).sum(axis=2), -1, 1))
        at = np.unique(
            np.column_stack((trial.surface.repeat(3), triangles.ravel())),
            axis=0,
            return_inverse=True,
        )[1].ravel()
        sums = np.zeros((at.max() + 1, 3))
        np.add.at(sums, at, (angles[:, :, None] * self.normals[:, None]).reshape(-1, 3))
        self.smooth = unit(sums)[at].reshape(-1, 3, 3)

    def place(self, near: Array) -> tuple[Array, Array, int, bool]:
        """The nearest place of the faces, its normal and surface, and whether no other surface is as near."""
        feet, away = feet_on(near, self.corners)
        face = int(away.argmin())
        others = self.surface != self.surface[face]
        size = np.linalg.norm(np.ptp(self.corners.reshape(-1, 3), axis=0))
        alone = away[others].min(initial=np.inf) > away[face] + 1e-3 * size
        own = np.vstack((self.corners[face].T - feet[face][:, None], np.ones(3)))
        shares = np.linalg.lstsq(own, np.array((0.0, 0.0, 0.0, 1.0)), rcond=None)[0]
        return feet[face], unit(shares @ self.smooth[face]), int(self.surface[face]), alone

    def balls(self, place: Array, normal: Array, surface: int) -> tuple[float, float]:
        """The diameters of the largest ball there, and of that which no opposite face limits."""
        facing = self.normals @ normal
        own = (self.surface == surface) & (facing > OWN)
        return self._largest(place, normal, ~own), self._largest(place, normal, facing <= SURELY)

    def _largest(self, place: Array, normal: Array, faces: NDArray[np.bool_]) -> float:
        corners = self.corners[faces]
        radius = float(np.linalg.norm(np.ptp(self.corners.reshape(-1, 3), axis=0)))
        for _ in range(200):
            centre = place - radius * normal
            feet, away = feet_on(centre, corners)
            nearest = int(away.argmin()) if len(away) else -1
            if nearest < 0 or away[nearest] >= (1 - 1e-6) * radius:
                break
            corners = corners[away <= radius]  # each ball lies in the one before
            way = place - feet[nearest]
            depth = float(way @ normal)
            if depth <= 0:
                return 0.0
            radius = float(way @ way) / (2 * depth)
        return 2 * radius


@dataclass
class Verdict:
    """The judged places of one trial, those that are wrong, the least and largest share of the truth, what was said."""

    judged: int
    wrong: int
    least: float
    largest: float
    told: bool


def judged(trial: Trial, found: Measurement, back: Callable[[Array], Array], seed: int) -> Verdict:
    judge, rng = Judge(trial), np.random.default_rng(seed)
    count = found.samples
    some = np.flatnonzero(np.isfinite(found.lengths[:count]) & ~found.at_edge[:count])
    thin = some[np.argsort(found.lengths[some], kind="stable")][:JUDGED]
    rows = np.concatenate((thin, rng.choice(some, min(JUDGED, len(some)), replace=False)))
    most = BY_FACES if hasattr(found.chosen, "row") else BY_SAMPLES
    verdict = Verdict(0, 0, 1.0, 1.0, bool(found.warnings))
    for near, length in zip(back(found.points[rows]), found.lengths[rows], strict=True):
        place, normal, surface, alone = judge.place(near)
        if not alone:
            continue
        ball, wall = judge.balls(place, normal, surface)
        low = min((length + trial.slack) / ball, 1.0) if ball > 0 else 1.0
        is_wall = wall <= (1 + 1e-3) * ball
        high = max((length - trial.slack) / wall, 1.0) if is_wall else 1.0
        verdict.judged += 1
        if low < 1 - most or high > 1 + most:
            verdict.wrong += 1
            if SHOWN:
                print("   ", near, normal, f"found {length:.5g}, ball {ball:.5g}, wall {wall:.5g}")
        verdict.least, verdict.largest = min(verdict.least, low), max(verdict.largest, high)
    return verdict


def pose(
    rng: np.random.Generator, mesh: Mesh, away: float
) -> tuple[Mesh, Callable[[Array], Array]]:
    """The mesh in a random pose, so many of its sizes from the origin, and the way back."""
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    size = np.linalg.norm(np.ptp(mesh[0], axis=0))
    shift = away * size * np.array((0.6, -0.64, 0.48))
    return (mesh[0] @ turn.T + shift, mesh[1]), lambda points: (points - shift) @ turn


SHOWN = False


def trials(name: str, number: int, away: float) -> Iterator[Verdict | None]:
    for seed in range(number):
        rng = np.random.default_rng([seed, list(CLASSES).index(name)])
        trial = CLASSES[name](rng)
        (points, triangles), back = pose(rng, trial.mesh, away)
        shape = Shape(points, np.ascontiguousarray(triangles, np.int32))
        try:
            found = measure_thickness(shape, Settings(smooth=trial.smooth), ThicknessSettings())
        except MedialAxisError as error:
            print("   ", name, seed, error)
            yield None
            continue
        verdict = judged(trial, found, back, seed)
        if SHOWN and verdict.wrong:
            print(name, seed, away, len(trial.mesh[0]), verdict, found.warnings[:1], flush=True)
        yield verdict


def row_of(name: str, number: int, away: float) -> list[str]:
    found = [v for v in trials(name, number, away) if v is not None]
    wrong = [v for v in found if v.wrong]
    return [
        name,
        f"{away:g}",
        str(number),
        str(number - len(found)),
        str(len(wrong)),
        str(sum(not v.told for v in wrong)),
        f"{sum(v.wrong for v in found)} of {sum(v.judged for v in found):,}",
        f"{min((v.least for v in found), default=1):.3f}",
        f"{max((v.largest for v in found), default=1):.3f}",
    ]


HEADER = [
    "solids",
    "sizes away",
    "trials",
    "refused",
    "wrong",
    "in silence",
    "wrong places",
    "least",
    "largest",
]


def main() -> None:
    global SHOWN
    parser = _module.parser(__doc__)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--only", choices=list(CLASSES), nargs="*", default=list(CLASSES))
    parser.add_argument("--show", action="store_true", help="print each wrong place")
    arguments = parser.parse_args()
    SHOWN = arguments.show
    rows = (row_of(name, arguments.trials, away) for name in arguments.only for away in AWAY)
    _module.tell(HEADER, rows, arguments.output)


if __name__ == "__main__":
    main()
