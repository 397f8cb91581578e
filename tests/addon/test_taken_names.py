# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that are taken, and groups and properties that were changed, give one sentence or a whole result."""

import bpy
import pytest
from installed import addon
from measure import attribute
from scene import compute, ellipsoid, press, refuse, torus


def test_a_vertex_group_with_the_name_of_an_attribute_is_named():
    """Blender once made an attribute by another name, which nothing reads, or none at all."""
    source = ellipsoid(segments=6)
    source.vertex_groups.new(name="ma_thickness").add([0], 1.0, "REPLACE")
    taken, vertices = "Expected the name 'ma_thickness' to be free", {"sampling": "VERTICES"}
    refuse(taken, "medial_axis_thickness", **vertices)
    assert not [a.name for a in source.data.attributes if a.name.startswith("ma_thickness.")]
    source.vertex_groups[0].name = "mine"
    press("medial_axis_thickness", **vertices)
    assert attribute(source.data, "ma_thickness").min() > 0


def test_a_changed_group_of_wires_does_not_end_later_computations():
    compute(torus(), form="CLEAN", side="INNER")
    group = bpy.data.node_groups["Medial Axis Wires"]
    if hasattr(group, "interface"):
        group.interface.clear()
    else:
        group.inputs.clear()
    group.nodes.clear()
    result = compute(torus("Second"), form="CLEAN", side="INNER")
    assert result["ma_analysis"] and result.modifiers[0].node_group != group
    assert addon("bridge.nodes.wires").width_of(result.modifiers[0]) is not None


CRAFTED = {"ma_form": "X", "ma_theta": "abc", "ma_side": 7}
CRAFTED |= {"ma_rho": [1.0, 2.0], "ma_box": [1.0, 2.0]}


@pytest.mark.parametrize(("name", "value"), CRAFTED.items())
def test_crafted_properties_do_not_stop_the_sliders(name, value):
    source, panel = ellipsoid(), bpy.context.scene.medial_axis
    result = compute()
    result[name] = value
    panel.theta = 0.35
    panel.theta = 0.3
    assert "Traceback" not in panel.note
    assert 0 < addon("bridge.axis.axis_object").settings_of(result).theta < 1.6
    compute(source)
