# SPDX-License-Identifier: GPL-3.0-or-later
"""Would crisp places pay for points with normals, which have no faces? An experiment: a Markdown table.

    python3 lab/benchmarks/places_of_clouds.py [--output table.md] [--shapes box ellipsoid] [--samples 4000]
        [--noise 0 0.05 0.1] [--neighbours 16] [--seed 0]

Points of the exact faces with exact normals, as evenly spread as Sampling Surface spreads them, none on an edge; noise
moves them in all directions by a share of the spacing (the standard deviation), and turns the normals by as many
radians. The walls of a vertex are quadrics, each fitted to the points and normals round a sample of the vertex that
look the same way. Each vertex of the level moves to the ball that touches its walls, unless it would move by more than
a spacing. The columns have the distances to the exact axis over the diagonal: mean, 99 %, largest.
"""

import sys

import _module
import numpy as np
from scipy.spatial import cKDTree

medial = _module.load()

from support import crisp_solids  # noqa: E402  (found through _module)

FREE = 4  # the kind of samples that are on no edge
SAME_WAY = 0.7  # the least cosine between normals of one wall
SAME_DIRECTION = 0.08  # between walls that do not determine a place
STEPS, FOOT_STEPS = 12, 6
HEADER = ["shape", "points", "noise", "vertices", "moved", "before", "after"]


def cloud(solid, count, noise, seed):
    """(n, 3) points near the faces of a solid, and their outward normals."""
    corners, triangles = solid.mesh
    found = medial.sample_surface(
        np.ascontiguousarray(corners, float),
        np.ascontiguousarray(triangles, np.int32),
        count=count,
        seed=seed,
    )
    points = np.asarray(found.points)[np.asarray(found.kind) == FREE]
    for _ in range(3):  # onto the faces, of which the mesh has chords
        inward = solid.inward(points)
        points = points - solid.distance(points)[:, None] * inward
    normals = -solid.inward(points)
    random = np.random.default_rng([seed, count])
    points = points + noise * solid.spacing(count) * random.normal(size=points.shape)
    normals = normals + noise * random.normal(size=points.shape)
    return points, normals / np.linalg.norm(normals, axis=1)[:, None]


class Quadrics:
    """Heights over the tangent planes of all samples: d + e u + f v + (a u u + 2 b u v + c v v) / 2."""

    def __init__(self, points, normals, neighbours):
        self.points, self.normal = points, normals
        least = np.eye(3)[np.abs(normals).argmin(axis=1)]
        self.u = np.cross(normals, least)
        self.u /= np.linalg.norm(self.u, axis=1)[:, None]
        self.v = np.cross(normals, self.u)
        far, near = cKDTree(points).query(points, neighbours)
        size = far[:, -1:]
        away = (points[near] - points[:, None]) / size[:, :, None]
        u, v, h = (np.einsum("nkj,nj->nk", away, axis) for axis in (self.u, self.v, normals))
        along = np.einsum("nkj,nj->nk", normals[near], normals)
        weight = (along > SAME_WAY) * np.exp(-2 * (u**2 + v**2))
        slope = [
            -np.einsum("nkj,nj->nk", normals[near], axis) / np.maximum(along, SAME_WAY)
            for axis in (self.u, self.v)
        ]
        one, none = np.ones_like(u), np.zeros_like(u)
        rows = [
            ([one, u, v, u * u / 2, u * v, v * v / 2], h),
            ([none, one, none, u, v, none], slope[0]),
            ([none, none, one, none, u, v], slope[1]),
        ]
        matrix = np.concatenate([np.stack(columns, -1) for columns, _ in rows], 1)
        right = np.concatenate([values for _, values in rows], 1)
        weight = np.concatenate([weight] * 3, 1)
        square = np.einsum("nki,nk,nkj->nij", matrix, weight, matrix) + 1e-9 * np.eye(6)
        found = np.linalg.solve(
            square, np.einsum("nki,nk,nk->ni", matrix, weight, right)[..., None]
        )
        self.of = found[..., 0] * size ** np.array([1, 0, 0, -1, -1, -1])

    def feet(self, sample, x):
        """(m, 3) the places of the quadrics of some samples that are nearest to as many points."""
        away = x - self.points[sample]
        axes = np.stack((self.u[sample], self.v[sample], self.normal[sample]), 1)
        local = np.einsum("mij,mj->mi", axes, away)
        d, e, f, a, b, c = self.of[sample].T
        at = np.zeros((len(x), 2))
        for _ in range(FOOT_STEPS):
            u, v = at.T
            height = d + e * u + f * v + (a * u * u + 2 * b * u * v + c * v * v) / 2
            hu, hv, above = e + a * u + b * v, f + b * u + c * v, height - local[:, 2]
            gradient = np.stack((u - local[:, 0] + above * hu, v - local[:, 1] + above * hv), 1)
            uu, uv, vv = 1 + hu * hu + above * a, hu * hv + above * b, 1 + hv * hv + above * c
            positive = uu * vv - uv * uv > 1e-3
            uu, uv, vv = (
                np.where(positive, full, simple)
                for full, simple in ((uu, 1 + hu * hu), (uv, hu * hv), (vv, 1 + hv * hv))
            )
            step = np.stack(
                (
                    vv * gradient[:, 0] - uv * gradient[:, 1],
                    uu * gradient[:, 1] - uv * gradient[:, 0],
                ),
                1,
            )
            at = at - step / (uu * vv - uv * uv)[:, None]
        u, v = at.T
        height = d + e * u + f * v + (a * u * u + 2 * b * u * v + c * v * v) / 2
        return self.points[sample] + np.einsum("mi,mij->mj", np.column_stack((at, height)), axes)


