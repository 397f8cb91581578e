# SPDX-License-Identifier: GPL-3.0-or-later
"""Every option, declared once as a field of a dataclass: default, range, unit, label and description.

The command line (core/batch/option_words.py) and Blender's properties (ui/settings/properties.py) are derived from
these fields. Options of a machine are declared by MemoryLimit (core/machine/memory_limit.py).

Dey & Zhao, sect. 3: an edge is selected by Angle[theta] or Ratio[rho].
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import Enum

from .options import Choice, Integer, Options, choice, integer, number, options_of, switch


class Side(Enum):
    """The part of the medial axis that is computed."""

    AUTOMATIC = "AUTOMATIC"
    INNER = "INNER"
    OUTER = "OUTER"
    BOTH = "BOTH"


class SidesFrom(Enum):
    """The source of the decision between inside and outside."""

    AUTOMATIC = "AUTOMATIC"
    SURFACE = "SURFACE"
    NORMALS = "NORMALS"
    TIGHT_COCONE = "TIGHT_COCONE"
    POLES = "POLES"
    WRAP = "WRAP"


class Prepare(Enum):
    """The treatment of points without faces before they are analysed."""

    AUTOMATIC = "AUTOMATIC"
    OFF = "OFF"
    ALWAYS = "ALWAYS"


class SamplingMode(Enum):
    """The points of the surface that are analysed."""

    AUTOMATIC = "AUTOMATIC"
    VERTICES = "VERTICES"
    SURFACE = "SURFACE"
    ADAPTIVE = "ADAPTIVE"


class Rule(Enum):
    """The ends of a Delaunay edge that must pass a condition."""

    EITHER = "EITHER"
    BOTH = "BOTH"


class Criteria(Enum):
    """The conditions that select facets."""

    ANGLE_OR_RATIO = "ANGLE_OR_RATIO"
    ANGLE = "ANGLE"
    RATIO = "RATIO"


class Bind(Enum):
    """The way an object follows an armature."""

    NONE = "NONE"
    AUTOMATIC = "AUTOMATIC"
    AXIS = "AXIS"


class Form(Enum):
    """The form into which the selected facets are brought."""

    CLEAN = "CLEAN"
    PUBLISHED = "PUBLISHED"
    CURVE = "CURVE"


class Mesh(Enum):
    """The mesh of the sheets of a clean form."""

    EVEN = "EVEN"
    VORONOI = "VORONOI"


class AboveLimit(Enum):
    """The reaction to an analysis that needs more memory than the limit."""

    REFUSE = "REFUSE"
    THIN = "THIN"


CACHE_SIZE = Integer(
    label="Cache Size",
    description="Memory that analyses may keep for other thresholds after a computation, in MB; "
    "the oldest go first",
    default=3 << 10,
    minimum=0,
    maximum=1 << 20,
    soft_minimum=0,
    soft_maximum=1 << 14,
    unit="MB",
)
MEGABYTE = 1 << 20  # bytes

COARSE = 4_000  # samples of a quick answer
# These options determine how faces are sampled; the choice of Sampling determines which of them matter.
SAMPLING_OPTIONS = (
    "prepare",
    "wrap_opening",
    "samples",
    "spacing",
    "epsilon",
    "budget",
    "sharp_angle",
    "smooth",
    "keep_vertices",
    "pairs",
    "seed",
)
# These options need another analysis; the others only select facets of the analysis that exists.
ANALYSED = ("side", "sides", "sampling", *SAMPLING_OPTIONS)

# Readers of the paper know these; the panel has them under Method.
AS_IN_PAPER = ("wrap_opening", "epsilon", "budget", "keep_vertices", "pairs")


def applies_to_form(name: str, form: Form) -> bool:
    """Return whether an option changes anything for a Form."""
    if name in ("simplify", "erode", "spike", "mesh"):
        return form is Form.CLEAN
    if name == "detail":
        return form is Form.CURVE
    if name in ("limb", "crisp"):
        return form is not Form.PUBLISHED
    return name != "limit_set" or form is Form.PUBLISHED


def applies(
    name: str, sampling: SamplingMode, spacing: float, of_faces: tuple[str, ...] = ()
) -> bool:
    """Return whether an option of the sampling changes anything for a choice of Sampling and a Spacing.

    `of_faces` are the options that matter for Vertices, too (`Settings.options_of_faces`).
    """
    if name in ("epsilon", "wrap_opening", "prepare") or name not in SAMPLING_OPTIONS:
        return True
    if sampling is SamplingMode.VERTICES:
        return name in of_faces
    if name == "samples":
        return spacing == 0.0
    return name != "budget" or sampling is not SamplingMode.SURFACE


@dataclass(frozen=True)
class Settings(Options):
    """The choice of samples and of facets; the default thresholds are the paper's."""

    form: Form = choice(
        "Form",
        "What becomes of the facets that the conditions select",
        default=Form.CLEAN,
        items={
            Form.CLEAN: (
                "Clean",
                "Facets, and edges that stand by themselves, with the topology of the solid; without "
                "what the samples cannot tell from noise",
            ),
            Form.PUBLISHED: (
                "Raw",
                "The facets that pass the conditions and no others, which may fall into pieces",
            ),
            Form.CURVE: (
                "Curve",
                "A skeleton of curves with the topology of the solid",
            ),
        },
    )
    simplify: float = number(
        "Simplify",
        "Drop whole sheets that are nowhere thicker than this, in percent of the diagonal of "
        "the bounding box; what joins the others stays as edges",
        default=0.0,
        limits=(0.0, 100.0),
        soft_maximum=20.0,
        unit="%",
    )
    erode: float = number(
        "Trim Rims",
        "Let the rims of sheets recede to where they are thicker than this, in percent of the "
        "diagonal of the bounding box",
        default=0.0,
        limits=(0.0, 100.0),
        soft_maximum=10.0,
        unit="%",
    )
    spike: float = number(
        "Remove Spikes",
        "Drop the narrow parts of sheets, which lie in none of their discs that are thicker than this, in percent "
        "of the diagonal of the bounding box; rims of broad parts stay",
        default=0.0,
        limits=(0.0, 100.0),
        soft_maximum=10.0,
        unit="%",
    )
    limb: float = number(
        "Shortest Limb",
        "Drop branches of single edges that are shorter than this, in percent of the diagonal "
        "of the bounding box",
        default=4.0,
        limits=(0.0, 100.0),
        soft_maximum=20.0,
        unit="%",
    )
    detail: float = number(
        "Detail",
        "How much of what the samples show a curve keeps: at 1 everything; below, one after the other, loops of limbs "
        "that touch, pinholes, and the branches that are no limbs are left out; at 0 a skeleton is left. Grey where "
        "the curve has none of these: a lower Shortest Limb brings more",
        default=1.0,
        limits=(0.0, 1.0),
    )
    crisp: bool = switch(
        "Sharp Edges",
        "Balls touch the faces themselves, and sheets reach the sharp edges; off: balls touch the "
        "samples of the faces, which takes less time, most of all on smooth bodies. It matters only "
        "where the faces decide what is inside",
        default=True,
    )
    theta: float = number(
        "Theta",
        "More leaves sheets between walls that face each other; less lets them run into shallow bumps, dents and "
        "notches, too: a facet stays when the line between its two samples leaves the surface at more than this "
        "angle. Grey where Rho keeps what it drops",
        default=math.pi / 8,
        limits=(0.0, math.pi / 2),
        soft_maximum=math.pi / 4,
        unit="rad",
    )
    rho: float = number(
        "Rho",
        "More leaves what is thick for how densely it is sampled; less keeps fine detail and fringes, too: a facet "
        "stays when its two samples are farther apart than this many times the spacing of samples there. Grey where "
        "Theta keeps what it drops",
        default=8.0,
        limits=(0.0, math.inf),
        soft_maximum=16.0,
    )
    side: Side = choice(
        "Side",
        "Which part of the medial axis is wanted",
        default=Side.AUTOMATIC,
        items={
            Side.AUTOMATIC: ("Automatic", "Inner"),
            Side.INNER: ("Inner", "The axis inside the shape"),
            Side.OUTER: ("Outer", "The axis outside the shape, bounded by a sphere around it"),
            Side.BOTH: ("Both", "The whole axis, bounded by a sphere around the shape"),
        },
    )
    sides: SidesFrom = choice(
        "Inside Decided By",
        "What tells inside from outside",
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
            SidesFrom.WRAP: (
                "Wrap",
                "A closed surface that is wrapped round the faces, a little outside of them, for faces "
                "that bound nothing; openings up to Wrap Opening are closed",
            ),
        },
    )
    rule: Rule = choice(
        "Rule",
        "Which ends of a pair of samples must pass a condition",
        default=Rule.EITHER,
        items={
            Rule.EITHER: ("Either", "One of the two samples is enough, as published"),
            Rule.BOTH: (
                "Both",
                "Both samples must pass: fewer islands on noisy samples, a little less rim",
            ),
        },
    )
    criteria: Criteria = choice(
        "Criteria",
        "Which conditions select facets",
        default=Criteria.ANGLE_OR_RATIO,
        items={
            Criteria.ANGLE_OR_RATIO: (
                "Angle or Ratio",
                "A facet that passes one condition is kept",
            ),
            Criteria.ANGLE: ("Angle", "Only the angle condition selects"),
            Criteria.RATIO: ("Ratio", "Only the ratio condition selects"),
        },
    )
    limit_set: bool = switch(
        "Limit Set",
        "Drop facets that the ratio condition alone keeps although their samples "
        "are too close for the size of the shape there. This thins out fins on tubes, but only where "
        "samples are dense: at 8,000 samples it leaves a torus as it is",
        default=False,
    )
    mesh: Mesh = choice(
        "Mesh",
        "The faces of which sheets consist",
        default=Mesh.EVEN,
        items={
            Mesh.EVEN: ("Even", "Even triangles between shared seams and smooth rims"),
            Mesh.VORONOI: (
                "Voronoi",
                "The facets of the Voronoi diagram of the samples as they are, each between two of them; "
                "Sharp Edges moves none",
            ),
        },
    )
    sampling: SamplingMode = choice(
        "Sampling",
        "Which points of the surface are analysed",
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
    )
    prepare: Prepare = choice(
        "Denoise",
        "What is done to noisy points and faces, as of scans and voxels, before they are analysed",
        default=Prepare.AUTOMATIC,
        items={
            Prepare.AUTOMATIC: (
                "Automatic",
                "Where there is noise, points and the vertices of faces are moved onto smooth surfaces; of points "
                "without faces those that stand alone are left out, and noisy ones thinned. Clean ones stay as they "
                "are",
            ),
            Prepare.OFF: ("Off", "The points and faces stay as they are"),
            Prepare.ALWAYS: ("Always", "Points are moved also where noise is small"),
        },
    )
    samples: int = integer(
        "Samples",
        "How many samples of the faces are wanted; Adaptive starts from this number",
        default=16_000,
        limits=(100, 5_000_000),
        soft_limits=(1_000, 200_000),
    )
    spacing: float = number(
        "Spacing",
        "Distance between samples in percent of the diagonal of the bounding box; "
        "0: as the number of samples says",
        default=0.0,
        limits=(0.0, 10.0),
        soft_maximum=5.0,
        unit="%",
    )
    epsilon: float = number(
        "Epsilon",
        "The largest hole between samples that is dense enough, as a share of the "
        "distance to the medial axis there",
        default=0.25,
        limits=(0.02, 1.0),
        soft_maximum=0.5,
    )
    budget: int = integer(
        "Budget",
        "The most samples that Adaptive may take",
        default=200_000,
        limits=(100, 5_000_000),
        soft_limits=(10_000, 1_000_000),
    )
    wrap_opening: float = number(
        "Wrap Opening",
        "The width of openings that Inside Decided By: Wrap closes, in percent of the diagonal; smaller "
        "ones show more detail and take longer",
        default=1.0,
        limits=(0.25, 50.0),
        soft_maximum=10.0,
        unit="%",
    )
    sharp_angle: float = number(
        "Sharp Angle",
        "Edges are sharp where the directions of their faces differ by clearly more "
        "than this angle, or by twice this where all faces are shaded smooth; so are edges that are marked sharp",
        default=math.pi / 6,
        limits=(math.radians(1.0), math.pi),
        unit="rad",
    )
    smooth: bool = switch(
        "Smooth",
        "Samples follow the smooth surface that the faces approximate, which is "
        "creased at sharp edges only; off: they lie on the flat faces",
        default=True,
    )
    keep_vertices: bool = switch(
        "Keep Vertices", "The vertices of the faces are samples, too", default=False
    )
    pairs: bool = switch(
        "Pairs",
        "Between close walls, samples lie opposite each other, so that thin sheets are whole "
        "whatever the spacing; small details next to them still need small spacings",
        default=False,
    )
    seed: int = integer(
        "Seed",
        "Another number gives other samples; the same number always the same",
        default=0,
        limits=(0, 2**31 - 1),
        soft_limits=(0, 100),
    )

    @property
    def form_of_side(self) -> Form:
        """The form that the result has: only the inner axis has a clean form or a curve."""
        return self.form if self.side in (Side.AUTOMATIC, Side.INNER) else Form.PUBLISHED

    @property
    def crisp_is_possible(self) -> bool:
        """Whether Crisp can change anything: the axis is a level, and the faces may decide what is inside."""
        of_faces = self.sides in (SidesFrom.AUTOMATIC, SidesFrom.SURFACE, SidesFrom.WRAP)
        return of_faces and self.form_of_side is not Form.PUBLISHED

    @property
    def has_crisp_places(self) -> bool:
        """Whether the faces may give the vertices places."""
        return self.crisp and self.crisp_is_possible

    @property
    def options_of_faces(self) -> tuple[str, ...]:
        """The options of the sampling that say what the faces are, if the form of the axis depends on that.

        Crisp places are on the smooth surface and at its sharp edges; these also divide the sheets of a clean form.
        """
        if self.has_crisp_places:
            return ("sharp_angle", "smooth")
        return ("sharp_angle",) if self.form_of_side is Form.CLEAN else ()

    def with_side(self) -> Settings:
        """The same with a side that is not AUTOMATIC."""
        return replace(self, side=Side.INNER) if self.side is Side.AUTOMATIC else self


