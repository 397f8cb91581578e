# SPDX-License-Identifier: GPL-3.0-or-later
"""The axis lies where the artist sees the shape; scale, shear and mirror are applied first."""

import math

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Euler, Matrix
from measure import attribute, generators, world_positions
from scene import compute, ellipsoid, new_object

ROTATION = Euler((0.4, -0.8, 1.3)).to_matrix().to_4x4()
SHEAR = Matrix(((1, 0.7, 0, 0), (0, 1, 0.2, 0), (0, 0, 1, 0), (0, 0, 0, 1)))


def scale(x, y, z):
    return Matrix.Diagonal((x, y, z, 1))


PLACES = {
    "moved": Matrix.Translation((3, -2, 7)),
    "turned": Matrix.Translation((1, 2, 3)) @ ROTATION,
    "even scale": ROTATION @ scale(2.5, 2.5, 2.5),
    "uneven scale": ROTATION @ scale(0.5, 2, 3),
    "mirrored": ROTATION @ scale(-1, 1, 1),
    "all negative": Matrix.Translation((1, 0, 0)) @ scale(-2, -2, -2),
    "two negative": scale(-1, 3, -1) @ ROTATION,
    "sheared": ROTATION @ SHEAR,
    "everything": Matrix.Translation((10, 20, -5))
    @ ROTATION
    @ scale(-1, 2, 0.7)
    @ SHEAR
    @ ROTATION,
}


def place(source, world, parents):
    """Put an object there by itself, or through a chain of parents that leaves only a turn to the object."""
    if not parents:
        source.matrix_world = world  # shear cannot be an object's own
        return
    outer, inner = new_object("Outer"), new_object("Inner")
    outer.matrix_world = Matrix.Translation((0, 0, 5)) @ scale(1, 3, 0.5)
    inner.parent, source.parent = outer, inner
    inner.matrix_local = ROTATION
    bpy.context.view_layer.update()
    source.matrix_parent_inverse = inner.matrix_world.inverted() @ world
    source.matrix_basis = Matrix.Identity(4)
    bpy.context.view_layer.update()


def applied_copy(source):
    """An object without transform whose vertices are where the source's are; faces outward."""
    bpy.context.view_layer.update()
    mesh = source.data.copy()
    mesh.transform(source.matrix_world)
    if source.matrix_world.determinant() < 0:
        mesh.flip_normals()
    return new_object("Applied", mesh)


def facets(result):
    """{generators: facet centre}; generators name a facet whatever the order is."""
    where, mesh = world_positions(result), result.data
    return {
        tuple(pair): where[list(polygon.vertices)].mean(axis=0)
        for pair, polygon in zip(generators(mesh), mesh.polygons, strict=True)
    }


@pytest.mark.parametrize("name", PLACES)
def test_result_equals_that_of_a_copy_with_applied_transform(name):
    source = ellipsoid(segments=3)
    place(source, PLACES[name], parents=list(PLACES).index(name) % 2 == 0)
    result, expected = compute(source), compute(applied_copy(source))
    assert result["ma_side"] == expected["ma_side"] == "INNER"
    bpy.context.view_layer.update()
    assert result.matrix_world.to_scale()[:] == pytest.approx((1, 1, 1), abs=1e-6)
    assert result.matrix_world.determinant() > 0
    mine, theirs = facets(result), facets(expected)
    common = mine.keys() & theirs.keys()
    # Vertices of float32 decide a few edges.
    assert len(common) > 0.98 * max(len(mine), len(theirs)) > 100
    away = np.array([np.linalg.norm(mine[key] - theirs[key]) for key in common])
    assert np.quantile(away, 0.99) < 1e-4 * max(source.dimensions)
    low, high = (np.sort(attribute(thing.data, "ma_radius")) for thing in (result, expected))
    assert np.median(low) == pytest.approx(np.median(high), rel=1e-3)
    assert low[-1] == pytest.approx(high[-1], rel=1e-3)


def test_animated_constraint_is_seen():
    source, target = ellipsoid(), new_object("Target")
    target.location = (4, 5, 6)
    source.constraints.new("COPY_LOCATION").target = target
    np.testing.assert_allclose(world_positions(compute()).mean(axis=0), (4, 5, 6), atol=0.05)


@pytest.mark.parametrize("name", PLACES)
def test_split_transform_gives_a_rotation_and_a_symmetric_rest(name):
    split = addon("bridge.objects.read_object").split_transform
    world = np.array(PLACES[name], np.float64)
    frame, rest = split(world)
    rotation = frame[:3, :3]
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    np.testing.assert_allclose(rotation @ rest, world[:3, :3], atol=1e-5)
    np.testing.assert_array_equal(frame[:3, 3], world[:3, 3])
    np.testing.assert_allclose(rest, rest.T, atol=1e-6)


@pytest.mark.parametrize("scale", [(-1, 1, 1), (-2, -2, -2), (1, 1, -3), (0.5, -2, 0.5)], ids=str)
def test_rounding_does_not_turn_the_mirror(scale):
    """One transform read twice, with another last bit of float32, is split in one way."""
    split = addon("bridge.objects.read_object").split_transform
    turn = np.array(Euler((0.4, -0.8, 1.3)).to_matrix(), np.float64)
    world = np.eye(4)
    world[:3, :3] = turn * scale
    random = np.random.default_rng(2)
    for _ in range(20):
        other = world * (1.0 + 1e-7 * random.uniform(-1.0, 1.0, (4, 4)))
        for one, two in zip(split(world), split(other), strict=True):
            np.testing.assert_allclose(one, two, atol=1e-5)


def test_rotation_alone_leaves_the_points_exactly_as_they_are():
    split = addon("bridge.objects.read_object").split_transform
    random = np.random.default_rng(5)
    for _ in range(100):
        turn = Euler(random.uniform(-math.pi, math.pi, 3)).to_matrix().to_4x4()
        further = Euler(random.uniform(-math.pi, math.pi, 3)).to_matrix().to_4x4()
        _, rest = split(np.array(turn @ further, np.float64))
        np.testing.assert_array_equal(rest, np.eye(3))