def walls_of(level):
    """(v, 4) a sample for each wall of each vertex, nearest first in its group, or -1."""
    pairs = [set() for _ in level.vertices]
    for f, (p, q) in enumerate(np.asarray(level.generators)):
        for v in level.face_vertices[level.face_offsets[f] : level.face_offsets[f + 1]]:
            pairs[v].add((min(p, q), max(p, q)))
    walls = np.full((len(pairs), 4), -1)
    for v, apart in enumerate(pairs):
        samples = sorted({s for pair in apart for s in pair})
        group = {s: s for s in samples}
        for i, s in enumerate(samples):
            for t in samples[i + 1 :]:
                if (s, t) not in apart and group[s] != group[t]:
                    old, new = group[t], group[s]
                    group = {k: new if g == old else g for k, g in group.items()}
        firsts = sorted(set(group.values()))
        if apart and len(firsts) < 2:
            firsts = list(min(apart))
        walls[v, : len(firsts[:4])] = firsts[:4]
    return walls


def placed(quadrics, walls, start, farthest):
    """(v, 3) the centres of the balls that touch the walls, and which vertices moved."""
    x, known = start.copy(), walls >= 0
    moves = known.sum(axis=1) >= 2
    for _ in range(STEPS):
        feet = np.repeat(x[:, None], 4, axis=1)
        rows = np.nonzero(known)
        feet[rows] = quadrics.feet(walls[rows], x[rows[0]])
        away = x[:, None] - feet
        radius = np.linalg.norm(away, axis=2)
        away /= np.maximum(radius, 1e-300)[..., None]
        usable = known[:, 1:, None]
        matrix = np.where(usable, away[:, 1:] - away[:, :1], 0)
        unequal = np.where(usable[..., 0], radius[:, :1] - radius[:, 1:], 0)
        u, sizes, vt = np.linalg.svd(matrix)
        inverse = np.where(sizes > SAME_DIRECTION, 1 / np.maximum(sizes, 1e-300), 0)
        step = np.einsum("vji,vj,vkj,vk->vi", vt, inverse, u, unequal)
        x = np.where(moves[:, None], x + step, x)
        moves &= np.linalg.norm(x - start, axis=1) < farthest
        x = np.where(moves[:, None], x, start)
    moves &= np.abs(unequal).max(axis=1) < 1e-6 * farthest
    return np.where(moves[:, None], x, start), moves


def row(name, noise, options):
    solid = crisp_solids.solid(name)
    points, normals = cloud(solid, options.samples, noise, options.seed)
    quadrics = Quadrics(points, normals, options.neighbours)
    level = medial.MedialAnalysis(points).hierarchy().extract(spacings=1)
    vertices = np.asarray(level.vertices)
    on_facets = np.unique(level.face_vertices)
    walls = walls_of(level)
    after, moved = placed(quadrics, walls, vertices, solid.spacing(options.samples))
    head = [name, str(len(points)), f"{noise:g}", str(len(on_facets))]
    return [
        *head,
        f"{moved[on_facets].mean():.1%}",
        *(spread(solid.off_axis(x[on_facets]) / solid.diagonal) for x in (vertices, after)),
    ]


def spread(values):
    return f"{values.mean():.1e} {np.quantile(values, 0.99):.1e} {values.max():.1e}"


def main():
    parser = _module.parser(__doc__)
    shapes = ["ellipsoid", "box", "cylinder", "cone"]
    parser.add_argument("--shapes", nargs="+", default=shapes, choices=crisp_solids.NAMES)
    parser.add_argument("--samples", type=int, default=4_000)
    parser.add_argument("--noise", nargs="+", type=float, default=[0, 0.05, 0.1])
    parser.add_argument("--neighbours", type=int, default=16, help="of a sample, for its quadric")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    table = []
    for name in options.shapes:
        for noise in options.noise:
            table.append(row(name, noise, options))
            print(" | ".join(table[-1]), file=sys.stderr, flush=True)
    _module.publish(_module.markdown(HEADER, table), options.output)


if __name__ == "__main__":
    main()
