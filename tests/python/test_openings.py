# SPDX-License-Identifier: GPL-3.0-or-later
"""The solid of an open mesh: where its winding number is above one half, closed by samples of that level."""

import re

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute, compute_axis
from medial_axis.core.axis.medial_axis import ON_CREASE
from medial_axis.core.errors import DegenerateInputError
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.settings import SamplingMode, Settings, Side, SidesFrom, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.compute import compute_skeleton
from support import meshes, reference

pytestmark = pytest.mark.oracle

BALL = meshes.icosphere(4)
BOWL = meshes.below(BALL, 0.0)
OPEN_BOX = meshes.below(meshes.box((8, 8, 8), (1.0, 1.0, 1.0)), 1.0 - 1e-9)
OPENED = meshes.below(BALL, 0.8)
# Like Suzanne's eyes: an open ball that looks out of the opening of another one, its own opening inside.
EYE = meshes.join(OPENED, meshes.flip((0.5 * BALL[0] * (1, 1, -1) + (0, 0, 0.65), OPENED[1])))


def sampled(medial, mesh, count=4000):
    found = medial.sample_surface(*mesh, count=count)
    return found, medial.closing_samples(found.points, found.normals, found.radius, *mesh)


@pytest.mark.parametrize("mesh, lid", [(BOWL, 0.0), (OPEN_BOX, 1.0)], ids=["bowl", "box"])
def test_a_plane_opening_gets_a_plane_lid(medial, mesh, lid):
    """The solid angle of a bowl, and of a box without lid, is half of all from each place of the lid."""
    found, (points, normals, _) = sampled(medial, mesh)
    assert np.abs(points[:, 2] - lid).max() < (0.08 if lid == 0.0 else 1e-4)
    assert (normals[:, 2] > 0.5).all() and np.median(normals[:, 2]) > 0.999
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0)
    area = np.pi if lid == 0.0 else 4.0
    expected = area / found.area * len(found.points)
    assert 0.75 * expected < len(points) < 1.3 * expected


@pytest.mark.parametrize("mesh", [BOWL, OPEN_BOX, EYE], ids=["bowl", "box", "eye"])
def test_they_lie_where_the_winding_number_is_a_half_and_as_far_apart_as_the_others(medial, mesh):
    found, (points, normals, radius) = sampled(medial, mesh)
    assert len(points) > 20
    winding = reference.winding_number(points, *mesh)
    np.testing.assert_allclose(winding, 0.5, atol=3e-6)
    step = 1e-3 * radius[:, None] * normals
    falls = reference.winding_number(points + step, *mesh)
    assert (falls < reference.winding_number(points - step, *mesh)).all()
    assert radius == pytest.approx(found.radius[0])
    apart = np.linalg.norm(points[:, None] - points, axis=2)
    alike = (normals @ normals.T > 0) & ~np.eye(len(points), dtype=bool)
    assert apart[alike].min() > 0.85 * radius[0]
    away = np.linalg.norm(points[:, None] - found.points, axis=2)
    assert away[normals @ found.normals.T > 0].min() > 0.85 * radius[0]


def test_they_leave_no_hole(medial):
    found, (points, _, radius) = sampled(medial, BOWL)
    turn, out = np.meshgrid(np.linspace(0, 6.28, 90), np.linspace(0.0, 0.99, 40))
    lid = np.column_stack([(out * f(turn)).ravel() for f in (np.cos, np.sin)] + [0 * out.ravel()])
    all_points = np.concatenate((points, found.points))
    away = np.linalg.norm(lid[:, None] - all_points, axis=2).min(axis=1)
    assert away.max() < 1.7 * radius[0]


def test_closed_triangles_need_none(medial):
    _, (points, normals, radius) = sampled(medial, BALL)
    assert points.shape == normals.shape == (0, 3) and radius.shape == (0,)
    nothing = np.zeros((0, 3))
    assert len(medial.closing_samples(nothing, nothing, np.zeros(0), *BOWL)[0]) == 0


ONE, RADIUS = np.array([[0.0, 0.0, -1.0]]), np.array([0.1])


