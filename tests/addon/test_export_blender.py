# SPDX-License-Identifier: GPL-3.0-or-later
"""Files made inside Blender: by our operator, and of the result by Blender's own exporters, read back."""

import os

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, entries_of, positions, reports, world_positions
from scene import compute, export, in_edit_mode, link, refuse_export, select, suzanne, torus
from support.readers import read_ma

EXTENSIONS = (".ma", ".ply", ".obj", ".off", ".npz")
BEFORE_4 = bpy.app.version < (4, 0, 0)


@pytest.fixture
def result():
    """The inner axis of a moved and rotated torus; selected and active."""
    source = torus()
    source.location, source.rotation_euler = (3, -2, 1), (0.3, -0.5, 0.7)
    axis = compute(source, side="INNER")
    select(axis)
    return axis


def corner_counts(mesh):
    return np.array([polygon.loop_total for polygon in mesh.polygons])


def polygons(mesh):
    return [np.array(polygon.vertices) for polygon in mesh.polygons]


def assert_same_points(found, expected, rounding=4):
    """Equal row by row, up to a few last bits of the float32 coordinates that Blender keeps."""
    tolerance = rounding * np.finfo(np.float32).eps * np.abs(expected).max()
    assert found.shape == expected.shape
    np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance)


def assert_same_point_set(found, expected):
    """The same places, in any order and any number of times."""
    from scipy.spatial import cKDTree

    tolerance = 4 * np.finfo(np.float32).eps * np.abs(expected).max()
    assert cKDTree(expected).query(found)[0].max() <= tolerance
    assert cKDTree(found).query(expected)[0].max() <= tolerance


# --- our operator


@pytest.mark.parametrize("extension", EXTENSIONS)
def test_operator_writes_every_format(result, extension, tmp_path, capfd):
    path = tmp_path / f"axis{extension}"
    export(path)
    assert [p.name for p in tmp_path.iterdir()] == [path.name] and path.stat().st_size > 1000
    kind, text = reports(capfd)[-1]
    assert kind == "Info" and f"{len(result.data.polygons):,} facets" in text and path.name in text


def test_ma_holds_the_result_in_the_world(result, tmp_path):
    export(tmp_path / "axis.ma")
    vertices, edges, faces = read_ma(tmp_path / "axis.ma")
    assert_same_points(vertices[:, :3], world_positions(result), rounding=1)
    assert np.array_equal(vertices[:, 3], attribute(result.data, "ma_radius").astype(np.float64))
    assert len(faces) == (corner_counts(result.data) - 2).sum()
    assert len(np.unique(edges, axis=0)) == len(edges) and (edges[:, 0] < edges[:, 1]).all()
    result.location.x += 10
    export(tmp_path / "axis.ma")
    assert_same_points(read_ma(tmp_path / "axis.ma")[0][:, :3], world_positions(result), rounding=1)


def test_npz_holds_all_attributes(result, tmp_path):
    export(tmp_path / "axis.npz")
    arrays, mesh = np.load(tmp_path / "axis.npz"), result.data
    for name in ("theta", "rho", "side"):
        found = arrays[name]
        assert np.array_equal(found, attribute(mesh, f"ma_{name}").astype(found.dtype))
    assert np.array_equal(np.diff(arrays["face_offsets"]), corner_counts(mesh))
    assert np.array_equal(arrays["face_vertices"], np.concatenate(polygons(mesh)))
    assert arrays["generators"].shape == (len(mesh.polygons), 2)
    # The axis lies halfway between its generators.
    samples = world_positions(source_of(result))[arrays["generators"]]
    first = arrays["vertices"][arrays["face_vertices"][arrays["face_offsets"][:-1]]]
    near, far = (np.linalg.norm(first - samples[:, end], axis=1) for end in (0, 1))
    np.testing.assert_allclose(near, far, rtol=1e-4)


def source_of(result):
    return addon("bridge.objects.output_object").source_of(result)


def test_read_axis_is_the_computed_axis_in_float32(result):
    read = addon("bridge.axis.read_axis").read_axis(result)
    settings = addon("bridge.axis.axis_object").settings_of(result)
    axis = addon("core.axis.compute").refilter(result["ma_analysis"], settings)
    for name in ("face_offsets", "face_vertices", "side", "generators", "unbounded"):
        assert np.array_equal(getattr(read, name), getattr(axis, name)), name
    for name in ("vertices", "radius", "theta", "rho"):
        assert getattr(read, name).dtype == np.float64
        assert np.array_equal(getattr(read, name), getattr(axis, name).astype(np.float32)), name


def test_source_exports_its_result(result, tmp_path):
    for name, thing in (("result", result), ("source", source_of(result))):
        select(thing)
        export(tmp_path / f"{name}.off")
    assert (tmp_path / "result.off").read_bytes() == (tmp_path / "source.off").read_bytes()
    export(tmp_path / "axis", file_format="OFF")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["axis.off", "result.off", "source.off"]


