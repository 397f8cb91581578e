# SPDX-License-Identifier: GPL-3.0-or-later
"""The cache tells settings apart: the keys of analyses, and results that do not depend on what was computed before."""

from dataclasses import fields, is_dataclass, replace
from enum import Enum

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.cover.ball_cover import cover_by_balls
from medial_axis.core.machine.cache import CACHE, key_of
from medial_axis.core.options import Choice, Integer, Switch
from medial_axis.core.settings import (
    BALL_OPTIONS,
    OPTIONS,
    SKELETON_OPTIONS,
    THICKNESS_OPTIONS,
    BallSettings,
    Form,
    SamplingMode,
    Settings,
    Side,
    SidesFrom,
    SkeletonSettings,
    ThicknessSettings,
)
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.compute import compute_skeleton
from medial_axis.core.thickness.thickness import kept_measurement, measure_thickness
from medial_axis.core.thickness.thin_parts import find_thin_parts
from support.meshes import box, icosphere, join, moved, torus, uv_sphere


@pytest.fixture(autouse=True)
def _nothing_is_kept():
    CACHE.clear()
    yield
    CACHE.clear()


# --- keys


class Colour(Enum):
    RED = "RED"
    BLUE = "BLUE"


class Fruit(Enum):
    RED = "RED"


LONG = np.arange(5000.0)
CHANGED = LONG + (LONG == 2500.0)
DIFFERENT = {
    "where one part ends and the next begins": ((5, 10.0), (51, 0.0)),
    "how texts are divided": (("ab", "c"), ("a", "bc")),
    "what is inside a tuple": (((1, (2, 3)),), (((1, 2), 3),)),
    "a tuple and its items": (((1, 2),), (1, 2)),
    "an empty tuple": ((), ((),)),
    "True and 1": ((True,), (1,)),
    "False and None": ((False,), (None,)),
    "a text and a number": (("1",), (1,)),
    "an integer and a float": ((1,), (1.0,)),
    "floats that differ in the last bit": ((0.1,), (np.nextafter(0.1, 1.0),)),
    "None and its name": ((None,), ("None",)),
    "members of one enum": ((Colour.RED,), (Colour.BLUE,)),
    "members of two enums": ((Colour.RED,), (Fruit.RED,)),
    "a member and its name": ((Colour.RED,), ("RED",)),
    "long arrays": ((LONG,), (CHANGED,)),
    "long arrays in a tuple": (((LONG, LONG),), ((LONG, CHANGED),)),
    "the shape of an array": ((LONG,), (LONG.reshape(50, 100),)),
    "the type of an array": ((LONG,), (LONG.view(np.int64),)),
    "an array and its bytes as a text": ((np.array([65], np.uint8),), ("A",)),
}


@pytest.mark.parametrize("name", DIFFERENT)
def test_keys_tell_apart(name):
    first, second = DIFFERENT[name]
    assert key_of(*first) != key_of(*second)


def test_equal_parts_have_one_key():
    def parts():
        return "name", (1, (2.5, None)), np.arange(9.0).reshape(3, 3), True, Colour.RED

    assert key_of(*parts()) == key_of(*parts())
    every_other = np.arange(18.0).reshape(3, 6)[:, ::2]
    assert key_of(every_other) == key_of(every_other.copy())


def test_numbers_of_numpy_are_numbers():
    assert key_of(np.float64(0.5), np.int64(3), np.bool_(True)) == key_of(0.5, 3, True)


@pytest.mark.parametrize("part", [[1, 2], {1: 2}, object(), np.array([None]), 1j, b"1"])
def test_other_parts_are_refused(part):
    with pytest.raises(TypeError, match=r"^Expected .*, found .*; .*$"):
        key_of("name", (1, part))


# --- history: A and then B is B


def balls_in_a_row():
    """Two balls and a lens between them, which takes dense samples away from the first and the last of them."""
    ball = uv_sphere(24, 12)
    lens = moved(ball, (3.0, 0.0, 0.0), (1.0, 1.0, 0.12))
    return Shape(*join(ball, lens, moved(ball, (6.0, 0.0, 0.0))))


def test_epsilon_of_adaptive_samples_is_not_that_of_the_run_before():
    shape = balls_in_a_row()
    settings = Settings(sampling=SamplingMode.ADAPTIVE, samples=1500, budget=15_000, epsilon=0.2)
    alone = compute_axis(shape, settings)
    CACHE.clear()
    compute_axis(shape, replace(settings, epsilon=0.4))
    assert differences(compute_axis(shape, settings), alone) == []


def test_another_seed_gives_other_samples():
    shape, settings = Shape(*box((4, 3, 2))), replace(FEW, sampling=SamplingMode.SURFACE)
    found = [compute_axis(shape, replace(settings, seed=seed)) for seed in (0, 1)]
    assert not np.array_equal(*(one.chosen.samples.points for one in found))


def bent_shape():
    """A ring and a box above it, of few vertices with normals: something for every option to change."""
    above = moved(box((4, 3, 2)), (0.0, 0.0, 3.0))
    points, triangles = join(torus(around=24, across=10), above)
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], np.cross(b - a, c - a))
    return Shape(points, triangles, normals)


