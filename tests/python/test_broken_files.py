# SPDX-License-Identifier: GPL-3.0-or-later
"""Broken files are read or refused in one sentence; nothing else, whatever is wrong with them."""

import warnings

import numpy as np
import pytest
from medial_axis.core.errors import MedialAxisError, OutOfMemoryError, ReadError
from medial_axis.core.files.read import READERS, import_points
from medial_axis.core.files.read_shape import read_shape
from test_import_meshes import (
    MIXED,
    NORMALS,
    ORDERS,
    POINTS,
    npy,
    npz,
    obj,
    off_binary,
    ply,
    stl_binary,
    stl_text,
)

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle

OFF = "OFF\n8 2 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in POINTS) + "4 0 1 3 2\n3 0 4 1\n"
GOOD = {
    "a.off": OFF,
    "n.off": OFF.replace("OFF", "NOFF").replace("\n1", "\n1"),
    "a.obj": obj(),
    "a.stl": stl_text(),
    "b.stl": stl_binary(),
    "a.npy": npy(POINTS),
    "a.npz": npz(points=POINTS, normals=NORMALS),
    "b.off": off_binary(),
    **{f"{kind}.ply": ply(kind, MIXED, NORMALS, extra=True) for kind in ORDERS},
    "a.xyz": "".join(f"{x} {y} {z}\n" for x, y, z in POINTS),
    "a.xyzn": "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in POINTS),
}
GOOD = {name: x.encode() if isinstance(x, str) else x for name, x in GOOD.items()}
WORDS = [
    b"99999999999999999999",
    b"-1",
    b"1e999",
    b"nan",
    b"\0",
    b"\xff\xfe",
    b"",
    b"0x1p9",
    b"list",
]


def mutated(data, random):
    """A few bytes, words, lines or pieces changed, doubled or left out."""
    for _ in range(random.integers(1, 4)):
        kind, at = random.integers(0, 6), int(random.integers(0, max(1, len(data))))
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
            random.shuffle(lines[:20])
            del lines[int(random.integers(0, len(lines)))]
            data = b"\n".join(lines)
        else:
            data = data[:at] + data[at + int(random.integers(0, 40)) :]
    return data


def test_every_kind_is_broken():
    assert {"." + name.partition(".")[2] for name in GOOD} == set(READERS)


@pytest.mark.parametrize("seed", repeats(40))
def test_fuzzed_files(tmp_path, seed):
    random = np.random.default_rng([seed, 18])
    names = sorted(GOOD)
    refused = 0
    for _ in range(50):
        name = names[random.integers(0, len(names))]
        path = tmp_path / name
        path.write_bytes(mutated(GOOD[name], random))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                shape, _ = read_shape(path)
        except MedialAxisError as error:
            assert isinstance(error, (ReadError, OutOfMemoryError))
            assert str(error).startswith("Expected ") and "\n" not in str(error)
            refused += 1
        else:
            assert np.isfinite(shape.points).all() and len(shape.points)
            assert shape.triangles.size == 0 or shape.triangles.max() < len(shape.points)
            assert shape.triangles.size == 0 or shape.triangles.min() >= 0
    assert 0 < refused < 50


def test_stl_that_begins_like_text_and_is_binary(tmp_path):
    (tmp_path / "a.stl").write_bytes(stl_binary(b"solid by hand") + b"\0\0")
    found = import_points(tmp_path / "a.stl")
    assert found.faces == 12 and found.warnings == ("Left out 2 bytes after the triangles",)


def test_stl_behind_a_blank_line(tmp_path):
    (tmp_path / "a.stl").write_text("\n" + stl_text())
    assert import_points(tmp_path / "a.stl").faces == 12


def test_a_folder_is_called_by_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ReadError, match=r"found '\.'"):
        import_points(".")
