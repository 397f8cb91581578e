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
from scene import addon, analyses, attribute, link, medial_objects, on_ellipsoid, positions, select

NAME, FOLDER = sys.argv[sys.argv.index("--") + 1 :][:2]
PATIENCE = 90.0
# (left, down) in pixels from the top right corner of the sidebar, as Blender 3.4 to 5.2 draw it.
TAB = (13, 177) if bpy.app.version < (5, 0) else (13, 254)  # below Blender's own tab Animation
COMPUTE = (102, 50)
CANCEL = (48, 50)
MORE = (49, 81)  # beside a note
RECONSTRUCT = (102, 81)  # where there are points without faces
THETA_LEFT, THETA_RIGHT = (112, 153), (84, 153)
SIMPLIFY_LEFT, SIMPLIFY_RIGHT = (120, 130), (50, 130)
GERMAN_TAB = (13, 270)
# Headers of closed panels, 26 pixels one below the other, and what is in them when they alone are open.
SKELETON, THICKNESS, SETTINGS = (150, 208), (150, 234), (150, 260)
(
    RESULT,
    REBUILD,
    SETTINGS_OF_RESULT,
) = (  # where there is a result; the others, when the first is closed
    (150, 208),
    (150, 286),
    (150, 338),
)
AUTO_UPDATE = (62, 208)  # in the header of the panel Result
CLEAN_UP, METHOD = (150, 286), (150, 338)  # in Settings before there is a result
SAMPLING = (150, 391)  # in Settings of a result
EXTRACT_SKELETON, MAKE_ARMATURE = (102, 360), (102, 386)
MEASURE_THICKNESS, THICKEN, DIVIDE = (102, 382), (102, 563), (102, 584)
UNSOLIDIFY, HOLLOW = (102, 405), (102, 426)
DRAIN = (255, 675)  # on the screen, in Adjust Last Operation
REBUILD_SOLID, OTHERS = (102, 316), (49, 316)
FORM, SKELETON_END = (200, 95), (30, 322)
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
    steps = 8
    for step in range(1, steps + 1):
        xdotool(
            "mousemove", *(a + (b - a) * step // steps for a, b in zip(start, end, strict=True))
        )
        yield 0.15
    xdotool("mouseup", 1)
    yield 0.5


def in_viewport():
    """Operators run as if from the viewport."""
    area = viewport()
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window(), area=area, region=region)


