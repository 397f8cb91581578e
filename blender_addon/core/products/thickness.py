# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of thickness."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..batch.batch import Item, begin, failure, make_folder, report_of, result_of
from ..batch.option_words import add_sampling, add_thickness, settings_from
from ..machine.job import Outcome, Task
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings, ThicknessSettings
from ..shape.shape import Shape
from ..shape.triangles import FEW
from ..thickness.measurement import Measurement
from ..thickness.parts_page import PartRow, export_page, row_of, row_without, verdict_of
from ..thickness.thickness import measure_thickness
from ..thickness.thin_parts import find_thin_parts
from ..thickness.write_thickness import THICKNESS_FORMATS, export_thickness, summary_of
from .product import DONE, THIN, UNMEASURED, Product


@dataclass(frozen=True)
class Thickness(Product):
    """Thickness; `unit` is what lengths are in."""

    wanted: ThicknessSettings
    unit: str = ""

    description = "How thick meshes and point clouds are, and where they are too thin."
    heading = "lengths"
    kind = ThicknessSettings
    formats = THICKNESS_FORMATS
    usual = "json"
    codes = (
        (0, "nothing is thinner than the limit"),
        (5, "something is thinner than the limit"),
        (6, "something could not be measured"),
    )
    help = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .csv   thickness at every vertex of the input and every other measured point
          .json  minimum, area and share below the limit, patches with place, area and minimum
          .ply   the measured surface, coloured: red at the limit, blue from three times the limit
          With --page FILE.html there is no OUTPUT: the page has a row for each INPUT.

examples:
  medial_axis thickness bracket.stl bracket.json --limit 1.2 --unit mm
  medial_axis thickness parts/*.stl reports/ --format csv --limit 1.2
  medial_axis thickness hinge.stl gaps.ply --limit 0.4 --gap
  medial_axis thickness parts/*.stl --limit 0.8 --unit mm --page report.html
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        lengths = parser.add_argument_group(cls.heading)
        add_thickness(lengths)
        lengths.add_argument(
            "--unit",
            default="",
            metavar="NAME",
            help="what lengths are in, for the report; mm, say",
        )
        add_sampling(parser.add_argument_group("method"))
        parser.add_argument(
            "--page",
            metavar="FILE",
            help="one page of .html with a row for each INPUT, instead of OUTPUT",
        )

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> Thickness:
        return cls(settings_from(words, Settings), settings_from(words, cls.kind), words.unit)

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> Measurement:
        return measure_thickness(shape, self.settings, self.wanted, progress, limit)

    def write(self, found: Measurement, path: Path, _frame: np.ndarray) -> tuple[str, ...]:
        export_thickness(found, find_thin_parts(found, self.wanted.limit), path, self.unit)
        return ()

    def figures(self, found: Measurement) -> dict[str, Any]:
        summary = summary_of(found, find_thin_parts(found, self.wanted.limit), self.unit)
        del summary["warnings"]  # every report has them
        return summary

    def exit_code(self, report: dict[str, Any]) -> int:
        if report["patches"]:
            return THIN
        return UNMEASURED if report["share_unmeasured"] > FEW else DONE

    def page(self, path: str) -> ThicknessPage:
        """Return a page for all outputs of a run."""
        return ThicknessPage(path, self, self.unit)


class ThicknessPage:
    """One page for all items of a batch; it is made anew each time, because it needs every measurement."""

    def __init__(self, path: str, work: Product, unit: str) -> None:
        self._path, self._work, self._unit = Path(path), work, unit
        self._rows: list[PartRow] = []

    def measured(
        self, item: Item, limit: MemoryLimit, run: Callable[[Task], Outcome]
    ) -> dict[str, Any]:
        """Measure an item, give it a row, and return its report."""
        work = self._work
        begun = begin(replace(item, output=self._path), work, True, limit)
        found = result_of(begun, run(begun.task))
        report: dict[str, Any] = {**report_of(begun, found), "row": len(self._rows) + 1}
        parts = find_thin_parts(found, work.wanted.limit)
        self._rows.append(row_of(item.name, found, parts, self._unit, report["warnings"]))
        return report

    def failed(self, item: Item, error: BaseException) -> dict[str, Any]:
        """Give an item that could not be measured a row that says why, and return its report."""
        report = failure(replace(item, output=self._path), error)
        self._rows.append(row_without(item.name, report["error"]))
        return report

    def written(self) -> dict[str, Any]:
        """Write the page, and return its report, or that of the reason why it could not be written."""
        wanted = self._work.wanted
        verdict = verdict_of(self._rows, wanted.limit, self._unit, wanted.between)
        place = {"input": str(self._path), "object": None, "frame": None, "output": str(self._path)}
        try:
            make_folder(self._path)
            export_page(self._rows, self._path, verdict, wanted.between)
        except Exception as error:
            return {"status": "failed", **place, "kind": type(error).__name__, "error": str(error)}
        figures = {"rows": len(self._rows), "places": sum(row.places for row in self._rows)}
        return {"status": "done", **place, **figures, "verdict": verdict}


RECORD = Thickness
