# SPDX-License-Identifier: GPL-3.0-or-later
# ruff: noqa: F811 - the fixture of another file is an argument here
"""PLY, OBJ, STL, COLLADA and arrays of NumPy: the same cube comes out of each, and nothing wrong goes in."""

import io
import itertools
import struct
from functools import partial

import numpy as np
import pytest
from medial_axis.core.files.read_shape import read_shape
from support.topology import volume
from test_import import read, refusal  # noqa: F401 - a fixture

POINTS = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
QUADS = np.array(
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
)
NORMALS = (POINTS - 0.5) / np.sqrt(0.75)
TRIANGLES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
# A pyramid over the first side, so that faces of 3 and 4 corners follow each other.
MIXED = [[0, 1, 3, 2], [0, 4, 1], [1, 4, 3], [3, 4, 2], [2, 4, 0]]
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


def ply(kind="ascii", faces=QUADS.tolist(), normals=None, extra=False):
    """A PLY file; `extra` adds what has to be passed over."""
    axes = [*"xyz"] + (["nx", "ny", "nz"] if normals is not None else [])
    header = ["ply", f"format {kind} 1.0", "comment made by hand"]
    if extra:
        header += ["element camera 2", "property list uchar int view", "property float f"]
    header += [f"element vertex {len(POINTS)}", *[f"property double {axis}" for axis in axes]]
    header += ["property uchar red"] if extra else []
    header += [f"element face {len(faces)}"] + (["property short tag"] if extra else [])
    header += ["property list uchar int vertex_indices"]
    header += ["property list uchar float uv"] if extra else []
    rows = [[("B", n), *[("i", 7)] * n, ("f", 0.5)] for n in (1, 2)] if extra else []
    for i, point in enumerate(POINTS):
        values = [*point, *(normals[i] if normals is not None else ())]
        rows.append([("d", x) for x in values] + ([("B", 200)] if extra else []))
    for face in faces:
        row = [("h", -4)] if extra else []
        row += [("B", len(face)), *[("i", corner) for corner in face]]
        rows.append(row + ([("B", 1), ("f", 0.25)] if extra else []))
    text = "\n".join([*header, "end_header"]).encode() + b"\n"
    if kind == "ascii":
        return text + "".join(" ".join(f"{v:.17g}" for _, v in r) + "\n" for r in rows).encode()
    return text + b"".join(struct.pack(ORDERS[kind] + c, v) for row in rows for c, v in row)


def obj(faces=QUADS.tolist()):
    lines = [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in POINTS]
    return "\n".join([*lines, *["f " + " ".join(str(i + 1) for i in face) for face in faces], ""])


def off():
    rows = ["{:g} {:g} {:g}".format(*point) for point in POINTS]
    return "\n".join(["OFF", "8 6 0", *rows, *["4 {} {} {} {}".format(*q) for q in QUADS], ""])


def off_binary(order=">", real="f", colours=(0,), faces=QUADS.tolist(), points=POINTS, kind=""):
    """A binary OFF file; `colours` follow each face: their number, and as many words."""
    words = [word for face in faces for word in (len(face), *face, *colours)]
    data = struct.pack(f"{order}3i", len(points), len(faces), 0)
    data += struct.pack(f"{order}{points.size}{real}", *points.ravel())
    return f"{kind}OFF BINARY\n".encode() + data + struct.pack(f"{order}{len(words)}i", *words)


def stl_text():
    facets = []
    for triangle in POINTS[TRIANGLES]:
        corners = "".join("    vertex {:g} {:g} {:g}\n".format(*corner) for corner in triangle)
        facets.append(f"facet normal 0 0 0\n  outer loop\n{corners}  endloop\nendfacet\n")
    return "solid cube\n" + "".join(facets) + "endsolid cube\n"


def stl_binary(header=b"not solid"):
    count = struct.pack("<I", len(TRIANGLES))
    rows = [struct.pack("<12fH", 0, 0, 0, *POINTS[triangle].ravel(), 0) for triangle in TRIANGLES]
    return header.ljust(80, b" ") + count + b"".join(rows)


