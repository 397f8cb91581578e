# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of reading `.xyz`, `.xyzn` and `.off` files, and of the errors for wrong ones."""

import re

import numpy as np
import pytest
from medial_axis.core.errors import ReadError
from medial_axis.core.files.read import import_points
from medial_axis.core.files.rounding import rounding_warning
from medial_axis.core.files.write import export_axis
from test_export import AXES

THREE = np.array([[0.1, -2.5e3, 3.0], [4.0, 5.0, -6.25], [7.0, 8.0, 9.0]])
NORMALS = np.array([[1.0, 0.0, 0.0], [0.0, -0.6, 0.8], [0.0, 0.0, 1.0]])


@pytest.fixture
def read(tmp_path):
    """(name, bytes or text) -> what is read of a file with that content."""

    def read_content(name, content):
        path = tmp_path / name
        path.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)
        return import_points(path)

    return read_content


def refusal(read, name, content, words):
    """The one sentence, with these words, in which the file is refused."""
    with pytest.raises(ReadError, match=words) as error:
        read(name, content)
    text = str(error.value)
    assert "\n" not in text and ". " not in text and not text.endswith(".")
    assert text.startswith("Expected ")
    return text


@pytest.fixture
def refuse(read):
    def check(*file_and_words):
        text = refusal(read, *file_and_words)
        assert ", found " in text and "; " in text

    return check


def rows(*tables, mark=" "):
    """Text of tables side by side, 17 digits."""
    table = np.column_stack(tables)
    return "".join(mark.join(f"{x:.17g}" for x in row) + "\n" for row in table.tolist())


def assert_points(found, points=THREE, normals=None):
    assert np.array_equal(found.vertices, points) and found.vertices.dtype == np.float64
    assert (found.normals is None) == (normals is None)
    assert normals is None or np.array_equal(found.normals, normals)


# --- .xyz and .xyzn


TEXT, LINES = rows(THREE).encode(), rows(THREE).splitlines(keepends=True)
TITLES = [
    "{0}{1}{2}",
    "3\n{0}{1}{2}",
    "3\n\n{0}{1}{2}",
    "3\ntaken 24 May, 12.5 metres\n{0}{1}{2}",
    "3\n//X Y Z\n{0}{1}{2}",
    "X Y Z\n{0}{1}{2}",
    "x,y,z\n{0}{1}{2}",
    "# points\n\n{0}# more 1 2 3\n{1}\n \t \n//\n{2}\n\n",
    "  {0}  {1}\t{2}",
]
SAME = {
    **{
        f"separator {mark!r}, line end {end!r}": rows(THREE, mark=mark).replace("\n", end)
        for mark in (" ", "\t", "  \t ", ",", ", ", " , ", ";", "; ", ";\t")
        for end in ("\n", "\r\n", "\r")
    },
    **{f"title {text!r}": text.format(*LINES) for text in TITLES},
    "byte order mark": b"\xef\xbb\xbf" + TEXT,
    "Latin-1": "# caf\xe9, 20 \xb0C\n".encode("latin-1") + TEXT,
    "UTF-8": "# café, 20 °C\n".encode() + TEXT,
    "no last line end": TEXT.rstrip(),
    "any byte": TEXT.replace(b"\n", b" # \xff\x00\x85\n"),
    "capital E": TEXT.replace(b"e", b"E"),
    "trailing separators": rows(THREE, mark=",").replace("\n", ", \n"),
}


@pytest.mark.parametrize("content", SAME.values(), ids=SAME)
def test_what_means_the_same_points(read, content):
    found = read("a.xyz", content)
    assert_points(found)
    assert found.faces == 0 and found.warnings == ()


def test_every_number_is_the_nearest_float64(read):
    points = np.random.default_rng(1).normal(size=(500, 3)) * 10.0 ** np.arange(-300, 200)[:, None]
    assert_points(read("a.xyz", rows(points)), points)


