# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs each scene of scenes.py in a Blender window under Xvfb, and reports which passed."""

from __future__ import annotations

import contextlib
import json
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

from tests.support.claims import claim  # run.py makes it found

HERE = Path(__file__).resolve().parent
SIZE = (1280, 800)  # the screen, which the window fills
SIZES = {"tutorial": (1280, 720), "first_glance": (1280, 720)}  # of other scenes
# Blender goes on after these: Python failed, or a panel names a property, an operator or a menu that is not there.
_ERROR = re.compile(
    r"Traceback|property not found|operator missing|unknown operator|menu.* not found"
)
LIMIT = 240  # seconds for one scene, start of Blender included, on a machine that is not overloaded

SCENES = {  # name -> whether the compiled module is installed
    "tutorial": True,
    "first_glance": True,
    "compute_drag_undo": True,
    "draft": True,
    "sliders_with_escape": True,
    "auto_update": True,
    "panels_in_place": True,
    "what_comes_after": True,
    "cancel_with_escape": True,
    "undo_while_running": True,
    "undo_storm": True,
    "missing_module": False,
}


def run_all(blender, folder: Path, wanted: list[str], claims: Path | None = None) -> int:
    """Run the scenes, or those named; with `claims` those that no other process takes. Returns the exit code."""
    folder = folder.resolve()  # a chroot has another working folder
    folder.mkdir(parents=True, exist_ok=True)
    unknown = set(wanted) - set(SCENES)
    if unknown:
        raise SystemExit(f"expected scenes out of {', '.join(SCENES)}, found {', '.join(unknown)}")
    failed = []
    for name, with_module in SCENES.items():
        if (wanted and name not in wanted) or (claims and not claim(claims, name)):
            continue
        with (
            display(SIZES.get(name, SIZE)) as number,
            contextlib.nullcontext() if with_module else module_hidden(blender),
        ):
            blender.environment |= {"DISPLAY": number, "LIBGL_ALWAYS_SOFTWARE": "1"}
            problem = run_scene(blender, name, folder)
        print(f"{'FAILED' if problem else 'passed'}  {name}  {problem}", flush=True)
        failed += [name] if problem else []
    return 1 if failed else 0


@contextlib.contextmanager
def display(size: tuple[int, int]) -> Iterator[str]:
    """An X server without a screen."""
    server = subprocess.Popen(
        f"Xvfb -displayfd 1 -screen 0 {size[0]}x{size[1]}x24 +extension GLX -nolisten tcp".split(),
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        yield f":{server.stdout.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


@contextlib.contextmanager
def module_hidden(blender) -> Iterator[None]:
    """The installed add-on without its compiled modules."""
    folders = [p for p in Path(blender.environment["HOME"]).rglob("medial_axis/lib") if p.is_dir()]
    for folder in folders:
        folder.rename(folder.with_name("lib_hidden"))
    try:
        yield
    finally:
        for folder in folders:
            folder.with_name("lib_hidden").rename(folder)


def run_scene(blender, name: str, folder: Path) -> str:
    """Run one scene; returns what went wrong, or an empty string."""
    answer, log = folder / f"{name}.json", folder / f"{name}.log"
    answer.unlink(missing_ok=True)
    command = [*blender.program, "--factory-startup", "--window-geometry", "0", "0"]
    command += [*map(str, SIZES.get(name, SIZE)), "--python-exit-code", "1"]
    command += ["--python", str(HERE / "scenes.py"), "--", name, str(folder)]
    with open(log, "wb") as output:
        options = {"env": blender.environment, "stdout": output, "stderr": subprocess.STDOUT}
        window = subprocess.Popen(command, **options)
        limit = LIMIT * max(1.0, os.getloadavg()[0] / len(os.sched_getaffinity(0)))
        try:
            code = window.wait(limit)
        except subprocess.TimeoutExpired:
            window.kill()
            window.wait()
            return f"no end after {limit:.0f} s; see {log}"
    text = log.read_text(encoding="utf-8", errors="replace")
    problem = problem_of(code, answer, text)
    return f"{problem}\n{text[-3000:]}" if problem else ""


def problem_of(code: int, answer: Path, text: str) -> str:
    """The problem of a scene that ended with an exit code and printed a text, or an empty string."""
    if not answer.exists():
        return f"no answer, exit code {code}"
    if problem := json.loads(answer.read_text(encoding="utf-8"))["problem"]:
        return problem
    if code not in (0, 1):  # Blender's own is 1 after Escape was pressed
        return f"exit code {code}"
    lines = (line for line in text.splitlines() if _ERROR.search(line))
    return next((f"it printed an error: {line}" for line in lines), "")
