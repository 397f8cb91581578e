# SPDX-License-Identifier: GPL-3.0-or-later
"""The drawings of the stage pages, as SVG: samples, Delaunay and Voronoi, inside and outside, the selection,
labels of poles.

    python3 lab/benchmarks/section_pictures.py [--output docs/pictures]

Samples are the module's; so are winding numbers and selected facets, of which a plane cuts a section. Only Delaunay
and Voronoi are drawn in the plane, where a cell is a triangle and a facet an edge.
"""

import argparse
import math
from pathlib import Path

import _module
import numpy as np
from _drawing import INK, ORANGE, PALE, RED, picture, stroke
from algorithm_pictures import BLUE, GREEN, bent, crossings, dot, fill, text
from scipy.spatial import Delaunay, Voronoi
from stage_pictures import inside, outline

medial = _module.study()

from support.shapes import SHAPES  # noqa: E402

# --- samples of a surface


def sampling() -> str:
    corners = np.array([(x, y, z) for x in (0, 1.5) for y in (0, 1.0) for z in (0, 0.8)])
    samples = medial.sample_surface(corners, box_triangles(), count=900)
    parts = [text(24, 30, "The mesh: a box of eight vertices", size=15)]
    parts += faces(corners, 185) + [dot(p, INK, 4) for p in isometric(visible(corners), 185)]
    parts += [text(400, 30, "What is analysed: its samples", size=15), *faces(corners, 575)]
    kinds = kinds_of(samples)
    shown = seen(samples.points)
    for colour, size, chosen in ((BLUE, 2.6, 2), (ORANGE, 2.6, 1), (RED, 3.2, 0)):
        places = isometric(samples.points[shown & (kinds == chosen)], 575)
        parts += [dot(p, colour, size) for p in places]
    legend = [
        (RED, "on sharp edges and at corners, at even steps; these come first"),
        (ORANGE, "rows beside an edge, at the same places on both faces"),
        (BLUE, "blue noise: at random, but no two too close, and no hole too large"),
    ]
    return picture("Samples of a box", 420, parts, legend)


def box_triangles():
    """The outward triangles of a box whose corners are sorted by x, y, z."""
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype=np.int32)


def kinds_of(samples):
    """0 on edges and corners, 1 in the rows beside them, 2 elsewhere.

    All samples of a row are equally far from an edge; no two samples of blue noise are.
    """
    walls = np.concatenate((samples.points, (1.5, 1.0, 0.8) - samples.points), axis=1)
    away = np.sort(np.abs(walls), axis=1)[:, 1].round(6)
    values, counts = np.unique(away, return_counts=True)
    rows = np.isin(away, values[counts > 20])
    sharp = samples.kind <= int(medial.SampleKind.SHARP)
    return np.where(sharp, 0, np.where(rows, 1, 2))


def seen(points):
    """On the three faces of the box that look at the eye."""
    near = 1e-9 * np.abs(points).max()
    return (points[:, 0] > 1.5 - near) | (points[:, 1] < near) | (points[:, 2] > 0.8 - near)


def visible(corners):
    return corners[seen(corners)]


def isometric(points, middle: float):
    """The box from the front, the right and above."""
    x, y, z = np.asarray(points, dtype=float).T - np.array([[0.75], [0.5], [0.4]])
    c, s = math.cos(math.radians(35)), math.sin(math.radians(35))
    right, deep = c * x + s * y, -s * x + c * y
    up = math.cos(math.radians(28)) * z + math.sin(math.radians(28)) * deep
    return np.column_stack((middle + 190 * right, 185 - 190 * up))


def faces(corners, middle: float) -> list[str]:
    quads = [(4, 6, 7, 5), (0, 4, 5, 1), (1, 5, 7, 3)]
    return [fill(isometric(corners[list(q)], middle), "#eef1f4", 1, "#8a97a4", 1.2) for q in quads]


# --- Delaunay and Voronoi, in the plane