OPTIONS = options_of(Settings)


class KeptLoops(Enum):
    """The loops that a skeleton keeps."""

    AUTOMATIC = "AUTOMATIC"
    KEEP = "KEEP"
    OPEN = "OPEN"


class Fill(Enum):
    """Whether hollow solids count as full ones, and what their radii are."""

    OFF = "OFF"
    OUTSIDE = "OUTSIDE"
    INSIDE = "INSIDE"


@dataclass(frozen=True)
class SkeletonSettings(Options):
    """The branches that a skeleton keeps, and how exactly it follows its curve."""

    detail: float = number(
        "Branches",
        "How many ends the skeleton has: more let shorter and lighter branches stay",
        default=0.5,
        limits=(0.0, 1.0),
    )
    simplify: float = number(
        "Fewer Points",
        "How far the skeleton may leave its curve to need fewer points, as a share of the radius "
        "there; 0 keeps all points",
        default=0.02,
        limits=(0.0, 1.0),
        soft_maximum=0.5,
    )
    mirror: bool = switch(
        "Mirror",
        "Where the skeleton is symmetric in X to 2 % of its size, both halves become their mean",
        default=True,
    )
    loops: KeptLoops = choice(
        "Loops",
        "The loops that the skeleton keeps",
        default=KeptLoops.AUTOMATIC,
        items={
            KeptLoops.AUTOMATIC: (
                "Automatic",
                "All but those of limbs that touch, which are cut, and round pinholes, which are filled",
            ),
            KeptLoops.KEEP: ("Keep", "All loops of the curve"),
            KeptLoops.OPEN: (
                "Open",
                "None: as Automatic, and then each loop is opened where it is thinnest",
            ),
        },
    )

    fill: Fill = choice(
        "Fill",
        "Pipes, vessels and cups have the line of their outer faces: cavities and bores count as full",
        default=Fill.OFF,
        items={
            Fill.OFF: ("Off", "Walls have a skeleton of their own"),
            Fill.OUTSIDE: ("Radius Outside", "Radii are those of the outer faces"),
            Fill.INSIDE: ("Radius Inside", "Radii are those of the bore, where there is one"),
        },
    )

    @property
    def limb(self) -> float:
        """The shortest branch, as a share of the diagonal: 16 %, 4 %, 1 % for a detail of 0, 0.5, 1."""
        return 0.04 * 4.0 ** (1.0 - 2.0 * self.detail)

    @property
    def share(self) -> float:
        """The least share of the surface that a branch carries: 40 %, 2.5 %, 0.16 % for a detail of 0, 0.5, 1."""
        return 0.025 * 16.0 ** (1.0 - 2.0 * self.detail)