MESH = "<instance_geometry url='#g'/>"
DAE = """<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema'><asset>{asset}</asset>
<library_geometries><geometry id='g'><mesh><source id='s'><float_array id='a'>{numbers}</float_array>
<technique_common><accessor source='#a' count='8' offset='1' stride='4'/></technique_common></source>
<vertices id='v'><input semantic='POSITION' source='#s'/></vertices>{groups}
<lines><input semantic='VERTEX' source='#v' offset='0'/><p>0 7</p></lines></mesh></geometry>
</library_geometries><library_nodes><node id='n'>{node}</node></library_nodes><library_visual_scenes>
<visual_scene id='here'>{scene}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url='#here'/></scene></COLLADA>"""


def group(kind="polylist", faces=QUADS.tolist(), at=0, width=1):
    """Faces of a COLLADA file; behind each corner or before it are ids of something else."""
    rows = [
        " ".join(" ".join(["99"] * at + [str(i)] + ["99"] * (width - 1 - at)) for i in f)
        for f in faces
    ]
    lists = rows if kind == "polygons" else [" ".join(rows)]
    counts = f"<vcount>{' '.join(str(len(face)) for face in faces)}</vcount>"
    kinds = ["VERTEX" if i == at else "TEXCOORD" for i in range(width)]
    inputs = [f"<input semantic='{k}' source='#v' offset='{i}'/>" for i, k in enumerate(kinds)]
    body = "".join([*inputs[::-1], counts if kind == "polylist" else ""])
    return f"<{kind}>{body}{''.join(f'<p>{row}</p>' for row in lists)}</{kind}>"


def dae(groups=group(), scene=f"<node>{MESH}</node>", asset="", node=MESH):
    """A COLLADA file whose points have a number before and one between them, as accessors allow."""
    numbers = "7 " + "".join("{:.17g} {:.17g} {:.17g} 7 ".format(*point) for point in POINTS)
    return DAE.format(groups=groups, scene=scene, asset=asset, node=node, numbers=numbers)


def npz(**arrays):
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def npy(array):
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


@pytest.fixture
def refuse(read):
    return partial(refusal, read)


def faces_of(found):
    return [row.tolist() for row in np.split(found.face_vertices, found.face_offsets[1:-1])]


def assert_cube(found, normals=None, faces=QUADS.tolist()):
    np.testing.assert_array_equal(found.vertices, POINTS)
    assert found.vertices.dtype == np.float64 and found.face_vertices.dtype == np.int32
    assert faces_of(found) == faces and found.warnings == ()
    assert (found.normals is None) == (normals is None)
    assert normals is None or np.array_equal(found.normals, normals)


# --- PLY


@pytest.mark.parametrize("extra", [False, True], ids=["plain", "extra"])
@pytest.mark.parametrize("faces", [QUADS.tolist(), TRIANGLES.tolist(), MIXED, []])
@pytest.mark.parametrize("kind", ORDERS)
def test_ply(read, kind, faces, extra):
    found = read("a.ply", ply(kind, faces, NORMALS, extra))
    if faces:
        assert_cube(found, NORMALS, faces)
    else:
        assert found.faces == 0


def test_ply_without_faces(read):
    text = ply(normals=NORMALS).split(b"element face")[0] + b"end_header\n"
    rows = ply(normals=NORMALS).split(b"end_header\n")[1].splitlines()[: len(POINTS)]
    found = read("a.ply", text + b"\n".join(rows))
    np.testing.assert_array_equal(found.normals, NORMALS)
    assert found.faces == 0


def test_ply_of_floats_and_other_names_of_types(read):
    content = ply("binary_little_endian").replace(b"property double", b"property float64")
    assert_cube(read("a.ply", content.replace(b"list uchar int ", b"list uint8 uint32 ")))


def test_ply_leaves_lines_and_points_of_faces(read):
    found = read("a.ply", ply("binary_little_endian", [*MIXED, [0, 1], [5]]))
    assert faces_of(found) == MIXED
    assert found.warnings == ("Left out faces of fewer than three corners: 2",)


PASSED_OVER = """ply
format ascii 1.0
element vertex 3
property double x
property double y
property double z
property float quality
element face 1
property list uchar int vertex_indices
property double rho
end_header
0 0 0 nan
1 0 0 1e999
0 1 0 -inf
3 0 1 2 inf
"""