def delaunay() -> str:
    points = outline(44)
    found = Delaunay(points)
    centres = np.array([circumcentre(*points[t]) for t in found.simplices])
    within = inside(centres, points)
    page = plane(points, 190)
    parts = [text(24, 30, "Delaunay: triangles whose", size=15)]
    parts += [text(24, 50, "circles hold no sample", size=15)]
    parts += [fill(page[t], "#f4f6f8", 1, PALE, 0.9) for t in found.simplices]
    chosen = int(np.argmax(within * radii(points, found, centres)))
    parts += [fill(page[found.simplices[chosen]], ORANGE, 0.8, "#8a5410", 1.4)]
    cx, cy = plane(centres[chosen], 190)
    size = radii(points, found, centres)[chosen] * 185
    parts += [f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="{size:.1f}" fill="none" stroke="{RED}" '
              'stroke-width="2"/>', dot((cx, cy), RED, 4.5)]  # fmt: skip
    parts += [dot(p, INK, 2.6) for p in page]
    parts += [text(400, 30, "Voronoi: the centres, joined", size=15)]
    parts += [text(400, 50, "where triangles meet", size=15)]
    parts += voronoi(found, centres, within) + [dot(p, INK, 2.6) for p in plane(points, 570)]
    legend = [
        (RED, "an empty circle and its centre: a Voronoi vertex, with the circle's radius"),
        (PALE, "Voronoi facets across the surface, between neighbours"),
        (BLUE, "Voronoi facets inside, between opposite walls: candidates for the medial axis"),
    ]
    return picture("Delaunay triangles and Voronoi facets, in the plane", 390, parts, legend)


def plane(points, middle: float):
    return np.asarray(points) * (185, -185) + (middle, 190)


def circumcentre(a, b, c):
    rows = 2 * np.array([b - a, c - a])
    return np.linalg.solve(rows, [b @ b - a @ a, c @ c - a @ a])


def radii(points, found, centres):
    return np.linalg.norm(points[found.simplices[:, 0]] - centres, axis=1)


def voronoi(found, centres, within) -> list[str]:
    """Voronoi edges, in blue if both ends are inside; the picture's frame clips them."""
    drawn = {False: [], True: []}
    for t, others in enumerate(found.neighbors):
        for corner, other in enumerate(others):
            if other > t:
                ends = centres[[t, other]]
            elif other < 0:
                ends = ray(found, centres[t], np.delete(found.simplices[t], corner))
            else:
                continue
            kept = clipped(*ends, (0.96, 0.62))
            if kept is not None:
                drawn[bool(other >= 0 and within[t] and within[other])].append(kept)
    pale = [stroke(plane(ends, 570), PALE, 1.3) for ends in drawn[False]]
    return pale + [stroke(plane(ends, 570), BLUE, 3) for ends in drawn[True]]


def ray(found, start, edge):
    """The Voronoi edge dual to an edge of the hull, as a long segment."""
    a, b = found.points[edge]
    out = np.array([b[1] - a[1], a[0] - b[0]])
    out *= np.sign(out @ (a + b - 2 * found.points.mean(axis=0))) / np.linalg.norm(out)
    return start, start + 100 * out


def clipped(a, b, half):
    """The part of a segment in a frame round the origin; None where there is none."""
    low, high = 0.0, 1.0
    for start, along, end in zip(a, b - a, half, strict=True):
        if abs(along) < 1e-12:
            along = 1e-12
        near, far = sorted(((-end - start) / along, (end - start) / along))
        low, high = max(low, near), min(high, far)
    return None if low >= high else np.array([a + low * (b - a), a + high * (b - a)])


# --- inside and outside


COLUMNS, ROWS, STEP = 190, 80, 4.0  # of squares, and pixels of each


