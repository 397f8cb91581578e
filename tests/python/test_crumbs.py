# SPDX-License-Identifier: GPL-3.0-or-later
"""Crumbs: small pieces of a level are known by their size in spacings, and the rest of the axis stays what it was."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.axis.crumbs import crumbs_below, without_crumbs
from medial_axis.core.settings import SamplingMode, Settings
from support import meshes
from support.messy import crossing_plates

SETTINGS = Settings(sampling=SamplingMode.SURFACE, samples=1500)


@pytest.fixture(scope="module")
def plates():
    return compute(*crossing_plates(), SETTINGS).axis


def test_pieces_without_crumbs_are_whole(plates):
    hidden, kept = crumbs_below(plates, 1.0), without_crumbs(plates, 1.0)
    assert 0 < hidden < plates.level.betti[0]
    large = plates.level.crumb >= 1.0
    assert np.array_equal(kept.vertices, plates.vertices[large])
    assert kept.facets == plates.facets
    for before, after in (
        (plates.face_vertices, kept.face_vertices),
        (plates.edges.ravel(), kept.edges.ravel()),
    ):
        where = plates.vertices[before[large[before]]]
        assert np.array_equal(kept.vertices[after], where)
    assert len(kept.level.limb) == len(kept.edges)
    assert len(kept.structure.kind) == len(kept.level.place) == len(kept.vertices)


def test_no_setting_hides_all_and_none_hides_nothing(plates):
    assert without_crumbs(plates, 0.0) is plates
    assert len(without_crumbs(plates, 4.0).vertices) > 0


def test_small_bodies_of_closed_faces_are_no_crumbs():
    large, small = meshes.icosphere(3), meshes.icosphere(1, 0.01, (3.0, 0.0, 0.0))
    axis = compute(*meshes.join(large, small), Settings(sampling=SamplingMode.VERTICES)).axis
    assert axis.level.betti == (2, 0, 0) and crumbs_below(axis, 4.0) == 0
