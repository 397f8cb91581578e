# SPDX-License-Identifier: GPL-3.0-or-later
"""Every stage equals the brute-force reference: exact sets of triangles and edges, arrays to 1e-9.

General position: the reference starts from Qhull's cells. Structured input: from the module's own cells, after an
exact proof that they are a Delaunay triangulation. Samples that the definitions do not settle are left out.
"""

from functools import cache
from itertools import pairwise, product

import numpy as np
import pytest
from support import inputs, meshes, reference

pytestmark = pytest.mark.oracle

GENERIC = inputs.generic_cases()
STRUCTURED = inputs.structured_cases()
CASES = [*GENERIC, *STRUCTURED]
THETAS_AND_RHOS = [(np.pi / 8, 8.0), (0.2, 4.0), (1.0, 3.0), (np.pi / 2, 8.0), (np.pi / 8, 1e9)]
LOW = [
    (0.0, 2.0),
    (0.3, 1.0),
    (0.0, 0.0),
]  # here edges of U_p would pass if step 5 did not leave them out


def name_of(case):
    return case if isinstance(case, str) else f"{case[0]}-{case[1]}-{case[2]}"


def points_of(case):
    return STRUCTURED[case] if isinstance(case, str) else inputs.generic(*case)


@cache
def reference_of(study, case):
    points = points_of(case)
    if not isinstance(case, str):
        return reference.Medial(points, reference.delaunay_qhull(points))
    cells = study.delaunay(points)[0]
    cells = reference.sort_cells(cells[(cells >= 0).all(axis=1)])
    reference.assert_delaunay(points, cells)
    return reference.Medial(points, cells)


@cache
def analysis_of(medial, case):
    return medial.MedialAnalysis(points_of(case), sides=medial.SidesFrom.NONE)


@pytest.fixture(params=CASES, ids=name_of, scope="module")
def case(request):
    return request.param


def settled_edges(expected):
    return ~expected.ambiguous[expected.edges].any(axis=1)


def test_cells_are_the_delaunay_triangulation(study, case):
    expected = reference_of(study, case)
    cells, neighbors, _centres = study.delaunay(points_of(case))
    finite = (cells >= 0).all(axis=1)
    assert np.array_equal(reference.sort_cells(cells[finite]), expected.cells)
    assert (cells < 0).sum() == (~finite).sum() == len(expected.rays)
    assert (reference.orientation(expected.grid, cells[finite].astype(np.int64)) > 0).all()
    for column in range(4):
        other = cells[neighbors[:, column]]
        rest = np.sort(np.delete(cells, column, axis=1), axis=1)
        assert all(set(a) <= set(b) for a, b in zip(rest.tolist(), other.tolist()))


def test_circumcentres_are_right_to_24_bits(study, case):
    expected = reference_of(study, case)
    cells, _, centres = study.delaunay(points_of(case))
    finite = np.flatnonzero((cells >= 0).all(axis=1))
    order = np.lexsort(np.sort(cells[finite], axis=1).T[::-1])
    error = np.linalg.norm(centres[finite][order] - expected.centres, axis=1)
    rounding = np.spacing(np.abs(expected.centres).max(axis=1)) * 2
    assert (error <= expected.radius * 2.0**-24 + rounding).all()


def test_directions_of_infinite_cells_are_outward_unit_normals(study, case):
    expected = reference_of(study, case)
    cells, _, centres = study.delaunay(points_of(case))
    for row in np.flatnonzero((cells < 0).any(axis=1)):
        corners = tuple(sorted(int(x) for x in cells[row] if x >= 0))
        assert np.allclose(centres[row], reference.unit(expected.rays[corners]), atol=1e-12, rtol=0)


def test_poles(study, case):
    expected = reference_of(study, case)
    vectors, unbounded = study.poles(points_of(case))
    assert np.array_equal(unbounded, expected.unbounded_cells)
    settled = ~expected.ambiguous
    size = np.linalg.norm(expected.pole_vectors, axis=1)
    error = np.linalg.norm(vectors - expected.pole_vectors, axis=1)
    assert (error <= 1e-7 * size)[settled].all()