def sides() -> str:
    vertices, triangles = open_ball()
    left, top = np.arange(COLUMNS) * STEP, 20 + np.arange(ROWS) * STEP
    x, z = (left + STEP / 2 - 330) / 140, (190 - top - STEP / 2) / 140
    grid = np.array([(a, 0.0, b) for b in z for a in x])
    winding = medial.winding_number(grid, vertices, triangles).reshape(ROWS, COLUMNS)
    parts = [run for y, values in zip(top, winding, strict=True) for run in runs(left, y, values)]
    parts += [stroke(section_page(line), RED, 3) for line in level(winding, x, z)]
    cuts = [crossings(vertices[t], [(0, 1), (1, 2), (0, 2)]) for t in triangles]
    parts += [stroke(section_page(cut), INK, 4) for cut in cuts if len(cut) == 2]
    parts += [
        text(310, 205, "about 1: inside", INK, "middle"),
        text(640, 300, "about 0: outside", INK, "middle"),
        text(446, 128, "1/2: the lid", RED),
    ]
    legend = [
        (INK, "the faces, cut through: a ball that is open on one side"),
        (RED, "where the winding number is 1/2: the open side gets a lid, from rim to rim"),
        (shade(1.0), "how large the winding number is: the darker, the nearer to 1"),
    ]
    return picture("Winding number of an open ball", 420, parts, legend)


def runs(left, y: float, values) -> list[str]:
    """Squares of one row, those of one colour in one piece; white ones are not drawn."""
    colours = np.array([shade(value) for value in values])
    starts = np.flatnonzero(np.append(True, colours[1:] != colours[:-1]))
    ends = np.append(starts[1:], len(colours))
    return [
        f'<path d="M{left[a]:.0f},{y:.0f}h{(b - a) * STEP:.0f}v{STEP:.0f}h{(a - b) * STEP:.0f}Z" '
        f'fill="{colours[a]}" shape-rendering="crispEdges"/>'
        for a, b in zip(starts, ends, strict=True)
        if colours[a] != shade(0.0)
    ]


def open_ball():
    """A ball of triangles without those that look to the right and up."""
    u = np.linspace(0, math.pi, 19)[1:-1]
    v = np.linspace(0, 2 * math.pi, 36, endpoint=False) + 0.03
    rings = [
        (math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)) for a in u for b in v
    ]
    points = np.array([(0, 0, 1), *rings, (0, 0, -1)], dtype=float)
    found = [(0, 1 + j, 1 + (j + 1) % 36) for j in range(36)]
    for i in range(len(u) - 1):
        for j in range(36):
            a, b = 1 + 36 * i + j, 1 + 36 * i + (j + 1) % 36
            found += [(a, a + 36, b), (b, a + 36, b + 36)]
    last = len(points) - 1
    found += [(last, last - 36 + (j + 1) % 36, last - 36 + j) for j in range(36)]
    triangles = np.array(found, dtype=np.int32)
    looks = points[triangles].mean(axis=1) @ (math.cos(0.5), 0, math.sin(0.5))
    return points, triangles[looks < 0.72]


def section_page(points):
    return np.asarray(points) * (140, -140) + (330, 190)


def shade(value: float) -> str:
    share = min(max(value, 0.0), 1.0)
    low, high = np.array([255, 255, 255]), np.array([122, 171, 214])
    return "#{:02x}{:02x}{:02x}".format(*(low + round(share * 20) / 20 * (high - low)).astype(int))


def level(values, x, z) -> list:
    """Segments of the level 1/2 in the squares between the middles of a grid."""
    found = []
    for row in range(len(z) - 1):
        for column in range(len(x) - 1):
            at = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
            ends = [edge_level(values, x, z, at[i], at[(i + 1) % 4]) for i in range(4)]
            ends = [end for end in ends if end is not None]
            if len(ends) == 2 and np.linalg.norm(np.mean(ends, axis=0)) < 0.96:
                found.append(np.array(ends))
    return found


def edge_level(values, x, z, one, other):
    a, b = values[one] - 0.5, values[other] - 0.5
    if (a < 0) == (b < 0):
        return None
    t = a / (a - b)
    return (x[one[1]] + t * (x[other[1]] - x[one[1]]), z[one[0]] + t * (z[other[0]] - z[one[0]]))


# --- the selection


