# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether results become better with crisp places: a Markdown table for docs/lab/crisp.md.

    python3 lab/benchmarks/crisp_consumers.py [--solids box fandisk_large.off] [--samples 4000] [--vertices 60]

Reduce and the whole solid: mean and largest distance between the faces and the solid of balls, cones and slabs, in
percent of the diagonal. Balls: percent of the solid that as many balls cover. Curve: mean and largest distance of its
vertices from the exact axis, in percent of the diagonal, and its length. Thickness: mean and largest error in percent
of the exact length where balls lie between walls, as it is measured and by the crisp balls that come nearest to the
places. A name with a dot is a file of the data folder.
"""

import argparse
import math
import sys
from dataclasses import replace

import _module
import numpy as np

_module.load()

import medial_axis  # noqa: E402
from medial_axis.core.axis.levels import hierarchy_of  # noqa: E402
from medial_axis.core.samples.shape import Shape  # noqa: E402
from medial_axis.core.settings import SamplingMode, Settings, ThicknessSettings  # noqa: E402
from medial_axis.core.solid.reduce import SphereMesh, reduce_axis, sphere_mesh  # noqa: E402
from medial_axis.core.solid.thickness import measure_thickness  # noqa: E402
from support import crisp_solids  # noqa: E402

SOLIDS = ("box", "wedge", "bracket", "plate", "ellipsoid", "fandisk_large.off")
PLACES, SPACING = 10_000, 1 / 90


class Subject:
    """A solid as faces and, where they are known, as formulas."""

    def __init__(self, name, samples):
        self.solid = None if "." in name else crisp_solids.solid(name)
        if self.solid is None:
            shape = medial_axis.read(_module.DATA / name)
        else:
            points, triangles = self.solid.mesh
            shape = Shape(np.ascontiguousarray(points), triangles.astype(np.int32))
        self.shape, self.options = shape, {"sampling": "surface", "samples": samples}
        self.diagonal = float(np.linalg.norm(np.ptp(shape.points, axis=0)))

    def axis(self, crisp):
        points, triangles = self.shape.points, self.shape.triangles
        return medial_axis.compute(points, triangles, crisp=crisp, **self.options).axis

    def settings(self):
        return replace(Settings(), sampling=SamplingMode.SURFACE, samples=self.options["samples"])

    def off(self, mesh: SphereMesh) -> str:
        """Mean from the faces to the solid of the mesh, and the largest of both directions, in percent."""
        module, shape = _module.load(), self.shape
        faces = (shape.points, np.zeros(len(shape.points)), shape.triangles, mesh.edges[:0])
        there = np.abs(module.solid_distances(self.places(), *mesh.arrays))
        points = module.solid_surface(*mesh.arrays, SPACING * self.diagonal)
        back = np.abs(module.solid_distances(points, *faces))
        return percent(there[:PLACES].mean(), max(there.max(), back.max()), self.diagonal)

    def places(self):
        """Random points of the faces by area, then the vertices."""
        random = np.random.default_rng(5)
        a, b, c = self.shape.points[self.shape.triangles].transpose(1, 0, 2)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        at = random.choice(len(area), PLACES, p=area / area.sum())
        shares = random.dirichlet([1, 1, 1], PLACES)
        corners = np.stack([a[at], b[at], c[at]], axis=1)
        inside = np.einsum("ij,ijk->ik", shares, corners)
        return np.concatenate([inside, self.shape.points])


def percent(mean, largest, whole):
    return f"{100 * mean / whole:.3f} / {100 * largest / whole:.2f}"


def solids(subject, axes, _):
    """From the faces to the solid only: points all over the solid of a whole axis take minutes."""
    module, places = _module.load(), subject.places()[:PLACES]
    for axis in axes:
        there = np.abs(module.solid_distances(places, *sphere_mesh(axis).arrays))
        yield percent(there.mean(), there.max(), subject.diagonal)


def reductions(subject, axes, vertices):
    """The axis without crisp places gets as many vertices as the other one has."""
    small = reduce_axis(axes[1], vertices)
    old = reduce_axis(axes[0], len(small.vertices))
    facets = f"{len(small.vertices)} vertices, {small.facets} faces: "
    return [subject.off(sphere_mesh(old)), facets + subject.off(sphere_mesh(small))]


def balls(subject, _, vertices):
    points, triangles = subject.shape.points, subject.shape.triangles
    for crisp in (False, True):
        found = medial_axis.cover_by_balls(
            points, triangles, count=vertices, crisp=crisp, **subject.options
        )
        yield f"{100 * found.balls.covered:.2f}"


def curves(subject, _axes, _vertices):
    """The curve as it is fitted to the samples, and with its vertices at their crisp places."""
    if subject.solid is None:
        return ["", ""]
    points, triangles = subject.shape.points, subject.shape.triangles
    found = medial_axis.compute(points, triangles, form="curve", **subject.options)
    hierarchy = hierarchy_of(found.chosen.samples, found.settings, None)
    level = hierarchy.extract(sheet=math.inf, relaxed=True)
    return [
        curve(subject, places, level.wires)
        for places in (level.vertices, hierarchy.crisp_vertices[level.vertex_of])
    ]


def curve(subject, places, wires):
    off = subject.solid.off_axis(places)
    length = np.linalg.norm(places[wires[:, 0]] - places[wires[:, 1]], axis=1).sum()
    return f"{percent(off.mean(), off.max(), subject.diagonal)}, length {length:.2f}"


def lengths(subject, axes, _):
    if subject.solid is None:
        return ["", ""]
    found = measure_thickness(subject.shape, subject.settings(), ThicknessSettings())
    at = found.surface.points[: found.samples]
    exact = 2 * radii(subject.solid, at, subject.diagonal)
    known = found.measured & (exact > 1e-3 * subject.diagonal)
    measured = (found.surface.lengths[: found.samples], nearest_balls(axes[1], at))
    off = [np.abs(values - exact)[known] / exact[known] for values in measured]
    return [percent(errors.mean(), errors.max(), 1) for errors in off]


def nearest_balls(axis, at):
    """The diameters of the balls of an axis that come nearest to some places."""
    nearest = [
        np.argmin(np.abs(np.linalg.norm(axis.vertices - place, axis=1) - axis.radius))
        for place in at
    ]
    return 2 * axis.radius[nearest]


def radii(solid, at, diagonal):
    """The radii of the largest balls inside that touch the faces at some places, by bisection."""
    inward = solid.inward(at)
    low, high = np.zeros(len(at)), np.full(len(at), diagonal)
    for _ in range(40):
        middle = (low + high) / 2
        fits = solid.distance(at + middle[:, None] * inward) > middle - 1e-9 * diagonal
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    return low


CONSUMERS = {
    "whole solid": solids,
    "reduce": reductions,
    "balls": balls,
    "curve": curves,
    "thickness": lengths,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--solids", nargs="+", default=SOLIDS)
    parser.add_argument("--consumers", nargs="+", default=list(CONSUMERS), choices=CONSUMERS)
    parser.add_argument("--samples", type=int, default=4000)
    parser.add_argument("--vertices", type=int, default=60)
    wanted = parser.parse_args()
    print("| solid | result | without | with |\n|---|---|---|---|")
    for name in wanted.solids:
        subject = Subject(name, wanted.samples)
        axes = [subject.axis(False), subject.axis(True)]
        for consumer in wanted.consumers:
            cells = CONSUMERS[consumer](subject, axes, wanted.vertices)
            print("| " + " | ".join([name, consumer, *cells]) + " |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
