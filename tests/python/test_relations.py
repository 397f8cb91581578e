# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of stages and a table of relations that hold for all of them: threads, powers of two, progress, Cancel.

More inputs of the analysis itself: test_metamorphic.py.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
import pytest
from medial_axis.core.axis import structure as of_axis
from support import meshes
from support.shapes import SHAPES
from support.thick_meshes import block

TORUS = meshes.torus(1.0, 0.4, 48, 24)
BALL = meshes.icosphere(3)
BOWL = meshes.below(BALL, 0.3)
MANY = 2**14  # samples, so that threads share the work


class Stage(NamedTuple):
    """`run(medial, scale, **options)` gives arrays by name; `powers` says which of them are lengths to which power."""

    run: Callable
    powers: dict


def named(found, names):
    return {name: np.asarray(getattr(found, name)) for name in names}


def analysis_of(medial, scale, name="torus", count=4000, **options):
    shape = SHAPES[name]
    points = shape.random_sample(count, 1)
    return medial.MedialAnalysis(scale * points, normals=shape.normals(points), **options)


def sides_by_normals(medial, scale, **options):
    return named(analysis_of(medial, scale, **options), ("edges", "side"))


def sides_by_poles(medial, scale, **options):
    points = scale * SHAPES["shell"].sample(2000, 0)
    found = medial.MedialAnalysis(points, sides=medial.SidesFrom.POLES, **options)
    return named(found, ("edges", "side"))


def feature_size(medial, scale, progress=None, **options):
    analysis = analysis_of(medial, scale, **options)
    return {"size": analysis.feature_size(progress=progress), "spacing": analysis.spacing}


def solid_triangles(medial, scale, **options):
    return {"triangles": analysis_of(medial, scale, **options).solid_triangles()}


VALUES = ("facet_sheet", "facet_spacings", "facet_spike", "vertex_erosion", "vertex_limb")
VALUES = (*VALUES, "edges", "cells")


def hierarchy(medial, scale, progress=None, **options):
    """The values of a hierarchy, and its level that is smoothed."""
    found = analysis_of(medial, scale, "slab", 3000, **options).hierarchy(progress=progress)
    level = found.extract(sheet=np.inf, relaxed=True, round_limbs=True, progress=progress)
    return named(found, VALUES) | named(level, ("vertices", "radius", "exact", "wires"))


def thickness(medial, scale, progress=None, **options):
    analysis, shape = analysis_of(medial, scale, **options), SHAPES["torus"]
    normals = scale * shape.normals(shape.random_sample(4000, 1))
    found = analysis.thickness(normals, progress=progress)
    scan = analysis.thickness(mode=medial.ThicknessMode.SCAN, progress=progress)
    return {"values": found.values, "measured": found.measured, "scan": scan.values}


def inscribed_balls(medial, scale, **options):
    balls = medial.BallFaces(scale * TORUS[0], TORUS[1], smooth=True, **options)
    face = np.arange(0, len(TORUS[1]), 5, dtype=np.int32)
    places, spacing = scale * TORUS[0][TORUS[1][face]].mean(axis=1), np.full(len(face), 0.05)
    found = balls.inscribed_balls(places, face, scale * spacing, **options)
    return dict(zip(("length", "wall"), found))


FIELDS = ["edges" if name == "facet_edges" else name for name in of_axis.FIELDS]


def structure(medial, scale, threads=0):
    level = analysis_of(medial, scale, "box").hierarchy().extract()
    names = ("vertices", "radius", "face_offsets", "face_vertices", "generators", "wires")
    patches = np.random.default_rng(0).integers(0, 4, (4000, 2), dtype=np.int32)
    patches[::3, 1] = -1
    more = {"patches": np.sort(patches)[:, ::-1].copy(), "spacing": np.full(4000, 0.05 * scale)}
    return named(medial.structure(**named(level, names), **more, threads=threads), FIELDS)


def tight_cocone(medial, scale, **options):
    found = medial.TightCocone(scale * SHAPES["torus"].random_sample(3000, 0), **options)
    return named(found, ("triangles", "flat", "good", "on_surface"))


def samples(medial, scale, **options):
    found = medial.sample_surface(scale * TORUS[0], TORUS[1], count=MANY, smooth=True, **options)
    return named(found, ("points", "normals", "triangle", "kind", "radius"))


def samples_of_edges(medial, scale, **options):
    vertices, triangles = meshes.box()
    found = medial.sample_surface(scale * vertices, triangles, count=3000, **options)
    return named(found, ("points", "kind"))


