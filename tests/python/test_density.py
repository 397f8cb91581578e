# SPDX-License-Identifier: GPL-3.0-or-later
"""How dense samples are: figures of made-up estimates, and nearness against brute force."""

import numpy as np
import pytest
from medial_axis.core.machine.cache import CACHE
from medial_axis.core.samples import analysis
from medial_axis.core.samples.density import Density, estimate, percent
from medial_axis.core.samples.sampling_report import report_sampling
from medial_axis.core.settings import SamplingMode, Settings
from medial_axis.core.shape.nearness import near
from medial_axis.core.shape.shape import Shape
from support.meshes import icosphere
from support.shapes import SHAPES

RNG = np.random.default_rng(5)


def density(spacing, size, points=None, edges=None, limit=0.25, finest=0.1):
    count = len(spacing)
    points = RNG.normal(size=(count, 3)) if points is None else points
    edges = np.zeros((0, 3)) if edges is None else edges
    return Density(points, np.array(spacing, float), np.array(size, float), edges, finest, limit)


def test_epsilon_is_spacing_by_feature_size_and_infinite_where_nothing_is_known():
    found = density([1, 1, np.inf, 1], [4, np.inf, 1, 0])
    np.testing.assert_array_equal(found.epsilon, [0.25, np.inf, np.inf, np.inf])
    assert found.share == 0.75 and found.median == np.inf


def test_figures_leave_out_what_is_at_sharp_edges():
    points = np.array([[0.0, 0, 0], [0.3, 0, 0], [0.41, 0, 0], [5, 0, 0]])
    found = density([1, 1, 1, 1], [1, 2, 5, 10], points, edges=np.zeros((1, 3)))
    # finest / limit is 0.4: closer than that, 0.25 times the distance is less than 0.1
    assert found.at_edge.tolist() == [True, True, False, False]
    assert (found.share, found.share_of_all) == (0.0, 0.5)
    assert found.p95 == 0.2 and found.dense_enough
    assert str(found).endswith("95 % below 0.20, 0 % above 0.25; with sharp edges 50 %")


def test_everything_at_sharp_edges_is_no_division_by_nothing():
    found = density([1, 1], [1, 2], np.zeros((2, 3)), edges=np.zeros((1, 3)))
    assert (found.share, found.share_of_all, found.worst) == (1.0, 1.0, [])
    assert found.p95 == 1.0 and found.median > found.limit
    assert found.dense_enough  # another pass would be no closer there
    assert str(found).endswith("100 % above 0.25")


def test_worst_places_are_apart_and_in_order():
    points = np.concatenate([RNG.normal(scale=1e-3, size=(50, 3)) + centre for centre in np.eye(3)])
    epsilon = RNG.random(150)
    worst = density(epsilon, np.ones(150), points).worst
    assert len(worst) == 3
    assert [value for _, value in worst] == sorted((value for _, value in worst), reverse=True)
    assert worst[0] == (tuple(points[epsilon.argmax()]), epsilon.max())
    for part, centre in zip(np.split(epsilon, 3), np.eye(3), strict=True):
        assert any(value == part.max() and np.allclose(p, centre, atol=0.01) for p, value in worst)


@pytest.mark.parametrize(
    ("share", "text"),
    [(0, "0 %"), (0.004, "0.4 %"), (0.094, "9.4 %"), (0.12, "12 %"), (1, "100 %")],
)
def test_percent(share, text):
    assert percent(share) == text


def test_nothing_is_near_nothing():
    points = np.zeros((3, 3))
    assert not near(points, np.zeros((0, 3)), 1.0).any()
    assert not near(points, points, 0.0).any()
    assert near(np.zeros((0, 3)), points, 1.0).shape == (0,)


# --- some of many samples


@pytest.fixture(scope="module")
def analysed(medial):
    points = SHAPES["ellipsoid"].random_sample(30_000, 0)
    return medial.MedialAnalysis(points, sides=medial.SidesFrom.NONE), points


def test_some_samples_tell_what_all_would(analysed):
    analysis, points = analysed
    whole = estimate(analysis, points, points[:0], 0.0, 0.05)
    some = estimate(analysis, points, points[:0], 0.0, 0.05, most=5_000)
    assert len(whole.points) == 30_000 and 4_900 < len(some.points) <= 5_000
    assert 0.2 < whole.share < 0.8
    assert abs(some.share - whole.share) < 0.02
    assert some.median == pytest.approx(whole.median, rel=0.02)
    rows = {tuple(point): row for row, point in enumerate(points.tolist())}
    found = [rows[tuple(point)] for point in some.points.tolist()]
    np.testing.assert_array_equal(some.epsilon, whole.epsilon[found])


def test_all_samples_where_there_are_few(analysed):
    analysis, points = analysed
    found = estimate(analysis, points, points[:0], 0.0, 0.05, most=30_000)
    np.testing.assert_array_equal(found.points, points)


def test_a_report_is_of_all_samples(monkeypatch):
    work = Shape(*icosphere(4)), Settings(sampling=SamplingMode.VERTICES)
    whole = report_sampling(*work)
    CACHE.clear()
    monkeypatch.setattr(analysis, "LOOKED_AT", 100)
    some = report_sampling(*work)
    assert len(some.chosen.samples.density.points) <= 100
    np.testing.assert_array_equal(some.epsilon, whole.epsilon)
    assert some.density.share == whole.density.share


def test_samples_at_edges_do_not_make_the_others_dense():
    points = np.array([(0.0, 0.0, 0.0), (5.0, 0.0, 0.0), (9.0, 0.0, 0.0)])
    found = density([1, 1, 1], [1, 1, 1], points, points[:1], limit=0.5)
    assert found.at_edge.tolist() == [True, False, False] and not found.dense_enough
