# SPDX-License-Identifier: GPL-3.0-or-later
"""Files written by core/files/write.py: counts, exact numbers, valid references, and writing whole or not at all."""

import dataclasses
import os
import resource
import shutil
import signal
import tempfile
from pathlib import Path

import numpy as np
import pytest
from medial_axis.core.axis.medial_axis import LevelValues, MedialAxis
from medial_axis.core.errors import ExportError
from medial_axis.core.files.load_axis import load_axis
from medial_axis.core.files.write import FORMATS, export_axis
from support.inputs import rotation
from support.measure import polygons
from support.readers import read_ma
from support.topology import vector_areas

EXTENSIONS = (".ma", ".ply", ".obj", ".off", ".npz")


def axis_of(vertices, polygons, seed=0):
    """A medial axis with made-up numbers on the given polygons."""
    rng = np.random.default_rng(seed)
    vertices = np.asarray(vertices, np.float64).reshape(-1, 3)
    counts = [len(polygon) for polygon in polygons]
    return MedialAxis(
        vertices=vertices,
        radius=rng.random(len(vertices)),
        face_offsets=np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
        face_vertices=np.array([v for polygon in polygons for v in polygon], np.int32),
        theta=rng.random(len(polygons)),
        rho=rng.random(len(polygons)) * 20,
        side=rng.integers(0, 4, len(polygons)).astype(np.int32),
        generators=rng.integers(0, 1000, (len(polygons), 2)).astype(np.int32),
        unbounded=3,
        zero_area=1,
    )


def fan_of_sheets(sheets=40, seed=1):
    """Convex polygons of 3 to 9 corners in three sheets round a common line, as a Y-shaped axis has them."""
    rng = np.random.default_rng(seed)
    vertices, polygons = [], []
    for _ in range(sheets):
        corners = int(rng.integers(3, 10))
        angles = np.sort(rng.random(corners)) * 2 * np.pi
        frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        flat = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(corners)])
        polygons.append(list(range(len(vertices), len(vertices) + corners)))
        vertices.extend(flat @ frame.T * rng.random() + rng.normal(size=3) * 1e3)
    return axis_of(vertices, polygons, seed)


def grid_of_quads(n=12):
    """A welded n x n sheet: shared edges, so that "every edge once" means something."""
    ij = np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), axis=-1).reshape(-1, 2)
    vertices = np.column_stack([ij / 7.0, np.sin(ij[:, 0] / 3.0)])
    corner = [i * n + j for i in range(n - 1) for j in range(n - 1)]
    return axis_of(vertices, [(c, c + n, c + n + 1, c + 1) for c in corner])


def clean_axis(seed=2):
    """A sheet, a chain of edges from its corner, and a vertex by itself; what is shown is moved a little."""
    sheet, rng = grid_of_quads(), np.random.default_rng(seed)
    first = len(sheet.vertices)
    shown = np.concatenate([sheet.vertices, rng.normal(size=(7, 3))])
    edges = np.array([[0, first], *((i, i + 1) for i in range(first, first + 5))], np.int32)
    level = LevelValues(
        exact=np.add(shown, (1 / 256, 1 / 128, 1 / 512)),
        exact_radius=rng.random(len(shown)),
        sheet=rng.random(sheet.facets).astype(np.float32),
        erosion=rng.random(sheet.facets).astype(np.float32),
        limb=np.array([*rng.random(5), np.inf], np.float32),
        betti=(2, 0, 0),
        place=rng.integers(0, 6, len(shown)).astype(np.int32),
    )
    radius = rng.random(len(shown))
    return dataclasses.replace(sheet, vertices=shown, radius=radius, edges=edges, level=level)


def curve_axis():
    """Edges alone."""
    clean = clean_axis()
    level = dataclasses.replace(clean.level, sheet=np.empty(0), erosion=np.empty(0))
    none = axis_of([], [])
    fields = ("face_offsets", "face_vertices", "theta", "rho", "side", "generators")
    nothing = {name: getattr(none, name) for name in fields}
    return dataclasses.replace(clean, level=level, **nothing)


