# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangulation against Qhull, which shares no code with it, up to 20,000 points; cells equal as sets."""

import numpy as np
import pytest
from scipy.spatial import Delaunay, cKDTree
from support import inputs, reference, shapes

pytestmark = pytest.mark.oracle


@pytest.mark.parametrize(
    "kind, n",
    [
        ("cube", 1000), ("gauss", 3000), ("cube", 20000), ("ellipsoid", 5000), ("shell", 10000),
        ("torus", 20000), ("knot", 20000), ("graded", 2000),
    ],
)  # fmt: skip
def test_cells_equal_qhull(study, kind, n):
    points = inputs.generic(kind, n, 1)
    cells, _neighbors, _ = study.delaunay(points)
    finite = (cells >= 0).all(axis=1)
    wanted = reference.sort_cells(Delaunay(points, qhull_options="Qbb Qc Qz Q12").simplices)
    assert np.array_equal(reference.sort_cells(cells[finite]), wanted)


STRUCTURED = inputs.structured_cases()


@pytest.mark.parametrize("name", STRUCTURED)
def test_coincident_samples_by_exact_integers(study, name):
    """Grids, spheres and prisms, also turned, so that rounding breaks their coincidences."""
    points = STRUCTURED[name]
    cells, _, centres = study.delaunay(points)
    finite = (cells >= 0).all(axis=1)
    exact = reference.Voronoi(points, reference.sort_cells(cells[finite]))
    reference.assert_delaunay(points, exact.cells)
    order = np.lexsort(np.sort(cells[finite], axis=1).T[::-1])
    error = np.linalg.norm(centres[finite][order] - exact.centres, axis=1)
    rounding = np.spacing(np.abs(exact.centres).max(axis=1)) * 2
    assert (error <= exact.radius * 2.0**-24 + rounding).all()
    analysis = study.MedialAnalysis(points, sides=study.SidesFrom.NONE)
    assert np.array_equal(analysis.edges, exact.edges)
    assert np.array_equal(analysis.bounded, exact.bounded)


def test_neighbors_share_three_corners_and_know_each_other(study):
    cells, neighbors, _ = study.delaunay(inputs.generic("ellipsoid", 2000, 5))
    for column in range(4):
        other = neighbors[:, column]
        assert (neighbors[other] == np.arange(len(cells))[:, None]).sum(axis=1).min() >= 1
        common = (cells[:, :, None] == cells[other][:, None, :]).any(axis=2)
        assert not common[:, column].any() and (common.sum(axis=1) == 3).all()


def test_cells_fill_the_convex_hull(study):
    """The volumes add up: no overlap, no gap, also for exactly cospherical and coplanar samples."""
    grids = (inputs.grid((5, 6, 7)), 4.0 * 5 * 6), (inputs.hollow((8, 8, 8)), 7.0**3)
    for points, volume in grids:
        cells = study.delaunay(points)[0]
        cells = cells[(cells >= 0).all(axis=1)].astype(np.int64)
        grid, _ = reference.to_integers(points)
        sizes = reference.orientation(grid, cells)
        assert (sizes > 0).all() and sizes.sum() == 6 * volume


def test_empty_spheres_of_20000_samples(study):
    points = shapes.SHAPES["ellipsoid"].sample(20000, 3)
    cells, _, centres = study.delaunay(points)
    finite = (cells >= 0).all(axis=1)
    radius = np.linalg.norm(centres[finite] - points[cells[finite, 0]], axis=1)
    nearest, _ = cKDTree(points).query(centres[finite])
    assert (nearest >= radius * (1 - 2.0**-23)).all()
