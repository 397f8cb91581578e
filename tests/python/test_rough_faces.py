# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces with noise or steps: what is measured, and where the vertices go."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.samples.rough_faces import are_cubes, smooth_faces
from medial_axis.core.samples.sampling_report import report_sampling
from medial_axis.core.settings import Form, Mesh, Prepare, SamplingMode, Settings, SidesFrom
from medial_axis.core.shape.shape import Shape
from medial_axis.core.shape.triangles import area_vectors
from support.data import DATA
from support.inputs import rotation
from support.meshes import box, icosphere, torus
from support.messy import soup
from support.shapes import SHAPES


@cache
def sphere(noise, subdivisions=5):
    """10,242 vertices, or fewer, with errors of so many edges along the normals."""
    points, triangles = icosphere(subdivisions)
    edge = float(np.linalg.norm(points[triangles[0, 0]] - points[triangles[0, 1]]))
    errors = np.random.default_rng(1).normal(size=(len(points), 1))
    return points * (1.0 + noise * edge * errors), np.asarray(triangles, np.int32)


def cubes(cells):
    """A ball of cubes: their corners and the quadrangles of their sides, in steps."""
    axis = np.arange(-cells, cells + 1)
    inside = (np.stack(np.meshgrid(axis, axis, axis), -1) ** 2).sum(-1) < (cells - 1) ** 2
    quads = []
    for along in range(3):
        for step in (1, -1):
            cell = np.argwhere(inside & ~np.roll(inside, -step, axis=along))
            corner = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])[::step]
            quad = np.repeat(cell[:, None], 4, axis=1)
            quad[:, :, (along + 1) % 3] += corner[:, 0]
            quad[:, :, (along + 2) % 3] += corner[:, 1]
            quad[:, :, along] += step > 0
            quads.append(quad)
    corners = np.concatenate(quads)
    points, row = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return (points - cells - 0.5).astype(float), row.reshape(-1, 4)


def halves(quads):
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int32)


def between(points, quads):
    """Each corner in the middle of the sides round it, as programs make surfaces of voxels."""
    sums = np.zeros_like(points)
    np.add.at(sums, quads, points[quads].mean(axis=1)[:, None])
    return sums / np.bincount(quads.ravel())[:, None]


def prepared(mesh, **options):
    shape = Shape(*mesh)
    return shape, *smooth_faces(shape, Settings(**options))


def off(points, radius=1.0):
    return float(np.std(np.linalg.norm(points, axis=1) / radius))


@pytest.mark.parametrize("noise", [0.15, 0.3, 0.5])
def test_noise_is_measured_and_moved_away(noise):
    shape, found, said = prepared(sphere(noise))
    assert off(found.points) < 0.45 * off(shape.points)
    assert abs(np.linalg.norm(found.points, axis=1).mean() - 1.0) < 0.002
    assert found.triangles is shape.triangles and "their vertices were moved" in said


def test_steps_of_voxels_are_moved_away():
    points, quads = cubes(30)
    for places, wanted, left in (
        (between(points, quads), Prepare.AUTOMATIC, 0.6),
        (points, Prepare.ALWAYS, 0.35),
    ):
        shape, found, said = prepared((places, halves(quads)), prepare=wanted)
        assert off(found.points, 29) < left * off(shape.points, 29) and "steps of about" in said


@pytest.mark.parametrize("kind", ["along the axes", "turned", "apart", "with grass"])
def test_cubes_stay_cubes(kind):
    """As of voxel art: their steps are meant, and only Always moves them."""
    points, quads = cubes(30)
    triangles = halves(quads)
    if kind == "turned":
        points = np.float64(np.float32(points @ rotation(1)))
    if kind == "apart":
        points, triangles = soup((points, triangles))
    if kind == "with grass":
        blade = points[triangles[:20]].reshape(-1, 3) @ rotation(1)
        triangles = np.vstack([triangles, len(points) + np.arange(60).reshape(-1, 3)])
        points, triangles = np.vstack([points, blade]), triangles.astype(np.int32)
    shape, found, said = prepared((points, triangles))
    assert found is shape and "sides of cubes" in said
    assert prepared((points, triangles), prepare=Prepare.OFF)[2] == ""


def test_a_prism_has_no_cubes():
    """All faces of a round bar are along its axis or across it, but in more than three directions."""
    points, triangles = sphere(0.0)
    assert not are_cubes(area_vectors(points * (1.0, 1.0, 1e4), triangles)[0])
    assert are_cubes(area_vectors(*box((24, 20, 16)))[0])


