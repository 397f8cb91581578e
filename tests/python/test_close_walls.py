# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness is never reported above what rays find between the walls, and what is unknown is never 0 %."""

import json

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.machine.cache import CACHE
from medial_axis.core.settings import Edges, SamplingMode, Settings, ThicknessSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.thickness import close_walls
from medial_axis.core.thickness import thickness as thickness_module
from medial_axis.core.thickness.face_lengths import MeasuredFaces
from medial_axis.core.thickness.face_pieces import _lattice
from medial_axis.core.thickness.thickness import measure_thickness
from medial_axis.core.thickness.thin_parts import find_thin_parts
from medial_axis.core.thickness.write_thickness import export_thickness
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from support import meshes
from support.meshes import join
from support.plates import box, prism
from support.topology import unit_normals

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle


def halves(polygons):
    """Triangles of triangles and quadrilaterals."""
    return np.array(
        [t for p in polygons for t in ((p[0], p[i], p[i + 1]) for i in range(1, len(p) - 1))]
    )


def cube_with_fin(width, thickness):
    """A unit cube with a fin on top: one closed manifold of 16 vertices."""
    cube = box((1, 1, 1))[0]
    xs, ys = 0.5 + np.array([-1, 1]) * width / 2, 0.5 + np.array([-1, 1]) * thickness / 2
    foot = [(xs[0], ys[0], 1), (xs[1], ys[0], 1), (xs[1], ys[1], 1), (xs[0], ys[1], 1)]
    top = np.array(foot) + np.array((0, 0, 0.1))
    faces = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    for start in (4, 8):  # the top around the fin, then its sides
        ends = [(start + i, start + (i + 1) % 4) for i in range(4)]
        faces += [(a, b, b + 4, a + 4) for a, b in ends]
    return np.concatenate([cube, foot, top]), halves([*faces, (12, 13, 14, 15)])


def measured(*mesh, settings=Settings(), **wanted):
    return measure_thickness(meshes.shape_of(mesh), settings, ThicknessSettings(**wanted))


FINS = [(width, t) for width in (0.05, 0.1, 0.2, 0.5) for t in (0.002, 0.0005, 1e-5)]


def values_near(found, places, reach):
    """(k,) the least length of the samples, and of the triangles, whose places are nearer than a reach."""
    middles = found.points[found.triangles].mean(axis=1)
    least = []
    for points, values in ((found.points, found.lengths), (middles, found.of_triangles)):
        near = cKDTree(points).query_ball_point(places, reach)
        least.append(np.array([values[rows].min(initial=np.inf) for rows in near]))
    return least


THIN_THINGS = [
    *(pytest.param(cube_with_fin(*fin), 0.02, id=f"fin-{fin}") for fin in FINS),
    *(pytest.param(box((1.0, 1.0, t)), 0.02, id=f"plate-{t}") for t in (0.002, 0.0015, 1e-5)),
    pytest.param(cube_with_fin(0.5, 0.002), 0.001, id="no limit is met"),
]


def assert_below_rays(found, medial):
    """In the middles of the measured triangles, and next to their corners away from edges."""
    points, triangles = found.shape.points, found.shape.triangles
    normals = unit_normals(points, triangles)[found.surface.face_of_triangles]
    reach = np.full(len(normals), np.linalg.norm(np.ptp(points, axis=0)))
    middles = found.points[found.triangles].mean(axis=1)

    def check(places, values):
        way = medial.wall_distances(places, normals, reach, points, triangles)
        known = np.isfinite(values)
        assert (values <= (1 + 1e-6) * way + found.slack)[known].all()

    check(middles, found.of_triangles)
    for corner in found.triangles.T:
        beside = found.points[corner] + 1e-3 * (middles - found.points[corner])
        check(beside, np.where(found.at_edge[corner], np.inf, found.lengths[corner]))


@pytest.mark.parametrize("edges", list(Edges))
@pytest.mark.parametrize(("mesh", "limit"), THIN_THINGS)
def test_no_value_exceeds_what_rays_find(medial, mesh, limit, edges):
    """The lengths at the points and at the triangles of a solid that its faces bound."""
    found = measured(*mesh, limit=limit, edges=edges)
    assert isinstance(found.chosen, MeasuredFaces)
    assert_below_rays(found, medial)
    parts = find_thin_parts(found, limit)
    thin = found.drawn < limit - found.slack
    np.testing.assert_array_equal(parts.patch_of_triangles >= 0, thin)
    assert parts.area == pytest.approx(found.areas_below(limit)[thin].sum())


