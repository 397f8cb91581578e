# SPDX-License-Identifier: GPL-3.0-or-later
"""Every text that the add-on shows: labels and descriptions of what is registered, and sentences of its sources."""

import ast
import inspect
import re
from pathlib import Path

import bpy
from bl_ui.utils import PresetPanel
from scene import MODULE, addon

# Sources whose texts nobody sees in Blender's windows, and texts that are data or belong to Blender.
HIDDEN = {
    "bridge/material.py",
    "core/batch/batch.py",
    "core/batch/outputs.py",
    "core/machine/free_memory.py",
    "core/batch/option_words.py",
    "core/files/robot_links.py",
    "core/files/thickness_page.py",
    "core/files/vtp.py",
    "core/files/write_mid_surface.py",
    "core/machine/cache.py",
    "ui/translation.py",
}
DATA = {
    "Error: {}",
    "{} of {}",
    "x y z",
    "x y z nx ny nz",
    "{} or {}",
    "{} {}",
    "'{}'",
    "of {}",
    "property float {}\n",
    "property int kind\n",
    "property int part\n",
    "property int place\n",
    "{} Follow",
    "{} Part {}",
    "{} Parts",
    "{} Medial Axes",
    " Medial Axis",
    " Small Mesh",
    " Thick Parts",
    "Medial Axis Wires",
    "Medial Axis Capsules",
    "Medial Axis Drain",
    "Medial Axis IK",
    "Medial Axis Thicken",
    "Medial Axis Thickness",
    "OFF\n{} {} 0\n",
    "Fill Caps",
    "Profile Curve",
    "step {}",
    " Medial Axis Sequence",
    " Skeleton Sequence",
    "Medial Axis Self-Test",
    "Medial Axis Armature",
    "the arrays of a mesh contradict each other",
    "(?:Sampled|Used the) ([\\d,]+) (points|vertices)",
    "VERSION 1",
    "{}:Medial Axis:Medial Axis",
    "Voxel Size",
}
# Parts of sentences that occur in a source as a single word, or inside of another sentence.
PARTS = {"unknown", "arrays that contradict each other"}
PARTS |= {"Sampling", "Building", "Cleaning", "Drawing"}  # of a computation
# How sentences are put together.
FRAMES = {"'{}': {}"}
# Properties that Blender's own helpers declare on our operators.
HELPERS = {"filepath", "axis_forward", "axis_up"}
# The variable whose keys are parts of sentences, by which short ones are found.
MATCHED = "_IN_SHORT"
PRODUCTS = {"product", "_PRODUCT"}  # what is computed, by the name of the variable


def shown():
    """All of them, each as the translation knows it."""
    return labels() | sentences() | PARTS | FRAMES | compiled()


# --- what is registered


def labels():
    found = set()
    for cls in registered():
        rna = cls.bl_rna
        if issubclass(cls, bpy.types.Operator):
            module, _, name = cls.bl_idname.partition(".")
            rna = getattr(getattr(bpy.ops, module), name).get_rna_type()
            found.add(rna.description)
        if getattr(cls, "bl_label", "") and not issubclass(
            cls, PresetPanel
        ):  # it has that of a preset
            found.add(cls.bl_label)
        for prop in own_properties(cls, rna):
            found |= {prop.name, prop.description}
            if prop.type == "ENUM":
                found |= {t for item in prop.enum_items for t in (item.name, item.description)}
    folder = bpy.types.Scene.bl_rna.properties["medial_axis_folder"]
    found |= {folder.name, folder.description}
    front = Path(addon().__file__).read_text(encoding="utf-8")  # what was loaded is of the manifest
    found |= set(re.findall('^    "(?:name|description|location)": "(.+)",$', front, re.MULTILINE))
    manifest = (Path(addon().__file__).parent / "blender_manifest.toml").read_text(encoding="utf-8")
    found |= set(re.findall('^(?:tagline|files) = "(.+)"$', manifest, re.MULTILINE))
    return {text for text in found if re.match("[A-Z3]", text)}


def registered():
    kinds = (
        bpy.types.Operator,
        bpy.types.Panel,
        bpy.types.Menu,
        bpy.types.PropertyGroup,
        bpy.types.AddonPreferences,
    )
    return [cls for kind in kinds for cls in kind.__subclasses__() if is_ours(cls)]


def is_ours(cls):
    return cls.__module__.startswith(f"{MODULE}.") and hasattr(cls, "bl_rna") and cls.is_registered


