# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples of triangulated surfaces: blue noise without holes, creases covered, deterministic, for any mesh."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree
from support import distance, meshes, resampled, thick_meshes, topology
from support.plates import prism
from support.shapes import SHAPES, Sphere

pytestmark = pytest.mark.oracle

CORNER, SHARP, BOUNDARY, VERTEX, SURFACE = range(5)
MESHES = {
    "icosphere": meshes.icosphere(3),
    "fine icosphere": meshes.icosphere(5),
    "torus": meshes.torus(),
    "cube": meshes.box((1, 1, 1)),
    "box": meshes.box(),
}


def spacing_of(samples):
    return resampled.spacing(samples.area, len(samples.points))


@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize("count", [500, 2000, 20000])
def test_count(medial, name, count):
    samples = medial.sample_surface(*MESHES[name], count=count)
    assert abs(len(samples.points) - count) <= 0.02 * count


def test_samples_lie_where_they_say(medial):
    vertices, triangles = meshes.box()
    samples = medial.sample_surface(vertices, triangles, count=2000)
    assert np.allclose(places_of(samples, vertices, triangles), samples.points, atol=1e-12)
    assert samples.barycentric.min() >= 0
    surface = samples.kind == SURFACE
    normal = topology.unit_normals(vertices, triangles[samples.triangle])
    assert np.allclose(samples.normals[surface], normal[surface], atol=1e-12)
    assert (np.diff(samples.kind) >= 0).all()


def places_of(samples, vertices, triangles):
    corners = vertices[triangles[samples.triangle]]
    return np.einsum("ij,ijk->ik", samples.barycentric, corners)


def test_cube_edges_and_corners(medial):
    vertices, triangles = MESHES["cube"]
    samples = medial.sample_surface(vertices, triangles, spacing=0.1)
    assert len(samples.sharp_edges) == 12
    corners = samples.points[samples.kind == CORNER]
    assert {tuple(p) for p in corners} == {tuple(p) for p in vertices}
    assert farthest_from_samples(samples, vertices) <= 0.05 + 1e-9


def test_density_of_curved_triangles_is_even(medial):
    """Sixteen sides of a cylinder, each bent to an arc: as many samples in the middle of a side as at its ends."""
    # without rows along the rims, which are as regular as the sides and would show in the counts
    samples = medial.sample_surface(*cylinder(16), count=20000, smooth=True, mirrored_rows=0)
    side = (np.abs(samples.normals[:, 2]) < 0.1) & (np.abs(samples.points[:, 2]) < 0.9)
    turn = np.arctan2(samples.points[side, 1], samples.points[side, 0]) * 16 / (2 * np.pi) % 1
    found = np.histogram(turn, 8, (0, 1))[0]
    assert np.allclose(found, found.mean(), rtol=0.04)


def cylinder(sides):
    """The height is from -1 to 1, and the radius is 1."""
    turn = np.arange(sides) * 2 * np.pi / sides
    ring = np.column_stack((np.cos(turn), np.sin(turn)))
    vertices, triangles = prism(ring, [(0, k, k + 1) for k in range(1, sides - 1)], 2)
    return vertices - (0, 0, 1), triangles


def farthest_from_samples(samples, vertices):
    """Largest distance of a place on a sharp edge to the samples of creases."""
    ends = vertices[samples.sharp_edges]
    along = ends[:, :1] + np.linspace(0, 1, 200)[:, None] * (ends[:, 1:] - ends[:, :1])
    tree = cKDTree(samples.points[samples.kind <= BOUNDARY])
    return tree.query(along.reshape(-1, 3))[0].max()


def test_prism_at_the_threshold_is_sharp_everywhere_or_nowhere(medial):
    """Twelve sides turn by 30 degrees, up to rounding: rounding must not choose some of the edges."""
    vertices, triangles = cylinder(12)
    samples = medial.sample_surface(vertices, triangles, spacing=0.2)
    ends = vertices[samples.sharp_edges][:, :, 2]
    assert (ends[:, 0] != ends[:, 1]).sum() == 12
    more = medial.sample_surface(vertices, triangles, spacing=0.2, sharp_angle=np.radians(31))
    assert len(more.sharp_edges) == 24


def test_marked_edges_are_sharp_in_either_direction(medial):
    vertices, triangles = meshes.icosphere(3)
    plain = medial.sample_surface(vertices, triangles, spacing=0.2)
    assert len(plain.sharp_edges) == 0
    edge = np.sort(triangles[5][:2])
    for marked in (edge, edge[::-1]):
        pairs = np.array([marked, [0, 1]], dtype=np.int32)  # 0, 1 is no edge
        samples = medial.sample_surface(vertices, triangles, spacing=0.2, sharp_edges=pairs)
        assert samples.sharp_edges.tolist() == [edge.tolist()]
        assert (samples.kind == CORNER).sum() == 2


