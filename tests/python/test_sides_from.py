# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the source of inside and outside: the rule of AUTOMATIC, the vote of normals, and all errors."""

from functools import partial

import numpy as np
import pytest
from support import meshes
from support.shapes import SHAPES
from test_bad_input import assert_refused

pytestmark = pytest.mark.oracle

CLOUD = np.random.default_rng(0).random((50, 3))
CLOSED = meshes.jitter(meshes.icosphere(3), 1e-3)
OPEN = CLOSED[0], CLOSED[1][5:]
OUTWARD = CLOSED[0] / np.linalg.norm(CLOSED[0], axis=1)[:, None]


def analysis_of(medial, points, triangles=None, sides="AUTOMATIC", **options):
    return medial.MedialAnalysis(
        points, triangles, sides=getattr(medial.SidesFrom, sides), **options
    )


@pytest.mark.parametrize(
    "triangles, normals, chosen",
    [
        (CLOSED[1], None, "SURFACE"),
        (CLOSED[1], -OUTWARD, "SURFACE"),
        (OPEN[1], OUTWARD, "NORMALS"),
        (None, OUTWARD, "NORMALS"),
        (CLOSED[1][:0], OUTWARD, "NORMALS"),
        (OPEN[1], None, "TIGHT_COCONE"),
        (None, None, "TIGHT_COCONE"),
        (CLOSED[1][:0], None, "TIGHT_COCONE"),
    ],
)
def test_automatic(medial, triangles, normals, chosen):
    """The faces when they close a volume, else the normals, else Tight Cocone; an explicit choice gives the same."""
    found = medial.MedialAnalysis(CLOSED[0], triangles, normals=normals)
    assert found.sides_from == getattr(medial.SidesFrom, chosen)
    assert medial.automatic_sides(triangles is CLOSED[1], normals is not None) == found.sides_from
    assert (found.tight_cocone is None) == (chosen != "TIGHT_COCONE")
    asked = analysis_of(medial, CLOSED[0], triangles, chosen, normals=normals)
    assert asked.sides_from == found.sides_from and np.array_equal(asked.side, found.side)
    assert (found.side == int(medial.Side.INNER)).sum() > 500


@pytest.mark.parametrize("chosen", ["SURFACE", "NORMALS", "TIGHT_COCONE", "POLES", "NONE"])
def test_what_is_asked_for_is_used(medial, chosen):
    """The choice holds even if everything is given; the faces are examined all the same."""
    analysis = analysis_of(medial, *OPEN, chosen, normals=OUTWARD)
    assert analysis.sides_from == getattr(medial.SidesFrom, chosen)
    assert (analysis.tight_cocone is None) == (chosen != "TIGHT_COCONE")
    assert not analysis.closed and analysis.boundary_edges > 0
    assert (analysis.side == 0).all() == (chosen == "NONE")


@pytest.mark.parametrize("triangles", [None, np.empty((0, 3), np.int32)])
def test_a_surface_needs_triangles(medial, triangles):
    with pytest.raises(medial.InvalidInputError, match="triangles|faces"):
        analysis_of(medial, CLOUD, triangles, "SURFACE")


def test_normals_must_be_given(medial):
    for triangles in (None, meshes.icosphere(1)[1]):
        call = partial(analysis_of, medial, CLOUD, triangles, "NORMALS")
        assert "normals" in assert_refused(medial.InvalidInputError, call)


def with_value(value):
    normals = CLOUD.copy()
    normals[31, 2] = value
    return normals


