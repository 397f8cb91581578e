# SPDX-License-Identifier: GPL-3.0-or-later
"""The slider Spikes: narrow parts of sheets go, rims of broad parts stay, and the topology is that of the solid."""

import medial_axis
import numpy as np
import pytest
from medial_axis.core.axis.levels import hierarchy_of
from support import measure
from support.plates import prism

TAB = 0.15  # half of its width


@pytest.fixture(scope="module")
def tabbed():
    """A plate of 4 by 4 with a tab of 2 by 0.3 at its rim."""
    outline = [(-2.0, -2.0), (2.0, -2.0), (2.0, -TAB), (4.0, -TAB)]
    outline += [(x, -y) for x, y in outline[::-1]]
    caps = [(0, 1, 6), (0, 6, 7), (1, 2, 5), (1, 5, 6), (2, 3, 4), (2, 4, 5)]
    points, triangles = prism(outline, caps, 0.1)
    return points - (0.0, 0.0, 0.05), triangles


def shown(shape, **settings):
    found = medial_axis.compute(*shape, sampling="surface", samples=8000, **settings)
    return found, found.axis


def area_of(axis, beyond):
    """The areas up to and beyond a place in X."""
    fans = measure.fan_triangles(axis.vertices, axis.face_offsets, axis.face_vertices)
    size = np.linalg.norm(np.cross(fans[:, 1] - fans[:, 0], fans[:, 2] - fans[:, 0]), axis=1) / 2
    out = fans[:, :, 0].mean(axis=1) > beyond
    return size[~out].sum(), size[out].sum()


def test_a_tab_goes_and_the_plate_keeps_its_rim(tabbed):
    _, whole = shown(tabbed)
    diagonal = np.linalg.norm(np.ptp(tabbed[0], axis=0))
    amount = 100 * 2 * TAB / diagonal
    _, opened = shown(tabbed, spike=amount)
    _, eroded = shown(tabbed, erode=amount)
    body, tab = area_of(whole, 2.2)
    assert area_of(opened, 2.2)[1] < 0.02 * tab < tab
    opened_body, eroded_body = area_of(opened, 2.2)[0], area_of(eroded, 2.2)[0]
    assert opened_body > 0.8 * body, "without the narrow sheets into its edges"
    assert eroded_body < 0.9 * opened_body
    assert opened.level.betti == (1, 0, 0)


def test_levels_are_nested_and_zero_changes_nothing(tabbed):
    found, _ = shown(tabbed)
    hierarchy = hierarchy_of(found.chosen.samples, found.settings, None)
    before = hierarchy.extract(spacings=1.0)
    same = hierarchy.extract(spacings=1.0, spike=0.0)
    assert np.array_equal(before.facet_of, same.facet_of)
    for spike in (0.005, 0.01, 0.03, 0.1):
        level = hierarchy.extract(spacings=1.0, spike=spike)
        assert level.betti == hierarchy.betti
        assert np.isin(level.facet_of, before.facet_of).all()
        assert (hierarchy.facet_spike[level.facet_of] > spike).all()
        before = level
    assert len(before.facet_of) < len(same.facet_of)