def test_result_keeps_its_scale(result, tmp_path):
    export(tmp_path / "before.ma")
    result.scale = (2, 1, 3)
    export(tmp_path / "after.ma")
    assert all(result.lock_scale)
    before, after = (read_ma(tmp_path / f"{name}.ma")[0] for name in ("before", "after"))
    np.testing.assert_allclose(after, before, rtol=1e-5, atol=1e-6)


def test_result_scaled_evenly_scales_its_radii_and_unevenly_it_is_refused(result, tmp_path):
    result.constraints.clear()
    result.scale = (2, 2, 2)
    export(tmp_path / "axis.ma")
    vertices = read_ma(tmp_path / "axis.ma")[0]
    assert_same_points(vertices[:, :3], world_positions(result))
    np.testing.assert_allclose(vertices[:, 3], 2 * attribute(result.data, "ma_radius"), rtol=1e-5)
    result.scale = (2, 1, 1)
    refuse_export("scaled evenly, found scales from 1 to 2", tmp_path / "other.ma")


def test_edited_result_is_exported_as_it_is(result, tmp_path):
    with in_edit_mode():
        bpy.ops.mesh.select_all(action="DESELECT")
    for face in result.data.polygons[:50]:
        face.select = True
    with in_edit_mode():
        bpy.ops.mesh.delete(type="FACE")
        export(tmp_path / "axis.npz")
    arrays = np.load(tmp_path / "axis.npz")
    assert np.array_equal(arrays["face_vertices"], np.concatenate(polygons(result.data)))
    assert np.array_equal(arrays["rho"], attribute(result.data, "ma_rho").astype(np.float64))


def test_unknown_extension_and_missing_attribute_are_named(result, tmp_path):
    words = r"\.ma, \.ply, \.obj, \.off, \.npz or \.csv, found 'axis\.stl'"
    refuse_export(words, tmp_path / "axis.stl")
    result.data.attributes.remove(result.data.attributes["ma_radius"])
    words = "'ma_radius' on 'Torus Medial Axis'.*compute the medial axis again"
    refuse_export(words, tmp_path / "axis.ma")


