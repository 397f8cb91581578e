# SPDX-License-Identifier: GPL-3.0-or-later
"""The value of Simplify that a model suggests lies between sheets of noise and those of the body, or there is none."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute, extract_axis
from medial_axis.core.axis.slider_range import length_in_gap
from medial_axis.core.settings import Prepare, SamplingMode, Settings
from support.meshes import box, icosphere

BY_VERTICES = {"sampling": SamplingMode.VERTICES, "prepare": Prepare.OFF}


def gap(values, weights, meant=()):
    stays = np.isin(np.arange(len(values)), meant)
    return length_in_gap(np.array(values), np.array(weights), stays)


def test_the_gap_is_between_noise_and_features():
    rng = np.random.default_rng(8)
    noise, features = rng.lognormal(np.log(0.1), 0.5, size=400), np.array([3.0, 4.0, 8.0])
    values = np.concatenate([noise, features, [np.inf, 0.0]])
    weights = np.concatenate([np.full(400, 0.2 / 400), [0.2, 0.2, 0.4], [5.0, 5.0]])
    assert gap(values, weights) == pytest.approx(np.sqrt(noise.max() * 3.0))
    assert gap(noise, weights[:400]) is None


def test_the_widest_gap_counts():
    assert gap([0.1, 0.4, 4.0], [1.0, 1.0, 8.0]) == pytest.approx(np.sqrt(0.4 * 4.0))
    assert gap([0.1, 4.0, 16.0], [1.0, 1.0, 8.0]) == pytest.approx(np.sqrt(0.1 * 4.0))


@pytest.mark.parametrize(
    ("values", "weights"),
    [
        ([1.0, 2.9], [1.0, 9.0]),  # near each other
        ([1.0, 30.0], [0.9, 99.1]),  # too little to be seen
        ([1.0, 30.0], [51.0, 49.0]),  # most of it would go
        ([1.0], [1.0]),
        ([], []),
        ([np.inf, 0.0], [1.0, 1.0]),
    ],
)
def test_no_gap_is_clear(values, weights):
    assert gap(values, weights) is None


def test_what_is_meant_does_not_go():
    values, weights = [0.1, 1.0, 1.1, 30.0], [1.0, 1.0, 1.0, 9.0]
    assert gap(values, weights) == pytest.approx(np.sqrt(1.1 * 30.0))
    assert gap(values, weights, meant=[1]) == pytest.approx(np.sqrt(0.1 * 1.0))
    assert gap(values, weights, meant=[0]) is None


@pytest.fixture(scope="module")
def rough():
    """An ellipsoid whose vertices have errors of about a quarter of their distance."""
    points, triangles = icosphere(4)
    points = np.asarray(points) * (1.0, 0.7, 0.4)
    noise = np.random.default_rng(1).normal(scale=0.02, size=points.shape)
    settings = Settings(**BY_VERTICES)
    clean, noisy = (compute(each, triangles, settings) for each in (points, points + noise))
    return clean.axis, noisy


def test_a_noisy_ellipsoid_keeps_its_one_sheet(rough):
    clean, noisy = rough
    assert clean.level.gap is None
    sheets = np.unique(noisy.axis.level.sheet)
    assert len(sheets) > 3 and sheets[-2] < noisy.axis.level.gap < sheets[-1]
    # Over four draws of the noise it is 0.89 to 1.07 of that of the clean one.
    assert sheets[-1] == pytest.approx(clean.level.sheet.max(), rel=0.12)
    kept = extract_axis(noisy, Settings(**BY_VERTICES, simplify=noisy.axis.level.gap))
    assert set(kept.level.sheet) == {sheets[-1]} and kept.level.betti == (1, 0, 0)


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (4.0, 4.0, 0.5)])
def test_sheets_into_edges_are_no_noise(scale):
    """The sheets into the edges of a plate are far thinner than its middle."""
    points, triangles = box()
    settings = Settings(sampling=SamplingMode.SURFACE, samples=2000)
    axis = compute(np.asarray(points) * scale, triangles, settings).axis
    assert len(np.unique(axis.level.sheet)) > 3 and axis.level.gap is None
