# SPDX-License-Identifier: GPL-3.0-or-later
"""The dependency rule, read from the sources: ui -> bridge -> core -> _medial -> analysis -> the rooms of the core.

The rooms are folders, and what each may see is in the tables of docs/architecture.md. No bpy in core, no ui in bridge,
no NumPy in ui, CGAL in native/medial/delaunay and mesh alone, no pybind11 outside native/python.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "blender_addon"
NATIVE = ROOT / "native"

BLENDER_MODULES = {"bpy", "bpy_extras", "bmesh", "mathutils", "gpu", "blf", "addon_utils"}
SPAN = re.compile(r"`([^`\n]+)`")


def rows(page, head):
    """The cells of a table of the docs, by how its first line begins."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    table = text[text.index(head) :].partition("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table]


def table(language):
    """{room: what it sees, in words}, as architecture.md has it."""
    cells = rows("architecture.md", f"| room of {language} |")
    return {SPAN.findall(room)[0]: sees for room, _, sees in cells}


ROOMS = table("Python")
CORE = {room for room in ROOMS if room.split("/")[0] == "core"}
BRIDGE = {room for room in ROOMS if room.split("/")[0] == "bridge"}


def may_import(room, sees):
    """Rooms of core are named without it, and all see `core` and `core/machine`; "" is the package itself."""
    seen = {f"core/{name}" if f"core/{name}" in CORE else name for name in SPAN.findall(sees)}
    seen |= {"core", "core/machine"} | (CORE if "all of `core`" in sees else set())
    seen |= BRIDGE if "all of `bridge`" in sees else set()
    return seen | ({""} if room not in CORE or room in {"core/axis", "core/batch"} else set())


# The rooms that each room may import besides itself.
MAY_IMPORT = {room: may_import(room, sees) for room, sees in ROOMS.items()}
MAY_IMPORT |= {"core": set(), "core/machine": {"core", "lib"}}


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
    return sorted((ADDON / room).glob("*.py"))


def room_of(name):
    """The room that a dotted name inside the package lies in: its folder, "" for the package itself."""
    first, *rest = name.split(".")
    nested = f"{first}/{rest[0]}" if rest else ""
    return nested if nested in MAY_IMPORT else first if first in {*MAY_IMPORT, "lib"} else ""


PYTHON_FILES = [(room, path) for room in MAY_IMPORT for path in python_files(room)]


@pytest.fixture(params=PYTHON_FILES, ids=lambda item: dotted(item[1]))
def python_file(request):
    room, path = request.param
    return room, imports_of(path.read_text(encoding="utf-8"), dotted(path))


def test_rooms_have_files():
    assert {room for room, _ in PYTHON_FILES} == set(MAY_IMPORT)


def test_python_looks_down_only(python_file):
    room, (_, inside) = python_file
    assert {room_of(name) for name in inside} <= {room, *MAY_IMPORT[room]}


def test_every_folder_of_core_is_a_room():
    folders = {p.parent.relative_to(ADDON).as_posix() for p in (ADDON / "core").rglob("*.py")}
    assert folders == CORE


def circle(seen_by):
    """Names that see each other in a circle, the first one again at the end; empty where there is no circle.

    Parameters
    ----------
    seen_by : {name: set of names}
    """
    done = set()

    def follow(name, path):
        if name in path:
            return [*path[path.index(name) :], name]
        if name not in done:
            for other in sorted(seen_by.get(name, ())):
                if found := follow(other, [*path, name]):
                    return found
            done.add(name)
        return []

    return next((found for name in sorted(seen_by) if (found := follow(name, []))), [])


def files_of_core():
    """{file: files of core that it imports}, imports for type checkers and inside functions included."""
    paths = {dotted(path): path for path in (ADDON / "core").rglob("*.py")}
    seen = {}
    for name, path in paths.items():
        _, inside = imports_of(path.read_text(encoding="utf-8"), name)
        seen[name] = {file for i in inside for file in (i, i.rpartition(".")[0]) if file in paths}
    return seen


def test_files_of_core_form_no_circle():
    """Types count as well: what two files know of each other belongs into a third one below them."""
    seen = files_of_core()
    assert "core.samples.analysed" in seen["core.samples.choose_samples"]
    assert circle(seen) == []


