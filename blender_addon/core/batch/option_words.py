# SPDX-License-Identifier: GPL-3.0-or-later
"""This module converts the options of settings into words of a command line, and back."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping
from typing import Any, TypeVar

from ..options import Choice, Switch, options_of
from ..settings import OPTIONS, SAMPLING_OPTIONS, THICKNESS_OPTIONS, Between, Settings

_UNITS = {"rad": "DEG", "%": "PERCENT", "MB": "MB", "length": "LENGTH"}
# Thickness, skeletons and balls depend on these options of the method only; thresholds do not change them.
_MEASURED = ("sides", "sampling", *SAMPLING_OPTIONS)
T = TypeVar("T")


def add_options(parser: argparse._ArgumentGroup, kind: type, without: tuple[str, ...] = ()) -> None:
    """Add an argument `--name` for every option of a kind of settings; an option that is not given has its default."""
    _add(parser, {n: option for n, option in options_of(kind).items() if n not in without})


def add_thickness(parser: argparse._ArgumentGroup) -> None:
    """Add the options of ThicknessSettings as `add_options` does, but with `--gap` as a switch."""
    _add(parser, {n: option for n, option in THICKNESS_OPTIONS.items() if n != "between"})
    walls, gaps = THICKNESS_OPTIONS["between"].items.values()
    parser.add_argument(
        "--gap",
        dest="between",
        action="store_const",
        const=_word(Between.GAP),
        default=argparse.SUPPRESS,
        help=f"{gaps[1]} (default: {walls[1].lower()})",
    )


def add_sampling(parser: argparse._ArgumentGroup) -> None:
    """Add only the options of Settings that thickness, skeletons and balls depend on."""
    _add(parser, {name: OPTIONS[name] for name in _MEASURED})


def _add(parser: argparse._ArgumentGroup, options: Mapping[str, Any]) -> None:
    for name, option in options.items():
        flag = "--" + name.replace("_", "-")
        words: dict[str, Any] = {"dest": name, "default": argparse.SUPPRESS}
        if isinstance(option, Switch):
            words["action"] = argparse.BooleanOptionalAction
            shown = "on" if option.default else "off"
        elif isinstance(option, Choice):
            words["choices"] = [_word(member) for member in option.items]
            words["type"] = lambda text: text.lower().replace("_", "-")
            shown = _word(option.default)
        else:
            words["type"] = type(option.default)
            words["metavar"] = _UNITS.get(option.unit, name[0].upper())
            shown = f"{_outward(option, option.default):g}"
        parser.add_argument(flag, help=_help(option, shown), **words)


def settings_from(words: argparse.Namespace, kind: type[T]) -> T:
    """Return the settings of a kind, or the MemoryLimit, that a parsed command line means.

    Raises
    ------
    InvalidInputError
        A number is out of its range.
    """
    return kind(**_given(words, options_of(kind)))


def sampling_from(words: argparse.Namespace) -> Settings:
    """Return the settings from the options that `add_sampling` adds."""
    return Settings(**_given(words, {name: OPTIONS[name] for name in _MEASURED}))


def as_words(settings: Any) -> dict[str, str | float | bool]:
    """Return {option: value} of settings of any kind, with values as on the command line."""
    options = options_of(type(settings))
    return {name: _outward(option, getattr(settings, name)) for name, option in options.items()}


def _given(words: argparse.Namespace, options: Mapping[str, Any]) -> dict[str, Any]:
    given = {name: value for name, value in vars(words).items() if name in options}
    return {name: _inward(options[name], value) for name, value in given.items()}


def _help(option: Any, shown: str) -> str:
    """Return the help of an option; % is doubled, because argparse formats the text with %."""
    return f"{option.description} (default: {shown})".replace("%", "%%")


def _word(member: Any) -> str:
    return member.name.lower().replace("_", "-")


def _outward(option: Any, value: Any) -> Any:
    if isinstance(option, Choice):
        return _word(value)
    if getattr(option, "unit", "") == "rad":
        return float(f"{math.degrees(value):.12g}")
    return value


def _inward(option: Any, value: Any) -> Any:
    if isinstance(option, Choice):
        return next(member for member in option.items if _word(member) == value)
    if getattr(option, "unit", "") == "rad":
        radians = math.radians(value)
        known = (option.default, option.minimum, option.maximum)
        return next((x for x in known if math.isclose(x, radians, rel_tol=1e-12)), radians)
    return value
