# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line inside Blender: objects, frames, and the same bytes as without Blender."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from installed import MODULE, addon, program, succeeded
from measure import positions, world_positions
from scene import ellipsoid, link, press, scan, torus

FOLDER = Path(addon().__file__).resolve().parent


@pytest.fixture
def run(capfd):
    """(words) -> exit code and reports of the command line in this Blender."""

    def run_words(*words):
        capfd.readouterr()
        code = addon("cli").main([*map(str, words), "--json", "--quiet"])
        return code, reports_of(capfd.readouterr().out)

    return run_words


def reports_of(text):
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


def blender(*words, **options):
    """Another Blender with the same profile."""
    command = [program(), "--background", "--factory-startup", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, **options)


def in_blender(*words, file=()):
    """The command line in another Blender, as documented for every version."""
    return blender(*file, "--python", FOLDER / "__main__.py", "--", *words)


def walking(path="walk.blend"):
    """A file with an ellipsoid that grows and turns from frame 1 to 5, and a still torus."""
    source, scene = ellipsoid("Body"), bpy.context.scene
    for frame, size, turn in ((1, 1.0, 0.0), (5, 2.0, 1.0)):
        source.scale, source.rotation_euler = (1.0, 1.0, size), (turn, 0.0, turn)
        source.keyframe_insert("scale", frame=frame)
        source.keyframe_insert("rotation_euler", frame=frame)
    torus("Ring").location.x = 5
    scene.frame_end = 5
    scene.frame_set(1)
    return save(path)


def save(path):
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(path).absolute()))
    return path


def operator_axis(name, frame):
    """The result of the operator at a frame, and its vertices in the world."""
    bpy.context.scene.frame_set(frame)
    result = press("medial_axis", bpy.data.objects[name])
    return addon("bridge.axis.read_axis").read_axis(result), world_positions(result)


# --- objects and frames


def test_frames_of_a_file(here, run):
    code, reports = run(walking(), "axes/", "--format", "npz", "--frames", "1-5:2")
    assert code == 0
    wanted = [(name, frame) for frame in (1, 3, 5) for name in ("Body", "Ring")]
    assert [(r["object"], r["frame"]) for r in reports] == wanted
    for frame in (1, 3, 5):
        load_axis = addon("core.files.load_axis").load_axis
        axis = load_axis(here / "axes" / f"Body_{frame:04d}.npz")
        expected, places = operator_axis("Body", frame)
        np.testing.assert_array_equal(axis.generators, expected.generators)
        np.testing.assert_allclose(axis.vertices, places, atol=1e-5)
        np.testing.assert_allclose(axis.radius, expected.radius, rtol=1e-5, atol=1e-6)
    rings = {(here / "axes" / f"Ring_{frame:04d}.npz").read_bytes() for frame in (1, 3, 5)}
    assert len(rings) == 1, "what does not move has one axis"


@pytest.mark.parametrize("flag, ran", [((), False), (("--allow-scripts",), True)])
def test_python_in_a_file_runs_only_where_it_is_allowed(here, flag, ran):
    """The preference of the machine does not matter: Blender's own option allows or forbids scripts here."""
    ellipsoid("Body")
    text = bpy.data.texts.new("startup.py")
    text.write("open('ran', 'w').close()")
    text.use_module = True
    save("scripted.blend")
    for option in ("--enable-autoexec", "--disable-autoexec"):
        Path("ran").unlink(missing_ok=True)
        done = in_blender("scripted.blend", "axis.npz", "--force", *flag, file=(option,))
        assert done.returncode == 0, done.stderr
        assert Path("ran").exists() is ran, f"{option} decided"


def test_open_file_is_the_input_where_none_is_named(here, run):
    walking()
    bpy.context.scene.frame_set(3)
    code, (report,) = run("now.npz", "--object", "Body")
    assert code == 0 and (report["input"], report["frame"]) == (str(here / "walk.blend"), None)
    run("then_####.npz", "--object", "Body", "--frames", "3")
    assert (here / "now.npz").read_bytes() == (here / "then_0003.npz").read_bytes()
    assert "Body" in bpy.data.objects


def test_frames_are_kept_in_any_order_of_chunks(here, run):
    run(walking(), "axes/", "--frames", "4,5", "--object", "Body")
    code, reports = run("walk.blend", "axes/", "--frames", "1-5", "--object", "Body")
    assert code == 0
    assert [r["status"] for r in reports] == ["done"] * 3 + ["kept"] * 2


def test_results_and_hidden_objects_are_not_taken(here, run):
    source = ellipsoid()
    bpy.ops.object.medial_axis()
    torus("Hidden").hide_set(True)
    bpy.ops.object.light_add()
    code, reports = run("{name}.ma")
    assert (code, [r["object"] for r in reports]) == (0, [source.name])


def test_objects_that_cannot_be_used(here, run):
    ellipsoid("Good")
    link("Flat", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 3, 2)])
    code, reports = run("{name}.ma")
    assert code == 3
    assert {r["object"]: r["status"] for r in reports} == {"Good": "done", "Flat": "failed"}
    code, (report,) = run("one.ma")
    assert code == 3 and "{name} in OUTPUT for 2 objects" in report["error"]
    code, (report,) = run("one.ma", "--object", "Nobody")
    assert code == 3 and "found Good, Flat" in report["error"].replace("Flat, Good", "Good, Flat")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    code, (report,) = run("one.ma")
    assert code == 3 and "visible mesh" in report["error"]


