# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender's window: plays one scene with mouse and keyboard, and asserts on the data.

A scene is a generator; what it yields is how many seconds Blender's own loop runs before it goes
on, or a function to wait for.
"""

import contextlib
import json
import os
import subprocess
import sys
import threading
import time
import traceback
from functools import partial
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Matrix

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from installed import MODULE, addon
from measure import analyses, medial_objects, positions
from scene import added, link, new_object, select

NAME, FOLDER = sys.argv[sys.argv.index("--") + 1 :][:2]
PATIENCE = 90.0
# (left, down) in pixels from the top right corner of the sidebar, as Blender 3.4 to 5.2 draw it.
TAB = (13, 177) if bpy.app.version < (5, 0) else (13, 254)  # below Blender's own tab Animation
COMPUTE = (102, 50)
THETA_LEFT, THETA_RIGHT = (112, 153), (78, 153)
SIMPLIFY_LEFT, SIMPLIFY_RIGHT = (120, 130), (50, 130)
# Headers of closed panels, 26 pixels one below the other, and what is in them when they alone are open.
SKELETON, THICKNESS = (150, 208), (150, 234)
RESULT, REBUILD = (150, 208), (150, 286)  # where there is a result
AUTO_UPDATE = (62, 208)  # in the header of the panel Result
EXTRACT_SKELETON, MAKE_ARMATURE = (102, 336), (102, 362)
MEASURE_THICKNESS, THICKEN = (102, 336), (102, 517)
REBUILD_SOLID, OTHERS = (102, 316), (49, 316)
FORM = (200, 95)
SHOW_COLOURS, BELOW_LEGEND, BOTTOM = (30, 222), (200, 330), (30, 600)


# --- hands and eyes


def window():
    return bpy.context.window_manager.windows[0]


def viewport():
    return next(area for area in window().screen.areas if area.type == "VIEW_3D")


def sidebar():
    return next(region for region in viewport().regions if region.type == "UI")


def at(place):
    """A place in the sidebar on the screen."""
    left, down = place
    region = sidebar()
    return region.x + region.width - left, window().height - (region.y + region.height) + down


def xdotool(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def point(x, y):
    xdotool("mousemove", x, y)
    yield 0.4
    xdotool("mousemove_relative", 1, 1)
    yield 0.4


def click(x, y):
    yield from point(x, y)
    xdotool("click", 1)
    yield 0.5


def drag(start, end):
    yield from point(*start)
    xdotool("mousedown", 1)
    yield 0.2
    for step in range(1, 9):
        xdotool("mousemove", *(a + (b - a) * step // 8 for a, b in zip(start, end, strict=True)))
        yield 0.15
    xdotool("mouseup", 1)
    yield 0.5


def in_viewport():
    """Operators run as if from the viewport."""
    area = viewport()
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window(), area=area, region=region)


def point_at_viewport():
    """The mouse is over the viewport, left of its middle."""
    area = viewport()
    yield from point(area.x + area.width // 4, window().height - (area.y + area.height // 3))


def key(name):
    """Press a key with the mouse over the viewport."""
    yield from point_at_viewport()
    xdotool("key", name)
    yield 0.8


def look(name):
    """Keep a picture of the screen; it must show something."""
    path = Path(FOLDER) / f"{NAME}-{name}.png"
    subprocess.run(["import", "-window", "root", str(path)], check=True)
    colours = subprocess.check_output(["identify", "-format", "%k", str(path)], text=True)
    assert int(colours) > 500, f"{path} shows {colours} colours only"


def look_after(seconds, name):
    """Keep a picture after a while, which Blender has for drawing."""
    yield patience(seconds)
    look(name)


def patience(seconds):
    """A limit for a machine that is not overloaded, stretched by how much it is."""
    return seconds * max(1.0, os.getloadavg()[0] / len(os.sched_getaffinity(0)))


# --- scenes


def open_tab():
    viewport().spaces.active.show_region_ui = True
    yield 1.0
    if getattr(sidebar(), "active_panel_category", "") != "Medial Axis":  # else a click folds it
        yield from click(*at(TAB))
    yield 0.5
    if hasattr(sidebar(), "active_panel_category"):  # from 4.2
        assert sidebar().active_panel_category == "Medial Axis", "the tab was missed"


def monkey():
    """Suzanne under a Subdivision Surface modifier instead of the default cube."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    mesh = bpy.data.meshes.new("Suzanne")
    with in_viewport():
        bpy.ops.mesh.primitive_monkey_add()
    bpy.data.meshes.remove(mesh)
    source = bpy.data.objects["Suzanne"]
    source.modifiers.new("Subdivision", "SUBSURF").levels = 1
    return on_stage(source)