def key(name):
    """Press a key with the mouse over the viewport, left of its middle."""
    area = viewport()
    yield from point(area.x + area.width // 4, window().height - (area.y + area.height // 3))
    xdotool("key", name)
    yield 0.8


def look(name):
    """Keep a picture of the screen; it must show something."""
    path = Path(FOLDER) / f"{NAME}-{name}.png"
    subprocess.run(["import", "-window", "root", str(path)], check=True)
    colours = subprocess.run(
        ["identify", "-format", "%k", str(path)], check=True, capture_output=True, text=True
    ).stdout
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
    source = bpy.data.objects.new("Cloud", mesh)
    bpy.context.scene.collection.objects.link(source)
    select(source)
    bpy.ops.ed.undo_push(message="Scene is set")
    return source


def job():
    return addon("ui.base.current_job").job()


def job_exists():
    return job() is not None


job_exists.patience = (
    10.0  # a click begins a job at once; one that was refused has none to wait for
)


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


def surfaces():
    return [thing for thing in bpy.data.objects if addon("bridge.surface_object").is_surface(thing)]


def surface_exists():
    return bool(surfaces()) and job() is None


def threads():
    return [thread for thread in threading.enumerate() if thread.name == "medial axis"]


def nothing_is_left():
    assert medial_objects() == [] and surfaces() == [] and threads() == []
    assert not [m.name for m in bpy.data.meshes if "Medial" in m.name]
    assert not [m.name for m in bpy.data.materials if "Medial" in m.name]


def facets():
    return len(bpy.data.objects["Suzanne Medial Axis"].data.polygons)


def scene_compute_drag_undo():
    monkey()
    yield from open_tab()
    look("before")
    yield from computed()
    yield from look_after(0.5, "computed")
    assert [thing.name for thing in medial_objects()] == ["Suzanne Medial Axis"]
    assert bpy.context.window_manager.operators[-1].bl_idname == "OBJECT_OT_medial_axis"
    first, before = facets(), analyses()
    yield from click(145, 705)  # opens Adjust Last Operation at the lower left
    yield 1.0
    yield from drag((220, 320), (250, 320))  # its theta
    yield from look_after(1.0, "adjusted")
    adjusted = facets()
    assert 0 < adjusted < first and len(medial_objects()) == 1
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


def scene_steady_panels():
    """Nothing moves when a computation begins, and every verb is in one menu, where F3 finds it."""
    select(bpy.data.objects["Cube"])
    bpy.context.scene.medial_axis.sampling = "SURFACE"
    bpy.context.scene.medial_axis.samples = 600
    yield from open_tab()
    yield from fold(SKELETON)
    look("before")
    with held(addon("core.axis.compute"), "extract"):
        yield from click(*at(COMPUTE))
        yield job_exists
        yield from look_after(1.0, "computing")
        yield from key("Escape")
        yield no_job
    yield from look_after(1.0, "cancelled")
    assert_same_below(FORM, SKELETON_END, "before", "computing")
    assert_same_below(FORM, SKELETON_END, "before", "cancelled")
    yield from fold(SKELETON)
    yield from computed()
    yield from look_after(1.0, "result")
    yield from fold(RESULT)
    yield from fold(SETTINGS_OF_RESULT)
    look("settings")
    yield from key("F3")
    xdotool("type", "thick")
    yield from look_after(1.0, "found")
    yield from key("Escape")
    with in_viewport():
        bpy.ops.wm.call_menu(name="VIEW3D_MT_medial_axis")
    yield from look_after(1.0, "menu")
    yield from key("Escape")


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
    assert np.allclose(*seen, atol=0.02), (
        f"{np.ptp(np.argwhere(np.abs(seen[0] - seen[1]) > 0.02), axis=0)}"
    )


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
    for part in (
        moves_need_nothing,
        edit_mode_waits,
        undo_is_followed,
        coarse_comes_first,
        escape_stops_it,
        files_keep_it,
        disabled_while_it_waits,
        deleted_source_ends_it,
    ):
        yield from part()


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
    yield lambda: followed() > 1.5 * first
    yield no_job
    yield from look_after(0.7, "edited")
    assert not changed_since()
    for stroke in ("ctrl+z", "ctrl+z", "ctrl+z"):  # out of edit mode, the scale, into edit mode
        yield from key(stroke)
    yield lambda: abs(followed() - first) < 1e-3
    yield no_job
    assert bpy.context.object.mode == "OBJECT" and not changed_since()


def undo_is_followed():
    """One stroke takes back one step of the artist; redo still knows it after the result has followed."""
    first, things = followed(), len(bpy.data.objects)
    yield from key("s")
    xdotool("key", "x", "2", "Return")
    yield lambda: followed() > 1.5 * first
    yield no_job
    for _ in range(2):
        yield from key("ctrl+z")
        assert bpy.context.object.scale.x == 1.0, "one stroke takes back one step"
        yield lambda: abs(followed() - first) < 1e-3
        yield no_job
        yield from look_after(1.0, "undone")
        yield from key("ctrl+shift+z")
        assert bpy.context.object.scale.x == 2.0, "redo must know the step after an update"
        yield lambda: followed() > 1.5 * first
        yield no_job
    assert len(bpy.data.objects) == things and not changed_since()
    yield from look_after(1.0, "redone")


def coarse_comes_first():
    live_result()["ma_seconds"] = 5.0  # as if it were slow
    addon("core.settings").COARSE = 500
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
    yield lambda: followed() > 1.2 * first
    yield no_job


def disabled_while_it_waits():
    """An edit that waits is dropped with the add-on, and found again when that comes back."""
    first, module = followed(), os.environ["MEDIAL_AXIS_MODULE"]
    before = bpy.app.handlers.depsgraph_update_post[:]
    bpy.context.object.scale.x = 1.0
    yield 0.2
    bpy.ops.preferences.addon_disable(module=module)
    yield 1.5
    assert followed() == first and threads() == []
    assert len(bpy.app.handlers.depsgraph_update_post) == len(before) - 1
    bpy.ops.preferences.addon_enable(module=module)
    yield lambda: followed() < 0.7 * first
    yield no_job


def deleted_source_ends_it():
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
    return float(np.ptp(positions_of(live_result())[:, 0]))


def positions_of(thing):
    found = np.empty(3 * len(thing.data.vertices), np.float32)
    thing.data.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


def changed_since():
    return addon("bridge.objects.source_state").differs(
        live_result(), bpy.context.view_layer.depsgraph
    )


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
    """Click the button; returns when the job runs and the picture was taken."""
    yield from open_tab()
    yield from click(*at(COMPUTE))
    yield job_exists
    yield job_runs
    assert medial_objects() == []


def scan_file():
    """A raw scan: that of a cap where the optional data folder is named, or else a bare ellipsoid."""
    path = Path(os.environ.get("MEDIAL_AXIS_TEST_DATA", ""), "distcap.xyz")
    if not path.is_file():
        path = Path(FOLDER) / "scan.xyz"
        np.savetxt(path, on_ellipsoid(3000)[0])
    return path


def scene_scan():
    """File > Import of a raw scan, one click, a clean inner axis; another click, its surface."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    with in_viewport():
        assert bpy.ops.import_mesh.points_xyz(filepath=str(scan_file())) == {"FINISHED"}
    source = bpy.context.view_layer.objects.active
    assert len(source.data.vertices) > 1000 and len(source.data.polygons) == 0
    frame_selected()
    yield from open_tab()
    look("imported")
    yield from computed()
    yield from look_after(0.5, "computed")
    (result,) = medial_objects()
    assert result["ma_inside"].startswith("Inside from Tight Cocone: the points have no faces")
    assert set(attribute(result.data, "ma_side")) == {1}
    select(source)
    yield from click(*at(RECONSTRUCT))
    yield surface_exists
    yield from look_after(1.5, "reconstructed")
    (surface,) = surfaces()
    assert len(surface.data.vertices) > 0.99 * (surface["ma_points"] - surface["ma_duplicates"])
    yield from key("ctrl+z")
    assert surfaces() == [] and len(medial_objects()) == 1, "undo must remove the surface alone"
    yield from key("ctrl+shift+z")
    assert len(surfaces()) == 1, "redo must bring the surface back"
    yield from look_after(1.0, "redone")


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
    bpy.ops.object.text_add(rotation=(1.2, 0.0, 0.0))
    thing = bpy.context.object
    thing.data.body, thing.data.extrude, thing.data.bevel_depth = "Axis", 0.15, 0.02
    return thing


def added(operator):
    """A function that makes an object by one of Blender's operators."""

    def make():
        getattr(bpy.ops.mesh, f"primitive_{operator}_add")()
        return bpy.context.object

    return make


MODELS = {
    "cube": added("cube"),
    "torus": added("torus"),
    "suzanne": added("monkey"),
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


scene_first_glance_light = scene_first_glance_large = scene_first_glance


def scene_tutorial():
    """The pictures of docs/tutorial.md, in their order."""
    source, panel = monkey(), bpy.context.scene.medial_axis
    source.modifiers["Subdivision"].levels = 2
    turn_to_the_front()
    yield from open_tab()
    yield from look_after(0.5, "01")  # where the panel is
    bpy.context.preferences.addons[os.environ["MEDIAL_AXIS_MODULE"]].preferences.guided = True
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
    torus = bpy.context.object
    torus.data.transform(uneven())
    yield 0.7
    with in_viewport():
        assert bpy.ops.object.medial_axis_sampling_report() == {"FINISHED"}
    yield from look_after(1.5, "09")
    yield from computed()
    yield from look_after(1.5, "10")


def uneven():
    """A stretch that makes a ring flat, so that its rims are hard to sample."""
    return Matrix(((1.2, 0, 0, 0), (0, 0.9, 0, 0), (0, 0, 0.4, 0), (0, 0, 0, 1)))


def turn_to_the_front():
    """The viewport looks at what is selected, a little from the side."""
    viewport().spaces.active.region_3d.view_rotation = Euler((1.35, 0.0, 0.45)).to_quaternion()
    frame_selected()


def scene_sampling():
    """One click on the cube that Blender starts with; another shows how densely it was sampled; H, and one more."""
    cube = bpy.data.objects["Cube"]
    select(cube)
    yield from open_tab()
    look("panel")
    yield from computed()
    yield from look_after(0.5, "computed")
    (result,) = medial_objects()
    assert "samples of the surface: the vertices" in result["ma_sampled"]
    assert abs(attribute(result.data, "ma_radius").max() - 1.0) < 0.02
    select(cube)
    for header in (RESULT, SETTINGS_OF_RESULT, SAMPLING):
        yield from fold(header)
    look("opened")
    yield from key("F3")
    xdotool("type", "report samp")
    yield patience(1.0)
    xdotool("key", "Return")
    yield report_exists
    yield from look_after(2.0, "reported")
    (report,) = reports()
    assert len(report.data.vertices) == result["ma_points"], "it is the same analysis"
    yield from key("ctrl+z")
    assert reports() == [] and len(medial_objects()) == 1, "undo must remove the report alone"
    select(bpy.data.objects["Cube"])
    yield from key("h")
    assert bpy.context.selected_objects == [] and medial_objects()[0].visible_get()
    medial_objects()[0]["ma_seconds"] = -1.0
    yield from pressed(COMPUTE, lambda: medial_objects()[0]["ma_seconds"] > 0.0)
    look("hidden-by-h")
    assert not bpy.data.objects["Cube"].visible_get(), "it is read and stays hidden"


def branches():
    """A Y of three tubes, as one mesh."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    ends = [(0, 0, 0), (0, 0, -1.6), (-1.2, 0, 1.2), (1.2, 0, 1.2)]
    wire = link("Wire", ends, edges=[(0, 1), (0, 2), (0, 3)])
    wire.modifiers.new("Skin", "SKIN")
    wire.modifiers.new("Subdivision", "SUBSURF").levels = 3
    depsgraph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(wire.evaluated_get(depsgraph))
    source = bpy.data.objects.new("Branches", mesh)
    bpy.context.scene.collection.objects.link(source)
    bpy.data.objects.remove(wire)
    select(source)
    turn_to_the_front()
    bpy.ops.ed.undo_push(message="Scene is set")
    return source


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
    yield from pressed(
        MEASURE_THICKNESS,
        lambda: addon("bridge.thickness.thickness_object").carrier_of(source) is not None,
    )
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


def scene_pose_a_body():
    """Shoulder, hip, knee and tail turned by mouse, of a body with weights of the axis and one with Blender's."""
    from test_rig import figure

    bpy.data.objects.remove(bpy.data.objects["Cube"])
    viewport().spaces.active.show_region_ui = False
    viewport().spaces.active.overlay.show_bones = True
    for bind in ("AXIS", "AUTOMATIC"):
        source = figure(bind.title(), tail=True)
        with bpy.context.temp_override(window=window(), area=viewport(), object=source):
            made = bpy.ops.object.medial_axis_armature(bind=bind, per_limb=2)
        assert made == {"FINISHED"}
        look_at_it_from((1.0, -1.6, 0.5))
        frame_selected()
        yield from look_after(1.5, f"{bind.lower()}-1-at-rest")
        thing = bpy.data.objects[f"{bind.title()} Armature"]
        select(thing)
        with in_viewport():
            bpy.ops.object.mode_set(mode="POSE")
        for bone, angle in (("arm.01.L", -50), ("leg.01.L", 50), ("leg.02.L", -50)):
            yield from turned_by_mouse(thing, bone, angle)
        assert_left_side_moved(source)
        look(f"{bind.lower()}-2-limbs")
        look_at_it_from((1.6, 1.2, 0.4))
        yield patience(1.0)
        yield from turned_by_mouse(thing, "tail.01", 40)
        look(f"{bind.lower()}-3-tail")
        with in_viewport():
            bpy.ops.object.mode_set(mode="OBJECT")
        for made in (source, thing):
            made.hide_set(True)


def look_at_it_from(towards):
    from mathutils import Vector

    view = viewport().spaces.active.region_3d
    view.view_rotation = Vector(towards).to_track_quat("Z", "Y")
    view.view_perspective = "ORTHO"


def on_screen(place):
    """A place of the world in pixels from the upper left."""
    from bpy_extras.view3d_utils import location_3d_to_region_2d

    region = next(region for region in viewport().regions if region.type == "WINDOW")
    x, y = location_3d_to_region_2d(region, viewport().spaces.active.region_3d, place)
    return round(region.x + x), round(window().height - region.y - y)


def turned_by_mouse(thing, name, angle):
    """Click on a bone, press R, lead the mouse round its head, and click again."""
    bone = thing.pose.bones[name]
    middle = thing.matrix_world @ (bone.head + bone.tail) / 2
    yield from click(*on_screen(middle))
    found = bpy.context.view_layer.objects.active
    assert found == thing and thing.data.bones.active.name == name, thing.data.bones.active
    before = bone.matrix.to_quaternion()
    x, y = on_screen(thing.matrix_world @ bone.head)
    steps = np.radians(np.linspace(0.0, angle, 9))
    way = [(round(x + 120 * np.cos(a)), round(y - 120 * np.sin(a))) for a in steps]
    yield from point(*way[0])
    xdotool("key", "r")
    yield 0.5
    for place in way[1:]:
        xdotool("mousemove", *place)
        yield 0.15
    xdotool("click", 1)
    yield patience(0.8)
    turned = np.degrees(before.rotation_difference(bone.matrix.to_quaternion()).angle)
    turned = min(turned, 360.0 - turned)  # a quaternion and its negative are one turn
    assert 0.5 * abs(angle) < turned < 1.3 * abs(angle), (name, turned)


def assert_left_side_moved(source):
    """The arm and the leg at the left have moved, and those at the right have not."""
    now = source.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    rest = positions(source.data)
    moved = np.linalg.norm(positions(now) - rest, axis=1)
    x, z = rest[:, 0], rest[:, 2]
    assert moved[x > 0.5].max() > 0.2, "the arm"
    assert moved[(x > 0.1) & (z < 0.4)].max() > 0.2, "the leg"
    for away in (x < -0.4, (x < -0.12) & (z < 0.5)):
        assert moved[away].max() < 0.03, "the other side"


def scene_hollow():
    """A ring with a wall and a drain hole, by the button of the panel and Adjust Last Operation; undo takes it off."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    with in_viewport():
        bpy.ops.mesh.primitive_torus_add(major_radius=1.2, minor_radius=0.6)
    bpy.ops.ed.undo_push(message="Scene is set")
    frame_selected()
    yield from measured(limit=0.2)
    look("1-measured")
    yield from pressed(HOLLOW, lambda: "Torus Hollow" in bpy.data.objects)
    show_colours()
    viewport().spaces.active.shading.show_xray = True
    yield from look_after(1.0, "2-hollow")
    solid, within = (
        0.6 * np.cos(np.pi / 12),
        0.6 * np.cos(np.pi / 12) - 0.2,
    )  # to the sides of a ring of 12
    left = volume_of(bpy.data.objects["Torus Hollow"]) / volume_of(bpy.data.objects["Torus"])
    assert abs(left - (1 - (within / solid) ** 2)) < 0.02, left
    yield from click(145, 705)  # opens Adjust Last Operation at the lower left
    yield from look_after(1.0, "3-adjust")
    yield from typed_into(DRAIN, "0.3")
    yield from until(lambda: "Torus Hollow Drain" in bpy.data.objects)
    look("4-drained")
    drained, whole = (bpy.data.objects[name] for name in ("Torus Hollow", "Torus"))
    assert drained.modifiers[-1].type == "BOOLEAN"
    assert left - 0.02 < volume_of(drained) / volume_of(whole) < left
    yield from key("ctrl+z")
    yield from until(lambda: not any("Hollow" in thing.name for thing in bpy.data.objects))
    assert "Torus" in bpy.data.objects


def scene_unsolidify():
    """A T as its middle surface, which the panel's button makes and its modifier thickens again; undo takes it off.

    Then a plate that is thin at one end: another button divides its faces and thickens it, and undo takes both off.
    """
    profile_t()
    yield from measured(limit=0.05)
    look("1-measured")
    yield from pressed(UNSOLIDIFY, lambda: "T Mid-Surface" in bpy.data.objects)
    sheets = bpy.data.objects["T Mid-Surface"]
    assert set(attribute(sheets.data, "ma_part")) == {0, 1, 2}
    yield from look_after(1.0, "2-sheets")
    modifier = sheets.modifiers["Medial Axis Thickness"]
    modifier.show_viewport = True
    yield from look_after(1.0, "3-solid-again")
    yield from key("ctrl+z")
    yield from until(lambda: "T Mid-Surface" not in bpy.data.objects)
    assert "T" in bpy.data.objects

    wedge()
    bpy.context.scene.medial_axis_thickness.limit = 0.05
    yield from click(*at(MEASURE_THICKNESS))
    yield from until(
        lambda: (
            addon("bridge.thickness.thickness_object").carrier_of(bpy.data.objects["Wedge"])
            is not None
        )
    )
    look("4-thin-at-one-end")
    yield from pressed(DIVIDE, lambda: "Medial Axis Thicken" in bpy.data.objects["Wedge"].modifiers)
    look("5-divided-and-thicker")
    thing, of = bpy.data.objects["Wedge"], addon("bridge.thickness.thickness_object")
    assert len(thing.data.polygons) > 300 and of.carrier_of(thing)["ma_thickness_share"] < 0.02
    yield from key("ctrl+z")
    yield from until(lambda: not bpy.data.objects["Wedge"].modifiers)
    assert len(bpy.data.objects["Wedge"].data.polygons) == 6


def wedge():
    """A plate of six faces, which gets thicker from 0.02 to 0.1."""
    bpy.data.batch_remove(bpy.data.objects)
    points = [(x, y, z * (0.03 + 0.02 * x)) for z in (-1, 1) for x in (-1, 1) for y in (-1, 1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    select(link("Wedge", points, sides))
    frame_selected()
    bpy.ops.ed.undo_push(message="Scene is set")


def profile_t():
    """A T of walls of 0.1."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    outline = [(-1, 1), (-1, 0.9), (-0.05, 0.9), (-0.05, -0.5)]
    outline += [(-x, z) for x, z in outline[::-1]]
    points = [(x, y, z) for y in (-1, 1) for x, z in outline]
    sides = [(i, (i + 1) % 8, (i + 1) % 8 + 8, i + 8) for i in range(8)]
    source = link("T", points, [*sides, range(7, -1, -1), range(8, 16)])
    frame_selected()
    bpy.ops.ed.undo_push(message="Scene is set")
    return source


def measured(limit):
    """Measure the thickness of the active object by the panel."""
    source = bpy.context.object
    bpy.context.scene.medial_axis_thickness.limit = limit
    yield from open_tab()
    yield from fold(THICKNESS)
    yield from pressed(
        MEASURE_THICKNESS,
        lambda: addon("bridge.thickness.thickness_object").carrier_of(source) is not None,
    )
    yield patience(1.0)


def typed_into(place, text):
    """Type a value into a field on the screen."""
    yield from point(*place)
    xdotool("click", "--repeat", 2, "--delay", 60, 1)
    yield 0.5
    xdotool("key", "ctrl+a")
    xdotool("type", text)
    xdotool("key", "Return")
    yield 0.8


def volume_of(thing):
    """The volume that the faces of an object enclose, after its modifiers."""
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    mesh.calc_loop_triangles()
    corners = np.array([[mesh.vertices[i].co for i in t.vertices] for t in mesh.loop_triangles])
    return abs(np.linalg.det(corners).sum()) / 6


def until(condition):
    """Wait for a button's work; it is refused at once or begun, so the limit is short."""

    def done():
        return bool(condition()) and no_job()

    done.patience = 30.0
    yield done
    yield patience(1.0)


def pressed(button, condition):
    """Click a button of the panel and wait for its work."""
    yield from click(*at(button))
    yield from until(condition)


def fold(header):
    """Open or close a panel by its header."""
    yield from click(*at(header))
    yield 1.0


def reports():
    is_report = addon("bridge.axis.report_object").is_report
    return [thing for thing in bpy.data.objects if is_report(thing)]


def report_exists():
    return bool(reports()) and no_job()


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
    area = viewport()
    yield from point(area.x + area.width // 4, window().height - (area.y + area.height // 3))
    asked = time.monotonic()
    xdotool("key", "Escape")
    yield no_job
    assert time.monotonic() - asked < patience(3.0)  # far less than the run would take
    yield from look_after(0.5, "cancelled")
    nothing_is_left()
    assert "cancelled" in bpy.context.scene.medial_axis.note


def scene_reduce_with_escape():
    """A small medial mesh takes seconds: Blender goes on, Escape ends it, and once more it comes."""
    source = monkey()
    source.modifiers["Subdivision"].levels = 2
    assert bpy.ops.object.medial_axis(form="CLEAN", side="INNER") == {"FINISHED"}
    before = len(bpy.data.objects)
    area = viewport()
    yield from point(area.x + area.width // 4, window().height - (area.y + area.height // 3))
    start_reducing()
    yield from blender_goes_on(8)
    xdotool("key", "Escape")  # at once: most of the time goes into measuring the result
    yield no_job
    assert len(bpy.data.objects) == before
    assert "cancelled" in bpy.context.scene.medial_axis.note
    start_reducing()
    yield no_job
    assert len(bpy.data.objects) == before + 1
    yield from look_after(1.0, "reduced")


def start_reducing():
    with in_viewport():
        started = bpy.ops.object.medial_axis_reduce("INVOKE_DEFAULT", vertices=100)
    assert started == {"RUNNING_MODAL"}


def scene_cancel_with_button():
    cloud()
    yield from start_long_run()
    yield from click(*at(CANCEL))
    yield patience(0.5)
    assert no_job(), "the button was missed, or the run does not end"
    nothing_is_left()
    yield 0.3
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
    area = viewport()
    yield from point(area.x + area.width // 4, window().height - (area.y + area.height // 3))
    for name in ("ctrl+z", "ctrl+shift+z"):
        xdotool("key", "--delay", 15, *[name] * strokes)
        yield 0.3
        heights.add(bpy.data.objects["Camera"].location.z)
    yield 0.5


def scene_file_opened():
    """Another file while a run is on, the same file once more, and the add-on works in it."""
    path = str(Path(FOLDER) / "opened.blend")
    cloud(400_000)
    bpy.ops.wm.save_as_mainfile(filepath=path)
    for load in (partial(bpy.ops.wm.open_mainfile, filepath=path), bpy.ops.wm.revert_mainfile):
        yield from start_long_run()
        with bpy.context.temp_override(window=window()):
            load()
        yield 1.0
        assert no_job()
        nothing_is_left()
        select(bpy.data.objects["Cloud"])
    yield from start_long_run()
    yield result_exists
    yield from look_after(0.5, "computed")
    assert [thing.name for thing in medial_objects()] == ["Cloud Medial Axis"]


def scene_disabled_while_running():
    cloud()
    yield from start_long_run()
    bpy.ops.preferences.addon_disable(module=os.environ["MEDIAL_AXIS_MODULE"])
    yield 1.0
    assert threads() == [] and not hasattr(bpy.types, "OBJECT_OT_medial_axis")
    look("disabled")
    bpy.ops.preferences.addon_enable(module=os.environ["MEDIAL_AXIS_MODULE"])
    yield 0.5
    nothing_is_left()
    bpy.data.objects.remove(bpy.data.objects["Cloud"])
    bpy.ops.mesh.primitive_cube_add()
    yield from open_tab()
    yield from computed()
    yield from look_after(0.5, "computed")


def scene_window_closed_while_running():
    """The run belongs to the window that it was started in."""
    cloud()
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.window_new()
    yield 1.0
    second = bpy.context.window_manager.windows[-1]
    assert second != window()
    with bpy.context.temp_override(window=second):
        assert bpy.ops.object.medial_axis("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield job_exists
    yield job_runs
    with bpy.context.temp_override(window=second):
        bpy.ops.wm.window_close()
    yield 1.0
    assert no_job()
    nothing_is_left()
    bpy.data.objects.remove(bpy.data.objects["Cloud"])
    bpy.ops.mesh.primitive_cube_add()
    yield from open_tab()
    yield from computed()


def scene_edit_mode():
    monkey()
    with in_viewport():
        bpy.ops.object.mode_set(mode="EDIT")
    yield from open_tab()
    yield from computed()
    yield from look_after(0.5, "computed")
    assert bpy.context.mode == "EDIT_MESH" and bpy.context.object.name == "Suzanne"
    yield from key("ctrl+z")
    look("undone")


def start_sequence(folder):
    with in_viewport():
        begun = bpy.ops.object.medial_axis_sequence("INVOKE_DEFAULT", directory=str(folder))
    assert begun == {"RUNNING_MODAL"}


def played():
    return [thing for thing in bpy.data.objects if "ma_frame" in thing]


def scene_sequence():
    """Frames are computed while Blender stays usable; one undo takes the playback away, not the files."""
    source = monkey()
    for frame in (1, 3):
        source.scale = (1, 1, frame)
        source.keyframe_insert("scale", frame=frame)
    bpy.context.scene.frame_end = 3
    bpy.ops.ed.undo_push(message="Scene is animated")
    folder = Path(FOLDER) / "sequence"
    yield from open_tab()
    start_sequence(folder)
    yield played
    yield from look_after(0.5, "computed")
    assert len(list(folder.glob("Suzanne_000?.npz"))) == 3 == len(played())
    assert bpy.context.scene.frame_current == 1 and no_job()
    (shown,) = (thing for thing in played() if thing.visible_get())
    assert shown.dimensions.z <= source.dimensions.z, "the first frame has no key of the last"
    yield from key("ctrl+z")
    assert played() == [] and len(bpy.data.collections) == 1
    start_sequence(folder)  # of files that are finished
    yield played
    for frame in (1, 2, 3):
        bpy.context.scene.frame_set(frame)
        shown = [thing["ma_frame"] for thing in played() if thing.visible_get()]
        assert shown == [frame]
    yield from look_after(0.5, "played")


def scene_cancel_sequence_with_escape():
    cloud()
    bpy.context.scene.frame_end = 3
    folder = Path(FOLDER) / "cancelled sequence"
    yield from open_tab()
    start_sequence(folder)
    yield job_exists
    yield job_runs
    look("running")
    yield from key("Escape")
    yield no_job
    yield 0.5
    nothing_is_left()
    assert played() == [] and not folder.exists()


def scene_quit_while_running():
    cloud()
    yield from start_long_run()
    assert threads()


def scene_plain_words():
    """Flat text is told in one line; the question mark beside it has the whole sentence."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    with in_viewport():
        bpy.ops.object.text_add()
    yield from open_tab()
    yield from click(*at(COMPUTE))
    yield lambda: bpy.context.scene.medial_axis.note
    yield patience(1.0)
    yield from point(viewport().x + 200, 300)  # Blender's own message goes with the mouse
    look("told")
    for _ in range(2):  # Blender's own message takes the first one
        yield from click(*at(MORE))
    yield from look_after(1.0, "more")
    yield from point(viewport().x + 200, 300)
    bpy.context.scene.medial_axis.note = ""
    yield patience(1.0)
    for header in (SETTINGS, METHOD, CLEAN_UP):
        yield from fold(header)
    look("settings")


def scene_german():
    """The sidebar with a result, and the preferences with a self-test, where Blender speaks German."""
    bpy.context.preferences.view.language = "de_DE"
    select(bpy.data.objects["Cube"])
    viewport().spaces.active.show_region_ui = True
    yield 1.0
    yield from click(*at(GERMAN_TAB))
    with in_viewport():
        bpy.ops.object.medial_axis("INVOKE_DEFAULT")
    yield result_exists
    yield from look_after(1.0, "sidebar")
    area = viewport()
    area.type = "PREFERENCES"
    bpy.context.preferences.active_section = "ADDONS"
    bpy.context.window_manager.addon_search = "Medial"
    yield 1.5  # the list knows its add-ons when it was drawn
    bpy.ops.preferences.addon_expand(module=os.environ["MEDIAL_AXIS_MODULE"])
    assert bpy.ops.wm.medial_axis_self_test() == {"FINISHED"}
    yield from look_after(1.5, "preferences")


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


def answer(problem):
    (Path(FOLDER) / f"{NAME}.json").write_text(json.dumps({"problem": problem}), encoding="utf-8")


def end(problem):
    answer(problem)
    bpy.ops.wm.quit_blender()


def light_theme():
    """The light theme that comes with Blender."""
    for folder in bpy.utils.preset_paths("interface_theme"):
        for path in Path(folder).glob("Blender_Light.xml"):
            bpy.ops.script.execute_preset(
                filepath=str(path), menu_idname="USERPREF_MT_interface_theme_presets"
            )


def start():
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.inputs.use_mouse_continuous = False  # else a drag warps the mouse
    bpy.ops.preferences.addon_enable(module=os.environ["MEDIAL_AXIS_MODULE"])
    preferences = bpy.context.preferences.addons[os.environ["MEDIAL_AXIS_MODULE"]].preferences
    preferences.guided = NAME != "tutorial"  # else its line moves what is below
    if NAME.endswith("_light"):
        light_theme()
    bpy.app.timers.register(play(globals()[f"scene_{NAME}"]()), first_interval=3.0, persistent=True)


start()
