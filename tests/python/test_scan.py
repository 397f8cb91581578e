# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans, judged by shapes whose surfaces are known exactly: what is measured, and where points are moved."""

from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.samples.sampling_report import report_sampling
from medial_axis.core.samples.scan import Scan, prepared, scan_warnings
from medial_axis.core.settings import Prepare, Settings, SidesFrom
from medial_axis.core.shape.shape import Shape
from scipy.spatial import cKDTree
from support.data import DATA
from support.shapes import SHAPES, Sphere

NO_FACES = np.zeros((0, 3), np.int32)
COUNT = 4000


def noisy(shape, noise, count=COUNT, seed=1):
    """Samples with errors of so many spacings, and the spacing."""
    clean = shape.sample(count, seed)
    spacing = float(np.median(cKDTree(clean).query(clean, 2)[0][:, 1]))
    errors = np.random.default_rng(seed).normal(size=clean.shape)
    return clean + noise * spacing * errors, spacing


def prepare(points, **options):
    return prepared(Shape(points, NO_FACES), Settings(**options))


def assert_the_same(points, **options):
    shape = Shape(points, NO_FACES)
    assert prepared(shape, Settings(**options))[0] is shape


@pytest.mark.oracle
@pytest.mark.parametrize("name", ["ellipsoid", "torus", "box"])
@pytest.mark.parametrize("noise", [0.1, 0.25, 0.5, 1.0])
def test_noise_is_measured(medial, name, noise):
    points, spacing = noisy(SHAPES[name], noise, 8000)
    found = medial.measure_scan(points)
    assert found.spacing == pytest.approx(spacing, rel=0.05)
    assert found.noise == pytest.approx(noise * spacing, rel=0.1)


@pytest.mark.oracle
@pytest.mark.parametrize("noise", [0.1, 0.35])
def test_noise_of_thin_walls_is_measured(medial, noise):
    """Walls of three spacings: only small neighbourhoods have one wall, and larger ones a plateau of two."""
    points, spacing = noisy(SHAPES["shell"], noise, 12_000)
    found = medial.measure_scan(points)
    assert found.noise == pytest.approx(noise * spacing, rel=0.1)
    assert found.kurtosis > 2.3 and found.mates == 0.0


@pytest.mark.oracle
@pytest.mark.parametrize("name", ["ellipsoid", "torus", "box", "slab", "knot", "shell"])
def test_clean_points_stay_the_same(name):
    for wanted in (Prepare.AUTOMATIC, Prepare.ALWAYS):
        assert_the_same(noisy(SHAPES[name], 0.0)[0], prepare=wanted)


@pytest.mark.skipif(not DATA.is_dir(), reason=f"needs {DATA}")
@pytest.mark.parametrize("name", ["dilo.off", "openscad-nonmanifold-crash.obj", "rocker-arm.off"])
def test_vertices_of_meshes_are_clean(name):
    assert_the_same(read_shape(DATA / name)[0].points)


def test_outliers_leave_and_nothing_else():
    points, spacing = noisy(SHAPES["torus"], 0.0)
    away = np.array([[0.0, 0.0, k * 12.0 * spacing] for k in range(1, 7)])
    found, scan = prepare(np.vstack([away[:3], points, away[3:]]))
    assert scan.outliers == 6
    assert found.rows.tolist() == list(range(3, 3 + len(points)))
    assert np.array_equal(found.points, points)


def test_duplicates_and_borders_are_counted(medial):
    xy = np.random.default_rng(0).random((3000, 2))
    sheet = np.column_stack([xy, 0.1 * np.sin(5 * xy[:, 0])])
    found = medial.measure_scan(np.vstack([sheet, sheet[:7]]))
    assert found.duplicates == 7 and found.border > 0.02
    assert medial.measure_scan(noisy(Sphere(), 0.0)[0]).border == 0.0


def test_layers_are_told_from_errors(medial):
    points, spacing = noisy(Sphere(), 0.0)
    apart = points * (1.0 + spacing * np.where(np.arange(len(points)) % 2, 0.5, -0.5))[:, None]
    assert medial.measure_scan(apart).kurtosis < 1.7
    assert 2.5 < medial.measure_scan(noisy(Sphere(), 0.5)[0]).kurtosis < 3.2


@pytest.mark.parametrize("apart", [0.5, 1.0, 2.0])
def test_views_that_do_not_fit_are_told_from_errors(medial, apart):
    """Each of four views lies off as a whole, so that pairs of one view have the same height."""
    points, spacing = noisy(SHAPES["torus"], 0.0, 8000)
    rng = np.random.default_rng(3)
    away = rng.normal(size=(4, 3))
    away *= apart * spacing / np.linalg.norm(away, axis=1)[:, None]
    found = medial.measure_scan(points + away[rng.integers(0, 4, len(points))])
    assert found.noise > 0.1 * found.spacing and found.mates > 1.45


