# SPDX-License-Identifier: GPL-3.0-or-later
"""Two hundred runs leave nothing behind; updates, removal and what is written, each in a Blender of its own."""

import os
import re
import shutil
import sys
import textwrap
import zipfile
from pathlib import Path

import bpy
import pytest
from installed import MODULE, addon, program
from measure import medial_objects, result_of
from run import Blender
from scene import compute, ellipsoid

RUNS = 200
BLOCKS = (
    *("objects", "meshes", "materials", "collections", "images", "texts", "actions"),
    *("node_groups", "pointclouds", "curves", "scenes", "worlds", "screens", "workspaces"),
)
STATM = Path("/proc/self/statm")


def blocks():
    return {kind: len(getattr(bpy.data, kind)) for kind in BLOCKS if hasattr(bpy.data, kind)}


def resident():
    """Bytes; 0 where the system does not say."""
    if not hasattr(os, "sysconf") or not STATM.exists():
        return 0
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def change(source, run):
    """Another shape, so that it is analysed again."""
    source.data.vertices[0].co.x += 1e-5 * (run + 1)
    source.data.update()


def test_runs_leave_no_blocks_and_no_memory():
    source = ellipsoid(segments=5)
    cache = addon("core.machine.cache").CACHE
    before = cache.analyses
    for run in range(RUNS // 10):
        change(source, run)
        compute(source)
    (result,) = medial_objects()
    one = addon("core.machine.cache").bytes_of(cache.get(result["ma_analysis"]))
    preferences = bpy.context.preferences.addons[MODULE].preferences
    preferences.cache_size = 1 + 2 * one // (1 << 20)
    start, held = blocks(), resident()
    for run in range(RUNS):
        change(source, run)
        compute(source, theta=0.2 + 0.002 * run)
    assert cache.analyses == before + RUNS // 10 + RUNS  # nothing came from the cache
    assert blocks() == start and medial_objects() == [result] == [result_of(source)]
    assert resident() - held < RUNS / 2 * one
    preferences.property_unset("cache_size")


def test_moved_sliders_leave_no_blocks_and_no_memory():
    """Each moves Simplify, which only filters, and each tenth theta, which needs another hierarchy.

    A mesh of a result is larger than what may stay of each run.
    """
    mesh = compute(ellipsoid(segments=5)).data
    size = 12 * len(mesh.vertices) + 4 * len(mesh.loops) + 40 * len(mesh.polygons)
    panel = bpy.context.scene.medial_axis

    def move(runs):
        for run in range(runs):
            panel.simplify = 0.01 * (run % 10)
            if run % 10 == 0:
                panel.theta = 0.2 + 0.001 * (run % 50)
            assert panel.note == ""

    move(RUNS // 10)
    start, held = blocks(), resident()
    move(RUNS)
    assert blocks() == start
    assert resident() - held < RUNS / 2 * size


def test_enabling_again_and_again_leaves_one_of_each():
    def traces():
        menus = (bpy.types.VIEW3D_MT_object, bpy.types.TOPBAR_MT_file_import)
        lists = [bpy.app.handlers.load_pre, *(menu._dyn_ui_initialize() for menu in menus)]
        ours = [sum(f.__module__.startswith(MODULE) for f in functions) for functions in lists]
        manuals = sum("medial_axis" in prefix for prefix, _ in bpy.utils.manual_map())
        return manuals, ours, len(sys.path)

    before = traces()
    for _ in range(10):
        bpy.ops.preferences.addon_disable(module=MODULE)
        bpy.ops.preferences.addon_enable(module=MODULE)
    assert traces() == before and before[0] == 1


# --- in a Blender of its own


@pytest.fixture
def blender(tmp_path):
    return Blender([program()], tmp_path / "profile")


def archive(path, version=None):
    """A zip of what is installed here, perhaps as of another version, with a file that ours has not."""
    folder = Path(addon().__file__).parent
    with zipfile.ZipFile(path, "w") as target:
        for file in sorted(folder.rglob("*")):
            if file.is_dir() or "__pycache__" in file.parts:
                continue
            content = file.read_bytes()
            if version and file.name in ("__init__.py", "blender_manifest.toml"):
                text, digits = content.decode(), version.replace(".", ", ")
                text = re.sub(r'("version": )\(.*?\)', rf"\1({digits})", text)
                content = re.sub(r'(?m)^(version = )".*"', rf'\1"{version}"', text)
            target.writestr(f"medial_axis/{file.relative_to(folder).as_posix()}", content)
        if version:
            target.writestr("medial_axis/core/leftover.py", "")
    return path


START = """
import importlib, os, sys
from pathlib import Path
import bpy
name = sys.argv[-1]
def addon(path=""):
    return importlib.import_module(f"{name}.{path}" if path else name)
def preferences():
    return bpy.context.preferences.addons[name].preferences
def compute():
    bpy.ops.mesh.primitive_torus_add()
    assert bpy.ops.object.medial_axis() == {"FINISHED"}
"""


def play(blender, folder, name, text):
    """Run a script in a new session; it fails where the script raises."""
    path = folder / "script.py"
    path.write_text(START + textwrap.dedent(text), encoding="utf-8")
    assert blender.script(path, name, check=False) == 0


def test_update_of_an_older_version(blender, tmp_path):
    """The preferences stay, the files of the older version go, and the new version computes."""
    name = blender.install(archive(tmp_path / "old.zip", "0.0.9"))
    old = """
        assert addon().__version__.partition("+")[0] == "0.0.9"
        addon("core.leftover")
        preferences().cache_size = 77
        bpy.ops.wm.save_userpref()
        """
    play(blender, tmp_path, name, old)
    assert blender.install(archive(tmp_path / "new.zip")) == name
    new = f"""
        assert addon().__version__ == "{addon().__version__}"
        assert preferences().cache_size == 77
        if bpy.app.version >= (4, 2, 0):  # before, Blender lays new files over the old ones
            assert not (Path(addon().__file__).parent / "core" / "leftover.py").exists()
        compute()
        assert addon("core.machine.cache").CACHE.room == 77 << 20
        assert bpy.ops.wm.medial_axis_self_test() == {{"FINISHED"}}
        """
    play(blender, tmp_path, name, new)


def test_update_while_the_older_version_runs(blender, tmp_path):
    """The compiled module stays loaded, everything else is that of the new version."""
    name = blender.install(archive(tmp_path / "old.zip", "0.0.9"))
    path = archive(tmp_path / "new.zip")
    update = f"""
        addon("core.leftover")
        compute()
        if bpy.app.version >= (4, 2, 0):
            bpy.ops.extensions.package_install_files(
                filepath={str(path)!r}, repo="user_default", enable_on_install=True, overwrite=True
            )
        else:
            bpy.ops.preferences.addon_install(filepath={str(path)!r}, overwrite=True)
            bpy.ops.preferences.addon_enable(module=name)
        assert addon().__version__ == "{addon().__version__}"
        assert f"{{name}}.core.leftover" not in sys.modules
        compute()
        assert bpy.ops.wm.medial_axis_self_test() == {{"FINISHED"}}
        """
    play(blender, tmp_path, name, update)


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="the system has no files in memory")
def test_only_legacy_installs_load_a_copy_of_the_compiled_module():
    native, legacy = addon("core.machine.native"), not MODULE.startswith("bl_ext.")
    native.load()
    assert native.load_a_copy is legacy
    # The files of this process that hold code or data in place, as Linux lists them.
    mapped = Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace")
    assert (str(native.file()) in mapped) is not legacy
    assert ("memfd:_medial" in mapped) is legacy


def test_removal_leaves_nothing_but_the_preferences_of_blender(blender, tmp_path):
    name = blender.install(archive(tmp_path / "new.zip"))
    play(blender, tmp_path, name, "compute()")
    if bpy.app.version >= (4, 2, 0):
        blender.run("--command", "extension", "remove", "medial_axis")
    else:
        remove = """
            window = bpy.context.window_manager.windows[0]
            with bpy.context.temp_override(window=window, area=window.screen.areas[0]):
                bpy.ops.preferences.addon_remove(module=name)
            bpy.ops.wm.save_userpref()
            """
        play(blender, tmp_path, name, remove)
    left = [path for path in (tmp_path / "profile").rglob("*") if "medial_axis" in path.name]
    assert left == []
    play(blender, tmp_path, name, 'assert not hasattr(bpy.types, "OBJECT_OT_medial_axis")')


WATCH = """
CACHE = os.path.join("extensions", ".cache")  # Blender's own: what it knows of all extensions
wrote = []
def watch(event, arguments):
    if event == "open":
        path, mode, flags = arguments
        if isinstance(path, int):
            return  # of what is open already: a file in memory
        if CACHE in str(path):
            return
        if (flags or 0) & (os.O_WRONLY | os.O_RDWR | os.O_CREAT) or set(mode or "") & set("wax+"):
            wrote.append((event, path))
    elif event.startswith(("socket.", "urllib.", "subprocess.", "os.system", "os.mkdir",
                           "os.rename", "os.remove", "os.rmdir", "os.link", "os.symlink", "shutil.")):
        if CACHE not in str(arguments[0]):
            wrote.append((event, *map(str, arguments)))
sys.addaudithook(watch)
kept = list(sys.path)
bpy.ops.preferences.addon_disable(module=name)
bpy.ops.preferences.addon_enable(module=name)
compute()
assert bpy.ops.object.medial_axis_sampling_report() == {"FINISHED"}
assert bpy.ops.object.tight_cocone_surface() == {"FINISHED"}
bpy.context.scene.medial_axis.theta = 1.0
bpy.ops.wm.medial_axis_self_test()
bpy.ops.wm.medial_axis_free_memory()
bpy.ops.preferences.addon_disable(module=name)
assert sys.path == kept
assert wrote == [], wrote
"""


def test_work_writes_no_file_needs_no_network_and_leaves_the_path(blender, tmp_path):
    name = blender.install(archive(tmp_path / "new.zip"))
    profile = tmp_path / "profile"

    def files():
        kept = (p for p in profile.rglob("*") if p.is_file() and ".cache" not in p.parts)
        return {path: path.stat().st_mtime_ns for path in kept}

    before = files()
    play(blender, tmp_path, name, WATCH)
    assert files() == before


def test_work_without_a_network(blender, tmp_path):
    """In a name space of its own there is no network at all."""
    if shutil.which("unshare") is None or os.system("unshare --net true 2>/dev/null") != 0:
        pytest.skip("unshare --net is not allowed here")
    name = blender.install(archive(tmp_path / "new.zip"))
    blender.program = ["unshare", "--net", *blender.program]
    work = "compute()\nassert bpy.ops.wm.medial_axis_self_test() == {'FINISHED'}"
    play(blender, tmp_path, name, work)


def test_sources_touch_no_path_and_no_network():
    network = re.compile(r"^\s*(import|from) (socket|urllib|http|requests|ssl)\b", re.M)
    for path in Path(addon().__file__).parent.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert "sys.path" not in text and not network.search(text), path
