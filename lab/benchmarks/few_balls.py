# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges few balls of solids from both sides: the tables of docs/lab/few_balls.md.

python3 lab/benchmarks/few_balls.py hand_closed.obj human_woman.obj dilo.off --counts 50 100 200
python3 lab/benchmarks/few_balls.py hand_closed.obj --balls other.ma
python3 lab/benchmarks/few_balls.py hand_closed.obj --counts 50 --capsules
"""

import sys
import time
from pathlib import Path

import numpy as np
from _module import DATA, load, markdown, parser, publish

SURFACE, VOLUME, OF_BALL = 20_000, 40_000, 400  # random places
ALONG = 17  # balls along a capsule whose boundaries are looked at
HEADER = ["solid", "balls", "who", "bare, mean", "bare, largest", "out, largest", "rim, mean",
          "held", "added", "CPU s"]  # fmt: skip


def main():
    words = parser(__doc__)
    words.add_argument("meshes", nargs="+", help="names in the folder of real meshes, or paths")
    words.add_argument("--counts", type=int, nargs="+", default=[50, 100, 200])
    words.add_argument("--tolerances", type=float, nargs="*", default=[], help="%% of the diagonal")
    words.add_argument("--balls", nargs="*", default=[], help=".ma files to judge instead of ours")
    words.add_argument("--greedy", action="store_true", help="without Refine")
    words.add_argument("--capsules", action="store_true", help="capsules instead of balls")
    wanted = words.parse_args()
    load()
    rows = [row for mesh in wanted.meshes for row in rows_of(mesh, wanted)]
    publish(markdown(HEADER, rows), wanted.output)


def rows_of(name, wanted):
    """The rows of a mesh: balls of others where files are given, else all of ours."""
    import medial_axis

    path = Path(name) if Path(name).exists() else Path(DATA) / name
    shape = medial_axis.read(path)
    solid = shape.points, shape.triangles
    for file in wanted.balls:
        balls = np.loadtxt(file, skiprows=1, usecols=(1, 2, 3, 4), ndmin=2)
        yield row_of(path, Path(file).stem, balls, solid, None)
    kinds = [] if wanted.balls else kinds_of(wanted.tolerances, wanted.capsules)
    options = {"refine": not wanted.greedy}
    if kinds:
        medial_axis.cover_by_balls(*solid, count=1)  # the axis is kept
    for count in wanted.counts:
        for label, kind in kinds:
            start = time.process_time()
            found = medial_axis.cover_by_balls(*solid, count=count, **kind, **options).balls
            seconds = time.process_time() - start
            balls = np.column_stack([found.centres, found.radii])
            if wanted.capsules:
                balls = np.concatenate(
                    [np.tile(balls[found.single], 2), balls[found.edges].reshape(-1, 8)]
                )
            yield row_of(path, label, balls, solid, seconds)


def kinds_of(tolerances, capsules):
    middle = [(f"tolerance {t:g} %", {"tolerance": t}) for t in tolerances]
    kinds = [("inside", {}), *middle, ("around", {"mode": "around"})]
    if not capsules:
        return kinds
    return [
        (f"{shapes}, {label}", {"shapes": shapes, **kind})
        for label, kind in kinds
        for shapes in ("capsules", "tapered")
    ]


def row_of(path, label, balls, solid, seconds):
    figures = [f"{100 * value:.2f}" for value in judged(balls, solid)]
    cost = "-" if seconds is None else f"{seconds:.1f}"
    row = [path.stem, str(len(balls)), label, *figures, cost]
    print(row, file=sys.stderr, flush=True)
    return row


def judged(balls, solid):
    """Bare places (mean, largest), the largest reach outside, the mean distance of the boundary of the balls from the
    surface, all as shares of the diagonal; held and added volume as shares of the solid's."""
    diagonal = np.sqrt((np.ptp(solid[0], axis=0) ** 2).sum())
    bare = np.maximum(gaps(on_surface(solid, SURFACE), balls), 0) / diagonal
    at_corners = np.maximum(gaps(solid[0], balls), 0) / diagonal
    rim, weight = on_rim(balls)
    away = away_from(rim, solid) / diagonal
    out = np.where(inside(rim, solid), 0.0, away)
    held, added = volumes(balls, solid)
    largest = max(bare.max(), at_corners.max())
    return bare.mean(), largest, out.max(), np.average(away, weights=weight), held, added


