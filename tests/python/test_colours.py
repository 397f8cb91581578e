# SPDX-License-Identifier: GPL-3.0-or-later
"""The scale of colours, judged by CIE L*a*b*: order by brightness, and distance from the greys of viewports."""

import numpy as np
import pytest
from medial_axis.core.axis.colours import SCALE, UNKNOWN, colours, radius_range
from medial_axis.core.thickness.thickness_colours import STEPS, STEPS_BELOW, ThicknessScale

VIEWPORTS = ("#3d3d3d", "#303030", "#646464")  # Blender Dark from top to bottom, Blender Light


def lab(linear):
    """CIE L*a*b* (D65) of (n, 3) linear sRGB."""
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    xyz = np.asarray(linear) @ np.transpose(to_xyz) / (0.9505, 1.0, 1.089)
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    x, y, z = np.moveaxis(f, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def linear(word):
    """Linear RGB of a colour such as '#3d3d3d'."""
    encoded = np.array([int(word[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def whole_scale():
    return colours(np.linspace(2.0, 5.0, 257), 2.0, 5.0)


def test_brightness_tells_the_order():
    lightness = lab(whole_scale()[:, :3])[:, 0]
    assert (np.diff(lightness) > 0).all()
    assert lightness[-1] - lightness[0] > 35


@pytest.mark.parametrize("background", VIEWPORTS)
def test_every_colour_is_seen_on_dark_and_light_viewports(background):
    distance = np.linalg.norm(lab(whole_scale()[:, :3]) - lab(linear(background)), axis=1)
    assert distance.min() > 50  # 2.3 is the least that an eye can tell


def test_the_ends_and_beyond():
    found = colours([-np.inf, 1.0, 3.0, np.inf], 1.0, 3.0)
    first, last = SCALE[0][1], SCALE[-1][1]
    assert found.dtype == np.float32 and found.shape == (4, 4)
    assert np.allclose(found[:, :3], [first, first, last, last])
    assert (found[:, 3] == 1.0).all()


def test_a_range_may_run_backwards():
    values = np.linspace(0.0, 1.0, 11)
    assert np.allclose(colours(values, 1.0, 0.0), colours(values[::-1], 0.0, 1.0))


def test_scale_does_not_matter():
    values = np.random.default_rng(1).random(100)
    huge = colours(values * 2.0**200, 0.0, 2.0**200)
    assert (huge == colours(values, 0.0, 1.0)).all()


def test_one_number_has_the_first_colour_and_nan_is_grey():
    found = colours([4.0, np.nan], 4.0, 4.0)
    assert np.allclose(found[0, :3], SCALE[0][1])
    assert np.allclose(found[1, :3], UNKNOWN)


def test_radii_that_hardly_differ_have_one_colour():
    start, end = radius_range([0.99, 1.0, 1.01])
    assert (start, end) == (1.01, 0.505)
    assert radius_range(np.array([0.25, 1.0])) == (1.0, 0.25)


def test_colours_of_thickness_have_a_hard_edge_at_the_limit():
    scale = ThicknessScale(0.0, 2.0, 6.0)
    found = scale.positions(np.array([0.0, 1.999999, 2.0, 6.0, 9.0, np.inf]))
    assert found[:5] == pytest.approx([1.0, 0.58, 0.3, 0.0, 0.0], abs=1e-6)
    assert np.isnan(found[5])
    assert scale.bounds[STEPS_BELOW] == 2.0 and len(scale.bounds) == STEPS + 1
    without_limit = ThicknessScale(1.0, 1.0, 3.0)
    assert without_limit.positions(np.array([1.0, 2.0, 3.0])) == pytest.approx([1.0, 0.5, 0.0])
    equal = ThicknessScale(2.0, 2.0, 2.0)
    assert equal.positions(np.array([2.0, 2.0])) == pytest.approx([1.0, 1.0])