SKELETON_OPTIONS = options_of(SkeletonSettings)


class LimbControl(Enum):
    """The bones of a limb are moved one by one, by a target, or along a line."""

    NONE = "NONE"
    TARGET = "TARGET"
    SPLINE = "SPLINE"


@dataclass(frozen=True)
class RigSettings(Options):
    """The bones that a rig has along a skeleton."""

    per_limb: int = integer(
        "Bones per Limb",
        "The number of bones along each limb, where there is room for them; "
        "0: as many as its bends and its length need, and at least three",
        default=0,
        limits=(0, 100),
        soft_limits=(0, 8),
    )
    ik: LimbControl = choice(
        "IK",
        "What moves the bones of each limb that has two or more",
        default=LimbControl.NONE,
        items={
            LimbControl.NONE: ("Off", "Each bone is turned by itself"),
            LimbControl.TARGET: (
                "Target",
                "A target at its end that it reaches for; its joints bend in their plane",
            ),
            LimbControl.SPLINE: (
                "Spline",
                "A control at each joint; the limb lies along the line through them, for tails and tentacles",
            ),
        },
    )


RIG_OPTIONS = options_of(RigSettings)
BIND = Choice(
    label="Weights",
    description="How the object follows the armature",
    default=Bind.AXIS,
    items={
        Bind.NONE: ("None", "It does not: bones alone"),
        Bind.AUTOMATIC: (
            "By Blender",
            "Blender's automatic weights; where these fail, those of the medial axis",
        ),
        Bind.AXIS: (
            "By Medial Axis",
            "Each vertex follows the branch of the skeleton that its ball belongs to",
        ),
    },
)