def on_stage(source):
    """The source is selected, and undo goes back to here."""
    select(source)
    bpy.ops.ed.undo_push(message="Scene is set")
    return source


def cloud(count=1_200_000):
    """Points that keep the computer busy for many seconds."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    points = np.random.default_rng(9).normal(size=(count, 3))
    points *= np.array([1.0, 0.8, 0.6]) / np.linalg.norm(points, axis=1)[:, None]
    mesh = bpy.data.meshes.new("Cloud")
    mesh.vertices.add(count)
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.update()
    return on_stage(new_object("Cloud", mesh))


def job():
    return addon("ui.base.current_job").job()


def job_exists():
    return job() is not None


# A click begins a job at once; one that was refused has none to wait for.
job_exists.patience = 10.0


def job_runs():
    assert job() is not None, "the job ended before it was seen to run; was it refused?"
    return job().fraction > 0.02


def computed():
    """Click the button, and wait for the result."""
    yield from click(*at(COMPUTE))
    yield result_exists


def no_job():
    return job() is None


def result_exists():
    return bool(medial_objects()) and job() is None


def no_result():
    return medial_objects() == []


def threads():
    return [thread for thread in threading.enumerate() if thread.name == "medial axis"]


def nothing_is_left():
    is_surface = addon("bridge.surface_object").is_surface
    assert no_result() and threads() == [] and not any(map(is_surface, bpy.data.objects))
    assert not [m.name for m in (*bpy.data.meshes, *bpy.data.materials) if "Medial" in m.name]


def facets():
    return len(bpy.data.objects["Suzanne Medial Axis"].data.polygons)


def area():
    return sum(facet.area for facet in bpy.data.objects["Suzanne Medial Axis"].data.polygons)


def scene_compute_drag_undo():
    monkey()
    yield from open_tab()
    look("before")
    yield from computed()
    yield from look_after(0.5, "computed")
    assert [thing.name for thing in medial_objects()] == ["Suzanne Medial Axis"]
    assert bpy.context.window_manager.operators[-1].bl_idname == "OBJECT_OT_medial_axis"
    first, wide, before = facets(), area(), analyses()
    yield from click(145, 705)  # opens Adjust Last Operation at the lower left
    yield 1.0
    yield from drag((220, 291), (250, 291))  # its theta
    yield from look_after(1.0, "adjusted")
    adjusted = facets()
    assert 0 < adjusted != first and 0 < area() < wide and len(medial_objects()) == 1
    assert bpy.data.objects["Suzanne Medial Axis"]["ma_theta"] > 0.42  # it was pi / 8
    assert analyses() == before

    yield from drag(at(THETA_LEFT), at(THETA_RIGHT))
    look("dragged")
    dragged = facets()
    theta = bpy.context.scene.medial_axis.theta
    assert theta > 0.6, f"theta is {theta}: the slider was missed"
    assert bpy.data.objects["Suzanne Medial Axis"]["ma_theta"] == theta
    assert dragged != adjusted and analyses() == before

    yield from key("ctrl+z")
    assert abs(bpy.context.scene.medial_axis.theta - np.pi / 8) < 1e-6
    assert facets() == adjusted, "undo must bring the facets back, too"
    yield from key("ctrl+z")
    assert medial_objects() == [], "one undo must remove the result"
    look("undone")
    yield from key("ctrl+shift+z")
    assert facets() == adjusted, "redo must bring the result back"
    yield from key("ctrl+shift+z")
    assert facets() == dragged
    look("redone")
    assert analyses() == before


def scene_draft():
    """The first click shows a draft; Escape keeps it, then the exact axis takes its place, a step of undo each."""
    monkey()
    yield from open_tab()
    with held(addon("core.axis.compute"), "extract", 4_000):
        yield from click(*at(COMPUTE))
        yield medial_objects
        yield from look_after(1.0, "draft")
        assert job() is not None and medial_objects()[0]["ma_draft"]
        yield from key("Escape")
        yield no_job
    assert "draft stays" in bpy.context.scene.medial_axis.note
    few = facets()
    yield from look_after(0.5, "kept")
    yield from key("ctrl+z")
    assert medial_objects() == []
    yield from key("ctrl+shift+z")
    assert facets() == few
    yield from click(*at(COMPUTE))
    yield lambda: no_job() and "ma_draft" not in medial_objects()[0]
    yield from look_after(0.5, "exact")
    assert facets() > few
    yield from key("ctrl+z")
    assert facets() == few and medial_objects()[0]["ma_draft"]


def scene_sliders_with_escape():
    """Simplify runs over what can go; of a large result it acts in the thread, and Escape leaves the old one."""
    monkey()
    yield from open_tab()
    yield from computed()
    yield patience(1.0)
    show_colours()
    panel, name = bpy.context.scene.medial_axis, "Suzanne Medial Axis"
    whole = facets()
    yield from drag(at(SIMPLIFY_LEFT), at(SIMPLIFY_RIGHT))
    yield from look_after(0.7, "dragged")
    assert 0.0 < panel.simplify_share < 100.0, f"the slider was missed: {panel.simplify_share}"
    assert bpy.data.objects[name]["ma_simplify"] == panel.simplify > 0.0
    assert facets() < whole
    yield from key("ctrl+z")
    assert facets() == whole and bpy.context.scene.medial_axis.simplify_share == 0.0

    later = addon("ui.settings.apply_later")
    later.SAMPLES = 0  # every result is large
    yield from drag(at(SIMPLIFY_LEFT), at(SIMPLIFY_RIGHT))
    yield no_update
    yield from look_after(1.0, "dragged-in-the-thread")
    panel = bpy.context.scene.medial_axis
    dragged = facets()
    assert dragged < whole and bpy.data.objects[name]["ma_simplify"] == panel.simplify
    yield from key("ctrl+z")
    yield no_update
    assert facets() == whole, "undo must bring back the mesh that the slider had"
    yield from key("ctrl+shift+z")
    yield no_update
    assert facets() == dragged, "redo must bring the mesh back with the slider"
    yield from key("ctrl+z")
    yield no_update
    assert facets() == whole
    with held(addon("core.axis.compute"), "extract"):
        bpy.context.scene.medial_axis.erode_share = 50.0
        yield job_exists
        yield from look_after(0.5, "in-the-thread")
        yield from key("Escape")
    yield no_update
    assert facets() == whole
    assert "cancelled" in bpy.context.scene.medial_axis.note
    bpy.context.scene.medial_axis.form = "CURVE"
    yield no_update
    yield from look_after(1.0, "curve")
    assert facets() == 0


def scene_panels_in_place():
    """Show Colours moves no row, also in the first drawing after it; another object and back leave all as it was."""
    cube, light = bpy.data.objects["Cube"], bpy.data.objects["Light"]
    select(cube)
    yield from open_tab()
    yield from computed()
    yield from point(viewport().x + 200, 300)  # away from the sidebar, where it would light a row
    yield from look_after(1.0, "result")
    show_colours()
    draw_once()
    look("colours")
    assert_same_below(FORM, SHOW_COLOURS, "result", "colours")
    assert_same_below(BELOW_LEGEND, BOTTOM, "result", "colours")
    for thing in (light, cube):
        select(thing)
        yield from look_after(2.0, thing.name)
    assert_same_below(FORM, BOTTOM, "colours", "Cube")


def draw_once():
    """One drawing of the window, and no event after it."""
    bpy.context.view_layer.update()
    with in_viewport():
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)


def assert_same_below(start, end, *names):
    """Two pictures show the same of the sidebar between two places."""
    seen = []
    for name in names:
        image = bpy.data.images.load(str(Path(FOLDER) / f"{NAME}-{name}.png"))
        pixels = np.array(image.pixels[:]).reshape(*reversed(image.size), 4)[::-1]
        (left, top), (right, bottom) = at(start), at(end)
        seen.append(pixels[top:bottom, left:right])
        bpy.data.images.remove(image)
    other = np.argwhere(np.abs(seen[0] - seen[1]) > 0.02)
    assert np.allclose(*seen, atol=0.02), f"{np.ptp(other, axis=0)}"


def scene_auto_update():
    """A result follows edits, undo, redo and another session; it waits where it should, and Escape stops it."""
    monkey().modifiers.clear()
    bpy.context.scene.medial_axis.sampling = "SURFACE"
    bpy.context.scene.medial_axis.samples = 2_000
    yield from open_tab()
    yield from computed()
    yield from look_after(1.0, "offered")  # the panel Result is open after the first computation
    yield from click(*at(AUTO_UPDATE))
    assert live_result().medial_axis_auto_update, "the switch was missed"
    yield from moves_need_nothing()
    yield from edit_mode_waits()
    yield from undo_is_followed()
    yield from coarse_comes_first()
    yield from escape_stops_it()
    yield from files_keep_it()
    yield from disabled_while_it_waits()
    yield from deleted_source_ends_it()


def moves_need_nothing():
    yield from key("g")
    xdotool("key", "x", "1", "Return")
    yield lambda: abs(live_result().matrix_world.translation.x - 1.0) < 1e-3
    yield from stays_without_job(1.5)


def stays_without_job(seconds):
    for _ in range(int(10 * seconds)):
        assert no_job(), "nothing should be computed now"
        yield 0.1


def edit_mode_waits():
    first = followed()
    yield from key("Tab")
    yield from key("s")
    xdotool("key", "x", "2", "Return")
    yield from stays_without_job(1.5)
    assert followed() == first
    yield from key("Tab")
    yield lambda: followed() > 1.5 * first and no_job()
    yield from look_after(0.7, "edited")
    assert not changed_since()
    for _ in range(3):  # out of edit mode, the scale, into edit mode
        yield from key("ctrl+z")
    yield lambda: abs(followed() - first) < 1e-3 and no_job()
    assert bpy.context.object.mode == "OBJECT" and not changed_since()


def undo_is_followed():
    """One stroke takes back one step of the artist; redo still knows it after the result has followed."""
    first, things = followed(), len(bpy.data.objects)
    yield from key("s")
    xdotool("key", "x", "2", "Return")
    yield lambda: followed() > 1.5 * first and no_job()
    for _ in range(2):
        yield from key("ctrl+z")
        assert bpy.context.object.scale.x == 1.0, "one stroke takes back one step"
        yield lambda: abs(followed() - first) < 1e-3 and no_job()
        yield from look_after(1.0, "undone")
        yield from key("ctrl+shift+z")
        assert bpy.context.object.scale.x == 2.0, "redo must know the step after an update"
        yield lambda: followed() > 1.5 * first and no_job()
    assert len(bpy.data.objects) == things and not changed_since()
    yield from look_after(1.0, "redone")


def coarse_comes_first():
    live_result()["ma_seconds"] = 5.0  # as if it were slow
    addon("core.samples.thinning").COARSE = 500
    bpy.context.object.scale.z = 1.5
    yield job_exists
    seen = set()
    while job() is not None:
        seen.add((live_result()["ma_points"], changed_since()))
        yield 0.05
    few = min(seen)
    assert few[0] < 1_000 < live_result()["ma_points"] and few[1] and not changed_since(), seen


def escape_stops_it():
    with held(addon("core.axis.compute"), "extract"):
        bpy.context.object.scale.y = 3.0
        yield job_exists
        yield from look_after(0.5, "in-the-thread")
        yield from key("Escape")
        yield no_job
    yield from stays_without_job(2.0)
    assert changed_since(), "what was cancelled is not begun again"
    look("cancelled")
    bpy.context.object.scale.y = 1.0
    yield 2.0
    yield no_job
    assert not changed_since()


def files_keep_it():
    path, first = str(Path(FOLDER) / "live.blend"), followed()
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
    yield from stays_without_job(2.0)
    assert live_result().medial_axis_auto_update and not changed_since()
    bpy.context.object.scale.x = 3.0
    yield lambda: followed() > 1.2 * first and no_job()


def disabled_while_it_waits():
    """An edit that waits is dropped with the add-on, and found again when that comes back."""
    first = followed()
    before = bpy.app.handlers.depsgraph_update_post[:]
    bpy.context.object.scale.x = 1.0
    yield 0.2
    bpy.ops.preferences.addon_disable(module=MODULE)
    yield 1.5
    assert followed() == first and threads() == []
    assert len(bpy.app.handlers.depsgraph_update_post) == len(before) - 1
    bpy.ops.preferences.addon_enable(module=MODULE)
    yield lambda: followed() < 0.7 * first and no_job()


def deleted_source_ends_it():
    with held(addon("core.axis.compute"), "extract"):
        bpy.context.object.scale.y = 2.0
        yield job_exists
        bpy.data.objects.remove(bpy.context.object)
        yield no_job
    yield 2.0
    assert job() is None and not bpy.context.scene.medial_axis.note
    assert addon("ui.axis.auto_update")._after_update not in bpy.app.handlers.depsgraph_update_post
    yield from look_after(0.5, "deleted")


def live_result():
    return bpy.data.objects["Suzanne Medial Axis"]


def followed():
    """How wide the result is in X."""
    return float(np.ptp(positions(live_result().data)[:, 0]))


def changed_since():
    differs = addon("bridge.objects.source_state").differs
    return differs(live_result(), bpy.context.view_layer.depsgraph)


def no_update():
    return no_job() and not addon("ui.settings.apply_later").waits()


@contextlib.contextmanager
def held(module, name, most=0):
    """A function of a module that waits until its progress is cancelled; not where so many samples are asked for."""
    kept = getattr(module, name)

    def wait(samples, settings, progress=None, *others):
        if settings.samples <= most:
            return kept(samples, settings, progress, *others)
        while not progress.cancelled:
            time.sleep(0.05)
        raise addon("core.errors").Cancelled("cancelled")

    setattr(module, name, wait)
    try:
        yield
    finally:
        setattr(module, name, kept)


def start_long_run():
    """Click the button; returns when the job runs, without a draft, and the picture was taken."""
    addon("core.samples.thinning").COARSE = 10**9
    yield from open_tab()
    yield from click(*at(COMPUTE))
    yield job_exists
    yield job_runs
    assert medial_objects() == []


def data(name):
    """A function that makes an object of an optional mesh, or None where it is absent."""

    def make():
        path = Path(os.environ.get("MEDIAL_AXIS_TEST_DATA", "")) / name
        if not path.is_file():
            return None
        shape, _ = addon("core.files.read_shape").read_shape(path)
        return link(path.stem, shape.points, shape.triangles)

    return make


def text():
    """Letters that have a thickness."""
    thing = added("object.text", rotation=(1.2, 0.0, 0.0))
    thing.data.body, thing.data.extrude, thing.data.bevel_depth = "Axis", 0.15, 0.02
    return thing


MODELS = {
    "cube": partial(added, "cube"),
    "torus": partial(added, "torus"),
    "suzanne": partial(added, "monkey"),
    "text": text,
    "hand": data("hand_closed.obj"),
    "dilo": data("dilo.off"),
    "igea": data("igea.ply"),
    "scan": data("distcap.xyz"),
}


def scene_first_glance():
    """Each model as a newcomer meets it: the panel, one click, Show Colours; and nothing of his is changed."""
    yield from open_tab()
    shading = viewport().spaces.active.shading
    for name, make in MODELS.items():
        bpy.data.batch_remove(bpy.data.objects)
        with in_viewport():
            source = make()
        if source is None:
            continue
        select(source)
        frame_selected()
        yield from look_after(0.7, f"{name}-1-before")
        kept = shading.type, shading.color_type
        yield from computed()
        yield from look_after(1.0, f"{name}-2-computed")
        (result,) = medial_objects()
        assert bpy.context.selected_objects == [source] == [bpy.context.object]
        assert (shading.type, shading.color_type) == kept, "nobody pressed Show Colours"
        assert result.parent == source and "ma_color" in result.data.color_attributes
        show_colours()
        yield from look_after(0.7, f"{name}-3-colours")
        assert (shading.type, shading.color_type) == ("SOLID", "VERTEX")
        show_colours()
        assert (shading.type, shading.color_type) == kept


def show_colours():
    with in_viewport():
        assert bpy.ops.view3d.medial_axis_show_colours() == {"FINISHED"}


def scene_tutorial():
    """The pictures of docs/tutorial.md, in their order."""
    source, panel = monkey(), bpy.context.scene.medial_axis
    source.modifiers["Subdivision"].levels = 2
    turn_to_the_front()
    yield from open_tab()
    yield from look_after(0.5, "01")  # where the panel is
    bpy.context.preferences.addons[MODULE].preferences.guided = True
    yield 0.5
    yield from computed()
    yield from look_after(1.5, "02")  # one click
    show_colours()
    yield from look_after(0.7, "03")
    source.hide_set(True)
    yield from look_after(0.7, "04")
    with in_viewport():  # where active_object is None now, and object is not
        assert bpy.ops.export_scene.medial_axis.poll() and bpy.ops.object.medial_axis_rebuild.poll()
    source.hide_set(False)
    select(source)
    panel.simplify = 4.0
    yield from look_after(1.5, "05")
    panel.form = "CURVE"
    yield from look_after(1.5, "06")
    source.rotation_euler.z += 0.8
    source.location.x += 0.6
    yield from look_after(1.5, "07")  # it follows
    panel.form, panel.simplify = "CLEAN", 0.0
    panel.side = "OUTER"
    yield from click(*at(COMPUTE))
    yield no_job
    yield from look_after(1.5, "08")
    panel.side = "AUTOMATIC"
    bpy.data.batch_remove([*medial_objects(), source])
    with in_viewport():
        bpy.ops.mesh.primitive_torus_add(major_segments=192, minor_segments=64, minor_radius=0.35)
    # A stretch makes the ring flat, so that its rims are hard to sample.
    bpy.context.object.data.transform(Matrix.Diagonal((1.2, 0.9, 0.4, 1.0)))
    yield 0.7
    with in_viewport():
        assert bpy.ops.object.medial_axis_sampling_report() == {"FINISHED"}
    yield from look_after(1.5, "09")
    yield from computed()
    yield from look_after(1.5, "10")


def turn_to_the_front():
    """The viewport looks at what is selected, a little from the side."""
    viewport().spaces.active.region_3d.view_rotation = Euler((1.35, 0.0, 0.45)).to_quaternion()
    frame_selected()


def branches():
    """A Y of three tubes, as one mesh."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    ends = [(0, 0, 0), (0, 0, -1.6), (-1.2, 0, 1.2), (1.2, 0, 1.2)]
    wire = link("Wire", ends, edges=[(0, 1), (0, 2), (0, 3)])
    wire.modifiers.new("Skin", "SKIN")
    wire.modifiers.new("Subdivision", "SUBSURF").levels = 3
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(wire.evaluated_get(depsgraph))
    source = new_object("Branches", mesh)
    bpy.data.objects.remove(wire)
    select(source)
    turn_to_the_front()
    return on_stage(source)


