# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials in this process: whatever is read or computed is right in form, or refused by a documented error."""

import io
import re
import sys
import threading
import warnings
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "python")]

import conftest  # noqa: E402, F401 - registers the add-on's folder as medial_axis
from medial_axis import cli  # noqa: E402
from medial_axis.core.axis.compute import compute  # noqa: E402
from medial_axis.core.errors import MedialAxisError  # noqa: E402
from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.machine import native  # noqa: E402
from medial_axis.core.settings import OPTIONS, Settings  # noqa: E402
from support import meshes as shapes  # noqa: E402
from test_broken_files import GOOD, mutated  # noqa: E402

Random = np.random.Generator
TOKENS = b"nan inf -inf 1e308 -1e51 1e-320 0 -0 00 1_0 +5 2147483648 -2147483649 1,5 \xc2\xbd 0b1 1e 1d3 #".split()
ODD = [
    float("nan"),
    float("inf"),
    -float("inf"),
    1e308,
    -1e200,
    5e-324,
    -1.0,
    0.0,
    2**63,
    2**31,
    -(2**31),
]


def files(random: Random, folder: Path) -> None:
    """Other mutations than those of the tests; what is read is computed, too."""
    name = str(random.choice(sorted(GOOD)))
    data = GOOD[name]
    for _ in range(random.integers(1, 4)):
        data = [_other_token, _piece_twice, _piece_of_another, mutated][random.integers(0, 4)](
            data, random
        )
    if random.random() < 0.1:
        name = "a" + Path(str(random.choice(sorted(GOOD)))).suffix
    path = folder / name
    path.write_bytes(data)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            shape, _ = read_shape(path)
            found = compute(shape.points, shape.triangles, Settings(samples=200, budget=400))
    except MedialAxisError as error:
        _is_a_sentence(error)
    else:
        _is_an_axis(found.axis)


def _other_token(data: bytes, random: Random) -> bytes:
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?", data))
    if not numbers:
        return data
    one = numbers[random.integers(0, len(numbers))]
    return data[: one.start()] + TOKENS[random.integers(0, len(TOKENS))] + data[one.end() :]


def _piece_twice(data: bytes, random: Random) -> bytes:
    a, b = np.sort(random.integers(0, len(data) + 1, 2))
    at = random.integers(0, len(data) + 1)
    return data[:at] + data[a:b] * int(random.integers(1, 4)) + data[at:]


def _piece_of_another(data: bytes, random: Random) -> bytes:
    other = GOOD[str(random.choice(sorted(GOOD)))]
    a, b = np.sort(random.integers(0, len(other) + 1, 2))
    at = random.integers(0, len(data) + 1)
    return data[:at] + other[a:b] + data[at:]


# --- meshes and points


def _mesh(random: Random) -> tuple[np.ndarray, np.ndarray]:
    made = [
        lambda: shapes.icosphere(int(random.integers(0, 4))),
        lambda: shapes.box(
            tuple(random.integers(1, 7, 3).tolist()), tuple(10.0 ** random.uniform(-4, 1, 3))
        ),
        lambda: shapes.torus(
            around=int(random.integers(3, 40)), across=int(random.integers(3, 16))
        ),
        lambda: shapes.uv_sphere(int(random.integers(3, 24)), int(random.integers(3, 12))),
    ]
    points, triangles = made[random.integers(0, len(made))]()
    if random.random() < 0.3:
        other = made[random.integers(0, len(made))]()
        points, triangles = shapes.join(
            (points, triangles), (other[0] * random.uniform(0.1, 2), other[1])
        )
    return points.copy(), triangles.copy()