def test_rooms_of_core_form_no_circle():
    below = {room: {r for r in MAY_IMPORT[room] if r.startswith("core/")} for room in CORE}
    assert circle({room: seen for room, seen in below.items() if room != "core"}) == []


# How the names of rooms begin -> the packages that none of them imports.
NEVER = {
    "": {"medial_axis", "blender_addon", "bl_ext"},  # imports inside the package are relative
    "core": BLENDER_MODULES,
    "ui": {"numpy", "scipy"},
}


@pytest.mark.parametrize("start", NEVER)
def test_some_packages_are_never_imported(python_file, start):
    room, (outside, _) = python_file
    if room.startswith(start):
        assert not {name for name in outside if name.split(".")[0] in NEVER[start]}


@pytest.mark.parametrize(
    "path", sorted([*ADDON.glob("*.py"), *python_files("commands")]), ids=lambda path: path.name
)
def test_front_doors_import_without_blender(path):
    """The package and its command line load where there is no bpy: it is only imported inside functions."""
    top = [
        node
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if "Import" in type(node).__name__
    ]
    outside, _ = imports_of("\n".join(ast.unparse(node) for node in top), dotted(path))
    assert not {module for module in outside if module.split(".")[0] in BLENDER_MODULES}


@pytest.mark.parametrize("folder", ["blender_addon", "native", "tests"])
def test_product_and_tests_do_without_the_laboratory(folder):
    """The laboratory sees the tests' helpers; the product and its tests do not see the laboratory."""
    files = sorted((ROOT / folder).rglob("*.py"))
    assert files
    for path in files:
        outside, _ = imports_of(path.read_text(encoding="utf-8"), "")
        assert "lab" not in {name.split(".")[0] for name in outside}, path


# --- C++


def includes_of(path):
    return re.findall(
        r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE
    )


def native_files(folder):
    return sorted(p for p in (NATIVE / folder).rglob("*") if p.suffix in {".h", ".cpp"})


NATIVE_FILES = native_files("include") + native_files("medial") + native_files("python")


def users_of(*prefixes):
    """Native files that include a header whose name starts with one of the prefixes."""
    return [
        path
        for path in NATIVE_FILES
        if any(name.startswith(prefixes) for name in includes_of(path))
    ]


MEDIAL = NATIVE / "medial"
# The rooms that each room of the core may include besides itself: the paper's pipeline, read downwards.
MAY_INCLUDE = {room: set(SPAN.findall(sees)) for room, sees in table("the core").items()}
ON_TOP = {
    "base",
    "delaunay",
    "inside",
    "axis",
    "thickness",
    "cocone",
    "sampling",
    "walls",
    "levels",
}
MAY_INCLUDE["."] = ON_TOP  # the analysis


# The words that every room may use, and the public headers that only those who make what is in them see.
VOCABULARY = {"types.h", "errors.h", "progress.h", "options.h"}
PUBLIC = {
    "medial_mesh.h": {"axis"},
    "watertight_surface.h": {"cocone"},
    "faces.h": {"walls", "levels"},
    "hierarchy.h": {"collapse", "exact", "levels"},
    "sphere_mesh.h": {"reduce"},
    "thickness.h": {"thickness"},
    "ball_cover.h": {"cover"},
    "capsule_cover.h": {"cover"},
    "sampling.h": {"sampling"},
    "structure.h": {"structure"},
    "scan.h": {"scan"},
    "analysis.h": {"."},
}


def test_every_public_header_is_in_a_table():
    names = {path.name for path in native_files("include")}
    assert names == VOCABULARY | set(PUBLIC)


@pytest.mark.parametrize("path", native_files("include"), ids=lambda path: path.name)
def test_public_headers_see_only_public_ones(path):
    """Public headers include public headers and the standard library, whose headers have no ending."""
    assert path.suffix == ".h", "nothing is compiled here"
    for name in includes_of(path):
        if "." in name or "/" in name:
            assert name.startswith("medial/") and (NATIVE / "include" / name).is_file()


def test_cgal_has_one_home():
    """Triangulations, faces that cross, even sheets, and wrapping; all set CGAL up alike."""
    units = (
        "delaunay/triangulation.cpp",
        "mesh/crossing_faces.cpp",
        "mesh/even_sheet.cpp",
        "mesh/polygon_triangles.cpp",
        "mesh/wrap.cpp",
    )
    homes = [MEDIAL / unit for unit in units]
    kernel = {MEDIAL / "base" / "cgal.h", MEDIAL / "base" / "filtered_kernel.h"}
    assert sorted(set(users_of("CGAL/")) - kernel) == homes
    assert all("base/cgal.h" in includes_of(home) for home in homes)


