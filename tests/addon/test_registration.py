# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on comes and goes without a trace; every option is what core.settings says."""

import math
import sys

import bpy
import pytest
from installed import MODULE, addon
from scene import compute, ellipsoid, link

SAMPLING = (
    *("sampling", "prepare", "samples", "spacing", "epsilon", "budget"),
    *("wrap_opening", "sharp_angle", "smooth", "keep_vertices", "pairs", "seed"),
)
OPTIONS = (
    *("form", "simplify", "erode", "spike", "limb", "detail", "crisp"),
    *("theta", "rho", "side", "sides", "rule", "criteria", "limit_set", "mesh"),
    *SAMPLING,
)


def present():
    types = bpy.types
    found = {name: hasattr(types, name) for name in TYPES.split()}
    for menu, module in (
        (types.TOPBAR_MT_file_import, "ui.axis.compute_sequence"),
        (types.TOPBAR_MT_file_import, "ui.axis.import_points"),
        (types.TOPBAR_MT_file_export, "ui.axis.export_axis"),
        (types.VIEW3D_MT_object, "ui.panels.menus"),
        (types.VIEW3D_MT_object_context_menu, "ui.panels.menus"),
    ):
        entries = [function.__module__ for function in menu._dyn_ui_initialize()]
        found[menu.__name__, module] = f"{MODULE}.{module}" in entries
    return {
        **found,
        "sequence folder": hasattr(types.Scene, "medial_axis_folder"),
        "settings": hasattr(types.Scene, "medial_axis"),
        "progress": hasattr(types.WindowManager, "medial_axis_progress"),
        "handler": any(h.__module__.startswith(MODULE) for h in bpy.app.handlers.load_pre),
    }


TYPES = """
OBJECT_OT_medial_axis OBJECT_OT_medial_axis_sampling_report OBJECT_OT_tight_cocone_surface
OBJECT_OT_medial_axis_cancel EXPORT_SCENE_OT_medial_axis OBJECT_OT_medial_axis_sequence
IMPORT_SCENE_OT_medial_axis_sequence VIEW3D_PT_medial_axis_sequence VIEW3D_PT_medial_axis
VIEW3D_PT_medial_axis_sampling IMPORT_MESH_OT_points_xyz IMPORT_MESH_OT_points_off
"""


def test_disable_removes_everything_and_enable_brings_it_back():
    assert all(present().values()), present()
    for _ in range(2):
        bpy.ops.preferences.addon_disable(module=MODULE)
        assert not any(present().values()), present()
        left = (name for name in sys.modules if name.startswith(f"{MODULE}."))
        assert not [name for name in left if ".lib" not in name]
        bpy.ops.preferences.addon_enable(module=MODULE)
        assert all(present().values()), present()
    assert compute(ellipsoid()) is not None


def test_registration_leaves_the_file_alone():
    link("Something", [(0, 0, 0)])
    kinds = ("objects", "meshes", "materials", "collections", "node_groups")
    names = lambda: {kind: [thing.name for thing in getattr(bpy.data, kind)] for kind in kinds}
    before = names()
    bpy.ops.preferences.addon_disable(module=MODULE)
    bpy.ops.preferences.addon_enable(module=MODULE)
    assert names() == before


@pytest.mark.parametrize("name", OPTIONS)
def test_options_of_operator_and_panel_come_from_settings(name):
    option = addon("core.settings").OPTIONS[name]
    owners = [bpy.ops.object.medial_axis.get_rna_type(), bpy.context.scene.medial_axis.bl_rna]
    if name in ("side", "sides", *SAMPLING):
        owners.append(bpy.ops.object.medial_axis_sampling_report.get_rna_type())
    for owner in owners:
        assert_shows(owner.properties[name], option)


# The property of a number has these from its option.
FLOATS = {"default": "default", "hard_min": "minimum", "hard_max": "maximum"}
FLOATS["soft_max"] = "soft_maximum"
INTEGERS = FLOATS | {"soft_min": "soft_minimum"}


def assert_shows(shown, option):
    """A property of Blender is that of an option."""
    assert (shown.name, shown.description) == (option.label, option.description)
    if shown.type == "ENUM":
        assert shown.default == option.default.name
        assert [(i.identifier, i.name) for i in shown.enum_items] == [
            (member.name, label) for member, (label, _) in option.items.items()
        ]
    elif shown.type in ("FLOAT", "INT"):
        for name, own in (FLOATS if shown.type == "FLOAT" else INTEGERS).items():
            value = getattr(option, own)
            same = value if shown.type == "INT" else pytest.approx(value, rel=1e-7)
            assert getattr(shown, name) == same or not math.isfinite(value), name
        assert (shown.subtype == "ANGLE") == (option.unit == "rad")
        assert (shown.subtype == "PERCENTAGE") == (option.unit == "%")
    else:
        assert shown.default == option.default


def test_all_options_are_tested_here():
    assert tuple(addon("core.settings").OPTIONS) == OPTIONS
    assert tuple(addon("core.settings").Settings.__dataclass_fields__) == OPTIONS


def test_what_does_not_apply_is_grey():
    settings = addon("core.settings")
    modes, applies = settings.SamplingMode, settings.applies
    of = {
        name: {kind.name for kind in modes if applies(name, kind, 0.0)}
        for name in settings.SAMPLING_OPTIONS
    }
    everywhere, faces = {"AUTOMATIC", "VERTICES", "SURFACE", "ADAPTIVE"}, {"AUTOMATIC", "ADAPTIVE"}
    known = dict.fromkeys(("epsilon", "wrap_opening", "prepare"), everywhere) | {"budget": faces}
    assert of == dict.fromkeys(of, faces | {"SURFACE"}) | known
    assert not applies("samples", modes.SURFACE, 1.0)
    options = settings.Settings().options_of_faces
    assert applies("smooth", modes.VERTICES, 0.0, options)
    assert not applies("seed", modes.VERTICES, 0.0, options)
    assert {"sampling", *of} == set(SAMPLING)


def test_rounded_limits_and_defaults_mean_the_exact_numbers():
    exact, panel = addon("ui.settings.properties")._exact, bpy.context.scene.medial_axis
    theta = addon("core.settings").OPTIONS["theta"]
    assert panel.theta != theta.default
    assert exact(theta, panel.theta) == math.pi / 8
    panel.theta = math.pi / 2
    assert panel.theta > math.pi / 2
    assert exact(theta, panel.theta) == math.pi / 2
    assert exact(theta, 0.5) == 0.5


OUT_OF_RANGE = [("theta", -0.1), ("theta", 1.6), ("rho", -1.0), ("rho", math.nan), ("samples", 99)]
OUT_OF_RANGE += [("spacing", 10.5), ("epsilon", 0.0), ("sharp_angle", 0.0)]
OUT_OF_RANGE += [("budget", 0), ("seed", -1)]


@pytest.mark.parametrize(("name", "value"), OUT_OF_RANGE)
def test_settings_out_of_range_are_refused(name, value):
    error = addon("core.errors").InvalidInputError
    with pytest.raises(error, match=rf"Expected {name} .*, found"):
        addon("core.settings").Settings(**{name: value})
