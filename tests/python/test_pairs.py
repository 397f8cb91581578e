# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples in pairs across thin walls: the product with the option on finds the topology of thin solids."""

import numpy as np
import pytest
from medial_axis import library
from medial_axis.core.samples.surface_samples import _of_rows, are_paired
from medial_axis.core.samples.walls import Walls
from support import thin_solids


def computed(solid, **options):
    return library.compute(*thin_solids.turned(solid.mesh), side="inner", pairs=True, **options)


@pytest.mark.parametrize(
    "solid",
    [
        thin_solids.plate(0.01),
        thin_solids.plate(1e-4),
        thin_solids.profile_t(0.002),
        thin_solids.profile_l(0.002),
        thin_solids.cross(0.004),
        thin_solids.stairs(0.004),
    ],
    ids=["plate", "foil", "T", "L", "cross", "stairs"],
)
def test_flat_thin_walls_have_whole_sheets_with_few_samples(solid):
    found = computed(solid, sampling="surface", samples=4000)
    level = found.axis.level
    assert tuple(level.betti) == solid.betti
    assert len(found.chosen.samples.points) < 4200
    assert not any("walls are closer" in warning for warning in found.warnings)


def test_a_second_pass_follows_curved_walls():
    solid = thin_solids.shell(0.003, subdivisions=4)
    found = computed(solid, samples=4000)
    assert tuple(found.axis.level.betti) == solid.betti
    assert 4500 < len(found.chosen.samples.points) < 60_000


def test_without_the_option_no_sample_has_a_partner():
    points, triangles = thin_solids.turned(thin_solids.plate(0.05).mesh)
    found = library.compute(points, triangles, side="inner", sampling="surface", samples=2000)
    assert found.chosen.samples.partners is None


def test_partners_are_counted_among_the_samples_that_are_kept():
    partners = np.array([3, 2, 1, -1, 1], np.int32)
    assert are_paired(partners).tolist() == [True, True, True, True, True]
    kept = np.array([True, False, True, True, True])
    assert _of_rows(partners, kept).tolist() == [2, -1, -1, -1]


def test_pairs_miss_walls_only_where_these_bend_away():
    walls = Walls(
        points=np.zeros((4, 3)),
        distance=np.full(4, 0.1),
        spacing=np.ones(4),
        area=np.ones(4),
        faces=np.arange(4, dtype=np.int32),
        bend=np.array([0.0, 0.01, 1.0, 0.0]),
        paired=np.array([True, True, True, False]),
    )
    assert walls.missed == 0.5
    places, wanted = walls.wanted(1e-3)
    assert np.allclose(np.sort(wanted), [0.05, np.sqrt(0.025)])
    assert len(places) == 2
