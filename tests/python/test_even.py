# SPDX-License-Identifier: GPL-3.0-or-later
"""Even meshes of clean forms: shape of the triangles, exact places on solids with known axes, topology, values."""

from dataclasses import replace
from functools import cache

import medial_axis
import numpy as np
import pytest
from medial_axis.core.axis.levels import hierarchy_of
from support import crisp_measures, crisp_solids, crossing_triangles, meshes, topology
from support.crisp_runs import Case
from support.data import DATA
from support.levels import betti_of_mesh
from support.thick_meshes import pipe

FLAT = ("box", "wedge", "blunt", "fan", "bracket", "stairs")
PLANE = FLAT[:3]  # all of their sheets, without a kink of the mesh
# Shares of the diagonal: what the worst hundredth of the axis is missed by, and the mean error of vertices.
CURVED = {
    "cylinder": (1e-3, 5e-5), "cone": (1e-3, 1e-6), "plate": (1e-3, 1e-7),
    "stadium": (1e-3, 5e-5), "oblate": (1e-3, 2e-4), "ellipsoid": (1e-3, 2e-4),
}  # fmt: skip
REAL = ("spot_low.obj", "hand_closed.obj", "fandisk_large.off")


@cache
def made(name):
    return Case(name, 4000, mesh="even").made(crisp=True)


@cache
def of_file(name, mesh="even", **more):
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


def area_of(level):
    return topology.area(level.vertices, level.face_vertices.reshape(-1, 3))


def test_two_edges_between_the_same_places_enclose_nothing():
    """Samples on common spheres leave such edges, as in a ball of 32 faces; in this one by its size and place."""
    faces = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
    octahedron = np.concatenate((np.eye(3), -np.eye(3))), np.array(faces, np.int32)
    corners, triangles = meshes.split(octahedron)
    corners *= 0.29919 / np.linalg.norm(corners, axis=1)[:, None]
    found = medial_axis.compute(corners + np.array((0.01853, -0.23887, 0.07384)), triangles).axis
    assert (found.level.betti, euler(found)) == ((1, 0, 0), 1)


@pytest.mark.parametrize("name", FLAT)
def test_flat_walls_have_exact_places_and_reach_edges_and_corners(name):
    found = made(name).measured()
    assert found.err.most < 1e-13 and found.ball.most < 1e-13
    assert found.gap.most < 1e-12 and found.rim == pytest.approx(1.0, abs=1e-12)
    if name in PLANE:
        assert found.area == pytest.approx(0.0, abs=1e-8) and found.cov.most < 1e-9
    assert found.folds == found.crossings == 0


@pytest.mark.parametrize(
    "name, size, seed",
    [("bracket", 4000, 3), ("profile", 1000, 1), ("stairs", 4000, 2), ("wedge", 4000, 1)],
)
def test_no_two_vertices_have_one_place(name, size, seed):
    """Sheets that end in one corner of the solid have one vertex there, without a slit between them."""
    level = Case(name, size, seed, mesh="even").made(crisp=True).output()
    used = level.vertices[np.unique(level.face_vertices)]
    assert len(np.unique(used, axis=0)) == len(used)


@pytest.mark.parametrize("name", CURVED)
def test_curved_walls_are_missed_by_chords_only(name):
    found, (missed, off) = made(name).measured(), CURVED[name]
    assert found.cov.p99 < missed and found.err.mean < off
    assert found.folds == found.crossings == 0
    if name == "cone":  # whose tip is an end of the axis
        tip = crisp_solids.solid(name).mesh[0].max(axis=0)[2]
        level = made(name).output()
        row = level.vertices[:, 2].argmax()
        assert level.vertices[row] == pytest.approx([0.0, 0.0, tip], abs=1e-12)
        assert level.radius[row] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("seed", [1, 3, 7, 10])
def test_a_sheet_ends_where_the_balls_of_a_fillet_have_their_common_centre(seed):
    found = Case("stadium", 4000, seed, mesh="even").made(crisp=True).measured()
    assert found.err.most < 2e-3 and found.cov.most < 5e-3


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
    assert len(crossing_triangles.crossing_pairs(axis.vertices, triangles)) == 0
    assert np.mean(axis.level.is_crisp) > 0.8
    assert axis.level.refused < 0.03 * len(axis.vertices)  # 0.032 if none looks again


