# SPDX-License-Identifier: GPL-3.0-or-later
"""Every error of the module's contract: the right class, one sentence, nothing half-made; valid extreme input."""

import itertools
import re
import threading
import time
from functools import partial

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.errors import InvalidInputError, MedialAxisError
from medial_axis.core.settings import SamplingMode, Settings
from support import inputs, measure, meshes, shapes
from support.readers import area_of

CLOUD = np.random.default_rng(0).random((50, 3))
BALL = meshes.icosphere(1)
STAGES = ("MedialAnalysis", "delaunay", "poles", "umbrellas", "TightCocone", "cocone")


def with_value(row, value):
    points = CLOUD.copy()
    points[row, 1] = value
    return points


def assert_refused(error, call):
    """The call raises this error, and what it says is returned: Expected ..., found ...; what to do."""
    with pytest.raises(error) as caught:
        call()
    text = str(caught.value)
    assert re.match(r"^Expected .+", text), text
    assert "found" in text and "\n" not in text and "nan" not in text.split("found")[0], text
    assert 20 < len(text) < 300, text
    return text


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize(
    "points",
    [
        CLOUD[:, :2], CLOUD.ravel(), CLOUD[None], np.zeros((5, 4)), np.zeros((3, 0)),
        CLOUD.astype(int), CLOUD > 0.5, CLOUD.astype(complex), CLOUD.astype(str),
        CLOUD.astype(object), np.float64(1.0),
    ],
)  # fmt: skip
def test_points_of_a_wrong_shape_or_type(study, stage, points):
    assert_refused(study.InvalidInputError, lambda: getattr(study, stage)(points))


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("row", [0, 17, 49])
def test_values_that_are_not_finite_name_their_row(study, stage, value, row):
    points = with_value(row, value)
    points[row + 20 :, 0] = np.inf  # the first row is named
    call = lambda: getattr(study, stage)(points)
    assert re.search(rf"\b{row}\b", assert_refused(study.InvalidInputError, call))


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize(
    "points",
    [
        CLOUD[:0],
        CLOUD[:1],
        CLOUD[:2],
        CLOUD[:3],
        np.ones((20, 3)),
        np.repeat(CLOUD[:3], 10, axis=0),
        np.outer(np.arange(20.0), [1, 2, 4]),
        np.column_stack((CLOUD[:, :2], np.zeros(50))),
        np.column_stack((CLOUD[:, :2], np.full(50, 7.25))),
        CLOUD @ np.diag([1, 1, 0]) + 3,
        np.zeros((4, 3)),
        np.column_stack((np.round(CLOUD[:, :2] * 64) / 64, np.round(CLOUD[:, 0] * 64) / 64)),
        inputs.grid((5, 5, 1)),
        inputs.grid((9, 1, 1)),
    ],
)
def test_points_without_volume(study, stage, points):
    assert_refused(study.DegenerateInputError, lambda: getattr(study, stage)(points))


@pytest.mark.parametrize(
    "triangles",
    [
        BALL[1].astype(float),
        BALL[1][:, :2],
        BALL[1].ravel(),
        np.zeros((2, 4), np.int32),
        BALL[1] > 3,
    ],
    ids=["float", "two columns", "flat", "quads", "bool"],
)
def test_triangles_of_a_wrong_shape_or_type(medial, triangles):
    assert_refused(medial.InvalidInputError, lambda: medial.MedialAnalysis(BALL[0], triangles))


@pytest.mark.parametrize("index", [-1, 42, 2**31 - 1, -(2**31)])
@pytest.mark.parametrize("row", [0, 79])
def test_triangles_that_name_no_point(medial, index, row):
    triangles = BALL[1].copy()
    triangles[row, 2] = index
    assert len(BALL[0]) == 42
    for call in (
        lambda: medial.MedialAnalysis(BALL[0], triangles),
        lambda: medial.winding_number(CLOUD, BALL[0], triangles),
    ):
        text = assert_refused(medial.InvalidInputError, call)
        assert re.search(rf"\b{row}\b|{index}", text)


