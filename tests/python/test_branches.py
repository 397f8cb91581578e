# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of branches: bends, cross-sections and loops of solids that have known ones, and files of them."""

import base64
import csv
import json
from xml.etree import ElementTree

import numpy as np
import pytest
from medial_axis.cli import main
from medial_axis.core.curves.bridges import on_loops
from medial_axis.core.curves.smooth_line import smooth_line
from medial_axis.core.settings import Settings, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.branches import MEASURES, branches_of, measure_branches
from medial_axis.core.skeleton.compute import compute_skeleton
from medial_axis.core.skeleton.parts import Parts, Places
from medial_axis.core.skeleton.sections import Faces, section
from medial_axis.core.skeleton.skeleton import skeleton_of
from medial_axis.core.skeleton.write_skeleton import export_skeleton
from scipy.ndimage import binary_fill_holes, label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from support import meshes, swept, tubes
from support.poses import turn
from support.reference import winding_number
from support.shapes.base import directions

NO_LINES = np.zeros((0, 2, 3))


def measured(points, triangles):
    found = compute_skeleton(Shape(points, triangles), Settings(), SkeletonSettings(mirror=False))
    return found, measure_branches(found)


def polygon(radius, sides):
    """The area and the perimeter of a regular polygon in a circle."""
    area = sides / 2 * radius**2 * np.sin(2 * np.pi / sides)
    return area, 2 * sides * radius * np.sin(np.pi / sides)


# --- solids with known measures


def test_a_straight_capsule():
    points, triangles = swept.capsule(2.0, 0.2)
    _, found = measured(points @ turn((1.0, 2, 3), 1.0), triangles)
    assert len(found.length) == 1 and not found.on_loop[0]
    assert (found.start_degree[0], found.end_degree[0]) == (1, 1)
    assert found.tortuosity[0] == pytest.approx(1.0, abs=1e-3)
    assert found.curvature_largest[0] * 0.2 < 1e-4 and np.isnan(found.torsion_mean[0])
    area, perimeter = polygon(0.2, 32)
    for name in ("area_mean", "area_least", "area_largest"):
        assert getattr(found, name)[0] == pytest.approx(area, rel=1e-6)
    assert found.perimeter_mean[0] == pytest.approx(perimeter, rel=1e-6)
    assert found.sections[0] > 10


def test_a_torus_is_a_loop_of_one_curvature():
    solid, found = measured(*meshes.torus(1.0, 0.3, 96, 32))
    assert found.on_loop.tolist() == [True] and found.start_degree.tolist() == [2]
    assert np.isnan(found.tortuosity[0]) and solid.skeleton.loops == 1
    assert found.length[0] == pytest.approx(2 * np.pi, rel=1e-3)
    assert found.curvature_mean[0] == pytest.approx(1.0, rel=1e-3)
    assert found.curvature_largest[0] == pytest.approx(1.0, rel=5e-3)
    assert abs(found.torsion_mean[0]) < 1e-6
    area, perimeter = polygon(0.3, 32)
    assert found.area_mean[0] == pytest.approx(area, rel=2e-3)
    assert found.perimeter_mean[0] == pytest.approx(perimeter, rel=2e-3)


def test_a_helix_turns_and_climbs():
    """A left-handed one has the opposite torsion."""
    pitch = 0.4
    points, triangles = swept.helix(0.2, pitch)
    _, found = measured(points, triangles)
    assert found.curvature_mean[0] == pytest.approx(1 / 1.16, rel=5e-3)
    assert found.torsion_mean[0] == pytest.approx(pitch / 1.16, rel=0.01)
    assert found.area_mean[0] == pytest.approx(polygon(0.2, 32)[0], rel=5e-3)
    mirrored = measured(points * (1, 1, -1), triangles[:, ::-1])[1]
    assert mirrored.torsion_mean[0] == pytest.approx(-found.torsion_mean[0], rel=0.02)


