# SPDX-License-Identifier: GPL-3.0-or-later
"""Sequences: files of every frame, and objects that play them in viewport and render."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from installed import addon
from measure import analyses, contents, positions, reports
from scene import ellipsoid, link, press, refuse, reopened, select, torus


@pytest.fixture
def growing():
    """An ellipsoid that grows from frame 1 to 4, selected."""
    source, scene = ellipsoid("Body"), bpy.context.scene
    for frame, size in ((1, 1.0), (4, 2.0)):
        source.scale = (size, size, size)
        source.keyframe_insert("scale", frame=frame)
    scene.frame_start, scene.frame_end = 1, 4
    scene.frame_set(2)
    return source


def compute_sequence(folder, *things, **options):
    """Write the files of every frame of the selection, and make the objects that play them."""
    press("medial_axis_sequence", *things, directory=str(folder), **options)


def play(name="Body"):
    return next(c for c in bpy.data.collections if c.get("ma_sequence") == name)


def shown(name="Body"):
    """{frame: names of the objects that viewport and render show}."""
    found = {}
    for frame in range(-1, 8):
        bpy.context.scene.frame_set(frame)
        things = play(name).all_objects
        assert all(thing.hide_viewport == thing.hide_render for thing in things)
        found[frame] = [thing.name for thing in things if not thing.hide_render]
    return found


# The objects that are seen from two frames before the first one to four frames after the last one.
PLAYED = [[f"Body {frame:04d}"] for frame in (1, 1, 1, 2, 3, 4, 4, 4, 4)]


def test_files_and_playback(growing, tmp_path):
    before = [thing.name for thing in bpy.data.objects]
    compute_sequence(tmp_path)
    names = [f"Body_{frame:04d}.npz" for frame in range(1, 5)]
    assert sorted(path.name for path in tmp_path.glob("*.npz")) == names
    assert bpy.context.scene.frame_current == 2, "the frame is as before"
    things = play().objects
    assert len(things) == 4 == len(bpy.data.objects) - len(before)
    sizes = [np.ptp(positions(thing.data)[:, 0]) for thing in things]
    assert sizes == sorted(sizes) and sizes[3] / sizes[0] == pytest.approx(2.0, rel=1e-3)
    assert list(shown().values()) == PLAYED
    ranges = {(thing["ma_radius_min"], thing["ma_radius_max"]) for thing in things}
    assert len(ranges) == 1, "the same colours mean the same radius in all frames"


def test_values_that_were_changed_without_a_key_are_of_no_frame(growing, tmp_path):
    bpy.context.scene.frame_set(1)
    growing.scale = (3.0, 3.0, 3.0)
    compute_sequence(tmp_path, frames="1,4")
    first, last = (np.ptp(positions(thing.data)[:, 0]) for thing in play().objects)
    assert last / first == pytest.approx(2.0, rel=1e-3)


def test_fast_leaves_out_exact_places(growing, tmp_path):
    for fast in (False, True):
        folder = tmp_path / str(fast)
        compute_sequence(folder, growing, frames="1", fast=fast)
        axis = addon("core.files.load_axis").load_axis(folder / "Body_0001.npz")
        assert axis.level.is_crisp.any() != fast


def test_attributes_come_from_the_file(growing, tmp_path):
    compute_sequence(tmp_path, frames="3")
    axis = addon("core.files.load_axis").load_axis(tmp_path / "Body_0003.npz")
    back = addon("bridge.axis.read_axis").read_axis(play().objects[0])
    for name in ("radius", "theta", "rho"):
        np.testing.assert_allclose(getattr(back, name), getattr(axis, name), rtol=1e-6)
    np.testing.assert_array_equal(back.generators, axis.generators)
    np.testing.assert_allclose(back.vertices, axis.vertices, rtol=1e-6, atol=1e-7)


def test_again_keeps_files_and_replaces_objects(growing, tmp_path, capfd):
    compute_sequence(tmp_path)
    reports(capfd)
    before, count = [*map(len, contents())], analyses()
    compute_sequence(tmp_path, growing)
    assert ("Info", "4 of 4 frames are there, 4 were before") in reports(capfd)
    assert [*map(len, contents())] == before and analyses() == count
    assert len(bpy.data.collections) == 1


def test_panel_settings_are_used_and_the_command_line_agrees(growing, tmp_path, capfd):
    bpy.context.scene.medial_axis.rho = 6.0
    compute_sequence(tmp_path, frames="2-3", playback=False)
    assert len(bpy.data.collections) == 0
    reports(capfd)
    words = [f"{tmp_path}/", "--frames", "2-3", "--format", "npz", "--rho", "6"]
    assert addon("cli").main(words) == 0
    out = capfd.readouterr().out
    assert out.count(" facets, kept\n") == 2


def test_several_objects_and_a_frame_that_fails(growing, tmp_path, capfd):
    other = torus("Ring")
    other.scale = (1, 1, 0)
    other.keyframe_insert("scale", frame=1)
    other.scale = (1, 1, 1)
    other.keyframe_insert("scale", frame=2)
    compute_sequence(tmp_path, growing, other)
    said = reports(capfd)
    assert ("Warning", "7 of 8 frames are there, 0 were before") in said
    assert any(text.startswith("'Ring, frame 1': Expected") for _, text in said)
    assert [len(play(name).objects) for name in ("Body", "Ring")] == [4, 3]


def test_refused(growing, tmp_path):
    refuse("Expected a saved file", "medial_axis_sequence", directory="//axes")
    chosen = {"operator": "medial_axis_sequence", "directory": str(tmp_path)}
    refuse("Expected frames such as", **chosen, frames="x")
    link("Flat", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 3, 2)])
    refuse("Expected results of 4 frames, found none", **chosen)
    assert list(tmp_path.iterdir()) == [] and len(bpy.data.collections) == 0
    select()
    assert not bpy.ops.object.medial_axis_sequence.poll()


def test_folder_beside_the_file(growing, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"))
    press("medial_axis_sequence", growing, frames="1")
    assert (tmp_path / "medial_axis" / "Body_0001.npz").is_file()


def test_saved_file_plays_without_the_addon(growing, tmp_path):
    """Keys, not handlers: the file plays where the add-on is disabled, and it leaves no handler of its own."""
    handlers = bpy.app.handlers.frame_change_pre, bpy.app.handlers.frame_change_post
    before = [list(each) for each in handlers]
    compute_sequence(tmp_path / "axes")
    for path in (tmp_path / "axes").iterdir():
        path.unlink()
    reopened(tmp_path / "a.blend")
    assert list(shown().values()) == PLAYED
    assert [list(each) for each in handlers] == before


def test_files_of_a_farm_are_imported(growing, tmp_path, capfd):
    words = [f"{tmp_path}/", "--frames", "1-4", "--format", "npz"]
    assert addon("cli").main(words) == 0
    assert len(bpy.data.collections) == 0
    files = [{"name": path.name} for path in sorted(tmp_path.glob("*.npz"))]
    done = bpy.ops.import_scene.medial_axis_sequence(directory=str(tmp_path), files=files[::-1])
    assert done == {"FINISHED"} and len(play().objects) == 4
    assert shown()[3] == ["Body 0003"]


@pytest.mark.parametrize("broken", ["text", "other arrays", "wrong lengths", "wrong corners"])
def test_nothing_is_left_of_files_that_are_broken(growing, tmp_path, broken):
    compute_sequence(tmp_path, playback=False, frames="1-2")
    path = tmp_path / "Body_0002.npz"
    with np.load(path) as archive:
        arrays = dict(archive)
    if broken == "other arrays":
        del arrays["theta"]
    elif broken == "wrong lengths":
        arrays["radius"] = arrays["radius"][1:]
    elif broken == "wrong corners":
        arrays["face_vertices"] = arrays["face_vertices"] + 10**6
    np.savez(path, **arrays)
    if broken == "text":
        path.write_text("no archive")
    files = [{"name": f"Body_{frame:04d}.npz"} for frame in (1, 2)]
    chosen = {"operator": "import_scene.medial_axis_sequence", "directory": str(tmp_path)}
    refuse("Expected", **chosen, files=files)


# --- skeletons


@pytest.fixture
def bending():
    """A rod that bends from frame 1 to 3, selected."""
    source = rod("Arm")
    bend = source.modifiers.new("Bend", "SIMPLE_DEFORM")
    bend.deform_method, bend.deform_axis = "BEND", "Z"
    for frame, angle in ((1, 0.0), (3, 1.5)):
        bend.angle = angle
        bend.keyframe_insert("angle", frame=frame)
    source.location = (1.0, 2.0, 3.0)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 3
    bpy.context.scene.frame_set(1)
    return source


def rod(name, around=16, along=41):
    turn = np.linspace(0.0, 2 * np.pi, around, endpoint=False)
    places = np.linspace(-2.0, 2.0, along)
    vertices = [(x, 0.3 * np.cos(t), 0.3 * np.sin(t)) for x in places for t in turn]
    ends = [list(range(around))[::-1], list(range(around * (along - 1), around * along))]
    steps = [(k, (k + 1) % around) for k in range(around)]
    starts = range(0, around * (along - 1), around)
    faces = [(i + a, i + b, i + b + around, i + a + around) for i in starts for a, b in steps]
    return link(name, vertices, [*ends, *faces])


def test_skeletons_of_every_frame(bending, tmp_path):
    compute_sequence(tmp_path, of="SKELETONS")
    names = [f"Arm_{frame:04d}.json" for frame in (1, 2, 3)]
    assert sorted(p.name for p in tmp_path.glob("Arm_????.json")) == names
    assert play("Arm").name == "Arm Skeleton Sequence"
    assert [shown("Arm")[frame] for frame in (1, 2, 3)] == [[f"Arm {f:04d}"] for f in (1, 2, 3)]
    spans = []
    for name, thing in zip(names, play("Arm").objects, strict=True):
        skeleton = addon("core.skeleton.load_skeleton").load_skeleton(tmp_path / name)
        assert (skeleton.tips, skeleton.loops) == (2, 0) == (thing["ma_ends"], thing["ma_loops"])
        (spline,) = thing.data.splines
        points = np.array([point.co[:3] for point in spline.points])
        np.testing.assert_allclose(points, skeleton.points[skeleton.branches[0]], atol=1e-5)
        assert abs(np.median(points[:, 2]) - 3.0) < 0.05, "it lies where the source is"
        radii = [point.radius for point in spline.points]
        assert max(radii) == pytest.approx(0.3, abs=0.05)
        spans.append(np.linalg.norm(points[-1] - points[0]))
    assert spans[0] > spans[1] > spans[2]


def test_files_of_skeletons_are_imported_and_reports_passed_over(bending, tmp_path):
    compute_sequence(tmp_path, of="SKELETONS", frames="1-2", playback=False)
    files = [{"name": path.name} for path in tmp_path.iterdir()]
    assert len(files) == 4
    bpy.ops.import_scene.medial_axis_sequence(directory=str(tmp_path), files=files)
    assert [thing.name for thing in play("Arm").objects] == ["Arm 0001", "Arm 0002"]
    wrong = '{"nodes": [], "edges": 3, "parts": [{"nodes": [0, 9]}]}'
    (tmp_path / "Arm_0002.json").write_text(wrong)
    chosen = {"operator": "import_scene.medial_axis_sequence", "directory": str(tmp_path)}
    refuse("Expected nodes and parts of a skeleton", **chosen, files=files)


def test_names_of_files():
    by_frame = addon("bridge.skeleton.sequence_objects").by_frame
    paths = [Path(f"{name}.npz") for name in ("a_0002", "a_0010", "b.001", "c-0005", "d_-03", "e7")]
    found = {name: list(frames) for name, frames in by_frame(paths).items()}
    assert found == {"a": [2, 10], "b": [1], "c": [5], "d": [-3], "e": [7]}
    with pytest.raises(addon("core.errors").InvalidInputError, match="'axis.npz'"):
        by_frame([Path("axis.npz")])
