# SPDX-License-Identifier: GPL-3.0-or-later
"""Invariants of every output: empty balls, planar convex polygons, order, welded vertices, types."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import inputs, meshes, shapes

pytestmark = pytest.mark.oracle

MESHES = {
    "torus": meshes.jitter(meshes.torus(around=60, across=24), 1e-3),
    "shell": meshes.jitter(meshes.nested_shell(3), 1e-3),
    "box": meshes.box((16, 12, 8)),
    "uv sphere": meshes.uv_sphere(),
}
CLOUDS = {
    "ellipsoid": shapes.SHAPES["ellipsoid"].sample(3000, 2),
    "shell samples": shapes.SHAPES["shell"].sample(3000, 2),
    "grid cube": shapes.grid_cube(),
    "grid cube turned": shapes.grid_cube() @ inputs.rotation(1).T,
    "random": np.random.default_rng(0).random((2000, 3)),
    "cosphere": shapes.Sphere().sample(1000, 0),
}


@pytest.fixture(params=[*MESHES, *CLOUDS], scope="module")
def result(request, medial):
    """points, analysis, mesh"""
    if request.param in MESHES:
        points, triangles = MESHES[request.param]
        analysis = medial.MedialAnalysis(points, triangles)
    else:
        points = CLOUDS[request.param]
        analysis = medial.MedialAnalysis(points)
    return points, analysis, analysis.extract(0.2, 4.0)


def polygons(mesh):
    return [mesh.face_vertices[a:b] for a, b in zip(mesh.face_offsets[:-1], mesh.face_offsets[1:])]


def assert_invariants(points, mesh):
    """Everything below but the types, for one output; test_fuzz uses it too."""
    assert_balls(points, mesh)
    assert_polygons(points, mesh)
    assert_order(mesh)


def assert_balls(points, mesh):
    """Each vertex is as far from its generators as its radius says, and no sample is nearer."""
    if len(mesh.vertices) == 0:
        return
    size = np.abs(mesh.vertices).max(axis=1) + np.abs(points).max()
    slack = 2.0**-22 * mesh.radius + 8 * np.spacing(size)
    nearest, _ = cKDTree(points).query(mesh.vertices)
    assert (np.abs(nearest - mesh.radius) <= slack).all()
    face = np.repeat(np.arange(len(mesh.generators)), np.diff(mesh.face_offsets))
    for end in (0, 1):
        ends = points[mesh.generators[face, end]]
        arm = np.linalg.norm(mesh.vertices[mesh.face_vertices] - ends, axis=1)
        assert (np.abs(arm - mesh.radius[mesh.face_vertices]) <= slack[mesh.face_vertices]).all()


def assert_polygons(points, mesh):
    """Planar, across pq; convex and counter-clockwise about the direction from p to q, up to 24 bits of the radius."""
    for corners, (p, q) in zip(polygons(mesh), mesh.generators):
        ring = mesh.vertices[corners]
        apart, largest = np.linalg.norm(points[q] - points[p]), mesh.radius[corners].max()
        axis = (points[q] - points[p]) / apart
        size = np.abs(ring).max() + np.abs(points).max()
        slack = 2.0**-21 * largest + 8 * np.spacing(size)
        middle, stretch = 0.5 * (points[p] + points[q]), largest / apart
        assert (np.abs((ring - middle) @ axis) <= slack * (1 + stretch)).all(), "not planar"
        step = np.roll(ring, -1, axis=0) - ring
        turn = np.cross(step, np.roll(step, -1, axis=0)) @ axis
        length = np.linalg.norm(step, axis=1)
        assert (turn >= -2 * slack * (length + np.roll(length, -1))).all(), "not convex"
        centred = ring - ring.mean(axis=0)
        area = 0.5 * np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0) @ axis
        assert area > -slack * length.sum(), "turns the wrong way"


def assert_order(mesh):
    """Facets by generators, p < q; each starts at its lowest vertex; vertices in order of first use, none twice."""
    generators = mesh.generators.astype(np.int64)
    assert (generators[:, 0] < generators[:, 1]).all()
    key = generators[:, 0] * 2**32 + generators[:, 1]
    assert (np.diff(key) > 0).all()
    assert mesh.face_offsets[0] == 0 and mesh.face_offsets[-1] == len(mesh.face_vertices)
    assert (np.diff(mesh.face_offsets) >= 3).all()
    for corners in polygons(mesh):
        assert corners[0] == corners.min() and len(set(corners.tolist())) == len(corners)
    used, first = np.unique(mesh.face_vertices, return_index=True)
    assert np.array_equal(used, np.arange(len(mesh.vertices)))
    facet_of_first_use = np.searchsorted(mesh.face_offsets, first, side="right")
    assert (np.diff(facet_of_first_use) >= 0).all()
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)
    for array in (mesh.vertices, mesh.radius, mesh.theta, mesh.rho):
        assert np.isfinite(array).all()
    assert ((mesh.theta >= 0) & (mesh.theta <= np.pi / 2)).all() and (mesh.rho >= 0).all()


def test_balls_polygons_and_order(result):
    assert_invariants(result[0], result[2])


def test_facets_of_positive_area_leave_no_counted_facet_out(result):
    _, analysis, mesh = result
    chosen = analysis.select(0.2, 4.0)
    assert len(mesh.generators) + mesh.unbounded + mesh.zero_area == len(chosen)
    assert mesh.unbounded == (~analysis.bounded[chosen]).sum()


def test_types_and_shapes(result):
    points, analysis, mesh = result
    v, f = len(mesh.vertices), len(mesh.generators)
    c, e = len(mesh.face_vertices), len(analysis.edges)
    expected = [
        (mesh, "vertices", (v, 3), "f8"),
        (mesh, "radius", (v,), "f8"),
        (mesh, "face_offsets", (f + 1,), "i4"),
        (mesh, "face_vertices", (c,), "i4"),
        (mesh, "theta", (f,), "f8"),
        (mesh, "rho", (f,), "f8"),
        (mesh, "side", (f,), "i4"),
        (mesh, "generators", (f, 2), "i4"),
        (analysis, "edges", (e, 2), "i4"),
        (analysis, "theta", (e,), "f8"),
        (analysis, "rho", (e,), "f8"),
        (analysis, "theta_both", (e,), "f8"),
        (analysis, "rho_both", (e,), "f8"),
        (analysis, "side", (e,), "i4"),
        (analysis, "bounded", (e,), "?"),
        (analysis, "samples", (len(points) - analysis.duplicates,), "i4"),
    ]
    for owner, name, shape, dtype in expected:
        array = getattr(owner, name)
        assert (array.shape, array.dtype) == (shape, np.dtype(dtype)), name
        assert array.flags.c_contiguous, name
        assert not array.flags.writeable, name
        if array.size:
            with pytest.raises(ValueError):
                array.flags.writeable = True
            with pytest.raises(ValueError):
                array[...] = 0
    for number in (mesh.unbounded, mesh.zero_area, analysis.duplicates, analysis.cells):
        assert isinstance(number, int)
    assert isinstance(analysis.closed, bool)


def test_stage_arrays_have_the_documented_types(study):
    points = CLOUDS["random"][:100]
    cells, neighbors, centres = study.delaunay(points)
    vectors, unbounded = study.poles(points)
    offsets, triangles = study.umbrellas(points)
    winding = study.winding_number(points, *meshes.icosphere(1))
    for array, dtype in (
        (cells, "i4"), (neighbors, "i4"), (centres, "f8"), (vectors, "f8"), (unbounded, "?"),
        (offsets, "i8"), (triangles, "i4"), (winding, "f8"),
    ):  # fmt: skip
        assert array.dtype == np.dtype(dtype) and not array.flags.writeable


def test_arrays_outlive_their_owner(medial):
    analysis = medial.MedialAnalysis(CLOUDS["random"])
    mesh = analysis.extract()
    kept, copies = (analysis.theta, mesh.vertices), (analysis.theta.copy(), mesh.vertices.copy())
    del analysis, mesh
    medial.MedialAnalysis(CLOUDS["ellipsoid"]).extract()
    assert all(np.array_equal(a, b) for a, b in zip(kept, copies))


def test_the_input_is_not_changed(medial):
    points = CLOUDS["random"].copy()
    medial.MedialAnalysis(points).extract()
    assert np.array_equal(points, CLOUDS["random"])


def test_bounding_sphere_bounds_the_outer_axis(medial):
    """Dey & Zhao, sect. 4.2: nothing selected reaches infinity, ids stay those of the input, the inner axis stays."""
    slab = shapes.SHAPES["slab"]
    points = slab.sample(2000, 0)
    plain, bounded = (medial.MedialAnalysis(points, bounding_sphere=b) for b in (False, True))
    assert bounded.edges.max() < len(points) and bounded.bounded.all()
    far = [np.linalg.norm(a.extract().vertices, axis=1).max() for a in (plain, bounded)]
    assert plain.extract().unbounded > 0 and bounded.extract().unbounded == 0
    assert far[1] < 4 * np.linalg.norm(points, axis=1).max() < far[0]
    inner = []
    for analysis in (plain, bounded):
        mesh = analysis.extract()
        inside = slab.inside(mesh.vertices)
        facets = zip(mesh.generators.tolist(), polygons(mesh))
        inner.append({tuple(g) for g, corners in facets if inside[corners].all()})
    assert len(inner[0] ^ inner[1]) <= 0.01 * len(inner[0])
