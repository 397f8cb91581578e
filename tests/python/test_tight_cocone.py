# SPDX-License-Identifier: GPL-3.0-or-later
"""Tight Cocone: watertight, of the right topology, with the right inside, on solids whose truth is known."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import inputs, meshes, topology
from support.measure import jaccard, selected_inner
from support.shapes import SHAPES
from support.solids import SOLIDS, Filled

pytestmark = pytest.mark.oracle

SIZES = {"knot": 4000, "genus 2": 4000, "genus 3": 4000}  # the others: 2000
CASES = [(name, SIZES.get(name, 2000)) for name in SOLIDS]
LARGE = [(name, n) for name in SOLIDS for n in (8000, 50000)]
ALL = CASES + [pytest.param(*case, marks=pytest.mark.slow) for case in LARGE]


@cache
def samples(name, n):
    return SOLIDS[name].shape.sample(n, 3)


@pytest.fixture(scope="module")
def surface_of(medial):
    return cache(lambda name, n: medial.TightCocone(samples(name, n)))


def assert_watertight(points, surface):
    """Every edge in an even number of triangles, as often one way as the other; and all counts are right."""
    triangles = surface.triangles
    assert_ordered(triangles)
    uses = topology.edges(triangles)[1]
    assert (uses % 2 == 0).all() and topology.is_oriented(triangles)
    assert surface.nonmanifold_edges == (uses > 2).sum()
    assert np.isin(triangles, surface.samples).all()
    assert np.array_equal(surface.on_surface, np.isin(surface.samples, triangles))
    assert len(surface.samples) + surface.duplicates == len(points)
    assert (len(triangles) == 0) == (surface.inner_cells == 0)
    assert surface.cavities >= 0


def assert_ordered(triangles):
    """Lowest row first, in lexicographic order, none twice."""
    assert triangles.dtype == np.int32 and triangles.shape[1:] == (3,)
    assert (triangles[:, 0] < triangles[:, 1:].min(axis=1)).all()
    rows = triangles.tolist()
    assert rows == sorted(rows) and len({tuple(sorted(row)) for row in rows}) == len(rows)


def assert_promises(study, points):
    surface = study.TightCocone(points)
    assert_watertight(points, surface)
    assert_between_inner_and_outer_cells(study, points, surface)
    return surface


def assert_between_inner_and_outer_cells(study, points, surface):
    """The triangles are exactly the Delaunay facets with one side in and one out, and face the outer one."""
    cells, neighbors, _ = study.delaunay(points)
    inner, outer = (surface.cell_side == int(x) for x in (study.Side.INNER, study.Side.OUTER))
    assert len(surface.cell_side) == len(cells) and (inner | outer).all()
    assert outer[(cells < 0).any(axis=1)].all()
    assert surface.inner_cells == inner.sum()
    cell, slot = np.nonzero(inner[:, None] & outer[neighbors])
    wanted = lowest_first(np.take_along_axis(cells[cell], FACING[slot], axis=1))
    assert np.array_equal(surface.triangles, wanted[np.lexsort(wanted.T[::-1])])


# Away from corner 0, 1, 2, 3 of a cell.
FACING = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])


def lowest_first(triangles):
    first = triangles.argmin(axis=1)
    return np.take_along_axis(triangles, (first[:, None] + np.arange(3)) % 3, axis=1)


@pytest.mark.parametrize("name, n", ALL)
def test_topology_is_exact(surface_of, name, n):
    """A closed manifold of the solid's components and Euler characteristic through every sample."""
    surface, solid = surface_of(name, n), SOLIDS[name]
    assert_watertight(samples(name, n), surface)
    assert (topology.edges(surface.triangles)[1] == 2).all()
    assert topology.euler(surface.triangles) == solid.euler
    assert topology.components(surface.triangles) == solid.components
    assert surface.on_surface.all()
    assert name == "knot" or (
        surface.flat.all() and surface.good.all() and not surface.left_outside
    )
    assert (surface.nonmanifold_edges, surface.nonmanifold_vertices, surface.cavities) == (0, 0, 0)


@pytest.mark.parametrize("name, n", ALL)
def test_triangles_face_outward_and_enclose_the_volume(surface_of, name, n):
    points, shape = samples(name, n), SOLIDS[name].shape
    low, size = points.min(axis=0), np.ptp(points, axis=0)
    thrown = low + np.random.default_rng(0).random((100_000, 3)) * size
    exact = shape.inside(thrown).mean() * np.prod(size)
    assert topology.volume(points, surface_of(name, n).triangles) == pytest.approx(exact, rel=0.05)