def test_tip_of_a_cone_is_kept(medial):
    cone = thick_meshes.lathe([(0, 0), (1, 0), (0, 2)], 64)
    samples = medial.sample_surface(*cone, spacing=0.2)
    assert samples.points[samples.kind == CORNER].tolist() == [[0, 0, 2]]


def test_boundary_of_an_open_mesh(medial):
    vertices, triangles = meshes.box((4, 4, 1))
    top = vertices[triangles][:, :, 2].min(axis=1) == vertices[:, 2].max()
    samples = medial.sample_surface(vertices, triangles[top], spacing=0.1)
    assert len(samples.sharp_edges) == 0
    assert (samples.kind == CORNER).sum() == 4
    rim = samples.points[samples.kind == BOUNDARY]
    assert np.allclose(np.abs(rim[:, :2] / (1.0, 0.7)).max(axis=1), 1)
    assert len(rim) == 2 * (20 + 14) - 4
    assert np.allclose(samples.normals, (0, 0, 1))


def test_vertices_are_kept_when_asked(medial):
    for vertices, triangles in (meshes.box(), meshes.icosphere(2)):
        samples = medial.sample_surface(vertices, triangles, spacing=0.1, keep_vertices=True)
        assert cKDTree(samples.points).query(vertices)[0].max() == 0
        assert len(np.unique(samples.points, axis=0)) == len(samples.points)
        kept = samples.points[samples.kind == VERTEX]
        assert cKDTree(vertices).query(kept)[0].max() == 0 and len(kept) > 100
        surface = samples.points[samples.kind == SURFACE]
        assert cKDTree(kept).query(surface)[0].min() >= samples.radius[-1] * (1 - 1e-12)


def test_slivers_along_an_edge_leave_it_sharp(medial):
    """A triangle without area between two faces of a cube: the edge stays sharp, and nothing else becomes so."""
    vertices, triangles = meshes.box((1, 1, 1))
    p, q = medial.sample_surface(vertices, triangles, spacing=0.5).sharp_edges[0]
    t = next(i for i, x in enumerate(triangles) if {p, q} <= set(x))
    a, b, c = np.roll(triangles[t], -next(i for i in range(3) if triangles[t][i] not in (p, q)))
    middle = len(vertices)
    vertices = np.concatenate((vertices, [(vertices[b] + vertices[c]) / 2]))
    extra = [(a, b, middle), (a, middle, c), (b, c, middle)]
    triangles = np.concatenate((np.delete(triangles, t, axis=0), extra))
    samples = medial.sample_surface(vertices, triangles, spacing=0.1)
    assert farthest_from_samples(samples, vertices) <= 0.05 + 1e-9
    corners = samples.points[samples.kind == CORNER].tolist()
    assert sorted(corners) == sorted(vertices[:8].tolist())


def test_seams_close(medial):
    """Every triangle with three vertices of its own is the same surface as with shared ones."""
    vertices, triangles = meshes.box()
    samples = medial.sample_surface(vertices, triangles, spacing=0.1)
    torn = medial.sample_surface(
        vertices[triangles.ravel()], np.arange(triangles.size).reshape(-1, 3), spacing=0.1
    )
    assert np.bincount(torn.kind).tolist() == np.bincount(samples.kind).tolist()
    assert np.bincount(torn.kind, minlength=5)[BOUNDARY] == 0


def off_cylinder(points):
    cap = np.abs(np.abs(points[:, 2]) - 1) < 1e-9
    return np.where(cap, 0, np.abs(np.hypot(points[:, 0], points[:, 1]) - 1))


# Measured: 12.8, 37.4 and 34.4.
@pytest.mark.parametrize(
    "mesh, off, better",
    [
        (meshes.icosphere(2), Sphere().field, 10),
        (meshes.torus(), SHAPES["torus"].field, 30),
        (cylinder(16), off_cylinder, 30),
    ],
    ids=["icosphere", "torus", "cylinder"],
)
def test_smooth_samples_are_nearer_to_the_smooth_shape(medial, mesh, off, better):
    flat = medial.sample_surface(*mesh, count=8000, sharp_angle=0.6)
    smooth = medial.sample_surface(*mesh, count=8000, sharp_angle=0.6, smooth=True)
    assert np.abs(off(smooth.points)).max() * better <= np.abs(off(flat.points)).max()
    assert abs(len(smooth.points) - 8000) <= 160
    spacing, surface = spacing_of(smooth), smooth.kind == SURFACE
    nearest = cKDTree(smooth.points).query(smooth.points[surface], k=2)[0][:, 1]
    assert nearest.min() >= 0.7 * spacing


