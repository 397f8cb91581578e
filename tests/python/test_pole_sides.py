# SPDX-License-Identifier: GPL-3.0-or-later
"""Inside from labels of poles: equal to a plain reading of the rule, right where Tight Cocone is not, chosen there."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.settings import Prepare, SamplingMode, Settings, Side, SidesFrom
from support import inputs, measure, meshes
from support.measure import jaccard, selected_inner
from support.pole_labels_reference import Labels
from support.shapes import SHAPES

pytestmark = pytest.mark.oracle


def poles(medial, points, **options):
    return medial.MedialAnalysis(points, sides=medial.SidesFrom.POLES, **options)


def exactly_inner(medial, points, shape):
    """The selected facets all of whose vertices lie inside the shape."""
    mesh = medial.MedialAnalysis(points, sides=medial.SidesFrom.NONE).extract()
    return set(map(tuple, mesh.generators[measure.inner_facets(mesh, shape)].tolist()))


def flat(medial, points):
    return medial.TightCocone(points).flat.astype(bool)


@pytest.mark.parametrize("name", ["shell", "ellipsoid", "torus", "knot", "box", "slab"])
@pytest.mark.parametrize("n, seed", [(400, 0), (900, 1)])
def test_sides_equal_those_of_the_reference(study, name, n, seed):
    points = np.unique(SHAPES[name].sample(n, seed), axis=0)
    normals = assert_as_the_reference(study, points)
    assert np.count_nonzero(normals.any(axis=1)) > 0.5 * len(points)


def assert_as_the_reference(study, points):
    normals = Labels(study, points, flat(study, points)).normals()
    expected = study.MedialAnalysis(points, normals=normals, sides=study.SidesFrom.NORMALS)
    assert np.array_equal(poles(study, points).side, expected.side)
    return normals


@pytest.mark.parametrize("seed", range(12))
def test_random_points_equal_the_reference(study, seed):
    assert_as_the_reference(study, np.random.default_rng(seed).normal(size=(60, 3)))


def test_poles_that_both_sides_claim_come_last(study):
    """Only this seed notices another order of the poles, so the test runs it every time."""
    test_random_points_equal_the_reference(study, 7)


@pytest.mark.parametrize("seed", range(3))
def test_thin_shell_is_told_exactly(medial, seed):
    """A wall hardly thicker than the spacing, about a cavity: Tight Cocone finds a third of its facets, poles all."""
    shape = SHAPES["shell"]
    points = shape.sample(2000, seed)
    exact = exactly_inner(medial, points, shape)
    analysis = medial.MedialAnalysis(points)
    assert analysis.sides_from == medial.SidesFrom.POLES and analysis.tight_cocone is None
    assert analysis.pole_disagreement > 0.2
    assert selected_inner(medial, analysis) == exact
    cocone = medial.MedialAnalysis(points, sides=medial.SidesFrom.TIGHT_COCONE)
    assert jaccard(selected_inner(medial, cocone), exact) < 0.5


def test_shell_keeps_its_cavity(medial):
    shape = SHAPES["shell"]
    points = shape.sample(8000, 0)
    hierarchy = medial.MedialAnalysis(points).hierarchy()
    clean = hierarchy.extract(spacings=1.0, round_limbs=True, relaxed=True)
    assert hierarchy.betti == (1, 0, 1) and clean.betti == (1, 0, 1)
    assert measure.errors(clean, shape).output_mean <= 0.0021


@pytest.mark.parametrize("name", ["ellipsoid", "torus", "knot", "box"])
def test_automatic_stays_with_tight_cocone_where_that_is_right(medial, name):
    points = SHAPES[name].sample(2000, 0)
    analysis = medial.MedialAnalysis(points)
    assert analysis.sides_from == medial.SidesFrom.TIGHT_COCONE
    assert analysis.pole_disagreement < 0.02
    asked = medial.MedialAnalysis(points, sides=medial.SidesFrom.TIGHT_COCONE)
    assert np.array_equal(analysis.side, asked.side) and asked.pole_disagreement is None


MESHES = {
    "engine_parts.ply": ("POLES", 0.97),
    "hand_closed.obj": ("TIGHT_COCONE", 0.999),
    "fandisk_large.off": ("TIGHT_COCONE", 0.998),
    "dilo.off": ("TIGHT_COCONE", 0.999),
    "rocker-arm.off": ("TIGHT_COCONE", 0.999),
    "knot1.off": ("TIGHT_COCONE", 1.0),
    "human_woman.obj": ("TIGHT_COCONE", 0.97),
}


@pytest.mark.parametrize("file", MESHES)
def test_meshes_without_their_faces(medial, data_file, file):
    points, triangles = meshes.read(data_file(file))
    chosen, least = MESHES[file]
    analysis = medial.MedialAnalysis(points)
    assert analysis.sides_from == getattr(medial.SidesFrom, chosen)
    by_faces = medial.MedialAnalysis(points, triangles, sides=medial.SidesFrom.SURFACE)
    assert jaccard(selected_inner(medial, analysis), selected_inner(medial, by_faces)) >= least


@pytest.mark.parametrize("name", ["ellipsoid", "torus", "knot"])
def test_outliers_do_not_turn_it_inside_out(medial, name):
    shape = SHAPES[name]
    points = shape.sample(4000, 0)
    box = np.abs(points).max(axis=0)
    strange = np.random.default_rng(1).uniform(-1, 1, (len(points) // 20, 3)) * box
    points = np.concatenate([points, strange])
    found = selected_inner(medial, poles(medial, points))
    assert jaccard(found, exactly_inner(medial, points, shape)) > 0.97


NO_FACES = np.zeros((0, 3), np.int32)
WORDS = {"openings": "times as long as most", "off": "not on the surface that the poles tell"}


def told(points, faces=NO_FACES, **options):
    """Return what is said of points whose inside the poles tell, and which of the words are in it."""
    found = compute(points, faces, Settings(prepare=Prepare.OFF, **options))
    assert found.settings.sides is SidesFrom.POLES
    said = " ".join(found.warnings)
    return said, {name for name, words in WORDS.items() if words in said}


def with_a_hole(name, n=4000, wide=0.25):
    """Samples but for those near the highest one, within so many diagonals."""
    points = SHAPES[name].sample(n, 0)
    away = np.linalg.norm(points - points[points[:, 2].argmax()], axis=1)
    return points[away > wide * np.linalg.norm(np.ptp(points, axis=0))]


@pytest.mark.parametrize("name", ["torus", "ellipsoid", "box"])
def test_wide_openings_are_told(name):
    """The torus needs no choice: Automatic takes the poles."""
    points = with_a_hole(name)
    sides = SidesFrom.AUTOMATIC if name == "torus" else SidesFrom.POLES
    assert told(points, sides=sides)[1] == {"openings"}


def test_points_off_the_surface_are_told():
    """The poles find an eighth of the facets of a shell whose wall is thinner than the spacing."""
    said, causes = told(SHAPES["shell"].sample(700, 0))
    assert causes == {"off"} and "23 of 696 points" in said


@pytest.mark.parametrize("n", [1000, 2000, 8000])
def test_nothing_is_told_where_walls_are_thin_and_right(medial, n):
    """Most of its points may be not flat, and the inside is right all the same: that is no cause for a warning."""
    points = SHAPES["shell"].sample(n, 0)
    assert n == 8000 or np.mean(~flat(medial, points)) > 0.7
    assert told(points)[1] == set()


@pytest.mark.parametrize("name", ["ellipsoid", "torus", "knot", "box", "slab"])
def test_nothing_is_told_of_clean_samples(name):
    assert told(SHAPES[name].sample(2000, 0), sides=SidesFrom.POLES)[1] == set()


def test_a_sheet_is_told():
    """A bowl: nothing is inside, and neither theta nor rho is the cause."""
    xy = np.random.default_rng(0).uniform(-1, 1, (1500, 2))
    bowl = np.column_stack([xy, 0.1 * (xy**2).sum(axis=1)])[(xy**2).sum(axis=1) < 1.0]
    said, _ = told(bowl, sides=SidesFrom.POLES)
    assert f"{len(bowl):,} of {len(bowl):,} points are not on the surface" in said
    assert "no facet lies inside the surface that the poles tell" in said


def test_faces_that_bound_nothing_are_told():
    points = SHAPES["shell"].sample(2000, 0)
    faces = np.arange(30, dtype=np.int32).reshape(-1, 3)
    said, _ = told(points, faces, sampling=SamplingMode.VERTICES, side=Side.BOTH)
    assert "the 10 faces bound nothing, so their points were read as a cloud" in said


def test_bounding_sphere_leaves_the_inner_facets(medial):
    points = SHAPES["shell"].sample(2000, 0)
    plain, within = (poles(medial, points, bounding_sphere=sphere) for sphere in (False, True))
    assert selected_inner(medial, within) == selected_inner(medial, plain)


STRUCTURED = inputs.structured_cases()


@pytest.mark.parametrize("name", STRUCTURED)
def test_structured_points_have_sides(medial, name):
    """Grids, hollow boxes, prisms: many cospherical cells, and samples on no smooth surface."""
    sides = {medial.Side.INNER, medial.Side.OUTER, medial.Side.CROSSING}
    assert set(poles(medial, STRUCTURED[name]).side.tolist()) <= set(map(int, sides))
