# SPDX-License-Identifier: GPL-3.0-or-later
"""The groups of Geometry Nodes: what they make of an axis, in this Blender as in any other."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from installed import MODULE, addon, program, succeeded
from measure import attribute, evaluated, instances, positions, volume
from scene import compute, ellipsoid, link, press, refuse, torus, with_radii

KEYS = ("FILTER", "BALLS", "REBUILD", "COLOUR")


def groups():
    return addon("bridge.nodes.groups")


def with_group(thing, key, **values):
    """A modifier of the group on an object, with values of its inputs by name."""
    modifier = groups().add_modifier(thing, key)
    set_inputs(modifier, **{name.replace("_", " "): value for name, value in values.items()})
    return modifier


def set_inputs(modifier, **values):
    addon("bridge.nodes.inputs").set_inputs(modifier, values)


# --- every group


@pytest.mark.parametrize("key", KEYS)
def test_a_group_is_built_once_and_its_inputs_are_explained(key):
    one = groups().group(key)
    assert groups().group(key) == one
    sockets = (
        [s for s in one.interface.items_tree if s.in_out == "INPUT"]
        if hasattr(one, "interface")
        else list(one.inputs)
    )
    assert sockets[0].name == "Geometry"
    assert all(socket.description for socket in sockets[1:])
    assert all(link.is_valid for link in one.links)
    assert not hasattr(one, "is_modifier") or one.is_modifier


def test_a_value_of_an_input_is_read_back():
    modifier = with_group(ellipsoid(), "REBUILD", Factor=0.5)
    read = addon("bridge.nodes.inputs").input_of
    assert read(modifier, "Factor") == 0.5 and read(modifier, "Merge") == 1.0


# --- Filter


@pytest.mark.parametrize(
    ("theta", "rho", "criteria"),
    [(np.pi / 8, 8.0, "ANGLE_OR_RATIO"), (np.pi / 6, 0.0, "ANGLE"), (0.0, 5.0, "RATIO")],
)
def test_filter_selects_what_the_thresholds_select(theta, rho, criteria):
    result = compute(torus(), theta=theta, rho=rho, criteria=criteria, side="INNER")
    expected = len(result.data.polygons)
    compute(theta=0.0, rho=0.0, side="INNER")
    everything = len(result.data.polygons)
    modifier = with_group(result, "FILTER")
    assert len(evaluated(result).polygons) == everything
    set_inputs(modifier, Theta=theta, Rho=rho)
    mesh = evaluated(result)
    assert len(mesh.polygons) == expected < everything
    assert len(mesh.vertices) == len({v for face in mesh.polygons for v in face.vertices})
    assert "ma_alone" not in mesh.attributes


def test_filter_by_sheet_erosion_and_radius():
    result = compute(ellipsoid(), form="CLEAN", side="INNER")
    modifier = with_group(result, "FILTER")
    for label in ("Sheet", "Erosion"):
        values = attribute(result.data, f"ma_{label.lower()}")
        limit = float(np.median(values))
        set_inputs(modifier, **{"Sheet": 0.0, "Erosion": 0.0, label: limit})
        assert len(evaluated(result).polygons) == (values >= np.float32(limit)).sum()
    radius = attribute(result.data, "ma_radius")
    mean = np.array([radius[list(face.vertices)].mean() for face in result.data.polygons])
    limit = float(np.median(mean)) * 1.001
    set_inputs(modifier, Erosion=0.0, Radius=limit)
    assert len(evaluated(result).polygons) == (mean >= limit).sum() > 0


def test_filter_by_limb_takes_wires_only():
    result = compute(torus(), form="CURVE", limb=0.0, side="INNER")
    limb = attribute(result.data, "ma_limb")
    assert len(np.unique(limb)) > 2
    limit = float(np.median(limb[limb > 0]))
    modifier = with_group(result, "FILTER")
    tubes = addon("bridge.nodes.wires").wires_of(result)
    assert list(result.modifiers) == [modifier, tubes], "what shows wires comes last"
    tubes.show_viewport = False
    assert len(evaluated(result).edges) == len(result.data.edges)
    set_inputs(modifier, Limb=limit)
    kept = evaluated(result)
    faces_edges = len({edge for face in result.data.polygons for edge in face.edge_keys})
    assert len(kept.edges) == faces_edges + (limb[faces_edges:] >= np.float32(limit)).sum()
    assert len(kept.polygons) == len(result.data.polygons)


# --- Balls


def two_balls():
    """Vertices with radii 1 and 0.5, ten apart."""
    return with_radii(link("Two", [(0, 0, 0), (10, 0, 0)]), [1.0, 0.5])


def test_balls_are_as_large_as_the_radii():
    thing = two_balls()
    modifier = with_group(thing, "BALLS")
    for values, sizes in (
        ({}, [0.5, 1.0]),
        ({"Factor": 2.0, "Offset": -1.25}, [0.75]),
        ({"Factor": 1.0, "Offset": 0.0, "Min Radius": 0.6}, [1.0]),
    ):
        set_inputs(modifier, **values)
        assert sorted(scale[0] for scale in instances(thing)) == pytest.approx(sizes)


def test_balls_merge():
    result = compute(ellipsoid(), side="INNER")
    modifier = with_group(result, "BALLS")
    assert len(instances(result)) == len(result.data.vertices)
    set_inputs(modifier, Merge=0.1)
    assert 0 < len(instances(result)) < len(result.data.vertices) / 4


# --- Rebuild


def ball_volume(radius):
    return 4 / 3 * np.pi * radius**3


@pytest.mark.parametrize(("factor", "offset"), [(1.0, 0.0), (1.0, 0.3), (1.0, -0.3), (0.5, 0.1)])
def test_rebuild_of_a_ball_has_its_volume(factor, offset):
    thing = two_balls()
    with_group(thing, "REBUILD", Min_Radius=0.6, Voxel=0.03, Factor=factor, Offset=offset)
    found = volume(evaluated(thing))
    assert found == pytest.approx(ball_volume(factor + offset), rel=0.02)


def test_rebuilt_balls_have_the_colours_of_their_radii():
    thing = two_balls()
    with_group(thing, "REBUILD", Voxel=0.2)
    mesh, scale = evaluated(thing), addon("core.axis.colours").SCALE
    large = positions(mesh)[:, 0] < 5
    for rows, (_, colour) in ((large, scale[0]), (~large, scale[-1])):
        np.testing.assert_allclose(colours(mesh)[rows], [colour] * rows.sum(), atol=0.01)
    assert 0 < large.sum() < len(large)


# --- Thickness Colour


def test_colour_goes_from_the_first_to_the_last_colour():
    thing = two_balls()
    modifier = with_group(thing, "COLOUR")
    scale = addon("core.axis.colours").SCALE
    found = colours(evaluated(thing))
    assert found[1] == pytest.approx(scale[0][1], abs=0.01)
    assert found[0] == pytest.approx(scale[-1][1], abs=0.01)
    set_inputs(modifier, Start=0.5, End=1.5)
    assert colours(evaluated(thing))[0] != pytest.approx(scale[-1][1], abs=0.01)


def colours(mesh):
    """(n, 3) of `ma_color`."""
    return attribute(mesh, "ma_color")[:, :3]


# --- the menu, the library, and files without the add-on


def test_the_menu_adds_a_group_to_the_axis_of_the_active_object():
    source = ellipsoid()
    refuse("Select a medial axis", "medial_axis_nodes", group="BALLS")
    result = compute(side="INNER", select_result=False)
    for _ in range(2):
        press("medial_axis_nodes", group="BALLS")
    assert [one.node_group for one in result.modifiers] == 2 * [groups().group("BALLS")]
    assert not source.modifiers and len(bpy.data.node_groups) == 1


def libraries():
    return [(one.name, Path(one.path)) for one in bpy.context.preferences.filepaths.asset_libraries]


def test_the_library_is_registered_and_is_gone_when_the_add_on_is_disabled():
    before = libraries()
    folder = Path(addon().__file__).parent / "nodes"
    assert bpy.ops.wm.medial_axis_asset_library() == {"FINISHED"}
    assert libraries() == [*before, ("Medial Axis", folder)]
    assert bpy.ops.wm.medial_axis_asset_library() == {"FINISHED"}
    assert libraries() == before
    bpy.ops.wm.medial_axis_asset_library()
    bpy.ops.preferences.addon_disable(module=MODULE)
    try:
        assert libraries() == before
    finally:
        bpy.ops.preferences.addon_enable(module=MODULE)


def test_the_library_is_small_and_holds_all_groups_in_the_catalogue():
    module, folder = groups(), Path(addon().__file__).parent / "nodes"
    file = folder / module.FILE
    assert file.stat().st_size < 300_000
    catalogue = (folder / module.CATALOGUE_FILE).read_text(encoding="utf-8")
    assert f"\n{module.CATALOGUE}:Medial Axis:" in catalogue
    with bpy.data.libraries.load(str(file), assets_only=True) as (there, wanted):
        wanted.node_groups = list(there.node_groups)
    names = {group.name for group in module.GROUPS.values()}
    assert {one.name for one in wanted.node_groups} == names
    assert {one.asset_data.catalog_id for one in wanted.node_groups} == {module.CATALOGUE}


def test_groups_of_the_library_evaluate_like_those_that_are_built():
    thing = two_balls()
    assert len(instances(modified(thing, "BALLS", False))) == 2
    assert len(instances(modified(thing, "BALLS", True))) == 2
    made = modified(thing, "REBUILD", True, **{"Min Radius": 0.6, "Voxel": 0.03})
    assert volume(evaluated(made)) == pytest.approx(ball_volume(1.0), rel=0.02)


def modified(thing, key, of_library, **values):
    """The object with one modifier alone: a group that is built, or that of the library."""
    thing.modifiers.clear()
    modifier = groups().add_modifier(thing, key)
    if of_library:
        file = Path(addon().__file__).parent / "nodes" / groups().FILE
        with bpy.data.libraries.load(str(file)) as (_, wanted):
            wanted.node_groups = [groups().GROUPS[key].name]
        modifier.node_group = wanted.node_groups[0]
    set_inputs(modifier, **values)
    return thing


COUNT = """
import bpy
graph = bpy.context.evaluated_depsgraph_get()
thing = bpy.data.objects["Two"]
assert not any("medial" in addon.module for addon in bpy.context.preferences.addons)
print("COUNTED", len(thing.evaluated_get(graph).data.polygons))
"""


def test_a_file_evaluates_without_the_add_on(tmp_path):
    thing = two_balls()
    with_group(thing, "REBUILD", Min_Radius=0.6, Voxel=0.1)
    expected, file = len(evaluated(thing).polygons), tmp_path / "two.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    words = [program(), "--background", "--factory-startup", str(file), "--python-expr", COUNT]
    assert f"COUNTED {expected}\n" in succeeded(words)
    assert expected > 100