def test_triangles_with_repeated_corners_are_harmless(medial):
    triangles = np.concatenate((BALL[1], [[0, 0, 1], [5, 5, 5]])).astype(np.int32)
    points = meshes.jitter(BALL, 1e-3)[0]
    sides = (medial.MedialAnalysis(points, faces).side for faces in (triangles, BALL[1]))
    assert np.array_equal(*sides)


@pytest.mark.parametrize(
    "name, values",
    [
        ("theta", [-1e-9, -1.0, np.pi / 2 + 1e-6, 22.5, np.nan, np.inf]),
        ("rho", [-1e-9, -8.0, np.nan]),
    ],
)
def test_thresholds_out_of_range(medial, name, values):
    analysis = medial.MedialAnalysis(CLOUD)
    for call, value in itertools.product((analysis.select, analysis.extract), values):
        refused = assert_refused(medial.InvalidInputError, partial(call, **{name: value}))
        assert name in refused


def test_limits_of_the_thresholds_are_valid(medial):
    analysis = medial.MedialAnalysis(CLOUD)
    assert len(analysis.select(np.pi / 2, 1e300)) == 0
    assert len(analysis.extract(np.pi / 2, np.inf).generators) == 0
    assert len(analysis.select(0.0, 0.0)) > len(analysis.select(0.1, 2.0))


def test_crossing_is_no_argument(medial):
    analysis = medial.MedialAnalysis(*meshes.jitter(BALL, 1e-3))
    with pytest.raises(medial.InvalidInputError):
        analysis.extract(side=medial.Side.CROSSING)


def test_an_open_mesh_may_be_asked_for_its_inner_axis(medial):
    vertices, triangles = meshes.jitter(meshes.icosphere(3), 1e-3)
    lidless = triangles[vertices[triangles].mean(axis=1)[:, 2] < 0.8]
    for source in (medial.SidesFrom.SURFACE, medial.SidesFrom.TIGHT_COCONE):
        analysis = medial.MedialAnalysis(vertices * (1.0, 0.7, 0.4), lidless, sides=source)
        assert not analysis.closed
        assert len(analysis.extract(side=medial.Side.INNER).generators) > 100


@pytest.mark.parametrize("argument", ["theta", "side", "rule", "criteria"])
def test_arguments_of_a_wrong_type(medial, argument):
    with pytest.raises(TypeError):
        medial.MedialAnalysis(CLOUD).extract(**{argument: "INNER"})


def test_errors_are_value_errors(medial):
    assert issubclass(medial.InvalidInputError, ValueError)
    assert issubclass(medial.DegenerateInputError, ValueError)
    assert issubclass(medial.Cancelled, Exception) and not issubclass(medial.Cancelled, ValueError)


@pytest.mark.parametrize(
    "queries", [CLOUD[:, :2], CLOUD.astype(int), with_value(3, np.nan)], ids=["2d", "int", "nan"]
)
def test_winding_number_checks_its_queries(medial, queries):
    assert_refused(medial.InvalidInputError, lambda: medial.winding_number(queries, *BALL))


# ---- cancelling


def cancelled(medial, when, work):
    """Whether work ends by Cancel from another thread when so much is done."""
    progress, raised = medial.Progress(), []

    def run():
        try:
            work(progress=progress)
        except medial.Cancelled as error:
            raised.append(error)

    (worker := threading.Thread(target=run)).start()
    while worker.is_alive() and progress.fraction < when:
        time.sleep(0.001)
    progress.cancel()
    worker.join(60)
    assert not worker.is_alive() and (0 <= progress.fraction < 1 or not raised)
    return bool(raised)


