# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces are read as those of a solid, whichever way they look: random flips, whole parts, doubled faces, soups."""

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.machine import native
from medial_axis.core.settings import SamplingMode, Settings
from medial_axis.core.shape.outward_faces import outward_shape
from medial_axis.core.shape.shape import Shape
from support import meshes, messy
from support.same_axis import same_axis
from support.thick_meshes import block

TURNED, REPEATED, WITHOUT_CORNERS = 1, 2, 3


def cube(corner=(0.0, 0.0, 0.0), size=1.0):
    return block(size, size, size, np.add(corner, size / 2))


def grid(count):
    flat, triangles = meshes.rectangle(count - 1, count - 1)
    return np.column_stack(((flat + 1) / 2, np.zeros(count * count))), triangles


def inward(mesh):
    return with_inward(mesh, np.ones(len(mesh[1]), bool))


def with_inward(mesh, rows):
    return mesh[0], np.where(rows[:, None], mesh[1][:, [0, 2, 1]], mesh[1])


def flipped(mesh, share, seed=0):
    rows = np.random.default_rng(seed).random(len(mesh[1])) < share
    return with_inward(mesh, rows), rows


SOLIDS = {
    "box": cube(),
    "cavity": meshes.join(cube(), inward(cube((0.3, 0.3, 0.3), 0.4))),
    "parts": meshes.join(cube(), cube((3, 0, 0)), cube((0, 3, 0), 0.2)),
    "overlap": meshes.join(cube(), cube((0.5, 0.5, 0.5))),
    "solid in a solid": meshes.join(cube(), cube((0.3, 0.3, 0.3), 0.4)),
}


FLIPS = [(name, share) for name in SOLIDS for share in (0.0, 1.0)]
FLIPS += [(n, share) for n in SOLIDS if n != "solid in a solid" for share in (0.01, 0.1, 0.5)]


@pytest.mark.parametrize("name, share", FLIPS)
def test_flipped_faces_are_turned_and_no_others(medial, name, share):
    """None of them, all of them, and some at random."""
    for seed in range(5):
        mesh, rows = flipped(SOLIDS[name], share, seed)
        triangles, reading, _, _ = medial.outward_faces(*mesh)
        assert np.array_equal(triangles, SOLIDS[name][1]), seed
        assert np.array_equal(reading == TURNED, rows), seed


@pytest.mark.parametrize("part", range(3))
def test_a_part_that_looks_inward(medial, part):
    mesh, rows = SOLIDS["parts"], np.arange(36) // 12 == part
    triangles, reading, patches, unseen = medial.outward_faces(*with_inward(mesh, rows))
    assert np.array_equal(triangles, mesh[1]) and np.array_equal(reading == TURNED, rows)
    assert (patches, unseen) == (3, 0)


@pytest.mark.parametrize("again", [[0, 1, 2], [0, 2, 1], [2, 0, 1]])
def test_doubled_faces(medial, again):
    assert_first_are_kept(medial, cube(), again)


def test_a_sheet_of_doubled_faces_keeps_one_of_each(medial):
    """To leave out both would leave no edge open, and no face."""
    assert_first_are_kept(medial, grid(5))


def assert_first_are_kept(medial, mesh, again=(0, 1, 2)):
    points, triangles = mesh
    count, both = len(triangles), np.concatenate((triangles, triangles[:, again]))
    read, reading, _, _ = medial.outward_faces(points, both)
    assert np.array_equal(read[:count], triangles)
    assert (reading[:count] == 0).all() and (reading[count:] == REPEATED).all()
    assert (read[count:] == read[count:, :1]).all()


def test_a_wall_between_two_rooms_drawn_from_both_sides(medial):
    """Two boxes share a wall, of which each has its own faces: they bound one solid as they are."""
    mesh = meshes.join(cube(), cube((1, 0, 0)))
    triangles, reading, _, _ = medial.outward_faces(*mesh)
    assert medial.open_edges(mesh[0], triangles) == 0
    assert (reading != TURNED).all()


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_faces_cut_apart(medial, share):
    """Every face has corners of its own; equal coordinates are one place."""
    apart = messy.soup(SOLIDS["cavity"])
    assert np.array_equal(medial.outward_faces(*flipped(apart, share)[0])[0], apart[1])