def test_what_is_passed_over_in_a_ply_need_not_be_finite(read, refuse):
    """Programs write so what they do not know; an axis may have an infinite rho. In text as in binary."""
    found = read("a.ply", PASSED_OVER.encode())
    assert found.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert found.face_vertices.tolist() == [0, 1, 2] and found.warnings == ()
    for right, wrong in (("1 0 0 1e999", "1 0 1e999 0"), ("0 1 0 -inf", "nan 1 0 0")):
        line = PASSED_OVER[: PASSED_OVER.index(right)].count("\n") + 1
        refuse("a.ply", PASSED_OVER.replace(right, wrong), f"finite numbers in line {line}")
    refuse("a.ply", PASSED_OVER.replace("nan", "none"), "numbers in line 12 .* 'none'")
    for corners in ("inf 0 1 2", "3 0 1 inf", "nan 0 1 2", "3 0 nan 2"):
        refuse("a.ply", PASSED_OVER.replace("3 0 1 2", corners), "corners")


# --- OBJ


def test_obj(read):
    assert_cube(read("a.obj", obj()))
    assert_cube(read("a.obj", obj(MIXED)), faces=MIXED)


def test_obj_as_others_write_it(read):
    points = "".join(f"v {x:g} {y:g} {z:g} 1.0 0.5 0.5 # c\r\n" for x, y, z in POINTS)
    faces = "".join("f " + " ".join(f"{i - 8}/1/2" for i in face) + "\n" for face in QUADS)
    faces = faces.replace("/1/2 ", "/1/2 \\\n", 1).replace("/1/2", "//3", 5)
    text = "# m\nmtllib a.mtl\no Cube\nvt 0 0\nvn 0 0 1\n" + points + "usemtl x\ns off\n" + faces
    assert_cube(read("a.obj", text))


def test_obj_of_points_with_normals(read):
    row = "vn {:.17g} {:.17g} {:.17g}\nv {:g} {:g} {:g}\n"
    text = "".join(row.format(*n, *p) for n, p in zip(NORMALS, POINTS))
    found = read("a.obj", text)
    np.testing.assert_array_equal(found.normals, NORMALS)
    assert found.faces == 0


# --- STL


@pytest.mark.parametrize(
    "content",
    [
        stl_text(),
        stl_text().replace("solid cube", "a title of some exporter", 1),
        stl_text().removeprefix("solid cube\n").upper(),
        stl_binary(),
        stl_binary(b"solid it is not"),
        stl_binary(b"\xef\xbb\xbfsolid facet normal"),
    ],
)
def test_stl(read, content):
    found = read("a.stl", content)
    assert len(found.vertices) == 8 and found.faces == 12
    corners = POINTS[TRIANGLES].reshape(-1, 3)
    np.testing.assert_array_equal(found.vertices[found.face_vertices], corners)
    first, seen = [*map(tuple, found.vertices)], [*dict.fromkeys(map(tuple, corners))]
    assert first == seen, "points come in the order of the file"


# --- COLLADA


SPLIT = [*QUADS[:5].tolist(), [1, 5, 7], [1, 7, 3]]


@pytest.mark.parametrize("at, width", [(0, 1), (0, 3), (2, 3)])
@pytest.mark.parametrize(
    "kind, faces",
    [("triangles", TRIANGLES.tolist()), ("polylist", SPLIT), ("polygons", SPLIT)],
)
def test_dae(read, kind, faces, at, width):
    assert_cube(read("a.dae", dae(group(kind, faces, at, width))), faces=faces)


def test_dae_of_several_groups_leaves_what_is_no_polygon(read):
    """A mesh has a group for each material. Lines, and points that only they use, are no part of a solid."""
    parts = [
        group("polygons", MIXED[:1]),
        group("triangles", MIXED[1:]),
        group("polygons", [[1, 0]]),
    ]
    found = read("a.dae", dae("".join(parts)))
    np.testing.assert_array_equal(found.vertices, POINTS[:5])
    assert faces_of(found) == MIXED
    assert found.warnings == ("Left out faces of fewer than three corners: 1",)