def samples_in_pairs(medial, scale, **options):
    vertices, triangles = block(1.0, 1.0, 1e-3)
    found = medial.sample_surface(scale * vertices, triangles, count=3000, pairs=True, **options)
    return named(found, ("points", "partner"))


def closing(medial, scale, **options):
    vertices, triangles = scale * BOWL[0], BOWL[1]
    found = medial.sample_surface(vertices, triangles, count=2000)
    given = found.points, found.normals, found.radius, vertices, triangles
    return dict(zip(("points", "normals", "radius"), medial.closing_samples(*given, **options)))


def buried(medial, scale, **options):
    points = scale * BALL[0]
    return {"found": medial.buried(points, BALL[0], 1e-3 * scale, points, BALL[1], **options)}


def distances(medial, scale, **options):
    random = np.random.default_rng(3)
    vertices, queries = random.normal(size=(300, 3)), random.normal(size=(9000, 3))
    triangles = random.integers(0, 300, (200, 3)).astype(np.int32)
    found = medial.TriangleTree(scale * vertices, triangles).distances(scale * queries, **options)
    row, weights = medial.surface_places(scale * queries, scale * vertices, triangles)
    places = (weights[:, :, None] * scale * vertices[triangles[row]]).sum(axis=1)
    assert found == pytest.approx(np.linalg.norm(scale * queries - places, axis=1), rel=1e-9)
    return {"distance": found, "place": places}


def outward(medial, scale, **options):
    triangles = TORUS[1].copy()
    triangles[::3] = triangles[::3, ::-1]
    return dict(enumerate(medial.outward_faces(scale * TORUS[0], triangles, **options)))


def scanned(medial, scale, threads=0):
    noise = np.random.default_rng(1).normal(scale=0.03, size=(4000, 3))
    points = scale * (SHAPES["torus"].random_sample(4000, 1) + noise)
    measured = medial.measure_scan(points, threads=threads)
    return named(medial.prepare_scan(points, measured, threads=threads), ("rows", "points"))


def smoothed(medial, scale, threads=0):
    normals = BALL[0]
    points = scale * (normals + np.random.default_rng(1).normal(scale=0.02, size=normals.shape))
    noise = medial.surface_noise(points, normals, threads=threads)
    return {"points": medial.smooth_vertices(points, normals, noise, threads=threads)}


def balls(medial, scale, mode, refine, **options):
    random = np.random.default_rng(4)
    angle, away = random.uniform(0, 2 * np.pi, 300), random.uniform(0.85, 1.15, 300)
    height, radii = random.uniform(-0.1, 0.1, 300), random.uniform(0.05, 0.5, 300)
    centres = np.column_stack([away * np.cos(angle), away * np.sin(angle), height])
    given = scale * centres, scale * radii, scale * TORUS[0], TORUS[1]
    more = {"mode": getattr(medial.CoverMode, mode), "refine": refine, "places": 5000}
    found = medial.cover_by_balls(*given, count=15, **more, **options)
    return named(found, ("chosen", "radii", "covered", "outside", "farthest"))


def capsules(medial, scale, mode, **options):
    angle = 2 * np.pi * np.arange(12) / 12
    ends = scale * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    segments = np.column_stack([np.arange(12), (np.arange(12) + 1) % 12]).astype(np.int32)
    mode = getattr(medial.CoverMode, mode)
    given = ends, segments, scale * TORUS[0], TORUS[1]
    found = medial.cover_by_capsules(*given, mode=mode, places=5000, **options)
    return named(found, ("ends", "radii", "held", "outside", "farthest"))


def least_capsules(medial, scale, **options):
    places = scale * np.random.default_rng(2).normal(size=(500, 3))
    group = (np.arange(500) % 7).astype(np.int32)
    return dict(zip(("ends", "radii"), medial.least_capsules(places, group, count=7, **options)))


def reduced(medial, scale, **options):
    x, y = (side.ravel() for side in np.meshgrid(np.arange(25.0), np.arange(25.0), indexing="ij"))
    vertices = np.column_stack([x, y, np.sin(x / 4)])
    radius = 0.3 + 0.1 * np.sin(3 * x) * np.cos(5 * y)
    triangles = meshes.lattice(np.arange(625).reshape(25, 25))
    mesh = scale * vertices, scale * radius, triangles, np.zeros((0, 2), np.int32)
    names = "vertices", "radius", "triangles", "edges"
    return dict(zip(names, medial.reduce_sphere_mesh(*mesh, 50, **options), strict=True))


