# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of the records: everything that the command line and the batch ask of a product.

A new product is a room of core that computes it, a record here, and a line in PRODUCTS.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar

from ..batch.batch import Work
from ..batch.option_words import add_options, add_sampling, as_words, sampling_from, settings_from
from ..files.read_shape import read_shape
from ..machine.memory_limit import MemoryLimit
from ..settings import Settings

DONE, FAILED, USAGE, INPUT, CANCELLED, THIN, UNMEASURED = range(7)  # exit codes

# The words of the command line, and the files of the records; only the one that is used is imported.
PRODUCTS = {
    "": "axis",
    "thickness": "thickness",
    "thicken": "thicken",
    "skeleton": "skeleton",
    "balls": "balls",
    "midsurface": "mid_surface",
    "hollow": "hollow",
    "solidify": "solidify",
    "robot": "robot",
}


@dataclass(frozen=True)
class Product(Work):
    """A kind of result with its settings; the `repr` has all settings that an output depends on."""

    settings: Settings  # They are those of the method; thresholds count for the axis alone
    # The product's own settings, of the class `kind`; None where they are those of the method
    wanted: Any = None

    description: ClassVar[str]
    heading: ClassVar[str]  # of the product's own options
    kind: ClassVar[type]
    formats: ClassVar[Iterable[str]]  # extensions, such as ".ply"
    usual: ClassVar[str]  # the format of files in a folder, such as "ply"
    help: ClassVar[str]  # inputs, outputs and examples, after the options
    reads_shapes: ClassVar[bool] = True  # what is no shape has no connected parts
    samples: ClassVar[bool] = True  # whether the settings of the method matter
    hidden: ClassVar[tuple[str, ...]] = ()  # its own options that Blender has alone
    # The exit codes that mean other things than those of all products.
    codes: ClassVar[tuple[tuple[int, str], ...]] = ()

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        """Add the product's options to a parser."""
        add_options(parser.add_argument_group(cls.heading), cls.kind, without=cls.hidden)
        if cls.samples:
            add_sampling(parser.add_argument_group("method"))

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> Product:
        """Return the product that a parsed command line asks for; InvalidInputError where a number is wrong."""
        method = sampling_from(words) if cls.samples else Settings()
        return cls(method, settings_from(words, cls.kind))

    @staticmethod
    def read(path: str, limit: MemoryLimit) -> tuple[Any, tuple[str, ...]]:
        """Read a file; return the shape, or whatever the product reads, and warnings."""
        return read_shape(path, limit)

    def check(self, found: Any) -> None:
        """Accept every result: most products fail before there is nothing to write."""

    def beside(self, _output: Path) -> tuple[Path, ...]:
        """Return the files that are written next to an output, besides its report."""
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line, for the report."""
        own = {} if self.wanted is None else as_words(self.wanted)
        method = as_words(self.settings) if self.samples else {}
        return {**method, **{name: own[name] for name in own if name not in self.hidden}}

    def exit_code(self, _report: dict[str, Any]) -> int:
        """Return what the report of a finished output means for the whole run."""
        return DONE


def product(word: str) -> type[Product]:
    """Return the record of a word of PRODUCTS."""
    record: type[Product] = import_module(f".{PRODUCTS[word]}", __package__).RECORD
    return record