def test_nothing_to_export_says_so(tmp_path):
    link("Plain", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    refuse_export("Select a medial axis", tmp_path / "axis.ma")
    select()
    refuse_export("Select a medial axis", tmp_path / "axis.ma")


@pytest.mark.skipif(os.name == "nt", reason="names are bytes where files are POSIX's")
def test_name_that_is_no_text(result, tmp_path, capfd):
    """Blender takes text alone in what operators report."""
    reports(capfd)
    path = os.fsencode(tmp_path) + b"/caf\xe9.ma"
    export(os.fsdecode(path))
    assert os.path.getsize(path) > 1000
    assert [(kind, "caf\\udce9.ma" in text) for kind, text in reports(capfd)] == [("Info", True)]


@pytest.mark.filterwarnings("error:.*blend relative:RuntimeWarning")
def test_path_beside_the_blend_file(result, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    export("//axis.obj")
    assert (tmp_path / "axis.obj").is_file()


def remembered(thing):
    """The custom properties of an object; those of several values as lists and dictionaries."""
    found = {}
    for name, value in thing.items():
        read = getattr(value, "to_list", None) or getattr(value, "to_dict", None)
        found[name] = value if read is None else read()
    return found


def test_export_does_not_change_the_result(result, tmp_path):
    mesh = result.data
    state = lambda: (positions(mesh).tobytes(), mesh.attributes.keys(), remembered(result))
    before = state()
    for extension in EXTENSIONS:
        export(tmp_path / f"axis{extension}")
    assert state() == before


def test_menu_entry():
    draw = addon("ui.axis.export_axis").menu_func_export
    assert entries_of(draw, bpy.types.TOPBAR_MT_file_export) == {
        "export_scene.medial_axis": "Medial Axis (.ma/.ply/.obj/.off/.npz/.csv)"
    }


@pytest.mark.parametrize(
    "path, shown, chosen, expected",
    [
        ("/a/axis.ma", "MA", "PLY", ("/a/axis.ply", "PLY")),  # another format was chosen
        ("/a/axis.OBJ", "MA", "MA", ("/a/axis.OBJ", "OBJ")),  # another name was typed
        ("/a/axis", "OFF", "OFF", ("/a/axis.off", "OFF")),  # no extension was typed
        ("/a/axis.v2", "MA", "MA", ("/a/axis.v2.ma", "MA")),  # a dot that is no extension
        ("/a/axis.ma", "MA", "MA", ("/a/axis.ma", "MA")),
        ("//axis", "MA", "MA", ("//axis.ma", "MA")),  # beside the .blend file
    ],
)
def test_file_browser_keeps_name_and_format_together(path, shown, chosen, expected):
    cls = addon("ui.axis.export_axis").EXPORT_SCENE_OT_medial_axis

    class Browser:
        filepath, file_format, _shown_format = path, chosen, shown
        extensions = addon("ui.axis.export_axis")._EXTENSIONS
        filename_ext = property(lambda self: self.extensions[self.file_format])

    browser = Browser()
    changed = cls.check(browser, bpy.context)
    assert (browser.filepath, browser.file_format) == expected
    assert bool(changed) == (browser.filepath != path)
    assert not cls.check(browser, bpy.context), "nothing changed since"


# --- our files in Blender's importers


def called(name, **options):
    """Call an operator of Blender by its name; it must succeed."""
    group, _, operator = name.partition(".")
    assert getattr(getattr(bpy.ops, group), operator)(**options) == {"FINISHED"}


def imported(name, path, **options):
    """The object that an import operator makes."""
    before = set(bpy.data.objects)
    called(name, filepath=str(path), **options)
    (new,) = [thing for thing in set(bpy.data.objects) - before if thing.type == "MESH"]
    return new


READ_PLY = "import_mesh.ply" if BEFORE_4 else "wm.ply_import"
UPRIGHT = {"forward_axis": "Y", "up_axis": "Z"}
READERS = [(".ply", READ_PLY, {}), (".obj", "wm.obj_import", UPRIGHT)]


@pytest.mark.parametrize(("suffix", "operator", "options"), READERS)
def test_our_files_in_blenders_importers(result, tmp_path, suffix, operator, options):
    """The importer of PLY may begin a polygon at another corner."""
    export(tmp_path / f"axis{suffix}")
    again = imported(operator, tmp_path / f"axis{suffix}", **options)
    assert_same_points(world_positions(again), world_positions(result))
    for found, expected in zip(polygons(again.data), polygons(result.data)):
        pair = map(np.sort, (found, expected)) if suffix == ".ply" else (found, expected)
        assert np.array_equal(*pair)
    assert len(again.data.polygons) == len(result.data.polygons)


# --- the result in Blender's exporters


CHOSEN, OLDER = {"export_selected_objects": True}, {"use_selection": True}
QUIET = {"use_normals": False, "use_uv_coords": False, "use_colors": False}
NEW_FBX = hasattr(bpy.types, "WM_OT_fbx_import")
# How each format is written, with which options, and read; other shading stumbles over np.bool in Blender 3.4 with
# NumPy 1.24.
FORMATS = {
    "obj": ("wm.obj_export", CHOSEN, "wm.obj_import", {}),
    "fbx": ("export_scene.fbx", OLDER, "wm.fbx_import" if NEW_FBX else "import_scene.fbx", {}),
    "glb": ("export_scene.gltf", OLDER, "import_scene.gltf", {"import_shading": "FLAT"}),
    "ply": ("wm.ply_export", CHOSEN, READ_PLY, {}),
    "stl": ("wm.stl_export", CHOSEN, "wm.stl_import", {}),
}
if BEFORE_4:
    FORMATS["ply"] = ("export_mesh.ply", OLDER | QUIET, READ_PLY, {})
    FORMATS["stl"] = ("export_mesh.stl", OLDER, "import_mesh.stl", {})


@pytest.mark.parametrize("name", FORMATS)
def test_blenders_exporters_keep_the_places(result, name, tmp_path):
    """They keep the polygons, too; those of glTF and STL cut them into triangles."""
    writer, chosen, reader, options = FORMATS[name]
    path = tmp_path / f"axis.{name}"
    called(writer, filepath=str(path), **chosen)
    again, counts = imported(reader, path, **options), corner_counts(result.data)
    if name in ("glb", "stl"):
        assert len(again.data.polygons) == (counts - 2).sum()
    else:
        assert np.array_equal(corner_counts(again.data), counts)
        assert len(again.data.vertices) == len(result.data.vertices)
    assert_same_point_set(world_positions(again), world_positions(result))


@pytest.mark.skipif("collada_export" not in dir(bpy.ops.wm), reason="this Blender has no COLLADA")
def test_our_reader_takes_blenders_collada(tmp_path):
    """An object in a stretched one lies where Blender has it; each material has a group of polygons."""
    outer, inner = suzanne(), torus()
    outer.location, outer.rotation_euler, outer.scale = (3, -2, 1), (0.3, -0.5, 0.7), (1, 2, -0.5)
    inner.parent, inner.location, inner.rotation_euler = outer, (0, 1, 0), (0.2, 0.4, 0.1)
    for name in "ab":
        inner.data.materials.append(bpy.data.materials.new(name))
    inner.data.polygons[7].material_index = 1
    bpy.context.view_layer.update()
    called("wm.collada_export", filepath=str(tmp_path / "both.dae"), triangulate=False)
    found = addon("core.files.read").import_points(tmp_path / "both.dae")
    places = np.concatenate([world_positions(outer), world_positions(inner)])
    assert_same_point_set(found.vertices, places)
    sizes = np.concatenate([corner_counts(outer.data), corner_counts(inner.data)])
    assert np.array_equal(np.sort(np.diff(found.face_offsets)), np.sort(sizes))