@pytest.mark.parametrize("seed", repeats(12))
def test_fuzzed_thin_parts(medial, seed):
    """Plates, and fins on one or two blocks, turned, moved and of any size."""
    rng = np.random.default_rng(seed)
    mesh = cube_with_fin(rng.uniform(0.05, 0.6), 10 ** rng.uniform(-5.0, -1.5))
    if rng.random() < 0.4:
        mesh = join(mesh, moved_block(*rng.uniform(-0.6, 0.6, 2), rng.uniform(-1.2, -0.2)))
    elif rng.random() < 0.4:
        mesh = box((1.0, rng.uniform(0.1, 1.0), 10 ** rng.uniform(-5.0, -1.5)))
    turned = mesh[0] @ Rotation.random(random_state=seed).as_matrix().T
    points = (turned + rng.uniform(-2.0, 2.0, 3)) * 10 ** rng.uniform(-8.0, 8.0)
    sampling = (SamplingMode.SURFACE, SamplingMode.VERTICES)[seed % 2]
    settings = Settings(sampling=sampling, samples=2_000)
    found = measured(points, mesh[1], settings=settings, edges=list(Edges)[seed % 3])
    if isinstance(found.chosen, MeasuredFaces):
        assert_below_rays(found, medial)
    else:
        walls, reach = found.walls, 1.5 * found.chosen.samples.walls.spacing.max()
        for least in values_near(found, walls.points, reach):
            assert (least <= walls.distance).all()
    assert found.triangles.max() < len(found.points) == len(found.lengths) == len(found.at_edge)
    assert len(find_thin_parts(found, 2 * found.minimum).patch_of_faces) == len(mesh[1])


@pytest.mark.parametrize(("width", "thickness"), FINS)
def test_a_fin_is_seen(tmp_path, width, thickness):
    """Its vertices in the table, its triangles and colours in the picture, and its faces in the selection."""
    points, triangles = cube_with_fin(width, thickness)
    found = measured(points, triangles, limit=0.02)
    parts = find_thin_parts(found, 0.02)
    table = export_thickness(found, parts, tmp_path / "fin.csv").read_text().split("\n")[1:-1]
    lengths = np.array([float(row.split(",")[4]) for row in table if not row.startswith("-1,")])
    assert lengths[8:] == pytest.approx(np.full(8, thickness), rel=0.01)
    assert (lengths[:8] > 0.5).all()
    on_fin = triangles.min(axis=1) >= 8
    sides = on_fin & (np.abs(unit_normals(points, triangles)[:, 1]) > 0.9)
    assert (parts.patch_of_faces[sides] >= 0).all() and (parts.patch_of_faces[~on_fin] < 0).all()
    path = export_thickness(found, parts, tmp_path / "fin.ply")
    head, body = path.read_bytes().split(b"end_header\n", 1)
    kind = np.dtype([("place", "<f8", 3), ("thickness", "<f8"), ("colour", "u1", 3)])
    vertices = np.frombuffer(body, kind, len(found.points))
    kind = np.dtype([("n", "u1"), ("corners", "<i4", 3), ("patch", "<i4")])
    faces = np.frombuffer(body[vertices.nbytes :], kind)
    corners = vertices[faces["corners"][faces["patch"] >= 0]].ravel()
    height = corners["place"][:, 2]
    assert len(corners) and f"element face {len(faces)}\n".encode() in head
    assert (height > 0.95).all() and (corners["colour"][height > 1.02, 0] > 200).mean() > 0.9


def test_no_sample_of_a_patch_is_thicker_than_the_patch():
    """Where only rays find a wall, its samples have more than its minimum."""
    points, triangles = cube_with_fin(0.2, 0.0005)
    found = measured(points, triangles[1:])
    patches = find_thin_parts(found, 0.02).patches
    assert len(found.walls.distance) and patches
    assert all(0.0 < patch.lowest <= patch.minimum < 0.02 for patch in patches)


@pytest.mark.parametrize(("width", "thickness"), [f for f in FINS if f[0] >= 0.1])
def test_the_area_of_a_fin_is_its_own(width, thickness):
    found = measured(*cube_with_fin(width, thickness))
    true = 2 * 0.1 * width / (6 + 2 * 0.1 * (width + thickness))
    assert find_thin_parts(found, 0.02).share == pytest.approx(true, rel=0.15)


def test_vertices_that_are_samples_have_the_length_of_the_faces_at_them():
    """A fine cube with a fin whose own faces are large."""
    points, triangles = cube_with_fin(0.5, 0.002)
    found = measured(points, triangles, settings=Settings(sampling=SamplingMode.VERTICES))
    sides = np.abs(unit_normals(points, triangles)[:, 1]) > 0.9
    sides &= triangles.min(axis=1) >= 8
    assert (found.of_triangles[sides] <= 0.00201).all() and (found.of_vertices[8:] <= 0.00201).all()


