# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of inputs, settings and the words in which the program says what it assumes, leaves out or refuses."""

import re
from functools import cache, partial

import medial_axis
import numpy as np
import pytest
from support.clouds import on_ellipsoid
from support.meshes import flip, icosphere, join, torus
from support.thick_meshes import ellipsoid

BY_VERTICES = {"sampling": "vertices", "form": "published", "prepare": "off"}
FEW = {"sampling": "surface", "samples": 1000}
SMALL_BUDGET = {"sampling": "adaptive", "samples": 1000, "budget": 1500}
MANY, _ = on_ellipsoid(6000)


def cloud(points, normals=None):
    return points, None, normals


egg = partial(ellipsoid, subdivisions=2)


def rod():
    """A closed ball that goes over into thin rods."""
    points, triangles = icosphere(5)
    points[:, 1:] *= 0.15 + 0.85 * np.exp(-((2.2 * points[:, :1]) ** 2))
    return points * (3.0, 1.0, 1.0), triangles


def noisy():
    shaken = np.random.default_rng(3).normal(scale=0.01, size=(5000, 3))
    return cloud(on_ellipsoid(5000)[0] + shaken)


SHAPES = {
    "dust": lambda: cloud(np.random.default_rng(2).normal(size=(300, 3))),
    "scan": lambda: cloud(on_ellipsoid()[0]),
    "scan with normals": lambda: cloud(*on_ellipsoid()),
    "scan with inward normals": lambda: cloud(on_ellipsoid()[0], -on_ellipsoid()[1]),
    "scan with normals of zeros": lambda: cloud(on_ellipsoid()[0], np.zeros((2000, 3))),
    "noisy scan": noisy,
    "scan with a cavity": lambda: cloud(np.concatenate([MANY, 0.4 * MANY[::4]])),
    "scan of a bowl": lambda: cloud(MANY[MANY[:, 2] > -0.2]),
    "egg": egg,
    "dense egg": ellipsoid,
    "open egg": lambda: (egg()[0], egg()[1][10:]),
    "egg with loose points": lambda: (np.concatenate([egg()[0], np.full((3, 3), 0.1)]), egg()[1]),
    "egg of doubled faces": lambda: join(egg(), flip(egg())),
    "two balls in each other": lambda: join(icosphere(3), icosphere(3, 1.0, (1.2, 0.0, 0.0))),
    "rod": rod,
    "square": lambda: ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]),
    "torus": torus,
}


@cache
def computed(name, **settings):
    return medial_axis.compute(*SHAPES[name](), **settings)


def said(found):
    """All sentences of a computation."""
    inside = f"Inside from {found.sides.source.name}: {found.sides.reason}"
    return "\n".join([inside, found.chosen.reason, str(found.density), *found.warnings])


TOLD = [
    ("scan", BY_VERTICES, "TIGHT_COCONE: the points have no faces and no normals"),
    ("scan", {}, "vertices, there are no faces"),
    ("scan with normals", BY_VERTICES, "NORMALS: the points have no faces$"),
    ("scan with normals of zeros", BY_VERTICES, "TIGHT_COCONE: .* no faces and no normals"),
    ("scan with inward normals", {**BY_VERTICES, "side": "both"}, "the normals point inward"),
    ("dust", {**BY_VERTICES, "side": "both"}, "enclose nothing, so inner and outer facets mean"),
    ("noisy scan", BY_VERTICES, "noise of about 0.33 spacings was found and left as it is"),
    ("noisy scan", BY_VERTICES, "points are not on the surface that Tight Cocone found"),
    ("noisy scan", BY_VERTICES, r"touches itself at \d+ edges"),
    ("noisy scan", BY_VERTICES, "do not look like samples of a smooth surface"),
    ("noisy scan", {}, "the points were moved by 0.23 spacings in the median"),
    ("scan with a cavity", {**BY_VERTICES, "sides": "tight-cocone"}, "walls of closed cavities"),
    ("scan with a cavity", BY_VERTICES, r"POLES: .* of \d\d% of the points contradict Tight"),
    ("scan of a bowl", BY_VERTICES, "closed openings, by .* more than 10 times as wide as most"),
    ("egg", BY_VERTICES, "SURFACE: the faces are closed"),
    ("egg", {}, "the vertices are too sparse, epsilon above 0.25 at"),
    ("dense egg", {}, "The 10,242 vertices, dense enough"),
    ("egg", {**BY_VERTICES, "sides": "poles"}, "POLES: as chosen"),
    ("open egg", BY_VERTICES, "SURFACE: the winding number .* open at 20 edges"),
    ("open egg", {**BY_VERTICES, "sides": "surface"}, "open at 20 edges: inside was taken to be"),
    ("egg with loose points", FEW, "3 vertices without a face were left out"),
    ("egg of doubled faces", FEW, "lie on another face"),
    ("two balls in each other", FEW, "left out because the surface there bounds nothing"),
    ("rod", {"sampling": "adaptive", "samples": 1500}, "closer together where it is thin, in"),
    ("rod", {**SMALL_BUDGET, "epsilon": 0.05}, "until the budget of 1,500 was spent"),
]


def table(rows):
    ids = [f"{name}, {settings}, {words}" for name, settings, words in rows]
    return pytest.mark.parametrize("name, settings, words", rows, ids=ids)


@table(TOLD)
def test_what_is_told(name, settings, words):
    sentences = said(computed(name, **settings))
    assert re.search(words, sentences, re.MULTILINE), sentences


NOT_TOLD = [
    ("scan with normals", BY_VERTICES, "noise"),
    ("noisy scan", BY_VERTICES, "too sparse"),  # more points of this noise would not help
    ("torus", {}, "left out"),
]


@table(NOT_TOLD)
def test_what_is_not_told(name, settings, words):
    assert words not in said(computed(name, **settings))


REFUSED = [
    ("dust", BY_VERTICES, "found 289 of 300 that enclose nothing; sample more densely"),
    ("dust", {**BY_VERTICES, "side": "outer"}, "that enclose nothing; .* or choose side Both"),
    ("scan", {"sides": "normals"}, "attribute 'normal' of the points, .* not all zero"),
    ("scan", {"sides": "surface"}, "faces for Inside Decided By Surface, found points only"),
    ("scan", {"sides": "wrap"}, "faces for Inside Decided By Wrap, found points only"),
    ("scan", {"sampling": "surface"}, "faces for Sampling Surface, found points only"),
    ("scan", {"sampling": "adaptive"}, "faces for Sampling Adaptive, found points only"),
    ("egg", {"sides": "normals", **BY_VERTICES}, "attribute 'normal' of the points"),
    ("square", {}, "in one plane; give them thickness"),
]


@table(REFUSED)
def test_what_is_refused(name, settings, words):
    with pytest.raises(medial_axis.MedialAxisError, match=f"^Expected .*{words}") as caught:
        computed(name, **settings)
    assert "\n" not in str(caught.value)
