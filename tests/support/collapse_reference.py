# SPDX-License-Identifier: GPL-3.0-or-later
"""The ordered collapse as it is defined: sets and loops over everything, for some dozens of points.

Independent of the compiled core but for the Delaunay cells, their sides, theta, rho and spacing, and for the order of
the ids, which breaks ties.
"""

from __future__ import annotations

import heapq
import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from .reference import rank

LEVELS = 16  # of weight, in the fringe
AT_ONCE = 1 / 1024  # of the diagonal: wires that are loose and no longer than this do not wait
PER_ANCHOR = 9  # edges, at least, from one anchor of a front to the next


@dataclass
class Complex:
    """Cells as numbers: vertices, edges as pairs of them, facets as lists of vertices and edges in turn, 3-cells."""

    position: np.ndarray
    radius: np.ndarray
    edges: list[tuple[int, int]]
    rings: list[list[int]]  # per facet: vertices in order
    generators: list[tuple[int, int]]
    bubbles: list[int]
    facets_of_edge: list[list[int]] = field(default_factory=list)
    edges_of_facet: list[list[int]] = field(default_factory=list)
    edges_of_vertex: list[list[int]] = field(default_factory=list)

    def finish(self) -> Complex:
        number = {frozenset(e): i for i, e in enumerate(self.edges)}
        self.facets_of_edge = [[] for _ in self.edges]
        self.edges_of_vertex = [[] for _ in self.position]
        for i, e in enumerate(self.edges):
            for v in e:
                self.edges_of_vertex[v].append(i)
        for f, ring in enumerate(self.rings):
            own = [number[frozenset(pair)] for pair in zip(ring, ring[1:] + ring[:1], strict=True)]
            self.edges_of_facet.append(own)
            for e in own:
                self.facets_of_edge[e].append(f)
        return self


def inner_complex(points, cells, inner, vertices, facet_order, edge_order) -> Complex:
    """From Delaunay cells (c, 4), -1 for infinity, and the ids of the inner ones; `vertices` are their centres."""
    number = {int(c): v for v, c in enumerate(inner)}
    faces, rings_of, cells_of = {}, {}, {}
    for c, cell in enumerate(cells):
        for face in itertools.combinations(sorted(map(int, cell)), 3):
            faces.setdefault(face, []).append(c)
        for pair in itertools.combinations(sorted(map(int, cell)), 2):
            rings_of.setdefault(pair, []).append(c)
        for p in cell:
            cells_of.setdefault(int(p), []).append(c)
    edges = {
        tuple(sorted((number[a], number[b])))
        for a, b in faces.values()
        if a in number and b in number
    }
    found = {
        pair: ring
        for pair, ring in rings_of.items()
        if pair[0] >= 0 and all(c in number for c in ring)
    }
    assert edges == {tuple(map(int, e)) for e in edge_order}
    assert sorted(found) == sorted(tuple(map(int, g)) for g in facet_order)
    order = [tuple(map(int, g)) for g in facet_order]
    return Complex(
        position=np.asarray(vertices),
        radius=np.linalg.norm(
            np.asarray(vertices) - points[[min(p for p in cells[c] if p >= 0) for c in inner]],
            axis=1,
        ),
        edges=[tuple(map(int, e)) for e in edge_order],
        rings=[in_turn(found[pair], number, edges) for pair in order],
        generators=order,
        bubbles=[p for p, own in cells_of.items() if p >= 0 and all(c in number for c in own)],
    ).finish()


def in_turn(ring, number, edges) -> list[int]:
    left = {number[c] for c in ring}
    turn = [left.pop()]
    while left:
        following = [v for v in left if tuple(sorted((v, turn[-1]))) in edges]
        turn.append(following[0])
        left.remove(following[0])
    return turn


def betti(c: Complex) -> tuple[int, int, int]:
    """Betti numbers by ranks of the boundary matrices over the two elements 0 and 1."""
    d1 = [sum(1 << v for v in e) for e in c.edges]
    d2 = [sum(1 << e for e in own) for own in c.edges_of_facet]
    d3 = [sum(1 << f for f, g in enumerate(c.generators) if p in g) for p in c.bubbles]
    r1, r2, r3 = (rank(rows) for rows in (d1, d2, d3))
    return len(c.position) - r1, len(c.edges) - r1 - r2, len(c.rings) - r2 - r3