def _damaged(
    points: np.ndarray, triangles: np.ndarray, random: Random
) -> tuple[np.ndarray, np.ndarray]:
    for _ in range(random.integers(0, 5)):
        some = random.integers(0, len(triangles), max(1, len(triangles) // 10))
        rows = random.integers(0, len(points), max(1, len(points) // 10))
        kind = random.integers(0, 12)
        if kind == 0:
            triangles[some, 2] = triangles[some, 1]
        elif kind == 1:
            triangles = np.delete(triangles, some, axis=0) if len(triangles) > 20 else triangles
        elif kind == 2:
            triangles[some] = triangles[some][:, ::-1]
        elif kind == 3:
            triangles = np.concatenate((triangles, triangles[some], triangles[some][:, [1, 2, 0]]))
        elif kind == 4:
            points = np.concatenate(
                (points, random.normal(size=(7, 3)) * 10.0 ** random.uniform(-3, 3))
            )
        elif kind == 5:
            points[rows] = points[rows[0]]
        elif kind == 6:
            points[:, random.integers(0, 3)] *= 10.0 ** random.uniform(-9, 0)
        elif kind == 7:
            points *= 10.0 ** random.uniform(-49, 48)
        elif kind == 8:
            points += np.abs(points).max() * 10.0 ** random.uniform(0, 9) * random.normal(size=3)
        elif kind == 9:
            points = points.astype(np.float32).astype(float)
        elif kind == 10:
            step = np.abs(points).max() / random.integers(1, 30)
            points = np.round(points / max(step, 1e-300)) * step
        else:
            triangles = np.concatenate(
                (triangles, random.integers(0, len(points), (5, 3)).astype(np.int32))
            )
    return points, np.ascontiguousarray(triangles, np.int32)


def meshes(random: Random, folder: Path) -> None:
    points, triangles = _damaged(*_mesh(random), random)
    settings = _settings(random)
    try:
        if random.random() < 0.3:
            path = folder / "polygons.obj"
            path.write_text(_polygons(points, triangles, random))
            shape, _ = read_shape(path)
            points, triangles = shape.points, shape.triangles
        found = compute(points, triangles, settings)
    except MedialAxisError as error:
        _is_a_sentence(error)
    else:
        _is_an_axis(found.axis)
        assert all("\n" not in text for text in found.warnings)


def _settings(random: Random) -> Settings:
    def one_of(name):
        return random.choice(list(type(OPTIONS[name].default)))

    words = {"samples": int(random.integers(100, 900)), "budget": int(random.integers(100, 1500))}
    for name in ("form", "sampling", "side", "sides", "rule", "criteria"):
        if random.random() < 0.4:
            words[name] = list(type(OPTIONS[name].default))[
                random.integers(0, len(type(OPTIONS[name].default)))
            ]
    for name in ("limit_set", "smooth", "keep_vertices"):
        words[name] = bool(random.integers(0, 2))
    for name, top in (
        ("theta", 1.5),
        ("rho", 20.0),
        ("erode", 5.0),
        ("simplify", 5.0),
        ("limb", 9.0),
    ):
        if random.random() < 0.3:
            words[name] = float(random.uniform(0, top))
    return Settings(**words)


def _polygons(points: np.ndarray, triangles: np.ndarray, random: Random) -> str:
    """As text of an OBJ, some of the faces with corners that repeat, or of many corners anywhere."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    for face in (triangles + 1).tolist():
        if random.random() < 0.05:
            face = random.choice(face, int(random.integers(3, 9))).tolist()
        elif random.random() < 0.01:
            face = random.integers(1, len(points) + 1, int(random.integers(3, 60))).tolist()
        lines.append("f " + " ".join(map(str, face)))
    return "\n".join(lines)


def points(random: Random, folder: Path) -> None:
    """The same bytes whatever the threads; facets, levels and thickness right in form."""
    module, rows = native.load(), _points(random)
    options = {"bounding_sphere": bool(random.integers(0, 2))}
    if random.random() < 0.6:
        options["sides"] = module.SidesFrom.TIGHT_COCONE
    found = []
    for threads in (1, 2, 64):
        try:
            analysis = module.MedialAnalysis(rows, threads=threads, **options)
            parts = [analysis.theta.tobytes(), analysis.rho.tobytes()]
            mesh = analysis.extract(float(random.choice([0.0, 0.4])) if not found else 0.4, 8.0)
            mesh = analysis.extract(0.4, 8.0)
            _is_an_axis(mesh)
            parts += [mesh.vertices.tobytes(), mesh.face_vertices.tobytes(), mesh.radius.tobytes()]
            if (
                "sides" in options
                and analysis.tight_cocone.encloses
                and not options["bounding_sphere"]
            ):
                level = analysis.hierarchy().extract()
                assert np.isfinite(level.vertices).all() and (level.radius >= 0).all()
                parts += [level.vertices.tobytes(), level.wires.tobytes(), str(level.betti)]
                parts.append(analysis.thickness(mode=module.ThicknessMode.SCAN).values.tobytes())
        except (module.InvalidInputError, module.DegenerateInputError) as error:
            _is_a_sentence(error)
            parts = [str(error)]
        found.append(parts)
    assert found[0] == found[1] == found[2]


def _points(random: Random) -> np.ndarray:
    count = int(10.0 ** random.uniform(0.5, 3.2))
    kind = random.integers(0, 8)
    rows = random.normal(size=(count, 3))
    if kind == 1:
        rows /= np.linalg.norm(rows, axis=1)[:, None]
    elif kind == 2:
        rows = random.integers(0, int(random.integers(2, 9)), (count, 3)).astype(float)
    elif kind == 3:
        rows[:, 2] *= 10.0 ** random.uniform(-60, 0)
    elif kind == 4:
        rows = _damaged(*_mesh(random), random)[0]
    elif kind == 5:
        rows = np.concatenate((rows, rows[:5] + 1e-14, [[10.0 ** random.uniform(0, 45)] * 3]))
    elif kind == 6:
        rows = np.column_stack([np.cos(rows[:, 0]), np.sin(rows[:, 0]), rows[:, 1] > 0])
    elif kind == 7:
        rows = (rows / np.linalg.norm(rows, axis=1)[:, None]).astype(np.float32).astype(float)
    return rows * 10.0 ** random.choice([0, 0, random.uniform(-40, 40)])


def _is_an_axis(axis) -> None:
    vertices, offsets, corners = axis.vertices, axis.face_offsets, axis.face_vertices
    assert (
        np.isfinite(vertices).all() and np.isfinite(axis.radius).all() and (axis.radius >= 0).all()
    )
    assert offsets[0] == 0 and offsets[-1] == len(corners) and (np.diff(offsets) >= 3).all()
    assert len(corners) == 0 or (corners.min() >= 0 and corners.max() < len(vertices))
    face = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    assert len(np.unique(np.column_stack((face, corners)), axis=0)) == len(corners), (
        "corners repeat"
    )
    assert len(axis.theta) == len(axis.generators) == len(offsets) - 1
    assert not np.isnan(axis.theta).any() and not np.isnan(axis.rho).any()


def _is_a_sentence(error: Exception) -> None:
    assert str(error).startswith("Expected ") and "\n" not in str(error), str(error)


# --- arguments


def _calls() -> dict:
    module = native.load()
    ball, triangles = shapes.icosphere(1)
    normals, some = ball.copy(), np.full(len(ball), 0.5)
    mesh = {"vertices": ball, "triangles": triangles}
    analysis = lambda points, **rest: module.MedialAnalysis(points, **rest).extract()
    cocone = {"points": ball, "sides": module.SidesFrom.TIGHT_COCONE}
    return {
        "analysis": (analysis, {"points": ball, "triangles": triangles, "normals": normals}),
        "vertices": (analysis, {"points": 0.9 * ball, **mesh}),
        "tight": (module.TightCocone, {"points": ball}),
        "thickness": (
            lambda points, normals, edges: module.MedialAnalysis(points, triangles).thickness(
                normals, edges=edges
            ),
            {"points": ball, "normals": normals, "edges": some > 1},
        ),
        "levels": (lambda **words: module.MedialAnalysis(**words).hierarchy().extract(), cocone),
        "sample": (lambda **words: module.sample_surface(count=300, **words), mesh),
        "sizing": (
            lambda a, b, **words: module.sample_surface(sizing=(a, b), count=300, **words),
            {"a": ball, "b": some, **mesh},
        ),
        "nearest": (module.nearest, {"sites": ball, "queries": ball}),
        "open_edges": (module.open_edges, {"points": ball, "triangles": triangles}),
        "solid_betti": (module.solid_betti, {"points": ball, "triangles": triangles}),
        "winding": (module.winding_number, {"queries": 0.5 * ball, **mesh}),
        "distances": (
            lambda queries, **words: module.TriangleTree(**words).distances(queries),
            {"queries": 0.5 * ball, **mesh},
        ),
        "walls": (
            module.wall_distances,
            {"points": ball, "normals": normals, "reach": some, **mesh},
        ),
        "buried": (
            lambda **words: module.buried(offset=1e-3, **words),
            {"points": ball, "normals": normals, **mesh},
        ),
        "polygons": (
            module.polygon_triangles,
            {
                "points": ball,
                "face_offsets": np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int32),
                "face_vertices": triangles.ravel(),
            },
        ),
        "patches": (
            lambda triangles, wanted: module.patches(triangles, wanted, len(ball)),
            {"triangles": triangles, "wanted": np.ones(len(triangles), bool)},
        ),
    }


def wrong_arguments(random: Random, folder: Path) -> None:
    """Every array of the compiled module: a documented error, or an answer."""
    module, calls = native.load(), _calls()
    function, words = calls[str(random.choice(sorted(calls)))]
    words = dict(words)
    name = str(random.choice(sorted(key for key in words if isinstance(words[key], np.ndarray))))
    words[name], poisoned = _spoilt(words[name], random)
    try:
        function(**words)
    except (module.InvalidInputError, module.DegenerateInputError) as error:
        _is_a_sentence(error)
    except (TypeError, ValueError) as error:
        assert str(error)
    else:
        assert not poisoned, f"{name} holds what is no number, and nothing was said"


def _spoilt(array: np.ndarray, random: Random) -> tuple[object, bool]:
    """The array with something wrong, and whether it is a number that is none."""
    other = array.copy()
    kind = random.integers(0, 8)
    if kind <= 3 and array.dtype.kind == "f":
        value = ODD[random.integers(0, len(ODD))]
        other.flat[random.integers(0, other.size)] = value
        return other, not np.isfinite(value)
    if kind <= 3 and array.dtype.kind == "i":
        other.flat[random.integers(0, other.size)] = random.choice(
            [-1, 2**31 - 1, -(2**31), len(array) * 9]
        )
        return other, False
    if kind == 4:
        return other[: random.integers(0, 4)], False
    if kind == 5:
        return other.astype(random.choice(["f4", "i8", "u1", "?", "c16", "O", "U9"])), False
    if kind == 6:
        return [other.T, other[::-2], other.ravel(), other[None], np.asfortranarray(other)][
            random.integers(0, 5)
        ], False
    return [None, 3, "x", [], [[1, 2]], {}, other.tolist()][random.integers(0, 7)], False


def settings_out_of_range(random: Random, folder: Path) -> None:
    name = str(random.choice(sorted(Settings.__dataclass_fields__)))
    value = [*ODD, None, "x", True, [], np.float32(3), 10**30][random.integers(0, len(ODD) + 6)]
    try:
        settings = Settings(**{"samples": 200, "budget": 400, name: value})
        found = compute(*shapes.icosphere(1), settings)
    except MedialAxisError as error:
        _is_a_sentence(error)
    except (TypeError, ValueError, AttributeError, KeyError) as error:
        assert not isinstance(value, (int, float)) or isinstance(value, bool), (
            f"{name}={value!r}: {error!r}"
        )
    else:
        _is_an_axis(found.axis)


def words_out_of_range(random: Random, folder: Path) -> None:
    """Numbers that are none or far off: usage, input, failure or done, and a sentence; no traceback."""
    shape = folder / "a.off"
    shape.write_bytes(GOOD["a.off"])
    flags = [
        "theta",
        "rho",
        "samples",
        "spacing",
        "budget",
        "epsilon",
        "sharp-angle",
        "seed",
        "simplify",
        "erode",
        "limb",
        "memory-limit",
        "frames",
    ]
    words = [str(shape), str(folder / "a.ply")]
    for _ in range(random.integers(1, 4)):
        value = random.choice(
            ["nan", "inf", "-1", "1e999", "", "0", "x", "1e30", "99999999999999999999", "-0", "1,5"]
        )
        words.append(f"--{random.choice(flags)}={value}")
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            code = cli.main(words)
        except SystemExit as end:
            code = end.code
    assert code in range(6) and "Traceback" not in err.getvalue(), (words, code, err.getvalue())
    assert code == 0 or err.getvalue().strip(), words
    assert (code in (0, 5)) == (folder / "a.ply").exists(), (words, code)


def cancelled(random: Random, folder: Path) -> None:
    """Cancelled, or all is there; the next run is whole."""
    module = native.load()
    points, triangles = shapes.icosphere(4)
    progress = module.Progress()
    timer = threading.Timer(float(random.uniform(0, 0.15)), progress.cancel)
    timer.start()
    works = [
        lambda p: module.MedialAnalysis(points, triangles, progress=p),
        lambda p: module.sample_surface(points, triangles, count=20_000, smooth=True, progress=p),
        lambda p: module.MedialAnalysis(
            points, sides=module.SidesFrom.TIGHT_COCONE, progress=p
        ).hierarchy(progress=p),
        lambda p: module.TightCocone(points, progress=p),
    ]
    try:
        works[random.integers(0, len(works))](progress)
    except module.Cancelled:
        pass
    finally:
        timer.cancel()
    assert len(module.MedialAnalysis(points[:100]).edges) > 0