LEFT = "Left out {} of {} columns: only positions and normals are read"
UNLIKE = "Left out 3 of 6 columns: .*\\.xyzn.*"
COLUMNS = {  # the name, the columns after x y z, the normals among them, and the warning
    "long": ("a.xyzn", [3 * NORMALS], 3 * NORMALS, None),
    "zero": ("a.XYZN", [0 * NORMALS], 0 * NORMALS, None),
    "like normals": ("a.xyz", [NORMALS.round(2)], NORMALS.round(2), None),
    "one without": ("a.xyz", [NORMALS * [[1], [1], [0]]], NORMALS * [[1], [1], [0]], None),
    "bytes": ("a.xyz", [[[255, 128, 0], [0, 0, 255], [12, 13, 14]]], None, UNLIKE),
    "pure colours": ("a.xyz", [[[1, 0, 0], [1, 0, 0], [0, 0, 1]]], None, UNLIKE),  # of length 1
    "too long": ("a.xyz", [2 * NORMALS], None, UNLIKE),
    "all zero": ("a.xyz", [0 * NORMALS], None, UNLIKE),
    "one": ("a.xyz", [[1, 2, 3]], None, LEFT.format(1, 4)),
    "two": ("a.xyz", [[[1, 2], [1, 2], [1, 2]]], None, LEFT.format(2, 5)),
    "after": ("a.xyz", [NORMALS, [[7, 8], [9, 10], [11, 12]]], NORMALS, LEFT.format(2, 8)),
    "after .xyzn": ("a.xyzn", [NORMALS, [[7, 8], [9, 10], [11, 12]]], NORMALS, LEFT.format(2, 8)),
}


@pytest.mark.parametrize("name, columns, normals, warning", COLUMNS.values(), ids=COLUMNS)
def test_columns_after_points(read, name, columns, normals, warning):
    found = read(name, rows(THREE, *columns))
    assert_points(found, normals=normals)
    assert len(found.warnings) == (warning is not None)
    assert warning is None or re.fullmatch(warning, *found.warnings)


XYZ_REFUSED = {
    "empty": ("", "Expected points, found none in 'a.xyz'"),
    "comments alone": ("# nothing\n\n// here\n", "Expected points, found none"),
    "title alone": ("x y z\n", "Expected points, found none"),
    "count alone": ("0\n", "Expected points, found none"),
    "two columns": ("1 2\n3 4\n", "x y z, at least 3 numbers, in line 1 of 'a.xyz', found 2"),
    "other columns": ("\n1 2 3\n#\n4 5 6\n\n7 8\n", "3 numbers in line 6 .* line 2, found 2"),
    "a word": ("1 2 3\n\n4 five 6\n", "finite numbers in line 3 of 'a.xyz', found 'five'"),
    "no title": ("a 2 3\n4 5 6\n", "finite numbers in line 1 of 'a.xyz', found 'a'"),
    "elements": ("2\nwater\nO 0 0 0\nH 1 0 0\n", "finite numbers in line 3 .*found 'O'"),
    "NaN": ("1 2 3\n4 nan 6\n", "finite numbers in line 2 of 'a.xyz', found 'nan'"),
    "NaN at once": ("nan nan nan\n4 5 6\n", "finite numbers in line 1 of 'a.xyz', found 'nan'"),
    "infinity": ("1 2 -Inf\n", "line 1 of 'a.xyz', found '-Inf'"),
    "too large": ("1 2 1e400\n", "line 1 of 'a.xyz', found '1e400'"),
    "underscore": ("1 2 3\n1_0 2 3\n", "line 2 of 'a.xyz', found '1_0'"),
    "binary": (bytes(range(256)) * 4, "Expected text in 'a.xyz', found a binary"),
    "UTF-16": ("1 2 3\n4 5 6\n".encode("utf-16"), "Expected text in 'a.xyz', .* UTF-16"),
    "long word": ("1 2 " + "x" * 10000, "found 'x{24}'\\.\\.\\."),
    "truncated": ("4\n1 2 3\n4 5 6\n", "Expected 4 points, .* first line, found 2"),
    "more than counted": ("1\n1 2 3\n4 5 6\n", "Expected 1 points, .* found 2"),
    "huge count": ("999999999999999999\n1 2 3\n", "Expected 999999999999999999 points, .* found 1"),
    "decimal commas": ("1,5 2,5 3,5\n", "between each two ',' in line 1 of 'a.xyz'"),
    "decimal commas, semicolons": ("1,5;2,5;3,5\n", "line 1 of 'a.xyz', found '1,5'"),
    "decimal commas later": ("1 2 3\n1,5 2 3\n", "line 2 of 'a.xyz', found '1,5'"),
    "empty field": ("1,2,3\n\n1,,2,3\n", "between each two ',' in line 3 of 'a.xyz'"),
    "first field empty": ("1,2,3\n ,1,2\n", "between each two ',' in line 2 of 'a.xyz'"),
    "blanks among commas": ("1,2,3\n1 2,3,\n", "between each two ',' in line 2 of 'a.xyz'"),
    "one line": ("1 2 3 " * 5 + "\n1 2 3\n", "Expected 15 numbers in line 2 .*found 3"),
}