def far_cells(study, points, shape):
    """Rows of finite cells whose Voronoi vertex is farther from the surface than the samples there from each other."""
    cells, _, centres = study.delaunay(points)
    finite = np.flatnonzero((cells >= 0).all(axis=1))
    spacing = cKDTree(points).query(points, 2)[0][:, 1]
    far = np.abs(shape.field(centres[finite])) > spacing[cells[finite]].max(axis=1)
    return finite[far], centres[finite[far]]


@pytest.mark.parametrize("name, n", CASES)
def test_inner_facets_do_not_depend_on_the_bounding_sphere(medial, name, n):
    """Some facets at flat cells on the surface differ, because the sphere changes the cells outside."""
    points = samples(name, n)
    one, other = (
        selected_inner(medial, analysed(medial, points, bounding_sphere=sphere))
        for sphere in (False, True)
    )
    assert len(one) > 100 and len(one ^ other) <= 0.001 * len(one)


def analysed(medial, points, **options):
    return medial.MedialAnalysis(points, sides=medial.SidesFrom.TIGHT_COCONE, **options)


@pytest.mark.parametrize("sphere", [False, True])
def test_the_surface_of_an_analysis(medial, surface_of, sphere):
    points, alone = samples("torus", 2000), surface_of("torus", 2000)
    found = analysed(medial, points, bounding_sphere=sphere).tight_cocone
    assert_watertight(points, found)
    assert np.array_equal(found.samples, alone.samples) and found.on_surface.all()
    assert len(found.cell_side) == 0 and found.timings == {} and alone.timings
    if not sphere:
        for name in ("triangles", "flat", "good"):
            assert np.array_equal(getattr(found, name), getattr(alone, name)), name


SMALL = ["3holes.off", "knot1.off", "hand_closed.obj", "spot_low.obj", "rocker-arm.off"]
BIG = ["mannequin.off", "screwdriver.off", "dilo.off", "igea.ply"]


@pytest.mark.parametrize("file", SMALL + [pytest.param(x, marks=pytest.mark.slow) for x in BIG])
def test_meshes_without_their_faces(medial, data_file, file):
    """Almost the same inner axis as with them."""
    points, triangles = meshes.read(data_file(file))
    wanted, found = (
        selected_inner(medial, medial.MedialAnalysis(points, triangles, sides=sides))
        for sides in (medial.SidesFrom.SURFACE, medial.SidesFrom.TIGHT_COCONE)
    )
    assert jaccard(wanted, found) >= 0.97


def test_repeated_rows_are_one_sample(medial, surface_of):
    points, plain = samples("torus", 2000), surface_of("torus", 2000)
    repeated = medial.TightCocone(np.concatenate((points, points[:300])))
    assert repeated.duplicates == 300
    assert np.array_equal(repeated.triangles, plain.triangles)
    assert np.array_equal(repeated.samples, plain.samples)


def cylinder(around=40, up=20):
    turn = np.arange(around) * 2 * np.pi / around
    ring = np.column_stack((np.cos(turn), np.sin(turn)))
    side = [np.column_stack((ring, np.full(around, z))) for z in np.linspace(0.0, 3.0, up)]
    disc = [np.column_stack((ring * r, np.zeros(around))) for r in (0.25, 0.5, 0.75)]
    disc = np.concatenate((np.zeros((1, 3)), *disc))
    return np.concatenate((*side, disc, disc + np.array([0.0, 0.0, 3.0])))


GRIDS = {
    "box": meshes.box((16, 12, 8))[0],
    "uv sphere": meshes.uv_sphere(32, 16)[0],
    "uv ellipsoid": meshes.uv_sphere(32, 16)[0] * (1.0, 0.8, 0.6),
    "icosphere": meshes.icosphere(3)[0],
    "torus": meshes.torus()[0],
    "cylinder": cylinder(),
}


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("name", GRIDS)
def test_grids(study, name, turned):
    """Cospherical and coplanar samples, sharp edges: exact all the same, but for a corner of a box cut off."""
    points = GRIDS[name] @ inputs.rotation(5).T if turned else GRIDS[name]
    surface = assert_promises(study, points)
    assert topology.euler(surface.triangles) == (0 if name == "torus" else 2)
    assert topology.components(surface.triangles) == 1 and surface.nonmanifold_vertices == 0
    is_corner = (np.abs(GRIDS["box"]) == GRIDS["box"].max(axis=0)).all(axis=1)
    assert (surface.on_surface | is_corner).all() if name == "box" else surface.on_surface.all()
    assert (~surface.on_surface).sum() <= 4


def test_an_open_surface_is_closed(medial):
    """A hemisphere: the hole gets a lid."""
    ball = samples("sphere", 4000)
    points = ball[ball[:, 2] > 0.0]
    surface = medial.TightCocone(points)
    assert_watertight(points, surface)
    assert topology.euler(surface.triangles) == 2 and surface.on_surface.mean() > 0.99
    assert topology.volume(points, surface.triangles) == pytest.approx(2 * np.pi / 3, rel=0.1)