def scene_what_comes_after():
    """Skeleton, armature, thickness, thicker walls, the solid again and nodes, each by the button of its panel."""
    source = branches()
    yield from open_tab()
    yield from fold(SKELETON)
    look("1-skeleton-panel")
    yield from pressed(EXTRACT_SKELETON, lambda: "Branches Skeleton" in bpy.data.objects)
    look("2-skeleton")
    yield from pressed(MAKE_ARMATURE, lambda: "Branches Armature" in bpy.data.objects)
    look("3-armature")
    assert len(bpy.data.armatures["Branches Armature"].bones) >= 3
    assert bpy.context.object == source, "the source stays what the panel speaks of"
    yield from fold(SKELETON)

    bpy.context.scene.medial_axis_thickness.limit = 0.45
    yield from fold(THICKNESS)
    look("4-thickness-panel")
    carrier_of = addon("bridge.thickness.thickness_object").carrier_of
    yield from pressed(MEASURE_THICKNESS, lambda: carrier_of(source) is not None)
    yield from look_after(1.0, "5-thickness-in-colours")
    assert addon("ui.base.show").shows_colours(viewport().spaces.active), "they are switched on"
    yield from pressed(THICKEN, lambda: "Medial Axis Thicken" in source.modifiers)
    look("6-thicker")
    assert source["ma_thickness_share"] == 0.0, "it is measured again"
    show_colours()
    yield from fold(THICKNESS)

    yield from pressed(COMPUTE, medial_objects)
    yield from fold(RESULT)
    yield from fold(REBUILD)
    look("7-rebuild-panel")
    yield from pressed(REBUILD_SOLID, lambda: "Branches Medial Axis Rebuilt" in bpy.data.objects)
    look("8-rebuilt")
    solid, axis = bpy.context.object, bpy.data.objects["Branches Medial Axis"]
    assert solid.name == "Branches Medial Axis Rebuilt" and not source.visible_get()
    yield from click(*at(OTHERS))
    assert source.visible_get() and axis.visible_get(), "one click brings them again"
    bpy.data.objects.remove(solid)
    select(source)
    with bpy.context.temp_override(window=window(), area=viewport(), object=source):
        assert bpy.ops.object.medial_axis_nodes("INVOKE_DEFAULT", group="BALLS") == {"FINISHED"}
    yield from look_after(1.5, "9-nodes")