@pytest.mark.parametrize("name", ["a.xyz", "a.off"])
@pytest.mark.parametrize("huge", [2.0, 1e154, 1e155, 1e200, 1e308])
@pytest.mark.filterwarnings("error")
def test_columns_of_any_size_that_are_no_normals(read, refuse, name, huge):
    """The square of such a number is none, and no warning of NumPy says so."""
    columns = NORMALS * [[1], [1], [huge]]
    if name == "a.xyz":
        assert_points(read(name, rows(THREE, columns)))
        return
    colours = np.full((3, 4), 255)
    refuse(name, "NCOFF\n3 0 0\n" + rows(THREE, columns, colours), "Expected normals of length 1")


# --- .off

CUBE = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]) + 1 / 3
QUADS = ["4 0 1 3 2", "4 4 6 7 5", "4 0 4 5 1", "4 2 3 7 6", "4 0 2 6 4", "4 1 5 7 3"]
CORNERS = [[int(word) for word in quad.split()[1:]] for quad in QUADS]
OUTWARD = (CUBE - CUBE.mean(axis=0)) / np.linalg.norm(CUBE - CUBE.mean(axis=0), axis=1)[:, None]
BYTES = np.array([[255, 0, i, 255] for i in range(8)])


def off(*tables, header="OFF\n8 6 12\n", faces=QUADS):
    return header + rows(CUBE, *tables) + "".join(f"{face}\n" for face in faces)


def assert_cube(found, normals=None):
    assert_points(found, CUBE, normals)
    assert found.face_offsets.tolist() == list(range(0, 25, 4))
    assert found.face_vertices.tolist() == np.concatenate(CORNERS).tolist()
    assert found.face_offsets.dtype == found.face_vertices.dtype == np.int32


HEADERS = [
    "OFF\n8 6 12\n",
    "OFF 8 6 12\n",
    "OFF\n8 6\n",
    "# a\n\nOFF # b\n# c\n8 6 0 # d\n\n",
    "OFF\t8 6 0\n",
]
COLOURED = ("COFF", "STOFF", "OFF", "STCOFF")
BESIDE = [([OUTWARD, BYTES], 4), ([BYTES, OUTWARD], 4), ([BYTES[:, :3], OUTWARD], 3)]
OFF_SAME = {  # the header, columns after x y z, the normals among them, and how many are left
    **{f"header {text!r}": (text, [], None, None) for text in HEADERS},
    "NOFF": ("NOFF 8 6 0\n", [OUTWARD], OUTWARD, None),
    "NOFF long": ("NOFF 8 6 0\n", [5 * OUTWARD], 5 * OUTWARD, None),
    **{f"{word} colours": (f"{word} 8 6 0\n", [BYTES], None, (4, 7)) for word in COLOURED},
    **{  # Geomview writes normals first, MeshLab last
        f"{word} {number}": (f"{word} 8 6 0\n", columns, OUTWARD, (left, left + 6))
        for word in ("CNOFF", "NCOFF", "STCNOFF")
        for number, (columns, left) in enumerate(BESIDE)
    },
}


