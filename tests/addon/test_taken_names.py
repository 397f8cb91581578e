# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that are taken, and groups and properties that were changed, give one sentence or a whole result."""

import bpy
import pytest
from installed import addon
from measure import attribute, contents, result_of
from scene import compute, ellipsoid, select, torus


def test_a_vertex_group_with_the_name_of_an_attribute_is_named():
    """Blender once made an attribute by another name, which nothing reads, or none at all."""
    source = ellipsoid(segments=6)
    source.vertex_groups.new(name="ma_thickness").add([0], 1.0, "REPLACE")
    before = contents()
    with pytest.raises(RuntimeError, match="Expected the name 'ma_thickness' to be free") as caught:
        bpy.ops.object.medial_axis_thickness(sampling="VERTICES")
    assert "Traceback" not in str(caught.value) and contents() == before
    assert not [a.name for a in source.data.attributes if a.name.startswith("ma_thickness.")]
    source.vertex_groups[0].name = "mine"
    assert bpy.ops.object.medial_axis_thickness(sampling="VERTICES") == {"FINISHED"}
    assert attribute(source.data, "ma_thickness").min() > 0


def test_a_changed_group_of_wires_does_not_end_later_computations():
    compute_of(torus())
    group = bpy.data.node_groups["Medial Axis Wires"]
    if hasattr(group, "interface"):
        group.interface.clear()
    else:
        group.inputs.clear()
    group.nodes.clear()
    source = torus("Second")
    compute_of(source)
    result = result_of(source)
    assert result["ma_analysis"] and result.modifiers[0].node_group != group
    assert addon("bridge.nodes.wires").width_of(result.modifiers[0]) is not None


def compute_of(source):
    compute(source, form="CLEAN", side="INNER")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("ma_form", "X"),
        ("ma_theta", "abc"),
        ("ma_side", 7),
        ("ma_rho", [1.0, 2.0]),
        ("ma_box", [1.0, 2.0]),
    ],
)
def test_crafted_properties_do_not_stop_the_sliders(name, value):
    source = ellipsoid()
    result = compute()
    result[name] = value
    panel = bpy.context.scene.medial_axis
    select(result)
    panel.theta = 0.35
    panel.theta = 0.3
    assert "Traceback" not in panel.note
    settings = addon("bridge.axis.axis_object").settings_of(result)
    assert 0 < settings.theta < 1.6
    compute(source)