def pressed(button, condition):
    """Click a button of the panel and wait for its work; it is refused at once or begun, so the limit is short."""
    done = lambda: bool(condition()) and no_job()
    done.patience = 30.0
    yield from click(*at(button))
    yield done
    yield patience(1.0)


def fold(header):
    """Open or close a panel by its header."""
    yield from click(*at(header))
    yield 1.0


def frame_selected():
    with in_viewport():
        bpy.ops.view3d.view_selected()


def blender_goes_on(steps):
    """While a job runs, that is not over after so many steps."""
    gaps, last = [], time.monotonic()
    for _ in range(steps):
        yield 0.05
        gaps.append(time.monotonic() - last)
        last = time.monotonic()
    assert job() is not None, "the run was too short to be cancelled"
    assert max(gaps) < patience(2.0), f"Blender stood still for {max(gaps):.2f} s"


def scene_cancel_with_escape():
    cloud()
    yield from start_long_run()
    yield from blender_goes_on(20)
    look("running")
    with in_viewport():
        assert not bpy.ops.object.medial_axis.poll(), "a second run must be refused"
    yield from point_at_viewport()
    asked = time.monotonic()
    xdotool("key", "Escape")
    yield no_job
    assert time.monotonic() - asked < patience(3.0)  # far less than the run would take
    yield from look_after(0.5, "cancelled")
    nothing_is_left()
    assert "cancelled" in bpy.context.scene.medial_axis.note