@pytest.mark.parametrize("header, columns, normals, left", OFF_SAME.values(), ids=OFF_SAME)
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["LF", "CRLF"])
def test_off_means_the_cube(read, header, columns, normals, left, end):
    found = read("a.off", off(*columns, header=header).replace("\n", end))
    assert_cube(found, normals)
    assert found.warnings == (() if left is None else (LEFT.format(*left),))


def test_off_colours_of_faces_are_left(read):
    faces = [f"{quad} {i} 0.5 1e-3" for i, quad in enumerate(QUADS)]
    assert_cube(read("a.off", off(faces=faces)))


def test_off_polygons_of_any_size(read):
    faces = ["3 0 1 2", "8 0 1 2 3 4 5 6 7", "5 7 6 5 4 3", "2 0 1", "1 3", "0", "4 1 2 3 4"]
    found = read("a.off", off(header="OFF 8 7 0\n", faces=faces))
    assert found.face_offsets.tolist() == [0, 3, 11, 16, 20]
    assert found.face_vertices.tolist() == [0, 1, 2, *range(8), 7, 6, 5, 4, 3, 1, 2, 3, 4]
    assert found.warnings == ("Left out faces of fewer than three corners: 3",)


def with_line(line, new):
    """The cube with one of its lines, counted from 1, replaced."""
    lines = off().splitlines()
    lines[line - 1] = new
    return "\n".join(lines)


TORN = b"OFF BINARY\n\x00\x00\x00\x08"
OFF_REFUSED = {
    "empty": ("", "Expected OFF, .* in line 1 of 'a.off', found ''"),
    "another keyword": ("PLY\n1 2 3\n", "Expected OFF, .* in line 1 of 'a.off', found 'PLY'"),
    "four dimensions": ("4OFF\n1 0 0\n1 2 3 4\n", "three dimensions|found '4OFF'"),
    "any dimension": ("nOFF\n3\n1 0 0\n1 2 3\n", "found 'nOFF'"),
    "binary": (TORN, "points and faces that the counts in 'a.off' announce, found 4"),
    "keyword alone": ("OFF\n", "numbers of points, faces and edges in line 1 of 'a.off', found ''"),
    "one count": ("OFF\n8\n", "numbers of points, faces and edges in line 2 of 'a.off', found '8'"),
    "negative count": ("OFF\n-8 6 0\n", "numbers of points, .* found '-8 6 0'"),
    "counts not whole": ("OFF\n8.0 6 0\n", "numbers of points, .* found '8.0 6 0'"),
    "no points": ("OFF\n0 0 0\n", "Expected points, found none in 'a.off'"),
    "huge counts": ("OFF\n999999999999999999 9 0\n1 2 3\n", "999999999999999999 lines .* found 1 "),
    "absurd counts": (f"OFF\n{'9' * 5000} 9 0\n1 2 3\n", "numbers of points, .* found '9{24}'"),
    "truncated": (off(faces=QUADS[:2]), "8 lines of points and 6 of faces .* found 10"),
    "cut in a line": (off()[:-4], "as many corners in line 16 of 'a.off', found 4 and 2"),
    "too long": (off() + "3 0 1 2\n", "8 lines of points and 6 of faces .* found 15"),
    "two numbers": (with_line(5, "1 2"), "3 numbers in line 5 of 'a.off', .* found 2"),
    "a word": (with_line(5, "1 2 x"), "finite numbers in line 5 of 'a.off', found 'x'"),
    "NaN": (with_line(5, "1 2 NaN"), "finite numbers in line 5 of 'a.off', found 'NaN'"),
    "corner too large": (with_line(12, "4 0 1 8 2"), "0 to 7 in line 12 of 'a.off', found 8"),
    "corner negative": (with_line(12, "4 0 -1 3 2"), "0 to 7 in line 12 .* found -1"),
    "corner not whole": (with_line(12, "4 0 1.5 3 2"), "0 to 7 in line 12 .* found 1.5"),
    "corner huge": (with_line(12, "4 0 1e300 3 2"), "0 to 7 in line 12 .* found 1"),
    "size huge": (with_line(12, "1e300 0 1 3 2"), "corners in line 12 .* found 1.*e\\+300 and 4"),
    "size negative": (with_line(12, "-3 0 1 3"), "corners in line 12 .* found -3 and 3"),
    "size not whole": (with_line(12, "3.5 0 1 3 2"), "corners in line 12 .* found 3.5 and 4"),
    "commas": (with_line(5, "1,2,3"), "finite numbers in line 5 of 'a.off', found '1,2,3'"),
    "NOFF without normals": (off(header="NOFF 8 6 0\n"), "x y z nx ny nz, .* in line 2 .* found 3"),
    "CNOFF without normals": (off(BYTES, header="CNOFF 8 6 0\n"), "Expected normals of length 1"),
}


