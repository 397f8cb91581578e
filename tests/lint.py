# SPDX-License-Identifier: GPL-3.0-or-later
"""Layout, lint and types of the sources. A tool that is not installed is skipped by name."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Callable

from tools.packaging import paths
from tools.packaging.terminal import Failure, output_of, parallel_jobs, run, succeeds


class Skip(Exception):
    """A part of the tests cannot run here, for lack of a tool."""


def lint(blender: Path) -> str | None:
    """Everything, but clang-tidy only over the units that the last commits changed."""
    return run_tools({**QUICK_TOOLS, "mypy": mypy, "run-clang-tidy": lambda: clang_tidy(changed())})


def full_lint(blender: Path) -> str | None:
    return run_tools({**QUICK_TOOLS, "mypy": mypy, "run-clang-tidy": clang_tidy})


def quick_lint(blender: Path) -> str | None:
    return run_tools(QUICK_TOOLS)


def run_tools(tools: dict[str, Callable[[], None]]) -> str | None:
    """Run each tool that is installed, also after a failure; returns which are missing."""
    missing = [tool for tool in tools if shutil.which(tool) is None]
    if len(missing) == len(tools):
        raise Skip(f"none of {', '.join(tools)} is installed")
    failures = []
    for tool in tools:
        if tool not in missing:
            try:
                tools[tool]()
            except Failure as failure:
                failures.append(f"{tool} ({failure})")
    if failures:
        raise Failure("; ".join(failures))
    return f"without {', '.join(missing)}, not installed" if missing else None


def ruff() -> None:
    run("ruff", "check", ".")
    run("ruff", "format", "--check", ".")


def clang_format() -> None:
    run("clang-format", "--dry-run", "--Werror", *cpp_files())


def clang_tidy(wanted: set[str] | None = None) -> None:
    """The units of the core and of the bindings that are wanted, each by itself, as the preset `dev` compiles it."""
    run("cmake", "--preset", "dev", "-DMEDIAL_TESTS=OFF", stdout=subprocess.DEVNULL)
    run(
        "cmake", "--build", paths.BUILD / "dev", "--target", "docstrings"
    )  # a header that the bindings include
    database = paths.BUILD / "dev" / "compile_commands.json"
    # The bindings are compiled once for each Python: the first is this machine's, whose headers clang can read.
    entries = json.loads(database.read_text(encoding="utf-8"))
    first = {entry["file"]: entry for entry in reversed(entries)}
    own = {
        name: first[name] for name in sorted(first) if "/native/" in name and "/tests/" not in name
    }
    if wanted is not None:
        own = {name: entry for name, entry in own.items() if name in wanted}
    if not own:
        print("clang-tidy: no unit has changed")
        return
    folder = paths.BUILD / "lint"
    folder.mkdir(exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps([*own.values()]), encoding="utf-8")
    run("run-clang-tidy", "-quiet", "-p", folder, "-j", parallel_jobs(), *map(exactly, own))


def changed() -> set[str]:
    """The C++ units that differ from the merge base with the branch that this one follows, or from ten commits ago.

    A header counts for the unit of its name; the other units that include it are left to the full lint.
    """
    names = changed_files("native", "lab/native")
    units = {
        (paths.ROOT / name).with_suffix(".cpp") for name in names if name.endswith((".cpp", ".h"))
    }
    return {str(unit) for unit in units if unit.is_file()}


def changed_files(*folders: str) -> list[str]:
    """The files that differ from the base of the changes."""
    return output_of("git", "diff", "--name-only", base_of_changes(), "--", *folders).splitlines()


def base_of_changes() -> str:
    """The merge base with the followed branch if there are commits after it; else the tenth commit before this."""
    for name in ("@{upstream}", "HEAD~10", "HEAD"):
        if succeeds("git", "rev-parse", "--verify", "--quiet", f"{name}^{{commit}}"):
            base = output_of("git", "merge-base", "HEAD", name).strip()
            if base != output_of("git", "rev-parse", "HEAD").strip() or name == "HEAD":
                return base
    raise Failure("expected a git checkout with a commit, found none")


def exactly(path: str) -> str:
    """The pattern that finds this path alone."""
    return f"^{path}$"


def mypy() -> None:
    run("mypy")  # what and how is said in pyproject.toml


def cpp_files() -> list[str]:
    """All C++ sources that are part of the checkout."""
    patterns = ("*.cpp", "*.h")
    listed = output_of("git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns)
    return [name for name in listed.splitlines() if (paths.ROOT / name).is_file()]


QUICK_TOOLS = {"ruff": ruff, "clang-format": clang_format}
