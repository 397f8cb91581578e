# SPDX-License-Identifier: GPL-3.0-or-later
"""Broken files are read or refused in one sentence; nothing else, whatever is wrong with them."""

import warnings

import numpy as np
import pytest
import test_import_meshes as cubes
from medial_axis.core.errors import MedialAxisError, OutOfMemoryError, ReadError
from medial_axis.core.files.read import READERS, import_points
from medial_axis.core.files.read_shape import read_shape
from test_import import BYTES, NORMALS, OUTWARD, THREE, off, rows

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle

OFF = (
    "OFF\n8 2 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in cubes.POINTS) + "4 0 1 3 2\n3 0 4 1\n"
)
GOOD = {
    "a.off": OFF,
    "n.off": OFF.replace("OFF", "NOFF").replace("\n1", "\n1"),
    "a.obj": cubes.obj(),
    "a.stl": cubes.stl_text(),
    "b.stl": cubes.stl_binary(),
    "a.dae": cubes.dae(scene=f"<node>{cubes.QUARTER}{cubes.AWAY}{cubes.MESH}</node>"),
    "a.npy": cubes.npy(cubes.POINTS),
    "a.npz": cubes.npz(points=cubes.POINTS, normals=cubes.NORMALS),
    "b.off": cubes.off_binary(),
    **{
        f"{kind}.ply": cubes.ply(kind, cubes.MIXED, cubes.NORMALS, extra=True)
        for kind in cubes.ORDERS
    },
    "a.xyz": "".join(f"{x} {y} {z}\n" for x, y, z in cubes.POINTS),
    "a.xyzn": "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in cubes.POINTS),
    "b.xyz": "3\ntitle\n" + rows(THREE),
    "c.xyz": rows(THREE, NORMALS, mark=","),
    "b.xyzn": rows(THREE, NORMALS, mark="; "),
    "c.off": off(OUTWARD, BYTES, header="# f\nCNOFF\n8 6 12\n"),
}
GOOD = {name: x.encode() if isinstance(x, str) else x for name, x in GOOD.items()}
WORDS = [
    b"99999999999999999999", b"-1", b"1e999", b"nan", b"\0", b"\xff\xfe", b"", b"0x1p9", b"list",
]  # fmt: skip


def mutated(data, random):
    """A few bytes, words, lines or pieces changed, doubled or left out."""
    for _ in range(random.integers(1, 4)):
        kind, at = random.integers(0, 8), int(random.integers(0, max(1, len(data))))
        if kind == 0:
            data = data[:at] + bytes(random.integers(0, 256, 1, np.uint8)) + data[at + 1 :]
        elif kind == 1:
            data = data[:at]
        elif kind == 2:
            stop = at + int(random.integers(0, 40))
            data = data[:stop] + data[at:]
        elif kind == 3:
            words = data.split(b" ")
            words[int(random.integers(0, len(words)))] = WORDS[random.integers(0, len(WORDS))]
            data = b" ".join(words)
        elif kind == 4:
            lines = data.split(b"\n")
            lines[:20] = random.permutation(np.array(lines[:20], object)).tolist()
            del lines[int(random.integers(0, len(lines)))]
            data = b"\n".join(lines)
        elif kind < 7:  # some bytes become any others, or such as numbers have
            some = np.arange(256) if kind == 5 else list(b"0123456789 .-e\n,;#/")
            stop = min(len(data), at + int(random.integers(0, 20)))
            data = data[:at] + bytes(random.choice(some, stop - at).tolist()) + data[stop:]
        else:
            data = data[:at] + data[at + int(random.integers(0, 40)) :]
    return data


def test_every_kind_is_broken():
    assert {"." + name.partition(".")[2] for name in GOOD} == set(READERS)


@pytest.mark.parametrize("seed", repeats(40))
def test_fuzzed_files(tmp_path, seed):
    """Every result satisfies the promises of ImportedPoints and Shape; the only exceptions are our errors."""
    random = np.random.default_rng([seed, 18])
    names = sorted(GOOD)
    refused = 0
    for _ in range(200):
        name = names[random.integers(0, len(names))]
        path = tmp_path / name
        path.write_bytes(mutated(GOOD[name], random))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                found, (shape, _) = import_points(path), read_shape(path)
        except MedialAxisError as error:
            assert isinstance(error, (ReadError, OutOfMemoryError))
            assert str(error).startswith("Expected ") and "\n" not in str(error)
            refused += 1
            continue
        assert found.vertices.shape == (len(found.vertices), 3) and len(found.vertices)
        assert np.isfinite(found.vertices).all() and np.isfinite(shape.points).all()
        if found.normals is not None:
            assert found.normals.shape == found.vertices.shape and np.isfinite(found.normals).all()
        assert found.face_offsets[0] == 0 and found.face_offsets[-1] == len(found.face_vertices)
        assert (np.diff(found.face_offsets) >= 3).all()
        for corners in (found.face_vertices, shape.triangles):
            assert ((corners >= 0) & (corners < len(found.vertices))).all()
    assert 0 < refused < 200


@pytest.mark.parametrize(
    "content, warnings",
    [
        (cubes.stl_binary(b"solid by hand") + b"\0\0", ("Left out 2 bytes after the triangles",)),
        (b"\n" + cubes.stl_text().encode(), ()),
    ],
    ids=["binary, begins like text", "behind a blank line"],
)
def test_stl_of_unusual_beginnings(tmp_path, content, warnings):
    (tmp_path / "a.stl").write_bytes(content)
    found = import_points(tmp_path / "a.stl")
    assert found.faces == 12 and found.warnings == warnings


def test_a_folder_is_called_by_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ReadError, match=r"found '\.'"):
        import_points(".")