@pytest.mark.parametrize(
    "arguments, word",
    [
        ((ONE, ONE[:0], RADIUS, *BOWL), "one normal and one radius"),
        ((ONE, ONE, RADIUS[:0], *BOWL), "one normal and one radius"),
        ((ONE, ONE, -RADIUS, *BOWL), "positive radii"),
        ((ONE, ONE, np.nan * RADIUS, *BOWL), "positive radii"),
        ((np.nan * ONE, ONE, RADIUS, *BOWL), "finite coordinates"),
        ((ONE, ONE, RADIUS, BOWL[0][:-90], BOWL[1]), "triangle corners below"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_closing_checks_its_input(medial, arguments, word):
    with pytest.raises(medial.InvalidInputError, match=rf"^Expected .*{re.escape(word)}.*found.+;"):
        medial.closing_samples(*arguments)


def surface(mesh, count=4000, **settings):
    return compute(*mesh, Settings(sampling=SamplingMode.SURFACE, samples=count, **settings))


@pytest.mark.parametrize(
    "mesh", [BOWL, OPEN_BOX, pytest.param(EYE, marks=pytest.mark.slow)], ids=["bowl", "box", "eye"]
)
def test_an_open_solid_is_one_piece_without_holes(medial, mesh):
    found = surface(mesh)
    samples = found.chosen.samples
    assert found.settings.sides is SidesFrom.SURFACE and "winding number" in found.sides.reason
    assert np.count_nonzero(samples.kinds == int(medial.SampleKind.OPENING)) > 20
    assert any("close the openings" in text for text in found.warnings)
    assert tuple(samples.analysis.hierarchy().betti) == (1, 0, 0)
    axis = found.axis
    on_edge = axis.level.place >= ON_CREASE
    assert (reference.winding_number(axis.vertices[~on_edge], *mesh) > 0.5).all()
    assert (axis.radius[on_edge] == 0).all() and (axis.radius[~on_edge] > 0).all()


def test_what_lies_inside_is_left_out():
    found = surface(EYE)
    assert found.chosen.samples.buried > 100
    assert any("bounds nothing" in text for text in found.warnings)


def test_the_axis_of_a_bowl_is_that_of_the_half_ball():
    """With its lid, as a closed mesh."""
    found = surface(BOWL, 8000).axis
    away = np.abs(np.linalg.norm(found.vertices, axis=1) - 1.0 + found.radius)
    assert away.max() < 0.03  # equally far from the ball
    high = found.radius > 0.2
    assert np.abs(found.radius + found.vertices[:, 2])[high].max() < 0.03  # and from the lid
    assert high.sum() > 400


def waves(height):
    """A wavy sheet: half of it bounds a solid of lenses, which nobody means."""
    flat, triangles = meshes.rectangle(30, 30)
    up = height * np.sin(12 * flat[:, 0]) * np.sin(11 * flat[:, 1])
    return np.column_stack((flat, up)), triangles


@pytest.mark.parametrize("height", [1e-3, 0.02, 0.1])
@pytest.mark.parametrize("sampling", [SamplingMode.SURFACE, SamplingMode.VERTICES])
def test_a_sheet_has_no_inside(height, sampling):
    """Its axis once was a point a million units away, with the advice to turn its normals round."""
    for side in (Side.INNER, Side.OUTER):
        with pytest.raises(DegenerateInputError, match="found an open sheet.*give it thickness"):
            compute(*waves(height), Settings(sampling=sampling, samples=4000, side=side))


def test_a_sheet_has_two_sides():
    found = surface(waves(0.1), side=Side.BOTH)
    assert found.settings.sides is SidesFrom.NORMALS and found.chosen.samples.buried == 0
    assert found.sides.reason.startswith("those of the faces")


def test_chosen_normals_are_kept(medial):
    found = surface(BOWL, sides=SidesFrom.NORMALS)
    samples = found.chosen.samples
    assert samples.buried == 0 and samples.kinds.max() == int(medial.SampleKind.SURFACE)


@pytest.mark.parametrize(
    "name, most",
    [
        ("human_woman.obj", 7),
        pytest.param("elephant-with-holes.off", 3, marks=pytest.mark.slow),
        ("stanford-bunny.obj", 0),
    ],
)
def test_tunnels_of_real_meshes(data_file, name, most):
    found = compute_axis(read_shape(data_file(name))[0], Settings())
    pieces, tunnels, cavities = found.chosen.samples.analysis.hierarchy().betti
    assert pieces == 1 and cavities == 0 and tunnels <= most


def vessel(slope, bend, flare):
    """An open pipe of radius 1, cut at slants at both ends, which may bend and become wider."""
    along, round_ = np.linspace(0, 1, 50), 2 * np.pi * np.arange(24) / 24
    radius = 1.0 + flare * along
    flat = radius[:, None, None] * np.stack((np.cos(round_), np.sin(round_)), -1)
    up = 16 * along[:, None] + slope * flat[:, :, 0] * (2 * along[:, None] - 1)
    turn_ = bend * along[:, None] + 0 * up
    at = np.stack((flat[:, :, 0] + 8 * turn_**2, flat[:, :, 1], up), -1).reshape(-1, 3)
    ids = np.pad(np.arange(len(at)).reshape(50, 24), ((0, 0), (0, 1)), "wrap")
    return at, meshes.lattice(ids.T)


@pytest.mark.parametrize(
    "slope, bend, flare", [(1, 0, 0), (2, 0, 0.3), (1, -0.3, 0), (0.5, 0.2, 0.1)]
)
def test_no_limb_leads_into_the_corner_of_a_lid(slope, bend, flare):
    """An opening at a slant meets the wall in a sharp edge: the limb led there, with radii of a fiftieth."""
    found = compute_skeleton(Shape(*vessel(slope, bend, flare)), Settings(), SkeletonSettings())
    assert len(found.curve.branches) == 1
    assert found.curve.radius.min() > 0.85
    assert np.ptp(found.curve.points[:, 2]) > 16 - 2 * (1 + slope) * (1 + flare)
