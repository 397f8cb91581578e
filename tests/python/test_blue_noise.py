# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges of the sampling that know nothing of how it is done: even, apart, without holes, blind to the triangulation.

White noise, as areas alone would give, has chi-square 1 per degree of freedom and a flat spectrum of 1; blue noise
stays far below both at long range, and above the disc's radius at short range.
"""

from functools import cache

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import distance, meshes, resampled, shape_meshes

pytestmark = pytest.mark.oracle

CORNER, SHARP, BOUNDARY, VERTEX, SURFACE = range(5)


def needles(around: int = 700) -> meshes.Mesh:
    """A cylinder as CAD programs make it: triangles as long as the whole."""
    return meshes.lathe(np.array([[0, -1.0], [0.5, -1.0], [0.5, 1.0], [0, 1.0]]), around)


def uneven_box() -> meshes.Mesh:
    """Two large triangles on most faces, 3,200 tiny ones on one."""
    vertices, triangles = meshes.box((1, 1, 1))
    fine, cells = meshes.rectangle(40, 40)
    lid = vertices[triangles][:, :, 2].min(axis=1) > 0.39
    top = np.column_stack((fine * (1.0, 0.7), np.full(len(fine), 0.4)))
    return meshes.join((vertices, triangles[~lid]), (top, cells))


MESHES = {
    name: shape_meshes.MESHED[name][1]
    for name in ("ellipsoid", "box", "cylinder", "torus", "spherical shell", "cone", "slab")
} | {"needles": needles(), "uneven box": uneven_box(), "grid box": meshes.box((12, 9, 6))}


@pytest.fixture(scope="module")
def sampled(medial):
    return cache(lambda name, count=6000: medial.sample_surface(*MESHES[name], count=count))


def spacing(samples):
    return resampled.spacing(samples.area, len(samples.points))


# --- even


def unevenness(mesh, points):
    """Chi-square per degree of freedom over patches of the surface, each of about 60 samples."""
    vertices, triangles = mesh
    rng = np.random.default_rng(3)
    dense = distance.points_on_triangles(vertices[triangles], 400_000, rng)
    centres = cKDTree(dense[:: len(dense) // 100])
    share = np.bincount(centres.query(dense)[1], minlength=centres.n) / len(dense)
    count = np.bincount(centres.query(points)[1], minlength=centres.n)
    wanted = share * len(points)
    return np.mean((count - wanted) ** 2 / wanted)


@pytest.mark.parametrize("name", MESHES)
def test_counts_follow_the_area(sampled, name):
    assert unevenness(MESHES[name], sampled(name).points) < 0.5


@pytest.mark.parametrize(
    "name, count",
    [(n, c) for n in ("ellipsoid", "torus") for c in (1500, 12_000)]
    + [(n, c) for n in ("grid box", "uneven box", "cone") for c in (12_000, 40_000)],
)
def test_counts_do_not_see_the_triangles(sampled, name, count):
    """Inside triangles and at their borders there are as many as the area says: by the least barycentric coordinate,
    whose shares of every triangle's area are 1 - (1 - 3 t)^2, for samples on the faces away from creases."""
    samples = sampled(name, count)
    creases = samples.points[samples.kind < VERTEX]
    rows = samples.kind == SURFACE
    if len(creases):
        vertices, triangles = MESHES[name]
        away = cKDTree(creases).query(vertices)[0] > 2 * spacing(samples)
        rows &= away[triangles].all(axis=1)[samples.triangle]
    least = samples.barycentric[rows].min(axis=1)
    bins = 1 - (1 - 3 * least) ** 2  # uniform on [0, 1] for uniform samples
    found, _ = np.histogram(bins, 5, (0, 1))
    assert rows.sum() > 300
    wanted = rows.sum() / 5
    assert ((found - wanted) ** 2 / wanted).sum() < 18.5  # p = 0.001 of white noise


@pytest.mark.parametrize("seed", range(3))
def test_spectrum_has_no_long_waves(medial, seed):
    """The square of two triangles, waves that fit into it, up to half of the spacing's frequency."""
    face, triangles = meshes.rectangle(1, 1)
    vertices = np.column_stack((face, np.zeros(4)))
    samples = medial.sample_surface(vertices, triangles, count=4000, seed=seed)
    assert long_waves(samples.points[:, :2], spacing(samples)) < 0.3


def long_waves(x, spacing):
    """Mean power over that of independent points."""
    top = int(0.5 * 2.0 / spacing)
    waves = np.array([(i, j) for i in range(top) for j in range(top) if 0 < np.hypot(i, j) < top])
    phase = np.pi * (x @ waves.T)
    power = (np.cos(phase).sum(axis=0) ** 2 + np.sin(phase).sum(axis=0) ** 2) / len(x)
    return power.mean()


