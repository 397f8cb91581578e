# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of options, and how a dataclass declares its options as fields.

The command line and Blender's properties are derived from these declarations, and values are checked against them.
"""

from __future__ import annotations

import math
import numbers
from dataclasses import dataclass, field, fields
from enum import Enum
from typing import Any

from .errors import InvalidInputError


@dataclass(frozen=True)
class Number:
    """A number in [minimum, maximum], finite if it is a length; a slider ends at `soft_maximum`."""

    label: str
    description: str
    default: float
    minimum: float
    maximum: float
    soft_maximum: float
    unit: str  # "rad", "%", "length", or "" for a pure number


@dataclass(frozen=True)
class Integer:
    """A whole number in [minimum, maximum]; a slider goes from `soft_minimum` to `soft_maximum`."""

    label: str
    description: str
    default: int
    minimum: int
    maximum: int
    soft_minimum: int
    soft_maximum: int
    unit: str = ""


@dataclass(frozen=True)
class Choice:
    """One member of an enum; `items` gives each member its label and description."""

    label: str
    description: str
    default: Enum
    items: dict[Enum, tuple[str, str]]


@dataclass(frozen=True)
class Switch:
    """On or off."""

    label: str
    description: str
    default: bool


class Options:
    """The base of the dataclasses whose fields are options; a value that does not fit raises InvalidInputError."""

    def __post_init__(self) -> None:
        for name, option in options_of(type(self)).items():
            value = getattr(self, name)
            _check_kind(name, option, value)
            if isinstance(option, (Number, Integer)):
                _check_range(name, option, value)


def options_of(kind: type) -> dict[str, Any]:
    """{name: Number, Integer, Choice or Switch} of a dataclass, in the order of its fields."""
    return {
        each.name: each.metadata["option"] for each in fields(kind) if "option" in each.metadata
    }


# --- fields: each returns Any, so that a type checker believes the annotation


def number(
    label: str,
    description: str,
    *,
    default: float,
    limits: tuple[float, float],
    soft_maximum: float | None = None,
    unit: str = "",
) -> Any:
    """A field that is a Number; without `soft_maximum` the slider ends at the maximum."""
    end = limits[1] if soft_maximum is None else soft_maximum
    return _field(Number(label, description, default, *limits, end, unit))


def integer(
    label: str,
    description: str,
    *,
    default: int,
    limits: tuple[int, int],
    soft_limits: tuple[int, int],
    unit: str = "",
) -> Any:
    """A field that is an Integer."""
    return _field(Integer(label, description, default, *limits, *soft_limits, unit))


def choice(
    label: str, description: str, *, default: Enum, items: dict[Enum, tuple[str, str]]
) -> Any:
    """A field that is a Choice."""
    return _field(Choice(label, description, default, items))


def switch(label: str, description: str, *, default: bool) -> Any:
    """A field that is a Switch."""
    return _field(Switch(label, description, default))


def _field(option: Number | Integer | Choice | Switch) -> Any:
    return field(default=option.default, metadata={"option": option})


# --- checks


def _check_kind(name: str, option: Any, value: Any) -> None:
    kind = type(option.default)
    # NumPy's numbers count as Python's, and everything has a truth value.
    wider: dict[type, type] = {float: numbers.Real, int: numbers.Integral, bool: object}
    if not isinstance(value, wider.get(kind, kind)):
        raise InvalidInputError(
            f"Expected {name} to be of the kind {kind.__name__}, found {value!r}; "
            f"the default is {option.default!r}"
        )


def _check_range(name: str, option: Number | Integer, value: float) -> None:
    endless = option.unit == "length" and math.isinf(value)
    if endless or not option.minimum <= value <= option.maximum:
        style = "," if isinstance(option, Integer) else ".6g"
        limits = f"a finite length of at least {option.minimum:{style}}"
        if option.unit != "length":
            limits = f"at least {option.minimum:{style}}"
        if math.isfinite(option.maximum):
            limits = f"from {option.minimum:{style}} to {option.maximum:{style}} {option.unit}"
        raise InvalidInputError(
            f"Expected {name} {limits.strip()}, found {value:{style}}; "
            f"the default is {option.default:{style}}"
        )