def scene_undo_while_running():
    """Undo takes the source away; the run must end by itself and leave the older scene alone."""
    cloud()
    yield from start_long_run()
    yield from key("ctrl+z")
    yield no_job
    yield 0.3
    assert "Cloud" not in bpy.data.objects and "Cube" in bpy.data.objects
    nothing_is_left()
    assert "'Cloud' was deleted" in bpy.context.scene.medial_axis.note
    look("undone")


def scene_undo_storm():
    """Undo and redo as fast as the keyboard gives them, while a run is on and after it."""
    cloud(200_000)
    camera = bpy.data.objects["Camera"]
    for step in range(1, 9):
        camera.location.z = step
        bpy.ops.ed.undo_push(message=f"Camera {step}")
    yield from start_long_run()
    del camera  # undo makes another
    heights = set()
    while job() is not None:
        yield from storm(6, heights)
    assert min(heights) < 4, "the keys were missed"
    yield result_exists
    look("computed")
    assert [thing.name for thing in medial_objects()] == ["Cloud Medial Axis"]
    assert medial_objects()[0]["ma_source"] == bpy.data.objects["Cloud"]
    before = len(medial_objects()[0].data.polygons)
    for _ in range(3):
        yield from storm(6, heights)
    yield from key("ctrl+z")
    yield no_result
    yield from key("ctrl+shift+z")
    yield result_exists
    assert [len(thing.data.polygons) for thing in medial_objects()] == [before]
    yield from look_after(1.0, "redone")
    assert threads() == []


