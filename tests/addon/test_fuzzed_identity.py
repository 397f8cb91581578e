# SPDX-License-Identifier: GPL-3.0-or-later
"""Random stacks of modifiers: what is written on the vertices of a mesh belongs to these vertices.

An attribute that travels through the modifiers says which vertex of the mesh a measured vertex was. Values on the
mesh must be those that were measured there; where that cannot be, nothing is written on the mesh.
"""

import random

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, evaluated, positions
from scene import ellipsoid, select, torus
from support.fuzz import repeats

TRAVELLER = "which_vertex"


def build(modifier, rng):
    modifier.frame_start, modifier.frame_duration = -100, 1
    modifier.use_random_order, modifier.seed = rng.random() < 0.8, rng.randrange(99)
    modifier.use_reverse = rng.random() < 0.2


# Modifiers that reorder, move, add, remove or double vertices, with their settings.
MODIFIERS = {
    "BUILD": {},
    "TRIANGULATE": {},
    "DISPLACE": {"strength": 0.05},
    "WELD": {"merge_threshold": 1e-4},
    "SUBSURF": {"levels": 1, "subdivision_type": "SIMPLE"},
    "ARRAY": {"count": 2},
    "MIRROR": {},
    "EDGE_SPLIT": {"split_angle": 0.2},
    "DECIMATE": {"ratio": 0.6},
    "SMOOTH": {"iterations": 2},
    "SOLIDIFY": {"thickness": 0.02},
    "CAST": {"factor": 0.2},
    "BEVEL": {"width": 0.01},
    "MASK": {},
}


def stack_on(source, rng):
    for number in range(rng.randrange(4)):
        kind = rng.choice(list(MODIFIERS)) if rng.random() < 0.6 else "BUILD"
        modifier = source.modifiers.new(f"{number} {kind}", kind)
        for name, value in MODIFIERS[kind].items():
            setattr(modifier, name, value)
        if kind == "BUILD":
            build(modifier, rng)
        modifier.show_viewport = rng.random() < 0.9


def add_traveller(source):
    """The number of each vertex, as a vector, which modifiers interpolate for vertices that they make."""
    if source.data.attributes.get(TRAVELLER) is None:
        source.data.attributes.new(TRAVELLER, "FLOAT_VECTOR", "POINT")
    numbers = np.arange(len(source.data.vertices), dtype=np.float32)
    vectors = np.column_stack((numbers, numbers**2, np.sqrt(numbers))).astype(np.float32)
    source.data.attributes[TRAVELLER].data.foreach_set("vector", vectors.ravel())
    return vectors


def travelled(source):
    """(n,) the vertex of the mesh that each evaluated vertex was, or -1 for those that modifiers made."""
    mesh = evaluated(source)
    found = attribute(mesh, TRAVELLER)
    numbers = np.round(found[:, 0]).astype(np.int64)
    same = (found[:, 0] == numbers) & (found[:, 1] == found[:, 0] ** 2)
    same &= found[:, 2] == np.sqrt(found[:, 0])
    return np.where(same, numbers, -1)


def tries(seed):
    """Measure a mesh under a random stack; whether values were written on the mesh, all of which are then right."""
    rng = random.Random(seed)
    source = rng.choice((lambda: ellipsoid(segments=2), torus))()
    add_traveller(source)
    stack_on(source, rng)
    select(source)
    try:
        bpy.ops.object.medial_axis_thickness(sampling="VERTICES", select_result=False)
    except RuntimeError as error:
        assert "Traceback" not in str(error), (seed, error)
        assert "ma_thickness" not in source.data.attributes
        return False
    if "ma_thickness" not in source.data.attributes:
        return False
    carrier = addon("bridge.thickness.thickness_object").carrier_of(source)
    measured = addon("core.thickness.thickness").kept_measurement(carrier["ma_thickness_key"])
    rows, written = travelled(source), attribute(source.data, "ma_thickness")
    values = np.float32(measured.of_vertices)
    assert len(rows) == len(values) and len(written) == len(positions(source.data))
    for vertex in range(len(written)):
        right = values[rows == vertex]
        assert len(right) and written[vertex] in right, (seed, vertex)
    return True


@pytest.mark.parametrize("seed", repeats(4))
def test_fuzzed_identity(seed):
    written = [tries(10 * seed + more) for more in range(10)]
    assert len(written) == 10


def test_both_ends_are_met():
    """Some stacks leave the vertices and some do not; else the fuzz tells nothing."""
    assert {tries(seed) for seed in range(12)} == {True, False}
