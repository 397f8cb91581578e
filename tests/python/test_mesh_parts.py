# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected parts of faces: against an oracle, told in results, and each computed by itself."""

import json

import medial_axis
import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.errors import DegenerateInputError
from medial_axis.core.samples.mesh_parts import split
from medial_axis.core.settings import SamplingMode, Settings, SidesFrom
from medial_axis.core.shape.shape import Shape
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from support import meshes, messy
from test_outward_faces import cube, grid, inward

SHEET = (grid(4)[0] + 5.0, grid(4)[1])
THREE = meshes.join(cube(), SHEET, cube((3, 0, 0)))
FEW = {"sampling": SamplingMode.SURFACE, "samples": 1500}


def computed(mesh):
    return compute_axis(Shape(*mesh), Settings(**FEW))


def expected(points, triangles):
    """The part of each face, by faces that share an edge of places."""
    _, place = np.unique(points, axis=0, return_inverse=True)
    ends = np.sort(place.reshape(-1)[triangles][:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    _, edge = np.unique(ends, axis=0, return_inverse=True)
    face = np.repeat(np.arange(len(triangles)), 3)
    graph = coo_array((np.ones(len(face)), (face, len(triangles) + edge.reshape(-1))))
    graph.resize((len(triangles) + edge.max() + 1,) * 2)
    part = connected_components(graph, directed=False)[1][: len(triangles)]
    _, first = np.unique(part, return_index=True)
    return np.searchsorted(np.sort(first), first[part])


@pytest.mark.parametrize("seed", range(8))
def test_parts_are_those_of_the_oracle(medial, seed):
    random = np.random.default_rng(seed)
    points = random.integers(0, 6, (60, 3)).astype(float)  # many places twice
    triangles = random.integers(0, 60, (int(random.integers(1, 50)), 3)).astype(np.int32)
    corners = points[triangles]
    whole = ((corners != np.roll(corners, 1, axis=1)).any(axis=2)).all(axis=1)
    part, _, _ = medial.mesh_parts(points, triangles)
    assert (part[~whole] == -1).all()
    if whole.any():
        assert np.array_equal(part[whole], expected(points, triangles[whole]))


def test_parts_of_an_engine(medial, data_file):
    mesh = messy.load("engine_parts.ply", data_file)
    part, is_open, is_flat = medial.mesh_parts(*mesh)
    assert np.array_equal(part, expected(*mesh))
    assert len(is_open) == 7 and not is_open.any() and not is_flat.any()


@pytest.mark.parametrize(("scale", "move"), [(1.0, 0.0), (1e-9, 0.0), (1e9, 0.0), (1.0, 50.0)])
def test_open_and_flat_parts(medial, scale, move):
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    points, triangles = meshes.join(THREE, (cube((0, 3, 0))[0], cube()[1][2:]))
    points = (scale * points @ turn + move).astype(np.float32).astype(float)
    part, is_open, is_flat = medial.mesh_parts(points, triangles)
    assert part.tolist() == [0] * 12 + [1] * 18 + [2] * 12 + [3] * 10
    assert is_open.tolist() == [False, True, False, True]
    assert is_flat.tolist() == [False, True, False, False]


def test_touching_parts(medial):
    """At a vertex they are two, at an edge one; a face without corners is of no part."""
    assert len(medial.mesh_parts(*meshes.join(cube(), cube((1, 1, 1))))[1]) == 2
    assert len(medial.mesh_parts(*meshes.join(cube(), cube((1, 1, 0))))[1]) == 1
    points, triangles = cube()
    part, is_open, _ = medial.mesh_parts(points, np.concatenate((triangles, [[0, 0, 1]])))
    assert part[-1] == -1 and not is_open.any()


def wavy(size=20):
    points, triangles = grid(size)
    return np.column_stack((points[:, :2], 0.1 * np.sin(18.0 * points[:, 0]))), triangles


PLACES = {
    "apart": ([cube(), cube((3, 0, 0)), cube((0, 1.01, 0))], "aaa"),
    "touching at a corner": ([cube(), cube((1, 1, 1))], "tt"),
    "touching at a part of a face": ([cube(), cube((1, 0.25, 0.25), 0.5)], "tt"),
    "touching along edges": ([cube(), cube((1.0, 0.3, 1.0)), cube((0, 5, 0))], "tta"),
    "inside": ([cube((-1.5,) * 3, 3.0), cube((-0.5,) * 3)], "aw"),
    "a cavity": ([cube((-1.5,) * 3, 3.0), inward(cube((-0.5,) * 3))], "aw"),
    "inside, on the floor": ([cube((0, 0, 0), 3.0), cube((1, 1, 0))], "aw"),
    "overlapping": ([cube(), cube((0.3, 0.4, 0.2)), cube((4, 0, 0))], "ooa"),
    "overlapping, edges in the middles of faces": ([cube(), cube((0.5, 0.5, 0.5))], "oo"),
    "overlapping, with faces in one plane": ([cube(), cube((0.5, 0, 0))], "oo"),
    "mirrored": ([meshes.icosphere(3), meshes.icosphere(3, 1.0, (0.5, 0, 0))], "oo"),
    "sheets": ([cube(), wavy(), SHEET], "ass"),
    "an open box": ([cube(), (cube((0.5, 0.5, 0.5))[0], cube()[1][2:])], "oo"),
}


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("pose", [None, 1e-9, 1e6])
def test_places_of_parts(medial, name, pose):
    """Also turned and rounded to float32, for a thousandth of nothing is not a distance."""
    parts, expected = PLACES[name]
    points, triangles = meshes.join(*parts)
    if pose is not None:
        turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
        points = (pose * (points @ turn)).astype(np.float32).astype(float)
    part, is_open, place = medial.part_places(points, triangles)
    assert "".join("atwos"[kind] for kind in place) == expected
    known = medial.mesh_parts(points, triangles)
    assert np.array_equal(part, known[0]) and np.array_equal(is_open, known[1])
    again = medial.part_places(points, np.roll(triangles[::-1], 1, axis=1))[2]
    assert sorted(again) == sorted(place)


# --- in the product


def test_results_tell_the_parts(tmp_path, capsys):
    points, triangles = meshes.join(THREE, inward(cube((0, 3, 0))))
    found = computed((points, triangles))
    assert str(found.mesh) == (
        "4 connected parts; 1 of them open; 1 of them with faces that were turned; "
        "3 of them apart from all others; 1 of them without thickness"
    )
    assert str(computed(cube()).mesh) == ""
    assert compute_axis(Shape(found.chosen.samples.points, triangles[:0]), Settings()).mesh is None
    np.savez(tmp_path / "a.npz", points=points, triangles=triangles)
    words = [str(tmp_path / "a.npz"), str(tmp_path / "b.ma"), "--json", "--samples", "1500"]
    assert cli.main(words) == cli.DONE
    told = json.loads(capsys.readouterr().out)["mesh"]
    table = told.pop("table")
    assert {kind: count for kind, count in told.items() if count} == (
        {"faces": 54, "parts": 4, "open": 1, "turned": 1, "apart": 3, "sheets": 1}
    )
    assert table[1] == {"part": 2, "faces": 18, "turned": 0, "open": True, "place": "sheet"}
    assert (table[3]["turned"], table[3]["place"], len(table)) == (12, "apart", 4)


def test_a_wrap_is_not_counted():
    settings = Settings(sides=SidesFrom.WRAP, wrap_opening=5.0, **FEW)
    found = compute_axis(Shape(*THREE), settings)
    assert (found.mesh.faces, found.mesh.parts, found.mesh.sheets) == (42, 3, 1)


def test_a_large_sheet_is_left_out_of_the_whole():
    """Less than three quarters of all faces bound the solid then."""
    points, triangles = wavy()
    found = computed(meshes.join(cube(), (9.0 * points + 2.0, triangles)))
    assert found.axis.level is not None and found.axis.level.betti == (1, 0, 0)
    assert (found.settings.sides, found.mesh.sheets) == (SidesFrom.SURFACE, 1)
    assert found.warnings[0].startswith("722 of 734 faces are sheets without thickness")
    assert found.axis.vertices.min() > -0.01 and found.axis.vertices.max() < 1.01


def test_a_split_shape_keeps_what_is_known():
    points, triangles = THREE
    shape = Shape(points, triangles, points + 1.0, sharp_edges=np.array([[0, 1], [0, 9], [24, 25]]))
    parts = split(shape, Settings())
    assert [part.number for part in parts.parts] == [1, 3] and parts.count == 3
    (warning,) = parts.warnings
    assert warning.startswith("1 of 3 connected parts are sheets without thickness")
    last = parts.parts[1].shape
    assert np.array_equal(last.points[last.triangles], points[triangles[-12:]])
    assert np.array_equal(last.normals, last.points + 1.0)
    assert last.sharp_edges.tolist() == [[0, 1]]


def test_each_part_in_a_program():
    found = medial_axis.compute_each_part(*THREE, sampling="surface", samples=1500)
    assert found.numbers == (1, 3)
    (warning,) = found.warnings
    assert warning.startswith("1 of 3 connected parts are sheets without thickness")
    for one, place in zip(found.computations, (0.5, 3.5), strict=True):
        assert one.axis.level.betti == (1, 0, 0)
        assert abs(one.axis.vertices.mean(axis=0)[0] - place) < 0.05
    alone = medial_axis.compute(*cube(), sampling="surface", samples=1500)
    assert np.array_equal(found.computations[0].axis.vertices, alone.axis.vertices)
    with pytest.raises(medial_axis.DegenerateInputError, match="found 1 without"):
        medial_axis.compute_each_part(*SHEET)
    with pytest.raises(medial_axis.InvalidInputError, match="found points only"):
        medial_axis.compute_each_part(THREE[0], np.zeros((0, 3), int))


def test_each_part_can_be_cancelled_and_watched():
    progress = medial_axis.Progress()
    medial_axis.compute_each_part(*THREE, progress=progress, sampling="surface", samples=800)
    assert progress.fraction == pytest.approx(1.0)
    progress.cancel()
    with pytest.raises(medial_axis.Cancelled):
        medial_axis.compute_each_part(*THREE, progress=progress)


def test_each_part_on_the_command_line(tmp_path, capsys):
    np.savez(tmp_path / "a.npz", points=THREE[0], triangles=THREE[1])
    np.savez(tmp_path / "sheet.npz", points=SHEET[0], triangles=SHEET[1])
    paths = [str(tmp_path / name) for name in ("a.npz", "sheet.npz", "out")]
    (tmp_path / "out").mkdir()
    code = cli.main([*paths, "--each-part", "--json", "--samples", "1500"])
    one, three, sheet = map(json.loads, capsys.readouterr().out.splitlines())
    assert (code, sheet["status"]) == (cli.INPUT, "failed")
    assert "found 1 without" in sheet["error"]
    assert (one["part"], three["part"]) == (1, 3)
    assert one["warnings"][0].startswith("1 of 3 connected parts are sheets")
    assert three["warnings"] == [] and three["mesh"]["parts"] == 1
    assert sorted(path.name for path in (tmp_path / "out").glob("*.ma")) == ["a_1.ma", "a_3.ma"]
    assert cli.main([*paths, "--each-part", "--json", "--samples", "1500"]) == cli.INPUT
    again = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [report["status"] for report in again] == ["kept", "kept", "failed"]


# --- bent sheets


def bent(height):
    """A grid bent to an arch across x."""
    points, triangles = grid(12)
    x = points[:, 0]
    return np.column_stack((points[:, :2], 4 * height * x * (1 - x))), triangles


def panels(mesh):
    """The faces of a cube as six parts, a crack of a thousandth apart."""
    points, triangles = mesh
    middle = points.mean(axis=0)
    normals = np.cross(*(points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2)))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    apart = points[triangles] + 1e-3 * normals[:, None]
    return (apart - middle).reshape(-1, 3), np.arange(triangles.size, dtype=np.int32).reshape(-1, 3)


@pytest.mark.parametrize("height", [0.001, 0.02, 0.1, -0.001, -0.02, -0.1])
@pytest.mark.parametrize("size", [1.0, 1e6])
def test_a_bent_sheet_is_refused(height, size):
    points, triangles = bent(height)
    with pytest.raises(DegenerateInputError, match="found an open sheet"):
        computed((size * points, triangles))
    with pytest.raises(DegenerateInputError, match="1 without"):
        split(Shape(size * points, triangles), Settings(**FEW))


@pytest.mark.parametrize("height", [0.02, -0.02])
def test_bent_sheets_beside_a_solid_are_left_out(height):
    points, triangles = bent(height)
    mesh = meshes.join(cube(), (points + 2.0, triangles), (points * (3, 3, 3) - 5.0, triangles))
    found = computed(mesh)
    assert found.axis.level.betti == (1, 0, 0) and found.mesh.sheets == 2
    assert found.axis.vertices.min() > -0.01 and found.axis.vertices.max() < 1.01


@pytest.mark.parametrize("missing", [1, 2])
def test_boxes_with_open_sides_are_none(missing):
    points, triangles = cube()
    found = computed((points, triangles[2 * missing :]))
    assert found.settings.sides is SidesFrom.SURFACE and found.mesh.sheets == 0


def test_panels_of_a_cube_bound_it_together():
    found = computed(panels(cube()))
    assert found.settings.sides is SidesFrom.SURFACE and found.axis.level.betti == (1, 0, 0)