def test_smooth_normals_are_those_of_the_smooth_shape(medial):
    samples = medial.sample_surface(*meshes.icosphere(2), count=4000, smooth=True)
    outward = samples.points / np.linalg.norm(samples.points, axis=1)[:, None]
    assert np.einsum("ij,ij->i", outward, samples.normals).min() > np.cos(0.02)
    samples = medial.sample_surface(*cylinder(16), count=4000, smooth=True)
    surface = samples.kind == SURFACE
    upright = np.abs(samples.normals[surface, 2])
    assert ((upright < 1e-12) | (upright > 1 - 1e-12)).all()


def test_sharp_edges_have_one_curve_for_both_sides(medial):
    """The rim of a smooth cylinder is a circle in the plane of its cap, and both sides reach it without a gap."""
    samples = medial.sample_surface(*cylinder(16), count=20000, smooth=True)
    rim = samples.points[samples.kind == SHARP]
    assert np.abs(np.abs(rim[:, 2]) - 1).max() < 1e-12
    assert off_cylinder(rim * (1, 1, 0)).max() < 1e-3
    surface = samples.kind == SURFACE
    cap = surface & (np.abs(samples.normals[:, 2]) > 0.5)
    spacing = spacing_of(samples)
    assert np.abs(np.abs(samples.points[cap, 2]) - 1).max() < 1e-12
    assert np.hypot(*samples.points[cap, :2].T).max() > 1 - 1.2 * spacing
    assert np.hypot(*samples.points[cap, :2].T).max() <= 1 + 1e-3
    side = samples.points[surface & ~cap]
    assert 1 - 1.2 * spacing < np.abs(side[:, 2]).max() <= 1 + 1e-12


def test_needles_and_flat_triangles(medial):
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1e-5, 0], [0, 1e-5, 0], [0.5, 0, 0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 4, 1], [4, 4, 1]])
    samples = medial.sample_surface(vertices, triangles, spacing=0.01)
    assert cKDTree(samples.points).query(np.linspace(vertices[0], vertices[1], 500))[0].max() < 0.01
    assert not np.isin(samples.triangle[samples.kind == SURFACE], (2, 3)).any()


ENDS = """
import importlib.util, sys
import numpy as np
sys.path[:0] = [sys.argv[2]]
from support import meshes
spec = importlib.util.spec_from_file_location("_medial", sys.argv[1])
medial = importlib.util.module_from_spec(spec)
spec.loader.exec_module(medial)
vertices, triangles = meshes.icosphere(1)
spacings = np.full(len(vertices), 0.5)
if sys.argv[3] == "site":
    spacings[7] = float(sys.argv[4])
else:
    vertices[7] = float(sys.argv[4])
words = {"sizing": (meshes.icosphere(1)[0], spacings)} if sys.argv[3] != "spike" else {}
print(len(medial.sample_surface(vertices, triangles, count=300, **words).points))
"""


@pytest.mark.parametrize("value", ["5e-324", "1e-30", "1e9", "1e18"])
@pytest.mark.parametrize("what", ["site", "spike", "spike and sites"])
def test_a_count_bounds_the_work(medial, what, value):
    """A spacing next to nothing at one site, and a vertex that is far away: it ends, with samples that are few."""
    from medial_axis.core.machine import native

    support = str(Path(__file__).resolve().parents[1])
    command = [sys.executable, "-c", ENDS, str(native.file()), support, what, value]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert 4 < int(done.stdout) <= 400


@pytest.mark.parametrize("keep", [False, True])
def test_vertices_of_no_triangle_are_no_samples(medial, keep):
    """One that uses a vertex twice is none."""
    vertices, triangles = meshes.box((1, 1, 1), (1.0, 1.0, 1.0))
    more = np.array([(2, 0, 0), (3, 0, 0), (3, 1, 0)], float)
    n = len(vertices)
    all_triangles = np.concatenate([triangles, [(n, n, n + 1), (n, n + 1, n + 1), (n + 2,) * 3]])
    options = {"count": 300, "keep_vertices": keep}
    found = medial.sample_surface(np.concatenate([vertices, more]), all_triangles, **options)
    assert 0 <= found.triangle.min() <= found.triangle.max() < len(triangles)
    places = places_of(found, vertices, triangles)
    np.testing.assert_allclose(places, found.points, atol=1e-6)
    assert not keep or cKDTree(found.points).query(vertices)[0].max() == 0