UNITS = {"area": 2, "radius": 1, "length": 1}
FIGURES = {"chosen": 0, "radii": 1, "covered": 0, "outside": 1, "farthest": 1}
STAGES = {
    "sides by normals": Stage(sides_by_normals, {"edges": 0, "side": 0}),
    "sides by poles": Stage(sides_by_poles, {"edges": 0, "side": 0}),
    "feature size": Stage(feature_size, {"size": 1, "spacing": 1}),
    "solid triangles": Stage(solid_triangles, {"triangles": 0}),
    "hierarchy": Stage(
        hierarchy, {**dict.fromkeys((*VALUES, "wires"), 0), "vertices": 1, "radius": 1, "exact": 1}
    ),
    "thickness": Stage(thickness, {"values": 1, "measured": 0, "scan": 1}),
    "inscribed balls": Stage(inscribed_balls, {"length": 1, "wall": 1}),
    "structure": Stage(structure, {name: UNITS.get(name.split("_")[-1], 0) for name in FIELDS}),
    "tight cocone": Stage(tight_cocone, {"triangles": 0, "flat": 0, "good": 0, "on_surface": 0}),
    "samples": Stage(samples, {"points": 1, "kind": 0, "triangle": 0}),
    "samples of edges": Stage(samples_of_edges, {"points": 1, "kind": 0}),
    "samples in pairs": Stage(samples_in_pairs, {"points": 1, "partner": 0}),
    "closing samples": Stage(closing, {"points": 1, "radius": 1}),
    "buried": Stage(buried, {"found": 0}),
    "distances": Stage(distances, {"distance": 1}),
    "outward faces": Stage(outward, {0: 0, 1: 0}),
    "scan": Stage(scanned, {"rows": 0, "points": 1}),
    "smooth vertices": Stage(smoothed, {"points": 1}),
    "least capsules": Stage(least_capsules, {"ends": 1, "radii": 1}),
    "reduced": Stage(reduced, {"vertices": 1, "radius": 1, "triangles": 0, "edges": 0}),
}
for cover in ("INSIDE", "AROUND"):
    tube = {"ends": 1, "radii": 1, "held": 0, "outside": 1, "farthest": 1}
    STAGES[f"capsules {cover}"] = Stage(partial(capsules, mode=cover), tube)
    for refine in (True, False):
        run = partial(balls, mode=cover, refine=refine)
        STAGES[f"balls {cover}, refined: {refine}"] = Stage(run, FIGURES)
SILENT = ("outward faces", "scan", "smooth vertices", "structure", "inscribed balls")
WATCHED = [name for name in STAGES if name not in SILENT]
WATCHED = [name for name in WATCHED if name not in ("distances", "least capsules", "buried")]


@pytest.fixture(scope="module")
def plain(medial):
    """name -> the arrays of a stage by one thread, computed once."""
    found = {}

    def of(name):
        if name not in found:
            found[name] = STAGES[name].run(medial, 1.0, threads=1)
        return found[name]

    return of


@pytest.mark.parametrize("name", STAGES)
def test_any_number_of_threads_gives_the_same_bytes(medial, plain, name):
    for threads in (2, 5):
        again = STAGES[name].run(medial, 1.0, threads=threads)
        for key, value in plain(name).items():
            assert np.asarray(value).tobytes() == np.asarray(again[key]).tobytes(), (key, threads)


@pytest.mark.parametrize("power", [-60, 60])
@pytest.mark.parametrize("name", STAGES)
def test_a_power_of_two_changes_the_unit_alone(medial, plain, name, power):
    found = STAGES[name].run(medial, 2.0**power)
    for key, unit in STAGES[name].powers.items():
        assert np.array_equal(found[key], np.asarray(plain(name)[key]) * 2.0 ** (power * unit)), key


@pytest.mark.parametrize("power", [-160, 150])
@pytest.mark.parametrize("name", ["sides by normals", "hierarchy"])
def test_so_does_one_at_the_ends_of_the_documented_range(medial, plain, name, power):
    test_a_power_of_two_changes_the_unit_alone(medial, plain, name, power)


@pytest.mark.parametrize("name", [*WATCHED, "buried"])
def test_each_stage_is_watched_and_can_be_cancelled(medial, name):
    progress = medial.Progress()
    STAGES[name].run(medial, 1.0, progress=progress)
    assert progress.fraction > 0.5 and progress.stage
    progress.cancel()
    with pytest.raises(medial.Cancelled):
        STAGES[name].run(medial, 1.0, progress=progress)


THREADED = [name for name in STAGES if name not in ("hierarchy", "feature size")]


@pytest.mark.parametrize("name", THREADED)
def test_fewer_threads_than_none_are_refused(medial, name):
    with pytest.raises(medial.InvalidInputError, match="threads"):
        STAGES[name].run(medial, 1.0, threads=-1)
