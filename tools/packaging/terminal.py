# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that run for the person at the terminal, and how their failures are reported."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Failure(Exception):
    """A step did not succeed; the message is for the person at the terminal."""

    def __init__(self, message: str, exit_code: int = 1) -> None:
        super().__init__(message)
        self.exit_code = exit_code


def say(text: str) -> None:
    bold, plain = ("\033[1m", "\033[0m") if sys.stdout.isatty() else ("", "")
    print(f"\n{bold}== {text}{plain}", flush=True)


def run(*command: object, **options) -> None:
    """Run a command with its output shown; raise Failure when it fails."""
    words = [str(word) for word in command]
    print("$ " + " ".join(map(shlex.quote, words)), flush=True)
    code = subprocess.run(words, cwd=options.pop("cwd", ROOT), **options).returncode
    if code != 0:
        raise Failure(
            f"'{' '.join(words[:3])} ...' ended with exit code {code}; its output is above"
        )


def output_of(*command: object, **options) -> str:
    """The standard output of a command; raise Failure when it fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, **options)
    if done.returncode != 0:
        raise Failure(
            f"'{' '.join(words[:3])} ...' ended with exit code {done.returncode}: {done.stderr.strip()}"
        )
    return done.stdout


def succeeds(*command: object) -> bool:
    """Whether a command can be run and ends with exit code 0; its output is not shown."""
    words = [str(word) for word in command]
    try:
        return subprocess.run(words, capture_output=True, cwd=ROOT).returncode == 0
    except OSError:
        return False


def python_that(statement: str, advice: str) -> str:
    """The first Python, out of this one and the system's, that runs a statement such as `import mkdocs`."""
    for python in (sys.executable, "/usr/bin/python3"):
        if succeeds(python, "-c", statement):
            return python
    raise Failure(
        f"Expected a Python that runs '{statement}', found none: neither {sys.executable} nor "
        f"/usr/bin/python3 does; {advice}",
        2,
    )


def parallel_jobs() -> int:
    """Compilers to run at once: one unit that includes CGAL takes up to 2 GB."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(len(os.sched_getaffinity(0)), memory // (2 << 30)))


def build_preset(preset: str, *definitions: str, targets: Sequence[str] = ()) -> None:
    """Configure a preset of CMakePresets.json and compile all of it, or some targets."""
    run("cmake", "--preset", preset, *definitions)
    wanted = ["--target", *targets] if targets else []
    run("cmake", "--build", "--preset", preset, "--parallel", parallel_jobs(), *wanted)


def use_system_python() -> None:
    """Let this process and those that it starts find the system's Python first."""
    kept = with_system_python(os.environ)
    os.environ.clear()
    os.environ.update(kept)


def with_system_python(environment: Mapping[str, str]) -> dict[str, str]:
    """An environment in which Debian's Blender works: it takes its Python library from the first python3 on PATH, which
    must be the system's, also when a pyenv or virtual environment runs this."""
    lost = ("PYTHONHOME", "PYTHONPATH", "VIRTUAL_ENV")
    kept = {name: value for name, value in environment.items() if name not in lost}
    return {**kept, "PATH": os.pathsep.join(("/usr/bin", environment.get("PATH", "/bin")))}
