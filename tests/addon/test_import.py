# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import of `.xyz`, `.xyzn` and `.off` files, and of points through Blender's own importers."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from installed import addon, in_wine
from measure import contents, entries_of, positions, reports, triangles_of
from scene import ellipsoid, link
from support.clouds import on_ellipsoid

POINTS, NORMALS = (np.float64(np.float32(x)) for x in on_ellipsoid(500))  # 9 digits are exact
AXES = ("X", "-X", "Y", "-Y", "Z", "-Z")
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


@pytest.fixture
def folder(tmp_path):
    """A folder with a scan, one with normals, a mesh, and a file that is none of these."""
    np.savetxt(tmp_path / "scan.xyz", POINTS, fmt="%.9g")
    np.savetxt(tmp_path / "oriented.xyzn", np.column_stack([POINTS, NORMALS]), fmt="%.9g")
    (tmp_path / "solid.off").write_text(TETRAHEDRON)
    (tmp_path / "bad.xyz").write_text("1 2 3\n4 5 six\n")
    return tmp_path


def read(path, *more, **options):
    """Import one file, or several of a folder; returns what the operator returns."""
    kind = "off" if path.suffix == ".off" else "xyz"
    operator = getattr(bpy.ops.import_mesh, f"points_{kind}")
    if more:
        names = [{"name": one.name} for one in (path, *more)]
        return operator(directory=str(path.parent), files=names, **options)
    return operator(filepath=str(path), **options)


def imported(path, **options):
    """The object that the import of a file makes."""
    assert read(path, **options) == {"FINISHED"}
    return bpy.context.object


def activate(collection):
    """Link a collection to the scene, and let new objects come into it."""
    bpy.context.scene.collection.children.link(collection)
    layer = bpy.context.view_layer.layer_collection.children[collection.name]
    bpy.context.view_layer.active_layer_collection = layer
    return layer


def normals_of(thing):
    return addon("bridge.mesh.attributes").read_normals(thing.data.attributes)


def test_points(folder, capfd):
    thing = imported(folder / "scan.xyz")
    assert (thing.name, thing.data.name, thing.type) == ("scan", "scan", "MESH")
    np.testing.assert_array_equal(positions(thing.data), np.float32(POINTS))
    assert len(thing.data.edges) == len(thing.data.polygons) == 0
    assert normals_of(thing) is None
    assert np.array_equal(thing.matrix_world, np.identity(4))
    assert reports(capfd) == [("Info", "'scan': 500 points, 0 faces")]


def test_faces(folder, capfd):
    mesh = imported(folder / "solid.off").data
    assert triangles_of(mesh).tolist() == [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    assert len(mesh.edges) == 6 and not any(polygon.use_smooth for polygon in mesh.polygons)
    assert reports(capfd) == [("Info", "'solid': 4 points, 4 faces")]


def test_what_is_imported_is_selected_alone_and_active(folder):
    other = link("Other", [(0, 0, 0)])
    collection = bpy.data.collections.new("Active")
    activate(collection)
    read(folder / "scan.xyz", folder / "oriented.xyzn")
    names = [thing.name for thing in bpy.context.selected_objects]
    assert sorted(names) == ["oriented", "scan"] and not other.select_get()
    assert bpy.context.object.name == "oriented"
    assert sorted(thing.name for thing in collection.objects) == ["oriented", "scan"]


def test_import_leaves_edit_mode(folder):
    edited = ellipsoid()
    bpy.ops.object.mode_set(mode="EDIT")
    read(folder / "scan.xyz")
    assert (edited.mode, bpy.context.object.name) == ("OBJECT", "scan")


def test_collection_that_is_not_shown(folder):
    activate(bpy.data.collections.new("Hidden")).exclude = True
    assert read(folder / "scan.xyz") == {"FINISHED"}
    assert "scan" in bpy.data.objects and bpy.data.objects["scan"].users_collection


def test_collection_of_another_file(folder):
    """It cannot be added to, so that the scene's own takes the object."""
    if in_wine() and bpy.app.version >= (5, 0, 0):
        pytest.skip("Blender does not read in Wine what it wrote there")
    bpy.data.libraries.write(str(folder / "a.blend"), {bpy.data.collections.new("Theirs")})
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(folder / "a.blend"), link=True) as (_, loaded):
        loaded.collections = ["Theirs"]
    activate(bpy.data.collections["Theirs"])
    assert bpy.context.collection.library is not None
    read(folder / "scan.xyz")
    assert bpy.context.object.users_collection == (bpy.context.scene.collection,)


@pytest.mark.filterwarnings("error:.*blend relative:RuntimeWarning")
def test_path_beside_the_blend_file(folder):
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "scene.blend"))
    for words in ({"filepath": "//scan.xyz"}, {"directory": "//", "files": [{"name": "scan.xyz"}]}):
        assert bpy.ops.import_mesh.points_xyz(**words) == {"FINISHED"}


# --- axes and scale


