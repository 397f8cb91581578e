"""The dependency rule, read from the sources: ui -> bridge -> core -> _medial -> analysis -> stages -> vocabulary.

No bpy in core, no ui in bridge, no NumPy in ui, no CGAL outside native/medial/triangulation, no pybind11 outside
native/python, and nothing looks upwards.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "blender_addon"
NATIVE = ROOT / "native"

BLENDER_MODULES = {"bpy", "bpy_extras", "bmesh", "mathutils", "gpu", "blf", "addon_utils"}
# What each room may import of the package; "" is the package itself (its name and version).
MAY_IMPORT = {
    "core": {"core", "lib", ""},
    "bridge": {"bridge", "core", ""},
    "ui": {"ui", "bridge", "core", ""},
}


# --- Python


def imports_of(source, module):
    """(absolute names, names inside the package) that a module imports; `module` is its dotted path inside."""
    outside, inside = set(), set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            outside.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            outside.add(node.module)
        elif isinstance(node, ast.ImportFrom):
            base = module.split(".")[: -node.level] if module else []
            target = [*base, *(node.module.split(".") if node.module else [])]
            inside.update(".".join([*target, alias.name]) for alias in node.names)
    return outside, inside


def dotted(path):
    parts = path.relative_to(ADDON).with_suffix("").parts
    return ".".join(parts)


def python_files(room):
    return sorted((ADDON / room).rglob("*.py"))


PYTHON_FILES = [(room, path) for room in MAY_IMPORT for path in python_files(room)]


@pytest.fixture(params=PYTHON_FILES, ids=lambda item: dotted(item[1]))
def python_file(request):
    room, path = request.param
    return room, imports_of(path.read_text(encoding="utf-8"), dotted(path))


def test_rooms_have_files():
    assert {room for room, _ in PYTHON_FILES} == set(MAY_IMPORT)


def test_python_looks_down_only(python_file):
    room, (_, inside) = python_file
    rooms = {name.split(".")[0] if "." in name or name in MAY_IMPORT else "" for name in inside}
    assert rooms <= MAY_IMPORT[room]


def test_package_imports_are_relative(python_file):
    _, (outside, _) = python_file
    assert not {
        name for name in outside if name.split(".")[0] in {"medial_axis", "blender_addon", "bl_ext"}
    }


def test_core_imports_no_blender(python_file):
    room, (outside, _) = python_file
    if room == "core":
        assert not {name for name in outside if name.split(".")[0] in BLENDER_MODULES}


def test_ui_imports_no_numpy(python_file):
    room, (outside, _) = python_file
    if room == "ui":
        assert not {name for name in outside if name.split(".")[0] in {"numpy", "scipy"}}


@pytest.mark.parametrize("path", sorted(ADDON.glob("*.py")), ids=lambda path: path.name)
def test_front_doors_import_without_blender(path):
    """The package and its command line load where there is no bpy: it is only imported inside functions."""
    top = [
        node
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if "Import" in type(node).__name__
    ]
    outside, _ = imports_of("\n".join(ast.unparse(node) for node in top), dotted(path))
    assert not {module for module in outside if module.split(".")[0] in BLENDER_MODULES}


# --- C++


def includes_of(path):
    return re.findall(
        r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE
    )


def native_files(folder):
    return sorted(p for p in (NATIVE / folder).rglob("*") if p.suffix in {".h", ".cpp"})


NATIVE_FILES = native_files("medial") + native_files("python")


def users_of(*prefixes):
    """Native files that include a header whose name starts with one of the prefixes."""
    return [
        path
        for path in NATIVE_FILES
        if any(name.startswith(prefixes) for name in includes_of(path))
    ]


def test_cgal_has_one_home():
    assert users_of("CGAL/") == [NATIVE / "medial" / "triangulation.cpp"]


def test_each_part_of_boost_has_one_home():
    """Exact integers of the exact circumcentres, and the tree of points; what CGAL itself includes does not count."""
    assert users_of("boost/multiprecision/") == [NATIVE / "medial" / "circumcentre.cpp"]
    assert users_of("boost/geometry/") == [NATIVE / "medial" / "nearest.cpp"]
    assert users_of("boost/") == [
        NATIVE / "medial" / f"{unit}.cpp" for unit in ("circumcentre", "nearest")
    ]


def test_the_system_has_one_home():
    assert users_of("sys/") == [NATIVE / "medial" / "heap.h"]


def test_pybind_and_python_have_one_home():
    assert {path.parent for path in users_of("pybind11/", "Python.h")} == {NATIVE / "python"}


def test_tbb_and_openmp_have_no_home():
    assert users_of("tbb/", "oneapi/", "omp.h") == []


# A unit with a .cpp is a stage; native/CMakeLists.txt lists the stages in pipeline order. Headers alone are vocabulary.
STAGES = re.findall(
    r"^\s*medial/(\w+)\.cpp", (NATIVE / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE
)
VOCABULARY = {path.stem for path in native_files("medial")} - set(STAGES)


@pytest.mark.parametrize("path", native_files("medial"), ids=lambda path: path.name)
def test_native_looks_down_only(path):
    """A stage includes itself, earlier stages, the vocabulary and the standard library; the vocabulary only itself."""
    own = {
        name
        for name in includes_of(path)
        if name.endswith(".h") and not name.startswith(("CGAL/", "sys/"))
    }
    below = STAGES[: STAGES.index(path.stem) + 1] if path.stem in STAGES else []
    assert {name.removesuffix(".h") for name in own} <= {*below, *VOCABULARY}


def test_stages_are_listed():
    """Every .cpp is built; the pipeline begins with the samples and ends with the whole analysis."""
    assert sorted(STAGES) == sorted(
        path.stem for path in native_files("medial") if path.suffix == ".cpp"
    )
    assert (STAGES[0], STAGES[-1]) == ("samples", "analysis")
    assert {"vec3", "csr", "parallel", "progress", "errors"} <= VOCABULARY


# --- the readers above see what they should


def test_import_reader_resolves_relative_imports():
    source = (
        "import bpy.types\nfrom numpy import array\nfrom . import x\n"
        "from ..core.export import y\nfrom .. import bl_info"
    )
    outside, inside = imports_of(source, "ui.export")
    assert outside == {"bpy.types", "numpy"}
    assert inside == {"ui.x", "core.export.y", "bl_info"}


def test_import_reader_resolves_the_package_of_a_room():
    """In `ui/__init__.py` one dot is `ui` itself."""
    assert imports_of("from . import panels\nfrom ..bridge import material", "ui.__init__")[1] == {
        "ui.panels",
        "bridge.material",
    }
