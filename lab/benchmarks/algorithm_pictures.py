# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings for the docs, as SVG: a cell with its pole and umbrella, theta and rho of an edge, and peeling.

    python3 lab/benchmarks/algorithm_pictures.py [--output docs/pictures]

Of samples of a torus and of a bent ellipsoid, and of what the module computes from them.
"""

import argparse
import math
from pathlib import Path

import _module
import numpy as np
from _drawing import INK, ORANGE, PALE, RED, path, picture, stroke

medial = _module.study()

from support.shapes import SHAPES  # noqa: E402

BLUE, GREEN = "#2e6da4", "#3d8b5f"


def unit(vector):
    return vector / np.linalg.norm(vector)


class View:
    """Looks at a place from far away: `up` upwards, tilted so that one sees a little of what lies flat."""

    def __init__(self, place, up, right, tilt: float, scale: float, middle):
        up = unit(up)
        right = unit(right - (right @ up) * up)
        deep = np.cross(right, up)  # towards the eye
        tilt = math.radians(tilt)
        self.place, self.scale, self.middle = place, scale, np.array(middle)
        self.rows = np.array([right, math.cos(tilt) * up - math.sin(tilt) * deep])
        self.eye = math.sin(tilt) * up + math.cos(tilt) * deep

    def page(self, points):
        """(..., 3) to (..., 2) of the page."""
        flat = (np.asarray(points) - self.place) @ self.rows.T
        return flat * (self.scale, -self.scale) + self.middle

    def depth(self, points):
        return (np.asarray(points) - self.place) @ self.eye


class Sampled:
    """Samples of the torus with their cells, poles and umbrellas, and the one in the hole that is looked at."""

    def __init__(self, count: int):
        self.points = SHAPES["torus"].sample(count, 0)
        self.cells, _, self.centres = medial.delaunay(self.points)
        self.poles, _ = medial.poles(self.points)
        self.offsets, self.triangles = medial.umbrellas(self.points)
        self.row = int(np.argmin(np.hypot(self.points[:, 0], self.points[:, 1])))

    def umbrella(self, row: int):
        return self.triangles[self.offsets[row] : self.offsets[row + 1]]

    def surface(self, reach: float):
        """Triangles of the umbrellas of the samples that are no farther away than `reach`."""
        near = np.linalg.norm(self.points - self.points[self.row], axis=1) < reach
        found = [self.umbrella(row) for row in np.flatnonzero(near)]
        return np.unique(np.sort(np.concatenate(found), axis=1), axis=0)

    def facets(self, row: int):
        """The Voronoi facets of a sample: the other sample, and the corners in their order round the facet."""
        mine = self.cells[(self.cells == row).any(axis=1)]
        centres = self.centres[(self.cells == row).any(axis=1)]
        for other in np.unique(mine[mine != row]):
            corners = centres[(mine == other).any(axis=1)]
            axis = unit(self.points[other] - self.points[row])
            across = unit(np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))]))
            arms = corners - corners.mean(axis=0)
            turn = np.arctan2(arms @ np.cross(axis, across), arms @ across)
            yield other, corners[np.argsort(turn)]


def text(x, y, words: str, colour=INK, anchor="start", size=14) -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}" '
        f'font-size="{size}">{words}</text>'
    )


def dot(point, colour: str, size: float) -> str:
    x, y = point
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size}" fill="{colour}"/>'


def fill(points, colour: str, opacity: float, edge="#ffffff", width=0.8) -> str:
    return (
        f'<path d="{path(points, True)}" fill="{colour}" fill-opacity="{opacity}" stroke="{edge}" '
        f'stroke-width="{width}" stroke-linejoin="round"/>'
    )


def arrow(start, end, colour: str, width=3.0) -> str:
    along = unit(end - start)
    side = np.array([-along[1], along[0]])
    head = [end, end - 13 * along + 5 * side, end - 13 * along - 5 * side]
    return stroke([start, end - 10 * along], colour, width) + fill(head, colour, 1, colour)


# --- a cell, its pole, its umbrella


def cell() -> str:
    s = Sampled(420)
    p, pole = s.points[s.row], s.poles[s.row]
    view = View(p, pole, [0.0, 0.0, 1.0], 24, 400, (330, 300))
    parts = sheet(s, view, 0.42)
    parts += umbrella(s, view)
    behind, before = [], []
    for other, corners in s.facets(s.row):
        away = (s.points[other] - p) @ view.eye < 0
        target = behind if away else before
        target.append(fill(view.page(corners), BLUE, 0.10, BLUE, 0.7 if away else 1.8))
    parts = behind + parts + before
    start, end = view.page(p), view.page(p + pole)
    parts += [arrow(start, end, RED), dot(start, INK, 5), dot(end, RED, 6)]
    parts += [
        text(500, end[1] + 5, "pole p⁺: the farthest", RED),
        text(500, end[1] + 24, "vertex of the cell", RED),
        text(500, (start[1] + end[1]) / 2, "pole vector v: from p to p⁺", RED),
        text(start[0] - 16, start[1] + 5, "p", INK, "end", 17),
    ]
    legend = [
        (BLUE, "Voronoi cell of the sample p: all that is nearer to p than to any other sample"),
        (ORANGE, "umbrella of p: triangles whose Voronoi edges cross the plane normal to v"),
        (PALE, "umbrellas of other samples nearby: together they follow the surface"),
    ]
    return picture("A Voronoi cell, its pole and its umbrella", 640, parts, legend)


def sheet(s: Sampled, view: View, reach: float) -> list[str]:
    """The surface round the sample, what is farther away first."""
    triangles = s.surface(reach)
    order = np.argsort(view.depth(s.points[triangles]).mean(axis=1))
    drawn = [fill(view.page(s.points[t]), "#dfe4e9", 0.85, PALE) for t in triangles[order]]
    return drawn + [dot(view.page(s.points[i]), "#7d8a96", 2.2) for i in np.unique(triangles)]


def umbrella(s: Sampled, view: View) -> list[str]:
    return [fill(view.page(s.points[t]), ORANGE, 0.75, "#8a5410", 1.2) for t in s.umbrella(s.row)]


# --- theta and rho of an edge


def angles(s: Sampled, other: int):
    """theta and rho of the edge to another sample, at this end; the triangle that says theta, and all radii."""
    edge = s.points[other] - s.points[s.row]
    length = np.linalg.norm(edge)
    a, b, c = s.points[s.umbrella(s.row)].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    sides = [np.linalg.norm(x, axis=1) for x in (b - a, c - a, c - b)]
    radii = np.prod(sides, axis=0) / (2 * np.linalg.norm(normals, axis=1))
    sines = np.abs(normals @ edge) / np.linalg.norm(normals, axis=1) / length
    return math.asin(sines.min()), length / radii.max(), int(np.argmin(sines)), radii


def edge_numbers() -> str:
    s = Sampled(1500)
    across, along = chosen_edges(s)
    parts = theta_panel(s, across, along) + rho_panel(s, across, along)
    legend = [
        (ORANGE, "umbrella of p"),
        (RED, "Delaunay edge pq through the solid: both numbers are large, its facet is selected"),
        (BLUE, "Delaunay edge pr beside the surface: both are small, its facet is not"),
    ]
    return picture("Theta and rho of a Delaunay edge", 560, parts, legend)


def chosen_edges(s: Sampled) -> tuple[int, int]:
    """Two samples: one across the tube, one beside the surface; neither edge in the umbrella."""
    inward = -s.poles[s.row]
    others = [q for q, _ in s.facets(s.row) if q not in s.umbrella(s.row)]
    below = [q for q in others if (s.points[q] - s.points[s.row]) @ inward > 0]
    long = [q for q in below if angles(s, q)[1] > 8.5] or below
    across = min(long, key=lambda q: abs(angles(s, q)[0] - math.radians(55)))
    along = min(others, key=lambda q: angles(s, q)[1])
    return across, along


def theta_panel(s: Sampled, across: int, along: int) -> list[str]:
    p, q, r = (s.points[i] for i in (s.row, across, along))
    theta, _, row, _ = angles(s, across)
    a, b, c = s.points[s.umbrella(s.row)[row]]
    normal = np.cross(b - a, c - a)
    normal *= np.sign(normal @ (q - p)) / np.linalg.norm(normal)
    right = unit(q - p - (q - p) @ normal * normal)
    view = View(p, normal, right, 20, 350, (90, 350))
    parts = [text(24, 30, "theta: the smallest angle of edge and triangle", size=15)]
    parts += umbrella(s, view)
    parts += [fill(view.page([a, b, c]), ORANGE, 1, "#8a5410", 1.6)]
    turn = np.linspace(0, theta, 30)[:, None]
    arc = p + 0.3 * (np.cos(turn) * right + np.sin(turn) * normal)
    foot = view.page([p, p + 0.42 * right])
    parts += [
        stroke(foot, INK, 1.2, extra='stroke-dasharray="5 4"'),
        stroke(view.page(arc), RED, 2),
    ]
    ends = view.page([p, q, r])
    parts += [stroke(ends[[0, 2]], BLUE, 3), stroke(ends[[0, 1]], RED, 3)]
    parts += [dot(x, INK, 5) for x in ends]
    tip = view.page(arc[15])
    return [
        *parts,
        text(tip[0] + 8, tip[1], f"theta = {math.degrees(theta):.0f}°", RED),
        *names(ends),
        text(ends[2][0] + 4, ends[2][1] + 26, f"{math.degrees(angles(s, along)[0]):.0f}°", BLUE),
    ]


def names(ends) -> list[str]:
    return [
        text(x - 10, y - 9, name, INK, "end", 17) for (x, y), name in zip(ends, "pqr", strict=True)
    ]


def rho_panel(s: Sampled, across: int, along: int) -> list[str]:
    p = s.points[s.row]
    _, rho, _, radii = angles(s, across)
    view = View(p, s.poles[s.row], [0.0, 0.0, 1.0], 90, 350, (560, 180))
    largest = s.points[s.umbrella(s.row)[int(np.argmax(radii))]]
    parts = [text(420, 30, "rho: its length over the", size=15)]
    parts += [text(420, 50, "largest circumradius R", size=15)]
    parts += umbrella(s, view)
    centre, circle = circumcircle(largest)
    parts += [fill(view.page(largest), ORANGE, 1, "#8a5410", 1.6)]
    parts += [stroke(view.page(circle), INK, 1.4, extra='stroke-dasharray="5 4"')]
    parts += [stroke(view.page([centre, circle[0]]), INK, 2), dot(view.page(p), INK, 5)]
    at = view.page(centre)
    parts += [text(at[0] + 4, at[1] - 5, "R")]
    size = radii.max() * 350
    for y, colour, other, name in ((330, RED, across, "pq"), (380, BLUE, along, "pr")):
        _, rho, _, _ = angles(s, other)
        parts += [stroke([(420, y), (420 + rho * size, y)], colour, 4)]
        marks = [(420 + i * size, y) for i in range(math.floor(rho) + 1)]
        parts += [stroke([(x, y - 6), (x, y + 6)], INK, 1.2) for x, y in marks]
        parts += [text(420, y - 12, f"|{name}| = {rho:.1f} R", colour)]
    return parts


def circumcircle(triangle):
    """Its centre, and points round it."""
    a, b, c = triangle
    u = unit(b - a)
    v = unit((c - a) - (c - a) @ u * u)
    x = np.linalg.norm(b - a) / 2
    cu, cv = (c - a) @ u, (c - a) @ v
    y = (cu**2 + cv**2 - 2 * x * cu) / (2 * cv)
    turn = np.linspace(0, 2 * math.pi, 60)[:, None]
    centre = a + x * u + y * v
    return centre, centre + math.hypot(x, y) * (np.cos(turn) * u + np.sin(turn) * v)


# --- peeling


def peeling() -> str:
    points = bent(SHAPES["ellipsoid"].sample(700, 0))
    cells, neighbors, _ = medial.delaunay(points)
    cocone = medial.TightCocone(points)
    _, _, candidates = medial.cocone(points)
    depth = depths(cells, neighbors, cocone.cell_side)
    cut = {i: polygon for i in range(len(cells)) if len(polygon := section(points, cells[i])) > 2}
    deepest = max(depth[i] for i in cut)
    parts = [text(24, 30, "Before: Delaunay cells fill the", size=15)]
    parts += [text(24, 50, "convex hull of the samples", size=15)]
    parts += [text(400, 30, "After: cells outside are taken", size=15)]
    parts += [text(400, 50, "away, from the hull inwards", size=15)]
    for polygon in cut.values():
        parts.append(fill(on_cut(polygon, 190), "#f4f6f8", 1, PALE, 0.7))
    parts += lines(points, candidates, 190, INK, 2.2)
    for i, polygon in cut.items():
        parts.append(fill(on_cut(polygon, 570), shade(depth[i] / deepest), 1, "#ffffff", 0.5))
    parts += lines(points, cocone.triangles, 570, RED, 2.2)
    legend = [
        (INK, "triangles that Cocone takes for the surface"),
        (BLUE, "cells outside, taken away; darker: more cells away from the hull"),
        (ORANGE, "cells that are never taken away: the solid"),
        (RED, "its boundary, the watertight surface"),
    ]
    return picture(
        "Tight Cocone's peeling, cut through the middle of a bent ellipsoid", 500, parts, legend
    )


def bent(points):
    """An ellipsoid bent round the y axis, so that it has a hollow."""
    x, y, z = points.T
    turn = 1.9 * x / np.abs(x).max()
    out = 0.75 + 0.75 * z
    return np.column_stack((out * np.sin(turn), 0.75 * y, -out * np.cos(turn)))


def depths(cells, neighbors, side):
    """How many cells away from the infinite ones a cell outside is, through cells outside; -1 inside."""
    found = np.where((cells < 0).any(axis=1), 0, -1)
    outside = side == int(medial.Side.OUTER)
    layer = np.flatnonzero(found == 0)
    while len(layer):
        near = np.unique(neighbors[layer])
        layer_depth = found[layer[0]] + 1
        layer = near[outside[near] & (found[near] < 0)]
        found[layer] = layer_depth
    return found


def shade(depth: float) -> str:
    """The colour of an outer cell by its depth as a share of the largest depth; below zero, that of an inner cell."""
    if depth < 0:
        return "#f0b869"
    low, high = np.array([222, 235, 247]), np.array([24, 76, 128])
    mixed = low + depth * (high - low)
    return "#{:02x}{:02x}{:02x}".format(*mixed.astype(int))


def section(points, simplex):
    """Where the plane y = 0 cuts a tetrahedron: (k, 2) of x and z, in their order round it."""
    if (simplex < 0).any():
        return np.empty((0, 2))
    corners = points[simplex]
    cut = crossings(corners, [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])
    arms = cut - cut.mean(axis=0) if len(cut) else cut
    return cut[np.argsort(np.arctan2(arms[:, 1], arms[:, 0]))]


def crossings(corners, pairs):
    ends = [corners[list(pair)] for pair in pairs]
    ends = [(a, b) for a, b in ends if (a[1] < 0) != (b[1] < 0)]
    found = [a + a[1] / (a[1] - b[1]) * (b - a) for a, b in ends]
    return np.array(found).reshape(-1, 3)[:, [0, 2]]


def lines(points, triangles, middle: float, colour: str, width: float) -> list[str]:
    """Strokes along the cuts of the triangles with the plane y = 0."""
    found = [crossings(points[t], [(0, 1), (1, 2), (0, 2)]) for t in triangles]
    return [stroke(on_cut(cut, middle), colour, width) for cut in found if len(cut) == 2]


def on_cut(points, middle: float):
    return np.asarray(points) * (165, -165) + (middle, 195)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = Path(__file__).resolve().parents[2] / "docs" / "pictures"
    parser.add_argument("--output", type=Path, default=default)
    output = parser.parse_args().output
    for name, draw in (("cell", cell), ("theta_rho", edge_numbers), ("peeling", peeling)):
        (output / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
