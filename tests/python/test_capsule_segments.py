# SPDX-License-Identifier: GPL-3.0-or-later
"""Segments for capsules, and what they are chosen by: places, radii, merges. Exact shapes; volumes by formula."""

from functools import cache

import medial_axis
import numpy as np
import pytest
from medial_axis.core.cover import capsule_segments
from medial_axis.core.cover.capsule_fits import fitting_radii, gaps
from medial_axis.core.cover.capsule_segments import evenly, places_inside, segments_of
from support import meshes, swept

ROD = swept.capsule(4.0, 0.3, 64)


@cache
def dumb_bell():
    """A rod of radius 0.12 and length 8 with a bulge of radius 0.62 in the middle and pointed ends."""
    z = np.linspace(-4.0, 4.0, 97)
    r = 0.12 + 0.5 * np.exp(-((z / 0.8) ** 2))
    r[[0, -1]] = 0.0
    return meshes.lathe(np.column_stack([r, z]), 16)


def places_of(mesh):
    return places_inside(*mesh, 4000), mesh[0]


@pytest.mark.parametrize("count", [1, 1000, 20_000])
def test_places_inside_are_in_the_solid_and_as_many_as_wanted(medial, count):
    places = places_inside(*ROD, count)
    assert (medial.winding_number(places, *ROD) > 0.5).all()
    assert 0.5 * count <= len(places) <= 2 * count + 8


def test_places_of_a_thin_solid_are_bounded_by_its_box(monkeypatch):
    monkeypatch.setattr(capsule_segments, "_IN_BOX", 20_000)
    shear = np.array([(1.0, 0, 0), (0, 1e-3, 0), (1.0, 0, 1.0)])
    thin = (ROD[0][:, :, None] * shear).sum(axis=1)
    assert 100 < len(places_inside(thin, ROD[1], 20_000)) < 20_000


def test_evenly_keeps_at_most_so_many():
    places = np.arange(30.0).reshape(10, 3)
    assert [len(evenly(places, count)) for count in (1, 3, 9, 10, 99)] == [1, 3, 5, 10, 10]


@pytest.mark.parametrize("radii", [(0.3, 0.3), (0.5, 0.2), (0.1, 0.9), (0.2, 3.0)])
def test_gaps_are_those_of_balls_along_a_capsule(radii):
    ends, radii = np.array([(0.1, 0, 0), (0, 0.2, 2.0)]), np.array(radii)
    places = np.random.default_rng(0).normal(size=(300, 3)) * 2.0
    share = np.linspace(0.0, 1.0, 2001)[:, None]
    centres, sizes = ((1 - share) * each[0] + share * each[1] for each in (ends, radii))
    away = np.linalg.norm(places[:, None] - centres, axis=2) - sizes[:, 0]
    np.testing.assert_allclose(gaps(places, ends, radii), away.min(axis=1), atol=2e-3)


@pytest.mark.parametrize("tapered", [True, False])
def test_radii_are_those_that_the_compiled_module_finds(medial, tapered):
    """Segments at random in a bulge: those that fit become capsules of these radii, others balls at an end."""
    mesh = dumb_bell()
    places = np.random.default_rng(2).uniform((-0.3, -0.3, -2.0), (0.3, 0.3, 2.0), (120, 3))
    places = places[medial.winding_number(places, *mesh) > 0.5]
    ends = places[: len(places) // 2 * 2].reshape(-1, 2, 3)
    radii, fits = fitting_radii(ends, medial.TriangleTree(*mesh), tapered)
    assert 5 < fits.sum() < len(ends) - 5
    for row in np.flatnonzero(fits):
        one = medial.cover_by_capsules(
            ends[row], np.array([(0, 1)], np.int32), *mesh, mode=medial.CoverMode.INSIDE,
            tapered=tapered, places=100,
        )  # fmt: skip
        assert np.array_equal(one.ends, ends[row])
        np.testing.assert_allclose(one.radii, radii[row], rtol=0.03, atol=1e-3)


def test_a_segment_that_leaves_the_solid_does_not_fit(medial):
    ring = meshes.torus(1.0, 0.4, 48, 24)
    ends = np.array([[(1.0, 0, 0), (-1.0, 0, 0)], [(1.0, 0, 0), (0.98, 0.2, 0)]])
    assert fitting_radii(ends, medial.TriangleTree(*ring), False)[1].tolist() == [False, True]


@pytest.mark.parametrize("count", [1, 2, 5, 11])
def test_balls_in_a_row_become_so_many_segments(count):
    """Balls along a rod: one capsule holds as much as all of them."""
    centres = np.column_stack([np.zeros((12, 2)), np.linspace(0.0, 4.0, 12)])
    radii = np.full(12, 0.29)
    ends, found = segments_of(centres, radii, count, ROD, places_of(ROD), 0.05, False)
    assert ends.shape == (count, 2, 3) and found.shape == (count, 2)
    places = ends.reshape(-1, 3)
    assert places[:, 2].min() == 0.0 and places[:, 2].max() == 4.0
    assert set(map(tuple, places)) <= set(map(tuple, centres))


def one_segment(bound, places=None):
    """The ends of the only segment in a large and a small ball."""
    mesh = meshes.join(meshes.icosphere(3), meshes.icosphere(3, 0.1, (3.0, 0, 0)))
    centres, radii = np.array([(0.0, 0, 0), (3.0, 0, 0)]), np.array([0.99, 0.099])
    return segments_of(centres, radii, 1, mesh, places or places_of(mesh), bound, False)[0]


def test_a_place_beyond_the_bound_costs_more_than_all_places_inside():
    assert (one_segment(2.5)[..., 0] == 0.0).all()
    few = np.zeros((50, 3)), np.array([(3.1, 0, 0)])
    assert (one_segment(0.05, few)[..., 0] == 3.0).all()


def test_a_bound_of_0_grows_until_it_can_be_kept():
    ends = one_segment(0.0)
    assert len(ends) == 1 and (ends[..., 0] == 0.0).all()


def covered(mesh, **options):
    return medial_axis.cover_by_balls(*mesh, sampling="vertices", **options).balls


def test_a_spindle_has_no_end_bare():
    """No 16 capsules of one radius keep the first bound; counting places beyond it left 0.47 of this length of 8."""
    z = np.linspace(-4.0, 4.0, 81)
    r = 0.5 * (1.0 - np.abs(z) / 4.0)
    mesh = meshes.lathe(np.column_stack([r, z]), 24)
    balls, found = (covered(mesh, count=16, shapes=shapes) for shapes in ("balls", "capsules"))
    assert found.farthest < balls.farthest and found.covered > balls.covered


@pytest.mark.parametrize("shapes", ["capsules", "tapered"])
def test_thin_ends_are_not_left_bare(shapes):
    """Edges of a small mesh end where the depth is 0; capsules round them left 3.4 of this body's 8 bare."""
    balls, found = (covered(dumb_bell(), count=8, shapes=each) for each in ("balls", shapes))
    assert found.count <= 8 and found.outside == 0.0
    assert found.farthest < 0.5 * balls.farthest and found.covered > balls.covered + 0.2
    around = covered(dumb_bell(), count=8, shapes=shapes, mode="around")
    assert around.farthest == 0.0 and around.outside < 0.5 * balls.farthest
