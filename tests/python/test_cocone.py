# SPDX-License-Identifier: GPL-3.0-or-later
"""Cocone's thin and flat samples and its candidates equal the brute-force restatement as sets.

Where rounding may decide a comparison the reference gives two answers and the module's lies between; there are few.
"""

from functools import cache

import numpy as np
import pytest
from support import inputs, reference
from support.cocone_reference import Cocone
from support.shapes import SHAPES
from support.solids import SOLIDS

pytestmark = pytest.mark.oracle

OPTIONS = {
    "default": {},
    "wide cocone": {"cocone_angle": 0.7},
    "narrow cocone": {"cocone_angle": 0.05},
    "low ratio": {"flatness_ratio": 0.4},
    "high ratio": {"flatness_ratio": 2.5},
    "strict angle": {"flatness_angle": 0.2},
    "strict and low": {"flatness_ratio": 0.2, "flatness_angle": 0.3},
}


def noisy(points, share, seed=0):
    """Points moved by a normal error of a share of their box's diagonal."""
    size = np.linalg.norm(np.ptp(points, axis=0))
    return points + np.random.default_rng(seed).normal(size=points.shape) * share * size


def clouds():
    for seed, kind in enumerate(inputs.KINDS):
        for n in (8, 20, 60, 200):
            yield f"{kind} {n}", inputs.generic(kind, n, 50 + seed)
    for name in ("ellipsoid", "torus", "capsule", "slab", "genus 2"):
        points = SOLIDS[name].shape.sample(190, 1)
        yield f"{name} evenly", points
        for percent in (0.3, 1, 3):
            yield f"{name} noise {percent} %", noisy(points, percent / 100)
    yield "shell evenly", SHAPES["shell"].sample(190, 1)


CLOUDS = dict(clouds())
BOX = SHAPES["box"].sample(190, 1)
COINCIDENT = inputs.structured_cases() | {"box": BOX, "box turned": inputs.turned(BOX, 7, 2, 3, 1)}
STRUCTURED = {  # those of which exact arithmetic settles most
    name: COINCIDENT[name]
    for name in (
        "grid 3x3x3",
        "grid 4x3x2",
        "hollow 6x5x4",
        "flat grid 6x5x2",
        "icosphere",
        "icosphere turned",
        "prism",
        "box mesh",
        "box",
        "box turned",
    )
}


@cache
def medial_of(study, name):
    """The exact Voronoi diagram: of Qhull's cells, or of the module's own where many samples are cospherical."""
    if name in CLOUDS:
        return reference.Medial(CLOUDS[name], reference.delaunay_qhull(CLOUDS[name]))
    cells = study.delaunay(STRUCTURED[name])[0]
    cells = reference.sort_cells(cells[(cells >= 0).all(axis=1)])
    reference.assert_delaunay(STRUCTURED[name], cells)
    return reference.Medial(STRUCTURED[name], cells)


def assert_between(bounds, found):
    surely, possibly = bounds
    assert (found[surely]).all() and not (found & ~possibly).any()


def assert_equals_brute_force(study, name, options):
    expected = Cocone(medial_of(study, name), **OPTIONS[options])
    thin, flat, candidates = study.cocone(
        expected.medial.points, study.CoconeOptions(**OPTIONS[options])
    )
    assert_between(expected.thin, thin)
    assert_between(expected.flat, flat)
    rows = candidates.tolist()
    assert rows == sorted(rows) and all(a < b < c for a, b, c in rows)
    chosen = np.isin(keys(expected.triangles), keys(candidates))
    assert chosen.sum() == len(rows), "a candidate is no Delaunay triangle, or comes twice"
    assert_between(expected.candidates, chosen)


def keys(triangles):
    return triangles.astype(np.int64) @ (1_000_000, 1_000, 1)


@pytest.mark.parametrize("options", OPTIONS)
@pytest.mark.parametrize("name", CLOUDS)
def test_equals_brute_force(study, name, options):
    assert_equals_brute_force(study, name, options)


@pytest.mark.parametrize("name", STRUCTURED)
def test_coplanar_and_cospherical_samples(study, name):
    """On flat faces with Voronoi vertices 1e15 away, too."""
    surely, possibly = Cocone(medial_of(study, name)).candidates
    assert np.mean(surely == possibly) > 0.6 and surely.any()
    assert_equals_brute_force(study, name, "default")


@pytest.mark.turn
def test_rounding_decides_little(study):
    """Rounding rarely matters for clouds in general position; some samples pass each condition and some fail it."""
    for options in OPTIONS:
        found = [Cocone(medial_of(study, name), **OPTIONS[options]) for name in CLOUDS]
        for stage in ("thin", "flat", "candidates"):
            surely, possibly = (
                np.concatenate([getattr(x, stage)[i] for x in found]) for i in (0, 1)
            )
            assert np.mean(surely != possibly) < 0.005, (options, stage)
            assert 0 < surely.sum() < len(surely), (options, stage)


def test_flat_samples_grow(study):
    """Some samples are flat although a cocone neighbour disagrees, and some thin ones stay out."""
    grown = out = 0
    for name in CLOUDS:
        x = Cocone(medial_of(study, name), **OPTIONS["strict and low"])
        at_once = x.thin[0] & (x.agree[0] | ~x.neighbours(x.meets[1])).all(axis=1)
        grown += (x.flat[0] & ~at_once).sum()
        out += (x.thin[0] & ~x.flat[1]).sum()
    assert grown > 50 and out > 50