@pytest.mark.parametrize("forward, up", [(f, u) for f in AXES for u in AXES if f[-1] != u[-1]])
def test_axes(folder, forward, up):
    """The forward axis of the file becomes Y and its up axis Z; normals are rotated too."""
    thing = imported(folder / "oriented.xyzn", axis_forward=forward, axis_up=up)
    axes = {"XYZ"[i]: row for i, row in enumerate(np.identity(3))}
    axes |= {f"-{name}": -axis for name, axis in axes.items()}
    turn = np.array([np.cross(axes[forward], axes[up]), axes[forward], axes[up]])
    np.testing.assert_array_equal(positions(thing.data), np.float32(POINTS @ turn.T))
    np.testing.assert_allclose(normals_of(thing), NORMALS @ turn.T, atol=1e-7)


@pytest.mark.parametrize("scale", [1.0, 0.25])
def test_scale_and_normals(folder, scale, capfd):
    thing = imported(folder / "oriented.xyzn", global_scale=scale)
    np.testing.assert_array_equal(positions(thing.data), np.float32(scale * POINTS))
    np.testing.assert_allclose(normals_of(thing), NORMALS, atol=1e-7)
    assert tuple(thing.scale) == (1, 1, 1)
    assert reports(capfd) == [("Info", "'oriented': 500 points, 0 faces, with normals")]


@pytest.mark.parametrize("forward, up", [(f, u) for f in AXES for u in AXES if f[-1] == u[-1]])
def test_one_axis_twice(folder, forward, up):
    """Blender chooses another axis, as in its own importers."""
    found = np.abs(positions(imported(folder / "scan.xyz", axis_forward=forward, axis_up=up).data))
    np.testing.assert_array_equal(np.sort(found), np.sort(np.abs(np.float32(POINTS))))


# --- what is wrong


def test_bad_file_leaves_nothing(folder):
    edited = ellipsoid()
    bpy.ops.object.mode_set(mode="EDIT")
    before = contents()
    for name, words in (("bad.xyz", "line 2 of 'bad.xyz', found 'six'"), ("no.off", "found none")):
        with pytest.raises(RuntimeError, match=words) as error:
            read(folder / name)
        assert "Traceback" not in str(error.value)
    assert contents() == before
    assert edited.mode == "EDIT" and edited.select_get()


def test_good_ones_of_several_files_are_imported(folder):
    with pytest.raises(RuntimeError, match="found 'six'"):
        read(folder / "bad.xyz", folder / "scan.xyz", folder / "oriented.xyzn")
    assert contents()[:2] == [["oriented", "scan"]] * 2
    assert bpy.context.object.name == "oriented"


def test_coordinates_that_blender_cannot_hold(folder):
    (folder / "far.xyz").write_text("0 0 0\n1 2 1e39\n")
    with pytest.raises(RuntimeError, match=r"below 3.4e\+38, .* found 1e\+39"):
        read(folder / "far.xyz")
    assert not any(contents())
    assert read(folder / "far.xyz", global_scale=1e-3) == {"FINISHED"}


def test_faces_that_blender_cannot_hold(folder, capfd):
    """They would crash it, or its tools, later."""
    faces = "3 0 0 1\n3 2 1 0\n4 0 1 2 0\n2 0 1\n"
    (folder / "odd.off").write_text(TETRAHEDRON.replace("4 4 0", "4 8 0") + faces)
    mesh = imported(folder / "odd.off").data
    assert not mesh.validate() and len(mesh.polygons) == 4
    told = [text for kind, text in reports(capfd) if kind == "Warning"]
    assert told == [
        "'odd': Left out faces of fewer than three corners: 1",
        "'odd': Left out faces that repeat a corner or another face: 3",
    ]


# --- undo, menu, dropping


def test_menu_entries():
    draw = addon("ui.axis.import_points").menu_func_import
    assert entries_of(draw, bpy.types.TOPBAR_MT_file_import) == {
        "import_mesh.points_xyz": "Points (.xyz/.xyzn)",
        "import_mesh.points_off": "Object File Format (.off)",
    }


def test_dropped_files_are_not_asked_for_again():
    """Blender's helper shows the options alone when it knows the files; before 4.1 there is no dropping."""
    shared, asked = addon("ui.axis.import_points").ImportPoints, []
    manager = SimpleNamespace(fileselect_add=lambda _operator: asked.append("files"))
    context = SimpleNamespace(window_manager=manager)

    class Dropping(shared):
        def invoke_popup(self, _context):
            asked.append("options")

    Dropping().invoke(context, None)
    assert asked == ["options"]
    if not hasattr(shared, "invoke_popup"):
        shared().invoke(context, None)
        assert asked == ["options", "files"]


def test_files_can_be_dropped_where_blender_takes_them():
    module = addon("ui.axis.import_points")
    made = [module.drop_handler(object, operator) for operator in module.OPERATORS]
    assert [(cls.bl_import_operator, cls.bl_file_extensions) for cls in made] == [
        ("import_mesh.points_xyz", ".xyz;.xyzn"),
        ("import_mesh.points_off", ".off"),
    ]
    for space, taken in (("VIEW_3D", True), ("OUTLINER", True), ("CONSOLE", False), (None, False)):
        area = space and SimpleNamespace(type=space)
        assert made[0].poll_drop(SimpleNamespace(area=area)) == taken
    assert len(module.HANDLERS) == (2 if hasattr(bpy.types, "FileHandler") else 0)
