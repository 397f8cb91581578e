# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on comes and goes without a trace; every option is what core.settings says."""

import ast
import math
import re
import sys
from pathlib import Path

import bpy
import pytest
from installed import MODULE, addon
from scene import compute, ellipsoid, link

SAMPLING = (
    "sampling",
    "prepare",
    "samples",
    "spacing",
    "epsilon",
    "budget",
    "wrap_opening",
    "sharp_angle",
    "smooth",
    "keep_vertices",
    "pairs",
    "seed",
)
OPTIONS = (
    *("form", "simplify", "erode", "spike", "limb", "detail", "crisp"),
    *("theta", "rho", "side", "sides", "rule", "criteria", "limit_set", "mesh"),
    *SAMPLING,
)


def menu_texts(menu):
    return [function.__module__ for function in menu._dyn_ui_initialize()]


TYPES = """
OBJECT_OT_medial_axis OBJECT_OT_medial_axis_sampling_report OBJECT_OT_tight_cocone_surface
OBJECT_OT_medial_axis_cancel EXPORT_SCENE_OT_medial_axis OBJECT_OT_medial_axis_sequence
IMPORT_SCENE_OT_medial_axis_sequence VIEW3D_PT_medial_axis_sequence VIEW3D_PT_medial_axis
VIEW3D_PT_medial_axis_sampling
"""


def present():
    return {
        **{name: hasattr(bpy.types, name) for name in TYPES.split()},
        "sequence folder": hasattr(bpy.types.Scene, "medial_axis_folder"),
        "sequence menu": f"{MODULE}.ui.axis.compute_sequence"
        in menu_texts(bpy.types.TOPBAR_MT_file_import),
        "settings": hasattr(bpy.types.Scene, "medial_axis"),
        "progress": hasattr(bpy.types.WindowManager, "medial_axis_progress"),
        "object menu": f"{MODULE}.ui.panels.menus" in menu_texts(bpy.types.VIEW3D_MT_object),
        "context menu": f"{MODULE}.ui.panels.menus"
        in menu_texts(bpy.types.VIEW3D_MT_object_context_menu),
        "export menu": f"{MODULE}.ui.axis.export_axis"
        in menu_texts(bpy.types.TOPBAR_MT_file_export),
        "handler": any(h.__module__.startswith(MODULE) for h in bpy.app.handlers.load_pre),
    }


def test_everything_is_registered():
    assert all(present().values()), present()


def test_disable_removes_everything_and_enable_brings_it_back():
    for _ in range(2):
        bpy.ops.preferences.addon_disable(module=MODULE)
        assert not any(present().values()), present()
        assert not [
            name for name in sys.modules if name.startswith(f"{MODULE}.") and ".lib" not in name
        ]
        bpy.ops.preferences.addon_enable(module=MODULE)
        assert all(present().values()), present()
    assert compute(ellipsoid()) is not None


def test_registration_leaves_the_file_alone():
    link("Something", [(0, 0, 0)])
    kinds = ("objects", "meshes", "materials", "collections", "node_groups")
    before = {kind: [thing.name for thing in getattr(bpy.data, kind)] for kind in kinds}
    bpy.ops.preferences.addon_disable(module=MODULE)
    bpy.ops.preferences.addon_enable(module=MODULE)
    assert {kind: [thing.name for thing in getattr(bpy.data, kind)] for kind in kinds} == before


def test_importing_needs_no_blender():
    source = Path(addon().__file__).read_text(encoding="utf-8")
    top = [
        node for node in ast.parse(source).body if isinstance(node, (ast.Import, ast.ImportFrom))
    ]
    assert top == []


def test_one_version():
    manifest = (Path(addon().__file__).parent / "blender_manifest.toml").read_text(encoding="utf-8")
    assert f'version = "{addon().__version__}"' in manifest
    release = addon().__version__.partition("+")[0]
    assert addon("core.machine.native").load().__version__ == release