def selection() -> str:
    points = bent(SHAPES["ellipsoid"].sample(1200, 0))
    source = medial.SidesFrom.TIGHT_COCONE
    analysis = medial.MedialAnalysis(points, sides=source, bounding_sphere=True)
    cuts = [crossings(points[t], [(0, 1), (1, 2), (0, 2)]) for t in analysis.tight_cocone.triangles]
    parts = [text(24, 30, "Voronoi facets", size=15)]
    parts += [stroke(cut_page(cut, 190), "#9fb6cc", 1.1) for cut in sections(every_facet(points))]
    parts += [text(400, 30, "Those that are selected", size=15)]
    for side, colour in ((medial.Side.OUTER, GREEN), (medial.Side.INNER, RED)):
        chosen = facets(analysis.extract(side=side))
        parts += [stroke(cut_page(cut, 570), colour, 2.8) for cut in sections(chosen)]
    for middle in (190, 570):
        parts += [stroke(cut_page(cut, middle), INK, 2.4) for cut in cuts if len(cut) == 2]
    legend = [
        (INK, "the surface, cut through"),
        (
            "#9fb6cc",
            "all Voronoi facets: most of them stand across the surface, between neighbours",
        ),
        (RED, "selected, theta above 22.5° or rho above 8, and inside: the inner medial axis"),
        (GREEN, "selected and outside: the outer medial axis"),
    ]
    return picture(
        "The Voronoi facets of a bent ellipsoid, and those that are selected", 430, parts, legend
    )


def every_facet(points):
    """Polygons of all Voronoi facets; those at infinity are bounded by far corners."""
    far = 50.0 * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    diagram = Voronoi(np.concatenate((points, far)))
    for ends in diagram.ridge_vertices:
        if min(ends) >= 0:
            yield diagram.vertices[ends]


def facets(mesh):
    """Polygons of a medial mesh."""
    for a, b in zip(mesh.face_offsets[:-1], mesh.face_offsets[1:], strict=True):
        yield mesh.vertices[mesh.face_vertices[a:b]]


def sections(polygons):
    """The cuts of polygons with the plane y = 0, clipped to the frame."""
    for corners in polygons:
        cut = crossings(corners, [(i, (i + 1) % len(corners)) for i in range(len(corners))])
        kept = clipped(*(cut - (0, CENTRE)), (1.05, 0.82)) if len(cut) == 2 else None
        if kept is not None:
            yield np.add(kept, (0, CENTRE))


CENTRE = -0.45  # of the frame, in z


def cut_page(points, middle: float):
    return (np.asarray(points) - (0, CENTRE)) * (165, -165) + (middle, 180)


# --- labels of poles


def labels() -> str:
    points = SHAPES["shell"].sample(6000, 0)
    parts = []
    kinds = ((medial.SidesFrom.TIGHT_COCONE, "Tight Cocone"), (medial.SidesFrom.POLES, "Labels"))
    for middle, (kind, name) in zip((200, 560), kinds, strict=True):
        analysis = medial.MedialAnalysis(points, sides=kind)
        parts.append(text(middle, 30, name, INK, "middle", size=15))
        for side, colour in ((medial.Side.OUTER, BLUE), (medial.Side.INNER, RED)):
            found = slab(medial.pole_axis(analysis, side).vertices, 0.08)
            parts += [dot(p, colour, 2.6) for p in shell_page(found, middle)]
        parts += [dot(p, INK, 1.6) for p in shell_page(slab(points, 0.03), middle)]
    legend = [
        (INK, "samples near the section of a thin shell with a cavity"),
        (RED, "poles inside: by Tight Cocone the cavity's are among them"),
        (
            BLUE,
            "poles outside: the labels find those of the cavity, which no walk from outside reaches",
        ),
    ]
    return picture("Sides of the poles of a shell", 420, parts, legend)


def slab(points, width: float):
    """The points near the plane y = 0 and not far from the shell."""
    points = np.asarray(points)
    near = np.abs(points[:, 1]) < width
    return points[near & (np.abs(points[:, 0]) < 1.15) & (np.abs(points[:, 2]) < 0.85)][:, [0, 2]]


def shell_page(points, middle: float):
    return points * (145, -145) + (middle, 185)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = Path(__file__).resolve().parents[2] / "docs" / "pictures"
    parser.add_argument("--output", type=Path, default=default)
    output = parser.parse_args().output
    drawings = (
        ("sampling", sampling),
        ("delaunay", delaunay),
        ("inside", sides),
        ("selection", selection),
        ("labels", labels),
    )
    for name, draw in drawings:
        (output / f"stage_{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