WITHOUT = "x y z nx ny nz, at least 6 numbers, in line 1 .* found 3"
REFUSED = {
    **{f".xyz {what}": ("a.xyz", *case) for what, case in XYZ_REFUSED.items()},
    **{f".off {what}": ("a.off", *case) for what, case in OFF_REFUSED.items()},
    ".xyzn without normals": ("a.xyzn", rows(THREE), WITHOUT),
    "extension": ("a.blend", "BLENDER", r"\.xyz, \.xyzn, \.off, .*\.npz, found 'a\.blend'"),
}


@pytest.mark.parametrize("name, content, words", REFUSED.values(), ids=REFUSED)
def test_what_is_refused(refuse, name, content, words):
    refuse(name, content, words)


@pytest.mark.parametrize("name", ["sheets", "grid"])
def test_our_own_off_comes_back(name, tmp_path):
    found = import_points(export_axis(AXES[name], tmp_path / "a.off"))
    for field in ("vertices", "face_offsets", "face_vertices"):
        assert np.array_equal(getattr(found, field), getattr(AXES[name], field)), field


# --- files


def test_no_file(tmp_path):
    for path in (tmp_path / "none.xyz", tmp_path):
        with pytest.raises(ReadError, match="Expected .*, found .*; choose another"):
            import_points(path)
    (tmp_path / "folder.xyz").mkdir()
    with pytest.raises(ReadError, match="Expected a file, found none at"):
        import_points(tmp_path / "folder.xyz")


def test_system_refuses(tmp_path, monkeypatch):
    def refuse(*_arguments, **_options):
        raise PermissionError(13, "Permission denied")

    (tmp_path / "a.xyz").write_text("1 2 3\n")
    monkeypatch.setattr("builtins.open", refuse)
    with pytest.raises(ReadError, match="Expected to read '.*a.xyz', .* 'Permission denied'"):
        import_points(tmp_path / "a.xyz")


def test_reading_does_not_change_the_file(tmp_path, read):
    read("a.off", off())
    assert (tmp_path / "a.off").read_text() == off()


# --- what is kept in 32 bits


def grid(step, offset):
    return np.stack(np.meshgrid(*[np.arange(20)] * 3), axis=-1).reshape(-1, 3) * step + offset


@pytest.mark.parametrize(
    "points",
    [
        grid(0.1, 0.0), grid(0.1, 1000.0), grid(1.0, 5e5), grid(1e-9, 0.0), grid(1e30, 0.0),
        np.full((5, 3), 0.1), grid(0.1, 0.0)[:1],
    ],
    ids=["at home", "not far", "whole numbers", "tiny", "huge", "one place", "one point"],
)  # fmt: skip
def test_float32_is_enough(points):
    assert rounding_warning(points) is None


@pytest.mark.parametrize("step, offset, lie", [(0.1, 5e5, "0.1"), (1e-3, 1e4, "0.001")])
def test_float32_is_too_little(step, offset, lie):
    text = rounding_warning(grid(step, offset))
    assert f"while neighbours lie {lie} apart; subtract a common offset" in text
    moved = float(text.split("up to ")[1].split()[0])
    assert 0.05 * step < moved <= 2 * np.spacing(np.float32(offset))