@pytest.mark.oracle
@pytest.mark.parametrize("name", ["torus", "box", "knot"])
@pytest.mark.parametrize("noise", [0.25, 0.5, 1.0])
def test_errors_have_few_pairs_at_the_same_height(medial, name, noise):
    assert 0.8 < medial.measure_scan(noisy(SHAPES[name], noise, 8000)[0]).mates < 1.3


@pytest.mark.parametrize("noise", [0.25, 0.5, 1.0])
def test_points_come_to_lie_on_the_sphere(noise):
    """Without bias: the mean of what is left is small against its spread, and that against the new spacing."""
    points, spacing = noisy(Sphere(), noise)
    found, scan = prepare(points)
    radius = np.linalg.norm(found.points, axis=1)
    left = radius - np.linalg.norm(Sphere().sample(10), axis=1).mean()
    apart = np.median(cKDTree(found.points).query(found.points, 2)[0][:, 1])
    assert left.std() < 0.1 * apart and abs(left.mean()) < 0.1 * noise * spacing
    assert np.array_equal(scan.moved, np.linalg.norm(found.points - points[found.rows], axis=1))
    # Points off the surface have fewer neighbours, so more of them stay than of the others.
    assert 0.6 < np.median(scan.moved) / (noise * spacing) < 0.9


def test_the_edges_of_the_faces_stay_flat():
    """Inside the faces of a box, points lie on them; only those near its edges may be off."""
    points, spacing = noisy(SHAPES["box"], 0.5, 8000)
    found, _ = prepare(points)
    depth = np.sort(SHAPES["box"].half - np.abs(found.points), axis=1)
    inner = depth[:, 1] > 6 * spacing
    assert inner.sum() > 100
    assert np.sqrt((depth[inner, 0] ** 2).mean()) < 0.15 * spacing


@pytest.mark.parametrize(
    ("name", "betti"), [("ellipsoid", (1, 0, 0)), ("torus", (1, 1, 0)), ("slab", (1, 0, 0))]
)
def test_noise_of_half_a_spacing_leaves_the_topology(name, betti):
    points, _ = noisy(SHAPES[name], 0.5)
    found = compute(points, NO_FACES, Settings())
    assert found.axis.level.betti == betti
    assert found.chosen.samples.rows.max() > len(found.chosen.samples.points)  # of the caller
    assert any("noise of about" in warning for warning in found.warnings)
    off = compute(points, NO_FACES, Settings(prepare=Prepare.OFF))
    assert off.axis.level.betti != betti
    assert any("left as it is" in warning for warning in off.warnings)
    assert not any("too sparse" in warning for warning in (*off.warnings, *found.warnings))


def test_noise_of_thin_walls_leaves_the_topology():
    """Without Prepare there are loops."""
    points, _ = noisy(SHAPES["shell"], 0.25, 12_000)
    found = compute(points, NO_FACES, Settings())
    assert found.axis.level.betti == (1, 0, 1)
    assert any("the points were moved by" in said for said in found.warnings)
    assert not any("do not fit" in said or "layers" in said for said in found.warnings)


def test_the_report_tells_how_far_points_moved():
    points, _ = noisy(SHAPES["torus"], 0.5)
    found = report_sampling(Shape(points, NO_FACES), Settings())
    assert np.array_equal(found.moved, found.chosen.scan.moved)
    clean = report_sampling(Shape(noisy(SHAPES["torus"], 0.0)[0], NO_FACES), Settings())
    assert not clean.moved.any()


CLEAN = Scan(1000, 1000, 0.1, 0.0, 3.0, 1.0, 0, 0, 0.0)


@pytest.mark.parametrize(
    ("found", "sides", "words"),
    [
        ({}, "TIGHT_COCONE", ""),
        ({}, "POLES", "inside is a guess of the poles"),
        ({"noise": 3.0}, "POLES", "too much for so many points"),
        ({"noise": 0.5}, "POLES", "left as it is"),
        ({"noise": 0.5, "moved": np.ones(9)}, "TIGHT_COCONE", "the points were moved by 10 sp"),
        ({"noise": 0.5, "moved": np.ones(9)}, "POLES", "inside is a guess of the poles"),
        ({"noise": 0.5, "kurtosis": 1.2}, "TIGHT_COCONE", "the points lie in layers"),
        ({"noise": 1.5, "kurtosis": 1.2}, "POLES", "walls of a thin part"),
        ({"noise": 1.5, "kurtosis": 1.2, "mates": 2.0}, "POLES", "walls of a thin part"),
        ({"noise": 1.5, "mates": 1.6}, "TIGHT_COCONE", "the scans do not fit each other"),
        ({"mates": 1.6}, "TIGHT_COCONE", ""),
        ({"outliers": 20, "kept": 980}, "TIGHT_COCONE", "stood alone and were left out"),
        ({"outliers": 20}, "TIGHT_COCONE", "which Denoise Automatic leaves out"),
        ({"border": 0.05}, "POLES", "bounds no solid"),
    ],
)
def test_each_cause_has_its_sentence(found, sides, words):
    said = list(scan_warnings(replace(CLEAN, **found), SidesFrom[sides]))
    assert any(words in sentence for sentence in said) if words else not said