def test_an_elliptic_tube():
    """The perimeter is that of Ramanujan."""
    a, b, count = 0.3, 0.2, 64
    _, found = measured(*swept.elliptic(a, b, count))
    straight = np.argmax(found.length)
    h = ((a - b) / (a + b)) ** 2
    around = np.pi * (a + b) * (1 + 3 * h / (10 + np.sqrt(4 - 3 * h)))
    assert found.area_mean[straight] == pytest.approx(np.pi * a * b, rel=3e-3)
    assert found.perimeter_mean[straight] == pytest.approx(around, rel=2e-3)
    assert found.curvature_mean[straight] * b < 0.01


def test_a_tree_of_tubes():
    solid = tubes.tree()
    points = solid.sample(4000)
    shape = Shape(points, np.zeros((0, 3), np.int32), solid.normals(points))
    found = measure_branches(compute_skeleton(shape, Settings(), SkeletonSettings()))
    degrees = np.sort(np.column_stack((found.start_degree, found.end_degree)), axis=1).tolist()
    assert sorted(map(tuple, degrees)) == [(1, 3)] * 5 + [(3, 3)] * 2 and not found.on_loop.any()
    lengths = sorted(np.linalg.norm(np.diff(line, axis=0)) for line in solid.lines)
    np.testing.assert_allclose(np.sort(found.length), lengths, rtol=0.12)  # tubes have round ends
    assert (found.curvature_mean * found.radius_mean < 0.02).all()
    np.testing.assert_allclose(np.sort(found.radius_least), np.sort(solid.radii), rtol=0.03)
    assert (found.sections == 0).all() and np.isnan(found.area_mean).all()


# --- the smooth line


@pytest.mark.parametrize("count", [0, 1, 4, 5, 6, 40])
def test_a_smooth_line_solves_its_equations(medial, count):
    """Against the whole matrix of deviations and weighted fourth differences, solved by NumPy."""
    random = np.random.default_rng(count)
    places, widths = random.normal(size=(count, 3)), random.uniform(0.5, 3.0, count)
    fourth = np.diff(np.eye(count), 4, axis=0) if count > 4 else np.zeros((0, count))
    matrix = np.eye(count) + (fourth.T * widths[2 : 2 + len(fourth)] ** 8) @ fourth
    wanted = np.linalg.solve(matrix, places)
    np.testing.assert_allclose(medial.smooth_line(places, widths), wanted, rtol=1e-6, atol=1e-9)


def test_a_smooth_line_has_a_width_at_each_place(medial):
    with pytest.raises(medial.InvalidInputError, match="a width for each place, found 4"):
        medial.smooth_line(np.zeros((5, 3)), np.ones(4))


def trefoil(t):
    x = np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)
    return np.stack(x, axis=-1)


def test_noise_of_points_does_not_bend_a_line():
    """A knot with noise of one per cent of the radius, against differences of its formula."""
    t = np.linspace(0, 2 * np.pi, 1001)
    noise = 0.003 * np.random.default_rng(0).normal(size=(1001, 3))
    noise[-1] = noise[0]
    line = smooth_line(trefoil(t) + noise, np.full(1001, 0.3), True)
    h = 1e-3
    a, b, c, d, e = (trefoil(t + k * h) for k in (-2, -1, 0, 1, 2))
    first, second = (d - b) / (2 * h), (d - 2 * c + b) / h**2
    third = (e - 2 * d + 2 * b - a) / (2 * h**3)
    across, speed = np.cross(first, second), np.linalg.norm(first, axis=1)
    size = np.linalg.norm(across, axis=1)
    curvature, torsion = size / speed**3, (across * third).sum(axis=1) / size**2
    mean = np.average(curvature[:-1], weights=speed[:-1])
    weight = (curvature**2 * speed)[:-1]
    assert line.curvature[:-1].mean() == pytest.approx(mean, rel=0.01)
    assert line.curvature.max() == pytest.approx(curvature.max(), rel=0.05)
    found = np.average(line.torsion[:-1], weights=line.curvature[:-1] ** 2)
    assert found == pytest.approx(np.average(torsion[:-1], weights=weight), rel=0.05)
    assert line.length == pytest.approx(speed[:-1].mean() * 2 * np.pi, rel=2e-3)
    np.testing.assert_allclose(line.points[0], line.points[-1], atol=1e-6)