@pytest.mark.parametrize(
    "mesh", [sphere(0.0), torus(1.0, 0.4, 90, 40), box((24, 20, 16))], ids=["ball", "ring", "box"]
)
def test_clean_faces_stay_the_same(mesh):
    for wanted in (Prepare.AUTOMATIC, Prepare.ALWAYS, Prepare.OFF):
        shape, found, said = prepared(mesh, prepare=wanted)
        assert found is shape and said == ""


@pytest.mark.skipif(not DATA.is_dir(), reason=f"needs {DATA}")
@pytest.mark.parametrize("name", ["fandisk_large.off", "engine_parts.ply", "spot_low.obj"])
def test_edges_and_thin_walls_are_no_noise(name):
    given = read_shape(DATA / name)[0]
    assert smooth_faces(given, Settings(prepare=Prepare.ALWAYS)) == (given, "")


def test_off_and_a_wrap_leave_the_faces():
    shape, found, said = prepared(sphere(0.3), prepare=Prepare.OFF)
    assert found is shape and "left as they are" in said
    shape, found, said = prepared(sphere(0.3), sides=SidesFrom.WRAP)
    assert found is shape and said == ""


def test_faces_without_common_corners_are_one_surface():
    """Each triangle has its own corners, as in STL files; those in one place stay in one place."""
    points, triangles = sphere(0.3)
    _, found, _ = prepared(soup((points, triangles)))
    assert len(np.unique(found.points, axis=0)) == len(points)
    assert off(found.points) < 0.45 * off(points)


def assert_moved_by_always_alone(mesh, words):
    shape, found, said = prepared(mesh)
    assert found is shape and said == ""
    assert words in prepared(mesh, prepare=Prepare.ALWAYS)[2]


def test_few_faces_are_no_noise_unless_someone_says_so():
    """Details of a shape that was modelled coarse are as large as its faces, as those of Blender's monkey."""
    assert_moved_by_always_alone(sphere(0.3, 3), "their vertices were moved")


def test_designed_faces_of_uneven_size_are_no_noise():
    """As of a plate with letters: faces that are small at one end, and errors of a share of their size."""
    points, triangles = sphere(0.3)
    mesh = points * np.exp(3.0 * points[:, 2:]), triangles
    assert_moved_by_always_alone(mesh, "spacings were found in the faces")


@pytest.mark.parametrize("scale", [2.0**160, 2.0**-160])
def test_the_largest_and_smallest_coordinates(scale):
    points, triangles = sphere(0.3)
    _, found, _ = prepared((scale * points, triangles))
    assert np.array_equal(found.points, scale * prepared((points, triangles))[1].points)


def test_normals_have_to_fit(medial):
    points = sphere(0.0)[0]
    with pytest.raises(ValueError, match="one normal per point"):
        medial.surface_noise(points, points[:-1])


def noisy_ring():
    """Errors of a third of an edge."""
    points, triangles = torus(1.0, 0.4, 90, 40)
    return points + np.random.default_rng(1).normal(size=points.shape) * 0.022, triangles


def test_the_report_has_the_samples_of_the_axis():
    points, triangles = noisy_ring()
    settings = Settings(sampling=SamplingMode.VERTICES, form=Form.PUBLISHED)
    report = report_sampling(Shape(points, triangles), settings)
    axis = compute(points, triangles, settings)
    assert report.chosen.samples.kept.key == axis.key
    assert np.array_equal(report.vertices, axis.chosen.samples.points)
    assert any("were found in the faces" in said for said in report.warnings)
    assert np.allclose(report.moved, np.linalg.norm(report.vertices - points, axis=1))
    assert report.moved.any()


def test_the_axis_of_a_noisy_ring_is_a_ring():
    """As it is, the axis has flakes; prepared, it lies on the circle."""
    settings = Settings(sampling=SamplingMode.VERTICES, mesh=Mesh.VORONOI)
    off, found = (
        compute(*noisy_ring(), replace(settings, prepare=prepare))
        for prepare in (Prepare.OFF, Prepare.AUTOMATIC)
    )
    assert found.axis.level.betti == (1, 1, 0)
    away, before = (SHAPES["torus"].axis_distance(x.axis.vertices).mean() for x in (found, off))
    assert away < 0.02 < 0.05 < before
    assert any("were found in the faces" in said for said in found.warnings)