def own_properties(cls, rna):
    """The properties that the add-on declares and a user sees."""
    names = {
        name
        for base in cls.__mro__
        if base.__module__.startswith(f"{MODULE}.")
        for name in inspect.get_annotations(base)
    }
    found = [rna.properties[name] for name in sorted(names - HELPERS) if name in rna.properties]
    return [prop for prop in found if not prop.is_hidden]


# --- what is written in the sources


def sentences():
    folder = Path(addon().__file__).parent
    found = set()
    for room in ("core", "bridge", "ui"):
        for path in sorted((folder / room).rglob("*.py")):
            if path.relative_to(folder).as_posix() not in HIDDEN:
                found |= texts_of(ast.parse(path.read_text(encoding="utf-8")), room == "ui")
    names = {path.stem.replace("_", " ") for path in (folder / "presets").rglob("*.py")}
    return {text for text in found | names if text not in DATA and not text.startswith("ply\n")}


def texts_of(tree, in_ui):
    """Literals with several words; of the user interface also single words that are drawn."""
    silent = silent_nodes(tree)
    drawn = drawn_nodes(tree) if in_ui else {}
    found = set()
    for node in ast.walk(tree):
        text = template(node)
        if text is None or id(node) in silent or not re.search("[A-Za-z]{2}", text):
            continue
        if id(node) in drawn or re.search(r"[\w{}'):,;] [\w{}'(]", text):
            found.add(text)
        if drawn.get(id(node)) == "product":
            found.add(text.title())
    return found


def template(node):
    """A literal with {} for each value; what is appended to another sentence with that sentence's {}."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        text = node.value
    elif isinstance(node, ast.JoinedStr):
        pieces = (p.value if isinstance(p, ast.Constant) else "{}" for p in node.values)
        text = "".join(pieces)
    else:
        return None
    text = text.removeprefix("; ")
    return (
        ("{}" if re.match(r",? [a-z]", text) else "") + text + ("{}" if text.endswith(": ") else "")
    )


def silent_nodes(tree):
    """Docstrings, types for checkers, parts of sentences to look for, and the pieces of f-strings."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            found |= {id(inner) for inner in ast.walk(node)} - {id(node)}
        elif isinstance(node, ast.Call) and ast.unparse(node.func) == "cast":
            found.add(id(node.args[0]))
        elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == MATCHED:
            found |= set(map(id, node.value.keys))
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            found.add(id(node.value))
    return found


def drawn_nodes(tree):
    """{node: kind}: `text=`, rows of tables, buttons of the manual, products."""
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg == "text":
            found |= {id(inner): "text" for inner in ast.walk(node.value)}
        elif isinstance(node, ast.Dict):
            words = (w for w in (*node.keys, *node.values) if isinstance(w, ast.Constant))
            found |= {id(w): "row" for w in words if re.match("[A-Z9][a-z5]", str(w.value))}
        elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) in PRODUCTS:
            found[id(node.value)] = "product"
    return found


# --- what the compiled module says


def compiled():
    """The errors that a user can meet; sources of C++."""
    folder = Path(__file__).resolve().parents[2] / "native" / "medial"
    sources = "\n".join(path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.cpp")))
    errors = map(said, re.findall(r"throw \w+Error\((.*?)\);\n", sources, re.DOTALL))
    return {text for text in errors if text.startswith(MET)} | PLACES


def said(expression):
    """A message in C++, with {} for each expression between literals."""
    between, *pieces = re.split(r'"((?:[^"\\]|\\.)*)"', expression)
    text = ""
    for literal, after in zip(pieces[::2], pieces[1::2], strict=True):
        text += ("{}" if text and re.search(r"\w", between) else "") + literal
        between = after
    return text


# How errors begin that follow from what a user chose or imported; the others are met by programs only.
MET = (
    "Expected at least 4 distinct points",
    "Expected balls in the solid",
    "Expected faces that enclose a volume",
    "Expected fewer than 2^31 facet corners",
    "Expected finite coordinates below 1e50",
    "Expected outward normals",
    "Expected points that CGAL can triangulate",
    "Expected points that span a volume",
    "Expected points that spread over",
    "Expected samples of a closed surface",
    "Expected segments in the solid",
    "Expected a spacing above",
    "Expected a spacing that needs",
    "Expected triangles with an area",
)
PLACES = {"in one place", "on one line", "in one plane"}  # where points lie that span no volume