def test_what_boost_gives_has_one_home_each():
    """Predicates and circumcentres share its integers; headers that CGAL includes by itself do not count."""
    homes = ("exact_integer.h", "short_list.h")
    assert users_of("boost/") == [MEDIAL / "base" / home for home in homes]


def test_the_system_has_one_home():
    assert users_of("sys/", "windows.h") == [MEDIAL / "base" / "address_space.cpp"]
    assert users_of("malloc.h") == [MEDIAL / "base" / "address_space.cpp"]


def test_pybind_and_python_have_one_home():
    assert {path.parent for path in users_of("pybind11/", "Python.h")} == {NATIVE / "python"}


def test_tbb_and_openmp_have_no_home():
    assert users_of("tbb/", "oneapi/", "omp.h") == []


def native_room(path):
    return path.parent.relative_to(MEDIAL).as_posix()


@pytest.mark.parametrize(
    "path", native_files("medial"), ids=lambda path: path.relative_to(MEDIAL).as_posix()
)
def test_native_looks_down_only(path):
    """Own headers are named with their room; a unit sees its own room and those that the table allows."""
    foreign = ("CGAL/", "boost/", "sys/", "windows.h", "malloc.h", "medial/")
    own = [n for n in includes_of(path) if n.endswith((".h", ".hpp")) and not n.startswith(foreign)]
    rooms = {str(Path(name).parent.as_posix()) for name in own}
    room = native_room(path)
    assert rooms <= {room, *MAY_INCLUDE[room]}
    assert all((MEDIAL / name).is_file() for name in own)
    public = {n.removeprefix("medial/") for n in includes_of(path) if n.startswith("medial/")}
    assert all(name in VOCABULARY or room in PUBLIC[name] for name in public)


def test_every_folder_of_the_core_is_a_room():
    assert {native_room(path) for path in native_files("medial")} == set(MAY_INCLUDE)


def test_the_table_has_no_circle():
    order = list(MAY_INCLUDE)
    assert all(
        order.index(seen) < order.index(room) for room in order for seen in MAY_INCLUDE[room]
    )


@pytest.mark.parametrize("room", [room for room in MAY_INCLUDE if room != "."])
def test_each_room_lists_its_units(room):
    listed = re.findall(
        r"^\s*(\w+\.cpp)", (MEDIAL / room / "CMakeLists.txt").read_text(), re.MULTILINE
    )
    assert sorted(listed) == sorted(path.name for path in (MEDIAL / room).glob("*.cpp"))


# --- the readers above see what they should


def test_a_circle_is_found():
    assert circle({"a": {"b"}, "b": {"c", "d"}, "c": set(), "d": {"b"}}) == ["b", "d", "b"]
    assert circle({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []


def test_imports_for_type_checkers_are_seen():
    source = "if TYPE_CHECKING:\n    from .x import Y\ndef f():\n    from . import z"
    assert imports_of(source, "core.samples.a")[1] == {"core.samples.x.Y", "core.samples.z"}


def test_import_reader_resolves_relative_imports():
    source = (
        "import bpy.types\nfrom numpy import array\nfrom . import x\n"
        "from ..core.files.write import y\nfrom .. import bl_info"
    )
    outside, inside = imports_of(source, "ui.export")
    assert outside == {"bpy.types", "numpy"}
    assert inside == {"ui.x", "core.files.write.y", "bl_info"}


def test_import_reader_resolves_the_package_of_a_room():
    """In `ui/__init__.py` one dot is `ui` itself."""
    assert imports_of("from . import panels\nfrom ..bridge import material", "ui.__init__")[1] == {
        "ui.panels",
        "bridge.material",
    }


def test_stored_properties_are_named_in_one_table():
    """Files of users hold their names. Attributes of meshes have a table of their own, and are read in two files."""
    used = re.compile(r"""(\[|\.get\(|\.pop\(|in \()f?["']ma_""")
    paths = [*(ADDON / "bridge").rglob("*.py"), *(ADDON / "ui").rglob("*.py")]
    found = {path.name for path in paths if used.search(path.read_text(encoding="utf-8"))}
    assert found <= {"self_test.py", "filter.py"}
