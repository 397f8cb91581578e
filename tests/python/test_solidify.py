# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of sheets whose walls are known in closed form, and sheets that cannot be solid."""

import numpy as np
import pytest
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.settings import SolidifySettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.solidify.solidify import solidify
from support.crossing_triangles import crossing_pairs
from support.meshes import icosphere, lattice, read, shape_of


def strip(profile, width=1.0, steps=6):
    """A sheet along a line of (x, z), as wide along y."""
    y = np.tile(np.linspace(0, width, steps + 1), len(profile))
    x, z = np.repeat(np.asarray(profile, float), steps + 1, axis=0).T
    return Shape(np.column_stack((x, y, z)), lattice(np.arange(len(y)).reshape(-1, steps + 1)))


def fold(degrees, reach=2.0, step=0.05):
    """Two flaps that meet at a crease."""
    along, half = np.linspace(-reach, reach, 2 * round(reach / step) + 1), np.radians(degrees) / 2
    return strip(np.column_stack((np.abs(along) * np.cos(half), along * np.sin(half))))


def hairpin(gap, reach=2.0):
    """Two flaps with a half circle between them."""
    turn, back = np.linspace(-np.pi / 2, np.pi / 2, 13), np.linspace(-reach, -0.1, 20)
    half = gap / 2
    ends = [np.column_stack((x, np.full(20, z))) for x, z in ((back, -half), (back[::-1], half))]
    bend = half * np.column_stack((np.cos(turn), np.sin(turn)))
    return strip(np.concatenate((ends[0], bend, ends[1])))


def solid(shape, thickness, offset=0.0):
    """The solid, which is closed, turned outward, and crosses itself nowhere."""
    found = solidify(shape, SolidifySettings(thickness=thickness, offset=offset))
    made = Shape(found.vertices, found.triangles)
    assert made.open_edges == 0 and made.volume > 0.0 and found.crossings == 0
    assert not len(crossing_pairs(made.points, made.triangles))
    assert made.solid_betti is not None
    return found


@pytest.mark.parametrize("offset", [-1.0, 0.3])
def test_a_flat_sheet_becomes_a_box(offset):
    found = solid(strip(np.column_stack((np.linspace(0, 2, 9), np.zeros(9)))), 0.2, offset)
    assert found.volume == pytest.approx(2 * 0.2, rel=1e-12)
    assert found.without_room == 0.0 and found.least == pytest.approx(0.2)
    z = found.vertices[:, 2]
    np.testing.assert_allclose(
        [z.min(), z.max()], [-0.1 * (1 - offset), 0.1 * (1 + offset)], atol=1e-12
    )


@pytest.mark.parametrize("degrees", [20, 90])
@pytest.mark.parametrize("offset", [-1.0, 0.0, 1.0])
def test_a_fold_keeps_its_wall(degrees, offset):
    """Faces that are finer than the wall is thick have no room in the crease, and the wall is filled there."""
    found = solid(fold(degrees), 0.15, offset)
    assert found.without_room == 0.0 and found.least >= 0.98 * 0.15 and not found.warnings
    corner = 0.075 * (1 + abs(offset)) / np.sin(np.radians(degrees) / 2)
    assert np.abs(found.vertices[:, 0]).max() >= 0.98 * corner


def test_a_gap_leaves_less_room():
    gap, wall = 0.15, 0.2
    found = solid(hairpin(gap), wall, 1.0)
    assert found.least == pytest.approx(gap / 2, rel=0.03)
    assert found.without_room > 0.9 and "no room" in found.warnings[0]
    assert solid(hairpin(gap), wall, -1.0).without_room == 0.0, "outside there is room"


def test_a_closed_surface_gets_a_wall_inside():
    found = solid(shape_of(icosphere(3)), 0.1, -1.0)
    assert found.volume == pytest.approx(4 / 3 * np.pi * (1 - 0.9**3), rel=0.02)
    assert Shape(found.vertices, found.triangles).solid_betti == (1, 0, 1)


def test_coarse_corners_are_not_left_through_their_faces(data_file):
    """With faces as long as the wall is thick, two ways once led out of the ears, and ten corners lost their walls."""
    mesh = read(data_file("spot_low.obj"))
    wall = 0.03 * np.linalg.norm(np.ptp(mesh[0], axis=0))
    assert solid(shape_of(mesh), wall, -1.0).least > 0.8 * wall


def test_the_size_of_the_sheet_and_where_it_is_do_not_matter():
    shape = fold(20)
    large = Shape(1024.0 * shape.points, shape.triangles)
    one, other = solid(shape, 0.15), solid(large, 1024.0 * 0.15)
    np.testing.assert_allclose(other.vertices / 1024.0, one.vertices, atol=1e-9)


def test_faces_that_disagree_are_turned_and_told():
    shape = fold(90)
    shape.triangles[::3] = shape.triangles[::3, ::-1]
    assert "the other way round" in solid(shape, 0.1).warnings[0]


def test_what_is_no_sheet_is_refused():
    fins = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)], float)
    three = np.array([(0, 1, 2), (1, 0, 3), (0, 1, 4)], np.int32)
    with pytest.raises(InvalidInputError, match="two faces at most at every edge, found 1"):
        solidify(Shape(fins, three), SolidifySettings())
    with pytest.raises(InvalidInputError, match="Expected faces, found none"):
        solidify(Shape(fins, three), SolidifySettings(), np.zeros(3, bool))
    turn = np.linspace(0, np.pi, 13)[:-1]
    edge = np.column_stack((np.cos(turn), np.sin(turn)))
    ring = np.column_stack((np.cos(2 * turn), np.sin(2 * turn), 0 * turn))
    across = 0.3 * (edge[:, :1] * ring + edge[:, 1:] * np.array([0, 0, 1.0]))
    points = np.concatenate((ring - across, ring + across))
    ends = np.column_stack((np.append(np.arange(12), 12), np.append(np.arange(12, 24), 0)))
    with pytest.raises(InvalidInputError, match="twisted"):
        solidify(Shape(points, lattice(ends)), SolidifySettings())


def test_selected_faces_alone_become_a_solid():
    shape = fold(90)
    flap = shape.points[shape.triangles].mean(axis=1)[:, 2] > 0
    found = solidify(shape, SolidifySettings(thickness=0.1), flap)
    assert found.volume == pytest.approx(shape.area / 2 * 0.1)
