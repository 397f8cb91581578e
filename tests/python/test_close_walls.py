# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness is never reported above what rays find between the walls, and what is unknown is never 0 %."""

import json

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.samples.shape import Shape
from medial_axis.core.settings import Between, Edges, Settings, ThicknessSettings
from medial_axis.core.solid.thickness import measure_thickness
from medial_axis.core.solid.thin_parts import find_thin_parts

pytestmark = pytest.mark.oracle


def halves(polygons):
    """Triangles of triangles and quadrilaterals."""
    return np.array(
        [t for p in polygons for t in ((p[0], p[i], p[i + 1]) for i in range(1, len(p) - 1))]
    )


def box(*size):
    points = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]) * size
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, halves(faces)


def cube_with_fin(width, thickness):
    """A unit cube with a fin on top: one closed manifold of 16 vertices."""
    cube = box(1, 1, 1)[0][[0, 1, 3, 2, 4, 5, 7, 6]]
    xs, ys = 0.5 + np.array([-1, 1]) * width / 2, 0.5 + np.array([-1, 1]) * thickness / 2
    foot = [(xs[0], ys[0], 1), (xs[1], ys[0], 1), (xs[1], ys[1], 1), (xs[0], ys[1], 1)]
    top = np.array(foot) + np.array((0, 0, 0.1))
    faces = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    for start in (4, 8):  # the top around the fin, then its sides
        ring = [
            (start + i, start + (i + 1) % 4, start + 4 + (i + 1) % 4, start + 4 + i)
            for i in range(4)
        ]
        faces += ring
    return np.concatenate([cube, foot, top]), halves([*faces, (12, 13, 14, 15)])


def measured(points, triangles, **wanted):
    shape = Shape(np.asarray(points, float), triangles.astype(np.int32))
    return measure_thickness(shape, Settings(), ThicknessSettings(**wanted))


def write(path, points, triangles):
    rows = [f"OFF\n{len(points)} {len(triangles)} 0"]
    rows += ["{!r} {!r} {!r}".format(*map(float, row)) for row in points]
    rows += ["3 {} {} {}".format(*row) for row in triangles.tolist()]
    path.write_text("\n".join(rows))
    return path


FINS = [
    (width, thickness) for width in (0.05, 0.1, 0.2, 0.5) for thickness in (0.002, 0.0005, 1e-5)
]


@pytest.mark.parametrize(("width", "thickness"), FINS)
def test_a_fin_does_not_pass_the_gate(tmp_path, capsys, width, thickness):
    source = write(tmp_path / "fin.off", *cube_with_fin(width, thickness))
    words = ["thickness", source, tmp_path / "fin.json", "--limit", "0.02"]
    assert cli.main(list(map(str, words))) == cli.THIN
    found = json.loads((tmp_path / "fin.json").read_text())
    assert found["minimum"] == pytest.approx(thickness, rel=0.01)
    assert found["share_below"] > 0.0 and found["patches"]
    x, y, z = min(found["patches"], key=lambda patch: patch["minimum"])["place"]
    assert abs(x - 0.5) <= width and abs(y - 0.5) <= 0.01 and z >= 0.99


@pytest.mark.parametrize("thickness", [0.01, 0.002, 0.0015, 0.0003, 1e-5])
def test_plates_have_their_thickness_however_thin(thickness):
    found = measured(*box(1.0, 1.0, thickness), limit=0.02)
    assert found.minimum == pytest.approx(thickness, rel=0.01)
    assert find_thin_parts(found, 0.02).share > 0.9 and found.unmeasured < 0.01


def test_thick_solids_are_as_before():
    """A cube, a wedge with an acute edge, and a cube with a slot have no walls that were missed."""
    wedge = np.array([(0, 0, 0), (1, 0, 0), (1, 0, 0.6), (0, 1, 0), (1, 1, 0), (1, 1, 0.6)], float)
    faces = halves([(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (0, 2, 5, 3)])
    for points, triangles in (box(1, 1, 1), box(1, 0.5, 0.3), (wedge, faces)):
        found = measured(points, triangles)
        assert len(found.walls.distance) == 0 and found.unmeasured < 0.01


def test_a_gap_is_no_wall():
    assert len(measured(*cube_with_fin(0.1, 0.002), between=Between.GAP).walls.distance) == 0


def test_what_is_unknown_is_a_number_and_an_exit_code(tmp_path, monkeypatch):
    """Where the axis and the rays find nothing: here by taking the walls away."""
    from medial_axis.core.solid import close_walls, thickness

    nothing = lambda *_: close_walls.no_close_walls()
    monkeypatch.setattr(thickness, "close_walls", nothing)
    source = write(tmp_path / "plate.off", *box(1.0, 1.0, 1e-5))
    output = tmp_path / "plate.json"
    assert cli.main(["thickness", str(source), str(output), "--limit", "0.02"]) == cli.UNMEASURED
    found = json.loads(output.read_text())
    assert found["share_unmeasured"] > 0.9 and found["minimum"] is None
    assert any("no thickness could be measured" in text for text in found["warnings"])


def test_what_is_left_out_on_purpose_is_not_unknown():
    assert measured(*box(1, 1, 1), edges=Edges.GREY).unmeasured == 0.0


def test_only_wedges_of_the_solid_are_acute_edges():
    """Inside out, the sharp edge of a wedge is that of a groove, where ways through the solid do not become short."""
    from medial_axis.core.solid.close_walls import _acute_edges

    points = np.array(
        [(x, y, z) for y in (0.0, 1.0) for x, z in ((0.0, 0.0), (4.0, -1.0), (4.0, 1.0))]
    )
    triangles = np.array(
        [(0, 1, 2), (3, 5, 4), (0, 3, 4), (0, 4, 1), (1, 4, 5), (1, 5, 2), (2, 5, 3), (2, 3, 0)],
        np.int32,
    )
    outward = triangles if Shape(points, triangles).volume > 0 else triangles[:, ::-1]
    found = _acute_edges(Shape(points, outward))
    assert sorted(map(tuple, found.reshape(-1, 3).tolist())) == [(0.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    assert len(_acute_edges(Shape(points, outward[:, ::-1]))) == 0