@pytest.mark.parametrize("look", [lambda mesh: mesh, inward])
def test_an_open_box(medial, look):
    points, triangles = cube()
    clean = points, triangles[2:]
    assert np.array_equal(medial.outward_faces(*look(clean))[0], clean[1])


def test_a_sheet_keeps_the_side_of_most_of_its_faces(medial):
    points, triangles = grid(12)
    mesh, rows = flipped((points, triangles), 0.2)
    read, reading, _, unseen = medial.outward_faces(*mesh)
    assert np.array_equal(read, triangles) and np.array_equal(reading == TURNED, rows)
    assert unseen == 1


def test_faces_that_repeat_a_corner(medial):
    points, triangles = inward(cube())
    more = np.concatenate((triangles, [[3, 3, 5]])).astype(np.int32)
    read, reading, _, _ = medial.outward_faces(points, more)
    assert reading[12] == WITHOUT_CORNERS and read[12].tolist() == [3, 3, 5]
    assert np.array_equal(read[:12], cube()[1])


def test_bad_faces_are_refused(medial):
    points, triangles = cube()
    with pytest.raises(medial.InvalidInputError, match="corners below 8, found 9"):
        medial.outward_faces(points, np.array([[0, 1, 9]], np.int32))
    with pytest.raises(medial.InvalidInputError, match="finite"):
        medial.outward_faces(np.where(points > 0, np.nan, points), triangles)


def test_nothing_of_nothing(medial):
    nothing = np.zeros((0, 3)), np.zeros((0, 3), np.int32)
    triangles, reading, patches, _ = medial.outward_faces(*nothing)
    assert (len(triangles), len(reading), patches) == (0, 0, 0)


# --- in the product


def compute(mesh, sampling=SamplingMode.VERTICES, **options):
    return compute_axis(Shape(*mesh), Settings(sampling=sampling, **options))


def a_part_inward(mesh):
    return with_inward(mesh, native.load().mesh_parts(*mesh)[0] == 0)


def some_doubled(mesh):
    return mesh[0], np.concatenate((mesh[1], mesh[1][::3], mesh[1][::5, [1, 0, 2]]))


def cut_apart(mesh):
    """No two faces have a vertex in common; the first face of each keeps it, so that samples stay the same."""
    points, triangles = mesh
    corners = triangles.ravel()
    others = np.setdiff1d(np.arange(len(corners)), np.unique(corners, return_index=True)[1])
    rows = corners.copy()
    rows[others] = len(points) + np.arange(len(others))
    return np.concatenate((points, points[corners[others]])), rows.reshape(-1, 3)


DAMAGES = {
    "1 % flipped": lambda mesh: flipped(mesh, 0.01)[0],
    "10 % flipped": lambda mesh: flipped(mesh, 0.1)[0],
    "half flipped": lambda mesh: flipped(mesh, 0.5)[0],
    "inward": inward,
    "a part inward": a_part_inward,
    "doubled": some_doubled,
    "cut apart": cut_apart,
}
CLEAN = {"parts": SOLIDS["parts"], "cavity": SOLIDS["cavity"], "knot": "knot1.off"}
ALL = ("3holes.off", "club.off", "dilo.off", "fandisk_large.off", "hand_closed.obj", "igea.ply")
ALL = [pytest.param(name, marks=pytest.mark.slow) for name in ALL]


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize("name", [*CLEAN, *ALL])
def test_the_axis_is_that_of_the_clean_mesh(data_file, name, damage):
    if (name, damage) == ("cavity", "a part inward"):
        pytest.skip("it is also a solid in a solid, both inward, so nothing tells which is meant")
    clean = CLEAN.get(name, name)
    clean = messy.load(clean, data_file) if isinstance(clean, str) else clean
    options = {"sampling": SamplingMode.SURFACE, "samples": 2000}
    expected, found = compute(clean, **options), compute(DAMAGES[damage](clean), **options)
    assert same_axis(found.axis, expected.axis) and len(found.axis.vertices) > 100
    assert found.topology == expected.topology
    assert not any("looked inward" in text for text in expected.warnings)


def test_a_shape_says_how_it_was_read():
    shape = Shape(*inward(cube()))
    read = outward_shape(shape)
    none = dict.fromkeys(("repeated", "without_corners", "of_sheets"), 0)
    assert read.reading_counts == {"turned": 12, **none}
    assert shape.reading is None and outward_shape(read) is read