def test_white_noise_fails_these_judges():
    rng = np.random.default_rng(0)
    mesh = MESHES["ellipsoid"]
    assert unevenness(mesh, distance.points_on_triangles(mesh[0][mesh[1]], 6000, rng)) > 0.7
    assert long_waves(rng.uniform(-1, 1, (4000, 2)), resampled.spacing(4.0, 4000)) > 0.7


# --- apart


@pytest.mark.parametrize("name", ["grid box", "uneven box", "ellipsoid", "cylinder"])
def test_no_clusters_at_borders_of_triangles(sampled, name):
    """A sample's nearest neighbour is as far when it lies on another triangle as when it lies on the same one."""
    samples = sampled(name, 12_000)
    tree = cKDTree(samples.points)
    away, nearest = tree.query(samples.points, k=2)
    rows = np.flatnonzero(samples.kind == SURFACE)
    rows = rows[samples.kind[nearest[rows, 1]] == SURFACE]
    same = samples.triangle[rows] == samples.triangle[nearest[rows, 1]]
    assert same.sum() > 100 and (~same).sum() > 100
    within, across = np.median(away[rows[same], 1]), np.median(away[rows[~same], 1])
    assert across == pytest.approx(within, rel=0.06)


def test_walls_of_a_thin_sheet_do_not_see_each_other(medial):
    """Each has the density that it would have alone, though the other is much nearer than the spacing."""
    thin = meshes.box((1, 1, 1), (1.0, 1.0, 1e-4))
    samples = medial.sample_surface(*thin, count=4000)
    sides = [np.sum((samples.kind == SURFACE) & (samples.normals[:, 2] * s > 0.9)) for s in (1, -1)]
    assert min(sides) > 0.45 * len(samples.points)


# --- creases


def creases_of(mesh, angle=np.pi / 6):
    """Sharp edges and edges of one triangle, as pairs of coordinates: by a dictionary and nothing else."""
    vertices, triangles = mesh
    _, rows = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    rows = rows.reshape(-1)
    corners = vertices[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    users = {}
    for face, corner in enumerate(rows[triangles].tolist()):
        for a, b in zip(corner, corner[1:] + corner[:1]):
            if a != b:
                users.setdefault((min(a, b), max(a, b)), []).append((face, a < b))
    first = np.zeros(rows.max() + 1, dtype=int)
    first[rows[::-1]] = np.arange(len(rows))[::-1]
    sharp, boundary = [], []
    for (a, b), uses in users.items():
        ends = (vertices[first[a]], vertices[first[b]])
        if len(uses) == 1:
            boundary.append(ends)
            continue
        (one, way), (other, back) = uses[:2]
        if len(uses) > 2 or way == back or normal[one] @ normal[other] <= np.cos(angle):
            sharp.append(ends)
    return np.array(sharp).reshape(-1, 2, 3), np.array(boundary).reshape(-1, 2, 3)


def assert_creases_are_covered(samples, mesh, doubtful=0):
    sharp, boundary = creases_of(mesh)
    assert len(samples.sharp_edges) == pytest.approx(len(sharp), abs=doubtful)
    on_creases = samples.points[samples.kind <= BOUNDARY]
    assert len(on_creases) or not len(sharp) + len(boundary)
    edges = np.concatenate((sharp, boundary))
    if len(edges):
        t = np.linspace(0, 1, 41)[:, None, None]
        along = (edges[:, 0] + t * (edges[:, 1] - edges[:, 0])).reshape(-1, 3)
        assert cKDTree(on_creases).query(along)[0].max() <= 0.51 * spacing(samples)
        on_edges = samples.points[(samples.kind == SHARP) | (samples.kind == BOUNDARY)]
        assert distance.to_triangles(on_edges, edges[:, [0, 1, 1]]).max() < 1e-9 * np.ptp(mesh[0])
    corners = samples.points[samples.kind == CORNER]
    assert not len(corners) or cKDTree(mesh[0]).query(corners)[0].max() == 0.0


@pytest.mark.parametrize(
    "file", ["fandisk_large.off", "mannequin.off", "openscad-nonmanifold-crash.obj"]
)
def test_creases_of_real_meshes_are_covered(medial, data_file, file):
    mesh = meshes.read(data_file(file))
    # It has edges of four triangles, and faces that cancel each other.
    doubtful = 10 if "nonmanifold" in file else 0
    assert_creases_are_covered(medial.sample_surface(*mesh, count=10_000), mesh, doubtful)
