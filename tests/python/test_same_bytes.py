# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing whose last bits differ between processors, C libraries or C++ libraries reaches a result: the sources and the
compiled module are searched for it.
"""

import re

import pytest
from support.package import ROOT

from tools.packaging import check_module, paths

SOURCES = [
    path
    for folder in ("medial", "python")
    for path in (ROOT / "native" / folder).rglob("*")
    if path.suffix in {".h", ".cpp"}
]
# The standard leaves the order of equal or of unselected items open, or the values of hashes and distributions.
OPEN = re.compile(
    r"std::(nth_element|partial_sort|partition|random_shuffle|shuffle|hash|[a-z_]+_distribution)\b"
)
# Products by BLAS, and functions of the C library. (Lengths along an axis are sums in order.)
NUMPY = re.compile(
    r"np\.linalg\.(?!norm\(.*axis=[12])\w+|np\.(?:dot|matmul|vdot|einsum)\(|\S @ \S"
    r"|(?:np|math)\.(?:sin|cos|tan|arc\w+|a?sinh?|a?cosh?|a?tanh?|atan2|exp\w*|log\w*|power|pow|cbrt|hypot|dist)\("
)
# These choose, count or draw.
ALLOWED = {
    # Whole numbers.
    "nearness.py": 3,
    "fans.py": 1,
    "offset_surface.py": 7,
    "picture.py": 3,  # pictures in reports
}


def code_of(path):
    return re.sub(r"//.*", "", path.read_text(encoding="utf-8"))


def test_sources_call_no_inexact_function():
    call = re.compile(rf"\bstd::({check_module.INEXACT.pattern})\(")
    assert len(SOURCES) > 200
    assert [path.name for path in SOURCES if call.search(code_of(path))] == []


def test_orders_that_the_standard_leaves_open_are_not_used_for_items():
    # Medians: of all that is left in the order, the value in the middle alone is read.
    medians = {"samples_on_faces.cpp", "closing_samples.cpp"}
    medians |= {"outliers.cpp", "mover.cpp", "noise.cpp"}
    assert {path.name for path in SOURCES if OPEN.search(code_of(path))} == medians


HASHED = re.compile(r"std::unordered_\w+<")


def visited_in_the_order_of_hashes(code):
    """The names of hash tables that a loop, or an iterator, visits: each C++ library has its own order."""
    aliases = re.findall(r"using (\w+) = std::unordered_", code)
    tables = "|".join([r"std::unordered_\w+<.*>", *aliases])
    names = set(re.findall(rf"(?:{tables})[>,\s&\d]*\s(\w+)[;,)({{]", code))
    return sorted(name for name in names if re.search(rf": {name}\)|\b{name}\.c?begin\(", code))


def test_no_result_has_the_order_of_hashes():
    tables = {path: code_of(path) for path in SOURCES if HASHED.search(code_of(path))}
    names = {"winding_number.cpp", "pockets.cpp", "level_set.cpp", "paired_samples.h"}
    assert {path.name for path in tables} == names
    for path, code in tables.items():
        unit = path.with_suffix(".cpp")
        assert visited_in_the_order_of_hashes(code + code_of(unit)) == [], path.name


def test_a_loop_over_hashes_is_found():
    one = "std::unordered_map<int, std::vector<int>> cells;\nfor (auto& [id, cell] : cells) {"
    two = "using Parts = std::unordered_set<int>;\nvoid f(const Parts& parts) { parts.begin(); }"
    row = "std::array<std::unordered_set<uint64_t>, 3> had_;\nfor (auto& set : had_) set.clear();"
    assert visited_in_the_order_of_hashes(one) == ["cells"]
    assert visited_in_the_order_of_hashes(two) == ["parts"]
    assert visited_in_the_order_of_hashes(row) == ["had_"]
    assert visited_in_the_order_of_hashes(one.replace(": cells", ": rows")) == []


def test_compiled_modules_import_no_inexact_function():
    compiled = sorted(paths.LIBRARY.glob("_medial.*-linux-gnu.so"))
    if not compiled:
        pytest.skip("no module was built")
    for module in compiled:
        check_module.without_inexact(module)


def test_results_of_python_depend_on_no_library():
    core = ROOT / "blender_addon" / "core"
    found = {}
    for path in core.rglob("*.py"):
        text = re.sub(r"`[^`]*`", "", path.read_text(encoding="utf-8"))
        if some := NUMPY.findall(text):
            found[path.name] = len(some)
    assert found == ALLOWED


def test_no_multiplication_is_contracted():
    assert "-ffp-contract=off" in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
