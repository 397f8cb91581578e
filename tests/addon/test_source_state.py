# SPDX-License-Identifier: GPL-3.0-or-later
"""A result whose source has changed since says so, and one whose source is as it was does not."""

import bpy
import numpy as np
import pytest
from installed import addon
from scene import added, compute, ellipsoid, press, select, torus


def has_changed(output):
    bpy.context.view_layer.update()
    state = addon("bridge.objects.source_state")
    state._checked.clear()
    return state.has_changed(output, bpy.context.view_layer.depsgraph)


def computed(**settings):
    source = ellipsoid(segments=4)
    return source, compute(**settings)


def test_a_source_that_is_as_it_was():
    source, result = computed()
    assert not has_changed(result)
    source.location, source.rotation_euler = (3, 1, -2), (0.4, 0.2, 0.9)
    source.name = "Renamed"
    source.data.attributes.new("mine", "FLOAT", "POINT")
    assert not has_changed(result)


def move_a_vertex(source):
    source.data.vertices[7].co.x += 1e-5
    source.data.update()


CHANGES = {
    "moved vertex": move_a_vertex,
    "flipped": lambda source: source.data.flip_normals(),
    "modifier": lambda source: setattr(source.modifiers.new("Wave", "DISPLACE"), "strength", 0.01),
    "scale": lambda source: setattr(source, "scale", (2, 1, 1)),
    "even scale": lambda source: setattr(source, "scale", (1.01, 1.01, 1.01)),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_source(change):
    source, result = computed()
    CHANGES[change](source)
    assert has_changed(result)
    if change != "flipped":  # an axis of the inside needs faces that look outward
        assert compute(source) == result and not has_changed(result)


def test_a_change_that_is_taken_back():
    source, result = computed()
    before = source.data.vertices[7].co.copy()
    move_a_vertex(source)
    assert has_changed(result)
    source.data.vertices[7].co = before
    source.data.update()
    assert not has_changed(result)


def test_edit_mode_and_a_hidden_source_tell_nothing():
    source, result = computed()
    move_a_vertex(source)
    source.hide_viewport = True
    assert not has_changed(result)
    source.hide_viewport = False
    select(source)
    bpy.ops.object.mode_set(mode="EDIT")
    assert not has_changed(result)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert has_changed(result)


def change_curve(data):
    data.splines[0].bezier_points[0].radius = 0.7


def change_surface(data):
    data.splines[0].points[0].co.z += 0.2


KINDS = {
    "curve.bezier_circle": change_curve,
    "surface.nurbs_surface_torus": change_surface,
    "object.text": lambda data: setattr(data, "body", "Other"),
    "object.metaball": lambda data: setattr(data.elements[0], "radius", 1.7),
}


@pytest.mark.parametrize("kind", KINDS)
def test_sources_of_other_types(kind):
    source = added(kind)
    data = source.data
    if kind == "object.metaball":
        data.elements.new().co.x = 1.5
    elif "surface" not in kind:
        data.bevel_depth = data.extrude = 0.1
    result = compute(form="CLEAN", sampling="SURFACE")
    assert not has_changed(result)
    source.location.x += 1
    assert not has_changed(result)
    if kind != "object.metaball":
        depth, data.extrude = data.extrude, 0.3
        assert has_changed(result)
        data.extrude = depth
        assert not has_changed(result)
    KINDS[kind](data)
    assert has_changed(result)


def test_thickness_skeleton_and_balls_know_their_source():
    source = ellipsoid(segments=4)
    bpy.ops.object.medial_axis_thickness(select_result=False, sampling="SURFACE")
    bpy.ops.object.medial_axis_skeleton(select_result=False)
    bpy.ops.object.medial_axis_balls(select_result=False)
    source_of = addon("bridge.objects.output_object").source_of
    made = [thing for thing in bpy.data.objects if source_of(thing) == source]
    assert len(made) == 3 and not any(map(has_changed, made))
    move_a_vertex(source)
    assert all(map(has_changed, made))


def test_binding_to_bones_changes_nothing_and_a_pose_does():
    _, result = computed()
    bpy.ops.object.medial_axis_armature(select_result=False)
    assert not has_changed(result)
    armature = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    armature.pose.bones[0].rotation_mode = "XYZ"
    armature.pose.bones[0].rotation_euler = (0.5, 0, 0)
    assert has_changed(result)


def test_a_scaled_source_does_not_stretch_its_axis():
    """Radii are lengths of the world."""
    source, result = computed()
    before = np.array(result.matrix_world)
    for factor in ((2, 1, 1), (0.5, 3, 1), (1, 1, 1)):
        source.scale = factor
        bpy.context.view_layer.update()
        assert np.allclose(np.array(result.matrix_world), before, atol=1e-6)
    source.location = (1, 2, 3)
    bpy.context.view_layer.update()
    assert np.allclose(np.array(result.matrix_world)[:3, 3] - before[:3, 3], (1, 2, 3), atol=1e-6)


def test_what_was_rebuilt_or_reduced_follows_as_the_axis_does():
    source, result = computed(form="CLEAN", side="INNER")
    press("medial_axis_rebuild", result)
    press("medial_axis_reduce", result, vertices=10)
    rebuilt = addon("bridge.rebuilt_object").rebuilt_of(result)
    reduced = addon("bridge.axis.reduced_object").reduced_of(source)
    source.location, source.rotation_euler = (1.5, -2, 0.5), (0.3, 0.2, 0.1)
    bpy.context.view_layer.update()
    for made in (rebuilt, reduced):
        assert made.parent == source
        assert np.allclose(np.array(made.matrix_world), np.array(result.matrix_world), atol=1e-6)
    assert "ma_color" in reduced.data.attributes


def other_values(option):
    """Values of an option that are not its default."""
    if hasattr(option, "items"):
        return [member.name for member in option.items if member is not option.default]
    if isinstance(option.default, bool):
        return [not option.default]
    return [option.minimum + (option.default - option.minimum) / 2 or option.soft_maximum / 4]


def test_settings_that_need_another_analysis_are_those_that_were_not_asked_for():
    properties, settings = addon("ui.settings.properties"), addon("core.settings")
    panel = bpy.context.scene.medial_axis
    source = torus()

    def answer():
        button = {name: getattr(panel, name) for name in settings.OPTIONS}
        return press("medial_axis", source, **button)

    panel.samples, panel.form, panel.crisp = 600, "PUBLISHED", False
    result = answer()
    for name in settings.ANALYSED:
        for value in other_values(settings.OPTIONS[name]):
            before = getattr(panel, name)
            setattr(panel, name, type(before)(value))
            if (name, value) == ("side", "INNER"):  # as Automatic
                assert not properties.needs_analysis(result, panel)
                continue
            assert properties.needs_analysis(result, panel), name
            if value != "NORMALS":  # it has none
                assert not properties.needs_analysis(answer(), panel), name
            setattr(panel, name, before)
            result = answer()
    panel.theta = 0.9
    assert not properties.needs_analysis(result, panel)
    for name in ("samples", "form", "crisp", "theta"):
        panel.property_unset(name)
    del result["ma_asked"]  # as of an earlier version
    assert not properties.needs_analysis(result, panel)


def test_what_automatic_turns_on_by_itself_is_no_change_of_settings():
    """Between walls that nearly touch, samples lie in pairs on flat faces, whatever was asked."""
    properties, panel = addon("ui.settings.properties"), bpy.context.scene.medial_axis
    source = added("cylinder", vertices=64, radius=1.0, depth=0.01)
    source.data.polygons.foreach_set("use_smooth", [True] * len(source.data.polygons))
    result = press("medial_axis")
    assert result["ma_pairs"] and not panel.pairs
    assert not properties.needs_analysis(result, panel)