EMPTY = axis_of([], [])
AXES = {"sheets": fan_of_sheets(), "grid": grid_of_quads(), "clean": clean_axis()}
AXES |= {"curve": curve_axis(), "empty": EMPTY}
LEVEL_FIELDS = ("sheet", "erosion", "limb", "place")


@pytest.fixture(params=AXES)
def axis(request):
    return AXES[request.param]


# --- readers, written from the formats and not from the writers


def polygons_of(axis):
    return polygons(axis) if len(axis.face_offsets) > 1 else []


def balls(axis):
    """(v, 4) centres and radii: shown ones where balls end at faces or there is no level, else those at samples."""
    shown, level = np.column_stack([axis.vertices, axis.radius]), axis.level
    if level is None:
        return shown
    at_samples = np.column_stack([level.exact, level.exact_radius])
    return np.where((level.place >= 2)[:, None], shown, at_samples)


def lone_vertices(axis):
    used = {*axis.face_vertices.tolist(), *axis.edges.ravel().tolist()}
    return sorted(set(range(len(axis.vertices))) - used)


def read_ply(path):
    """vertices, as records; per face: corners, theta, rho, side, p, q, and the floats of a level; edges, as records."""
    data = Path(path).read_bytes()
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    vertex_count, face_count, edge_count = (
        int(line.split()[2]) for line in lines if line.startswith("element")
    )
    floats = lines.count("property float sheet") + lines.count("property float erosion")
    width = {"uchar": "u1", "int": "<i4"}[next(line for line in lines if "list" in line).split()[2]]
    place = [("place", "<i4")] if "property int place" in lines else []
    vertices = np.frombuffer(body, [("ball", "<f8", 4), *place], vertex_count)
    at, faces = vertices.nbytes, []
    for _ in range(face_count):
        count = int(np.frombuffer(body, width, 1, at)[0])
        at += np.dtype(width).itemsize
        corners = np.frombuffer(body, "<i4", count, at)
        theta, rho = np.frombuffer(body, "<f8", 2, at + 4 * count)
        side, p, q = np.frombuffer(body, "<i4", 3, at + 4 * count + 16)
        at += 4 * count + 28
        known = np.frombuffer(body, "<f4", floats, at)
        at += 4 * floats
        faces.append((corners, theta, rho, side, p, q, *known))
    limb = [("limb", "<f4")] if "property float limb" in lines else []
    edges = np.frombuffer(body, [("ends", "<i4", 2), *limb], edge_count, at)
    assert at + edges.nbytes == len(body)
    return vertices, faces, edges


# --- content


def test_ma_holds_every_number_each_edge_once_and_triangles_that_cover_each_polygon(axis, tmp_path):
    vertices, edges, faces = read_ma(export_axis(axis, tmp_path / "a.ma"))
    assert np.array_equal(vertices, balls(axis))
    listed = [tuple(sorted(edge)) for edge in edges.tolist()]
    of_faces = {tuple(sorted((f[i], f[i - 1]))) for f in faces.tolist() for i in range(3)}
    assert len(set(listed)) == len(listed)
    assert set(listed) == of_faces | {tuple(sorted(edge)) for edge in axis.edges.tolist()}
    counts = np.diff(axis.face_offsets)
    assert len(faces) == (counts - 2).sum()
    areas = vector_areas(vertices[:, :3], faces)
    start = 0
    for polygon in polygons_of(axis):
        own = slice(start, start + len(polygon) - 2)
        assert set(faces[own].ravel()) == set(polygon)
        fan = np.column_stack([np.full(len(polygon) - 2, polygon[0]), polygon[1:-1], polygon[2:]])
        whole = vector_areas(vertices[:, :3], fan).sum(axis=0)
        size = np.linalg.norm(whole)
        assert np.allclose(areas[own].sum(axis=0), whole, rtol=1e-9, atol=1e-9 * size)
        assert (areas[own] @ whole > 0).all()  # all turn as the polygon does, none is empty
        start = own.stop


