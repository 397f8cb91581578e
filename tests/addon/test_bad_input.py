# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input through the operator: one sentence each; never a crash, a NaN or half an object."""

import bpy
import numpy as np
import pytest
from measure import medial_objects, positions, reports, sound
from scene import added, compute, compute_or_not, ellipsoid, link, refuse, ring, select, suzanne


def test_nothing_selected():
    refuse("Select a mesh, point cloud, curve, .*; nothing is selected")


@pytest.mark.parametrize("add", ["camera_add", "empty_add", "light_add"])
def test_wrong_type(add):
    getattr(bpy.ops.object, add)()
    refuse("Select a mesh, point cloud, curve, .*; .* is of type")


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_not_finite_says_which_row(value):
    points = np.random.default_rng(3).normal(size=(50, 3))
    points[17, 1] = value
    link("Broken", points)
    assert "17" in refuse("'Broken': ")


def test_transform_that_is_not_finite():
    source = ellipsoid()
    source.parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(source.parent)
    source.matrix_parent_inverse[0][0] = np.nan
    refuse("'Ellipsoid': Expected a finite transform, found NaN")


def test_cloud_far_from_the_origin():
    moved = link("Moved", np.random.default_rng(8).normal(size=(80, 3)))
    moved.location = (1e6, 1e6, 1e6)
    result = compute(side="BOTH")
    sound(result)
    assert np.abs(positions(result.data)).max() < 1e5  # the offset stays in the matrix


def test_empty_result_leaves_an_older_one_untouched(capfd):
    result = compute(ellipsoid(), select_result=False)
    count = len(result.data.polygons)
    assert compute_or_not(criteria="RATIO", rho=1e9) == {"CANCELLED"}
    assert len(result.data.polygons) == count and result["ma_criteria"] == "ANGLE_OR_RATIO"
    assert any("no facet passes" in text for kind, text in reports(capfd) if kind == "Warning")


@pytest.mark.parametrize("chosen", ["result", "source"])
def test_a_source_hidden_by_h_is_read_as_it_was_seen(chosen):
    """H hides and deselects; the source stays active, and buttons act on what is still shown of it."""
    source = ellipsoid()
    source.modifiers.new("Subdivision", "SUBSURF").levels = 1
    result = compute()
    points = result["ma_points"]
    source.hide_set(True)
    select(*([result] if chosen == "result" else []))
    bpy.context.view_layer.objects.active = {"result": result, "source": source}[chosen]
    for operator in ("thickness", "armature", "sampling_report"):
        assert getattr(bpy.ops.object, f"medial_axis_{operator}").poll(), operator
    compute(select_result=False)
    assert result["ma_points"] == points and "ma_source_state" in result
    assert source.hide_get() and len(medial_objects()) == 1
    result.hide_set(True)
    select()
    bpy.context.view_layer.objects.active = source
    refuse("nothing is selected")


def noise():
    return link("Noise", np.random.default_rng(2).normal(size=(300, 3)))


REPORT = {"target": "SOURCE", "sampling": "SURFACE", "samples": 1_500}
# The object that there is, the operator with its options, and a part of the sentence with which it refuses.
REFUSED = {
    "flat text": ("object.text", "object.medial_axis", {}, "'Text': .*one plane; give them thickness"),
    "curve": ("curve.bezier_circle", "object.medial_axis", {},
              "'B.zierCircle': Expected faces, found only lines; give the object a surface"),
    "parts of a curve": (ring, "medial_axis_skeleton", {"parts": True}, "turn Parts off"),
    "hollow plane": ("plane", "medial_axis_hollow", {"wall": 0.1}, "one plane; give them"),
    "sheets of a block": ("cube", "medial_axis_unsolidify", {"samples": 4000}, "found none"),
    "noise": (noise, "tight_cocone_surface", {}, "'Noise': .*found nothing enclosed"),
    "report with a modifier": (suzanne, "medial_axis_sampling_report", REPORT,
                               "as many vertices with modifiers as without"),
    "report of a metaball": ("object.metaball", "medial_axis_sampling_report", REPORT, "found an object of type Meta"),
    "thicken without a limit": ("cube", "medial_axis_thicken", {"limit": 0.0}, "Expected a limit above 0"),
    "thicken a modifier": (suzanne, "medial_axis_thicken", {"limit": 0.1}, "Expected modifiers that keep the vertices"),
    "thicken an open mesh": ("plane", "medial_axis_thicken", {"limit": 0.1}, "Expected"),
    "thicken a curve": ("curve.bezier_circle", "medial_axis_thicken", {"limit": 0.1}, "Expected a mesh of this file"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_made_is_told_and_nothing_is_left(case):
    make, operator, options, words = REFUSED[case]
    source = added(make) if isinstance(make, str) else make()
    before = len(source.modifiers), len(bpy.data.node_groups)
    refuse(words, operator, **options)
    assert (len(source.modifiers), len(bpy.data.node_groups)) == before