def gaps(places, balls):
    """(k,) distances of places from the nearest ball, or capsule of two, negative in it."""
    found = np.full(len(places), np.inf)
    if balls.shape[1] == 8:
        for row in balls:
            found = np.minimum(found, gap_of_capsule(places, row[:4], row[4:]))
        return found
    for x, y, z, radius in balls:
        found = np.minimum(found, np.sqrt(((places - (x, y, z)) ** 2).sum(axis=1)) - radius)
    return found


def gap_of_capsule(places, first, second):
    """(k,) least distance to the balls between two: where the derivative along the segment is 0, or at an end."""
    along, rise = second[:3] - first[:3], second[3] - first[3]
    length, away = np.sqrt((along**2).sum()), places - first[:3]
    if length <= abs(rise) or length == 0:
        return np.minimum(gaps(places, first[None]), gaps(places, second[None]))
    at = (away * along).sum(axis=1) / length
    height = np.sqrt(np.maximum((away**2).sum(axis=1) - at**2, 0))
    slope = rise / length
    share = np.clip((at + slope * height / np.sqrt(1 - slope**2)) / length, 0, 1)
    off = np.sqrt(((away - share[:, None] * along) ** 2).sum(axis=1))
    return off - (first[3] + share * rise)


def on_surface(solid, count):
    """(count, 3) random places on the surface, even by area."""
    vertices, triangles = solid
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    area = np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1))
    random = np.random.default_rng(0)
    rows = random.choice(len(area), count, p=area / area.sum())
    u, v = np.sort(random.random((2, count)), axis=0)
    return a[rows] * u[:, None] + b[rows] * (v - u)[:, None] + c[rows] * (1 - v)[:, None]


def on_rim(balls):
    """(k, 3) places on the boundary of the union, and (k,) the area that each stands for."""
    spheres = balls
    if balls.shape[1] == 8:
        share = np.linspace(0, 1, ALONG)[:, None, None]
        spheres = ((1 - share) * balls[:, :4] + share * balls[:, 4:]).reshape(-1, 4)
    places, weight = on_spheres(spheres)
    bare = gaps(places, balls) > -1e-9 * spheres[:, 3].max()
    return places[bare], weight[bare]


def on_spheres(balls):
    """(k, 3) places on all spheres, and (k,) the area that each stands for."""
    step = np.arange(OF_BALL) + 0.5
    z, angle = 1 - 2 * step / OF_BALL, step * np.pi * (1 + 5**0.5)
    flat = np.sqrt(1 - z * z)
    sphere = np.column_stack([flat * np.cos(angle), flat * np.sin(angle), z])
    places = (balls[:, None, :3] + balls[:, None, 3:] * sphere).reshape(-1, 3)
    return places, np.repeat(balls[:, 3] ** 2, OF_BALL)


def volumes(balls, solid):
    ends = balls.reshape(-1, 4)
    low = np.minimum(solid[0].min(axis=0), (ends[:, :3] - ends[:, 3:]).min(axis=0))
    high = np.maximum(solid[0].max(axis=0), (ends[:, :3] + ends[:, 3:]).max(axis=0))
    places = np.random.default_rng(1).uniform(low, high, (VOLUME, 3))
    within, held = inside(places, solid), gaps(places, balls) <= 0
    return (within & held).sum() / within.sum(), (held & ~within).sum() / within.sum()


def inside(places, solid):
    return load().winding_number(np.ascontiguousarray(places), *solid) > 0.5


def away_from(places, solid):
    return load().TriangleTree(*solid).distances(np.ascontiguousarray(places))


if __name__ == "__main__":
    main()
