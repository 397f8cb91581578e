# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates that are cut out along outlines: bridges no wider than thick are part of the sheet."""

import numpy as np
import pytest
from medial_axis.core.mid_surface.carried_sheets import CarriedSheets
from medial_axis.core.mid_surface.cut_out_plates import cut_out_plate
from medial_axis.core.mid_surface.mid_surface import mid_surface
from medial_axis.core.settings import MidSurfaceSettings, Settings
from medial_axis.core.shape.outward_faces import outward_shape
from support import topology
from support.meshes import join, shape_of
from support.thick_meshes import block
from support.thin_solids import turned, union

T = 0.02
# A frame round a window, which is half a thickness away from the rim.
SIDES = ((0, 0, 0), (0.3, 0.7, T)), ((0.6, 0, 0), (1, 0.7, T))
FRAME = (*SIDES, ((0.3, 0, 0), (0.6, T / 2, T)), ((0.3, 0.4, 0), (0.6, 0.7, T)))
AREA = 0.7 - 0.3 * (0.4 - T / 2)


def sheets(mesh):
    return mid_surface(outward_shape(shape_of(mesh)), Settings(samples=4000), MidSurfaceSettings())


@pytest.mark.parametrize("scale", (1.0, 1e-3))
def test_a_bridge_beside_a_window_belongs_to_the_sheet(scale):
    points, triangles = turned(union(*FRAME), 3)
    found = sheets((points * scale, triangles))
    assert found.sheets == topology.components(found.triangles) == 1
    assert topology.euler(found.triangles) == 0
    area = topology.area(found.vertices, found.triangles)
    assert area == pytest.approx(AREA * scale**2, rel=1e-5)
    np.testing.assert_allclose(found.of_vertices, T * scale, rtol=1e-4)
    assert found.share == pytest.approx(1.0, abs=1e-4) and len(found.part) < 10


def test_plates_that_overlap_are_no_plate():
    """Their flat faces would count twice where they lie in each other: 1.4 in the place of 1.386."""
    found = sheets(join(*(union(((x, 0, 0), (x + 1, 0.7, T))) for x in (0, 0.98))))
    assert 0.97 * 1.386 < topology.area(found.vertices, found.triangles) < 1.387


def middle(mesh, area):
    """The plate that is made of a solid, of whose middle a level square with an area was found."""
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) * area**0.5
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    found = CarriedSheets(corners, triangles, np.zeros(2, np.int32), np.full((2, 3), T))
    return cut_out_plate(outward_shape(shape_of(mesh)), found)


def tapered(by):
    points, triangles = block(1.0, 0.7, T)
    points = points - points.mean(axis=0)
    points[points[:, 2] > 0, :2] *= 1.0 - by
    return points, triangles


def step(height):
    return union(((0, 0, 0), (0.6, 0.7, T)), ((0.6, 0, 0), (1, 0.7, height)))


def split():
    """A plate whose upper face has an edge on one side, and a vertex in its middle on the other."""
    points, triangles = block(1.0, 0.7, T)
    top = np.flatnonzero((points[triangles][:, :, 2] == points[:, 2].max()).all(axis=1))
    a, b = np.intersect1d(*triangles[top])
    new = len(points)
    turns = (np.roll(triangles[top[0]], -k) for k in range(3))
    start, end, apex = next(turn for turn in turns if {*turn[:2]} == {a, b})
    kept = np.delete(triangles, top[0], axis=0)
    pieces = [[start, new, apex], [new, end, apex], [end, new, start]]
    return np.vstack((points, points[[a, b]].mean(axis=0))), np.vstack((kept, pieces))


@pytest.mark.parametrize("make", (lambda: block(1.0, 0.7, T), lambda: tapered(1e-6), split))
def test_the_middle_of_a_plate(make):
    points, triangles = make()
    found = middle((points, triangles), 0.69)
    area = topology.area(found.vertices, found.triangles)
    assert area == pytest.approx(0.7, rel=1e-5)
    heights = found.vertices[found.triangles][:, :, 2]
    assert heights == pytest.approx(points[:, 2].min() + T / 2, abs=1e-9)
    np.testing.assert_allclose(found.at_corners, T, rtol=1e-9)
    assert topology.euler(found.triangles) == 1 and not found.part.any()


@pytest.mark.parametrize(
    "make, area",
    (
        (lambda: tapered(0.01), 0.69),
        (lambda: step(2 * T), 0.98),
        (lambda: step(1.01 * T), 0.7),
        (lambda: block(1.0, 0.7, T), 0.6),
    ),
    ids=["tapered", "a step", "a small step", "more than bridges is missing"],
)
def test_what_is_no_plate(make, area):
    assert middle(make(), area) is None
