# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of a computed axis of a solid whose faces are known exactly: where it is, what it misses, how it is made.

Lengths are shares of the solid's diagonal, the gap is in spacings of a hexagonal lattice of as many samples.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import distance, topology
from .crisp_solids import Solid
from .crossing_triangles import crossing_pairs
from .folds import Rings
from .levels import betti_of_mesh
from .measure import following

Array = NDArray[np.float64]
Ints = NDArray[np.integer]

BALLS = 20_000


@dataclass(frozen=True, eq=False)
class Output:
    """An axis in the frame of its solid.

    Parameters
    ----------
    vertices : (v, 3)
    radius : (v,)
    face_offsets, face_vertices
        Polygons, as in `MedialAxis`.
    wires : (w, 2)
        Edges without a polygon.
    triangles : (m, 3)
        The polygons cut, as they are shown and written.
    across : (f, 3)
        The direction about which each polygon turns counter-clockwise: from its one sample to its other one.
    """

    vertices: Array
    radius: Array
    face_offsets: Ints
    face_vertices: Ints
    wires: Ints
    triangles: Ints
    across: Array

    @property
    def generators(self) -> Array:
        """As many rows as polygons, for the counter of Betti numbers."""
        return self.across

    def cells(self) -> Array:
        """(k, 3, 3) triangles, wires and single vertices as triangles of two and of one corner."""
        lone = np.ones(len(self.vertices), bool)
        lone[self.face_vertices] = lone[self.wires] = False
        lone = np.flatnonzero(lone)
        rows = np.concatenate(
            (self.triangles, self.wires[:, [0, 1, 1]], np.column_stack((lone, lone, lone)))
        )
        return self.vertices[rows]

    def rings(self) -> Rings:
        return Rings(self.vertices, self.face_offsets, self.face_vertices, self.across)


@dataclass(frozen=True)
class Spread:
    mean: float
    p99: float
    most: float

    @staticmethod
    def of(values: Array) -> "Spread":
        if len(values) == 0:
            return Spread(0.0, 0.0, 0.0)
        return Spread(float(values.mean()), float(np.quantile(values, 0.99)), float(values.max()))


@dataclass(frozen=True)
class Found:
    """The measures; docs/lab/crisp.md says what each is."""

    samples: int
    facets: int
    vertices: int
    err: Spread
    ball: Spread  # |r - d|
    cov: Spread
    gap: Spread | None  # in spacings; None without edges
    rim: float  # of the exact length
    area: float | None  # of the exact area, less 1
    folds: int
    dents: int  # facets with a concave corner that are no folds
    lines: int  # facets without area
    crossings: int
    betti: tuple[int, int]  # components and Euler characteristic


def measured(solid: Solid, output: Output, samples: int) -> Found:
    size, cells = solid.diagonal, output.cells()
    area, rings = topology.area(output.vertices, output.triangles), output.rings()
    return Found(
        samples=samples,
        facets=len(output.across),
        vertices=len(output.vertices),
        err=Spread.of(off_axis(solid, output.vertices) / size),
        ball=Spread.of(np.abs(output.radius - solid.distance(output.vertices)) / size),
        cov=Spread.of(distance.to_triangles(solid.centres(BALLS), cells) / size),
        gap=gap(solid, cells, solid.spacing(samples)),
        rim=rim_length(output) / solid.rim,
        area=None if solid.area is None else area / solid.area - 1.0,
        folds=int(rings.folded().sum()),
        dents=int(rings.dented().sum()),
        lines=int(rings.lines().sum()),
        crossings=len(crossing_pairs(output.vertices, output.triangles)),
        betti=betti_of_mesh(output),
    )


def off_axis(solid: Solid, x: Array) -> Array:
    """(n,) Straight edges are known, where rounded places a little beyond them have no nearest face."""
    off = solid.off_axis(x)
    if len(solid.straight_edges) == 0:
        return off
    return np.minimum(off, distance.to_triangles(x, solid.straight_edges))


def gap(solid: Solid, cells: Array, spacing: float) -> Spread | None:
    """Distances of convex edges and corners to the output, in spacings."""
    if len(solid.edges) == 0:
        return None
    return Spread.of(distance.to_triangles(solid.edges, cells) / spacing)


def rim_edges(output: Output) -> Ints:
    """(r, 2) edges of exactly one polygon."""
    corners = output.face_vertices
    pairs = np.sort(np.column_stack((corners, corners[following(output)])), axis=1)
    edges, uses = np.unique(pairs, axis=0, return_counts=True)
    return edges[uses == 1]


def rim_length(output: Output) -> float:
    a, b = output.vertices[rim_edges(output)].transpose(1, 0, 2)
    return float(np.linalg.norm(b - a, axis=1).sum())


def rim_turns(output: Output) -> Array:
    """Degrees by which the rim turns at each vertex with two of its edges, where these have a length."""
    edges = rim_edges(output)
    ends = np.concatenate((edges, edges[:, ::-1]))
    ends = ends[np.lexsort(ends.T[::-1])]
    inner = np.flatnonzero(np.bincount(ends[:, 0], minlength=len(output.vertices)) == 2)
    first = np.searchsorted(ends[:, 0], inner)
    ways = output.vertices[ends[np.column_stack((first, first + 1)), 1]]
    ways = ways - output.vertices[inner][:, None]
    length = np.linalg.norm(ways, axis=2)
    ways = ways[length.min(axis=1) > 1e-9 * np.linalg.norm(np.ptp(output.vertices, axis=0))]
    cosine = -np.einsum("vi,vi->v", *ways.transpose(1, 0, 2)) / np.linalg.norm(ways, axis=2).prod(1)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))


def output_of(computation: Any, frame: Array, exact: bool = False) -> Output:
    """The axis of a `Computation`, back in the frame of the solid; if `exact`, at the places of the Voronoi diagram."""
    from medial_axis.core.axis.polygon_triangles import polygon_triangles

    axis, points = computation.axis, computation.chosen.samples.points
    places, radius = (
        (axis.level.exact, axis.level.exact_radius) if exact else (axis.vertices, axis.radius)
    )
    across = np.diff(points[axis.generators], axis=1)[:, 0] @ frame
    vertices = places @ frame
    return Output(
        vertices=vertices,
        radius=radius,
        face_offsets=axis.face_offsets,
        face_vertices=axis.face_vertices,
        wires=axis.edges,
        triangles=polygon_triangles(vertices, axis.face_offsets, axis.face_vertices),
        across=across / np.linalg.norm(across, axis=1)[:, None],
    )
