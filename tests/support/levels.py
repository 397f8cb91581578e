# SPDX-License-Identifier: GPL-3.0-or-later
"""The levels of a hierarchy from its values alone: masks, closedness, Betti numbers by another count."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .measure import following

# Thresholds of sixteen levels, by every value and by several at once.
SIXTEEN = [
    *({"sheet": s, "limb": c} for s in (0.0, 0.003, 0.01, 0.03) for c in (0.0, 0.04)),
    *({"spacings": s} for s in (0.5, 1.0, 2.0)),
    *({name: 0.01} for name in ("erosion", "spike")),
    {"sheet": 0.01, "erosion": 0.01, "limb": 0.02},
    {"sheet": np.inf},
    {"sheet": np.inf, "limb": np.inf},
]


class Levels:
    """The complex of a hierarchy and its values as arrays; `analysis` gives the Delaunay edges."""

    def __init__(self, hierarchy, analysis):
        h = self.h = hierarchy
        self.facet_of_corner = np.repeat(np.arange(len(h.generators)), np.diff(h.facet_offsets))
        self.corner_edge, self.ends, self.generators = h.facet_edges, h.edges, h.generators
        self.samples = analysis.samples
        edges = analysis.edges.astype(np.int64)
        width = int(edges.max()) + 1
        inside = np.concatenate((self.generators, h.shrunk[:, :2])).astype(np.int64)
        dual = np.isin(edges @ [width, 1], inside @ [width, 1])
        self.elsewhere = edges[~dual]  # Delaunay edges whose facets are not in the complex
        self.hull = np.unique(analysis.edges[~analysis.bounded])
        self.values = {
            name: tuple(getattr(h, f"{kind}_{name}") for kind in ("facet", "edge", "vertex"))
            for name in ("sheet", "spacings", "erosion", "spike")
        }
        self.values["limb"] = (np.zeros(len(h.generators), np.float32), h.edge_limb, h.vertex_limb)

    def alive(self, sheet=0.0, spacings=0.0, erosion=0.0, spike=0.0, limb=0.04):
        """(facets, edges, vertices) bool: what a level consists of."""
        result = []
        for kind in range(3):
            here = np.ones(len(self.values["sheet"][kind]), bool)
            wanted = {"sheet": sheet, "spacings": spacings, "erosion": erosion, "spike": spike}
            for name, threshold in wanted.items():
                if name == "spike" and threshold == 0.0:
                    continue  # facets of thickness 0 are in the disc of thicker ones, or not
                value = self.values[name][kind]
                here &= (value > threshold) | np.isinf(value)
            result.append(here | (self.values["limb"][kind] > limb) if kind else here)
        return tuple(result)

    def is_closed(self, alive):
        """The faces of all that is there are there."""
        facets, edges, vertices = alive
        there = edges[self.corner_edge][facets[self.facet_of_corner]].all()
        return bool(there and vertices[self.ends[edges]].all())

    def betti(self, alive):
        """Components by scipy, cavities by Alexander duality, tunnels by Euler's formula."""
        facets, edges, vertices = alive
        pieces = parts(len(vertices), self.ends[edges], vertices)
        row = int(max(self.samples.max(), self.hull.max())) + 1
        p_q, edge, vertex = self.h.shrunk[:, :2], self.h.shrunk[:, 2], self.h.shrunk[:, 3]
        there = np.where(edge >= 0, edges[edge] if len(edges) else False, vertices[vertex])
        joined = [self.elsewhere, self.generators[~facets], p_q[~there]]
        joined.append(np.column_stack((self.hull, np.full(len(self.hull), row))))
        there = np.zeros(row + 1, bool)
        there[self.samples] = there[row] = True
        cavities = parts(row + 1, np.concatenate(joined), there) - 1
        euler = int(vertices.sum()) - int(edges.sum()) + int(facets.sum())
        return pieces, pieces + cavities - euler, cavities

    def wrong(self, thresholds=SIXTEEN):
        """The thresholds whose levels are not closed, or have other Betti numbers than the complex."""
        alive = [(chosen, self.alive(**chosen)) for chosen in thresholds]
        return [
            chosen
            for chosen, level in alive
            if not self.is_closed(level) or self.betti(level) != tuple(self.h.betti)
        ]

    def drawn(self, alive):
        """The drawn cells of a level, as ascending ids: its facets, its edges without a facet, and its vertices."""
        facets, edges, vertices = alive
        bare = edges.copy()
        bare[self.corner_edge[facets[self.facet_of_corner]]] = False
        return tuple(map(np.flatnonzero, (facets, bare, vertices)))


def parts(count, pairs, there):
    """Components of a graph that contain any of the vertices that are there."""
    p, q = np.asarray(pairs, np.int64).reshape(-1, 2).T
    graph = coo_array((np.ones(len(p)), (p, q)), shape=(count, count))
    labels = connected_components(graph, directed=False)[1]
    return len(np.unique(labels[there]))


def betti_of_mesh(level, wires=None):
    """(components, Euler characteristic) of a drawn level: vertices, edges of polygons and wires, polygons."""
    corners = level.face_vertices
    rims = np.column_stack((corners, corners[following(level)]))
    edges = np.concatenate((rims, level.wires if wires is None else wires))
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    assert (edges[:, 0] != edges[:, 1]).all()
    everything = np.ones(len(level.vertices), bool)
    pieces = parts(len(level.vertices), edges, everything) if len(level.vertices) else 0
    return pieces, len(level.vertices) - len(edges) + len(level.face_offsets) - 1


def tips(level, wires=None):
    """The number of ends of wires that nothing else reaches."""
    wires = level.wires if wires is None else wires
    degree = np.bincount(wires.ravel(), minlength=len(level.vertices))
    degree[level.face_vertices] = 0
    return int(np.sum(degree == 1))


def facet_pieces(faces):
    """Sets of polygons that hang together, if only by a vertex."""
    if len(faces.generators) == 0:
        return 0
    corners, offsets = faces.face_vertices, faces.face_offsets
    first = np.repeat(corners[offsets[:-1]], np.diff(offsets))
    there = np.zeros(len(faces.vertices), bool)
    there[corners] = True
    return parts(len(there), np.column_stack((first, corners)), there)