@pytest.mark.parametrize("name", OPTIONS)
def test_options_of_operator_and_panel_come_from_settings(name):
    option = addon("core.settings").OPTIONS[name]
    owners = [bpy.ops.object.medial_axis.get_rna_type(), bpy.context.scene.medial_axis.bl_rna]
    if name in ("side", "sides", *SAMPLING):
        owners.append(bpy.ops.object.medial_axis_sampling_report.get_rna_type())
    for owner in owners:
        assert_shows(owner.properties[name], option)


# The property of a number has these from its option.
FLOATS = {
    "default": "default",
    "hard_min": "minimum",
    "hard_max": "maximum",
    "soft_max": "soft_maximum",
}
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


def test_defaults_are_those_of_the_compiled_module():
    settings = addon("core.settings")
    module = addon("core.machine.native").load()
    default = settings.Settings()
    # pybind11 writes the types in other words from version to version.
    signature = module.MedialAnalysis.extract.__doc__.splitlines()[0]
    for name in ("theta", "rho", "limit_set"):
        assert re.search(rf"\b{name}: [^=]*= {getattr(default, name)!r}\b", signature), signature
    assert f"Rule.{default.rule.name}:" in signature
    assert f"Criteria.{default.criteria.name}:" in signature
    for enum in (settings.Rule, settings.Criteria):
        assert {member.name for member in enum} <= set(getattr(module, enum.__name__).__members__)
    signature = module.sample_surface.__doc__.splitlines()[0]
    for name in ("sharp_angle", "keep_vertices", "seed"):
        assert re.search(rf"\b{name}: [^=]*= {getattr(default, name)!r}\b", signature), signature
    for side in set(settings.Side) - {settings.Side.AUTOMATIC}:
        assert side.name in module.Side.__members__
    for source in set(settings.SidesFrom) - {settings.SidesFrom.WRAP}:  # it makes other faces
        assert source.name in module.SidesFrom.__members__


def test_what_does_not_apply_is_grey():
    settings = addon("core.settings")
    of = {
        name: {kind.name for kind in settings.SamplingMode if settings.applies(name, kind, 0.0)}
        for name in settings.SAMPLING_OPTIONS
    }
    everywhere, faces = {"AUTOMATIC", "VERTICES", "SURFACE", "ADAPTIVE"}, {"AUTOMATIC", "ADAPTIVE"}
    assert (
        of["epsilon"] == of["wrap_opening"] == of["prepare"] == everywhere and of["budget"] == faces
    )
    others = set(of) - {"epsilon", "wrap_opening", "prepare", "budget"}
    assert all(of[name] == faces | {"SURFACE"} for name in others)
    assert not settings.applies("samples", settings.SamplingMode.SURFACE, 1.0)
    vertices = settings.SamplingMode.VERTICES
    assert settings.applies("smooth", vertices, 0.0, settings.Settings().options_of_faces)
    assert not settings.applies("seed", vertices, 0.0, settings.Settings().options_of_faces)
    assert {"sampling", *of} == set(SAMPLING)


def test_rounded_limits_and_defaults_mean_the_exact_numbers():
    exact = addon("ui.settings.properties")._exact
    theta = addon("core.settings").OPTIONS["theta"]
    panel = bpy.context.scene.medial_axis
    assert panel.theta != theta.default
    assert exact(theta, panel.theta) == math.pi / 8
    panel.theta = math.pi / 2
    assert panel.theta > math.pi / 2
    assert exact(theta, panel.theta) == math.pi / 2
    assert exact(theta, 0.5) == 0.5


@pytest.mark.parametrize(
    "values",
    [
        {"theta": -0.1},
        {"theta": 1.6},
        {"rho": -1.0},
        {"rho": math.nan},
        {"samples": 99},
        {"spacing": 10.5},
        {"epsilon": 0.0},
        {"budget": 0},
        {"sharp_angle": 0.0},
        {"seed": -1},
    ],
)
def test_settings_out_of_range_are_refused(values):
    with pytest.raises(
        addon("core.errors").InvalidInputError, match=rf"Expected {next(iter(values))} .*, found"
    ):
        addon("core.settings").Settings(**values)
