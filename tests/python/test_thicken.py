# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin walls moved apart to a limit: solids whose thickness afterwards is known, and those that must not change."""

import json
from dataclasses import replace

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.machine.cache import CACHE
from medial_axis.core.settings import (
    Between,
    Edges,
    Moving,
    Settings,
    ThickenSettings,
    ThicknessSettings,
)
from medial_axis.core.thickness import thickness
from medial_axis.core.thickness.face_gaps import face_gaps
from medial_axis.core.thickness.fine_faces import coarse_faces, cut_faces
from medial_axis.core.thickness.thicken import _left_over, thicken
from medial_axis.core.thickness.thickness import measure_thickness
from medial_axis.core.thickness.thin_in_part import subdivided
from medial_axis.core.thickness.thin_parts import Patch, ThinParts
from scipy.spatial import cKDTree
from support import thin_solids, topology
from support.meshes import join, read, shape_of, write_off
from support.thick_meshes import block, ellipsoid, shell
from support.thin_solids import turned, union

pytestmark = pytest.mark.oracle

LIMIT = 0.05
FEW = Settings(samples=3_000)


def thickened(mesh, limit=LIMIT, selected=None, settings=Settings(), **wanted):
    return thicken(shape_of(mesh), settings, ThickenSettings(limit=limit, **wanted), selected)


def finer(mesh, longest):
    """The mesh with its faces cut until no edge is longer."""
    shape, none = shape_of(mesh), (np.zeros((0, 2), np.int32), np.zeros(0, np.int8))
    cut = cut_faces(coarse_faces(shape.points, shape.triangles, *none), longest)
    return cut.points, cut.triangles


def measured(shape, **wanted):
    return measure_thickness(shape, Settings(), ThicknessSettings(**wanted))


@pytest.mark.parametrize("seed", (1, 2, 3))
@pytest.mark.parametrize("name", ("plate", "profile_t", "profile_i", "profile_l", "fin", "cup"))
def test_thin_solids_get_the_limit(name, seed):
    found = thickened(turned(getattr(thin_solids, name)(0.01).mesh, seed))
    assert not found.left.patches and not found.warnings
    assert found.after.minimum == pytest.approx(LIMIT, rel=2e-4)


def test_rims_stay_where_they_are():
    """A plate grows in height only, by half on both sides."""
    moves = thickened(thin_solids.plate(0.01).mesh).moves
    np.testing.assert_allclose(moves[:, :2], 0.0, atol=1e-12)
    np.testing.assert_allclose(np.abs(moves[:, 2]), 0.02, rtol=2e-3)


def test_only_selected_faces_move():
    points, triangles = thin_solids.plate(0.01).mesh
    top = (points[triangles][:, :, 2] > 0.005).all(axis=1)
    moves = thickened((points, triangles), moving=Moving.SELECTED, selected=top).moves
    above = points[:, 2] > 0.005
    np.testing.assert_allclose(moves[above][:, 2], 0.04, rtol=2e-3)
    assert not moves[~above].any()


def test_curved_walls():
    found = thickened(turned(shell(1.0, 0.95)), limit=0.08)
    assert not found.left.patches
    lengths = found.after.of_vertices
    assert lengths.min() > 0.0799 and np.quantile(lengths, 0.99) < 0.0815


def test_round_ends_gain_with_the_rest():
    """A body without edges whose walls are thick enough, and its ends are not.

    Its balls touch whole circles, and rounding decides at which place: copies that differ in last bits reach 0.88 to
    0.91.
    """
    found = thickened(ellipsoid((1.0, 0.5, 0.5), 4), limit=0.9)
    # Normals differ by 120 degrees where x = 4 y tan 30, so y = (28 / 3)^-1/2 and the ball has 2 y / cos 30 = 0.756.
    assert found.before.minimum < 0.76 and found.after.minimum > 0.87


def test_what_is_far_from_thin_walls_stays():
    """A fin on a cube: the cube moves within the blend only."""
    mesh = finer(thin_solids.fin(0.01).mesh, 0.05)
    found = thickened(mesh)
    assert not found.left.patches
    on_cube = mesh[0][:, 2] < 1.0 - 1e-9
    assert not found.moves[on_cube].any()


def test_a_blend_rises_to_the_wall():
    """A plate that gets thicker along its length has the limit where it was thinner, and rises before that."""
    points, triangles = ramp(finer(block(2.0, 0.5, 0.02), 0.04), 4.0)  # 0.02 to 0.18
    found = thickened((points, triangles), blend=0.2)
    # A ball that rests against the rim of a wall that tapers touches it farther on.
    assert found.left.share < 0.005 and found.after.minimum > 0.99 * LIMIT
    moved = np.linalg.norm(found.moves, axis=1)
    thickness = 0.02 * (1.0 + 4.0 * points[:, 0])
    assert not moved[thickness > LIMIT + 0.01 + 0.08 * 0.2].any()
    wall = (points[:, 2] < 1e-9) | (points[:, 2] > thickness - 1e-9)
    assert (moved[wall & (thickness < 0.045)] > 0.0).all()