@pytest.mark.parametrize("of", [(12, 5.0, 5.0, 0.8, 20.0), (48, 2.0, 3.0, 0.2, 6.0)])
def test_rims_at_the_ends_of_thin_pipes_keep_their_order(of):
    """Vertices of a rim lay on the edges in another order than along the rim: 5 and 22 pairs of triangles crossed."""
    axis = medial_axis.compute(*pipe(*of)).axis
    triangles = axis.face_vertices.reshape(-1, 3)
    assert len(crossing_triangles.crossing_pairs(axis.vertices, triangles)) == 0
    assert axis.level.betti == (1, 1, 0) and euler(axis) == 0
    heights = axis.vertices[axis.level.place == 4, 2]
    assert np.minimum(abs(heights), abs(heights - of[-1])).max() < 1e-12 and len(heights) > 100


@pytest.mark.parametrize("sides, wall", [(12, 0.02), (24, 0.01)])
def test_vertices_of_thin_pipes_find_their_places(sides, wall):
    """Edges of the mesh cut the corners of the walls, so vertices lay beyond these: 32 and 35 in 100 were refused."""
    level = medial_axis.compute(*pipe(sides, 1.0, 1.0, wall, 12.0), side="inner").axis.level
    assert level.refused < 0.03 * len(level.place) and level.betti == (1, 1, 0)


@pytest.mark.parametrize("name", ["rocker-arm.off", "mannequin.off", "spot_low.obj"])
def test_sheets_end_inside(medial, name):
    """Balls touched the rocker arm from outside, and refused vertices of the other two lay there."""
    axis = of_file(name).axis
    outside = medial.winding_number(axis.vertices, *meshes.read(DATA / name)) < 0.5
    assert not (outside & (axis.level.place < 3)).any()  # creases of the smooth surface bulge


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
    rng = np.random.default_rng(3)
    points = rng.normal(size=(3000, 3))
    points *= np.array([1.0, 0.7, 0.4]) / np.linalg.norm(points, axis=1)[:, None]
    facets, even = (medial_axis.compute(points, mesh=mesh).axis for mesh in ("voronoi", "even"))
    assert 0 < even.facets < facets.facets / 5
    assert euler(even) == 1 and not even.level.is_crisp.any()
    distances = np.linalg.norm(even.vertices[:, None] - points[None], axis=2).min(axis=1)
    assert even.radius == pytest.approx(distances, rel=1e-9)
    assert least_angles(even).mean() > 40


@pytest.mark.parametrize("name", ["ellipsoid", "box", "cone"])
def test_bytes_do_not_depend_on_the_threads(medial, name):
    """An even mesh and the crisp places of a Voronoi diagram are the same to the byte."""
    computation = made(name).computation
    samples, axes = computation.chosen.samples, []
    solid = samples.solid
    for threads in (1, 2, 5):
        mesh = {"triangles": solid.shape.triangles, "vertices": solid.shape.points}
        analysis = medial.MedialAnalysis(samples.points, **mesh, threads=threads)
        faces = solid.of_module(medial, *solid.options(computation.settings))
        even = analysis.hierarchy(faces=faces, places=False).even(spacings=1.0, crisp=True)
        placed = analysis.hierarchy(faces=faces)
        axes.append(
            [
                getattr(level, array).tobytes()
                for level in (
                    even.extract(crisp=True, relaxed=True),
                    placed.extract(spacings=1.0, round_limbs=True, relaxed=True, crisp=True),
                )
                for array in ("vertices", "radius", "face_vertices")
            ]
        )
    assert axes[0] == axes[1] == axes[2]
    for face in (solid.face[:3], np.full_like(solid.face, len(solid.shape.triangles))):
        wrong = medial.Faces(mesh["vertices"], mesh["triangles"], face)
        with pytest.raises(medial.InvalidInputError):
            analysis.hierarchy(faces=wrong)


# --- the hierarchy of an even mesh: levels, Theta and Rho


