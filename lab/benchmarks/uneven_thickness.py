# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness of smooth solids whose meshes are uneven: errors at vertices that lie on no sharp edge, a Markdown table.

    python3 lab/benchmarks/uneven_thickness.py

The diameter of the largest ball inside that touches each vertex, with Edges: Ball. Rows of triangles have unequal
widths, or triangles slant, or are slivers. All solids are turned and rounded to float32. Errors are in percent of the
true diameter. That of an ellipsoid is known at some vertices, to about 0.1 %, from the vertices of a fine one.
"""

from collections.abc import Iterator

import _module
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

medial = _module.load()

from medial_axis.core.settings import Edges, SamplingMode, Settings, ThicknessSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.thickness.thickness import measure_thickness  # noqa: E402
from support import inputs, meshes, thick_meshes  # noqa: E402

Array = NDArray[np.float64]
KNOWN = 250  # vertices of an ellipsoid whose truth is computed
TUBE = 0.4


def graded(count: int, smallest: float) -> Array:
    """(count + 1,) rising from 0 to 1; after five equal steps come five that are smaller by a factor."""
    steps = np.resize([1.0] * 5 + [smallest] * 5, count)
    return np.append(0.0, np.cumsum(steps)) / steps.sum()


def sphere(rows: Array, around: int) -> meshes.Mesh:
    """A unit sphere of rows at shares of the way from pole to pole."""
    angles = np.pi * rows
    return thick_meshes.lathe(list(zip(np.sin(angles), -np.cos(angles), strict=True)), around)


def capped(count: int, share: float) -> Array:
    """(count + 1,) even rows from 0 to 1, the first and the last one narrower by a factor."""
    steps = np.ones(count)
    steps[[0, -1]] = share
    return np.append(0.0, np.cumsum(steps)) / steps.sum()


def hull(count: int) -> meshes.Mesh:
    """The convex hull of random points of the unit sphere, whose triangles look outward."""
    points = np.random.default_rng(0).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    triangles = ConvexHull(points).simplices.astype(np.int32)
    inward = np.linalg.det(points[triangles]) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return points, triangles


def torus(
    around: int, across: int, turned: float = 0.0, angles: Array | None = None
) -> meshes.Mesh:
    """A torus of radii 1 and 0.4; its rings are turned against each other by a share of a step."""
    points, triangles = meshes.torus(1.0, TUBE, around, across)
    i, j = np.divmod(np.arange(len(points)), across)
    big = 2 * np.pi * (i + turned * (j % 2)) / around
    small = 2 * np.pi * (j / across if angles is None else angles[j])
    ring = 1 + TUBE * np.cos(small)
    points = np.column_stack((ring * np.cos(big), ring * np.sin(big), TUBE * np.sin(small)))
    return points, triangles


def solids() -> Iterator[tuple[str, meshes.Mesh, float]]:
    """Name, mesh and diameter; an ellipsoid is made of the spheres."""
    yield "sphere of 12 by 24", sphere(np.linspace(0, 1, 13), 24), 2.0
    yield "the same, caps of half a row", sphere(capped(12, 0.5), 24), 2.0
    yield "sphere of 32 by 32, caps of a quarter", sphere(capped(32, 0.25), 32), 2.0
    yield "sphere, rows graded by ten", sphere(graded(40, 0.1), 48), 2.0
    yield "icosphere of 642", meshes.icosphere(3), 2.0
    yield "hull of 500 points of a sphere", hull(500), 2.0
    random = (np.arange(40) + 0.8 * np.random.default_rng(0).random(40)) / 40
    yield "torus of 48 by 20", torus(48, 20), 2 * TUBE
    yield "torus of 60 by 30, triangles slant", torus(60, 30, 0.5), 2 * TUBE
    yield "torus of 120 by 60, triangles slant", torus(120, 60, 0.5), 2 * TUBE
    yield "torus, random rows", torus(48, 40, angles=random), 2 * TUBE
    yield "torus, graded rows", torus(48, 40, angles=graded(40, 0.1)[:-1]), 2 * TUBE


def ellipsoids() -> Iterator[tuple[str, meshes.Mesh, Array]]:
    """Name, mesh of the unit sphere and semi-axes."""
    for axes in ((1.0, 0.7, 0.4), (3.0, 2.0, 1.0)):
        name = f"ellipsoid {axes[0]:g}, {axes[1]:g}, {axes[2]:g}"
        yield f"{name}, icosphere", meshes.icosphere(4), np.array(axes)
        yield f"{name}, caps of half a row", sphere(capped(32, 0.5), 48), np.array(axes)
        yield f"{name}, graded rows", sphere(graded(40, 0.1), 48), np.array(axes)
        yield f"{name}, hull of 2,000 points", hull(2000), np.array(axes)


def measured(mesh: meshes.Mesh) -> tuple[Array, NDArray[np.bool_]]:
    """(n,) the diameters at the vertices, and (n,) which of these lie on a sharp edge."""
    points = (mesh[0] @ inputs.rotation(3).T).astype(np.float32).astype(float)
    shape = Shape(points, np.ascontiguousarray(mesh[1], np.int32))
    settings = Settings(sampling=SamplingMode.VERTICES)
    found = measure_thickness(shape, settings, ThicknessSettings(edges=Edges.BALL))
    return found.lengths[: len(points)], found.at_edge[: len(points)]


def row_of(name: str, vertices: int, errors: Array) -> str:
    least, most, mean = 100 * errors.min(), 100 * errors.max(), 100 * np.abs(errors).mean()
    return f"| {name} | {vertices:,} | {least:.2f} | {most:.2f} | {mean:.3f} |"


def main() -> None:
    print("| solid | vertices | least | largest | mean |\n|---|--:|--:|--:|--:|")
    for name, mesh, truth in solids():
        found, at_edge = measured(mesh)
        print(row_of(name, len(mesh[0]), found[~at_edge] / truth - 1), flush=True)
    fine = meshes.icosphere(6)[0] @ inputs.rotation(5)
    for name, (points, triangles), axes in ellipsoids():
        found, at_edge = measured((points * axes, triangles))
        normals = points / axes
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        some = np.random.default_rng(0).permutation(np.flatnonzero(~at_edge))[:KNOWN]
        truth = thick_meshes.shrinking_ball(points[some] * axes, normals[some], fine * axes)[0]
        print(row_of(name, len(points), found[some] / truth - 1), flush=True)


if __name__ == "__main__":
    main()