QUARTER, AWAY = "<rotate>0 0 2 90</rotate>", "<translate>1 2 3</translate>"
SHIFT = np.array([1.0, 2.0, 3.0])
TURNED = POINTS[:, [1, 0, 2]] * (-1, 1, 1)
PLACES = {
    "translate": (f"<node>{AWAY}{MESH}</node>", POINTS + SHIFT),
    "scale": (f"<node><scale>2 1 3</scale>{MESH}</node>", POINTS * (2, 1, 3)),
    "rotate": (f"<node>{QUARTER}{MESH}</node>", TURNED),
    "no axis": (f"<node><rotate>0 0 0 0</rotate>{MESH}</node>", POINTS),
    "matrix": (f"<node><matrix>0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1</matrix>{MESH}</node>", TURNED + SHIFT),
    "in order": (f"<node>{AWAY}{QUARTER}{MESH}</node>", TURNED + SHIFT),
    "nested": (f"<node>{QUARTER}<node>{AWAY}{MESH}</node></node>", (POINTS + SHIFT)[:, [1, 0, 2]] * (-1, 1, 1)),
    "instance": (f"<node>{AWAY}<instance_node url='#n'/></node>", TURNED + SHIFT),
    "beside a camera": (f"<node><lookat>0 0 0 1 1 1 0 0 1</lookat></node><node>{MESH}</node>", POINTS),
}  # fmt: skip


@pytest.mark.parametrize("scene, expected", PLACES.values(), ids=PLACES)
def test_places_in_a_dae(read, scene, expected):
    found = read("a.dae", dae(scene=scene, node=QUARTER + MESH))
    np.testing.assert_allclose(found.vertices, expected, rtol=0, atol=1e-15)


def test_several_instances_in_a_dae(read):
    found = read("a.dae", dae(scene=f"<node>{MESH}<node>{AWAY}{MESH}</node></node>"))
    np.testing.assert_array_equal(found.vertices, np.concatenate([POINTS, POINTS + SHIFT]))
    assert faces_of(found) == [*QUADS.tolist(), *(QUADS + 8).tolist()]


def test_a_mirrored_dae_keeps_its_faces_outward(tmp_path):
    (tmp_path / "a.dae").write_text(dae(scene=f"<node><scale>-1 1 2</scale>{MESH}</node>"))
    shape, _ = read_shape(tmp_path / "a.dae")
    assert volume(shape.points, shape.triangles) == pytest.approx(2.0)


@pytest.mark.parametrize("up", ["X", "Y", "Z"])
def test_units_and_axes_of_a_dae(read, up):
    """Lengths become metres, those of nodes as well, and nothing is turned, as in viewers of robots."""
    asset = f"<unit name='inch' meter='0.0254'/><up_axis>{up}_UP</up_axis>"
    found = read("a.dae", dae(scene=f"<node>{AWAY}{MESH}</node>", asset=asset))
    np.testing.assert_array_equal(found.vertices, 0.0254 * (POINTS + SHIFT))


def test_a_dae_of_trimesh(read):
    trimesh, _ = pytest.importorskip("trimesh"), pytest.importorskip("collada")
    body = trimesh.Trimesh(POINTS, TRIANGLES, process=False)
    assert_cube(read("a.dae", trimesh.exchange.dae.export_collada(body)), faces=TRIANGLES.tolist())


# --- text of other programs


@pytest.mark.parametrize(
    "name, content",
    [
        ("a.obj", obj()),
        ("a.off", off()),
        ("a.ply", ply()),
        ("a.ply", ply("binary_little_endian")),
        ("a.stl", stl_text()),
        ("a.dae", dae()),
        ("a.xyz", "".join("{:g} {:g} {:g}\n".format(*p) for p in POINTS)),
    ],
)
def test_a_byte_order_mark_changes_nothing(read, name, content):
    content = content if isinstance(content, bytes) else content.encode()
    plain, marked = read(name, content), read(name, b"\xef\xbb\xbf" + content)
    np.testing.assert_array_equal(marked.vertices, plain.vertices)
    np.testing.assert_array_equal(marked.face_vertices, plain.face_vertices)


# --- binary OFF


@pytest.mark.parametrize("faces", [QUADS.tolist(), MIXED])
@pytest.mark.parametrize(
    "order, real, colours",
    [(">", "f", (0,)), (">", "f", (4, 0, 0, 0, 0)), ("<", "f", ()), ("<", "d", ())],
    ids=["CGAL", "Geomview", "pmp", "pmp of 64 bits"],
)
def test_binary_off(read, faces, order, real, colours):
    assert_cube(read("a.off", off_binary(order, real, colours, faces)), faces=faces)