@pytest.fixture(scope="module")
def hand(medial):
    """Return the hierarchies of a hand: of the Voronoi diagram, and of its even mesh."""
    found = of_file(REAL[1])
    hierarchy = hierarchy_of(found.chosen.samples, found.settings, None)
    return hierarchy, hierarchy.even(spacings=1.0, round_limbs=True, crisp=True)


def test_levels_without_thresholds_are_the_whole_mesh(hand):
    _, even = hand
    level = even.extract(crisp=True)
    assert np.array_equal(level.facet_of, np.arange(len(even.generators)))
    triangles = level.vertex_of[level.face_vertices].reshape(-1, 3)
    assert np.array_equal(np.sort(triangles), np.sort(even.facet_vertices.reshape(-1, 3)))
    assert np.array_equal(level.vertices, even.vertices[level.vertex_of])


@pytest.mark.parametrize("name", ["sheet", "erosion", "spike"])
def test_levels_of_a_mesh_are_nested_and_keep_the_topology(hand, name):
    hierarchy, even = hand
    values = getattr(even, f"facet_{name}")
    area = np.inf
    for share in (0.1, 0.4, 0.7, 0.95):
        threshold = float(np.quantile(values, share))
        level = even.extract(**{name: threshold})
        assert np.all(values[level.facet_of] > threshold) and level.betti == hierarchy.betti
        assert betti_of_mesh(level)[1] == 1 and not len(level.points)
        triangles = level.face_vertices.reshape(-1, 3)
        assert len(crossing_triangles.crossing_pairs(level.vertices, triangles)) == 0
        before, area = area, area_of(level)
        assert area <= before


def test_higher_theta_and_rho_are_levels_of_the_same_mesh(hand):
    hierarchy, even = hand
    area = area_of(even.extract())
    for theta, rho in ((0.5, 8.0), (0.8, 10.0), (1.2, 20.0)):
        level = even.selecting(theta, rho).extract()
        assert level.betti == hierarchy.betti
        before, area = area, area_of(level)
        assert 0.0 < area < before


def test_a_level_does_not_depend_on_those_before(hand):
    hierarchy, even = hand
    value = float(np.quantile(even.facet_erosion, 0.5))
    again = hierarchy.even(spacings=1.0, round_limbs=True, crisp=True)
    again.extract(spike=0.01)
    again.selecting(1.0, 9.0)
    one, other = (h.extract(erosion=value, relaxed=True) for h in (even, again))
    for name in ("vertices", "radius", "face_vertices", "wires", "generators"):
        assert np.array_equal(getattr(one, name), getattr(other, name)), name


def test_new_rims_are_no_staircases():
    """Rims of triangles that are left out would turn by some 50 degrees at each vertex."""
    found = of_file(REAL[1])
    eroded = medial_axis.extract(found, erode=0.1)
    assert 0.5 * found.axis.facets < eroded.facets < 0.95 * found.axis.facets
    output = crisp_measures.output_of(replace(found, axis=eroded), np.eye(3))
    assert crisp_measures.rim_turns(output).mean() < 15


def test_what_is_far_from_new_rims_stays(hand):
    _, even = hand
    thin = float(np.unique(even.facet_sheet)[-2])
    level = even.extract(sheet=thin)
    assert 0.5 < len(level.facet_of) / len(even.generators) < 0.9
    assert np.mean(np.isin(level.vertices, even.vertices).all(axis=1)) > 0.9


def test_what_is_no_even_mesh_cannot_select_and_what_is_cannot_be_made_again(medial, hand):
    hierarchy, even = hand
    with pytest.raises(medial.InvalidInputError, match="call `even` once"):
        even.even()
    with pytest.raises(medial.InvalidInputError, match="call `even` first"):
        hierarchy.selecting(1.0, 8.0)
    for theta, rho in ((-0.1, 8.0), (1.0, float("nan"))):
        with pytest.raises(medial.InvalidInputError):
            even.selecting(theta, rho)


@pytest.mark.parametrize("crisp", [True, False])
def test_a_mesh_does_not_count_the_samples_and_faces_of_its_hierarchy(hand, crisp):
    hierarchy, _ = hand
    even = hierarchy.even(spacings=1.0, crisp=crisp)
    assert 100 * len(even.vertices) < even.bytes < hierarchy.bytes / 5
