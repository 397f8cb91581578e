# SPDX-License-Identifier: GPL-3.0-or-later
"""The light is red only where the result cannot be trusted, and no sentence claims what was not counted or measured."""

from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.axis.verdict import Light, verdict
from medial_axis.core.errors import DegenerateInputError, Severe
from medial_axis.core.settings import SamplingMode, Settings, ThicknessSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.thickness.thickness import measure_thickness
from support.meshes import join, shape_of, torus
from support.thick_meshes import block, ellipsoid, lathe

NO_FACES = np.zeros((0, 3), np.int32)


def linked_tubes():
    """Two rings of few faces, one through the other."""
    points, triangles = torus(1.0, 0.25, 24, 8)
    return join((points, triangles), (points[:, [0, 2, 1]] * (1, -1, 1) + (1, 0, 0), triangles))


CUP = [(0.0, 0.0), (0.4, 0.0), (0.5, 1.0), (0.45, 1.0), (0.36, 0.05), (0.0, 0.05)]
SHARP = {
    "linked tubes": (linked_tubes(), "2 pieces, 2 loops, no cavity"),
    "cup": (lathe(CUP), "1 piece, no loop, no cavity"),
}


@pytest.mark.parametrize("name", SHARP)
def test_sharp_edges_make_no_red_light(name):
    """Near a faceted edge every sample is above any epsilon, yet the axis is right."""
    mesh, counted = SHARP[name]
    found = compute_axis(shape_of(mesh), Settings(epsilon=0.05))
    assert found.topology == f"{counted}, as the solid"
    # The walls of the cup are plates, which count as dense enough.
    assert replace(found.chosen.samples.density, paired=None).share > 0.5
    assert not any("too sparse" in warning for warning in found.warnings)
    assert verdict(found.chosen, found.warnings).light is Light.GOOD


def test_sparse_points_are_looked_at():
    points = ellipsoid(subdivisions=2)[0]
    found = compute_axis(Shape(points, NO_FACES), Settings(epsilon=0.05))
    assert any("too sparse" in warning for warning in found.warnings)
    assert not any(isinstance(warning, Severe) for warning in found.warnings)
    assert verdict(found.chosen, found.warnings).light is Light.LOOK
    assert found.topology == "1 piece, no loop, no cavity, by the samples"


def test_missed_walls_are_red():
    found = compute_axis(shape_of(block(1.0, 1.0, 1e-4)), Settings(sampling=SamplingMode.SURFACE))
    assert verdict(found.chosen, found.warnings).light is Light.WRONG


@pytest.mark.parametrize("thickness", [0.002, 0.0003, 1e-5])
def test_samples_on_faces_have_no_noise(thickness):
    plate = shape_of(block(1.0, 1.0, thickness))
    found = measure_thickness(plate, Settings(budget=12_000), ThicknessSettings())
    assert found.noise == 0.0
    assert not any("scatter" in text or "Noise" in text for text in found.warnings)


@pytest.mark.parametrize("copies", (1, 2))
def test_a_twisted_sheet_is_told_to_get_thickness(copies):
    """Lower thresholds would not help: the sheet bounds nothing."""
    corners = [(0.0498759, 0.964456, 0.0949991), (0.042335, 0.96222, 0.0980526)]
    corners += [(0.0418548, 0.961535, 0.096869), (0.049267, 0.963762, 0.0939126)]
    with pytest.raises(DegenerateInputError, match="open sheet.*give it thickness"):
        compute_axis(shape_of((corners, [(3, 2, 1), (3, 1, 0)] * copies)), Settings())