def test_measures_have_units():
    """Doubled lengths double and halve numbers to the last bit."""
    t = np.linspace(0, 5, 60)
    points = np.column_stack((np.cos(t), np.sin(t), 0.3 * t))
    chain = [np.arange(60)]
    small, large = (
        branches_of(skeleton_of(size * points, np.full(60, 0.2 * size), chain, chain[0][:0]))
        for size in (1.0, 2.0)
    )
    powers = {"length": 1, "curvature_largest": -1, "torsion_mean": -1, "tortuosity": 0}
    for name, power in powers.items():
        assert getattr(large, name) == getattr(small, name) * 2.0**power


def test_lines_without_length_and_without_balls_are_measured():
    points = np.array([(0.0, 0, 0), (0, 0, 0), (1, 0, 0), (2, 0, 0)])
    chains = [np.array([0, 1]), np.array([1, 2, 3])]
    found = branches_of(skeleton_of(points, np.zeros(4), chains, chains[0][:0]))
    assert found.length.tolist() == [0.0, pytest.approx(2.0)]
    assert np.isnan(found.tortuosity[0]) and np.isnan(found.curvature_mean[0])
    assert found.curvature_largest[1] < 1e-6


# --- cross-sections


@pytest.mark.parametrize("seed", range(3))
def test_a_cross_section_is_what_is_inside_on_its_plane(data_file, seed):
    """Brute force: places on a grid that are inside, as far as they hang together with the middle one."""
    points, triangles = meshes.read(data_file("spot_low.obj"))
    rng = np.random.default_rng(seed)
    corners = points[rng.choice(triangles, 1)[0]]
    inward = -np.cross(corners[1] - corners[0], corners[2] - corners[0])
    place = corners.mean(axis=0) + 0.03 * inward / np.linalg.norm(inward)
    normal = directions(1, rng)[0]
    faces = Faces(points, triangles)
    area, _ = section(place, normal, faces.points, faces.triangles, NO_LINES)
    frame = np.linalg.svd(normal[None])[2][1:]
    half, step = 30, 0.1 * np.sqrt(area)
    grid = np.stack(np.meshgrid(*[np.arange(-half, half + 1) * step] * 2), axis=-1)
    inside = winding_number(place + grid.reshape(-1, 2) @ frame, points, triangles) > 0.5
    pieces, _ = label(inside.reshape(grid.shape[:2]))
    assert pieces[half, half]
    counted = binary_fill_holes(pieces == pieces[half, half]).sum() * step**2
    assert area == pytest.approx(counted, rel=0.05)


BOX = Faces(*meshes.box((2, 2, 2), (1.0, 1.0, 1.0)))
MIDDLE = (0.0, 0.1, 0.05)


def section_of_box(place, lines=NO_LINES, triangles=BOX.triangles):
    """The area and the perimeter of a level section of a box at a place."""
    return section(np.array(place), np.array((0.0, 0, 1)), BOX.points, triangles, lines)


def test_a_cross_section_of_two_branches_is_none():
    other = np.array([[(0.5, 0.2, -2.0), (0.5, 0.2, 2.0)]])
    x, y, _ = np.ptp(BOX.points, axis=0)
    through_vertices = section_of_box((0.0, 0.0, 0.0))
    far = section_of_box(MIDDLE, other + np.array((5.0, 0, 0)))
    for found in (through_vertices, section_of_box(MIDDLE), far):
        assert found == pytest.approx((x * y, 2 * (x + y)))
    assert np.isnan(section_of_box(MIDDLE, other)).all()