@pytest.mark.parametrize("when", [0.02, 0.3, 0.62])
def test_cancel_from_another_thread(medial, when):
    """At the start, during the triangulation and after: the computation raises, and the module works on."""
    points = np.random.default_rng(0).random((200_000, 3))
    assert cancelled(medial, when, partial(medial.MedialAnalysis, points))
    assert len(medial.MedialAnalysis(CLOUD).edges) > 0


def on_faces(medial, count):
    """The analysis of samples of a torus, and its faces."""
    mesh = meshes.torus(1.0, 0.4, 60, 30)
    samples = medial.sample_surface(*mesh, count=count, smooth=True)
    analysis = medial.MedialAnalysis(samples.points, mesh[1], vertices=mesh[0])
    return analysis, medial.Faces(*mesh, samples.triangle, smooth=True)


def crisp_places(medial):
    analysis, faces = on_faces(medial, 8000)
    return partial(analysis.hierarchy, faces=faces)


def fitted_curves(medial):
    hierarchy = medial.MedialAnalysis(*meshes.torus(1.0, 0.4, 200, 80)).hierarchy()
    return partial(hierarchy.extract, sheet=1.0, relaxed=True)


def tight_cocone(medial):
    return partial(medial.TightCocone, shapes.SHAPES["ellipsoid"].random_sample(30_000, 0))


@pytest.mark.parametrize("when", [0.0, 0.3, 0.5, 0.7, 0.9])
@pytest.mark.parametrize("stage", [crisp_places, fitted_curves, tight_cocone])
def test_cancel_in_every_stage(medial, stage, when):
    assert cancelled(medial, when, stage(medial)) or when > 0.0


def test_crisp_places_have_most_of_the_bar_as_of_the_time(medial):
    """They change neither the cells nor the exact places."""
    analysis, faces = on_faces(medial, 1500)
    progress, before, made = medial.Progress(), [], []
    work = lambda: made.append(analysis.hierarchy(faces=faces, progress=progress))
    (worker := threading.Thread(target=work)).start()
    while worker.is_alive():
        fraction = progress.fraction
        if progress.stage == "Crisp places":
            break
        before.append(fraction)
    worker.join(60)
    assert max(before) < 0.4 and progress.fraction == 1.0
    crisp, plain = (
        made[0].extract(spacings=1.0, round_limbs=True, crisp=crisp) for crisp in (True, False)
    )
    assert np.array_equal(crisp.face_vertices, plain.face_vertices)
    assert np.array_equal(crisp.exact, plain.vertices) and crisp.betti == plain.betti


def test_progress_rises_to_one_and_names_its_stages(medial):
    """This thread watches the progress while the other computes, so the GIL is released, too."""
    points = np.random.default_rng(0).random((60_000, 3))
    progress, seen = medial.Progress(), []
    assert progress.fraction == 0.0 and not progress.cancelled and isinstance(progress.stage, str)
    work = lambda: medial.MedialAnalysis(points, progress=progress).extract(progress=progress)
    (worker := threading.Thread(target=work)).start()
    while worker.is_alive():
        seen.append((progress.fraction, progress.stage))
        time.sleep(0.002)
    fractions = [fraction for fraction, _ in seen]
    assert fractions == sorted(fractions) and fractions[0] >= 0 and progress.fraction == 1.0
    assert len(set(fractions)) > 5 and "Delaunay triangulation" in {stage for _, stage in seen}


# ---- valid, but extreme


@pytest.mark.parametrize("size", [1e60, 1e155, 1e300, 1e-60, 1e-200, 5e-324])
def test_sizes_whose_squares_leave_the_doubles(medial, size):
    """An answer or a sentence, never a crash or a NaN."""
    points = shapes.SHAPES["ellipsoid"].sample(300, 0) * size
    try:
        mesh = medial.MedialAnalysis(points).extract()
    except (medial.InvalidInputError, medial.DegenerateInputError) as error:
        assert str(error).startswith("Expected ") and len(str(error)) < 250
        return
    assert np.isfinite(mesh.vertices).all() and np.isfinite(mesh.radius).all()
    assert np.isfinite(mesh.theta).all() and np.isfinite(mesh.rho).all()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("seed", range(4))
