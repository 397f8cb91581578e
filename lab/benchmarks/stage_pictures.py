# SPDX-License-Identifier: GPL-3.0-or-later
"""The drawings of the stages of the collapse for docs/lab/hierarchy_theory.md, and of crisp places, as SVG.

    python3 lab/benchmarks/stage_pictures.py [--output docs/pictures]

Fringe: a solid of the plane, where all is a dimension lower: Voronoi edges in the place of facets. Fire and wires: the
flat sheet of a slab, seen from above, and its curve. Crisp: the ends of the sheets of a box.
"""

import argparse
import math
from pathlib import Path

import _module
import numpy as np
from _drawing import INK, ORANGE, PALE, RED, WIDTH, path, picture, stroke
from scipy.spatial import Voronoi

medial = _module.load()

from support import crisp_solids  # noqa: E402
from support.shapes import SHAPES  # noqa: E402

SCALE = 330.0


def on_page(points, middle=200.0):
    """(n, 2) of the shape to the page, y upwards."""
    return np.asarray(points)[..., :2] * (SCALE, -SCALE) + (WIDTH / 2, middle)


# --- stage 1


def outline(count: int):
    """Samples of a rounded bar, a little noisy."""
    t = 2 * math.pi * np.arange(count) / count
    size = 0.36 + 0.16 * np.cos(2 * t) ** 2 + 0.03 * np.cos(3 * t + 1)
    points = np.column_stack(
        (1.75 * size * np.cos(t), size * np.sin(t) * (0.55 + 0.5 * np.cos(t) ** 2))
    )
    return points + np.random.default_rng(4).normal(scale=0.006, size=points.shape)


def inside(points, polygon):
    """Whether points are inside, by the crossings of a ray."""
    a, b = polygon, np.roll(polygon, -1, axis=0)
    x, y = points[:, :1], points[:, 1:]
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return np.sum(crosses & (x < at), axis=1) % 2 == 1


def peeled(ends, weight):
    """Edges that the collapse leaves: those below 1 go through their free ends, the least first."""
    left = set(range(len(ends)))
    at = np.bincount(np.ravel(ends))
    while True:
        free = [e for e in left if weight[e] <= 1 and at[list(ends[e])].min() == 1]
        if not free:
            return left
        e = min(free, key=lambda e: (weight[e], e))
        left.remove(e)
        at[list(ends[e])] -= 1


def fringe() -> str:
    samples = outline(74)
    diagram = Voronoi(samples)
    within = inside(diagram.vertices, samples)
    rows = [
        (pq, ends)
        for pq, ends in zip(diagram.ridge_points, diagram.ridge_vertices, strict=True)
        if min(ends) >= 0 and within[ends].all()
    ]
    ends = [tuple(e) for _, e in rows]
    apart = np.array([min(abs(p - q), len(samples) - abs(p - q)) for (p, q), _ in rows])
    weight = apart / 6.0  # how far round the outline the samples of an edge lie apart
    middle = diagram.vertices[np.array(ends)].mean(axis=1)
    weight[np.argmin(np.hypot(middle[:, 0] - 0.05, middle[:, 1]))] = 0.9  # one that is not selected
    left = peeled(ends, weight)
    page = on_page(diagram.vertices, 150.0)
    parts = [stroke(on_page(samples, 150.0), "#8a97a4", 1.5, closed=True)]
    for e, pair in enumerate(ends):
        colour = PALE if e not in left else RED if weight[e] > 1 else ORANGE
        parts.append(stroke(page[list(pair)], colour, 1.6 if e not in left else 4))
    for x, y in on_page(samples, 150.0):
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.4" fill="{INK}"/>')
    legend = [
        (PALE, "not selected: each goes through an end that no other edge has"),
        (RED, "selected by MEDIAL: untouched"),
        (ORANGE, "not selected, but never free: it stays, as a bridge"),
    ]
    return picture("Stage 1: the fringe", 380, parts, legend)


# --- stages 2 and 3


def slab(count: int):
    shape = SHAPES["slab"]
    points = np.round(shape.sample(count, 0), 10)  # processors differ in the last bits of sines
    hierarchy = medial.MedialAnalysis(points, normals=shape.normals(points)).hierarchy()
    return shape, hierarchy


def shade(share: float) -> str:
    """From pale yellow, which burns first, to dark red."""
    low, high = np.array([255, 243, 205]), np.array([146, 28, 22])
    return "#{:02x}{:02x}{:02x}".format(*(low + share * (high - low)).astype(int))