def test_ma_is_plain_ascii_with_lf_and_no_comments(tmp_path):
    text = export_axis(AXES["grid"], tmp_path / "a.ma").read_bytes().decode("ascii")
    assert "\r" not in text and "#" not in text and text.endswith("\n")
    assert all(line.split(" ")[0] in "vef" for line in text.splitlines()[1:])


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_triangles_of_polygons_with_straight_corners_have_area(tmp_path, scale):
    """Corners on straight sides: a fan from the first corner would give triangles without area."""
    base = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]
    triangle, base_only = [*base, [2, 1, 0], [1, 2, 0], [0, 3, 0], [0, 1, 0]], [*base, [1, 4, 0]]
    shapes = (triangle, base_only)
    turns = [np.roll(shape, turn, axis=0) for shape in shapes for turn in range(len(shape))]
    vertices = np.concatenate(turns)
    corners = np.split(np.arange(len(vertices)), np.cumsum([len(turn) for turn in turns])[:-1])
    points, _, faces = read_ma(export_axis(axis_of(vertices * scale, corners), tmp_path / "a.ma"))
    areas = vector_areas(points[:, :3], faces)[:, 2]
    assert len(faces) == len(vertices) - 2 * len(turns)
    assert areas.min() > 0.4 * scale**2


def test_ply_holds_polygons_and_all_attributes(axis, tmp_path):
    vertices, faces, edges = read_ply(export_axis(axis, tmp_path / "a.ply"))
    assert np.array_equal(edges["ends"], axis.edges)
    assert axis.level is None or np.array_equal(edges["limb"], axis.level.limb)
    assert np.array_equal(vertices["ball"], np.column_stack([axis.vertices, axis.radius]))
    assert axis.level is None or np.array_equal(vertices["place"], axis.level.place)
    assert len(faces) == len(axis.theta)
    for i, (face, polygon) in enumerate(zip(faces, polygons_of(axis))):
        corners, theta, rho, side, p, q, *known = face
        if axis.level is not None:
            assert known == [axis.level.sheet[i], axis.level.erosion[i]]
        assert np.array_equal(corners, polygon)
        assert (theta, rho, side) == (axis.theta[i], axis.rho[i], axis.side[i])
        assert [p, q] == axis.generators[i].tolist()


def test_ply_of_a_face_with_more_than_255_corners(tmp_path):
    angles = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    points = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    wheel = axis_of(points, [range(300), range(3)])
    _, faces, _ = read_ply(export_axis(wheel, tmp_path / "a.ply"))
    assert [len(face[0]) for face in faces] == [300, 3]
    _, _, triangles = read_ma(export_axis(wheel, tmp_path / "a.ma"))
    assert len(triangles) == 299