def test_a_rotated_box_keeps_its_inner_axis(medial, dtype, seed):
    """Coplanar faces, turned: nearly flat hull cells of any circumradius must cost no inner facet."""
    vertices, triangles = meshes.box((20, 14, 8))
    turn = inputs.rotation(seed)
    straight = medial.MedialAnalysis(vertices, triangles).extract(side=medial.Side.INNER)
    turned = medial.MedialAnalysis((vertices @ turn.T).astype(dtype), triangles).extract(
        side=medial.Side.INNER
    )
    one, other = (area_of(mesh.vertices, measure.polygons(mesh)) for mesh in (turned, straight))
    assert one == pytest.approx(other, rel=0.02)
    assert shapes.Box().axis_distance(turned.vertices @ turn).max() < 0.06
    assert np.isfinite(turned.vertices).all()


def test_a_rotated_box_of_random_samples_in_float64(medial):
    """Faces of many coplanar samples without a grid: flat cells with circumradii up to 1e16."""
    points, inner = shapes.Box().sample(1500, 0), []
    for frame in (np.eye(3), inputs.rotation(2)):
        mesh = medial.MedialAnalysis(points @ frame.T).extract()
        inside = shapes.Box().inside(mesh.vertices @ frame)
        facets = [inside[corners].all() for corners in measure.polygons(mesh)]
        inner.append({tuple(g) for g in mesh.generators[facets].tolist()})
    wanted, found = inner
    assert len(wanted ^ found) <= 0.005 * len(wanted)


@pytest.mark.parametrize(
    "points",
    [
        meshes.uv_sphere(64, 32)[0],
        meshes.icosphere(4)[0],
        inputs.grid((12, 12, 12)),
        inputs.prism(64, 8),
        np.concatenate((np.eye(3), -np.eye(3))),
    ],
    ids=["uv sphere", "icosphere", "grid", "prism", "octahedron"],
)
def test_exactly_cospherical_samples(medial, points):
    mesh = medial.MedialAnalysis(points).extract(0.1, 2.0)
    assert np.isfinite(mesh.vertices).all()
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)


def test_a_plain_cube_of_eight_vertices(medial):
    vertices, triangles = meshes.box((1, 1, 1))
    mesh = medial.MedialAnalysis(vertices, triangles).extract(0.0, 0.0)
    assert len(mesh.generators) == len(mesh.vertices) == 0
    assert np.array_equal(mesh.face_offsets, [0])


# --- settings of the Python interface


@pytest.mark.parametrize("name", ["side", "sides", "rule", "criteria", "sampling", "form"])
@pytest.mark.parametrize("value", [0, 1.5, float("nan"), "INNER", None])
def test_choices_are_of_their_kind(name, value):
    with pytest.raises(InvalidInputError) as error:
        Settings(**{name: value})
    assert name in str(error.value) and str(error.value).startswith("Expected ")


@pytest.mark.parametrize(
    "name, value", [("seed", 0.5), ("samples", 500.0), ("theta", "0.3"), ("spacing", None)]
)
def test_numbers_are_of_their_kind(name, value):
    with pytest.raises(InvalidInputError, match=f"Expected {name} to be of the kind"):
        Settings(**{name: value})
    for number in (np.float32(0.5), np.float64(0.5), 1):
        assert Settings(theta=number).theta == number
    assert Settings(samples=np.int64(500)).samples == 500


@pytest.mark.parametrize("spacing", [5e-324, 1e-200, 1e-100])
def test_a_spacing_next_to_nothing_is_refused_in_a_sentence(spacing):
    with pytest.raises(MedialAxisError) as error:
        compute(*BALL, Settings(spacing=spacing, sampling=SamplingMode.SURFACE))
    assert str(error.value).startswith("Expected ") and "\n" not in str(error.value)