@pytest.mark.parametrize("sides", ["AUTOMATIC", "NORMALS"])
@pytest.mark.parametrize(
    "normals",
    [
        CLOUD[:, :2],
        CLOUD[:-1],
        CLOUD.ravel(),
        CLOUD[None],
        np.concatenate((CLOUD, CLOUD)),
        CLOUD[:0],
        CLOUD.astype(int),
        CLOUD > 0.5,
        CLOUD.astype(complex),
        CLOUD.astype(str),
        with_value(np.nan),
        with_value(np.inf),
    ],
)
def test_normals_of_a_wrong_shape_type_or_value(medial, sides, normals):
    call = partial(analysis_of, medial, CLOUD, sides=sides, normals=normals)
    assert "normal" in assert_refused(medial.InvalidInputError, call)


def test_normals_that_are_not_finite_name_their_row(medial):
    with pytest.raises(medial.InvalidInputError, match=r"\b31\b"):
        analysis_of(medial, CLOUD, normals=with_value(np.nan))


@pytest.mark.parametrize("side", ["INNER", "OUTER"])
def test_a_side_needs_sides(medial, side):
    analysis = analysis_of(medial, CLOUD, sides="NONE")
    for call in (analysis.select, analysis.extract):
        assert_refused(medial.InvalidInputError, partial(call, side=getattr(medial.Side, side)))


@pytest.mark.parametrize("value", ["TIGHT_COCONE", 3, None])
def test_sides_of_a_wrong_type(medial, value):
    with pytest.raises(TypeError):
        medial.MedialAnalysis(CLOUD, sides=value)


# name -> the paper's value, which is the default; the largest one; another one
OPTIONS = {
    "cocone_angle": (np.pi / 8, np.pi / 2, 0.02),
    "flatness_ratio": (1.2, np.inf, 4.0),
    "flatness_angle": (np.pi / 3, np.pi / 2, 0.02),
    "sharp_angle": (2 * np.pi / 3, np.pi, 0.2),
}


def test_defaults_are_the_papers(medial):
    options = medial.CoconeOptions()
    for name, (value, _, _) in OPTIONS.items():
        assert getattr(options, name) == pytest.approx(value, rel=1e-15)
        with pytest.raises(AttributeError):
            setattr(options, name, value)
    with pytest.raises(TypeError):
        medial.CoconeOptions(np.pi / 8)


@pytest.mark.parametrize("name", OPTIONS)
def test_ranges_of_the_options(medial, name):
    limit = OPTIONS[name][1]
    for bad in (0.0, -1e-9, limit, np.nan, -np.inf, np.inf):
        call = partial(medial.CoconeOptions, **{name: bad})
        assert name in assert_refused(medial.InvalidInputError, call)
    for good in (1e-9, min(limit, 1e9) * 0.999):
        assert getattr(medial.CoconeOptions(**{name: good}), name) == good


@pytest.mark.parametrize("name", OPTIONS)
def test_every_option_has_an_effect(medial, name):
    """On the surface alone and as an argument of an analysis, alike."""
    points = SHAPES["torus"].random_sample(1500, 0)
    changed = medial.CoconeOptions(**{name: OPTIONS[name][2]})
    plain, other = medial.TightCocone(points), medial.TightCocone(points, options=changed)
    figures = lambda x: (x.flat.tobytes(), x.good.tobytes(), x.triangles.tobytes())
    assert figures(plain) != figures(other)
    analysis = analysis_of(medial, points, sides="TIGHT_COCONE", cocone=changed)
    assert figures(analysis.tight_cocone) == figures(other)


def test_normals_say_nothing_beyond_the_samples(medial):
    """Through the opening of a box far Voronoi vertices see the walls from behind; they are not inside."""
    vertices, triangles = meshes.box((6, 6, 6), (1.0, 0.7, 0.4))
    keep = (vertices[triangles][:, :, 2] < 0.39).any(axis=1)
    samples = medial.sample_surface(vertices, triangles[keep], count=4000)
    analysis = analysis_of(medial, samples.points, sides="NORMALS", normals=samples.normals)
    inner = analysis.extract(side=medial.Side.INNER)
    assert len(inner.generators) > 1000
    assert (np.abs(inner.vertices) <= np.abs(samples.points).max(axis=0)).all()
