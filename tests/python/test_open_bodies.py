# SPDX-License-Identifier: GPL-3.0-or-later
"""Open faces bound a solid where the volume says so: parts that overlap, doubled faces, sheets beside bodies."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.errors import DegenerateInputError
from medial_axis.core.hollow.hollow import hollow
from medial_axis.core.settings import (
    HollowSettings,
    SamplingMode,
    Settings,
    SidesFrom,
    ThickenSettings,
)
from medial_axis.core.shape.outward_faces import outward_shape
from medial_axis.core.shape.shape import OF_SHEETS, REPEATED, Shape
from medial_axis.core.thickness.thicken import thicken
from support import meshes
from support.meshes import moved, shape_of
from support.messy import soup
from support.thick_meshes import block

BOX = block(1.0, 1.0, 1.0)
OPEN, SMALL = (BOX[0], BOX[1][1:]), block(0.8, 0.8, 0.8, (0.5, 0.1, 0.1))


def twice(mesh, again=(0, 2, 1)):
    return mesh[0], np.concatenate((mesh[1], mesh[1][:, again]))


def wavy(count=12, size=1.0):
    x, y = np.meshgrid(np.linspace(0, 1, count), np.linspace(0, 1, count))
    points = np.stack((x, y, 0.1 * np.sin(9 * x) * np.cos(7 * y)), -1).reshape(-1, 3)
    return size * points, meshes.lattice(np.arange(count * count).reshape(count, count).T)


def boxes(count, seed):
    """Boxes, most of which overlap; the fourth lacks a triangle."""
    random = np.random.default_rng(seed)
    size = (0.3, 1, 3)
    found = [moved(block(*random.uniform(*size)), random.uniform(0, 1, 3)) for _ in range(count)]
    found[3] = (found[3][0], found[3][1][1:])
    return meshes.join(*found)


def computed(mesh):
    return compute_axis(shape_of(mesh), Settings())


ONE = {
    "overlapping boxes": meshes.join(OPEN, SMALL),
    "an assembly": boxes(20, 0),
    "both sides of each face": twice(OPEN),
    "both sides with vertices of their own": soup(twice(OPEN)),
    "every face twice": twice(OPEN, (0, 1, 2)),
    "every face four times": twice(twice(OPEN)),
    "a wavy sheet beside a box": meshes.join(BOX, moved(wavy(size=0.5), (2, 0, 0))),
    "a large sheet beside overlapping boxes": meshes.join(BOX, SMALL, moved(wavy(), (3, 0, 0))),
    "a triangle in a box": meshes.join(BOX, (0.3 * np.eye(3) + (0.1, 0.2, 0.3), [[0, 1, 2]])),
}


@pytest.mark.parametrize("name", ONE)
def test_one_solid(name):
    found = computed(ONE[name])
    assert found.sides.source is SidesFrom.SURFACE
    assert found.topology.startswith("1 piece, no loop, no cavity")


def test_an_open_body_of_doubles_stays_beside_a_closed_one():
    """To leave out all of it would leave no edge open."""
    found = computed(meshes.join(twice(OPEN), moved(BOX, (2, 0, 0))))
    assert found.topology.startswith("2 pieces, no loop, no cavity")


def test_a_wall_between_two_rooms_is_no_body_of_doubles():
    read = outward_shape(shape_of(meshes.join(BOX, moved(BOX, (1, 0, 0)))))
    assert (read.reading == REPEATED).sum() in (0, 4) and read.volume == pytest.approx(2.0)


def test_sheets_alone_are_refused():
    with pytest.raises(DegenerateInputError, match="found an open sheet"):
        computed(meshes.join(wavy(), moved(wavy(), (0, 3, 1))))


@pytest.mark.parametrize("sheet", [wavy(), (wavy()[0] * (1, 1, 0.3), wavy()[1])])
def test_results_of_solids_advise_thickness_for_a_sheet(sheet):
    advice = r"give it thickness \(a Solidify modifier\)$"
    with pytest.raises(DegenerateInputError, match=advice):
        thicken(shape_of(sheet), Settings(), ThickenSettings(limit=0.1))
    with pytest.raises(DegenerateInputError, match=advice):
        hollow(shape_of(sheet), HollowSettings(wall=0.1))


def test_faces_without_corners_are_one_sentence():
    points = np.random.default_rng(0).normal(size=(30, 3))
    with pytest.raises(DegenerateInputError, match="faces with three corners in three places"):
        computed((points, np.repeat(np.arange(30)[:, None], 3, axis=1)))


@pytest.mark.parametrize("sampling", SamplingMode)
def test_faces_of_which_none_is_left_are_one_sentence(sampling):
    """The compiled module said 'Expected triangles for sides SURFACE, found none'."""
    points, triangles = BOX
    left_out = np.full(len(triangles), OF_SHEETS, np.uint8)
    shape = Shape(points, np.repeat(triangles[:, :1], 3, axis=1), reading=left_out)
    said = "that repeat others, are sheets or have no three"
    with pytest.raises(DegenerateInputError, match=said):
        compute_axis(shape, Settings(sampling=sampling, samples=100))
