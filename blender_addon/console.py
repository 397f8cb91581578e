# SPDX-License-Identifier: GPL-3.0-or-later
"""The output of the command line: results on standard output, everything else on standard error.

Names of files are bytes. Characters that a stream cannot show are written with backslashes; a stream that is closed
or full does not end the work.
"""

from __future__ import annotations

import io
import json
import os
import sys
from typing import Any, TextIO

from .core.counted import counted
from .core.files.names import shown
from .core.samples.density import percent


class ClosedPipeError(Exception):
    """The reader of the results has closed the pipe."""


class Console:
    """Parameters
    ----------
    json_lines : bool
        Results as one line of JSON each.
    quiet : bool
        No progress and no warnings.
    new_lines : bool
        Begin each line of JSON on a new line, where others may have left one unfinished.

    Attributes
    ----------
    lost : bool
        Results were made that could not be printed, as on a full disk.
    """

    def __init__(self, json_lines: bool, quiet: bool, new_lines: bool) -> None:
        self._json, self._quiet = json_lines, quiet
        self._start = "\n" if new_lines else ""
        self._terminal = sys.stderr.isatty() and not quiet
        self.lost = False

    def show(self, text: str) -> None:
        """Progress, in one line of a terminal."""
        if self._terminal:
            self._write_aside(f"\r\x1b[K{text}")

    def complain(self, text: str) -> None:
        self._write_aside(f"medial_axis: {text}\n")

    def tell(self, report: dict[str, Any]) -> None:
        """A result, or why there is none."""
        if self._json:
            self._write(self._start + _as_json(report, sys.stdout) + "\n")
        name = report["object"] or os.path.basename(report["input"]) or report["input"]
        if not self._quiet:
            for warning in report.get("warnings", ()):
                self.complain(f"{name}: {warning}")
        if report["status"] in ("failed", "cancelled"):
            self.complain(f"{name}: {report['error']}")
        elif not self._json:
            self._write(f"{name if 'row' in report else report['output']}: {_ended(report)}\n")

    def _write(self, text: str) -> None:
        try:
            sys.stdout.write(shown(text, sys.stdout))
            sys.stdout.flush()
        except BrokenPipeError:
            _turn_off("stdout")
            raise ClosedPipeError from None
        except OSError as error:
            _turn_off("stdout")
            self.lost = True
            self.complain(
                "Expected to write results to standard output, but the system says "
                f"'{error.strerror or error}'; the files are written all the same"
            )

    def _write_aside(self, text: str) -> None:
        try:
            sys.stderr.write(shown(text, sys.stderr))
            sys.stderr.flush()
        except OSError:
            _turn_off("stderr")


def _length(value: float | None) -> str:
    return "unknown" if value is None else f"{value:.4g}"


def _ended(report: dict[str, Any]) -> str:
    if "verdict" in report:
        return report["verdict"]
    if "links" in report:
        return "\n  ".join([counted(len(report["links"]), "link"), *map(_link, report["links"])])
    how = f"done in {report['seconds']:.2f} s" if report["status"] == "done" else "kept"
    return f"{_said(report)}, {how}"


def _link(link: dict[str, Any]) -> str:
    """A row of the table of links."""
    if link["problem"] or not link["count"]:
        return f"{link['name']}: {link['problem'] or 'spheres or capsules, as it was'}"
    shapes = counted(link["count"], link["shapes"][:-1])
    return (
        f"{link['name']}: {shapes}, volume {link['volume']:.4g}, "
        f"farthest {link['farthest']:.4g}, {link['seconds']:.2f} s"
    )


def _said(report: dict[str, Any]) -> str:
    """The content of an output, in a few words."""
    if "facets" in report:
        edges = f", {counted(report['edges'], 'edge')}" if report.get("edges") else ""
        return f"{counted(report['facets'], 'facet')}{edges}"
    if "ends" in report:
        branches = counted(report["branches"], "branch", "branches")
        return f"{branches}, {counted(report['ends'], 'end')}, {counted(report['loops'], 'loop')}"
    if "sheets" in report and "share_of_volume" in report:
        return f"{counted(report['sheets'], 'sheet')}, {100 * report['share_of_volume']:.1f} % of the volume"
    if "covered" in report:
        shape = "ball" if report["settings"]["shapes"] == "balls" else "capsule"
        return (
            f"{counted(report['count'], shape)}, {100 * report['covered']:.1f} % of the volume, "
            f"{report['outside']:.4g} outside, surface at most {report['farthest']:.4g} away"
        )
    if "share_without_room" in report:
        lack = percent(report["share_without_room"])
        return f"wall {report['wall']:.4g}, {report['least_wall']:.4g} at least, no room on {lack}"
    if "cavities" in report:
        cavities = counted(report["cavities"], "cavity", "cavities")
        left = percent(report["volume"] / report["volume_of_solid"])
        return f"{cavities}, {left} of the volume left, wall at least {report['least_wall']:.4g}"
    if "farthest_move" in report:
        before, after = (_length(report[name]) for name in ("minimum_before", "minimum"))
        below = f", {percent(report['share_below'])} still thinner" if report["patches"] else ""
        return f"least thickness {before} before, {after} now{below}"
    unit = f" {report['unit']}" if report["unit"] else ""
    if report["minimum"] is None:
        return "no two walls face each other"
    minimum = f"minimum {report['minimum']:.4g}{unit}"
    parallel = report.get("minimum_parallel")
    if parallel is not None and f"{parallel:.4g}" != f"{report['minimum']:.4g}":
        minimum += f" ({parallel:.4g} between nearly parallel walls)"
    if not report["limit"]:
        return minimum
    patches, share = len(report["patches"]), percent(report["share_below"])
    where = f" in {counted(patches, 'patch', 'patches')}" if patches else ""
    return f"{minimum}, {share} below {report['limit']:g}{unit}{where}"


def open_streams() -> None:
    """Opens the null device in place of a standard stream that the caller closed."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115


def _turn_off(name: str) -> None:
    """Sends the buffer of a stream, and all further output, to the null device, so that Python ends quietly."""
    stream = getattr(sys, name)
    with open(os.devnull, "wb") as nowhere:
        try:
            os.dup2(nowhere.fileno(), stream.fileno())
        except (OSError, ValueError, io.UnsupportedOperation):  # a stream without a file
            setattr(sys, name, io.StringIO())


def _as_json(report: dict[str, Any], stream: TextIO) -> str:
    """In plain ASCII where the stream cannot show all of it; JSON knows other backslashes than terminals."""
    text = json.dumps(report, ensure_ascii=False)
    return text if shown(text, stream) == text else json.dumps(report)