def fire() -> str:
    _, hierarchy = slab(800)
    level = hierarchy.extract(spacings=1.0, relaxed=True)
    page = on_page(level.vertices, 250.0)
    polygons = np.split(level.face_vertices, level.face_offsets[1:-1])
    thickest = level.erosion.max()
    parts = []
    for polygon, value in zip(polygons, level.erosion, strict=True):
        parts.append(
            f'<path d="{path(page[polygon], True)}" fill="{shade(value / thickest)}" '
            f'stroke="#ffffff" stroke-width="0.4"/>'
        )
    legend = [
        (shade(0.0), "the rim: the fire starts here, after a time that is the radius of the ball"),
        (shade(0.5), "erosion thickness: how much later the fire comes than that radius"),
        (shade(1.0), "the last facets; behind them wires are left"),
    ]
    return picture("Stage 2: the fire", 590, parts, legend)


def wires() -> str:
    shape, hierarchy = slab(1500)
    x, y = shape.width, shape.depth
    corners = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
    every = hierarchy.extract(sheet=math.inf, limb=0.01, relaxed=True)
    parts = [stroke(on_page(corners, 250.0), "#8a97a4", 1.5, closed=True)]
    page = on_page(every.vertices, 250.0)
    for colour, width, chosen in ((PALE, 2, every.limb <= 0.04), (RED, 4, every.limb > 0.04)):
        lines = "".join(path(page[ends]) for ends in every.wires[chosen])
        parts.append(f'<path d="{lines}" fill="none" stroke="{colour}" stroke-width="{width}"/>')
    core = hierarchy.extract(sheet=math.inf, limb=math.inf).vertices
    for cx, cy in on_page(core, 250.0):
        parts.append(f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="6" fill="{INK}"/>')
    legend = [
        (PALE, "short limbs, below the threshold of 4 % of the diagonal"),
        (RED, "limbs above it: each has one value from its tip to where it ends at a longer one"),
        (INK, "what is left at the end: one point, for a slab has no loop"),
    ]
    return picture("Stage 3: the wires", 590, parts, legend)


# --- crisp places

# Where the axes of the solid point on the page, in pixels.
OBLIQUE = np.array([(105.0, 42.0), (88.0, -50.0), (0.0, -130.0)])


def ends_of_sheets(crisp: bool, middle: tuple[float, float]) -> list[str]:
    """The edges of a box, the seams of its axis, and the rims."""
    import medial_axis
    from medial_axis.core.axis.structure import RIM, SEAM

    points, triangles = crisp_solids.solid("box").mesh
    found = medial_axis.compute(points, triangles, sampling="surface", samples=600, crisp=crisp)
    axis, structure = found.axis, found.axis.structure
    low, high = points.min(axis=0), points.max(axis=0)
    centre, size = (low + high) / 2, high - low
    page = lambda places: (np.asarray(places) - centre) @ OBLIQUE + middle
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    near = [(a, b) for a in range(8) for b in range(a) if abs(corners[a] - corners[b]).sum() == 1]
    parts = []
    for ends, colour, width in (
        ([low + corners[list(pair)] * size for pair in near], PALE, 5),
        (axis.vertices[structure.facet_edges[structure.seam == SEAM]], INK, 1.5),
        (axis.vertices[structure.facet_edges[structure.seam >= RIM]], RED, 1.5),
    ):
        lines = "".join(path(page(segment)) for segment in ends)
        parts.append(
            f'<path d="{lines}" fill="none" stroke="{colour}" stroke-width="{width}" '
            'stroke-linecap="round"/>'
        )
    return parts


def crisp() -> str:
    parts = [*ends_of_sheets(False, (190.0, 160.0)), *ends_of_sheets(True, (570.0, 160.0))]
    legend = [
        (PALE, "the edges of a box"),
        (
            INK,
            "seams of its axis: left where balls end at the samples, right where they end at the faces",
        ),
        (RED, "where the sheets end: left half a spacing before the edges, right on them"),
    ]
    return picture("Crisp places", 400, parts, legend)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = Path(__file__).resolve().parents[2] / "docs" / "pictures"
    parser.add_argument("--output", type=Path, default=default)
    output = parser.parse_args().output
    drawings = {"fringe": fringe, "fire": fire, "wires": wires, "crisp": crisp}
    for name, draw in drawings.items():
        (output / f"stage_{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
