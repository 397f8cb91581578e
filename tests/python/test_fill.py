# SPDX-License-Identifier: GPL-3.0-or-later
"""Fill: hollow pipes, ducts, cups and bottles have the line of their outer faces, with either radius."""

import json

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.rig.rig import compute_rig
from medial_axis.core.settings import Fill, Settings, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.compute import compute_skeleton
from medial_axis.core.skeleton.fill import filled
from support.meshes import flip, revolved, shape_of, write_off
from support.thick_meshes import block, lathe, shell
from support.thin_solids import union

BEND, OUTSIDE, INSIDE, SHARP = 5.0, 1.0, 0.8, np.pi / 6


def pipe(low, high, inside=INSIDE, rings=40, around=32):
    """A pipe round Z with flat ends; the second half of the points is inside, from its end on."""
    along = np.linspace(low, high, rings)
    profile = [*((OUTSIDE, at) for at in along), *((inside, at) for at in along[::-1])]
    return revolved(profile, around)


def bent_pipe(turn=np.pi / 2):
    """A pipe with flat ends along an arc round Z; the second half of the points is inside, from its end on."""
    points, triangles = pipe(0.0, turn)
    away, angle = BEND + points[:, 0], points[:, 2]
    return flip(
        (np.column_stack((away * np.cos(angle), away * np.sin(angle), points[:, 1])), triangles)
    )


def duct():
    """A T of square ducts, 7 outside and 5 inside, along X from -16.5 to 16.5 and along Y from 0 to 17.5."""
    outer, inner = (
        (((-16.5, -half, -half), (16.5, half, half)), ((-half, 0, -half), (half, 17.5, half)))
        for half in (3.5, 2.5)
    )
    return union(*outer, without=inner)


CUP = [(0.0, 0.0), (1.0, 0.0), (1.0, 3.0), (0.9, 3.0), (0.9, 0.1), (0.0, 0.1)]
BOTTLE = [
    (0, 0), (1, 0), (1, 2), (0.4, 3), (0.4, 4), (0.3, 4), (0.3, 3), (0.9, 2), (0.9, 0.1),
    (0, 0.1),
]  # fmt: skip


@pytest.mark.parametrize("profile", [CUP, BOTTLE], ids=["cup", "bottle"])
def test_vessels_are_filled_to_their_lip(profile):
    """The bottom of a cup has no wall before it, but lies within the wall round it."""
    found = filled(shape_of(lathe(profile)), SHARP)
    outer = [*profile[: len(profile) // 2], (0.0, profile[len(profile) // 2 - 1][1])]
    assert found.shape.volume == pytest.approx(shape_of(lathe(outer)).volume, rel=1e-12)
    assert found.shape.open_edges == 0 and found.shape.solid_betti == (1, 0, 0)


def test_bores_and_cavities_are_filled():
    for mesh, loops in ((bent_pipe(), 1), (duct(), 2), (shell(), 0)):
        shape = shape_of(mesh)
        assert shape.solid_betti == (1, loops, 0 if loops else 1)
        found = filled(shape, SHARP)
        assert found.shape.solid_betti == (1, 0, 0) and 0.3 < found.share < 0.5
    volume = 7 * 7 * (33 + 14.5)
    assert filled(shape_of(duct()), SHARP).shape.volume == pytest.approx(volume, rel=0.02)


def test_a_bent_pipe_has_its_arc_with_either_radius():
    shape = shape_of(bent_pipe())
    lines = []
    for fill, radius in ((Fill.OUTSIDE, OUTSIDE), (Fill.INSIDE, INSIDE)):
        found = compute_skeleton(shape, Settings(), SkeletonSettings(fill=fill))
        line = found.skeleton
        assert (line.count, line.tips, line.loops, line.pieces) == (1, 2, 0, 1)
        away = np.hypot(np.hypot(*line.points[:, :2].T) - BEND, line.points[:, 2])
        along = BEND * np.arctan2(line.points[:, 1], line.points[:, 0])
        between = (along > 1.5 * OUTSIDE) & (along < BEND * np.pi / 2 - 1.5 * OUTSIDE)
        assert away[between].max() < 0.02 and line.length > BEND * np.pi / 2 - 2.1 * OUTSIDE
        np.testing.assert_allclose(line.radius[between], radius, rtol=0.01)
        assert any("% of the faces lie inside of others" in said for said in found.warnings)
        lines.append(found.curve.points)
        assert len(found.parts.faces) == len(shape.triangles) and (found.parts.faces == 0).all()
    np.testing.assert_array_equal(*lines)


@pytest.mark.parametrize("inside", [INSIDE, 0.95])
@pytest.mark.parametrize("slant", [0.25, 0.5, 1.0])
def test_a_pipe_with_slanted_mouths_keeps_its_line(slant, inside):
    """The wall of the bore is inside up to its lip, and the line does not go on into the corners of the lids."""
    points, triangles = pipe(-4.0, 4.0, inside)
    points[:, 2] += slant * points[:, 0] * np.abs(points[:, 2]) / 4.0
    shape = shape_of(flip((points, triangles)))
    assert len(filled(shape, SHARP).inner) == 2 * 39 * 32
    found = compute_skeleton(shape, Settings(), SkeletonSettings(fill=Fill.INSIDE))
    line = found.skeleton
    assert (line.count, line.tips, line.loops) == (1, 2, 0)
    assert np.hypot(*line.points[:, :2].T).max() < 0.1
    assert line.radius.min() > 0.85 * inside and line.length > 8.0 - 2.0 * (1.0 + slant)


def test_a_branching_duct_has_a_fork(tmp_path, capsys):
    out = tmp_path / "duct.json"
    words = ["skeleton", write_off(tmp_path / "duct.off", duct()), str(out), "--json"]
    assert cli.main([*words, "--fill", "inside"]) == cli.DONE
    report = json.loads(capsys.readouterr().out)
    assert (report["branches"], report["ends"], report["loops"]) == (3, 3, 0)
    assert report["settings"]["fill"] == "inside"
    found = json.loads(out.read_text())
    places = np.array([node["position"] for node in found["nodes"]])
    radii = np.array([node["radius"] for node in found["nodes"]])
    off = np.minimum(np.abs(places[:, 1]), np.abs(places[:, 0]))
    assert max(off.max(), np.abs(places[:, 2]).max()) < 0.5
    far = np.abs(places).max(axis=1) > 5.0
    assert np.median(radii[far]) == pytest.approx(2.5, abs=0.05)


def test_bones_of_a_pipe_have_weights_on_both_walls():
    rig = compute_rig(shape_of(bent_pipe()), Settings(), SkeletonSettings(fill=Fill.OUTSIDE))
    assert rig.bones.count >= 2
    np.testing.assert_allclose(rig.weight.sum(axis=1), 1.0)
    outside, inside = rig.bone[:, 0].reshape(2, 40, 32)
    assert (outside == inside[::-1]).mean() > 0.9, "inner beside outer vertices"


def test_what_is_not_hollow_stays():
    shape = shape_of(block(3.0, 1.0, 1.0))
    found = filled(shape, SHARP)
    assert found.shape is shape and found.share == 0.0
    made = compute_skeleton(shape, Settings(), SkeletonSettings(fill=Fill.OUTSIDE))
    assert "nothing is hollow, so Fill changed nothing" in made.warnings
    with pytest.raises(InvalidInputError, match="Expected faces for Fill, found points only"):
        filled(Shape(shape.points, np.zeros((0, 3), np.int32)), SHARP)