def test_cross_sections_may_be_much_wider_than_the_balls():
    """A slab twenty times as wide as thick: faces near the balls do not close a loop."""
    points = np.column_stack((np.linspace(-4.0, 4.0, 81), np.zeros(81), np.zeros(81)))
    line = skeleton_of(points, np.full(81, 0.2), [np.arange(81)], np.zeros(0, np.int64))
    found = branches_of(line, None, Faces(*meshes.box((50, 20, 2), (5.0, 4.0, 0.2))))
    assert found.sections[0] == len(found.profiles[0].share) > 9
    for area, perimeter in found.profiles[0].values[:, 2:]:
        assert (area, perimeter) == (pytest.approx(3.2), pytest.approx(16.8))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("side", [-1, 1])
def test_an_opening_has_no_cross_section(axis, side):
    wall = (side * BOX.points[BOX.triangles][..., axis] > 0.99).all(axis=1)
    assert 0 < wall.sum() < len(wall)
    assert section_of_box(MIDDLE, triangles=BOX.triangles[~wall]) is None
    assert section_of_box((9.0, 0, 0)) is None


def test_branches_on_loops_are_those_whose_ends_meet_without_them():
    rng = np.random.default_rng(0)
    for _ in range(40):
        nodes = int(rng.integers(1, 9))
        pairs = rng.integers(0, nodes, (rng.integers(0, 10), 2)).tolist()
        ends = dict(enumerate(map(tuple, pairs)))
        at = {node: [] for node in range(nodes)}
        for name, pair in ends.items():
            for node in pair:
                at[node].append(name)
        expected = []
        for name, (a, b) in ends.items():
            rest = np.delete(np.array(pairs), name, axis=0)
            graph = coo_array((np.ones(len(rest)), rest.T), shape=(nodes, nodes))
            part = connected_components(graph, directed=False)[1]
            if part[a] == part[b]:
                expected.append(name)
        assert on_loops(ends, at) == expected


# --- files


@pytest.fixture(scope="module")
def a_ring_with_a_tail():
    """A ring with a fork, a tail, and a single point; made by hand, with a tube of faces round the tail."""
    t = np.linspace(0, 2 * np.pi, 61)[:-1]
    ring = np.column_stack((np.cos(t), np.sin(t), 0 * t))
    tail = np.linspace((1.0, 0, 0), (3.0, 0, 0), 21)[1:]
    points = np.concatenate((ring, tail, [(9.0, 9, 9)]))
    chains = [np.array([*range(60), 0]), np.array([0, *range(60, 80)])]
    skeleton = skeleton_of(points, np.full(81, 0.1), chains, np.array([80]))
    points, triangles = swept.capsule(3.0, 0.1)
    faces = Faces(points[:, [2, 0, 1]] + (1.3, 0, 0), triangles)
    nowhere = Places(np.zeros(0, np.int32), np.zeros(0))
    return skeleton, Parts(nowhere, np.zeros(0, np.int32)), branches_of(skeleton, None, faces)


def test_csv_has_a_row_for_each_branch(a_ring_with_a_tail, tmp_path):
    skeleton, parts, branches = a_ring_with_a_tail
    rows = list(
        csv.DictReader(export_skeleton(skeleton, parts, tmp_path / "a.csv", branches).open())
    )
    assert [row["branch"] for row in rows] == ["0", "1"]
    for name, column in branches.columns.items():
        for row, value in zip(rows, column.tolist(), strict=True):
            assert (row[name] == "") if np.isnan(value) else float(row[name]) == value
    ring, tail = rows
    assert (ring["on_loop"], ring["start_degree"], ring["tortuosity"]) == ("1", "3", "")
    assert (tail["on_loop"], tail["end_degree"], ring["area_mean"]) == ("0", "1", "")
    assert float(ring["curvature_mean"]) == pytest.approx(1.0, rel=0.01)
    assert float(tail["area_largest"]) == pytest.approx(polygon(0.1, 32)[0])


def test_json_has_the_measures(a_ring_with_a_tail, tmp_path):
    path = export_skeleton(*a_ring_with_a_tail[:2], tmp_path / "a.json", a_ring_with_a_tail[2])
    ring, tail = (part["measures"] for part in json.loads(path.read_text())["parts"])
    assert ring["on_loop"] is True and ring["tortuosity"] is None
    assert tail["length"] == a_ring_with_a_tail[2].length[1]


