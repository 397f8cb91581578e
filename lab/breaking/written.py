# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials of what we write: axes, skeletons and balls, read again by us and by others; full disks."""

import csv
import json
import re
import resource
import signal
import warnings
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import replace
from io import StringIO
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from medial_axis import cli
from medial_axis.core.axis.compute import compute
from medial_axis.core.axis.medial_axis import LevelValues, MedialAxis
from medial_axis.core.axis.polygon_triangles import triangulate_facets
from medial_axis.core.cover.ball_cover import Balls
from medial_axis.core.cover.write_balls import export_balls
from medial_axis.core.errors import ExportError, MedialAxisError
from medial_axis.core.files.axis_arrays import as_arrays, exact_balls
from medial_axis.core.files.load_axis import load_axis
from medial_axis.core.files.read import import_points
from medial_axis.core.files.read_ma import read_ma
from medial_axis.core.files.write import export_axis
from medial_axis.core.settings import CoverMode
from medial_axis.core.skeleton.load_skeleton import load_skeleton
from medial_axis.core.skeleton.parts import Parts, Places
from medial_axis.core.skeleton.skeleton import Skeleton, skeleton_of
from medial_axis.core.skeleton.write_skeleton import export_skeleton
from support.readers import READERS, area_of

from .inside import Random, _damaged, _is_a_sentence, _mesh, _settings
from .outside import SUFFIXES, _run, _shapes

# --- axes


def axes(random: Random, folder: Path) -> None:
    """Every array that a format holds comes back bit for bit."""
    axis = _made_up(random)
    if random.random() < 0.3:
        try:
            axis = compute(*_damaged(*_mesh(random), random), _settings(random)).axis
        except MedialAxisError:
            return
    suffix, triangles = str(random.choice(SUFFIXES)), bool(random.integers(0, 2))
    path = folder / f"a{suffix}"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            export_axis(axis, path, triangles=triangles)
        except ExportError as error:
            _is_a_sentence(error)
            assert (
                triangles
                and axis.facets == 0
                and suffix in (".ply", ".off")
                and path_is_free(folder)
            )
            return
        _READ_AGAIN[suffix](axis, path, triangles)
    _others_agree(axis, path, triangles)


def path_is_free(folder: Path) -> bool:
    return not list(folder.iterdir())


def _numbers(random: Random, *shape: int) -> np.ndarray:
    """Some with few digits, some of every size of the documented range, signed zeros and denormal ones."""
    rows = random.normal(size=shape) * 10.0 ** random.choice([0, 0, random.uniform(-49, 48)])
    odd = random.random(shape) < random.choice([0, 0, 0.1])
    signs = random.choice([-1.0, 1.0], shape)
    rows[odd] = (signs * random.choice([0.0, 5e-324, 1e-310, 1 / 3, 1e49, 2.0**53], shape))[odd]
    return np.round(rows, 3) if random.random() < 0.1 else rows


def _made_up(random: Random) -> MedialAxis:
    """Arrays of the documented form and no other meaning."""
    points = int(random.integers(3, 400))
    faces = int(random.choice([0, 1, random.integers(0, 300)]))
    counts = random.integers(3, min(points, random.choice([4, 9, 400])) + 1, faces)
    corners = [random.choice(points, count, replace=False) for count in counts]
    some = random.integers(0, points, (int(random.choice([0, 1, random.integers(0, 50)])), 2))
    edges = np.unique(np.sort(some[some[:, 0] != some[:, 1]], axis=1), axis=0)
    axis = MedialAxis(
        vertices=_numbers(random, points, 3),
        radius=np.abs(_numbers(random, points)),
        face_offsets=np.cumsum([0, *counts]).astype(np.int32),
        face_vertices=np.concatenate([np.zeros(0, int), *corners]).astype(np.int32),
        theta=random.uniform(0, np.pi / 2, faces),
        rho=np.where(random.random(faces) < 0.1, np.inf, random.uniform(0, 50, faces)),
        side=random.integers(0, 4, faces).astype(np.int32),
        generators=random.integers(-1, 2**31 - 1, (faces, 2)).astype(np.int32),
        unbounded=int(random.integers(0, 2**31)),
        zero_area=int(random.integers(0, 9)),
        edges=edges.astype(np.int32),
    )
    if random.random() < 0.5:
        return axis
    floats = lambda count: random.choice([np.inf, 0.0, 1 / 3], count).astype(np.float32)
    level = LevelValues(
        exact=_numbers(random, points, 3),
        exact_radius=np.abs(_numbers(random, points)),
        sheet=floats(faces),
        erosion=floats(faces),
        limb=floats(len(edges)),
        betti=tuple(random.integers(0, 99, 3).tolist()),
        place=random.integers(0, 6, points).astype(np.int32),
    )
    return replace(axis, level=level)


def _same(found: np.ndarray, expected: np.ndarray) -> None:
    found, expected = np.asarray(found), np.asarray(expected)
    assert found.shape == expected.shape and found.dtype == expected.dtype, (found, expected)
    assert found.tobytes() == expected.tobytes(), "other bytes"