def test_binary_off_with_normals(read):
    found = read("a.off", off_binary(points=np.column_stack([POINTS, NORMALS]), kind="N"))
    np.testing.assert_array_equal(found.vertices, POINTS)
    np.testing.assert_allclose(found.normals, NORMALS, rtol=1e-6)


# --- NumPy


def test_arrays(read):
    assert_cube(read("a.npz", npz(points=POINTS, triangles=TRIANGLES)), faces=TRIANGLES.tolist())
    found = read("a.npz", npz(points=POINTS.astype("f4"), normals=NORMALS, other=np.zeros(3)))
    np.testing.assert_array_equal(found.normals, NORMALS)
    found = read("a.npy", npy(np.column_stack([POINTS, NORMALS])))
    np.testing.assert_array_equal(found.vertices, POINTS)
    np.testing.assert_array_equal(found.normals, NORMALS)
    assert read("b.npy", npy(POINTS.astype(int))).normals is None


# --- polygons of any shape


def test_shape_of_a_file(tmp_path):
    (tmp_path / "a.obj").write_text(obj())
    shape, warnings = read_shape(tmp_path / "a.obj")
    assert shape.triangles.shape == (12, 3) and shape.triangles.dtype == np.int32
    assert volume(shape.points, shape.triangles) == pytest.approx(1.0)
    assert warnings == () and shape.normals is None
    np.testing.assert_array_equal(shape.frame, np.identity(4))


# --- refused


def with_header(header, order="ascii"):
    """A PLY file of a header and more rows than it may have."""
    return f"ply\nformat {order} 1.0\n{header}end_header\n0 0 0 0\n0 0 0 0\n".encode()


def with_count(count):
    """A PLY file whose first face tells a number of corners by one byte."""
    data = ply("binary_little_endian", MIXED).replace(b"list uchar", b"list char")
    start = data.index(b"end_header\n") + len(b"end_header\n") + 24 * len(POINTS)
    return data[:start] + count + data[start + 1 :]