def test_obj_holds_polygons(axis, tmp_path):
    lines = export_axis(axis, tmp_path / "a.obj").read_text(encoding="ascii").splitlines()
    vertices = [[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")]
    faces = [[int(x) - 1 for x in line.split()[1:]] for line in lines if line.startswith("f ")]
    edges = [[int(x) - 1 for x in line.split()[1:]] for line in lines if line.startswith("l ")]
    alone = [int(line.split()[1]) - 1 for line in lines if line.startswith("p ")]
    comments = axis.level is not None
    assert len(lines) == comments + len(vertices) + len(faces) + len(edges) + len(alone)
    assert (edges, alone) == (axis.edges.tolist(), lone_vertices(axis))
    assert np.array_equal(np.reshape(vertices, (-1, 3)), axis.vertices)
    assert faces == [polygon.tolist() for polygon in polygons_of(axis)]


def test_off_holds_polygons(axis, tmp_path):
    lines = export_axis(axis, tmp_path / "a.off").read_text(encoding="ascii").splitlines()
    count = len(axis.vertices)
    assert lines[:2] == ["OFF", f"{count} {len(axis.theta) + len(axis.edges)} 0"]
    vertices = [[float(x) for x in line.split()] for line in lines[2 : 2 + count]]
    faces = [[int(x) for x in line.split()] for line in lines[2 + count :]]
    assert np.array_equal(np.reshape(vertices, (-1, 3)), axis.vertices)
    polygons = [[len(polygon), *polygon] for polygon in polygons_of(axis)]
    assert faces == polygons + [[2, *edge] for edge in axis.edges.tolist()]


NO_ARRAYS = ("level", "structure")  # they have arrays of their own


def test_npz_holds_everything(axis, tmp_path):
    """Exact balls have the names that every axis has; the shown places have names of their own."""
    arrays = np.load(export_axis(axis, tmp_path / "a.npz"))
    wanted = {name: value for name, value in vars(axis).items() if name not in NO_ARRAYS}
    if (level := axis.level) is not None:
        wanted |= {"vertices": level.exact, "radius": level.exact_radius, "betti": level.betti}
        wanted |= {"shown": axis.vertices, "shown_radius": axis.radius}
        wanted |= {name: getattr(level, name) for name in LEVEL_FIELDS}
    assert set(arrays) == set(wanted)
    for name, value in wanted.items():
        assert np.array_equal(arrays[name], value) and arrays[name].dtype == np.asarray(value).dtype


def test_npz_comes_back(axis, tmp_path):
    if axis is EMPTY:
        pytest.skip("an axis of nothing is not read")
    again = load_axis(export_axis(axis, tmp_path / "a.npz"))
    for name, value in vars(axis).items():
        if name not in NO_ARRAYS:
            assert np.array_equal(getattr(again, name), value), name
    assert (again.level is None) == (axis.level is None)
    for name in () if axis.level is None else (*LEVEL_FIELDS, "exact", "exact_radius", "betti"):
        assert np.array_equal(getattr(again.level, name), getattr(axis.level, name)), name


@pytest.mark.parametrize("name, missing", [("clean", "place"), ("grid", "edges")])
def test_npz_of_an_older_version_is_read(name, missing, tmp_path):
    """One has no crisp places, the other no forms."""
    axis = AXES[name]
    with np.load(export_axis(axis, tmp_path / "a.npz")) as arrays:
        kept = {key: array for key, array in arrays.items() if key != missing}
    np.savez(tmp_path / "old.npz", **kept)
    again = load_axis(tmp_path / "old.npz")
    if axis.level is None:
        assert again.edges.shape == (0, 2) and again.level is None
    else:
        assert np.array_equal(again.level.exact, axis.level.exact) and not again.level.place.any()


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ([0, 1, 0, 1], "All balls end at the samples"),
        ([2, 3, 4, 5], "All balls end at the faces"),
        ([0, 1, 2, 5], "2 of 4 balls end at the faces, the others at the samples"),
    ],
)
@pytest.mark.parametrize("triangles", [False, True])
def test_files_say_where_balls_end(place, words, triangles, tmp_path):
    grid, place = grid_of_quads(2), np.array(place, np.int32)
    values, none = np.ones(1, np.float32), np.ones(0, np.float32)
    level = LevelValues(grid.vertices, grid.radius, values, values, none, (1, 0, 0), place)
    axis = dataclasses.replace(grid, level=level)
    for name, mark in (("a.ply", "comment"), ("a.obj", "#")):
        text = export_axis(axis, tmp_path / name, triangles=triangles).read_bytes()
        assert f"{mark} {words}".encode() in text.splitlines()
        plain = export_axis(grid, tmp_path / name, triangles=triangles).read_bytes()
        assert b"balls end" not in plain
    assert level.refused == np.count_nonzero(place == 1)


# --- placing