@dataclass(frozen=True)
class Look(Options):
    """The looks of a result in Blender; what is computed does not depend on them."""

    colours: bool = switch(
        "Colours",
        "Results have the attribute ma_color, by radius, which Solid view shows with "
        "Color: Attribute",
        default=True,
    )
    by_part: bool = switch(
        "Colours by Part",
        "ma_color has a colour for each sheet of a clean form, instead of colours by radius",
        default=False,
    )
    parent: bool = switch(
        "Parent to Source",
        "Results move and turn with the object that they were made of",
        default=True,
    )
    within: float = number(
        "Within",
        "Facets of an outer axis are shown as far as they lie in the bounding box, enlarged by "
        "this factor, and are cut off there; 0: all of them",
        default=1.5,
        limits=(0.0, 1000.0),
        soft_maximum=5.0,
    )
    crumbs: float = number(
        "Remove Crumbs",
        "Pieces of a clean form or a curve without facets that are smaller than this many spacings of the "
        "samples are not shown, unless the closed faces have them, too; of an outer axis, pieces smaller than "
        "this many of their balls; 0: all pieces",
        default=1.0,
        limits=(0.0, 4.0),
    )
    lone_points: bool = switch(
        "Lone Points",
        "Single points are shown as balls; off: only where the axis is nothing else",
        default=False,
    )
    smallest_island: float = number(
        "Smallest Island",
        "Pieces of a raw axis with fewer of its facets than this are not shown; 0: all pieces",
        default=0.0,
        limits=(0.0, 100.0),
        soft_maximum=5.0,
        unit="%",
    )