def _triangles(axis: MedialAxis, vertices: np.ndarray) -> np.ndarray:
    return triangulate_facets(vertices, axis.face_offsets, axis.face_vertices)


def _npz_again(axis: MedialAxis, path: Path, triangles: bool) -> None:
    if len(axis.vertices) == 0:
        return
    found, expected = as_arrays(load_axis(path)), as_arrays(axis)
    assert found.keys() == expected.keys()
    for name, array in expected.items():
        _same(found[name], array)


def _ma_again(axis: MedialAxis, path: Path, triangles: bool) -> None:
    found, (vertices, radius) = read_ma(path), exact_balls(axis)
    _same(found.vertices, vertices)
    _same(found.radius, radius)
    cut = _triangles(axis, vertices)
    _same(found.face_vertices, cut.reshape(-1))
    sides = np.sort(cut[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    alone = {tuple(sorted(ends)) for ends in axis.edges.tolist()} - set(map(tuple, sides.tolist()))
    assert set(map(tuple, found.edges.tolist())) == alone and len(found.edges) == len(alone)


def _mesh_again(axis: MedialAxis, path: Path, triangles: bool) -> None:
    if len(axis.vertices) == 0:
        return
    found = import_points(path)
    _same(found.vertices, axis.vertices)
    offsets, corners = axis.face_offsets, axis.face_vertices
    if triangles:
        corners = _triangles(axis, axis.vertices).reshape(-1)
        offsets = np.arange(0, len(corners) + 1, 3, dtype=np.int32)
    _same(found.face_offsets, offsets)
    _same(found.face_vertices, corners)
    if path.suffix == ".obj":
        lines = [line.split()[1:] for line in path.read_text().splitlines() if line[0] == "l"]
        _same(np.array(lines, np.int32).reshape(-1, 2) - 1, axis.edges)


_READ_AGAIN = {
    ".npz": _npz_again,
    ".ma": _ma_again,
    ".ply": _mesh_again,
    ".obj": _mesh_again,
    ".off": _mesh_again,
}


def _others_agree(axis: MedialAxis, path: Path, triangles: bool) -> None:
    """Who is installed and reads triangles (docs/formats.md), on coordinates whose squares are numbers.

    Vertices that are of no facet some leave out.
    """
    of_one_size = np.abs(axis.vertices).max(initial=1.0) < 1e9
    used = len(np.unique(axis.face_vertices)) == len(axis.vertices)
    if not (triangles and of_one_size and axis.facets and used) or path.suffix not in (
        ".ply",
        ".obj",
        ".off",
    ):
        return
    cut = _triangles(axis, axis.vertices)
    area = area_of(axis.vertices, cut.tolist())
    for name, read in READERS.items():
        if name == "plyfile" and path.suffix != ".ply":
            continue
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            points, faces, found = read(path)
        assert points == len(axis.vertices), (name, path.suffix, points, len(axis.vertices))
        assert abs(found - area) <= 1e-4 * area, (name, path.suffix, found, area)
        assert faces == len(cut), (name, path.suffix, faces, len(cut))


# --- skeletons and balls


def _a_skeleton(random: Random) -> Skeleton:
    """Paths between few nodes, loops and parallel ones among them, and single points."""
    branches, count = [], int(random.integers(1, 8))
    points = count
    for _ in range(int(random.integers(0, 12))):
        inner = int(random.integers(2, 9))
        ends = random.integers(0, count, 2)
        branches.append(np.array([ends[0], *range(points, points + inner), ends[1]]))
        points += inner
    return skeleton_of(
        _numbers(random, points, 3), np.abs(_numbers(random, points)), branches, np.arange(count)
    )


def skeletons(random: Random, folder: Path) -> None:
    skeleton = _a_skeleton(random)
    faces = random.integers(-1, max(1, skeleton.count), int(random.integers(0, 40))).astype(
        np.int32
    )
    nowhere = Places(np.full(3, -1, np.int32), np.zeros(3))
    path = folder / str(random.choice(["a.json", "a.swc", "a.obj", "a.csv", "a.vtp"]))
    export_skeleton(skeleton, Parts(nowhere, faces), path)
    lines = [line.split() for line in path.read_text("ascii").splitlines()]
    if path.suffix == ".json":
        found = load_skeleton(path)
        for name in Skeleton.__dataclass_fields__:
            _same(getattr(found, name), getattr(skeleton, name))
        parts = json.loads(path.read_text())["parts"]
        assert [part["faces"] for part in parts] == [
            np.flatnonzero(faces == number).tolist() for number in range(skeleton.count)
        ]
    elif path.suffix == ".obj":
        _same(_table([words[1:] for words in lines if words[0] == "v"], 3), skeleton.points)
        runs = [[int(word) - 1 for word in words[1:]] for words in lines if words[0] == "l"]
        assert runs == [branch.tolist() for branch in skeleton.branches]
    elif path.suffix == ".csv":
        rows = list(csv.DictReader(path.read_text("ascii").splitlines()))
        assert [int(row["branch"]) for row in rows] == list(range(skeleton.count))
        ends = [[int(row[name]) for name in ("start", "end")] for row in rows]
        assert ends == [[int(branch[0]), int(branch[-1])] for branch in skeleton.branches]
    elif path.suffix == ".vtp":
        assert ElementTree.parse(path).getroot().get("type") == "PolyData"
    else:
        _is_swc(lines, skeleton)


def _table(rows: list[list[str]], width: int) -> np.ndarray:
    return np.array([[float(word) for word in row] for row in rows]).reshape(-1, width)


def _is_swc(lines: list[list[str]], skeleton: Skeleton) -> None:
    """Numbered from 1, parents first; the tree and the edges that close loops are all edges, by the same points."""
    rows = [words for words in lines if words[0] != "#"]
    assert [int(words[0]) for words in rows] == list(range(1, len(skeleton.points) + 1))
    parents = [int(words[6]) for words in rows]
    assert all(parent == -1 or 0 < parent <= row for row, parent in enumerate(parents))
    found = _table([words[2:6] for words in rows], 4)
    expected = np.column_stack((skeleton.points, skeleton.radius))
    _same(found[_order(found)], expected[_order(expected)])
    closing = re.findall(r"# closes a loop: (\d+) (\d+)", "\n".join(map(" ".join, lines)))
    pairs = [(row + 1, parent) for row, parent in enumerate(parents) if parent > 0]
    pairs += [(int(a), int(b)) for a, b in closing]
    lengths = lambda table, ends: np.sort(np.abs(table[ends[:, 0], 3] - table[ends[:, 1], 3]))
    _same(
        lengths(found, np.array(pairs, int).reshape(-1, 2) - 1),
        lengths(expected, skeleton.edges),
    )


def _order(table: np.ndarray) -> np.ndarray:
    return np.argsort([row.tobytes() for row in table], kind="stable")


def balls(random: Random, folder: Path) -> None:
    count = int(random.integers(0, 200))
    figures = [float("nan"), 0.0, 1 / 3, 1e49]
    made = Balls(
        centres=_numbers(random, count, 3),
        radii=np.abs(_numbers(random, count)),
        mode=list(CoverMode)[random.integers(0, len(CoverMode))],
        covered=float(random.choice(figures)),
        outside=float(random.choice(figures)),
        farthest=float(random.choice(figures)),
    )
    path = folder / str(random.choice(["a.ma", "a.json"]))
    export_balls(made, path)
    if path.suffix == ".ma":
        found = read_ma(path)
        _same(found.vertices, made.centres)
        _same(found.radius, made.radii)
        return
    said = json.loads(path.read_text("ascii"))
    _same(_lists([ball["centre"] for ball in said["balls"]], 3), made.centres)
    _same(np.array([ball["radius"] for ball in said["balls"]], float), made.radii)
    for name in ("covered", "outside", "farthest"):
        figure = getattr(made, name)
        assert said[name] == (None if np.isnan(figure) else figure), (name, said[name], figure)


def _lists(rows: list[list[float]], width: int) -> np.ndarray:
    return np.array(rows, float).reshape(-1, width)


# --- full disks

WORKS = {
    "axis": ([], [*SUFFIXES]),
    "skeleton": (["skeleton"], [".swc", ".obj", ".json", ".csv", ".vtp"]),
    "balls": (["balls"], [".ma", ".json"]),
    "thickness": (["thickness"], [".csv", ".json", ".ply"]),
}
ENDED = (cli.DONE, cli.UNMEASURED)  # exit codes with which the output is whole


def full_disks(random: Random, folder: Path) -> None:
    """No file can grow beyond so many bytes: all is there, or a sentence, the old file, and nothing half."""
    (name,) = _shapes(folder, random, 1, int(random.integers(50, 900)))
    words, suffixes = WORKS[str(random.choice(sorted(WORKS)))]
    output = f"a{random.choice(suffixes)}"
    room = int(10.0 ** random.uniform(0, 5.5))
    old = b"as it was" if random.random() < 0.5 else None
    if old is not None:
        (folder / output).write_bytes(old)

    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))

    code, _, err = _run(folder, *words, name, output, preexec_fn=limit)
    assert b"Traceback" not in err, err.decode(errors="replace")[-600:]
    ended = code in ENDED
    assert ended or code in (1, 3), (words, output, room, code, err)
    assert ended or (err.startswith(b"medial_axis: ") and err.count(b"\n") <= 2), err
    there = {path.name for path in folder.iterdir()} - {name}
    assert there <= {output, f"{output}.json"}, (there, err)
    kept = (folder / output).read_bytes() if output in there else None
    if ended or b"which is written" in err:  # but its report
        assert _run(folder, *words, name, f"whole-{output}")[0] in ENDED
        assert kept == (folder / f"whole-{output}").read_bytes(), (output, room, err)
    else:
        assert kept == old and f"{output}.json" not in there, (output, room, err)