def ramp(plate=block(2.0, 0.5, 0.02), steep=2.0):
    """The plate, which gets thicker along its length: from 0.02 to 0.1, by twelve triangles."""
    points = plate[0] - plate[0].min(axis=0)
    points[:, 2] *= 1.0 + steep * points[:, 0]
    return points, plate[1]


def slot(width):
    """Two walls of 0.01 on a block, with a slot between them."""
    start = 0.2 + 0.01 + width
    return union(
        ((0, 0, 0), (1, 1, 0.3)),
        ((0.2, 0, 0.3), (0.21, 1, 0.8)),
        ((start, 0, 0.3), (start + 0.01, 1, 0.8)),
    )


@pytest.mark.parametrize("seed", (1, 2))
def test_walls_of_a_narrow_slot_do_not_meet(seed):
    found = thickened(turned(slot(0.03), seed))
    assert found.gap == pytest.approx(0.03, rel=1e-4)
    assert any("gaps down to 0.03" in sentence for sentence in found.warnings)
    gap = measured(replace(found.after.shape, reading=None), between=Between.GAP)
    assert 0.002 < gap.minimum < 0.03
    assert not found.left.patches  # the free sides gain what the others may not


def spike_over_a_plate():
    """The tip stands 0.002 over a far place of one of the two triangles of a plate of 0.02."""
    points, triangles = block(1.0, 1.0, 0.02, (0.5, 0.5, 0.01))
    spike = np.array([[0.93, 0.93, 0.022], [0.95, 0.93, 0.5], [0.92, 0.95, 0.5], [0.91, 0.91, 0.5]])
    sides = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]])
    return join((points, triangles), (spike, sides))


def test_faces_never_pass_through_each_other():
    """The middle of the large triangle has no gap, so only the faces afterwards tell."""
    blade = block(0.01, 0.6, 0.47, (0.405, 0.5, 0.265))
    plate = block(1.0, 1.0, 0.02, (0.5, 0.5, 0.01))
    for mesh, gap in ((spike_over_a_plate(), 0.002), (join(plate, blade), 0.01)):
        found = thickened(mesh, 0.1)
        assert found.gap == pytest.approx(gap, rel=1e-6)
        assert any(f"across gaps down to {gap:.3g}," in text for text in found.warnings)
        assert not len(found.after.shape.crossing)
        assert found.moves.any() and any("run into each other" in text for text in found.warnings)
        assert not any("coarse faces" in text for text in found.warnings)


def test_gaps_of_faces_are_those_of_their_nearest_places():
    """Against the least of many places on both, for triangles that do not meet."""
    random = np.random.default_rng(4)
    first, second = random.normal(size=(2, 40, 3, 3))
    second[:, :, 0] += 5.0
    weights = random.dirichlet((0.3, 0.3, 0.3), 4000)
    places = [np.einsum("wc,pcx->pwx", weights, corners) for corners in (first, second)]
    for gap, a, b in zip(face_gaps(first, second), *places, strict=True):
        assert gap <= cKDTree(a).query(b)[0].min() <= gap + 0.1


@pytest.mark.parametrize(
    ("moved", "met", "reason"),
    [
        (False, False, "nothing moved, as a step would make more of it thin"),
        (True, True, "make room between the walls"),
        (False, True, "make room between the walls"),
        (True, False, "coarse faces need a subdivision"),
    ],
)
def test_the_reason_why_something_is_still_thin_is_said(moved, met, reason):
    patch = Patch((0.0, 0.0, 0.0), 1.0, 0.02, 0.02)
    none = np.zeros(1, np.int32)
    left = ThinParts(0.04, 0.02, (patch,), none, none, 1.0, 0.5)
    (said,) = _left_over(left, moved, met)
    assert reason in said
    assert not _left_over(replace(left, share=0.0009), moved, met)  # it would read as 0.0 %


def test_faces_that_are_thin_in_part_ask_for_a_subdivision():
    mesh = thin_solids.wedge(10.0).mesh
    with pytest.raises(InvalidInputError, match="thin in part; Subdivide divides them"):
        thickened(mesh)
    found = thickened(finer(mesh, 0.03))
    assert not found.left.patches
    before, after = (measured(x.shape, edges=Edges.GREY) for x in (found.before, found.after))
    thin = before.of_triangles < LIMIT
    assert (after.of_triangles[thin] > LIMIT * 0.999).mean() > 0.95


