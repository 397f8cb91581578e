# SPDX-License-Identifier: GPL-3.0-or-later
# ruff: noqa: F401 - the shapes are imported for the tests.
"""Solids whose medial axes are known exactly, with seeded blue-noise samplers of their surfaces.

Every shape has `sample(n, seed)`, `field(x)`, `inside(x)`, `normals(x)`, `axis_distance(x)` (exact distance to the
inner axis), `axis_points(m, seed)` (uniform points of the inner axis) and `axis_radius(x)` (of the ball there).
Truth: oblate and triaxial ellipsoid: a disc or solid ellipse with semi-axes (a^2 - c^2)/a and (b^2 - c^2)/b;
prolate: a segment; rounded slab: the rectangle; shell: the middle surface; convex polytope: for each pair of faces the
polygon where both are nearest; convex profile turned round the z axis: the profile's axis, turned; tube: the curve.
Some give `outer_axis_distance(x)`, too. Thickness varies in `RoundCone`, `EccentricShell` and `Cyclide`; `HoledPlate`
has handles.
"""

from .base import Array, Rng, Shape
from .convex import Box, Lathe, cylinder, frustum, grid_cube
from .ellipsoids import Ellipsoid, Prolate, Shell, Sphere
from .holes import HoledPlate
from .thick import Capsule, Knot, Slab, Torus
from .varying import Cyclide, EccentricShell, RoundCone

SHAPES: dict[str, Shape] = {
    "ellipsoid": Ellipsoid(),
    "oblate": Ellipsoid(1.0, 1.0, 0.5),
    "slab": Slab(),
    "shell": Shell(),
    "box": Box(),
    "torus": Torus(),
    "capsule": Capsule(),
    "knot": Knot(),
}
"""Those of the convergence study, by name."""

MORE_SHAPES: dict[str, Shape] = {
    "prolate": Prolate(),
    "spherical shell": Shell(0.8, 0.8, 0.8, 0.4),
    "cylinder": cylinder(0.5, 1.0),
    "flat cylinder": cylinder(1.0, 0.4),
    "frustum": frustum(1.0, 0.5, 0.8),
    "flat frustum": frustum(1.0, 0.7, 0.3),
    "cone": frustum(0.8, 0.0, 0.8),
}
"""Those that are sampled from triangle meshes only."""
