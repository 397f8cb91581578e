# SPDX-License-Identifier: GPL-3.0-or-later
"""The typed stub and the module say the same: names, parameters, defaults, docstrings; in both directions."""

import ast
import enum
import inspect
import re
from pathlib import Path

import pytest

STUB = Path(__file__).resolve().parents[2] / "native" / "python" / "_medial.pyi"
TREE = ast.parse(STUB.read_text())
CLASSES = {node.name: node for node in TREE.body if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in TREE.body if isinstance(node, ast.FunctionDef)}
CONSTANTS = {node.target.id for node in TREE.body if isinstance(node, ast.AnnAssign)}


def is_property(node):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def members(node):
    """name -> node of the public members of a class, __init__ included."""
    found = {}
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            found[item.name] = item
        elif isinstance(item, ast.AnnAssign):
            found[item.target.id] = item
    return found


METHODS = [
    (c, name)
    for c, node in CLASSES.items()
    for name, item in members(node).items()
    if isinstance(item, ast.FunctionDef) and not is_property(item)
]
PROPERTIES = [
    (c, name)
    for c, node in CLASSES.items()
    for name, item in members(node).items()
    if isinstance(item, ast.FunctionDef) and is_property(item)
]
VALUES = [
    (c, name)
    for c, node in CLASSES.items()
    for name, item in members(node).items()
    if isinstance(item, ast.AnnAssign)
]


def parameters(node):
    """(positional, keyword only) names of a stub's function, without self."""
    positional = [a.arg for a in node.args.args if a.arg != "self"]
    return positional, [a.arg for a in node.args.kwonlyargs]


def signature_line(function):
    """The first line that pybind11 writes into a docstring: name(self: T, a: X = 1, *, b: Y) -> Z."""
    return inspect.cleandoc(function.__doc__).splitlines()[0]


def compiled_parameters(function):
    line = signature_line(function)
    inside = line[line.index("(") + 1 : line.rindex(")")]
    parts, depth, current = [], 0, ""
    for character in inside:
        depth += character in "([{<"
        depth -= character in ")]}>"
        if character == "," and depth == 0:
            parts.append(current.strip())
            current = ""
        else:
            current += character
    parts = [part for part in [*parts, current.strip()] if part]
    star = parts.index("*") if "*" in parts else len(parts)
    names = [re.match(r"\w*", part).group() for part in parts]
    return [n for n in names[:star] if n != "self"], names[star + 1 :]


def docstring(thing):
    return (thing.__doc__ or "").strip()


def test_every_public_name_is_in_both(medial):
    public = {name for name in dir(medial) if not name.startswith("_")} | {"__version__"}
    assert public == set(CLASSES) | set(FUNCTIONS) | CONSTANTS


@pytest.mark.parametrize("name", CLASSES)
def test_class_members_are_in_both(medial, name):
    compiled, wanted = getattr(medial, name), members(CLASSES[name])
    inherited = set(dir(Exception)) if issubclass(compiled, Exception) else set()
    pybind_enum = {"name", "value", "names", "values"}
    found = {m for m in dir(compiled) if not m.startswith("_")} - inherited
    if any(isinstance(item, ast.AnnAssign) for item in wanted.values()):
        found -= pybind_enum
    assert found == {m for m in wanted if not m.startswith("_")}


@pytest.mark.parametrize("name", CLASSES)
def test_classes_have_docstrings(medial, name):
    assert begins_alike(docstring(getattr(medial, name)), ast.get_docstring(CLASSES[name]))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_have_parameters_and_docstrings(medial, name):
    function = getattr(medial, name)
    assert compiled_parameters(function) == parameters(FUNCTIONS[name])
    described = docstring(function).removeprefix(signature_line(function)).strip()
    assert begins_alike(described, ast.get_docstring(FUNCTIONS[name]))


@pytest.mark.parametrize("owner, name", METHODS)
def test_methods_have_parameters_and_docstrings(medial, owner, name):
    function, node = getattr(getattr(medial, owner), name), members(CLASSES[owner])[name]
    assert compiled_parameters(function) == parameters(node)
    described = docstring(function).removeprefix(signature_line(function)).strip()
    text = ast.get_docstring(node)
    assert text is None or begins_alike(described, text)


@pytest.mark.parametrize("owner, name", PROPERTIES)
def test_properties_have_docstrings_with_shape_and_type(medial, owner, name):
    compiled = docstring(getattr(getattr(medial, owner), name))
    text = ast.get_docstring(members(CLASSES[owner])[name])
    assert compiled and (text is None or begins_alike(compiled, text))
    if text and text.startswith("("):
        assert compiled.split(":")[0].split(",")[:2] == text.split(":")[0].split(",")[:2]


def begins_alike(found, wanted):
    """The same first words; the rest of a sentence may be shorter in one of them."""
    first = [re.findall(r"[\w/()+,]+", text)[:3] for text in (found, wanted)]
    return first[0] == first[1] and len(first[0]) == 3


@pytest.mark.parametrize("owner, name", VALUES)
def test_enum_values(medial, owner, name):
    """The comment behind a value in the stub starts with its number."""
    source = STUB.read_text().splitlines()[members(CLASSES[owner])[name].lineno - 1]
    number = int(re.search(r"#\s*(\d+)", source).group(1))
    assert int(getattr(getattr(medial, owner), name)) == number


def test_defaults_of_the_thresholds(medial):
    """Stated once in the stub's text: pi/8, 8, BOTH, EITHER, ANGLE_OR_RATIO, off."""
    for function in (medial.MedialAnalysis.select, medial.MedialAnalysis.extract):
        line = signature_line(function)
        theta = float(re.search(r"theta: [\w.]+ = ([\d.]+)", line).group(1))
        assert theta == pytest.approx(3.141592653589793 / 8, rel=1e-15)
        assert float(re.search(r"rho: [\w.]+ = ([\d.]+)", line).group(1)) == 8.0
        for value in ("BOTH", "EITHER", "ANGLE_OR_RATIO"):
            assert value in line
        assert "limit_set: bool = False" in line


def test_settings_of_the_add_on_have_the_same_defaults(medial):
    from medial_axis.core.settings import Settings

    line = signature_line(medial.MedialAnalysis.extract)
    assert float(re.search(r"theta: [\w.]+ = ([\d.]+)", line).group(1)) == pytest.approx(
        Settings().theta, rel=1e-15
    )
    assert float(re.search(r"rho: [\w.]+ = ([\d.]+)", line).group(1)) == Settings().rho
    others = {"ANGLE_AND_LENGTH", "LAMBDA"}  # the add-on does not offer them
    for choice in ("rule", "criteria"):
        value = getattr(Settings(), choice)
        assert value.name in line
        compiled = {n for c, n in VALUES if c == type(value).__name__}
        assert compiled - others == {member.name for member in type(value)}
        assert isinstance(value, enum.Enum)


def test_the_fields_of_the_result_are_those_of_the_add_on(medial):
    from medial_axis.core.axis.medial_axis import MedialAxis

    own = {"level"}  # of clean forms and curves
    assert set(MedialAxis.__dataclass_fields__) - own == {
        name
        for owner, name in PROPERTIES
        if owner == "MedialMesh" and name != "rings"  # a count of work
    }


def test_objects_cannot_be_subclassed_or_made_from_nothing(medial):
    with pytest.raises(TypeError):
        medial.MedialMesh()
    for name in ("Progress", "MedialMesh", "MedialAnalysis"):
        with pytest.raises(TypeError):
            type("Own", (getattr(medial, name),), {})