FEW = Settings(samples=200, budget=600, rho=1.5)
STARTS = (
    replace(FEW, sampling=SamplingMode.VERTICES, form=Form.PUBLISHED),
    replace(FEW, sampling=SamplingMode.SURFACE, form=Form.CURVE, detail=0.0),
    replace(FEW, sampling=SamplingMode.ADAPTIVE, form=Form.CLEAN),
    replace(FEW, sampling=SamplingMode.SURFACE, sides=SidesFrom.WRAP, wrap_opening=5.0),
)


def others(option, value):
    """Other values of an option than this one: all of a choice, one of a number, towards the end of its slider."""
    if isinstance(option, Choice):
        return [member for member in option.items if member is not value]
    if isinstance(option, Switch):
        return [not value]
    if isinstance(option, Integer):
        return [2 * value + 1]
    return [(value + option.soft_maximum) / 2]


def values_of(found, path=""):
    """{path: value} of all that a result holds, arrays as their bytes; without times and compiled objects."""
    if is_dataclass(found):
        parts = {field.name: getattr(found, field.name) for field in fields(found)}
        parts = {name: part for name, part in parts.items() if name not in NO_RESULT}
    elif isinstance(found, (tuple, list)):
        parts = dict(enumerate(found))
    else:
        if isinstance(found, np.ndarray):
            found = found.dtype.str, found.shape, found.tobytes()
        return {path: found}
    return {
        key: value
        for name, part in parts.items()
        for key, value in values_of(part, f"{path}.{name}").items()
    }


NO_RESULT = ("seconds", "analysis", "levels", "settings")


def differences(first, second):
    """The paths at which two results differ."""
    first, second = values_of(first), values_of(second)
    return sorted(path for path in {*first, *second} if first.get(path) != second.get(path))


def assert_independent_of_history(compute, pairs):
    """Each of two settings gives after the other what it gives alone; and some pair gives two results."""
    changed = False
    for first, second in pairs:
        CACHE.clear()
        first_alone, second_after = compute(first), compute(second)
        CACHE.clear()
        second_alone, first_after = compute(second), compute(first)
        assert differences(first_after, first_alone) == []
        assert differences(second_after, second_alone) == []
        changed |= differences(first_alone, second_alone) != []
    assert changed


def noisy_points():
    points, triangles = icosphere(3)
    noise = np.random.default_rng(0).normal(0.0, 0.03, points.shape)
    return Shape(points + noise, np.empty_like(triangles[:0]))


def names_of(settings):
    return [field.name for field in fields(settings)]


def pairs_of(starts, options, name):
    """Settings, and the same with another value of one option."""
    return [
        (start, replace(start, **{name: value}))
        for start in starts
        for value in others(options[name], getattr(start, name))
    ]


@pytest.mark.parametrize("name", names_of(Settings))
def test_an_axis_does_not_depend_on_the_settings_before(name):
    of_points = name == "prepare"
    shape, starts = (noisy_points(), STARTS[:1]) if of_points else (bent_shape(), STARTS)
    pairs = pairs_of(starts, OPTIONS, name)
    assert_independent_of_history(lambda settings: compute_axis(shape, settings), pairs)


@pytest.mark.parametrize("name", names_of(SkeletonSettings))
def test_a_skeleton_does_not_depend_on_the_settings_before(name):
    solid = torus() if name == "loops" else box((4, 3, 2))  # a box has none
    shape, settings = Shape(*solid), replace(FEW, sampling=SamplingMode.VERTICES)
    starts = [SkeletonSettings(detail=detail) for detail in (1.0, 0.0)]
    pairs = pairs_of(starts, SKELETON_OPTIONS, name)
    assert_independent_of_history(lambda wanted: compute_skeleton(shape, settings, wanted), pairs)


@pytest.mark.parametrize("name", names_of(BallSettings))
def test_balls_do_not_depend_on_the_settings_before(name):
    shape, pairs = bent_shape(), pairs_of([BallSettings(count=5)], BALL_OPTIONS, name)
    assert_independent_of_history(lambda wanted: cover_by_balls(shape, FEW, wanted), pairs)


@pytest.mark.parametrize("name", names_of(ThicknessSettings))
def test_a_thickness_does_not_depend_on_the_settings_before(name):
    """The thin parts also depend on the limit and on the smallest patch; the measurement does not."""
    shape, pairs = bent_shape(), pairs_of([ThicknessSettings()], THICKNESS_OPTIONS, name)

    def compute(wanted):
        found = measure_thickness(shape, FEW, wanted)
        return found, find_thin_parts(found, wanted.limit)

    assert_independent_of_history(compute, pairs)


@pytest.mark.parametrize("name", names_of(Settings))
def test_a_kept_measurement_is_not_replaced_by_one_of_other_settings(name):
    shape = bent_shape()
    for start, other in pairs_of(STARTS[:2], OPTIONS, name):
        first = measure_thickness(shape, start, ThicknessSettings())
        measure_thickness(shape, other, ThicknessSettings())
        assert differences(kept_measurement(first.key), first) == []


def test_balls_are_those_of_the_inside_whatever_side_is_set():
    """So the analysis of another side is neither computed nor kept."""
    shape = bent_shape()
    first = cover_by_balls(shape, replace(FEW, side=Side.INNER), BallSettings(count=5))
    analyses = CACHE.analyses
    again = cover_by_balls(shape, replace(FEW, side=Side.OUTER), BallSettings(count=5))
    assert CACHE.analyses == analyses
    assert differences(again.balls, first.balls) == []