def test_files_that_blender_imports(here, run):
    points = len(ellipsoid().data.vertices)
    bpy.ops.export_scene.fbx(filepath=str(here / "other.fbx"))
    save("egg.blend")
    files = ("other.fbx", "none.glb", "egg.txt", "egg.blend")
    code, reports = run(*files, "{file}.ma", "--sampling=vertices")
    assert code == 3
    assert [r["status"] for r in reports] == ["done", "failed", "failed", "done"], reports
    assert reports[0]["points"] - reports[0]["duplicates"] == points == reports[3]["points"]
    assert "found none at 'none.glb'" in reports[1]["error"]


def test_broken_file(here, run):
    Path("a.blend").write_bytes(b"no file of Blender")
    ellipsoid()
    code, (report,) = run("a.blend", "a.ma")
    assert code == 3 and report["kind"] == "ReadError" and "Blender says" in report["error"]


# --- the same everywhere


def plain_python():
    """Words that start the command line in this Blender's Python, without Blender."""
    python = Path(f"/usr/bin/python3.{sys.version_info[1]}")
    command = [str(python), "-c", "import numpy"]
    if not python.is_file() or subprocess.run(command, capture_output=True).returncode:
        pytest.skip(f"no {python} with NumPy outside Blender")
    return [str(python), str(FOLDER)]


def test_the_same_bytes_in_every_way_in(here, run):
    np.save("scan.npy", positions(scan("Scan").data))
    save("scan.blend")
    assert run("open.npz")[0] == 0
    assert run("scan.npy", "inside.npz")[0] == 0
    done = in_blender("scan.npy", "other.npz", "--json")
    assert done.returncode == 0 and len(reports_of(done.stdout)) == 1, done.stderr
    assert in_blender("loaded.npz", file=["scan.blend"]).returncode == 0
    if hasattr(bpy.utils, "register_cli_command"):
        succeeded([program(), "--command", "medial_axis", "scan.npy", "command.npz"])
        succeeded([program(), "scan.blend", "--command", "medial_axis", "after.npz"])
        assert (here / "after.npz").read_bytes() == (here / "command.npz").read_bytes()
    else:
        (here / "command.npz").write_bytes((here / "open.npz").read_bytes())
    succeeded([*plain_python(), "scan.npy", "plain.npz"])
    names = ["open", "inside", "other", "loaded", "command", "plain"]
    assert len({(here / f"{name}.npz").read_bytes() for name in names}) == 1


def test_exit_codes_leave_blender(here):
    walking()
    assert in_blender("none.off", "a.ma").returncode == 3
    assert in_blender("a.off", "--nonsense", "b.ma").returncode == 2
    assert in_blender("--help").returncode == 0
    assert in_blender("a.ma", "--object", "Body", "--rho=1e9", "--criteria=ratio", "--form=published",
                      file=["walk.blend"]).returncode == 1  # fmt: skip


def made_files(folder, pattern="*.npz"):
    return {path.name: path.read_bytes() for path in folder.glob(pattern)}


def test_two_blenders_in_one_folder(here):
    """The same frames at the same time, in other orders: every file is whole and as if made alone."""
    walking()
    command = [program(), "--background", "--factory-startup", "walk.blend"]
    command += ["--python", str(FOLDER / "__main__.py"), "--"]
    runs = [
        subprocess.Popen([*command, "both/", "--frames", "1-5", *words], stdout=subprocess.DEVNULL)
        for words in ([], ["--object", "Ring", "--object", "Body"])
    ]
    assert [run.wait() for run in runs] == [0, 0]
    succeeded([*command, "alone/", "--frames=1-5"])
    both, alone = (made_files(here / folder, "*.ma") for folder in ("both", "alone"))
    assert both == alone and len(both) == 10
    assert not list((here / "both").glob(".medial_axis_*"))


def test_module_path_of_an_enabled_addon(here):
    """`--python-expr` as documented; nothing is loaded twice although __main__.py is there, too."""
    walking()
    text = f"import bpy; bpy.ops.preferences.addon_enable(module={MODULE!r}); "
    text += f"from {MODULE} import cli; cli.run()"
    done = blender("walk.blend", "--python-expr", text, "--", "{name}.ma", "--json")
    assert done.returncode == 0, done.stderr
    assert [r["object"] for r in reports_of(done.stdout)] == ["Body", "Ring"]
    text = text.replace("cli.run()", "import runpy; ")
    text += f"runpy.run_path({str(FOLDER / '__main__.py')!r}, run_name='__main__')"
    done = blender("walk.blend", "--python-expr", text, "--", "{name}.ma", "--json")
    assert [r["status"] for r in reports_of(done.stdout)] == ["kept"] * 2, done.stderr


def test_documented_commands(here):
    """The commands of the page that need Blender."""
    page = os.environ.get("MEDIAL_AXIS_DOCS") or Path(__file__).parents[2] / "docs"
    text = Path(page, "command_line.md").read_text(encoding="utf-8")
    lines = "\n".join(re.findall(r"```sh\n(.*?)```", text, re.DOTALL)).splitlines()
    lines = [line for line in lines if line.startswith("blender ")]
    assert len(lines) >= 2
    walking()
    for line in lines:
        words = shlex.split(line.replace("FOLDER", str(FOLDER)))
        if "--command" in words and not hasattr(bpy.utils, "register_cli_command"):
            words = ["--background", "--python", str(FOLDER / "__main__.py"), "--"]
            words = ["blender", *words, *shlex.split(line)[3:]]
        succeeded([program(), *words[1:]])
    assert len(list((here / "axes").glob("Body_*.npz"))) == 5
    assert len(list((here / "axes" / "walk").glob("*.npz"))) == 6
