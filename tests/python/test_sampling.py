"""Samples of triangulated surfaces: blue noise without holes, creases covered, deterministic, for any mesh."""

import distance
import meshes
import numpy as np
import pytest
from scipy.spatial import cKDTree

CORNER, SHARP, BOUNDARY, VERTEX, SURFACE = range(5)
MESHES = {
    "icosphere": meshes.icosphere(3),
    "fine icosphere": meshes.icosphere(5),
    "torus": meshes.torus(),
    "cube": meshes.box((1, 1, 1)),
    "box": meshes.box(),
}


def spacing_of(samples):
    return np.sqrt(2 * samples.area / np.sqrt(3) / len(samples.points))


@pytest.mark.parametrize("name", MESHES)
def test_blue_noise_without_holes(medial, name):
    vertices, triangles = MESHES[name]
    samples = medial.sample_surface(vertices, triangles, count=3000)
    spacing, surface = spacing_of(samples), samples.kind == SURFACE
    tree = cKDTree(samples.points)
    nearest = tree.query(samples.points[surface], k=2)[0][:, 1]
    assert nearest.min() >= 0.7 * spacing
    assert (nearest >= samples.radius[surface] * (1 - 1e-12)).all()
    everywhere = distance.points_on_triangles(vertices[triangles], 100000, np.random.default_rng(0))
    assert tree.query(everywhere)[0].max() <= 1.25 * samples.radius[surface].max()


@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize("count", [500, 2000, 20000])
def test_count(medial, name, count):
    samples = medial.sample_surface(*MESHES[name], count=count)
    assert abs(len(samples.points) - count) <= 0.02 * count


def test_samples_lie_where_they_say(medial):
    vertices, triangles = meshes.box()
    samples = medial.sample_surface(vertices, triangles, count=2000)
    corners = vertices[triangles[samples.triangle]]
    assert np.allclose(
        np.einsum("ij,ijk->ik", samples.barycentric, corners), samples.points, atol=1e-12
    )
    assert samples.barycentric.min() >= 0
    surface = samples.kind == SURFACE
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    assert np.allclose(samples.normals[surface], normal[surface], atol=1e-12)
    assert (np.diff(samples.kind) >= 0).all()


def test_cube_edges_and_corners(medial):
    vertices, triangles = MESHES["cube"]
    samples = medial.sample_surface(vertices, triangles, spacing=0.1)
    assert len(samples.sharp_edges) == 12
    corners = samples.points[samples.kind == CORNER]
    assert {tuple(p) for p in corners} == {tuple(p) for p in vertices}
    tree = cKDTree(samples.points[samples.kind <= SHARP])
    for p, q in samples.sharp_edges:
        along = vertices[p] + np.linspace(0, 1, 200)[:, None] * (vertices[q] - vertices[p])
        assert tree.query(along)[0].max() <= 0.05 + 1e-9


@pytest.mark.parametrize("options", [{"count": 5000}, {"spacing": 0.05}])
def test_same_bytes_for_any_threads_and_others_for_another_seed(medial, options):
    def sample(**more):
        s = medial.sample_surface(*MESHES["torus"], **options, **more)
        return b"".join(
            getattr(s, x).tobytes() for x in ("points", "normals", "triangle", "kind", "radius")
        )

    first = sample(threads=1)
    assert all(sample(threads=threads) == first for threads in (1, 2, 3, 4))
    assert sample(seed=1) != first