def test_swc_says_forks_and_ends(a_ring_with_a_tail, tmp_path):
    path = export_skeleton(*a_ring_with_a_tail[:2], tmp_path / "a.swc")
    lines = path.read_text().splitlines()
    table = np.array([line.split() for line in lines if line[0] != "#"], float)
    fork, end = table[table[:, 1] == 5], table[table[:, 1] == 6]
    assert fork[:, 2:5].tolist() == [[1, 0, 0]] and end[:, 2:5].tolist() == [[3, 0, 0]]
    assert (table[:, 1] == 0).sum() == len(table) - 2
    assert sum("closes a loop" in line for line in lines) == 1


def arrays_of(path):
    """The arrays of a .vtp file by element and name."""
    found = {}
    for element in ElementTree.parse(path).getroot().find("PolyData/Piece"):
        for array in element:
            data = base64.b64decode(array.text.strip())
            dtype = {"Float64": "<f8", "Int32": "<i4"}[array.get("type")]
            assert np.frombuffer(data[:8], "<u8")[0] == len(data) - 8
            found[element.tag, array.get("Name")] = np.frombuffer(data[8:], dtype)
    return found


def test_vtp_has_lines_with_arrays(a_ring_with_a_tail, tmp_path):
    skeleton, parts, branches = a_ring_with_a_tail
    found = arrays_of(export_skeleton(skeleton, parts, tmp_path / "a.vtp", branches))
    np.testing.assert_array_equal(found["Points", "Points"].reshape(-1, 3), skeleton.points)
    np.testing.assert_array_equal(found["PointData", "radius"], skeleton.radius)
    np.testing.assert_array_equal(found["Lines", "connectivity"], skeleton.branch_points)
    np.testing.assert_array_equal(found["Lines", "offsets"], skeleton.branch_offsets[1:])
    assert found["Verts", "connectivity"].tolist() == [80]
    assert found["CellData", "branch"].tolist() == [-1, 0, 1]
    np.testing.assert_array_equal(found["CellData", "length"][1:], branches.length)
    assert {name for kind, name in found if kind == "PointData"} == {"radius", "degree", *MEASURES}
    area, curvature = found["PointData", "area"], found["PointData", "curvature"]
    assert np.isnan(area[[0, 80]]).all() and area[70] == pytest.approx(polygon(0.1, 32)[0])
    assert curvature[30] == pytest.approx(1.0, rel=0.01) and curvature[70] < 1e-6


def test_vtk_reads_vtp(a_ring_with_a_tail, tmp_path):
    io = pytest.importorskip("vtkmodules.vtkIOXML")
    reader = io.vtkXMLPolyDataReader()
    skeleton, parts, branches = a_ring_with_a_tail
    reader.SetFileName(str(export_skeleton(skeleton, parts, tmp_path / "a.vtp", branches)))
    reader.Update()
    found = reader.GetOutput()
    assert (found.GetNumberOfPoints(), found.GetNumberOfLines()) == (81, 2)
    assert found.GetNumberOfVerts() == 1
    area = found.GetPointData().GetArray("area")
    assert np.isnan(area.GetValue(0)) and area.GetValue(70) == pytest.approx(polygon(0.1, 32)[0])
    assert found.GetCellData().GetArray("tortuosity").GetValue(2) == branches.tortuosity[1]


def test_command_line_writes_tables(tmp_path):
    points, triangles = meshes.torus()
    source, target = tmp_path / "ring.npz", tmp_path / "ring.csv"
    np.savez(source, points=points, triangles=triangles)
    assert main(["skeleton", str(source), str(target)]) == 0
    (row,) = csv.DictReader(target.open())
    assert float(row["curvature_mean"]) == pytest.approx(1.0, rel=0.01)
    assert float(row["area_mean"]) == pytest.approx(polygon(0.4, 20)[0], rel=0.01)
