# SPDX-License-Identifier: GPL-3.0-or-later
"""The judge of the race: how far what a program wrote is from the exact axis, and how much of the axis it has.

    python3 -m lab.race.judge SOLID FILE [--samples N] [--outer]

prints the scores of one file as JSON. Distances are in the unit of the solids, whose largest half axis is about 1.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from support import distance

from .betti import betti
from .read_axis import Complex, read
from .solids import SOLIDS, box_of, outer_distance, outer_points, within

Array = NDArray[np.float64]

POINTS = 8000
"""Random points of the output whose distance to the exact axis is measured, besides its vertices."""
TRUTH = 1500
"""Random points of the exact axis whose distance to the output is measured; a quarter as many on its rim."""


@dataclass(frozen=True)
class Score:
    """Accuracy is of random points of the output, by area, with loose edges as strips as wide as a spacing of the
    samples and loose points as squares; the largest is of all vertices, too. Coverage is of random points of the exact
    axis, its largest of the rim, too."""

    mean: float
    p99: float
    largest: float
    missed_mean: float
    missed_largest: float
    betti: tuple[int, int, int] | None  # of inner axes
    area: float
    length: float  # of edges without a face
    faces: int
    edges: int
    points: int


def judge(name: str, found: Complex, samples: int, outer: bool = False) -> Score:
    """The score of the inner axis of a solid, or of the outer one in the box of the surface."""
    solid = SOLIDS[name]
    if outer:
        return _outer(name, found, samples)
    truth = np.concatenate((solid.shape.axis_points(TRUTH), solid.shape.rim_points(TRUTH // 4)))
    off = solid.shape.axis_distance
    drawn = points_of(found, solid.spacing(samples))
    away, corners = off(drawn), off(_some(found.vertices, 40_000))
    missed = distance_to(truth, found)
    return Score(
        *_three(away, corners),
        float(missed[:TRUTH].mean()),
        float(missed.max()),
        betti(found),
        *_sizes(found),
    )


def _outer(name: str, found: Complex, samples: int) -> Score:
    """Points are drawn from what lies in a box twice as large as that of the surface, so that what is far away does not
    take them all; those in the box count, and of the exact axis what lies there."""
    low, high = box = box_of(SOLIDS[name].shape)
    twice = low - (high - low) / 2, high + (high - low) / 2
    simplices, weight = simplices_of(found), weights_of(found, SOLIDS[name].spacing(samples))
    weight[~within(simplices.reshape(-1, 3), twice).reshape(-1, 3).all(axis=1)] = 0.0
    truth = outer_points(name, TRUTH)
    drawn = _drawn(simplices, weight, 4 * POINTS) if weight.any() else np.empty((0, 3))
    drawn = drawn[within(drawn, box)][:POINTS]
    missed = distance_to(truth, found)
    three = _NOTHING
    if len(drawn):
        vertices = found.vertices[within(found.vertices, box)]
        three = _three(outer_distance(name, drawn), outer_distance(name, _some(vertices, 40_000)))
    return Score(*three, float(missed.mean()), float(missed.max()), None, *_sizes(found))


_NOTHING = (float("nan"),) * 3


def _three(away: Array, corners: Array) -> tuple[float, float, float]:
    most = max(float(away.max()), float(corners.max(initial=0.0)))
    return float(away.mean()), float(np.quantile(away, 0.99)), most


def _sizes(found: Complex) -> tuple[float, float, int, int, int]:
    length = np.linalg.norm(np.diff(found.vertices[found.edges], axis=1)[:, 0], axis=1).sum()
    area = areas(triangles_of(found)).sum()
    return float(area), float(length), found.faces, len(found.edges), len(found.points)


def _some(rows: Array, most: int) -> Array:
    return (
        rows if len(rows) <= most else rows[np.random.default_rng(0).permutation(len(rows))[:most]]
    )


# --- geometry of a complex


def triangles_of(found: Complex) -> Array:
    """(t, 3, 3) polygons as fans; our facets are convex."""
    sizes = np.diff(found.offsets)
    first = np.repeat(found.offsets[:-1], sizes - 2)
    step = np.arange(len(first)) - np.repeat(np.cumsum(sizes - 2) - (sizes - 2), sizes - 2)
    rows = np.column_stack([found.corners[first + k] for k in (0, step + 1, step + 2)])
    return found.vertices[rows].reshape(-1, 3, 3)


def simplices_of(found: Complex) -> Array:
    """(s, 3, 3) triangles, and edges and points as triangles without area."""
    a, b = found.vertices[found.edges].transpose(1, 0, 2)
    edges = np.stack((a, b, b), axis=1)
    points = np.repeat(found.vertices[found.points][:, None], 3, axis=1)
    return np.concatenate((triangles_of(found), edges, points))


def areas(triangles: Array) -> Array:
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def points_of(found: Complex, width: float, count: int = POINTS, seed: int = 0) -> Array:
    """(count, 3) random points of it by area; edges are strips of that width, points squares."""
    return _drawn(simplices_of(found), weights_of(found, width), count, seed)


def weights_of(found: Complex, width: float) -> Array:
    """(s,) of each simplex its area, for edges and points that of the strip or square."""
    simplices = simplices_of(found)
    weight = areas(simplices)
    edges = slice(len(weight) - len(found.edges) - len(found.points), len(weight))
    weight[edges] = width * np.linalg.norm(simplices[edges, 1] - simplices[edges, 0], axis=1)
    weight[len(weight) - len(found.points) :] = width * width
    return weight


def _drawn(simplices: Array, weight: Array, count: int, seed: int = 0) -> Array:
    rng = np.random.default_rng(seed)
    chosen = simplices[rng.choice(len(weight), size=count, p=weight / weight.sum())]
    u, v = rng.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    line = (chosen[:, 1] == chosen[:, 2]).all(axis=1)
    u = np.where(line, rng.random(count) - v, u)  # u + v is uniform
    a, b, c = chosen[:, 0], chosen[:, 1], chosen[:, 2]
    return a + u[:, None] * (b - a) + v[:, None] * (c - a)


def distance_to(points: Array, found: Complex) -> Array:
    """(n,) exact distance of each point to the nearest point of the complex."""
    return distance.to_triangles(points, simplices_of(found))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("solid", choices=SOLIDS)
    parser.add_argument("file", type=Path)
    parser.add_argument("--samples", type=int, default=8000, help="how many the program was given")
    parser.add_argument("--outer", action="store_true")
    options = parser.parse_args()
    print(
        json.dumps(asdict(judge(options.solid, read(options.file), options.samples, options.outer)))
    )


if __name__ == "__main__":
    main()