def soup(seed):
    rng = np.random.default_rng(seed)
    n, m = rng.integers(3, 60), rng.integers(1, 120)
    vertices = rng.normal(size=(n, 3)) * 10.0 ** rng.integers(-20, 20)
    if seed % 2:
        vertices = np.round(vertices / np.abs(vertices).max() * 3)  # repeated and collinear points
    return vertices, rng.integers(0, n, size=(m, 3))


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_soups(medial, seed, smooth):
    vertices, triangles = soup(seed)
    spacing = np.sqrt(2 * topology.area(vertices, triangles) / 500)
    options = {"spacing": spacing, "smooth": smooth, "keep_vertices": seed % 3 == 0}
    samples = medial.sample_surface(vertices, triangles, threads=1, **options)
    again = medial.sample_surface(vertices, triangles, threads=3, **options)
    assert (samples.points == again.points).all()
    for x in (samples.points, samples.normals, samples.barycentric, samples.radius):
        assert np.isfinite(x).all()
    length = np.linalg.norm(samples.normals, axis=1)
    assert ((length == 0) | np.isclose(length, 1)).all()
    assert np.allclose(samples.barycentric.sum(axis=1), 1) and samples.barycentric.min() >= 0
    used = vertices[np.unique(triangles[samples.triangle])]
    room = 1 if smooth else 1e-9
    size = np.ptp(used, axis=0).max()
    assert (samples.points >= used.min(axis=0) - room * size).all()
    assert (samples.points <= used.max(axis=0) + room * size).all()
    if not smooth:
        everywhere = distance.points_on_triangles(
            vertices[triangles], 20000, np.random.default_rng(0)
        )
        assert cKDTree(samples.points).query(everywhere)[0].max() <= 1.4 * spacing


TRIANGLE = (np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), np.array([[0, 1, 2]]))
SITES = (np.zeros((2, 3)), np.ones(2))


@pytest.mark.parametrize(
    "message, vertices, triangles, options",
    [
        ("without", np.zeros((3, 3)), [[0, 1, 2]], {"count": 9}),
        ("without", np.eye(3), np.empty((0, 3), int), {"count": 9}),
        ("without", np.empty((0, 3)), np.empty((0, 3), int), {"count": 9}),
        ("corners below 3, found 3", np.eye(3), [[0, 1, 3]], {"count": 9}),
        ("corners below 3, found -1", np.eye(3), [[0, 1, -1]], {"count": 9}),
        ("finite coordinates", np.diag((1, np.nan, 1)), [[0, 1, 2]], {"count": 9}),
        ("one of count", *TRIANGLE, {}),
        ("one of count", *TRIANGLE, {"count": 9, "spacing": 1.0}),
        ("one of count", *TRIANGLE, {"sizing": SITES, "spacing": 1.0}),
        ("count of 1 to", *TRIANGLE, {"count": 0}),
        ("count of 1 to", *TRIANGLE, {"count": 2**40}),
        ("positive spacing", *TRIANGLE, {"spacing": 0.0}),
        ("positive spacing", *TRIANGLE, {"spacing": np.nan}),
        ("positive spacing", *TRIANGLE, {"spacing": np.inf}),
        ("at most 268435455 samples", *TRIANGLE, {"spacing": 1e-9}),
        ("sharp_angle of 0 to pi", *TRIANGLE, {"count": 9, "sharp_angle": 4.0}),
        ("sharp_edges below 3, found 5", *TRIANGLE, {"count": 9, "sharp_edges": [[0, 5]]}),
        ("sharp_edges as", *TRIANGLE, {"count": 9, "sharp_edges": [[0.0, 1]]}),
        ("sizing as a pair", *TRIANGLE, {"sizing": np.ones(3)}),
        ("spacings of the sites as", *TRIANGLE, {"sizing": (np.zeros((2, 3)), np.ones((2, 1)))}),
        ("one spacing for each", *TRIANGLE, {"sizing": (np.zeros((2, 3)), np.ones(3))}),
        ("one spacing for each", *TRIANGLE, {"sizing": (np.zeros((0, 3)), np.ones(0))}),
        ("spacings of the sites, found -1", *TRIANGLE, {"sizing": (np.eye(3), -np.ones(3))}),
        ("found (nan", *TRIANGLE, {"sizing": (np.full((2, 3), np.nan), np.ones(2))}),
        ("mirrored_rows", *TRIANGLE, {"count": 9, "mirrored_rows": -1}),
        ("0 to 1024 threads", *TRIANGLE, {"count": 9, "threads": -1}),
    ],
)
def test_bad_arguments(medial, message, vertices, triangles, options):
    if "sharp_edges" in options:
        options = options | {"sharp_edges": np.array(options["sharp_edges"])}
    with pytest.raises(medial.InvalidInputError) as error:
        medial.sample_surface(vertices, np.array(triangles), **options)
    assert message in str(error.value)
    assert str(error.value).endswith(".") and "\n" not in str(error.value)