def storm(strokes, heights):
    """Undoes `strokes` times, then redoes as often, with hardly a pause; adds the camera's heights in between."""
    yield from point_at_viewport()
    for name in ("ctrl+z", "ctrl+shift+z"):
        xdotool("key", "--delay", 15, *[name] * strokes)
        yield 0.3
        heights.add(bpy.data.objects["Camera"].location.z)
    yield 0.5


def scene_missing_module():
    yield from open_tab()
    look("message")
    native = addon("core.machine.native")
    assert native.expected_abi() in native.problem() and "found none" in native.problem()
    yield from click(*at((102, 128)))  # the button lies below the message; it is grey
    yield 0.5
    with in_viewport():
        assert not bpy.ops.object.medial_axis.poll()
    assert medial_objects() == []


# --- the stage


def play(scene):
    """A timer that plays a generator step by step and writes its end into the answer file."""
    waiting = None  # (condition, deadline)

    def step():
        nonlocal waiting
        try:
            if waiting is not None:
                condition, deadline = waiting
                if not condition():
                    assert time.monotonic() < deadline, f"waited in vain for {condition.__name__}"
                    return 0.1
                waiting = None
            wish = next(scene)
            if callable(wish):
                seconds = getattr(wish, "patience", PATIENCE)
                waiting = (wish, time.monotonic() + patience(seconds))
                return 0.05
            return wish
        except StopIteration:
            end("")
        except BaseException:
            look("failed")
            end(traceback.format_exc())
        return None

    return step


def end(problem):
    (Path(FOLDER) / f"{NAME}.json").write_text(json.dumps({"problem": problem}), encoding="utf-8")
    bpy.ops.wm.quit_blender()


def start():
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.inputs.use_mouse_continuous = False  # else a drag warps the mouse
    bpy.ops.preferences.addon_enable(module=MODULE)
    preferences = bpy.context.preferences.addons[MODULE].preferences
    preferences.guided = NAME != "tutorial"  # else its line moves what is below
    bpy.app.timers.register(play(globals()[f"scene_{NAME}"]()), first_interval=3.0, persistent=True)


start()
