# SPDX-License-Identifier: GPL-3.0-or-later
"""Every option of the method: default, range, unit and words. This is their only home.

Dey & Zhao, sect. 3: an edge is selected by Angle[theta] or Ratio[rho].
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any

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
    POLES = "POLES"


class SamplingMode(Enum):
    """Which points of the surface are analysed."""

    AUTOMATIC = "AUTOMATIC"
    VERTICES = "VERTICES"
    SURFACE = "SURFACE"
    ADAPTIVE = "ADAPTIVE"


class Rule(Enum):
    """Which ends of a Delaunay edge must pass a condition."""

    EITHER = "EITHER"
    BOTH = "BOTH"


class Criteria(Enum):
    """Which conditions select."""

    ANGLE_OR_RATIO = "ANGLE_OR_RATIO"
    ANGLE = "ANGLE"
    RATIO = "RATIO"


class Bind(Enum):
    """How an object follows an armature."""

    NONE = "NONE"
    AUTOMATIC = "AUTOMATIC"
    AXIS = "AXIS"


class Form(Enum):
    """What becomes of the facets that the conditions select."""

    CLEAN = "CLEAN"
    PUBLISHED = "PUBLISHED"
    CURVE = "CURVE"


class AboveLimit(Enum):
    """What becomes of an analysis that needs more memory than it may have."""

    REFUSE = "REFUSE"
    THIN = "THIN"


@dataclass(frozen=True)
class Number:
    """A number in [minimum, maximum]; `soft_maximum` is as far as a slider goes."""

    label: str
    description: str
    default: float
    minimum: float
    maximum: float
    soft_maximum: float
    unit: str  # "rad", "%", or "" for a pure number


@dataclass(frozen=True)
class Integer:
    """A whole number in [minimum, maximum]; `soft_minimum` to `soft_maximum` is where a slider goes."""

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


# Number, Integer, Choice or Switch; whoever names one knows which.
OPTIONS: dict[str, Any] = {
    "form": Choice(
        label="Form",
        description="What becomes of the facets that the conditions select",
        default=Form.CLEAN,
        items={
            Form.CLEAN: (
                "Clean",
                "Facets, and edges that stand by themselves, with the topology of the solid; without "
                "what the samples cannot tell from noise",
            ),
            Form.PUBLISHED: (
                "As Published",
                "The facets that pass the conditions and no others, which may fall into pieces",
            ),
            Form.CURVE: (
                "Curve",
                "A skeleton of curves with the topology of the solid",
            ),
        },
    ),
    "simplify": Number(
        label="Simplify",
        description="Drop whole sheets that are nowhere thicker than this, in percent of the diagonal of "
        "the bounding box; what joins the others stays as edges",
        default=0.0,
        minimum=0.0,
        maximum=100.0,
        soft_maximum=20.0,
        unit="%",
    ),
    "erode": Number(
        label="Erode",
        description="Let the rims of sheets recede to where they are thicker than this, in percent of the "
        "diagonal of the bounding box",
        default=0.0,
        minimum=0.0,
        maximum=100.0,
        soft_maximum=10.0,
        unit="%",
    ),
    "limb": Number(
        label="Limbs",
        description="Drop branches of single edges that are shorter than this, in percent of the diagonal "
        "of the bounding box",
        default=4.0,
        minimum=0.0,
        maximum=100.0,
        soft_maximum=20.0,
        unit="%",
    ),
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
                "have an attribute of that name; else Tight Cocone, or Poles where many of these "
                "contradict it",
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
            SidesFrom.POLES: (
                "Poles",
                "Balls inside and outside, labelled from the points alone: keeps cavities and thin "
                "walls, which Tight Cocone fills; faces are ignored",
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
        "are too close for the size of the shape there. This thins out fins on tubes, but only where "
        "samples are dense: at 8,000 samples it leaves a torus as it is",
        default=False,
    ),
    "sampling": Choice(
        label="Sampling",
        description="Which points of the surface are analysed",
        default=SamplingMode.AUTOMATIC,
        items={
            SamplingMode.AUTOMATIC: (
                "Automatic",
                "The vertices where they lie densely enough, or when there are no faces; else "
                "samples of the faces",
            ),
            SamplingMode.VERTICES: ("Vertices", "The vertices of the object and nothing else"),
            SamplingMode.SURFACE: (
                "Surface",
                "Evenly spread samples of the faces; sharp edges and corners are sampled first",
            ),
            SamplingMode.ADAPTIVE: (
                "Adaptive",
                "Samples of the faces, closer together where the shape is thin, until Epsilon is "
                "reached or Budget is spent",
            ),
        },
    ),
    "samples": Integer(
        label="Samples",
        description="How many samples of the faces are wanted; Adaptive starts from so many",
        default=16_000,
        minimum=100,
        maximum=5_000_000,
        soft_minimum=1_000,
        soft_maximum=200_000,
    ),
    "spacing": Number(
        label="Spacing",
        description="Distance between samples in percent of the diagonal of the bounding box; "
        "0: as the number of samples says",
        default=0.0,
        minimum=0.0,
        maximum=10.0,
        soft_maximum=5.0,
        unit="%",
    ),
    "epsilon": Number(
        label="Epsilon",
        description="The largest hole between samples that is dense enough, as a share of the "
        "distance to the medial axis there",
        default=0.25,
        minimum=0.02,
        maximum=1.0,
        soft_maximum=0.5,
        unit="",
    ),
    "budget": Integer(
        label="Budget",
        description="The most samples that Adaptive may take",
        default=200_000,
        minimum=100,
        maximum=5_000_000,
        soft_minimum=10_000,
        soft_maximum=1_000_000,
    ),
    "sharp_angle": Number(
        label="Sharp Angle",
        description="Edges are sharp where the directions of their faces differ by clearly more "
        "than this angle, or by twice this where all faces are shaded smooth; so are edges that are marked sharp",
        default=math.pi / 6,
        minimum=math.radians(1.0),
        maximum=math.pi,
        soft_maximum=math.pi,
        unit="rad",
    ),
    "smooth": Switch(
        label="Smooth",
        description="Samples follow the smooth surface that the faces approximate, which is "
        "creased at sharp edges only; off: they lie on the flat faces",
        default=True,
    ),
    "keep_vertices": Switch(
        label="Keep Vertices",
        description="The vertices of the faces are samples, too",
        default=False,
    ),
    "seed": Integer(
        label="Seed",
        description="Another number gives other samples; the same number always the same",
        default=0,
        minimum=0,
        maximum=2**31 - 1,
        soft_minimum=0,
        soft_maximum=100,
    ),
}

# Options of a machine and not of a result; in Blender they stand in the preferences.
LIMITS: dict[str, Any] = {
    "memory_limit": Integer(
        label="Memory Limit",
        description="Memory that an analysis may need, in MB; 0: what is free when it starts",
        default=0,
        minimum=0,
        maximum=1 << 24,
        soft_minimum=0,
        soft_maximum=1 << 16,
        unit="MB",
    ),
    "above_limit": Choice(
        label="Above the Limit",
        description="What is done when an analysis would need more memory",
        default=AboveLimit.REFUSE,
        items={
            AboveLimit.REFUSE: ("Refuse", "Nothing is computed; a message says what it would need"),
            AboveLimit.THIN: (
                "Thin",
                "As many samples of the faces, or evenly spread points of a cloud, as fit",
            ),
        },
    ),
}
# Options of a skeleton, beside those that say how faces are sampled.
SKELETON_OPTIONS: dict[str, Any] = {
    "detail": Number(
        label="Detail",
        description="How many ends the skeleton has: more let shorter and lighter branches stay",
        default=0.5,
        minimum=0.0,
        maximum=1.0,
        soft_maximum=1.0,
        unit="",
    ),
    "simplify": Number(
        label="Simplify",
        description="How far the skeleton may leave its curve to need fewer points, as a share of the radius "
        "there; 0 keeps all points",
        default=0.02,
        minimum=0.0,
        maximum=1.0,
        soft_maximum=0.5,
        unit="",
    ),
    "mirror": Switch(
        label="Mirror",
        description="Where the skeleton is symmetric in X to 2 % of its size, both halves become their mean",
        default=True,
    ),
}
BIND = Choice(
    label="Bind",
    description="How the object follows the armature",
    default=Bind.AXIS,
    items={
        Bind.NONE: ("None", "It does not: bones alone"),
        Bind.AUTOMATIC: (
            "Automatic",
            "Blender's automatic weights; where these fail, those of Axis",
        ),
        Bind.AXIS: (
            "Axis",
            "Each vertex follows the branch of the skeleton that its ball belongs to",
        ),
    },
)
# Options of how results look in Blender; what is computed does not depend on them.
LOOKS: dict[str, Any] = {
    "colours": Switch(
        label="Colours",
        description="Results have the attribute ma_color, by radius, which Solid view shows with "
        "Color: Attribute",
        default=True,
    ),
    "parent": Switch(
        label="Parent to Source",
        description="Results move and turn with the object that they were made of, and a medial axis is hidden "
        "with it",
        default=True,
    ),
    "within": Number(
        label="Within",
        description="Facets of an outer axis are shown as far as they lie in the bounding box, made so "
        "many times as large; 0: all of them",
        default=1.5,
        minimum=0.0,
        maximum=1000.0,
        soft_maximum=5.0,
        unit="",
    ),
    "smallest_island": Number(
        label="Smallest Island",
        description="Pieces of an axis as published with fewer of its facets than this are not shown; "
        "0: all pieces",
        default=0.0,
        minimum=0.0,
        maximum=100.0,
        soft_maximum=5.0,
        unit="%",
    ),
}
CACHE_SIZE = Integer(
    label="Cache Size",
    description="Memory that analyses may keep for other thresholds after a computation, in MB; "
    "the oldest go first",
    default=1 << 11,
    minimum=0,
    maximum=1 << 20,
    soft_minimum=0,
    soft_maximum=1 << 14,
    unit="MB",
)
MEGABYTE = 1 << 20  # bytes

# What needs another analysis; the other options only select facets of the one that is there.
ANALYSED = ("side", "sides", "sampling")
# The options that say how faces are sampled; which of them matter depends on the choice of Sampling.
SAMPLING_OPTIONS = (
    "samples",
    "spacing",
    "epsilon",
    "budget",
    "sharp_angle",
    "smooth",
    "keep_vertices",
    "seed",
)


def applies_to_form(name: str, form: Form) -> bool:
    """Whether an option changes anything for a Form."""
    if name in ("simplify", "erode"):
        return form is Form.CLEAN
    if name == "limb":
        return form is not Form.PUBLISHED
    return name != "limit_set" or form is Form.PUBLISHED


def applies(name: str, sampling: SamplingMode, spacing: float) -> bool:
    """Whether an option of the sampling changes anything for a choice of Sampling and a Spacing."""
    if name == "epsilon" or name not in SAMPLING_OPTIONS:
        return True
    if sampling is SamplingMode.VERTICES:
        return False
    if name == "samples":
        return spacing == 0.0
    return name != "budget" or sampling is not SamplingMode.SURFACE


@dataclass(frozen=True)
class Settings:
    """What to analyse and what to select; the thresholds' defaults are the paper's.

    Parameters
    ----------
    form : Form
    simplify, erode, limb : float
        Percent of the diagonal of the bounding box of the samples.
    theta : float
        theta0 of the Angle condition, radians.
    rho : float
        rho0 of the Ratio condition.
    side : Side
    sides : SidesFrom
    rule : Rule
    criteria : Criteria
    limit_set : bool
    sampling : SamplingMode
    samples, budget, seed : int
    spacing : float
        Percent of the diagonal of the bounding box.
    epsilon : float
    sharp_angle : float
        Radians.
    smooth, keep_vertices : bool

    Raises
    ------
    InvalidInputError
        A number out of its range.
    """

    form: Form = OPTIONS["form"].default
    simplify: float = OPTIONS["simplify"].default
    erode: float = OPTIONS["erode"].default
    limb: float = OPTIONS["limb"].default
    theta: float = OPTIONS["theta"].default
    rho: float = OPTIONS["rho"].default
    side: Side = OPTIONS["side"].default
    sides: SidesFrom = OPTIONS["sides"].default
    rule: Rule = OPTIONS["rule"].default
    criteria: Criteria = OPTIONS["criteria"].default
    limit_set: bool = OPTIONS["limit_set"].default
    sampling: SamplingMode = OPTIONS["sampling"].default
    samples: int = OPTIONS["samples"].default
    spacing: float = OPTIONS["spacing"].default
    epsilon: float = OPTIONS["epsilon"].default
    budget: int = OPTIONS["budget"].default
    sharp_angle: float = OPTIONS["sharp_angle"].default
    smooth: bool = OPTIONS["smooth"].default
    keep_vertices: bool = OPTIONS["keep_vertices"].default
    seed: int = OPTIONS["seed"].default

    @property
    def form_of_side(self) -> Form:
        """The form that the result has: only the inner axis has a clean form or a curve."""
        return self.form if self.side in (Side.AUTOMATIC, Side.INNER) else Form.PUBLISHED

    def with_side(self) -> Settings:
        """The same with a side that is not AUTOMATIC."""
        return replace(self, side=Side.INNER) if self.side is Side.AUTOMATIC else self

    def __post_init__(self) -> None:
        check_ranges(self, OPTIONS)


@dataclass(frozen=True)
class SkeletonSettings:
    """What becomes a branch of a skeleton.

    Parameters
    ----------
    detail, simplify : float
    mirror : bool

    Raises
    ------
    InvalidInputError
        A number out of its range.
    """

    detail: float = SKELETON_OPTIONS["detail"].default
    simplify: float = SKELETON_OPTIONS["simplify"].default
    mirror: bool = SKELETON_OPTIONS["mirror"].default

    def __post_init__(self) -> None:
        check_ranges(self, SKELETON_OPTIONS)

    @property
    def limb(self) -> float:
        """The shortest branch, as a share of the diagonal: 16 %, 4 %, 1 % for a detail of 0, 0.5, 1."""
        return 0.04 * 4.0 ** (1.0 - 2.0 * self.detail)

    @property
    def share(self) -> float:
        """The least share of the surface that a branch carries: 40 %, 2.5 %, 0.16 % for a detail of 0, 0.5, 1."""
        return 0.025 * 16.0 ** (1.0 - 2.0 * self.detail)


@dataclass(frozen=True)
class Look:
    """How a result looks in Blender.

    Parameters
    ----------
    colours, parent : bool
    within : float
        Times the bounding box of the samples.
    smallest_island : float
        Percent of the facets.
    """

    colours: bool = LOOKS["colours"].default
    parent: bool = LOOKS["parent"].default
    within: float = LOOKS["within"].default
    smallest_island: float = LOOKS["smallest_island"].default

    def __post_init__(self) -> None:
        check_ranges(self, LOOKS)


def check_ranges(values: Any, options: Mapping[str, Any]) -> None:
    """Raise InvalidInputError for a value of another kind than the default, or a number out of its range."""
    for name, option in options.items():
        value = getattr(values, name)
        _check_kind(name, option, value)
        if isinstance(option, (Number, Integer)):
            _check_range(name, option, value)


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
    if not option.minimum <= value <= option.maximum:
        style = "," if isinstance(option, Integer) else ".6g"
        limits = f"at least {option.minimum:{style}}"
        if math.isfinite(option.maximum):
            limits = f"from {option.minimum:{style}} to {option.maximum:{style}} {option.unit}"
        raise InvalidInputError(
            f"Expected {name} {limits.strip()}, found {value:{style}}; "
            f"the default is {option.default:{style}}"
        )


# --- thickness


class Between(Enum):
    """What a length is measured of."""

    WALL = "WALL"
    GAP = "GAP"


class Edges(Enum):
    """What stands at sharp edges, where a ball shrinks to nothing."""

    EXTRAPOLATE = "EXTRAPOLATE"
    BALL = "BALL"
    GREY = "GREY"


class Noise(Enum):
    """How good the points are."""

    CLEAN = "CLEAN"
    SCAN = "SCAN"


THICKNESS_OPTIONS: dict[str, Any] = {
    "limit": Number(
        label="Limit",
        description="What is thinner than this length is thin; 0: nothing is",
        default=0.0,
        minimum=0.0,
        maximum=math.inf,
        soft_maximum=1000.0,
        unit="length",
    ),
    "between": Choice(
        label="Measure",
        description="What is measured",
        default=Between.WALL,
        items={
            Between.WALL: ("Wall", "How thick the solid is between opposite walls"),
            Between.GAP: ("Gap", "How wide the space between walls that face each other is"),
        },
    ),
    "edges": Choice(
        label="Edges",
        description="What counts next to sharp edges, where no two walls face each other",
        default=Edges.EXTRAPOLATE,
        items={
            Edges.EXTRAPOLATE: ("Extrapolate", "The thickness of the nearest wall"),
            Edges.BALL: ("Ball", "The ball that fits there, which shrinks to nothing at an edge"),
            Edges.GREY: ("Grey", "Nothing: such places are grey and never thin"),
        },
    ),
    "noise": Choice(
        label="Noise",
        description="How good the points are",
        default=Noise.CLEAN,
        items={
            Noise.CLEAN: ("Clean", "The points lie on the surface"),
            Noise.SCAN: (
                "Scan",
                "The points scatter, up to a quarter of their spacing; what tapers reads too thick",
            ),
        },
    ),
    "minimum_patch": Number(
        label="Min. Patch",
        description="Thin patches with less than this share of the surface are left out, in percent",
        default=0.0,
        minimum=0.0,
        maximum=100.0,
        soft_maximum=5.0,
        unit="%",
    ),
}


@dataclass(frozen=True)
class ThicknessSettings:
    """What is measured, and what counts as thin.

    Parameters
    ----------
    limit : float
        A length; what is strictly below is thin.
    between : Between
    edges : Edges
        Of clean points; what a scan is measured by extrapolates.
    noise : Noise
    minimum_patch : float
        Percent of the area.

    Raises
    ------
    InvalidInputError
        A number out of its range.
    """

    limit: float = THICKNESS_OPTIONS["limit"].default
    between: Between = THICKNESS_OPTIONS["between"].default
    edges: Edges = THICKNESS_OPTIONS["edges"].default
    noise: Noise = THICKNESS_OPTIONS["noise"].default
    minimum_patch: float = THICKNESS_OPTIONS["minimum_patch"].default

    @property
    def side(self) -> Side:
        """The side whose axis tells."""
        return Side.INNER if self.between is Between.WALL else Side.OUTER

    def __post_init__(self) -> None:
        check_ranges(self, THICKNESS_OPTIONS)


# --- balls


class CoverMode(Enum):
    """What few balls promise."""

    INSIDE = "INSIDE"
    AROUND = "AROUND"


BALL_OPTIONS: dict[str, Any] = {
    "count": Integer(
        label="Balls",
        description="How many balls there are at most",
        default=64,
        minimum=1,
        maximum=100_000,
        soft_minimum=4,
        soft_maximum=1_000,
    ),
    "mode": Choice(
        label="Cover",
        description="What the balls promise",
        default=CoverMode.INSIDE,
        items={
            CoverMode.INSIDE: (
                "Inside",
                "No ball reaches out of the solid; each holds as much as it can of what the others leave",
            ),
            CoverMode.AROUND: (
                "Around",
                "The balls hold the whole surface, and so reach out of the solid",
            ),
        },
    ),
}


@dataclass(frozen=True)
class BallSettings:
    """How many balls, and what they promise.

    Parameters
    ----------
    count : int
    mode : CoverMode

    Raises
    ------
    InvalidInputError
        A number out of its range.
    """

    count: int = BALL_OPTIONS["count"].default
    mode: CoverMode = BALL_OPTIONS["mode"].default

    def __post_init__(self) -> None:
        check_ranges(self, BALL_OPTIONS)
