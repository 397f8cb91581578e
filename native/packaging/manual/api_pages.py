# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the interfaces, made of the docstrings and headers: of the package, the module and the C++ library."""

from __future__ import annotations

from pathlib import Path

from . import cpp_source, option_source, python_source
from .entries import Entry, docstring, markdown_of, paragraphs

# Of this checkout, whatever is packed.
_ROOT = Path(__file__).resolve().parents[3]
LIBRARY = _ROOT / "blender_addon" / "library.py"
SETTINGS = _ROOT / "blender_addon" / "core" / "settings.py"
MODULE = _ROOT / "native" / "python" / "_medial.pyi"
HEADERS = _ROOT / "native" / "include" / "medial"


def pages() -> dict[str, str]:
    """Name of each page -> its Markdown."""
    return {
        "api_medial_axis.md": package_page(),
        "api_python_module.md": module_page(),
        "api_cpp.md": cpp_page(),
    }


def package_page() -> str:
    """`medial_axis`, the package for Python programs: functions, then classes, choices and errors."""
    library = python_source.Source(LIBRARY)
    known = option_source.options(python_source.Source(SETTINGS))
    entries = [_public(library, name, known) for name in library.names()]
    functions = [entry for entry in entries if entry.name.islower()]
    errors = [entry for entry in entries if _is_error(entry)]
    classes = [entry for entry in entries if entry not in functions and entry not in errors]
    return _page("API of medial_axis", library.docstring, [*functions, *classes, *errors])


def _public(library: python_source.Source, name: str, known: option_source.Options) -> Entry:
    source = library.origin(name)
    entry = source.entry(name)
    option_source.describe_choices(entry, known)
    option_source.describe_fields(entry, source.definitions()[name], known)
    entry.signature = option_source.with_defaults(entry.signature, known)
    return entry


def _is_error(entry: Entry) -> bool:
    return "Error" in entry.signature or entry.name == "Cancelled"


def module_page() -> str:
    """`_medial`, the compiled module."""
    module = python_source.Source(MODULE)
    entries = [module.entry(name) for name in module.definitions()]
    return _page("API of _medial", module.docstring, [*entries, *module.values()])


def cpp_page() -> str:
    """`medial::`, header by header."""
    blocks = ["# API of medial::", "The public headers of the C++ library, each with its comments."]
    for path in sorted(HEADERS.glob("*.h")):
        about, entries = cpp_source.read_header(path)
        blocks += [f"## `<medial/{path.name}>`", paragraphs(about)]
        blocks += [markdown_of(entry, 3) for entry in entries]
    return "\n\n".join(blocks) + "\n"


def _page(title: str, text: str, entries: list[Entry]) -> str:
    return (
        "\n\n".join([f"# {title}", docstring(text), *(markdown_of(e, 2) for e in entries)]) + "\n"
    )
