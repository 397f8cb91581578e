# SPDX-License-Identifier: GPL-3.0-or-later
"""The package as a library: what `import medial_axis` offers, and that it computes what the add-on computes."""

import inspect
import subprocess
import sys

import medial_axis
import numpy as np
import pytest
from medial_axis import library
from medial_axis.core.axis import compute as axis
from medial_axis.core.settings import OPTIONS, Settings
from support.meshes import icosphere, torus
from support.same_axis import same_axis as same

FORM = ("form", "simplify", "erode", "spike", "limb", "detail", "crisp", "mesh")


def egg(count=2000):
    points = np.random.default_rng(1).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None] * (1.0, 0.7, 0.5)


# --- the package


def test_import_is_cheap():
    """The import loads neither NumPy nor the compiled module nor Blender, and adds only the offered names."""
    code = (
        f"import sys; sys.path[:0] = {[str(medial_axis.__path__[0]) + '/..']!r}; "
        "import importlib.util as u; "
        f"s = u.spec_from_file_location('medial_axis', {medial_axis.__file__!r}, "
        f"submodule_search_locations=[{medial_axis.__path__[0]!r}]); "
        "m = u.module_from_spec(s); sys.modules['medial_axis'] = m; s.loader.exec_module(m); "
        "assert not hasattr(m, 'no_such_name') and not hasattr(m, 'ui'); dir(m); "
        "assert 'medial_axis.library' not in sys.modules; "
        "assert not {'numpy', 'bpy'} & set(sys.modules), 'imported too early'; "
        "m.Settings; assert 'numpy' in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_package_offers_what_the_library_has():
    assert medial_axis.__all__ == library.__all__ == sorted(library.__all__)
    assert set(medial_axis.__all__) <= set(dir(medial_axis))
    for name in medial_axis.__all__:
        assert getattr(medial_axis, name) is getattr(library, name)
    with pytest.raises(AttributeError, match="no attribute 'cube'"):
        medial_axis.cube  # noqa: B018


@pytest.mark.parametrize("name", library.__all__)
def test_everything_offered_is_described(name):
    thing = getattr(medial_axis, name)
    assert inspect.getdoc(thing)
    if inspect.isfunction(thing):
        parameters = inspect.signature(thing).parameters
        assert all(p.annotation is not p.empty for p in parameters.values())
        assert inspect.signature(thing).return_annotation is not inspect.Signature.empty


# --- the same as the add-on


@pytest.mark.parametrize("settings", [{}, {"side": medial_axis.Side.BOTH, "theta": 0.2}])
def test_surface_as_in_the_add_on(settings):
    ours = medial_axis.compute(*torus(), **settings)
    theirs = axis.compute(*torus(), Settings(**settings))
    assert len(ours.axis.vertices) > 100
    assert same(ours.axis, theirs.axis) and ours.settings == theirs.settings


def test_points_as_in_the_add_on_from_lists():
    points = egg()
    ours = medial_axis.compute(points.tolist())
    theirs = axis.compute(points, np.empty((0, 3), np.int32), Settings())
    assert ours.axis.facets > 30 and same(ours.axis, theirs.axis)


def test_normals_tell_inside_from_outside():
    points = egg()
    found = medial_axis.compute(points, normals=points / np.square((1.0, 0.7, 0.5)))
    assert found.settings.sides is medial_axis.SidesFrom.NORMALS


def test_choices_by_name():
    points = egg()
    found = medial_axis.compute(points, side="outer", sides="tight-cocone", rule="BOTH")
    assert found.settings.side is medial_axis.Side.OUTER
    assert found.settings.rule is medial_axis.Rule.BOTH
    assert same(found.axis, medial_axis.compute(points, side="Outer", rule="both").axis)


def test_other_thresholds_of_the_same_analysis():
    found = medial_axis.compute(egg(), theta=0.2)
    fewer = medial_axis.extract(found, theta=0.7, criteria="angle")
    assert 0 < fewer.facets != found.axis.facets
    assert same(fewer, medial_axis.compute(egg(), theta=0.7, criteria="angle").axis)
    assert same(medial_axis.extract(found), found.axis)


def test_reconstructs():
    surface = medial_axis.reconstruct(egg().astype(np.float32))
    assert len(surface.triangles) == 2 * len(surface.vertices) - 4


def test_progress_is_told_and_cancels():
    progress = medial_axis.Progress()
    medial_axis.compute(egg(500), progress=progress)
    assert progress.fraction > 0.9
    stopped = medial_axis.Progress()
    stopped.cancel()
    with pytest.raises(medial_axis.Cancelled):
        medial_axis.compute(egg(501), progress=stopped)


# --- files


def test_writes_and_reads(tmp_path):
    np.savez(tmp_path / "egg.npz", points=egg())
    shape = medial_axis.read(tmp_path / "egg.npz")
    found = medial_axis.compute(shape.points, shape.triangles, shape.normals)
    path = medial_axis.write(found, tmp_path / "axis.npz")
    assert same(medial_axis.read_axis(path), found.axis)
    assert medial_axis.write(found.axis, tmp_path / "axis.ma").read_bytes()[:2].isdigit()
    with pytest.raises(medial_axis.ExportError, match="Expected a file name that ends in"):
        medial_axis.write(found, tmp_path / "axis.txt")
    with pytest.raises(medial_axis.ReadError):
        medial_axis.read(tmp_path / "none.ply")


# --- what is refused


POINTS, TRIANGLES = icosphere(1)
ROWS = "Expected points as rows of three numbers"


@pytest.mark.parametrize(
    "given, settings, said",
    [
        (([[0, 0], [1, 1]],), {}, rf"{ROWS}, found shape \(2, 2\)"),
        (([[0, 0, 0], [1, 1]],), {}, ROWS),
        ((["abc"],), {}, ROWS),
        (([[np.nan, 0, 0]] * 5,), {}, "Expected finite"),
        ((np.nan * POINTS, TRIANGLES), {}, "Expected finite"),
        ((POINTS, [[0.0, 1.0, 2.0]]), {}, "Expected triangles as rows of three integers"),
        ((POINTS, [[0, 1, 1 << 40]]), {}, "Expected rows of points in triangles, found"),
        ((POINTS, [[0, 1, 9999]]), {}, "9999"),
        ((POINTS, [[0, 1, -1]]), {}, "-1"),
        ((POINTS, None, POINTS[:3]), {}, "Expected a normal for each of 42 points, found 3"),
        ((POINTS,), {"thteta": 1}, "Expected settings among form, .*, found 'thteta'"),
        ((POINTS,), {"theta": "wide"}, "Expected theta as float, found 'wide'"),
        ((POINTS,), {"theta": 2.0}, "Expected theta from 0 to 1.5708 rad, found 2"),
        ((POINTS,), {"samples": 100.5}, "Expected samples as int, found 100.5"),
        ((POINTS,), {"smooth": "yes"}, "Expected smooth as bool, found 'yes'"),
        ((POINTS,), {"side": "top"}, "Expected side as one of 'automatic', 'inner'.*'top'"),
        ((POINTS,), {"side": medial_axis.Rule.BOTH}, "Expected side as one of"),
    ],
)
def test_wrong_input_is_one_sentence(given, settings, said):
    with pytest.raises(medial_axis.InvalidInputError, match=said):
        medial_axis.compute(*given, **settings)


MISUSES = {
    "masked points": lambda *_: library.compute(np.ma.masked_greater(POINTS, 0.5), TRIANGLES),
    "masked triangles": lambda *_: library.compute(POINTS, np.ma.masked_equal(TRIANGLES, 3)),
    "points that are none": lambda found, path: library.compute(None),
    "a huge number": lambda found, path: library.compute(POINTS, TRIANGLES, theta=10**400),
    "progress of compute": lambda found, path: library.compute(POINTS, progress="x"),
    "progress of parts": lambda *_: library.compute_each_part(POINTS, TRIANGLES, progress=1),
    "progress of balls": lambda found, path: library.cover_by_balls(POINTS, progress=1),
    "progress of a surface": lambda found, path: library.reconstruct(POINTS, progress=1),
    "progress of few vertices": lambda found, path: library.reduce(found, 9, progress=1),
    "vertices as text": lambda found, path: library.reduce(found, "4"),
    "half a vertex": lambda found, path: library.reduce(found, 4.5),
    "no vertices": lambda found, path: library.reduce(found, 0),
    "too many vertices": lambda found, path: library.reduce(None, 10**30),
    "few vertices of nothing": lambda found, path: library.reduce(None, 4),
    "extract of nothing": lambda found, path: library.extract(None),
    "extract of an axis": lambda found, path: library.extract(found.axis),
    "write of nothing": lambda found, path: library.write(None, path),
    "a path that is a number": lambda found, path: library.write(found, 5),
    "a path with a zero byte": lambda found, path: library.write(found, f"{path}\0.ma"),
    "balls of an axis": lambda found, path: library.write_balls(found, path),
    "read of a number": lambda found, path: library.read(5),
    "read of an axis from a number": lambda found, path: library.read_axis(5),
}


@pytest.fixture(scope="module")
def small():
    return medial_axis.compute(POINTS, TRIANGLES)


@pytest.mark.parametrize("name", MISUSES)
def test_every_error_is_one_of_its_own_in_a_sentence(small, tmp_path, name):
    with pytest.raises(medial_axis.MedialAxisError, match="^Expected .*, found .*; .*$"):
        MISUSES[name](small, tmp_path / "a.ma")


def test_a_path_may_be_bytes(small, tmp_path):
    written = medial_axis.write(small, bytes(tmp_path / "a.ma"))
    assert written == tmp_path / "a.ma" and len(medial_axis.read_axis(bytes(written)).vertices)


def test_a_masked_array_without_masked_numbers_is_an_array(small):
    again = medial_axis.compute(np.ma.array(POINTS), TRIANGLES)
    np.testing.assert_array_equal(again.axis.vertices, small.axis.vertices)


def test_what_needs_another_analysis_is_not_extracted():
    found = medial_axis.compute(egg(500))
    for name in OPTIONS:
        if name not in FORM and name not in ("theta", "rho", "rule", "criteria", "limit_set"):
            with pytest.raises(medial_axis.InvalidInputError, match="compute again"):
                medial_axis.extract(found, **{name: OPTIONS[name].default})
