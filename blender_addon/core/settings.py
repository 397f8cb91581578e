"""Every option of the method: default, range, unit and words. This is their only home.

Dey & Zhao, sect. 3: an edge is selected by Angle[theta] or Ratio[rho].
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from .errors import InvalidInputError


class Side(Enum):
    """Which axis is wanted."""

    AUTOMATIC = "AUTOMATIC"
    INNER = "INNER"
    OUTER = "OUTER"
    BOTH = "BOTH"


class SidesFrom(Enum):
    """What tells inside from outside."""

    AUTOMATIC = "AUTOMATIC"
    SURFACE = "SURFACE"
    NORMALS = "NORMALS"
    TIGHT_COCONE = "TIGHT_COCONE"


class Rule(Enum):
    """Which ends of a Delaunay edge must pass a condition."""

    EITHER = "EITHER"
    BOTH = "BOTH"


class Criteria(Enum):
    """Which conditions select."""

    ANGLE_OR_RATIO = "ANGLE_OR_RATIO"
    ANGLE = "ANGLE"
    RATIO = "RATIO"


@dataclass(frozen=True)
class Number:
    """A number in [minimum, maximum]; `soft_maximum` is as far as a slider goes."""

    label: str
    description: str
    default: float
    minimum: float
    maximum: float
    soft_maximum: float
    unit: str  # "rad", or "" for a pure number


@dataclass(frozen=True)
class Choice:
    """One member of an enum; `items` gives each its label and description."""

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


OPTIONS: dict[str, Number | Choice | Switch] = {
    "theta": Number(
        label="Theta",
        description="Angle condition: keep a facet when the line between its two samples leaves "
        "the surface at more than this angle. Larger values keep less",
        default=math.pi / 8,
        minimum=0.0,
        maximum=math.pi / 2,
        soft_maximum=math.pi / 2,
        unit="rad",
    ),
    "rho": Number(
        label="Rho",
        description="Ratio condition: keep a facet when its two samples are farther apart "
        "than this many times the spacing of samples there. Larger values keep less",
        default=8.0,
        minimum=0.0,
        maximum=math.inf,
        soft_maximum=64.0,
        unit="",
    ),
    "side": Choice(
        label="Side",
        description="Which part of the medial axis is wanted",
        default=Side.AUTOMATIC,
        items={
            Side.AUTOMATIC: ("Automatic", "Inner"),
            Side.INNER: ("Inner", "The axis inside the shape"),
            Side.OUTER: ("Outer", "The axis outside the shape, bounded by a sphere around it"),
            Side.BOTH: ("Both", "The whole axis, bounded by a sphere around the shape"),
        },
    ),
    "sides": Choice(
        label="Inside From",
        description="What tells inside from outside",
        default=SidesFrom.AUTOMATIC,
        items={
            SidesFrom.AUTOMATIC: (
                "Automatic",
                "The faces when they close a volume; else the normals of the points when they "
                "have an attribute of that name; else Tight Cocone",
            ),
            SidesFrom.SURFACE: (
                "Surface",
                "The faces: inside is where their winding number is above one half",
            ),
            SidesFrom.NORMALS: (
                "Normals",
                "The attribute 'normal' of the points, which points outward: the points nearest "
                "to a place vote whether it is inside",
            ),
            SidesFrom.TIGHT_COCONE: (
                "Tight Cocone",
                "A watertight surface that is found through the points alone; faces are ignored",
            ),
        },
    ),
    "rule": Choice(
        label="Rule",
        description="Which ends of a pair of samples must pass a condition",
        default=Rule.EITHER,
        items={
            Rule.EITHER: ("Either", "One of the two samples is enough, as published"),
            Rule.BOTH: (
                "Both",
                "Both samples must pass: fewer islands on noisy samples, a little less rim",
            ),
        },
    ),
    "criteria": Choice(
        label="Criteria",
        description="Which conditions select facets",
        default=Criteria.ANGLE_OR_RATIO,
        items={
            Criteria.ANGLE_OR_RATIO: (
                "Angle or Ratio",
                "A facet that passes one condition is kept",
            ),
            Criteria.ANGLE: ("Angle", "Only the angle condition selects"),
            Criteria.RATIO: ("Ratio", "Only the ratio condition selects"),
        },
    ),
    "limit_set": Switch(
        label="Limit Set",
        description="Drop facets that the ratio condition alone keeps although their samples "
        "are too close for the size of the shape there: removes fins on tubes",
        default=False,
    ),
}


@dataclass(frozen=True)
class Settings:
    """What to select; the defaults are the paper's.

    Parameters
    ----------
    theta : float
        theta0 of the Angle condition, radians.
    rho : float
        rho0 of the Ratio condition.
    side : Side
    sides : SidesFrom
    rule : Rule
    criteria : Criteria
    limit_set : bool

    Raises
    ------
    InvalidInputError
        A number out of its range.
    """

    theta: float = OPTIONS["theta"].default
    rho: float = OPTIONS["rho"].default
    side: Side = OPTIONS["side"].default
    sides: SidesFrom = OPTIONS["sides"].default
    rule: Rule = OPTIONS["rule"].default
    criteria: Criteria = OPTIONS["criteria"].default
    limit_set: bool = OPTIONS["limit_set"].default

    def __post_init__(self) -> None:
        for name, option in OPTIONS.items():
            if isinstance(option, Number):
                _check_range(name, option, getattr(self, name))


def _check_range(name: str, option: Number, value: float) -> None:
    if not option.minimum <= value <= option.maximum:
        limits = f"at least {option.minimum:g}"
        if math.isfinite(option.maximum):
            limits = f"from {option.minimum:g} to {option.maximum:.6g} {option.unit}"
        raise InvalidInputError(
            f"Expected {name} {limits}, found {value:g}; the default is {option.default:.6g}"
        )