def test_a_closed_cavity_is_filled_and_counted(study):
    """Flooding from infinity cannot see it."""
    solid = Filled(SHAPES["shell"])
    points = solid.sample(6000, 0)
    surface = study.TightCocone(points)
    assert_watertight(points, surface)
    outer = solid.shell.field(points) > -1e-9
    outer &= np.abs(solid.field(points)) < 1e-9
    assert np.array_equal(surface.on_surface, outer) and 1000 < outer.sum() < 5000
    assert topology.euler(surface.triangles) == 2 and surface.cavities == 1
    rows, centres = far_cells(study, points, solid.shell)
    inside = solid.inside(centres)
    assert np.array_equal(surface.cell_side[rows] == int(study.Side.INNER), inside)


@pytest.mark.parametrize("where", ["outside", "inside"])
def test_isolated_outliers_are_off_the_surface(medial, surface_of, where):
    ball, rng = samples("sphere", 2000), np.random.default_rng(4)
    direction = rng.normal(size=(12, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    reach = rng.uniform(2.0, 4.0, (12, 1)) if where == "outside" else rng.uniform(0.2, 0.6, (12, 1))
    surface = medial.TightCocone(np.concatenate((ball, direction * reach)))
    assert np.array_equal(surface.on_surface, np.arange(len(ball) + 12) < len(ball))
    assert np.array_equal(surface.triangles, surface_of("sphere", 2000).triangles)


@pytest.mark.parametrize(
    "points",
    [
        inputs.grid((2, 2, 2))[[0, 1, 2, 4]],
        np.concatenate((np.eye(3), [[0, 0, 0], [1, 1, 1.0]])),
        inputs.grid((2, 2, 2)),
        np.concatenate((np.eye(3), -np.eye(3))),
        np.random.default_rng(0).random((7, 3)),
    ],
    ids=["tetrahedron", "five", "cube", "octahedron", "seven"],
)
def test_very_few_points(study, points):
    assert_promises(study, points)


def noisy(name, spacings, seed):
    """Samples with a normal error in every coordinate; its deviation in median distances of neighbours."""
    points = samples(name, SIZES.get(name, 2000))
    spacing = np.median(cKDTree(points).query(points, 2)[0][:, 1])
    noise = np.random.default_rng(seed).normal(size=points.shape)
    return points + noise * spacings * spacing


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["torus", "ellipsoid", "genus 2"])
def test_noise_of_a_tenth_of_the_spacing_changes_no_topology(medial, name, seed):
    surface = medial.TightCocone(noisy(name, 0.1, seed))
    assert topology.euler(surface.triangles) == SOLIDS[name].euler
    assert topology.components(surface.triangles) == 1
    assert (~surface.on_surface).mean() < 0.002


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["torus", "ellipsoid", "genus 2"])
def test_noise_of_a_fifth_of_the_spacing_costs_few_samples(medial, surface_of, name, seed):
    points, n = noisy(name, 0.2, seed), SIZES.get(name, 2000)
    surface, clean = medial.TightCocone(points), surface_of(name, n)
    exact = topology.volume(samples(name, n), clean.triangles)
    assert topology.components(surface.triangles) == 1 and (~surface.on_surface).mean() < 0.03
    assert topology.volume(points, surface.triangles) == pytest.approx(exact, rel=0.03)


@pytest.mark.parametrize("spacings", [0.1, 0.3, 1.0, 3.0])
def test_noise_breaks_no_promise(study, spacings):
    assert_promises(study, noisy("torus", spacings, 1))


def test_a_solid_in_pieces_encloses_nothing(study):
    """Dust: some cells stay inside by chance, most samples do not."""
    dust = np.random.default_rng(2).normal(size=(300, 3))
    surface = study.TightCocone(dust)
    assert_watertight(dust, surface)
    used = np.isin(surface.samples, study.delaunay(dust)[0][surface.cell_side == 1])
    assert surface.left_outside == (~used).sum() > 150 and not surface.encloses
    analysis = study.MedialAnalysis(dust)
    for side in (study.Side.INNER, study.Side.OUTER):
        with pytest.raises(study.DegenerateInputError, match="that enclose nothing"):
            analysis.extract(side=side)
    assert len(analysis.extract().generators) > 0


def test_half_of_the_samples_may_be_outliers(medial):
    ball = samples("sphere", 2000)
    far = np.random.default_rng(8).uniform(-9, 9, (500, 3))
    surface = medial.TightCocone(np.concatenate((ball, far[np.linalg.norm(far, axis=1) > 3])))
    assert surface.encloses and surface.on_surface[: len(ball)].mean() > 0.99