def test_subdivide_divides_what_is_thin_in_part():
    mesh = turned(ramp(), 4)
    found = thickened(mesh, settings=FEW, subdivide=True)
    assert found.left.share < 0.002 and found.after.minimum > 0.95 * LIMIT
    shape = found.before.shape
    np.testing.assert_array_equal(shape.points[:8], mesh[0])
    assert topology.volume(shape.points, shape.triangles) == pytest.approx(topology.volume(*mesh))
    assert topology.euler(shape.triangles) == 2 and topology.is_oriented(shape.triangles)
    assert 500 < len(shape.triangles) < 10_000 and len(found.moves) == len(shape.points)
    thin = found.before.of_vertices < 0.8 * LIMIT
    assert np.median(found.after.of_vertices[thin]) < 1.05 * LIMIT
    thick = found.before.of_vertices > 1.5 * LIMIT
    assert thick.any() and not found.moves[thick].any()


def test_subdivide_leaves_other_faces():
    """A plate beside the ramp keeps its faces, and a plate alone all of them."""
    plate = thin_solids.plate(0.01).mesh
    shape, face = subdivided(shape_of(plate), FEW, LIMIT)
    np.testing.assert_array_equal(shape.points, plate[0])
    np.testing.assert_array_equal(face, np.arange(len(plate[1])))
    both = shape_of(join((plate[0] + (9.0, 0.0, 0.0), plate[1]), ramp()))
    _, face = subdivided(both, FEW, LIMIT)
    assert (face < len(plate[1])).sum() == len(plate[1]) < len(face) / 10


def test_nothing_is_measured_twice(monkeypatch):
    """Steps hand on what they measured by way of the cache, a second click measures nothing, and results stay."""
    measured, once = [], thickness.lengths_by_faces

    def counted(shape, settings, wanted, progress):
        measured.append((shape.points.tobytes(), shape.triangles.tobytes(), wanted.edges))
        return once(shape, settings, wanted, progress)

    def click():
        return thickened(turned(ramp(), 2), settings=Settings(samples=300), subdivide=True)

    monkeypatch.setattr(thickness, "lengths_by_faces", counted)
    CACHE.clear()
    found = click()
    count = len(measured)
    assert len(set(measured)) == count > 4
    again = click()
    assert len(measured) == count
    monkeypatch.setattr(thickness, "kept_measurement", lambda key: None)
    fresh = click()
    assert len(measured) > 2 * count
    for other in (again, fresh):
        assert other.moves.tobytes() == found.moves.tobytes()
        for name in ("of_vertices", "of_triangles"):
            assert getattr(other.after, name).tobytes() == getattr(found.after, name).tobytes()
        assert other.warnings == found.warnings and other.left.share == found.left.share


def test_sharp_edges_and_the_choice_of_faces_go_along():
    points, triangles = ramp()
    edge = np.sort(triangles[:1, :2], axis=1)
    shape, face = subdivided(replace(shape_of((points, triangles)), sharp_edges=edge), FEW, LIMIT)
    ends = shape.points[shape.sharp_edges]
    whole = np.linalg.norm(points[edge[0, 1]] - points[edge[0, 0]])
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(whole)
    made = topology.unit_normals(shape.points, shape.triangles)
    given = topology.unit_normals(points, triangles)
    np.testing.assert_allclose(made, given[face], atol=1e-9)


def test_files_and_figures(tmp_path, capsys):
    source = write_off(tmp_path / "ramp.off", ramp())
    words = ["thicken", source, str(tmp_path / "thick.ply"), "--limit", "0.05", "--samples", "1000"]
    assert cli.main([*words, "--quiet"]) == cli.INPUT
    assert "thin in part; Subdivide divides them" in capsys.readouterr().err
    ended = cli.main([*words, "--subdivide"])
    assert "least thickness 0.02" in capsys.readouterr().out
    said = json.loads((tmp_path / "thick.ply.json").read_text(encoding="utf-8"))
    assert ended == (cli.THIN if said["patches"] else cli.DONE)
    assert said["minimum"] > 0.95 * LIMIT and said["share_below"] < 0.02
    assert said["settings"]["subdivide"] and "moving" not in said["settings"]
    points, triangles = read(tmp_path / "thick.ply")
    assert len(triangles) == said["faces"] > 500
    thin = points[:, 0] < 0.2
    # A wall in the plane of its rim gains more.
    assert LIMIT < np.ptp(points[thin][:, 2]) < 1.3 * LIMIT


def test_open_meshes_and_no_limit_are_refused():
    points, triangles = thin_solids.plate(0.01).mesh
    for faces, limit, said in (
        (triangles[:-1], LIMIT, "closed faces"),
        (triangles, 0.0, "a limit above 0"),
    ):
        with pytest.raises(InvalidInputError, match=f"Expected {said}"):
            thickened((points, faces), limit)