@pytest.mark.parametrize("rows", [3, 4])
def test_rigid_transform_moves_points_and_leaves_radii(rows, tmp_path):
    axis, turn = AXES["sheets"], rotation(3)
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, (1, 2, 3)
    matrix = matrix.astype(np.float32)[:rows]
    vertices, _, _ = read_ma(export_axis(axis, tmp_path / "a.ma", matrix))
    expected = axis.vertices @ matrix[:3, :3].T.astype(np.float64) + (1, 2, 3)
    assert np.allclose(vertices[:, :3], expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    assert np.array_equal(vertices[:, 3], axis.radius)


@pytest.mark.parametrize("name", ["grid", "clean"])
def test_even_scale_scales_radii(name, tmp_path):
    axis, twice = AXES[name], np.diag([2.0, 2.0, 2.0, 1.0])
    vertices, _, _ = read_ma(export_axis(axis, tmp_path / "a.ma", twice))
    assert np.allclose(vertices, 2 * balls(axis), rtol=1e-15)
    vertices, _, _ = read_ply(export_axis(axis, tmp_path / "a.ply", twice))
    shown = np.column_stack([axis.vertices, axis.radius])
    assert np.allclose(vertices["ball"], 2 * shown, rtol=1e-15)


UNEVEN = [(1, 2, 1), (2, 2, 1), (2, 1, 1), (1, 1, 0), (0, 0, 0)]


@pytest.mark.parametrize(
    "matrix, words",
    [
        *((np.diag([*scales, 1.0]), "scaled evenly") for scales in UNEVEN),
        (np.full((4, 4), np.nan), "finite 3x4 or 4x4 transform"),
        (np.eye(3), "3x4 or 4x4 transform, found shape"),
    ],
)
def test_transform_that_makes_no_balls_is_refused(matrix, words, tmp_path):
    with pytest.raises(ExportError, match=words):
        export_axis(AXES["grid"], tmp_path / "a.ma", matrix)
    assert list(tmp_path.iterdir()) == []


# --- whole or not at all


def assert_one_sentence(error):
    """One that ends without a full stop."""
    text = str(error.value)
    assert "\n" not in text and ". " not in text and not text.endswith(".")


def assert_unwritten(folder, target, old):
    """`target` still holds `old` (None: is absent) and nothing else lies in `folder`."""
    assert sorted(folder.iterdir()) == ([target] if old is not None else [])
    assert old is None or target.read_bytes() == old


@pytest.fixture(params=[b"precious", None], ids=["over old", "new"])
def old(request):
    return request.param


@pytest.fixture(params=EXTENSIONS)
def target(request, tmp_path, old):
    path = tmp_path / ("axis" + request.param)
    if old is not None:
        path.write_bytes(old)
    return path


def test_old_file_is_replaced(target):
    assert export_axis(AXES["grid"], target) == target
    assert target.read_bytes()[:8] != b"precious" and len(list(target.parent.iterdir())) == 1


def test_full_disk(target, old, tmp_path):
    """The kernel refuses to let the file grow: the write fails in the middle, as on a full disk."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))
    try:
        with pytest.raises(ExportError, match="Expected to write .*system says") as error:
            export_axis(AXES["sheets"], target)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert_one_sentence(error)
    assert_unwritten(tmp_path, target, old)


@pytest.mark.parametrize("extension", EXTENSIONS)
def test_read_only_folder(extension, old):
    """Root may write everywhere, so root becomes nobody for the attempt."""
    folder = Path(tempfile.mkdtemp())
    target = folder / ("axis" + extension)
    try:
        if old is not None:
            target.write_bytes(old)
        folder.chmod(0o555)
        user = os.geteuid()
        if user == 0:
            os.seteuid(65534)
        try:
            with pytest.raises(ExportError, match="Permission denied") as error:
                export_axis(AXES["grid"], target)
        finally:
            os.seteuid(user)
        assert_one_sentence(error)
        assert_unwritten(folder, target, old)
    finally:
        folder.chmod(0o755)
        shutil.rmtree(folder)


@pytest.mark.parametrize(
    "call, error, expected",
    [
        ("replace", OSError(5, "Input/output error"), ExportError),
        ("fsync", KeyboardInterrupt(), KeyboardInterrupt),
    ],
)
def test_interrupted_write_leaves_nothing(
    target, old, tmp_path, monkeypatch, call, error, expected
):
    def refuse(*_given):
        raise error

    monkeypatch.setattr(os, call, refuse)
    with pytest.raises(expected, match="Input/output error" if call == "replace" else ""):
        export_axis(AXES["grid"], target)
    assert_unwritten(tmp_path, target, old)


def test_link_is_followed(tmp_path):
    (tmp_path / "real").mkdir()
    link = tmp_path / "a.off"
    link.symlink_to(tmp_path / "real" / "b.off")
    assert export_axis(EMPTY, link) == tmp_path / "real" / "b.off"
    assert link.is_symlink() and link.read_text() == "OFF\n0 0 0\n"


def test_formats_are_the_documented_ones():
    assert tuple(FORMATS) == (*EXTENSIONS, ".csv")