XYZ = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
LISTED = XYZ.replace("1\n", "1\nproperty list uchar int a\n", 1)
REFUSED = {
    "a.ply": [
        (b"", "'ply' as the first line"),
        (b"ply\nformat ascii 1.0\n", "line 3 of 'a.ply'"),
        (b"ply\nformat text 1.0\nend_header\n", "line 2"),
        (b"ply\nend_header\n", "line 'format'"),
        (b"ply\nformat ascii 1.0\nelement face 0\nend_header\n", "element 'vertex'"),
        (ply()[:-20], "12 rows|6 rows|corners in line"),
        (ply("binary_little_endian")[:-1], "6 rows of 'face'"),
        (ply("binary_little_endian").replace(b"vertex 8", b"vertex 999999999999"), "rows of 'vert"),
        (ply(faces=[[0, 1, 8]]), "corners from 0 to 7"),
        (ply("binary_big_endian", faces=[[0, 1, -1]]), "corners from 0 to 7"),
        (ply().replace(b"\n1 1 1\n", b"\n1 nan 1\n"), "finite numbers in line 18"),
        (ply("binary_little_endian", normals=NORMALS * np.nan), "finite numbers .* normal 0"),
        (ply().replace(b"4 0 1 3 2", b"4 0 1 3"), "as many corners in line 19"),
        (ply().replace(b"vertex_indices", b"strips"), "list vertex_indices"),
        (with_header(LISTED), "lists"),
        (with_header(XYZ + XYZ), "one element"),
        (with_count(b"\xff"), "Expected a number of corners"),
        # An element without properties takes no bytes, so the length of the file says nothing about its rows.
        *(
            (with_header(f"element junk {rows}\n{XYZ}", order), f"Expected {words}")
            for order in ("ascii", "binary_little_endian")
            for rows, words in (
                ("3", "properties of the element 'junk'"),
                ("-1", "a header of PLY in line 3"),
                ("99999999999999999999", "a header of PLY in line 3"),
            )
        ),
    ],
    "a.obj": [
        ("", "points, found none"),
        ("v 1 2\n", "after 'v' in line 1"),
        ("v 1 2 x\n", "after 'v' in line 1"),
        ("v 1 2 inf\n", "finite"),
        (obj() + "f 1 2 9\n", "corners from 0 to 7"),
        (obj() + "f 0 1 2\n", "corners from 0 to 7"),
        (obj() + "f 1 2 -9\n", "corners from 0 to 7"),
        (obj() + "f a b c\n", "after 'f' in line 15"),
    ],
    "a.stl": [
        (b"", "'solid' and facets"),
        ("solid of no format whatever", "three corners|points, found none"),
        (stl_binary()[:-1], "12 triangles as its header says"),
        (stl_text().replace("    vertex 0 0 0\n", "", 1), "three corners of each facet"),
        (stl_text().replace("vertex 0 0 0", "vertex 0 a 0", 1), "three numbers after"),
        ("solid\nendsolid\n", "points, found none"),
    ],
    "a.off": [
        (off_binary()[:-1], "points and faces that the counts"),
        (off_binary() + b"\0", "points and faces that the counts"),
        (off_binary(faces=[[0, 1, 8]]), "corners from 0 to 7"),
        (off_binary(points=POINTS + np.inf), "finite numbers"),
    ],
    "a.dae": [
        ("", "COLLADA meshes in 'a.dae', found 'no element found"),
        ("<svg/>", "found 'no <scene/instance_visual_scene> in <svg>'; save it again"),
        (dae().replace("url='#here'", ""), "found 'url='' in <instance_visual_scene>, which"),
        (dae().replace("#g'", "#h'"), "'url='#h' in <instance_geometry>, which names nothing'"),
        (dae().replace("POSITION", "PLACE"), "no <vertices/input.*POSITION.*> in <mesh>"),
        (dae().replace("count='8'", "count='9'"), "cannot reshape array"),
        (dae().replace("stride='4'", "stride='2'"), "out of bounds"),
        (dae().replace("7 0 0 0", "7 0 x 0"), "could not convert string to float: 'x'"),
        (dae().replace("7 0 0 0", "7 0 INF 0"), "finite numbers in 'a.dae'"),
        (dae(group(faces=[[0, 1, 8]])), "the corner 8 of 8 points"),
        (dae(group(faces=[[0, 1, -1]])), "the corner -1 of 8 points"),
        (dae().replace("<vcount>4", "<vcount>5"), "24 numbers of 25 corners in <polylist>"),
        (dae(group("triangles", QUADS[:2])), "8 numbers of 6 corners in <triangles>"),
        (dae(group("tristrips", TRIANGLES)), "<tristrips> that are strips"),
        (dae("<polygons><ph/></polygons>"), "<polygons> that are strips, fans or have holes"),
        (dae(scene=f"<node><skew>1 0 0 0 1 0 0</skew>{MESH}</node>"), "<skew> around a mesh"),
        (dae(scene=f"<node><rotate>1 0 0</rotate>{MESH}</node>"), "out of bounds"),
        (dae(scene="<node><instance_controller/></node>"), "<instance_controller>"),
        (dae(scene="<node/>"), "0 meshes with polygons"),
        (dae(scene="<instance_node url='#n'/>", node="<instance_node url='#n'/>"), "recursion"),
        (dae(asset="<unit meter='0'/>"), "1 meshes with polygons, in a unit of 0 metres"),
        (dae(asset="<unit meter='1 m'/>"), "could not convert string to float: '1 m'"),
    ],
    "a.npy": [
        (b"", "arrays of NumPy"),
        (npy(POINTS)[:-1], "arrays of NumPy"),
        (npy(POINTS[:, :2]), r"\(n, 3\) or \(n, 6\)"),
        (npy(np.array([object()])), "arrays of NumPy"),
        (npy(POINTS + np.inf), "finite"),
    ],
    "a.npz": [
        (npz(points=POINTS)[:-30], "arrays of NumPy"),
        (npz(vertices=POINTS), "array 'points'"),
        (npz(points=POINTS, triangles=QUADS), r"triangles \(n, 3\)"),
        (npz(points=POINTS, triangles=POINTS), r"triangles \(n, 3\)"),
        (npz(points=POINTS, normals=NORMALS[:5]), "as many normals"),
        (npy(POINTS), "single array"),
    ],
}


@pytest.mark.parametrize(
    "name, content, words", [(name, *case) for name in REFUSED for case in REFUSED[name]]
)
def test_what_is_refused(refuse, name, content, words):
    refuse(name, content, words)