def test_umbrellas(study, case):
    expected = reference_of(study, case)
    offsets, triangles = study.umbrellas(points_of(case))
    found = [triangles[a:b] for a, b in pairwise(offsets)]
    assert len(found) == len(expected.points)
    for sample in np.flatnonzero(~expected.ambiguous):
        assert found[sample].tolist() == [list(t) for t in expected.umbrellas[sample]]


@pytest.mark.slow
def test_few_samples_are_left_out(study):
    shares = [reference_of(study, case).ambiguous.mean() for case in GENERIC]
    assert max(shares) <= 0.2 and np.mean(shares) < 0.002
    turned = [reference_of(study, case).ambiguous.mean() for case in STRUCTURED if "turned" in case]
    assert np.mean(turned) < 0.7


def test_edges_and_bounded(study, case):
    expected, analysis = reference_of(study, case), analysis_of(study, case)
    assert np.array_equal(analysis.edges, expected.edges)
    assert np.array_equal(analysis.bounded, expected.bounded)
    assert analysis.cells == len(expected.cells)


@pytest.mark.parametrize("rule", ["", "_both"])
def test_theta(study, case, rule):
    """asin loses half the digits at pi/2, and nothing below 1.5."""
    expected, analysis = reference_of(study, case), analysis_of(study, case)
    settled = settled_edges(expected) & ~expected.in_umbrella.any(axis=1)
    found, wanted = (getattr(x, "theta" + rule)[settled] for x in (analysis, expected))
    assert np.allclose(np.sin(found), np.sin(wanted), atol=1e-9, rtol=0)
    assert np.allclose(found[wanted < 1.5], wanted[wanted < 1.5], atol=1e-9, rtol=0)


@pytest.mark.parametrize("rule", ["", "_both"])
def test_rho(study, case, rule):
    expected, analysis = reference_of(study, case), analysis_of(study, case)
    settled = settled_edges(expected) & ~expected.in_umbrella.any(axis=1)
    found, wanted = (getattr(x, "rho" + rule)[settled] for x in (analysis, expected))
    assert np.allclose(found, wanted, rtol=1e-9, atol=0)


def near_threshold(expected, theta, rho):
    close = (np.abs(expected._directed[0] - theta) < 1e-9) | (
        np.abs(expected._directed[1] / max(rho, 1e-300) - 1) < 1e-9
    )
    return (close & ~expected.in_umbrella).any(axis=1)


@pytest.mark.parametrize("limit_set", [False, True])
def test_selected_edges(study, case, limit_set):
    """Exact set equality for every rule, criterion and several thresholds."""
    for theta, rho in THETAS_AND_RHOS:
        assert_same_selection(study, case, theta, rho, limit_set)


def test_edges_of_an_umbrella_are_not_tried_from_its_sample(study, case):
    """Step 5 of MEDIAL: below rho0 = 2, and at theta0 = 0 by rounding, edges of U_p would pass from p."""
    for theta, rho in LOW:
        assert_same_selection(study, case, theta, rho, False)


def assert_same_selection(study, case, theta, rho, limit_set):
    expected, analysis = reference_of(study, case), analysis_of(study, case)
    compared = settled_edges(expected) & ~near_threshold(expected, theta, rho)
    for rule, criteria in product(("EITHER", "BOTH"), ("ANGLE_OR_RATIO", "ANGLE", "RATIO")):
        found = np.zeros(len(expected.edges), dtype=bool)
        options = {
            "rule": getattr(study.Rule, rule),
            "criteria": getattr(study.Criteria, criteria),
        }
        found[analysis.select(theta, rho, **options, limit_set=limit_set)] = True
        wanted = expected.selected(theta, rho, rule, criteria, limit_set)
        assert np.array_equal(found[compared], wanted[compared]), (theta, rho, rule, criteria)


def test_defaults_are_the_papers(medial, case):
    analysis = analysis_of(medial, case)
    assert np.array_equal(
        analysis.select(),
        analysis.select(
            np.pi / 8, 8.0, medial.Side.BOTH, medial.Rule.EITHER, medial.Criteria.ANGLE_OR_RATIO
        ),
    )