LOOKS = options_of(Look)


@dataclass(frozen=True)
class Division(Options):
    """How a mesh is divided before anything is computed of it."""

    each_part: bool = switch(
        "Each Part by Itself",
        "Each connected part of a mesh is a solid of its own, with a result of its own; parts without "
        "thickness are left out. Off: parts that overlap are one solid",
        default=False,
    )


DIVISION = options_of(Division)


# --- thickness


class Between(Enum):
    """The place whose width is measured."""

    WALL = "WALL"
    GAP = "GAP"


class Edges(Enum):
    """The thickness at sharp edges, where a ball shrinks to nothing."""

    EXTRAPOLATE = "EXTRAPOLATE"
    BALL = "BALL"
    GREY = "GREY"


class Noise(Enum):
    """The quality of the points."""

    CLEAN = "CLEAN"
    SCAN = "SCAN"


@dataclass(frozen=True)
class ThicknessSettings(Options):
    """The length that is measured, and the length below which a place is thin.

    `edges` matters for clean points only: the measurement of a scan always extrapolates.
    """

    limit: float = number(
        "Limit",
        "What is thinner than this length is thin; 0: nothing is",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    between: Between = choice(
        "Measure",
        "What is measured",
        default=Between.WALL,
        items={
            Between.WALL: ("Wall", "How thick the solid is between opposite walls"),
            Between.GAP: ("Gap", "How wide the space between walls that face each other is"),
        },
    )
    edges: Edges = choice(
        "Edges",
        "What counts next to sharp edges, where no two walls face each other",
        default=Edges.EXTRAPOLATE,
        items={
            Edges.EXTRAPOLATE: ("Extrapolate", "The thickness of the nearest wall"),
            Edges.BALL: ("Ball", "The ball that fits there, which shrinks to nothing at an edge"),
            Edges.GREY: ("Grey", "Nothing: such places are grey and never thin"),
        },
    )
    noise: Noise = choice(
        "Noise",
        "How good the points are",
        default=Noise.CLEAN,
        items={
            Noise.CLEAN: ("Clean", "The points lie on the surface"),
            Noise.SCAN: (
                "Scan",
                "The points scatter, up to a quarter of their spacing; what tapers reads too thick",
            ),
        },
    )
    minimum_patch: float = number(
        "Min. Patch",
        "Thin patches with less than this share of the surface are left out, in percent",
        default=0.0,
        limits=(0.0, 100.0),
        soft_maximum=5.0,
        unit="%",
    )

    @property
    def side(self) -> Side:
        """The side whose axis determines the length."""
        return Side.INNER if self.between is Between.WALL else Side.OUTER


THICKNESS_OPTIONS = options_of(ThicknessSettings)


class Moving(Enum):
    """The walls that move where a solid is made thicker."""

    BOTH = "BOTH"
    SELECTED = "SELECTED"


@dataclass(frozen=True)
class ThickenSettings(Options):
    """The least thickness of walls, and how they get it."""

    limit: float = number(
        "Limit",
        "Walls that are thinner than this length become as thick",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    moving: Moving = choice(
        "Move",
        "Which walls move",
        default=Moving.BOTH,
        items={
            Moving.BOTH: ("Both Sides", "Each wall moves outward by half of what is missing"),
            Moving.SELECTED: (
                "Selected Faces",
                "Only faces that are selected in edit mode move, by all that is missing",
            ),
        },
    )
    blend: float = number(
        "Blend",
        "How far beyond thin walls the surface rises to them; 0: as far as the limit",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    subdivide: bool = switch(
        "Subdivide",
        "Divide large faces that are thin in one part only, so that their vertices can rise where the wall is thin",
        default=False,
    )


THICKEN_OPTIONS = options_of(ThickenSettings)


@dataclass(frozen=True)
class MidSurfaceSettings(Options):
    """Which parts of a solid become sheets, and how fine these are."""

    least_width: float = number(
        "Least Width",
        "A wall is at least this many times as wide as it is thick; narrower parts are left out. 0: none are",
        default=2.0,
        limits=(0.0, math.inf),
        soft_maximum=20.0,
    )
    size: float = number(
        "Size",
        "How long edges are at most; 0: as few faces as show the shape",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    quads: bool = switch(
        "Quads",
        "With a size: quadrilaterals, in flat sheets with four corners a grid, and triangles where they do not fit",
        default=False,
    )
    keep_thick: bool = switch(
        "Keep Thick Parts",
        "Keep the faces of parts that are not thin, as an object or a file of their own; off: they are left out",
        default=False,
    )


MID_SURFACE_OPTIONS = options_of(MidSurfaceSettings)


@dataclass(frozen=True)
class HollowSettings(Options):
    """The wall of a hollow solid."""

    wall: float = number(
        "Wall",
        "How thick the wall is that is left; 0: 3 % of the diagonal of the bounding box",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    voxel_size: float = number(
        "Voxel Size",
        "How fine the surface inside is, at most half of the wall; 0: a quarter of the wall, or more on large solids",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )


HOLLOW_OPTIONS = options_of(HollowSettings)


@dataclass(frozen=True)
class SolidifySettings(Options):
    """The wall that a sheet becomes."""

    thickness: float = number(
        "Thickness",
        "How thick the solid is; 0: 1 % of the diagonal of the bounding box",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    offset: float = number(
        "Offset",
        "Where the faces lie in the solid; -1: it is behind them, 0: on both sides, 1: in front of them",
        default=0.0,
        limits=(-1.0, 1.0),
    )
    only_selected: bool = switch(
        "Selected Faces",
        "Only faces that are selected in edit mode become a solid",
        default=False,
    )


SOLIDIFY_OPTIONS = options_of(SolidifySettings)


class DrainAt(Enum):
    """Where the hole in the wall of a hollow solid is."""

    LOWEST = "LOWEST"
    CURSOR = "CURSOR"


@dataclass(frozen=True)
class DrainSettings(Options):
    """The hole in the wall of a hollow solid."""

    drain: float = number(
        "Drain Hole",
        "How wide the hole in the wall is, through which what is inside flows out; 0: none",
        default=0.0,
        limits=(0.0, math.inf),
        soft_maximum=1000.0,
        unit="length",
    )
    drain_at: DrainAt = choice(
        "Drain At",
        "Where the hole is",
        default=DrainAt.LOWEST,
        items={
            DrainAt.LOWEST: ("Lowest Place", "Below the lowest place inside"),
            DrainAt.CURSOR: ("3D Cursor", "Where the wall is nearest to the 3D cursor"),
        },
    )


DRAIN_OPTIONS = options_of(DrainSettings)


# --- balls


class CoverMode(Enum):
    """The promise that a cover by few balls makes."""

    INSIDE = "INSIDE"
    AROUND = "AROUND"


class CoverShapes(Enum):
    """The shapes that cover a solid."""

    BALLS = "BALLS"
    CAPSULES = "CAPSULES"
    TAPERED = "TAPERED"


MOST_REFINED = 1024  # balls; above, ball_cover.cpp chooses greedily, too


@dataclass(frozen=True)
class BallSettings(Options):
    """The number of balls, and what they promise."""

    count: int = integer(
        "Count",
        "How many balls, or capsules, there are at most",
        default=64,
        limits=(1, 100_000),
        soft_limits=(4, 1_000),
    )
    shapes: CoverShapes = choice(
        "Shapes",
        "What covers the solid",
        default=CoverShapes.BALLS,
        items={
            CoverShapes.BALLS: ("Balls", "Balls of the medial axis"),
            CoverShapes.CAPSULES: (
                "Capsules",
                "Capsules of one radius, each merged from balls of the axis, as simulators have them",
            ),
            CoverShapes.TAPERED: (
                "Tapered Capsules",
                "Capsules with a radius at each end, each merged from balls of the axis",
            ),
        },
    )
    mode: CoverMode = choice(
        "Cover",
        "What the balls promise",
        default=CoverMode.INSIDE,
        items={
            CoverMode.INSIDE: (
                "Inside",
                "No ball reaches out of the solid by more than the Tolerance; of few balls thin parts, such as ears, "
                "get none, and Around leaves no part out",
            ),
            CoverMode.AROUND: (
                "Around",
                "The balls hold the whole surface, and so reach out of the solid",
            ),
        },
    )
    tolerance: float = number(
        "Tolerance",
        "How far balls Inside may reach out of the solid to hold more of its surface, in percent of the diagonal "
        "of the bounding box; Around, it changes nothing",
        default=0.0,
        limits=(0.0, 100.0),
        soft_maximum=5.0,
        unit="%",
    )
    refine: bool = switch(
        "Refine",
        "Leave no place far from the balls, then hold as much volume as possible; off, or with more than 1,024 "
        "balls: one after the other, so that the first of many are the few. Capsules do not need it",
        default=True,
    )


BALL_OPTIONS = options_of(BallSettings)
