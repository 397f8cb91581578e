# SPDX-License-Identifier: GPL-3.0-or-later
"""Even meshes of clean forms: shape of the triangles, exact places on solids with known axes, topology, values."""

from functools import cache

import numpy as np
import pytest
from support import crisp_measures, crisp_solids, crossing_triangles, meshes
from support.crisp_runs import Case
from support.data import DATA

FLAT = ("box", "wedge", "blunt", "fan", "bracket", "stairs")
PLANE = FLAT[:3]  # all of their sheets, without a kink of the mesh
# Shares of the diagonal: what the worst hundredth of the axis is missed by, and the mean error of vertices.
CURVED = {
    "cylinder": (5e-3, 5e-5),
    "cone": (2e-3, 1e-6),
    "plate": (1e-3, 1e-7),
    "stadium": (3e-3, 5e-5),
    "oblate": (1e-3, 2e-4),
    "ellipsoid": (1e-3, 2e-4),
}
REAL = ("spot_low.obj", "hand_closed.obj", "fandisk_large.off")


@cache
def made(name):
    return Case(name, 4000, mesh="even").made(crisp=True)


@cache
def of_file(name, mesh="even", **more):
    import medial_axis

    path = DATA / name
    if not path.is_file():
        pytest.skip(f"{name} is not in the folder of real meshes")
    return medial_axis.compute(*meshes.read(path), mesh=mesh, **more)


def least_angles(axis):
    """(f,) degrees"""
    corners = axis.vertices[axis.face_vertices.reshape(-1, 3)]
    ways = np.roll(corners, -1, axis=1) - corners
    ways /= np.linalg.norm(ways, axis=2)[..., None]
    cosine = -np.einsum("fij,fij->fi", ways, np.roll(ways, 1, axis=1))
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))).min(axis=1)


def euler(axis):
    triangles = axis.face_vertices.reshape(-1, 3)
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return len(axis.vertices) - len(np.unique(sides, axis=0)) - len(axis.edges) + len(triangles)


@pytest.mark.parametrize("name", FLAT)
def test_flat_walls_have_exact_places_and_reach_edges_and_corners(name):
    found = made(name).measured()
    assert found.err.most < 1e-13 and found.ball.most < 1e-13
    assert found.gap.most < 1e-12 and found.rim == pytest.approx(1.0, abs=1e-12)
    if name in PLANE:
        assert found.area == pytest.approx(0.0, abs=1e-8) and found.cov.most < 1e-9
    assert found.folds == found.crossings == 0


@pytest.mark.parametrize("name", CURVED)
def test_curved_walls_are_missed_by_chords_only(name):
    found, (missed, off) = made(name).measured(), CURVED[name]
    assert found.cov.p99 < missed and found.err.mean < off
    assert found.folds == found.crossings == 0


@pytest.mark.parametrize("name", ["ellipsoid", "oblate"])
def test_smooth_rims_end_where_the_sheet_does(name):
    assert made(name).measured().rim == pytest.approx(1.0, abs=0.002)


@pytest.mark.parametrize("name", [*FLAT, *CURVED])
def test_the_mesh_has_the_topology_that_is_told(name):
    axis = made(name).computation.axis
    pieces, loops, cavities = axis.level.betti
    assert axis.level.betti == crisp_solids.solid(name).betti
    assert euler(axis) == pieces - loops + cavities
    assert len(np.unique(axis.vertices, axis=0)) == len(axis.vertices)


@pytest.mark.parametrize("name", REAL)
def test_real_meshes_have_few_even_triangles_with_their_topology(name):
    axis = of_file(name).axis
    facets = of_file(name, "voronoi").axis.facets
    assert axis.facets < facets / 5
    angles = least_angles(axis)
    assert angles.mean() > 44 and np.quantile(angles, 0.05) > 18
    pieces, loops, cavities = axis.level.betti
    assert euler(axis) == pieces - loops + cavities
    triangles = axis.face_vertices.reshape(-1, 3)
    assert len(crossing_triangles.crossing_pairs(axis.vertices, triangles)) <= 2
    assert np.mean(axis.level.is_crisp) > 0.8


@pytest.mark.parametrize("name", REAL[:2])
def test_rims_turn_half_as_much(name):
    even, facets = (
        crisp_measures.rim_turns(crisp_measures.output_of(of_file(name, mesh), np.eye(3)))
        for mesh in ("even", "voronoi")
    )
    assert len(even) < len(facets) / 2  # each turn stands for a longer piece of the rim
    assert even.mean() < 30


def test_a_triangle_has_the_values_of_a_facet_that_it_stands_for():
    """In a box its generators are mirror images in the plane of the triangle, as far away as its ball."""
    found = made("box")
    axis = found.computation.axis
    ends = found.computation.chosen.samples.points[axis.generators]
    corners = axis.vertices[axis.face_vertices.reshape(-1, 3)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across = ends[:, 1] - ends[:, 0]
    cosine = np.einsum("fi,fi->f", normals, across)
    cosine /= np.linalg.norm(normals, axis=1) * np.linalg.norm(across, axis=1)
    assert np.quantile(cosine, 0.01) > 0.9 and cosine.min() > 0.0
    assert np.all(axis.theta > 0.0) and np.all(axis.generators[:, 0] < axis.generators[:, 1])


def test_points_without_faces_have_even_triangles_at_the_samples():
    import medial_axis

    rng = np.random.default_rng(3)
    points = rng.normal(size=(3000, 3))
    points *= np.array([1.0, 0.7, 0.4]) / np.linalg.norm(points, axis=1)[:, None]
    facets, even = (medial_axis.compute(points, mesh=mesh).axis for mesh in ("voronoi", "even"))
    assert 0 < even.facets < facets.facets / 5
    assert euler(even) == 1 and not even.level.is_crisp.any()
    distances = np.linalg.norm(even.vertices[:, None] - points[None], axis=2).min(axis=1)
    assert even.radius == pytest.approx(distances, rel=1e-9)
    assert least_angles(even).mean() > 40


def test_bytes_do_not_depend_on_the_threads(medial):
    computation = made("ellipsoid").computation
    samples, axes = computation.chosen.samples, []
    solid = samples.solid
    for threads in (1, 2, 5):
        analysis = medial.MedialAnalysis(
            samples.points,
            triangles=solid.shape.triangles,
            vertices=solid.shape.points,
            threads=threads,
        )
        hierarchy = analysis.hierarchy(
            faces=solid.of_module(medial, computation.settings), places=False
        )
        level = hierarchy.extract(spacings=1.0, even=True, crisp=True, relaxed=True)
        axes.append((level.vertices.tobytes(), level.face_vertices.tobytes()))
    assert axes[0] == axes[1] == axes[2]