def test_polygons(study, case):
    """Each selected bounded facet of positive area comes out with exactly its Voronoi vertices, and no other."""
    expected, analysis = reference_of(study, case), analysis_of(study, case)
    mesh = analysis.extract(0.1, 3.0)
    chosen = analysis.select(0.1, 3.0)
    assert mesh.unbounded == (~expected.bounded[chosen]).sum()
    polygons = {
        tuple(g): mesh.vertices[mesh.face_vertices[a:b]]
        for g, a, b in zip(mesh.generators.tolist(), mesh.face_offsets[:-1], mesh.face_offsets[1:])
    }
    without_area = 0
    for edge in chosen[expected.bounded[chosen]]:
        wanted, found = (
            expected.facet(edge),
            polygons.pop(tuple(expected.edges[edge].tolist()), None),
        )
        without_area += found is None
        assert_same_polygon(wanted, found, expected.radius[expected.rings[edge]].max())
    assert not polygons
    assert mesh.zero_area == without_area


def assert_same_polygon(wanted, found, radius):
    """Vertices closer than 24 bits of the ball's radius may be one; a polygon of that size may be missing."""
    tolerance = 2.0**-22 * radius
    if found is None:
        assert width(wanted) <= tolerance
        return
    gap = np.linalg.norm(wanted[:, None] - found[None], axis=2)
    assert (gap.min(axis=0) <= tolerance).all() and (gap.min(axis=1) <= tolerance).all()


def width(points):
    """Second largest extent of planar points."""
    return (
        0.0 if len(points) < 3 else np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[1]
    )


def test_radius_and_attributes_of_facets(medial, case):
    analysis = analysis_of(medial, case)
    mesh = analysis.extract(0.1, 3.0)
    row = {tuple(edge): i for i, edge in enumerate(analysis.edges.tolist())}
    rows = np.array([row[tuple(g)] for g in mesh.generators.tolist()], dtype=int)
    assert (np.diff(rows) > 0).all()
    assert np.array_equal(mesh.theta, analysis.theta[rows]) and np.array_equal(
        mesh.rho, analysis.rho[rows]
    )
    assert (mesh.side == 0).all() and (analysis.side == 0).all()
    corner_row = np.repeat(rows, np.diff(mesh.face_offsets))
    samples = points_of(case)[analysis.edges[corner_row, 0]]
    distance = np.linalg.norm(mesh.vertices[mesh.face_vertices] - samples, axis=1)
    assert np.allclose(distance, mesh.radius[mesh.face_vertices], rtol=1e-6)


@pytest.mark.parametrize("seed", range(40))
def test_cells_equal_exact_brute_force(study, seed):
    """All subsets of four points, exact empty spheres: no library in common at all."""
    n = 5 + seed % 16
    points = (
        inputs.generic("cube", n, seed)
        if seed % 2
        else np.random.default_rng(seed).integers(0, 5, (n, 3)) * 1.0
    )
    points = points[reference.distinct_rows(points)]
    if np.linalg.matrix_rank(points - points[0]) < 3:
        pytest.skip("no volume")
    balls = reference.delaunay_brute_force(points)
    cells = study.delaunay(points)[0]
    cells = cells[(cells >= 0).all(axis=1)]
    reference.assert_delaunay(points, cells.astype(np.int64))
    owner = [
        [i for i, ball in enumerate(balls) if set(cell) <= set(ball)] for cell in cells.tolist()
    ]
    assert all(len(found) == 1 for found in owner), "a cell's sphere is not empty"
    assert {found[0] for found in owner} == set(range(len(balls))), "a Voronoi vertex is missing"


def test_reference_knows_betti_numbers():
    """The routine that judges topology, on surfaces whose numbers are known."""
    sphere = meshes.icosphere(1)
    for mesh, betti in (
        (sphere, (1, 0, 1)),
        (meshes.torus(around=8, across=6), (1, 2, 1)),
        (meshes.join(sphere, meshes.box((2, 2, 2))), (2, 0, 2)),
        ((sphere[0], sphere[1][1:]), (1, 0, 0)),
        ((sphere[0], sphere[1][[0, 40, 41]]), (2, 0, 0)),
    ):
        triangles = mesh[1]
        assert (
            reference.betti_numbers(np.arange(0, triangles.size + 1, 3), triangles.ravel()) == betti
        )