def test_a_face_that_is_thin_at_one_end_is_thick_at_the_other():
    """A block with a tongue of 0.002; both stand on one long face."""
    profile = [(0, 0), (2, 0), (2, 0.002), (1, 0.002), (1, 0.4), (0, 0.4)]
    found = measured(*prism(profile, [(0, 3, 4), (0, 4, 5), (0, 1, 2), (0, 2, 3)], 0.5), limit=0.02)
    parts = find_thin_parts(found, 0.02)
    place = found.points[found.triangles].mean(axis=1)
    thin = parts.patch_of_triangles >= 0
    assert parts.minimum == pytest.approx(0.002, rel=1e-6)
    # The ends have two middle lines where balls come to rest, 0.2 high up to x = 0.8 and 0.001 high from x = 1 on. Low
    # places from x = 0.8 on are nearer to the second one; as few places lie on the first, this begins before.
    assert place[thin, 0].min() > 0.7
    assert place[np.isfinite(found.of_triangles) & thin, 0].min() > 0.95
    assert parts.area == pytest.approx(1.0, rel=0.05)
    assert found.of_vertices[[1, 2, 7, 8]] == pytest.approx(np.full(4, 0.002), rel=0.01)
    assert (found.of_vertices[[0, 5, 6, 11]] > 0.3).all()


@pytest.mark.parametrize("cut", [1, 2, 5])
def test_pieces_cover_a_face(cut):
    shares, pieces = _lattice(cut)
    corners = shares[pieces] @ np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert len(pieces) == cut * cut and len(np.unique(pieces)) == len(shares)
    assert a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] == pytest.approx(np.full(cut * cut, 1 / cut**2))


@pytest.mark.parametrize("thickness", [0.01, 0.002, 0.0015, 0.0003, 1e-5])
def test_plates_have_their_thickness_however_thin(thickness):
    found = measured(*box((1.0, 1.0, thickness)), limit=0.02)
    assert (found.of_vertices <= 1.01 * thickness).all()
    assert found.minimum == pytest.approx(thickness, rel=0.01)
    assert find_thin_parts(found, 0.02).share > 0.9 and found.unmeasured < 0.01


def moved_block(*offset):
    return meshes.moved(box((1.0, 1.0, 1.0)), offset)


def test_a_fin_on_parts_that_overlap():
    """Rays pass through the walls inside the solid, so they are right where parts overlap."""
    found = measured(*join(cube_with_fin(0.5, 0.002), moved_block(0.5, 0.3, -0.5)), limit=0.02)
    assert found.chosen.samples.buried > 100
    assert found.minimum == pytest.approx(0.002, rel=0.01)
    assert 0.005 < find_thin_parts(found, 0.02).share < 0.02


@pytest.mark.parametrize(
    "offset",
    [(0.5, 0.3, 0.2), (0.99, 0.3, 0.2), (0.0, 0.001, 0.6), (1e-16, 0, 0.5), (0, 1e-9, 0.6)],
)
def test_thick_parts_that_overlap_have_no_close_walls(offset):
    found = measured(*join(box((1.0, 1.0, 1.0)), moved_block(*offset)))
    assert found.chosen.samples.buried > 100 and not len(found.walls.distance)


def test_ways_end_where_the_solid_does(data_file, medial):
    """Faces of several parts coincide in this mesh: rays once ended at one of them, inside another part."""
    points, triangles = meshes.read(data_file("openscad-nonmanifold-crash.obj"))
    walls = measured(points, triangles).walls
    inward = -unit_normals(points, triangles)[walls.faces]
    steps = np.array([-0.02, 0.02, 0.5, 0.98, 1.02])[:, None, None] * walls.distance[:, None]
    places = (walls.points + steps * inward).reshape(-1, 3)
    triangles = triangles.astype(np.int32)
    inside = medial.winding_number(places, points, triangles).reshape(5, -1) > 0.5
    assert len(walls.distance) > 100 and inside[1:4].all() and not inside[[0, 4]].any()


def test_what_is_unknown_is_a_number_and_an_exit_code(tmp_path, monkeypatch):
    """Where the axis and the rays find nothing: here by taking the walls away."""
    CACHE.clear()  # another test may have measured this plate by its faces
    nothing = lambda shape, *_: close_walls.no_close_walls(shape)
    monkeypatch.setattr(thickness_module, "close_walls", nothing)
    monkeypatch.setattr(thickness_module, "are_enough", lambda *_: False)
    source = meshes.write_off(tmp_path / "plate.off", box((1.0, 1.0, 1e-5)))
    output = tmp_path / "plate.json"
    assert cli.main(["thickness", source, str(output), "--limit", "0.02"]) == cli.UNMEASURED
    found = json.loads(output.read_text())
    assert found["share_unmeasured"] > 0.9 and found["minimum"] is None
    assert any("no thickness could be measured" in text for text in found["warnings"])


def test_what_is_left_out_on_purpose_is_not_unknown():
    assert measured(*box((1, 1, 1)), edges=Edges.GREY).unmeasured == 0.0


def test_only_wedges_of_the_solid_are_acute_edges():
    """Inside out, the sharp edge of a wedge is that of a groove, where ways through the solid do not become short."""
    points, outward = prism([(0, 0), (4, -1), (4, 1)], [(0, 1, 2)], 1.0)
    found = close_walls._acute_edges(Shape(points, outward))
    assert sorted(map(tuple, found.reshape(-1, 3).tolist())) == [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)]
    assert len(close_walls._acute_edges(Shape(points, outward[:, ::-1]))) == 0