class Collapse:
    """All stages. `log` holds (kind, cell, face); kinds: "bubble", "facet", "wire"."""

    def __init__(self, c: Complex, weight, selected, points, diagonal):
        self.c, self.points, self.diagonal = c, points, diagonal
        self.facets, self.edges = set(range(len(c.rings))), set(range(len(c.edges)))
        self.vertices = set(range(len(c.position)))
        self.log: list[tuple[str, int, int]] = []
        self.open_bubbles(weight)
        self.peel_facets(weight, selected)
        self.peel_wires()
        self.k1 = set(self.facets)
        self.started = len(self.log)
        self.burn()
        self.wires_from = len(self.log)
        self.burn_wires()

    # what is left

    def at_edge(self, e):
        return [f for f in self.c.facets_of_edge[e] if f in self.facets]

    def at_vertex(self, v):
        return [e for e in self.c.edges_of_vertex[v] if e in self.edges]

    def free_edges(self, f):
        return [e for e in self.c.edges_of_facet[f] if len(self.at_edge(e)) == 1]

    def is_loose(self, v):
        own = self.at_vertex(v)
        return len(own) == 1 and not self.at_edge(own[0])

    # stage 0

    def open_bubbles(self, weight):
        closed = set(self.c.bubbles)
        while closed:
            walls = [
                (weight[f], f)
                for f in self.facets
                if sum(p in closed for p in self.c.generators[f]) == 1
            ]
            _, f = min(walls)
            bubble = next(p for p in self.c.generators[f] if p in closed)
            closed.remove(bubble)
            self.facets.remove(f)
            self.log.append(("bubble", bubble, f))

    # stage 1

    def peel_facets(self, weight, selected):
        level = {
            f: min(int(LEVELS * weight[f]), LEVELS - 1) for f in self.facets if not selected[f]
        }
        for now in range(LEVELS):
            while True:
                going = [
                    f for f in self.facets if level.get(f, LEVELS) <= now and self.free_edges(f)
                ]
                if not going:
                    break
                exits = {f: min(self.free_edges(f), key=self.smallest_ball) for f in going}
                for f, e in exits.items():
                    self.take("facet", f, e)

    def smallest_ball(self, e):
        return min(self.c.radius[v] for v in self.c.edges[e]), e

    def peel_wires(self):
        while True:
            loose = {v: self.at_vertex(v)[0] for v in self.vertices if self.is_loose(v)}
            going = {
                v: e
                for v, e in loose.items()
                if not self.other(e, v) > v or self.other(e, v) not in loose
            }
            if not going:
                return
            for v, e in going.items():
                self.take("wire", e, v)

    def other(self, e, v):
        return sum(self.c.edges[e]) - v

    def take(self, kind, cell, face):
        self.log.append((kind, cell, face))
        if kind == "facet":
            self.facets.remove(cell)
            self.edges.remove(face)
        else:
            self.edges.remove(cell)
            self.vertices.remove(face)

    # stage 2

    def burn(self):
        c = self.c
        self.times = {
            e: [c.radius[v] for v in c.edges[e]] for e in self.edges if len(self.at_edge(e)) < 2
        }
        self.thickness = {}
        middle = {f: self.centroid(f) for f in self.facets}
        time = {}

        def heat(f, e):
            time[f] = min(time.get(f, math.inf), self.arrival(e, middle[f]))

        def key(f):
            radius = np.linalg.norm(middle[f] - self.points[c.generators[f][0]])
            return max(0.0, time[f] - radius), f

        for f in self.facets:
            for e in self.free_edges(f):
                heat(f, e)
        while time:
            f = min(time, key=key)
            self.thickness[f] = key(f)[0]
            del time[f]
            free = self.free_edges(f)
            self.take("facet", f, min(free, key=lambda e: (sum(self.times[e]), e)))
            for e in c.edges_of_facet[f]:
                left = self.at_edge(e)
                if e in self.edges and len(left) == 1:
                    self.times[e] = [
                        min(self.arrival(b, c.position[v]) for b in free) for v in c.edges[e]
                    ]
                    heat(left[0], e)

    def centroid(self, f):
        p = self.c.position[self.c.rings[f]]
        cross = np.cross(p[1:-1] - p[0], p[2:] - p[0])
        area = np.linalg.norm(cross, axis=1)
        if area.sum() == 0:
            return p.mean(axis=0)
        return ((p[1:-1] + p[2:] + p[0]) / 3 * area[:, None]).sum(axis=0) / area.sum()

    def arrival(self, e, x):
        """The least of t(y) + |x - y| over the points y of the edge, by a fine search."""
        a, b = (self.c.position[v] for v in self.c.edges[e])
        ta, tb = self.times[e]

        def at(s):
            return ta + s * (tb - ta) + np.linalg.norm(x - (a + s * (b - a)))

        low, high = 0.0, 1.0
        for _ in range(100):  # the function is convex
            one, two = low + (high - low) / 3, high - (high - low) / 3
            if at(one) < at(two):
                high = two
            else:
                low = one
        return min(at(0.0), at(1.0), at((low + high) / 2))

    # stage 3

    def burn_wires(self):
        c = self.c
        self.elongation = {}
        front: dict[int, tuple[float, int, float, int]] = {}  # time, anchor, its time, edges
        waiting: list[tuple[float, int]] = []

        def later(known, x):
            time, anchor, anchor_time, _ = known
            return max(time, anchor_time + np.linalg.norm(x - c.position[anchor]))

        def light(v):
            e = self.at_vertex(v)[0]
            lateral = self.times[e]
            sideways = lateral[c.edges[e].index(v)]
            if v not in front or not front[v][0] > sideways:
                front[v] = (sideways, v, sideways, 0)
            time = later(front[v], c.position[list(c.edges[e])].mean(axis=0))
            self.elongation[v] = max(0.0, time - sum(lateral) / 2)
            return self.elongation[v]

        def take_away(v):
            e = self.at_vertex(v)[0]
            w = self.other(e, v)
            self.take("wire", e, v)
            time, (_, anchor, anchor_time, edges) = later(front[v], c.position[w]), front[v]
            arrived = (time, anchor, anchor_time, edges + 1)
            if (
                edges + 1 >= PER_ANCHOR
                and np.linalg.norm(c.position[w] - c.position[anchor]) > c.radius[w] / 2
            ):
                arrived = (time, w, time, 0)
            if w not in front or time > front[w][0]:
                front[w] = arrived
            return w

        def follow(v):
            while v in self.vertices and self.is_loose(v):
                if light(v) > AT_ONCE * self.diagonal:
                    heapq.heappush(waiting, (self.elongation[v], v))
                    return
                v = take_away(v)

        for v in range(len(c.position)):
            follow(v)
        while waiting:
            _, v = heapq.heappop(waiting)
            if v in self.vertices and self.is_loose(v):
                follow(take_away(v))

    # values

    def waits_for(self):
        """Per operation: those that have to go before, as the theorem has it."""
        c = self.c
        takes_facet, takes_edge = {}, {}
        for i, (kind, cell, face) in enumerate(self.log):
            if kind == "bubble":
                takes_facet[face] = i
            elif kind == "facet":
                takes_facet[cell], takes_edge[face] = i, i
            else:
                takes_edge[cell] = i
        result = []
        for kind, cell, face in self.log:
            if kind == "bubble":
                result.append([])
            elif kind == "facet":
                result.append([takes_facet[f] for f in c.facets_of_edge[face] if f != cell])
            else:
                result.append(
                    [takes_facet[f] for f in c.facets_of_edge[cell]]
                    + [takes_edge[e] for e in c.edges_of_vertex[face] if e != cell]
                )
        return result

    def propagate(self, raw):
        """The least values that are nowhere below `raw` and never fall along "waits for"."""
        values = []
        for own, before in zip(raw, self.waits_for(), strict=True):
            values.append(max([own, *(values[i] for i in before)]))
        return values

    def erosion(self):
        return self.propagate(
            [
                self.thickness.get(cell, 0.0) / self.diagonal if kind == "facet" else 0.0
                for kind, cell, _ in self.log
            ]
        )

    def sheet(self, unit):
        drops = self.drops(
            {f: self.thickness[f] / unit[f] if f in self.thickness else math.inf for f in self.k1}
        )
        return self.propagate(
            [drops.get(cell, 0.0) if kind == "facet" else 0.0 for kind, cell, _ in self.log]
        )

    def drops(self, thickness):
        """Per facet of K1: the thickness at which its sheet goes.

        The thinnest sheet goes. Where that leaves two facets at a junction, the sheets there unite, unless both are
        all that is left at another junction.
        """
        sheets, values = self.sheets_of(self.k1), {}
        sheet_of = {f: i for i, sheet in enumerate(sheets) for f in sheet}
        meetings = {
            tuple(sorted(sheet_of[f] for f in self.k1 & set(own))) for own in self.c.facets_of_edge
        }
        meetings = sorted(m for m in meetings if len(m) > 2)
        into = list(range(len(sheets)))

        def left_at(meeting):
            return [into[s] for s in meeting if into[s] >= 0]

        def branch(two):
            return any(len(left_at(m)) > 2 and set(left_at(m)) <= set(two) for m in meetings)

        while any(i >= 0 for i in into):
            peak, gone = min(
                (
                    max(thickness[f] for s, i in enumerate(into) if i == group for f in sheets[s]),
                    group,
                )
                for group in set(into) - {-1}
            )
            if peak == math.inf:
                break
            dropped = {s for s, i in enumerate(into) if i == gone}
            values |= {f: peak for s in dropped for f in sheets[s]}
            into = [-1 if i == gone else i for i in into]
            for meeting in meetings:
                two = left_at(meeting)
                if dropped & set(meeting) and len(two) == len(set(two)) == 2 and not branch(two):
                    into = [min(two) if i == max(two) else i for i in into]
        return {f: values.get(f, math.inf) for f in self.k1}

    def sheets_of(self, facets):
        """Sets of facets that hang together over edges with exactly two of them."""
        c = self.c
        sheet = {f: f for f in facets}

        def find(f):
            while sheet[f] != f:
                f = sheet[f]
            return f

        for own in c.facets_of_edge:
            there = [f for f in own if f in facets]
            if len(there) == 2:
                sheet[find(there[0])] = find(there[1])
        groups: dict[int, list[int]] = {}
        for f in facets:
            groups.setdefault(find(f), []).append(f)
        return sorted(groups.values(), key=min)

    def limb(self):
        """Per operation on a wire of stage 3, in order, the rest 0."""
        c = self.c
        log = [(i, v) for i, (_, _, v) in enumerate(self.log) if i >= self.wires_from]
        leads_to = {v: self.other(self.log[i][1], v) for i, v in log}
        children: dict[int, list[int]] = {}
        for _, v in log:
            children.setdefault(leads_to[v], []).append(v)
        length, value = {}, {}
        for _, v in log:
            length[v] = max([self.elongation[v], *(length[u] for u in children.get(v, []))])
        for _, v in reversed(log):
            w = leads_to[v]
            elder = max(children[w], key=lambda u: length[u])  # of equal ones the first
            value[v] = value[w] if w in value and elder == v else length[v]
        tip, ended = {}, {}
        sticks_out: dict[int, float] = {}  # per tip
        for v in [*(v for _, v in log), *(w for w in children if w not in leads_to)]:
            arrived = [(out_of(c, tip[u], v), tip[u]) for u in children.get(v, [])]
            arrived.sort(key=lambda a: -a[0])
            goes_on = arrived[:1] if v in leads_to else []
            for out, x in arrived[len(goes_on) :]:
                sticks_out[x] = max(out, ended.get(x, 0.0), 0.0)
            tip[v] = goes_on[0][1] if goes_on else v
            for _, x in arrived[len(goes_on) :]:
                ended[tip[v]] = max(ended.get(tip[v], 0.0), sticks_out[x])
        result, behind = [0.0] * len(self.log), {}
        for i, v in log:
            out = sticks_out[tip[v]]
            farthest = self.farthest_out(v, children, leads_to, length)
            out = farthest if farthest > 4 * out else out
            own = min(value[v], out) / self.diagonal
            result[i] = behind[v] = max([own, *(behind[u] for u in children.get(v, []))])
        return result

    def farthest_out(self, v, children, leads_to, length):
        """How far a ball of the longest branch through v sticks out of the ball at its end, at most; 0 if a ball
        nearer to the end sticks out about as far, or if it is no more than the radius of the ball at the end."""
        # The first child wins if several are equally long.
        elder = {w: max(children[w], key=lambda u: length[u]) for w in children}
        before, end = [v], v
        while before[-1] in elder:
            before.append(elder[before[-1]])
        after = []
        while True:
            w = leads_to[end]
            if w not in leads_to or elder[w] != end:
                break
            after.append(end := w)
        most = max(out_of(self.c, x, w) for x in before + after)
        alike = (out_of(self.c, x, w) >= most - 0.05 * self.c.radius[x] for x in after)
        return 0.0 if any(alike) or most <= self.c.radius[w] else most

    def by_cell(self, values):
        """Values of facets, edges and vertices; infinite for those that are left."""
        facet, edge = [math.inf] * len(self.c.rings), [math.inf] * len(self.c.edges)
        vertex = [math.inf] * len(self.c.position)
        for value, (kind, cell, face) in zip(values, self.log, strict=True):
            if kind == "bubble":
                facet[face] = value
            elif kind == "facet":
                facet[cell] = edge[face] = value
            else:
                edge[cell] = vertex[face] = value
        return facet, edge, vertex


def out_of(c: Complex, tip: int, v: int) -> float:
    """How far the ball at a tip sticks out of that at another vertex."""
    return float(np.linalg.norm(c.position[tip] - c.position[v])) + c.radius[tip] - c.radius[v]
