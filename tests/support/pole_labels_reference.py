# SPDX-License-Identifier: GPL-3.0-or-later
"""The labels of poles as Power Crust gives them (Amenta, Choi & Kolluri 2001, sect. 5), written for reading alone."""

import heapq
import math
from collections import defaultdict

import numpy as np

INFINITY = -1
DEEP = 0.5


def unit(v):
    return v / np.linalg.norm(v)


class Labels:
    """Outward normals of distinct points, zero where the poles say nothing.

    `flat`: (n,) bool, the points whose two poles certainly lie on two sides.
    """

    def __init__(self, study, points, flat):
        self.points, self.flat = points, flat
        self.cells, self.neighbors, self.centres = study.delaunay(points)
        self.vectors, self.unbounded = study.poles(points)
        self.infinite = (self.cells < 0).any(axis=1)
        self.links = defaultdict(list)
        self._find_poles()
        self._link()
        self.inner = self._label()

    def _towards(self, p, cell):
        return self.centres[cell] if self.infinite[cell] else self.centres[cell] - self.points[p]

    def _find_poles(self):
        at = defaultdict(list)
        for cell, corners in enumerate(self.cells):
            for p in corners:
                at[p].append(cell)
        self.poles = []
        for p in range(len(self.points)):
            found = []
            for sign in (1, -1):
                beyond = [c for c in at[p] if sign * (self._towards(p, c) @ self.vectors[p]) > 0]
                found.append(self._farthest(p, beyond))
            self.poles.append(found)

    def _farthest(self, p, cells):
        """The name of a pole: its cell, or INFINITY, or None."""
        if any(self.infinite[c] for c in cells):
            return INFINITY
        return max(cells, key=lambda c: np.linalg.norm(self._towards(p, c)), default=None)

    def _add(self, a, b, weight):
        if a is not None and b is not None and a != b:
            self.links[a].append((b, min(weight, 1.0)))
            self.links[b].append((a, min(weight, 1.0)))

    def _link(self):
        for p, (first, second) in enumerate(self.poles):
            if second is None:
                continue
            there = self.vectors[p] if second == INFINITY else self._towards(p, second)
            cosine = unit(self.vectors[p]) @ unit(there)
            if second == INFINITY:
                continue
            if self.flat[p] or cosine > DEEP:
                self._add(first, second, cosine)
        for p, q in self._edges():
            for a in self.poles[p]:
                for b in self.poles[q]:
                    if a not in (None, INFINITY) and b not in (None, INFINITY):
                        cosine = self._deep(p, a, q, b)
                        if cosine > DEEP:
                            self._add(a, b, cosine)
        known = {pole for two in self.poles for pole in two}
        for cell in np.flatnonzero(self.infinite):
            behind = self.neighbors[cell][list(self.cells[cell]).index(-1)]
            corner = next(p for p in self.cells[cell] if p >= 0)
            cosine = self.centres[cell] @ unit(self.centres[behind] - self.points[corner])
            if behind in known and cosine > DEEP:
                self._add(INFINITY, behind, cosine)

    def _edges(self):
        corners = self.cells[~self.infinite]
        pairs = [corners[:, [i, j]] for i in range(4) for j in range(i)]
        return np.unique(np.sort(np.concatenate(pairs), axis=1), axis=0)

    def _deep(self, p, a, q, b):
        r, s = np.linalg.norm(self._towards(p, a)), np.linalg.norm(self._towards(q, b))
        d = np.linalg.norm(self.centres[a] - self.centres[b])
        return (r * r + s * s - d * d) / (2 * r * s)

    def _label(self):
        """pole -> whether it is inner."""
        sure = defaultdict(lambda: [0.0, 0.0])
        sure[INFINITY] = [0.0, 1.0]

        def priority(node):
            inner, outer = sure[node]
            return abs(inner - outer) - 1 if inner > 0 and outer > 0 else max(inner, outer)

        labels, heap = {}, [(-1.0, INFINITY)]
        while heap:
            known, node = heapq.heappop(heap)
            if node in labels or -known != priority(node):
                continue
            labels[node] = bool(sure[node][0] > sure[node][1])
            for other, weight in self.links[node]:
                side = 0 if labels[node] == (weight > 0) else 1
                if other not in labels and abs(weight) > sure[other][side]:
                    sure[other][side] = abs(weight)
                    heapq.heappush(heap, (-priority(other), other))
        return labels

    def normals(self):
        result = np.zeros_like(self.points)
        for p, (first, second) in enumerate(self.poles):
            a, b = self.inner.get(first), self.inner.get(second)
            if a is not b:
                outward = a is False or b is True
                result[p] = unit(self.vectors[p]) * (1 if outward else -1)
        assert all(math.isfinite(x) for x in result.ravel())
        return result
