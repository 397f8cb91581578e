# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles in text, which the usual readers of meshes read alike; one that is absent is skipped by its name."""

from dataclasses import replace
from types import SimpleNamespace

import medial_axis
import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.errors import ExportError
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.files.write import left_out
from medial_axis.core.products.axis import Axis
from medial_axis.core.settings import Settings

from tests.readers import example, verdict
from tests.support import topology
from tests.support.measure import polygons
from tests.support.readers import NAMES, READERS, area_of


@pytest.fixture(scope="module")
def axis():
    return example()


@pytest.fixture(scope="module")
def area(axis):
    return area_of(axis.vertices, polygons(axis))


@pytest.fixture
def reader(request):
    if request.param not in ("ours", *READERS):
        pytest.skip(f"{request.param} is not installed")
    return request.param


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".off"])
@pytest.mark.parametrize("reader", NAMES, indirect=True)
def test_others_read_triangles(axis, area, reader, suffix, tmp_path):
    if (reader, suffix) in {("plyfile", ".obj"), ("plyfile", ".off")}:
        pytest.skip("plyfile reads PLY alone")
    path = medial_axis.write(axis, tmp_path / f"a{suffix}", triangles=True)
    assert verdict(reader, path, len(axis.vertices), area) == "whole"


@pytest.mark.parametrize("reader", ["ours", *NAMES], indirect=True)
def test_an_infinite_rho_is_read_too(axis, area, reader, tmp_path):
    """Small medial meshes have an infinite rho."""
    without = replace(axis, rho=np.full(axis.facets, np.inf), theta=np.full(axis.facets, np.inf))
    path = medial_axis.write(without, tmp_path / "a.ply", triangles=True)
    if reader == "ours":
        np.testing.assert_array_equal(medial_axis.read(path).points, axis.vertices)
    else:
        assert verdict(reader, path, len(axis.vertices), area) == "whole"


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".off"])
def test_triangles_are_those_of_the_polygons(axis, area, suffix, tmp_path):
    path = medial_axis.write(axis, tmp_path / f"a{suffix}", triangles=True)
    shape, warnings = read_shape(path)
    np.testing.assert_array_equal(shape.points, axis.vertices)
    assert len(shape.triangles) == len(axis.face_vertices) - 2 * axis.facets and warnings == ()
    assert topology.area(shape.points, shape.triangles) == pytest.approx(area)


def test_each_triangle_of_a_ply_has_the_values_of_its_facet(axis, tmp_path):
    path = medial_axis.write(axis, tmp_path / "a.ply", triangles=True)
    head, body = path.read_text("ascii").split("end_header\n")
    lines, count = body.splitlines(), len(axis.vertices)
    rows = np.loadtxt(lines[count:])
    facet = rows[:, 9].astype(int)
    assert "property int facet" in head
    assert (np.bincount(facet) == np.diff(axis.face_offsets) - 2).all()
    values = np.column_stack((axis.theta, axis.rho, axis.side, axis.generators))
    np.testing.assert_array_equal(rows[:, 4:9], values[facet])
    np.testing.assert_array_equal(np.loadtxt(lines[:count])[:, 3], axis.radius)


@pytest.mark.parametrize("suffix", [".ma", ".npz"])
def test_the_other_formats_are_as_ever(axis, suffix, tmp_path):
    ever = medial_axis.write(axis, tmp_path / f"a{suffix}").read_bytes()
    assert medial_axis.write(axis, tmp_path / f"b{suffix}", triangles=True).read_bytes() == ever


def wired(axis, facets=True):
    """The axis has two edges and a vertex in addition to the facets, or instead of them."""
    extra = np.array([(9, 9, 9), (9, 9, 10), (9, 10, 9), (8, 8, 8)], float)
    first = len(axis.vertices) if facets else 0
    changes = {
        "vertices": np.concatenate([axis.vertices[:first], extra]),
        "radius": np.concatenate([axis.radius[:first], np.ones(4)]),
        "edges": np.array([(0, 1), (1, 2)], np.int32) + first,
    }
    if not facets:
        for name in ("face_vertices", "theta", "rho", "side", "generators"):
            changes[name] = getattr(axis, name)[:0]
        changes["face_offsets"] = np.zeros(1, np.int32)
    return replace(axis, **changes)


def test_an_obj_of_triangles_has_lines_and_points(axis, tmp_path):
    path, first = tmp_path / "a.obj", len(axis.vertices) + 1
    rows = medial_axis.write(wired(axis), path, triangles=True).read_text("ascii").splitlines()
    lines = [f"l {first} {first + 1}", f"l {first + 1} {first + 2}"]
    assert [row for row in rows if row[0] in "lp"] == [*lines, f"p {first + 3}"]
    assert left_out(wired(axis), path, triangles=True) == ""


@pytest.mark.parametrize("reader", [name for name in NAMES if name != "plyfile"], indirect=True)
def test_lines_change_no_face_for_others(axis, area, reader, tmp_path):
    path = medial_axis.write(wired(axis), tmp_path / "a.obj", triangles=True)
    _, faces, found = READERS[reader](path)
    assert faces == len(axis.face_vertices) - 2 * axis.facets
    assert found == pytest.approx(area, rel=1e-4)


@pytest.mark.parametrize("suffix", [".ply", ".off"])
def test_what_triangles_leave_out_is_said(axis, suffix, tmp_path):
    path = tmp_path / f"a{suffix}"
    medial_axis.write(wired(axis), path, triangles=True)
    assert len(read_shape(path)[0].triangles) == len(axis.face_vertices) - 2 * axis.facets
    said = left_out(wired(axis), path, triangles=True)
    assert "2 edges without a facet and 1 lone vertices, which are left out; write .obj" in said
    assert not left_out(wired(axis), path, triangles=False)
    assert not left_out(axis, path, triangles=True)


@pytest.mark.parametrize("suffix", [".ply", ".off"])
def test_edges_alone_are_no_triangles(axis, suffix, tmp_path):
    path, alone = tmp_path / f"a{suffix}", wired(axis, facets=False)
    with pytest.raises(ExportError, match="Expected facets .* found 2 edges and 1 lone vertices"):
        medial_axis.write(alone, path, triangles=True)
    assert list(tmp_path.iterdir()) == []
    assert medial_axis.write(alone, path).exists()


def test_the_command_line_says_what_triangles_leave_out(tmp_path, capsys):
    """The curve of a long ellipsoid is edges alone."""
    points = np.random.default_rng(4).normal(size=(800, 3))
    np.save(tmp_path / "a.npy", points / np.linalg.norm(points / (4, 1, 1), axis=1)[:, None])
    words = [str(tmp_path / "a.npy"), "--form", "curve", "--triangles"]
    for suffix in ("ply", "off"):
        output = tmp_path / f"a.{suffix}"
        assert cli.main([*words, str(output)]) == cli.FAILED and not output.exists()
        assert "Expected facets to write as triangles, found " in capsys.readouterr().err
    assert cli.main([*words, str(tmp_path / "a.obj")]) == cli.DONE
    assert "\nl " in (tmp_path / "a.obj").read_text("ascii")


def test_the_report_says_what_triangles_leave_out(axis, tmp_path):
    found = SimpleNamespace(axis=wired(axis))
    work = Axis(Settings(), triangles=True)
    said = work.write(found, tmp_path / "a.ply", np.identity(4))
    assert said == (left_out(wired(axis), "a.ply", triangles=True),) and said[0]
    assert work.write(found, tmp_path / "a.obj", np.identity(4)) == ()
