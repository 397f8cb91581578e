# SPDX-License-Identifier: GPL-3.0-or-later
"""The typed stub and the module say the same: names, parameters, defaults; in both directions."""

import ast
import inspect
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from medial_axis.core.axis.medial_axis import MedialAxis
from medial_axis.core.settings import Criteria, Rule, Settings, Side, SidesFrom

FOLDER = Path(__file__).resolve().parents[2] / "native" / "python"
NONE = "no default"


class Stub:
    """The classes and functions that a stub declares itself, by name."""

    def __init__(self, path, *shared):
        text = path.read_text(encoding="utf-8")
        self.lines, body = text.splitlines(), ast.parse(text).body
        self.classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in body if isinstance(node, ast.FunctionDef)}
        self.others = {node.target.id for node in body if isinstance(node, ast.AnnAssign)}
        for stub in shared:
            self.others |= {*stub.classes, *stub.functions, *stub.others}

    def methods(self):
        return [
            (owner, name, item)
            for owner, node in self.classes.items()
            for name, item in members(node).items()
            if isinstance(item, ast.FunctionDef) and not is_property(item)
        ]


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


MEDIAL = Stub(FOLDER / "_medial.pyi")
STUDY = Stub(FOLDER.parents[1] / "lab" / "native" / "study" / "_medial_study.pyi", MEDIAL)


@pytest.fixture(params=["medial", "study"])
def compiled(request):
    """A module and its stub. That of the study has all of the other one, too."""
    stub = {"medial": MEDIAL, "study": STUDY}[request.param]
    return SimpleNamespace(module=request.getfixturevalue(request.param), stub=stub)


def parameters(node):
    """(positional, keyword only) parameters of a stub's function without self, as name -> default or NONE.

    The ellipsis stands for a member of an enum, or a number that is no short literal.
    """
    arguments, default_of = node.args, ast.literal_eval
    free = len(arguments.args) - len(arguments.defaults)
    defaults = [NONE] * free + [default_of(d) for d in arguments.defaults]
    positional = {a.arg: d for a, d in zip(arguments.args, defaults, strict=True)}
    positional.pop("self", None)
    named = zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    return positional, {a.arg: NONE if d is None else default_of(d) for a, d in named}


def signature_line(function):
    """The first line that pybind11 writes into a docstring: name(self: T, a: X = 1, *, b: Y) -> Z."""
    return inspect.cleandoc(function.__doc__).splitlines()[0]


def compiled_parameters(function):
    """As `parameters`, with defaults as text."""
    line = signature_line(function)
    inside = line[line.index("(") + 1 : line.rindex(")")]
    parts, depth = [""], 0
    for character in inside:
        depth += (character in "([{<") - (character in ")]}>")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    parts = [part.strip() for part in parts if part.strip()]
    star = parts.index("*") if "*" in parts else len(parts)
    found = [re.fullmatch(r"(\w+)(?:: .+?)?(?: = (.+))?", part) for part in parts if part != "*"]
    pairs = [(m[1], NONE if m[2] is None else m[2]) for m in found]
    return {n: d for n, d in pairs[:star] if n != "self"}, dict(pairs[star:])


def assert_same_parameters(function, node):
    for found, wanted in zip(compiled_parameters(function), parameters(node), strict=True):
        assert list(found) == list(wanted)
        for name, default in wanted.items():
            if default is ...:
                assert found[name] is not NONE, name
            elif default is NONE or default is None or isinstance(default, (bool, str)):
                assert found[name] == (default if default is NONE else str(default)), name
            else:
                assert float(found[name]) == default, name


def described(thing):
    """The docstring, without the line of the signature."""
    text = inspect.cleandoc(thing.__doc__ or "").partition("\n\nMembers:")[0]  # of an enum
    return text.partition("\n")[2].strip() if re.match(r"\w+\(.*\) -> ", text) else text


def test_every_public_name_is_in_both(compiled):
    public = {name for name in dir(compiled.module) if not name.startswith("_")} | {"__version__"}
    stub = compiled.stub
    assert public == {*stub.classes, *stub.functions, *stub.others}


def test_class_members_are_in_both(compiled):
    for name, node in compiled.stub.classes.items():
        found_class, wanted = getattr(compiled.module, name), members(node)
        inherited = set(dir(Exception)) if issubclass(found_class, Exception) else set()
        found = {m for m in dir(found_class) if not m.startswith("_")} - inherited
        if any(isinstance(item, ast.AnnAssign) for item in wanted.values()):
            found -= {"name", "value", "names", "values"}  # of every enum
        assert found == {m for m in wanted if not m.startswith("_")}, name


def test_functions_and_methods_have_the_parameters_of_the_stub(compiled):
    for name, node in compiled.stub.functions.items():
        assert_same_parameters(getattr(compiled.module, name), node)
    for owner, name, node in compiled.stub.methods():
        assert_same_parameters(getattr(getattr(compiled.module, owner), name), node)


def test_everything_has_its_own_docstring(compiled):
    """The text has one home, but the bindings might take that of something else."""
    for name, node in {**compiled.stub.functions, **compiled.stub.classes}.items():
        assert described(getattr(compiled.module, name)) == ast.get_docstring(node), name
    for owner, node in compiled.stub.classes.items():
        for name, member in members(node).items():
            if isinstance(member, ast.FunctionDef) and name != "__init__":
                found = described(getattr(getattr(compiled.module, owner), name))
                assert found == ast.get_docstring(member), f"{owner}.{name}"


def test_enum_values(compiled):
    """The comment behind a value in the stub is its number."""
    count = 0
    for owner, node in compiled.stub.classes.items():
        for name, item in members(node).items():
            if isinstance(item, ast.AnnAssign):
                number = re.search(r"#\s*(\d+)$", compiled.stub.lines[item.lineno - 1])[1]
                assert int(getattr(getattr(compiled.module, owner), name)) == int(number)
                count += 1
    assert count > 2


def test_settings_of_the_add_on_have_the_same_defaults(medial):
    default = Settings()
    assert (default.theta, default.rho) == (pytest.approx(np.pi / 8, rel=1e-15), 8.0)
    analysis = medial.MedialAnalysis
    lines = [signature_line(f) for f in (analysis.extract, analysis.select, medial.sample_surface)]
    thresholds, of_samples = ("theta", "rho"), ("sharp_angle", "keep_vertices", "seed")
    for line, names in zip(
        lines, ((*thresholds, "limit_set"), thresholds, of_samples), strict=True
    ):
        for name in names:
            assert re.search(rf"\b{name}: [^=]*= {getattr(default, name)!r}\b", line), name
    assert all(name in lines[0] for name in ("Side.BOTH", default.rule.name, default.criteria.name))
    others = {Side.AUTOMATIC, SidesFrom.WRAP}  # which makes other faces
    for kind in (Rule, Criteria, Side, SidesFrom):
        known = set(members(MEDIAL.classes[kind.__name__]))
        assert {member.name for member in set(kind) - others} <= known


def test_the_fields_of_the_result_are_those_of_the_add_on(medial):
    own = {"level", "structure"}  # of clean forms and curves
    count_of_work = {"rings"}
    found = set(members(MEDIAL.classes["MedialMesh"])) - count_of_work
    assert set(MedialAxis.__dataclass_fields__) - own == found


def test_objects_cannot_be_subclassed_or_made_from_nothing(medial):
    with pytest.raises(TypeError):
        medial.MedialMesh()
    for name in ("Progress", "MedialMesh", "MedialAnalysis"):
        with pytest.raises(TypeError):
            type("Own", (getattr(medial, name),), {})
