# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis of a surface sample (Dey & Zhao's MEDIAL), computed in C++.

Every id that leaves this module is a row of the input array: `edges`, `generators`, cells and umbrellas
speak of the caller's points. Of rows with the same coordinates only the first is a sample; the others are
merged into it and counted. Angles are radians, lengths are in the unit of the input, -1 means "none" or
"the infinite vertex". Returned arrays are read-only and keep their owner alive. The GIL is released while
C++ works; one object may be used from several threads.
"""

from typing import final

import numpy as np
from numpy.typing import NDArray

__version__: str  # that of the add-on and of the package

class InvalidInputError(ValueError):
    """An argument has the wrong shape, type, range or a value that is not finite; the message says which."""

class DegenerateInputError(ValueError):
    """The points are valid but span no volume: fewer than 4 distinct ones, or all on a line or a plane."""

class Cancelled(Exception):
    """`Progress.cancel` was called; nothing was computed."""

class Side:
    """Which axis a facet belongs to; also the values of `MedialMesh.side`."""

    BOTH: Side  # 0
    """As an argument every facet, as a value "not known"."""
    INNER: Side  # 1
    """Every Voronoi vertex of the facet is inside; by Tight Cocone, every cell round the dual edge, too."""
    OUTER: Side  # 2
    """No Voronoi vertex of the facet is inside."""
    CROSSING: Side  # 3
    """Some Voronoi vertices of the facet are inside; only as a value."""

class SidesFrom:
    """What tells inside from outside, for `MedialAnalysis`."""

    AUTOMATIC: SidesFrom  # 0
    """SURFACE when the triangles are closed, else NORMALS when given, else TIGHT_COCONE; or POLES where its
    `pole_disagreement` is above 0.05."""
    SURFACE: SidesFrom  # 1
    """The winding number of the triangles."""
    NORMALS: SidesFrom  # 2
    """A vote of outward normals of the samples nearest to a Voronoi vertex."""
    TIGHT_COCONE: SidesFrom  # 3
    """The watertight surface of `TightCocone`; needs the points only."""
    NONE: SidesFrom  # 4
    """Nothing; every facet has side BOTH."""
    POLES: SidesFrom  # 5
    """Labels that go from pole to pole, and a vote of the samples by those of their own; needs the points only, and
    keeps cavities."""

class Rule:
    """Which ends of a Delaunay edge pq must pass a condition (Dey & Zhao, sect. 3)."""

    EITHER: Rule  # 0
    """p or q, the paper's text."""
    BOTH: Rule  # 1
    """p and q, per criterion."""

class Criteria:
    """Which conditions select (Dey & Zhao, sect. 3.1 and 3.2; figures 5 and 7 show one alone)."""

    ANGLE_OR_RATIO: Criteria  # 0
    ANGLE: Criteria  # 1
    RATIO: Criteria  # 2

@final
class Faces:
    """The faces on which the samples of an analysis lie. A hierarchy takes exact places from them.

    The arrays are kept, without a copy where their types are right.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        Outward.
    face : (n,) int32
        The triangle on which each point of the analysis lies, or -1 for none.
    sharp_angle, sharp_edges, smooth
        As in `sample_surface`.

    Raises
    ------
    InvalidInputError
        The rows are checked when a hierarchy is made.
    """

    def __init__(
        self,
        vertices: NDArray[np.float64],
        triangles: NDArray[np.int32],
        face: NDArray[np.int32],
        *,
        sharp_angle: float = ...,
        sharp_edges: NDArray[np.int32] | None = None,
        smooth: bool = False,
    ) -> None: ...

@final
class Progress:
    """Shared by the thread that computes and the one that watches; every member is safe to use at any time."""

    def __init__(self) -> None: ...
    @property
    def fraction(self) -> float:
        """Share of the whole job that is done, 0 to 1, never falling."""
    @property
    def stage(self) -> str:
        """Name of the running stage, for people: 'Delaunay triangulation', 'Poles', ..."""
    @property
    def cancelled(self) -> bool:
        """Whether `cancel` was called."""
    def cancel(self) -> None:
        """Ask the computation to stop; it raises `Cancelled` within 0.3 s."""

@final
class CoconeOptions:
    """The constants of Cocone and Tight Cocone; all are angles in radians or pure numbers.

    Parameters
    ----------
    cocone_angle : float
        Half-angle of the cocone about the tangent plane; default pi/8 (Amenta, Choi, Dey & Leekha 2002).
    flatness_ratio : float
        A flat sample's cell is longer towards both poles than this times its width; default 1.2
        (Dey & Giesen 2001).
    flatness_angle : float
        A flat sample's normal line agrees with its cocone neighbours' within this; default pi/3
        (Dey & Giesen 2001).
    sharp_angle : float
        An edge is sharp when no two of its triangles continue each other with normals closer than this;
        default 2 pi/3 (Dey & Goswami 2003).

    Raises
    ------
    InvalidInputError
        An angle outside (0, pi/2), a sharp_angle outside (0, pi), or a ratio that is not positive.
    """

    def __init__(
        self,
        *,
        cocone_angle: float = ...,
        flatness_ratio: float = ...,
        flatness_angle: float = ...,
        sharp_angle: float = ...,
    ) -> None: ...
    @property
    def cocone_angle(self) -> float:
        """Half-angle of the cocone about the tangent plane, radians."""
    @property
    def flatness_ratio(self) -> float:
        """A flat sample's cell is longer towards both poles than this times its width."""
    @property
    def flatness_angle(self) -> float:
        """Largest angle between the normal lines of flat cocone neighbours, radians."""
    @property
    def sharp_angle(self) -> float:
        """Largest angle between the normals of triangles that continue each other, radians."""

@final
class TightCocone:
    """The watertight surface through the samples: a subcomplex of their Delaunay triangulation (Dey & Goswami 2003).

    Parameters
    ----------
    points : (n, 3) float64
        As for `MedialAnalysis`.
    options : CoconeOptions, optional
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, DegenerateInputError, Cancelled
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        *,
        options: CoconeOptions | None = None,
        progress: Progress | None = None,
        threads: int = 0,
    ) -> None: ...
    @property
    def triangles(self) -> NDArray[np.int32]:
        """(f, 3) int32: facets between inner and outer cells, outward, lowest row first, in lexicographic order.
        Every edge is in an even number of them. Empty when nothing is enclosed."""
    @property
    def cell_side(self) -> NDArray[np.int32]:
        """(c,) int32: INNER or OUTER for each cell of `delaunay(points)`, infinite cells included."""
    @property
    def samples(self) -> NDArray[np.int32]:
        """(k,) int32: rows of the distinct points, ascending."""
    @property
    def flat(self) -> NDArray[np.bool_]:
        """(k,) bool: well sampled there: the Voronoi cell is long and thin and its neighbours agree."""
    @property
    def good(self) -> NDArray[np.bool_]:
        """(k,) bool: the triangles that Cocone finds at the sample are one disc round it."""
    @property
    def on_surface(self) -> NDArray[np.bool_]:
        """(k,) bool: a corner of one of `triangles`."""
    @property
    def nonmanifold_edges(self) -> int:
        """Edges in more than two of `triangles`."""
    @property
    def nonmanifold_vertices(self) -> int:
        """Samples round which `triangles` are not one disc, ends of those edges included."""
    @property
    def cavities(self) -> int:
        """Patches of good samples inside the solid that flooding from infinity cannot reach: closed inner
        cavities, most likely, which are filled."""
    @property
    def inner_cells(self) -> int:
        """Delaunay cells inside; 0 when the samples enclose nothing."""
    @property
    def left_outside(self) -> int:
        """Samples without an inner cell: outliers, or parts that could not be closed."""
    @property
    def encloses(self) -> bool:
        """At most half of the samples are left outside. Otherwise the solid is empty, or pinched to pieces, and says
        nothing about the shape: INNER and OUTER cannot be extracted."""
    @property
    def duplicates(self) -> int:
        """Rows merged into an earlier row with the same coordinates."""
    @property
    def timings(self) -> dict[str, float]:
        """Seconds of each stage, in order; none for that of a `MedialAnalysis`."""

@final
class MedialMesh:
    """The selected Voronoi facets as convex, planar polygons that share their vertices.

    Facets are ordered by their generators (p < q); each polygon turns counter-clockwise about the direction
    from p to q and starts at its lowest vertex id. No facet has zero area, no two vertices coincide.
    """

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(v, 3) float64: Voronoi vertices, the centres of empty balls, in order of first use."""
    @property
    def radius(self) -> NDArray[np.float64]:
        """(v,) float64: radius of each vertex' empty ball: its distance to the nearest samples."""
    @property
    def face_offsets(self) -> NDArray[np.int32]:
        """(f + 1,) int32: facet i has the corners `face_vertices[face_offsets[i] : face_offsets[i + 1]]`."""
    @property
    def face_vertices(self) -> NDArray[np.int32]:
        """(c,) int32: vertex ids, facet after facet."""
    @property
    def theta(self) -> NDArray[np.float64]:
        """(f,) float64, radians in [0, pi/2]: the Angle condition holds for every theta0 below it."""
    @property
    def rho(self) -> NDArray[np.float64]:
        """(f,) float64: the Ratio condition holds for every rho0 below it."""
    @property
    def side(self) -> NDArray[np.int32]:
        """(f,) int32: values of `Side`."""
    @property
    def generators(self) -> NDArray[np.int32]:
        """(f, 2) int32: rows p < q of the two samples whose cells meet in the facet."""
    @property
    def edges(self) -> NDArray[np.int32]:
        """(e, 2) int32: vertices of the edges without a facet, whose three facets all lie on the side; only LAMBDA has
        such."""
    @property
    def unbounded(self) -> int:
        """Selected facets that reach infinity; they are counted, never emitted."""
    @property
    def zero_area(self) -> int:
        """Selected facets that are a point or a segment (cospherical samples), by centres that are right to 2^-40 of
        the radius or better; they are not emitted."""
    @property
    def rings(self) -> int:
        """Rings of cells that were walked: of the facets that the conditions select, without those that one cell
        shows to lie on the other side."""

@final
class Level:
    """One level of a `Hierarchy`: polygons, edges that stand by themselves, and single vertices."""

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(v, 3) float64: Voronoi vertices, the centres of empty balls, in order of first use by facets, wires and
        points. Relaxed: what is shown; vertices of wires but their ends are new ones, the last of all."""
    @property
    def radius(self) -> NDArray[np.float64]:
        """(v,) float64: radius of each vertex' ball: the empty one, or, relaxed, that of what is shown."""
    @property
    def exact(self) -> NDArray[np.float64]:
        """(v, 3) float64: the place of the vertex of the hierarchy that each vertex stands for, a Voronoi vertex inside
        the solid; equal to `vertices` unless relaxed. Neighbours on a wire may stand for the same one."""
    @property
    def exact_radius(self) -> NDArray[np.float64]:
        """(v,) float64: radius of the empty ball there."""
    @property
    def vertex_of(self) -> NDArray[np.int32]:
        """(v,) int32: vertex of the hierarchy that each vertex stands for; of new vertices the nearest along the
        wire."""
    @property
    def place(self) -> NDArray[np.uint8]:
        """(v,) uint8: how each vertex was placed, as `Hierarchy.place`."""
    @property
    def face_offsets(self) -> NDArray[np.int32]:
        """(f + 1,) int32: facet i has the corners `face_vertices[face_offsets[i] : face_offsets[i + 1]]`."""
    @property
    def face_vertices(self) -> NDArray[np.int32]:
        """(c,) int32: vertex ids, facet after facet: convex, counter-clockwise about p -> q, lowest id first."""
    @property
    def generators(self) -> NDArray[np.int32]:
        """(f, 2) int32: rows p < q of the two samples whose cells meet in the facet, in lexicographic order."""
    @property
    def facet_of(self) -> NDArray[np.int32]:
        """(f,) int32: facet of the hierarchy, for its values."""
    @property
    def theta(self) -> NDArray[np.float64]:
        """(f,) float64, radians: as in `MedialMesh`, by the rule of the hierarchy."""
    @property
    def rho(self) -> NDArray[np.float64]:
        """(f,) float64: as in `MedialMesh`, by the rule of the hierarchy."""
    @property
    def sheet(self) -> NDArray[np.float32]:
        """(f,) float32: `facet_sheet` of each facet."""
    @property
    def erosion(self) -> NDArray[np.float32]:
        """(f,) float32: `facet_erosion` of each facet."""
    @property
    def wires(self) -> NDArray[np.int32]:
        """(w, 2) int32: ends of the edges without a facet."""
    @property
    def edge_of(self) -> NDArray[np.int32]:
        """(w,) int32: edge of the hierarchy, for its values; of new wires that at the middle."""
    @property
    def limb(self) -> NDArray[np.float32]:
        """(w,) float32: `edge_limb` of each wire."""
    @property
    def points(self) -> NDArray[np.int32]:
        """(k,) int32: vertices without an edge: the axis of a ball is one."""
    @property
    def betti(self) -> tuple[int, int, int]:
        """Components, tunnels and cavities, counted on the level; those of the hierarchy."""
    @property
    def hidden(self) -> int:
        """Edges from a vertex to itself, facets with fewer than three other edges, and facets with the corners of
        another one: they count but cannot be drawn. Only where very many samples are cospherical."""

@final
class Hierarchy:
    """All levels of the inner medial axis, from one ordered collapse of the inner Voronoi complex: each has the
    topology of the solid. Made by `MedialAnalysis.hierarchy`.

    The complex: its vertices are the inner cells, its edges the triangles between two of them, its facets the Delaunay
    edges all of whose cells are inner, its 3-cells the samples all of whose cells are inner. Cells without extent, as
    of cospherical samples, are shrunk to what they are. A value says up to which threshold a cell is there; it is
    infinite for what no threshold takes away. No cell has a larger value than a face of it.
    """

    @property
    def betti(self) -> tuple[int, int, int]:
        """Components, tunnels and cavities of the complex, and so of every level."""
    @property
    def bytes(self) -> int:
        """Memory that the hierarchy holds."""
    @property
    def diagonal(self) -> float:
        """Of the box of the samples: the unit of `sheet`, `erosion` and `limb`."""
    @property
    def cells(self) -> NDArray[np.int32]:
        """(v,) int32: cell of each vertex, the lowest of several in one place, as numbered by `delaunay` (without a
        bounding sphere)."""
    @property
    def vertices(self) -> NDArray[np.float64]:
        """(v, 3) float64: where the vertices are."""
    @property
    def radius(self) -> NDArray[np.float64]:
        """(v,) float64: radius of each vertex' empty ball."""
    @property
    def crisp_vertices(self) -> NDArray[np.float64]:
        """(v, 3) float64: where the vertices are on the medial axis of the faces; none without faces."""
    @property
    def crisp_radius(self) -> NDArray[np.float64]:
        """(v,) float64: the distance of `crisp_vertices` to the faces where `place` is 2 or more, else `radius`."""
    @property
    def place(self) -> NDArray[np.int32]:
        """(v,) int32: how each crisp place was found.

        0: it is the Voronoi vertex, because no walls are known there, or the samples are very dense; 1: it is the
        Voronoi vertex, because the ball of the walls was not empty or too far away; 2: the ball touches the walls; 3:
        it is on a smooth rim; 4: it is on a convex crease; 5: it is in a corner."""
    @property
    def on_crease(self) -> NDArray[np.uint8]:
        """(v,) uint8: 1 where a rim ends on a sharp convex edge of the faces; none without faces."""
    @property
    def edges(self) -> NDArray[np.int32]:
        """(e, 2) int32: ends of each edge, the lower vertex first."""
    @property
    def generators(self) -> NDArray[np.int32]:
        """(f, 2) int32: rows p < q of the samples of each facet; in no order that means anything."""
    @property
    def facet_offsets(self) -> NDArray[np.int32]:
        """(f + 1,) int32: facet i has the corners facet_offsets[i] : facet_offsets[i + 1]."""
    @property
    def facet_vertices(self) -> NDArray[np.int32]:
        """(c,) int32: vertex at each corner."""
    @property
    def facet_edges(self) -> NDArray[np.int32]:
        """(c,) int32: edge from each corner to the next."""
    @property
    def shrunk(self) -> NDArray[np.int32]:
        """(s, 4) int32: facets without area: rows p < q of the samples, the edge that it is or -1, a vertex of it."""
    @property
    def bubbles(self) -> NDArray[np.int32]:
        """(b,) int32: rows of the samples inside the solid; each is a 3-cell of the complex."""
    @property
    def facet_sheet(self) -> NDArray[np.float32]:
        """(f,) float32: thickness of the thickest facet of the sheet, as a share of the diagonal, of each facet."""
    @property
    def edge_sheet(self) -> NDArray[np.float32]:
        """(e,) float32: the same of each edge."""
    @property
    def vertex_sheet(self) -> NDArray[np.float32]:
        """(v,) float32: the same of each vertex."""
    @property
    def facet_spacings(self) -> NDArray[np.float32]:
        """(f,) float32: as `facet_sheet`, in local spacings of the samples."""
    @property
    def edge_spacings(self) -> NDArray[np.float32]:
        """(e,) float32: the same of each edge."""
    @property
    def vertex_spacings(self) -> NDArray[np.float32]:
        """(v,) float32: the same of each vertex."""
    @property
    def facet_erosion(self) -> NDArray[np.float32]:
        """(f,) float32: erosion thickness as a share of the diagonal: how much later than the radius of the ball there
        a fire from the rims comes to the facet; at least that of all that has to burn before."""
    @property
    def edge_erosion(self) -> NDArray[np.float32]:
        """(e,) float32: the same of each edge."""
    @property
    def vertex_erosion(self) -> NDArray[np.float32]:
        """(v,) float32: the same of each vertex."""
    @property
    def facet_spike(self) -> NDArray[np.float32]:
        """(f,) float32: the largest thickness of a facet in whose disc of the sheet the facet lies, as a share of the
        diagonal; at least that of all that has to burn before. Computed when it is first read."""
    @property
    def edge_spike(self) -> NDArray[np.float32]:
        """(e,) float32: the same of each edge."""
    @property
    def vertex_spike(self) -> NDArray[np.float32]:
        """(v,) float32: the same of each vertex."""
    @property
    def edge_limb(self) -> NDArray[np.float32]:
        """(e,) float32: length of the branch of each edge, as a share of the diagonal: how long it is, or how far its
        tip sticks out, whichever is less; 0 where the edge goes with a facet."""
    @property
    def vertex_limb(self) -> NDArray[np.float32]:
        """(v,) float32: the same of each vertex; infinite where it stays."""
    @property
    def timings(self) -> dict[str, float]:
        """Seconds of each stage, in order."""
    def held_balls(
        self,
        centres: NDArray[np.float64],
        radii: NDArray[np.float64],
        along: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """(n, 3), (n,) the balls of a curve: where flat walls hold a ball, its place and the distance to the walls.
        Elsewhere a ball stays, and is no larger than leaves the faces by as much as their smooth surface bulges over
        the flat one: balls between samples leave what is thinner than these are apart. Without faces all is as given.

        Parameters
        ----------
        centres : (n, 3) float64
        radii : (n,) float64
        along : (n, 3) float64
            The direction of the curve, or 0 where the place has to stay.

        Raises
        ------
        InvalidInputError
        """
    def even(
        self,
        *,
        spacings: float = 0.0,
        limb: float = 0.04,
        round_limbs: bool = False,
        crisp: bool = False,
        progress: Progress | None = None,
    ) -> Hierarchy:
        """The hierarchy of a level that gets a mesh of its own: even triangles, and not the facets of the Voronoi
        diagram. Its facets are the triangles, each with the generators, theta and rho of a facet for which it stands,
        and its levels without thresholds are all of the mesh. At others, new rims are smooth lines.

        Parameters
        ----------
        spacings, limb, round_limbs
            The thresholds of the level, as in `extract`.
        crisp : bool
            If the hierarchy was made with faces, the vertices are where balls touch them.
        progress : Progress, optional

        Raises
        ------
        InvalidInputError, Cancelled
        """
    def selecting(self, theta: float, rho: float, *, progress: Progress | None = None) -> Hierarchy:
        """The hierarchy of the same even mesh at other thresholds of MEDIAL, where these are higher; what lower ones
        would select is not in the mesh.

        Parameters
        ----------
        theta : float
            In radians.
        rho : float
        progress : Progress, optional

        Raises
        ------
        InvalidInputError, Cancelled
        """
    def extract(
        self,
        *,
        sheet: float = 0.0,
        spacings: float = 0.0,
        erosion: float = 0.0,
        spike: float = 0.0,
        limb: float = 0.04,
        relaxed: bool = False,
        round_limbs: bool = False,
        crisp: bool = False,
        progress: Progress | None = None,
    ) -> Level:
        """The level at some thresholds. A facet stays if it exceeds the first four. A vertex or an edge stays if it
        does, or if it exceeds `limb`. What no threshold takes away always stays.

        Parameters
        ----------
        sheet : float
            Thickness of the sheet, as a share of the diagonal; default 0. Sheets go whole.
        spacings : float
            The same in local spacings of the samples; default 0. 1 drops what the samples cannot tell from noise.
        erosion : float
            Thickness of the facet itself, as a share of the diagonal; default 0. Rims recede.
        spike : float
            Thickness of the sheet in a disc round the facet, likewise; default 0. Narrow parts go, rims of broad parts
            stay.
        limb : float
            Length of the branch of a wire, as a share of the diagonal; default 0.04.
        relaxed : bool
            For the eye: wires are smoothed, divided anew and fitted to the samples round them, rims are smoothed. The
            topology and the facets are the same, and `exact` says where all that is on the Voronoi diagram.
        round_limbs : bool
            Of wires with a loose end only those that run in round limbs.
        crisp : bool
            Vertices are at their crisp places, if the hierarchy was made with faces; those of even meshes always are.
        progress : Progress, optional

        Infinity takes all away that can go: `sheet=inf` leaves a curve skeleton.

        Raises
        ------
        InvalidInputError, Cancelled
        """

class CoverMode:
    """What `cover_by_balls` promises."""

    INSIDE: CoverMode  # 0
    """No ball reaches out of the solid."""
    AROUND: CoverMode  # 1
    """The balls hold all of the surface, and all places of the lattice in the solid."""

@final
class BallCover:
    """Few balls; made by `cover_by_balls`."""

    @property
    def chosen(self) -> NDArray[np.int32]:
        """(n,) int32: rows of the balls to choose from, in the order of the volume that each adds; without `refine` in
        the order in which they were chosen, which does not depend on their number. Fewer than asked for: more of them
        would not add anything."""
    @property
    def radii(self) -> NDArray[np.float64]:
        """(n,) float64: inside no longer than to the surface and the tolerance, around grown."""
    @property
    def covered(self) -> NDArray[np.float64]:
        """(n,) float64: share of the places in the solid that the first 1, 2, ... n balls hold, before they grow."""
    @property
    def held(self) -> float:
        """Share of the places in the solid that all balls hold, after they grew."""
    @property
    def outside(self) -> float:
        """No place in a ball is farther from the solid."""
    @property
    def farthest(self) -> float:
        """No place on the surface is farther from the balls."""
    @property
    def places(self) -> int:
        """Of the lattice in the solid."""
    @property
    def step(self) -> float:
        """Of the lattice."""

@final
class CapsuleCover:
    """Few capsules; made by `cover_by_capsules`. A capsule is the union of the balls round the places of a segment,
    with linear radii; a ball where both ends are equal."""

    @property
    def ends(self) -> NDArray[np.float64]:
        """(2n, 3) float64: the ends of capsule k are the rows 2k and 2k + 1, those of the largest volume first."""
    @property
    def radii(self) -> NDArray[np.float64]:
        """(2n,) float64: at the ends."""
    @property
    def held(self) -> float:
        """Share of the places in the solid that all capsules hold."""
    @property
    def outside(self) -> float:
        """No place in a capsule is farther from the solid."""
    @property
    def farthest(self) -> float:
        """No place on the surface is farther from the capsules."""
    @property
    def places(self) -> int:
        """Of the lattice in the solid."""
    @property
    def step(self) -> float:
        """Of the lattice."""

@final
class ScanMeasure:
    """Properties of points without faces; made by `measure_scan`. Lengths are in the unit of the points."""

    @property
    def spacing(self) -> float:
        """The distance of neighbours, as if the points were evenly spread."""
    @property
    def noise(self) -> float:
        """The standard deviation of a point from the surface; 0.0 where no noise is seen."""
    @property
    def kurtosis(self) -> float:
        """How the points spread over the noise: 3 as errors do, 1.8 evenly, 1 in two layers."""
    @property
    def mates(self) -> float:
        """How many pairs of close points have the same height over the surface, in units of what errors have.

        1 for errors, 1.5 to 2 where each view of a scan lies off as a whole; 0.0 where no noise is seen, or where
        larger neighbourhoods hold two walls.
        """
    @property
    def duplicates(self) -> int:
        """The number of rows that repeat an earlier one."""
    @property
    def outliers(self) -> NDArray[np.int32]:
        """(k,) int32: ascending rows of points that stand alone."""
    @property
    def border(self) -> float:
        """The share of the points at which the surface ends, because a wide sector round them is empty."""

@final
class SurfaceNoise:
    """The noise of the vertices of faces; made by `surface_noise`. Lengths are in the unit of the points."""

    @property
    def spacing(self) -> float:
        """The distance of neighbours, as if the vertices were evenly spread."""
    @property
    def noise(self) -> float:
        """Their standard deviation from a smooth surface; 0.0 where no noise is seen."""
    @property
    def radius(self) -> float:
        """The radius of the neighbourhoods that show the noise, and not yet the shape; 0.0 where no noise is seen."""

@final
class PreparedScan:
    """Points on smooth surfaces through a scan; made by `prepare_scan`."""

    @property
    def rows(self) -> NDArray[np.int32]:
        """(k,) int32: ascending rows of the points that were kept."""
    @property
    def points(self) -> NDArray[np.float64]:
        """(k, 3) float64: their places."""
    @property
    def moved(self) -> NDArray[np.float64]:
        """(k,) float64: how far each was moved."""

class ThicknessMode:
    """What `MedialAnalysis.thickness` measures."""

    WALL: ThicknessMode  # 0
    """Balls between walls, whose normals differ by 120 degrees or more. Elsewhere, as next to an edge, what the
    nearest wall along the surface has, or the largest ball that is near, but never less than the ball at the
    sample itself."""
    BALL: ThicknessMode  # 1
    """All balls; zero at every convex edge."""
    SCAN: ThicknessMode  # 2
    """The ball that comes nearest, of those at facets with a theta above 50 degrees at both ends, for noise. No
    normals are used; what tapers reads too thick."""

@final
class TriangleTree:
    """A tree of boxes round the triangles of a surface, for distances from it.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        One at least; they may be without area.

    Raises
    ------
    InvalidInputError
    """

    def __init__(self, vertices: NDArray[np.float64], triangles: NDArray[np.int32]) -> None: ...
    def distances(
        self, queries: NDArray[np.float64], *, progress: Progress | None = None, threads: int = 0
    ) -> NDArray[np.float64]:
        """(q,) float64: how far each query is from the nearest triangle.

        Parameters
        ----------
        queries : (q, 3) float64
        progress : Progress, optional
        threads : int
            0: as many as the machine has. The result does not depend on it.

        Raises
        ------
        InvalidInputError, Cancelled
        """

@final
class BallFaces:
    """The faces of a solid, flat or smooth, as walls that balls touch.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        Rows of `vertices`, outward; the whole boundary of a solid.
    sharp_angle, sharp_edges, smooth
        As of `sample_surface`.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

    def __init__(
        self,
        vertices: NDArray[np.float64],
        triangles: NDArray[np.int32],
        *,
        sharp_angle: float = ...,
        sharp_edges: NDArray[np.int32] | None = None,
        smooth: bool = True,
        progress: Progress | None = None,
        threads: int = 0,
    ) -> None: ...
    def creases(self) -> tuple[NDArray[np.int32], NDArray[np.bool_], NDArray[np.int32]]:
        """(e, 2) int32: rows of the vertices at the ends of each sharp or open edge; (e,) bool: whether the solid is
        convex there; (c,) int32: rows of the vertices at corners and at tips."""
    def inscribed_balls(
        self,
        points: NDArray[np.float64],
        face: NDArray[np.int32],
        spacing: NDArray[np.float64],
        normals: NDArray[np.float64] | None = None,
        *,
        rounding: float = 0.0,
        progress: Progress | None = None,
        threads: int = 0,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """The largest balls in the solid that touch its faces at given places.

        Parameters
        ----------
        points : (n, 3) float64
            On the faces.
        face : (n,) int32
            The triangle on which each point lies; -1 if it is unknown.
        spacing : (n,) float64
            Closer than this to a point, faces that look almost as it does belong to its surroundings: the distance at
            which triangles tell the curvature of the surface.
        normals : (n, 3) float64, optional
            Of the faces there: unit, outward. Where one is zero, there is no ball. Without them, the points are moved
            to the smooth surface of their faces, and have its normals.
        rounding : float
            How far coordinates may be off.
        progress : Progress, optional
        threads : int
            0: as many as the machine has. The result does not depend on it.

        Returns
        -------
        diameters : (n,) float64
            Infinite where nothing is opposite.
        walls, parallel : (n,) float64
            The same between walls: where the ball touches, as far as the surface is known, a place whose normal
            differs by 120 degrees or more, or by 165 degrees; else infinite.

        Raises
        ------
        InvalidInputError, Cancelled
        """
    def rolled_balls(
        self,
        points: NDArray[np.float64],
        face: NDArray[np.int32],
        spacing: NDArray[np.float64],
        *,
        rounding: float = 0.0,
        progress: Progress | None = None,
        threads: int = 0,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The balls between walls to which those at given places roll, away from what they touch.

        In a square pin they are those of its middle line, at the narrow side of a plate those of the plate. The
        arguments are those of `inscribed_balls`.

        Returns
        -------
        walls, parallel : (n,) float64
            As those of `inscribed_balls`; infinite where a ball comes to rest between no walls.

        Raises
        ------
        InvalidInputError, Cancelled
        """

@final
class WallThickness:
    """How thick a solid is at its samples, or how wide the gap; made by `MedialAnalysis.thickness`."""

    @property
    def values(self) -> NDArray[np.float64]:
        """(k,) float64: at each of `MedialAnalysis.samples`, in the unit of the input; infinite where there is no
        wall, or no ball."""
    @property
    def measured(self) -> NDArray[np.bool_]:
        """(k,) bool: measured at the sample itself; else filled from the nearest along the surface, or infinite."""

@final
class MedialAnalysis:
    """Everything about a point set that does not depend on the thresholds; computed once, extracted often.

    Parameters
    ----------
    points : (n, 3) float64
        Samples of the surface: finite, below 1e50, spread over more than 1e-50. Float32 is accepted and converted;
        other types are refused.
    triangles : (m, 3) int32, optional
        Outward-facing triangles of the surface as rows of `vertices`: they tell inside from outside.
    vertices : (v, 3) float64, optional
        What the rows of `triangles` mean; none: `points`, and rows that no triangle uses are samples all the same.
        Rows with the same coordinates are one vertex. Given, the vertices are no samples, and rows that no triangle
        uses count for nothing.
    normals : (n, 3) float64, optional
        Outward normals of the samples, of any length; a zero normal has no vote.
    sides : SidesFrom
        What tells inside from outside; default AUTOMATIC.
    cocone : CoconeOptions, optional
        For TIGHT_COCONE and POLES.
    bounding_sphere : bool
        Add 200 points at twice the radius (Dey & Zhao, sect. 4.2). It bounds the outer axis and removes
        its far junk; only edges between true samples are analysed and selected.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, DegenerateInputError, Cancelled
    """

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int32] | None = None,
        *,
        vertices: NDArray[np.float64] | None = None,
        normals: NDArray[np.float64] | None = None,
        sides: SidesFrom = ...,
        cocone: CoconeOptions | None = None,
        bounding_sphere: bool = False,
        progress: Progress | None = None,
        threads: int = 0,
    ) -> None: ...
    @property
    def samples(self) -> NDArray[np.int32]:
        """(k,) int32: rows of the distinct points, ascending."""
    @property
    def duplicates(self) -> int:
        """Rows merged into an earlier row with the same coordinates: n - k."""
    @property
    def edges(self) -> NDArray[np.int32]:
        """(e, 2) int32: all Delaunay edges between samples, p < q, in lexicographic order."""
    @property
    def theta(self) -> NDArray[np.float64]:
        """(e,) float64: max over the two ends of pi/2 - max over t in U_p of angle(n_t, pq) (sect. 3.1)."""
    @property
    def rho(self) -> NDArray[np.float64]:
        """(e,) float64: max over the two ends of |pq| / max over t in U_p of R_t (sect. 3.2)."""
    @property
    def theta_both(self) -> NDArray[np.float64]:
        """(e,) float64: as `theta` with the minimum of the two ends (`Rule.BOTH`)."""
    @property
    def rho_both(self) -> NDArray[np.float64]:
        """(e,) float64: as `rho` with the minimum of the two ends (`Rule.BOTH`)."""
    @property
    def side(self) -> NDArray[np.int32]:
        """(e,) int32: values of `Side` for the facet dual to each edge; all BOTH for `SidesFrom.NONE`."""
    @property
    def sides_from(self) -> SidesFrom:
        """What told inside from outside; never AUTOMATIC."""
    @property
    def pole_disagreement(self) -> float | None:
        """float: of the samples whose labelled poles lie on two sides, the share for which Tight Cocone says otherwise;
        None unless AUTOMATIC had to choose between the two."""
    @property
    def tight_cocone(self) -> TightCocone | None:
        """The surface that told inside from outside; None unless `sides_from` is TIGHT_COCONE. Its `cell_side` is
        empty: with a bounding sphere the cells are not those of `delaunay`."""
    @property
    def bounded(self) -> NDArray[np.bool_]:
        """(e,) bool: the dual facet does not reach infinity."""
    @property
    def closed(self) -> bool:
        """Every edge of the triangles is used equally often in both directions, and there are triangles."""
    @property
    def boundary_edges(self) -> int:
        """Edges of the triangles that break this."""
    @property
    def cells(self) -> int:
        """Number of finite Delaunay cells."""
    @property
    def bytes(self) -> int:
        """Memory that the analysis holds."""
    @property
    def timings(self) -> dict[str, float]:
        """Seconds of each stage, in order."""
    @property
    def spacing(self) -> NDArray[np.float64]:
        """(k,) float64: largest circumradius in the umbrella U_p of each of `samples`: the hole round it; infinite
        for an empty umbrella."""
    def feature_size(
        self,
        theta: float = ...,
        rho: float = ...,
        rule: Rule = ...,
        criteria: Criteria = ...,
        *,
        rows: NDArray[np.int32] | None = None,
        progress: Progress | None = None,
    ) -> NDArray[np.float64]:
        """(k,) float64: estimated local feature size: distance of each of `samples` to the nearest Voronoi vertex of a
        selected facet of either side; infinite when nothing is selected. Finite vertices of unbounded facets and
        those of zero-area facets count. Of vertices closer to each other than 1/32 of the radius of their balls some
        are left out: the distance is too large by at most 1/32 of itself. `spacing` / feature_size is the epsilon of
        the theorem.

        Parameters
        ----------
        theta, rho, rule, criteria
            As in `extract`.
        rows : (m,) int32, optional
            Only of the samples of these rows of the points, in that order.
        progress : Progress, optional

        Raises
        ------
        InvalidInputError, Cancelled
        """
    def thickness(
        self,
        normals: NDArray[np.float64] | None = None,
        *,
        edges: NDArray[np.bool_] | None = None,
        mode: ThicknessMode = ...,
        side: Side = ...,
        theta: float = ...,
        rho: float = ...,
        rule: Rule = ...,
        criteria: Criteria = ...,
        progress: Progress | None = None,
    ) -> WallThickness:
        """How thick the solid is at each of `samples`, or how wide the gap. The ball that is tangent at p and touches
        q has the diameter |pq|^2 / (n_p . (p - q)); the least over the selected facets (p, q) counts. Between walls
        the ball is tangent to the plane at q, too.

        Parameters
        ----------
        normals : (n, 3) float64, optional
            Outward normals of the points, of any length; what has a zero one is filled. Only SCAN does without.
        edges : (n,) bool, optional
            Points on sharp edges, where a normal is the mean of sides: they are filled. Default: none.
        mode : ThicknessMode
            WALL (default), BALL or SCAN.
        side : Side
            INNER (default) or OUTER, the gap; it needs a bounding sphere where gaps are open. What faces nothing has
            an infinite one.
        theta, rho, rule, criteria
            As in `extract`; SCAN has its own.
        progress : Progress, optional

        Raises
        ------
        InvalidInputError, Cancelled
        DegenerateInputError
            `TightCocone.encloses` is false.
        """
    def doubts(
        self,
        vertices: NDArray[np.float64],
        triangles: NDArray[np.int32],
        normals: NDArray[np.float64],
        reach: NDArray[np.float64],
        *,
        progress: Progress | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Places where the points are too sparse for the topology of the faces on which they lie: a Voronoi edge meets
        the faces more often than the sides of its ends demand, or on another wall than a sample of it.

        Parameters
        ----------
        vertices : (v, 3) float64
        triangles : (m, 3) int32
            The faces, outward.
        normals : (n, 3) float64
            Outward normals of the points; zero where there is none.
        reach : (n,) float64
            The farthest place of the faces that each point may be the nearest of; what is farther does not count.
        progress : Progress, optional

        Returns
        -------
        places : (k, 3) float64
            Where Voronoi edges meet the faces.
        gaps : (k,) float64
            The distance from there along the edge to where it meets them again, or to the samples.

        Raises
        ------
        InvalidInputError, Cancelled
        """
    def solid_triangles(self) -> NDArray[np.int32]:
        """(f, 3) int32: rows of the facets between inner and outer cells, outward, lowest row first, in lexicographic
        order: the surface as the samples see it. A cell is inner when its Voronoi vertex is; by Tight Cocone, when it
        is part of the solid, as in `TightCocone.triangles`. Every edge is in an even number of them. Raises
        InvalidInputError for `SidesFrom.NONE`."""
    def hierarchy(
        self,
        theta: float = ...,
        rho: float = ...,
        rule: Rule = ...,
        criteria: Criteria = ...,
        side: Side = ...,
        *,
        bodies: int | None = None,
        faces: Faces | None = None,
        partners: NDArray[np.int32] | None = None,
        places: bool = True,
        progress: Progress | None = None,
    ) -> Hierarchy:
        """The levels of the inner axis; computed once, extracted often. It does not need the analysis any more.

        Parameters
        ----------
        theta, rho, rule, criteria
            As in `extract`: what they select is in the level with the thresholds 0, with the bridges that it lacks.
        side : Side
            INNER only.
        bodies : int, optional
            The number of bodies of the solid, if it is known. Parts without any ball larger than the hole between the
            samples at them are left out then, those with few cells first, until no more parts than bodies are left.
        faces : Faces, optional
            The faces of the solid. With them facets between the two sides of a sharp convex edge are selected,
            whatever the thresholds say, and even meshes lie where balls touch the faces.
        partners : (n,) int32, optional
            The row of the partner of each point on the opposite wall, or -1, as in `SurfaceSamples.partner`. The facets
            between partners are selected, whatever the thresholds say, and they are no noise of the samples.
        places : bool
            With faces, every vertex also has a crisp place, which takes long.
        progress : Progress, optional

        Raises
        ------
        InvalidInputError, Cancelled
        DegenerateInputError
            `TightCocone.encloses` is false.
        """
    def select(
        self,
        theta: float = ...,
        rho: float = ...,
        side: Side = ...,
        rule: Rule = ...,
        criteria: Criteria = ...,
        *,
        limit_set: bool = False,
    ) -> NDArray[np.int32]:
        """Ids (rows of `edges`), ascending, of the edges that satisfy Angle[theta] or Ratio[rho]: the set F of
        MEDIAL, unbounded and zero-area facets included. An edge of U_p is not tried from p (step 5 of MEDIAL), which
        matters only for rho < 2 and theta = 0. Parameters as in `extract`."""
    def extract(
        self,
        theta: float = ...,
        rho: float = ...,
        side: Side = ...,
        rule: Rule = ...,
        criteria: Criteria = ...,
        *,
        limit_set: bool = False,
        progress: Progress | None = None,
    ) -> MedialMesh:
        """The closure of the selected facets.

        Parameters
        ----------
        theta : float
            theta0 of the Angle condition, radians in [0, pi/2]; default pi/8.
        rho : float
            rho0 of the Ratio condition, >= 0; default 8.
        side : Side
            BOTH (default), INNER or OUTER; INNER and OUTER need sides.
        rule : Rule
            EITHER (default) or BOTH.
        criteria : Criteria
            ANGLE_OR_RATIO (default), ANGLE or RATIO.
        limit_set : bool
            Keep a facet selected by the Ratio condition alone only if |pq| >= eps^(1/4) mu (Definition 4), where
            mu is the smallest ball radius at the facet's vertices and eps = |pq| / (rho mu). Default off.

        Raises
        ------
        InvalidInputError, Cancelled
        DegenerateInputError
            INNER or OUTER, and `TightCocone.encloses` is false.
        """

class SampleKind:
    """What a sample lies on; the values of `SurfaceSamples.kind`."""

    CORNER: SampleKind  # 0
    """A vertex that ends other than two creases, a sharp turn of a chain, or the tip of a cone."""
    SHARP: SampleKind  # 1
    """A sharp edge."""
    BOUNDARY: SampleKind  # 2
    """An edge of one triangle."""
    VERTEX: SampleKind  # 3
    """A kept vertex away from creases."""
    SURFACE: SampleKind  # 4
    """Anywhere."""
    OPENING: SampleKind  # 5
    """Off the triangles; only `closing_samples` makes them."""

@final
class SurfaceSamples:
    """Samples of a triangulated surface, as made by `sample_surface`.

    Corners come first, then places along sharp edges, along boundary edges, kept vertices, and the surface.
    """

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 3) float64: the samples."""
    @property
    def normals(self) -> NDArray[np.float64]:
        """(n, 3) float64: outward unit normals; where sides meet their mean; zero where there is none."""
    @property
    def triangle(self) -> NDArray[np.int32]:
        """(n,) int32: row of the triangle that the sample lies on."""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """(n, 3) float64: where on its triangle."""
    @property
    def kind(self) -> NDArray[np.int32]:
        """(n,) int32: values of `SampleKind`, ascending."""
    @property
    def radius(self) -> NDArray[np.float64]:
        """(n,) float64: radius of the sample's disc, 0.727 of the spacing there. No SURFACE sample is nearer to any
        other sample than the smaller of their radii, unless their normals are a right angle or more apart."""
    @property
    def partner(self) -> NDArray[np.int32]:
        """(n,) int32: the sample on the opposite wall, or -1; always -1 without `pairs`. Of several partners one is
        named: two samples are partners if either names the other."""
    @property
    def bend(self) -> NDArray[np.float64]:
        """(n,) float64: curvature of the surface at samples with partners, by the normals of their triangles
        and the next ones; 0 at all others. Pairs s apart follow walls t apart while s * s * bend is well below t."""
    @property
    def sharp_edges(self) -> NDArray[np.int32]:
        """(e, 2) int32: rows p < q of the ends of the sharp edges, sorted; of equal vertices the lowest row."""
    @property
    def area(self) -> float:
        """Area of the sampled surface."""

def sample_surface(
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    count: int | None = None,
    spacing: float | None = None,
    sizing: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None,
    sharp_angle: float = ...,
    sharp_edges: NDArray[np.int32] | None = None,
    smooth: bool = False,
    keep_vertices: bool = False,
    mirrored_rows: int = 2,
    pairs: bool = False,
    seed: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
) -> SurfaceSamples:
    """Blue-noise samples of a triangulated surface, its corners and sharp edges among them.

    Corners, creases (sharp and boundary edges) and kept vertices come first and stay; then discs are thrown on the
    surface until there is no room for one more (maximal Poisson-disk sampling: Cook 1986; Ebeida et al. 2012).
    Holes are hardly wider than the discs: the farthest place is about 1.2 radii from its nearest sample.

    The same input gives the same samples, whatever the number of threads.

    Parameters
    ----------
    vertices : (v, 3) float64
        Finite, below 1e50. Those with the same coordinates are one; those that no triangle uses are passed over.
    triangles : (m, 3) int32
        Rows of vertices, outward. A triangle repeated, either way round, counts once; those without area get no
        samples.
    count : int, optional
        Wanted number of samples, met within about 1 % where corners, creases and kept vertices leave room; with
        `sizing` the most that are allowed.
    spacing : float, optional
        Distance of neighbours in a hexagonal lattice of the same density, s = sqrt(2 A / (sqrt(3) n)).
    sizing : ((k, 3) float64, (k,) float64), optional
        Sites and the spacings there; elsewhere that of the nearest site counts. A spacing is first lowered to a
        neighbouring site's plus 0.3 of its distance. If more samples than `count` would be needed, all spacings
        are made larger alike.
    sharp_angle : float
        Edges whose triangles' normals are at least this far apart are sharp, radians; default pi/6. So are edges of
        more than two triangles and edges that two triangles pass in the same direction. A chain of creases that
        turns by more than this has a corner there; so has the tip of a cone.
    sharp_edges : (e, 2) int32, optional
        Rows of the ends of further sharp edges; pairs that are no edge of a triangle are passed over.
    smooth : bool
        Samples lie on PN triangles (Vlachos et al. 2001): cubic patches whose normals are averages over smooth fans,
        weighted by angle. Sharp edges are curves tangent to both sides, so there are no cracks. Default: flat.
    keep_vertices : bool
        Every vertex of a triangle is a sample, too; triangles that use one twice are none.
    mirrored_rows : int
        So many rows of samples along each sharp edge of two triangles, 0.75, 1.6, 2.45, ... spacings from it, are
        the same on both sides of the edge, where there is room: their Voronoi facets lie in the bisector of the
        sides, and the medial axis runs straight into the edge; default 2.
    pairs : bool
        Where walls are closer than two spacings, samples lie opposite each other: each has its partner where the ball
        that touches the surface there from inside touches the wall that looks the other way. The facets between
        partners are pieces of the sheet between the walls, however close these are. Across gaps it is the same, by
        the ball outside, but these samples are no partners. Default: without.
    seed : int
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError
        Besides wrong shapes and types: not exactly one of count, spacing and sizing (a count may go with sizing), a
        value out of range, a corner that is no row, no triangle with an area, or more than 268 million samples.
    Cancelled
    """

def patches(
    triangles: NDArray[np.int32], wanted: NDArray[np.bool_], vertices: int
) -> NDArray[np.int32]:
    """(m,) int32: number of the patch of each triangle: those of `wanted` that share a corner are in one. Patches are
    numbered in the order of their first triangles; -1: not wanted.

    Parameters
    ----------
    triangles : (m, 3) int32
    wanted : (m,) bool
    vertices : int
        The number of rows that the triangles count.

    Raises
    ------
    InvalidInputError
    """

class CurveKind:
    """What an edge of an axis is, in `Structure.seam`."""

    NONE: CurveKind  # 0
    """Inside a sheet."""
    SEAM: CurveKind  # 1
    """Sheets meet here."""
    RIM: CurveKind  # 2
    """A sheet ends here."""
    CREASE: CurveKind  # 3
    """A sheet ends here because it reaches a sharp convex edge of the solid."""

class PlaceKind:
    """What a vertex of an axis is, in `Structure.kind`."""

    SHEET: PlaceKind  # 0
    """Inside a sheet."""
    SEAM: PlaceKind  # 1
    """On a seam."""
    JUNCTION: PlaceKind  # 2
    """Three or more seams meet here."""
    RIM: PlaceKind  # 3
    """On a rim or a crease."""
    CORNER: PlaceKind  # 4
    """A seam reaches a crease here."""
    WIRE: PlaceKind  # 5
    """On no facet."""

@final
class Structure:
    """Sheets, seams, rims, junctions and corners of a medial axis, made by `structure`.

    A part is a sheet: facets that are connected across edges of two facets and lie between the same two patches of the
    surface. A curve is a seam, rim or crease between the same parts. A node is a junction or a corner. The numbers
    follow rules that do not know the samples: parts are in the order of their pairs of patches, curves in that of their
    kinds and parts, nodes in that of their kinds and curves. Where these agree the order is that of the middles: by x,
    by y where x differs by less than a spacing, and by z.
    """

    @property
    def part(self) -> NDArray[np.int32]:
        """(f,) int32: the part of each facet."""
    @property
    def turned(self) -> NDArray[np.bool_]:
        """(f,) bool: whether the facet must be turned to agree with its part."""
    @property
    def edges(self) -> NDArray[np.int32]:
        """(e, 2) int32: the edges of the facets, as `polygon_edges` returns them."""
    @property
    def seam(self) -> NDArray[np.int32]:
        """(e,) int32: `CurveKind` of each edge."""
    @property
    def curve(self) -> NDArray[np.int32]:
        """(e,) int32: the curve of each edge; -1 where there is none, or where it is shorter than 1.5 spacings."""
    @property
    def kind(self) -> NDArray[np.int32]:
        """(v,) int32: `PlaceKind` of each vertex. One vertex stands for each node."""
    @property
    def part_patches(self) -> NDArray[np.int32]:
        """(p, 2) int32: the patches between which each part lies, lower first; -1 where they are not known."""
    @property
    def part_area(self) -> NDArray[np.float64]:
        """(p,) float64."""
    @property
    def part_mean_radius(self) -> NDArray[np.float64]:
        """(p,) float64: mean over the area."""
    @property
    def part_least_radius(self) -> NDArray[np.float64]:
        """(p,) float64."""
    @property
    def curve_kind(self) -> NDArray[np.int32]:
        """(c,) int32: `CurveKind` of each curve."""
    @property
    def curve_length(self) -> NDArray[np.float64]:
        """(c,) float64."""
    @property
    def curve_mean_radius(self) -> NDArray[np.float64]:
        """(c,) float64: mean over the length."""
    @property
    def curve_least_radius(self) -> NDArray[np.float64]:
        """(c,) float64."""
    @property
    def curve_part_offsets(self) -> NDArray[np.int32]:
        """(c + 1,) int32: the parts at curve i are `curve_parts[curve_part_offsets[i] : curve_part_offsets[i + 1]]`."""
    @property
    def curve_parts(self) -> NDArray[np.int32]:
        """Parts, curve after curve, ascending and each once."""
    @property
    def node_kind(self) -> NDArray[np.int32]:
        """(n,) int32: `PlaceKind.JUNCTION` or `PlaceKind.CORNER`."""
    @property
    def node_vertex(self) -> NDArray[np.int32]:
        """(n,) int32: the vertex that stands for each node."""
    @property
    def node_curve_offsets(self) -> NDArray[np.int32]:
        """(n + 1,) int32: the curves at node i are `node_curves[node_curve_offsets[i] : node_curve_offsets[i + 1]]`."""
    @property
    def node_curves(self) -> NDArray[np.int32]:
        """Curves, node after node, ascending and each once."""

def structure(
    *,
    vertices: NDArray[np.float64],
    radius: NDArray[np.float64],
    face_offsets: NDArray[np.int32],
    face_vertices: NDArray[np.int32],
    generators: NDArray[np.int32],
    wires: NDArray[np.int32],
    patches: NDArray[np.int32],
    spacing: NDArray[np.float64],
    threads: int = 0,
) -> Structure:
    """Find the sheets, seams, rims, junctions and corners of a medial axis, such as a `Level`.

    Sheets smaller than two squared spacings go to the neighbour with the longest common edge. Curves shorter than 1.5
    spacings have no number. A rim is a crease where its sheet lies between two patches and its radii are below two
    spacings.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
        Counter-clockwise about the direction p -> q.
    generators : (f, 2) int32
        Rows p, q of the samples.
    wires : (w, 2) int32
        Edges without a facet.
    patches : (n, 2) int32
        The patches of each sample, as of `surface_patches`; (0, -1) where nothing is known of any.
    spacing : (n,) float64
        The distance of neighbours at each sample.
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError
    """

def surface_patches(
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    samples: tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]] | None = None,
    sharp_angle: float = ...,
    sharp_edges: NDArray[np.int32] | None = None,
    threads: int = 0,
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """The patches into which the sharp convex edges divide a surface. A patch goes on across reflex edges, and round
    the end of a crease.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        Rows of vertices, outward.
    samples : tuple, optional
        `points`, `kind` and `triangle` of `SurfaceSamples`; a triangle may be -1 where a sample closes an opening.
    sharp_angle, sharp_edges
        As in `sample_surface`. Edges of more than two triangles, and those that two triangles pass in the same
        direction, divide patches, too.
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    of_triangles : (m,) int32
        Patches are numbered in the order of their first triangles; -1: the triangle is repeated or has a corner twice.
    of_samples : (n, 2) int32
        Of each sample, or of each vertex without samples: its patch and -1; both patches, lower first, where two meet;
        twice -1 where more meet, and on no triangle. Samples that close openings have one more patch.

    Raises
    ------
    InvalidInputError
    """

def nearest(sites: NDArray[np.float64], queries: NDArray[np.float64]) -> NDArray[np.int32]:
    """(k,) int32: row of the site nearest to each of (k, 3) queries, of equally near ones the lowest; -1 where there
    are no sites.

    Raises
    ------
    InvalidInputError
    """

def closing_samples(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    radius: NDArray[np.float64],
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    seed: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Samples that close the openings of a surface: blue noise where the winding number is 1/2, off the triangles.

    They lie on the level set that begins at the boundary edges, within a millionth or two of 1/2, and as far from each
    other and from the samples that are there as those of `sample_surface`. None where the triangles are closed.

    Parameters
    ----------
    points : (n, 3) float64
        Samples of the surface, those that bound its solid.
    normals : (n, 3) float64
    radius : (n,) float64
        Of their discs; those of the openings are as large as the nearest of these, and grow by 0.3 of its distance.
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        Rows of `vertices`, outward.
    seed : int
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    points : (k, 3) float64
    normals : (k, 3) float64
        Outward, unit.
    radius : (k,) float64

    Raises
    ------
    InvalidInputError, Cancelled
    """

def memory_needed(points: int) -> int:
    """Bytes at the peak of an analysis of so many samples of a surface and an extraction, as measured. Facets that are
    long and thin, as on a torus of random points, take up to four times as many."""

def automatic_sides(bounded: bool, has_normals: bool) -> SidesFrom:
    """The source that `SidesFrom.AUTOMATIC` takes, by whether faces bound a solid and whether there are normals;
    instead of TIGHT_COCONE an analysis may take POLES."""

def open_edges(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> int:
    """`MedialAnalysis.boundary_edges` without the analysis: edges of the triangles that are not used equally often in
    both directions, rows with the same coordinates being one. 0: the surface is closed, or there is none.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
    """

def solid_betti(
    points: NDArray[np.float64], triangles: NDArray[np.int32]
) -> tuple[int, int, int] | None:
    """Pieces, loops and cavities of the solid whose boundary the triangles are, if they pass nowhere through
    themselves; None where they are no closed manifold, or a shell of them has no volume. Rows with the same
    coordinates are one. Shells that point outward are pieces, those that point inward cavities, every handle is a loop.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
    """

def are_single(points: NDArray[np.float64]) -> bool:
    """Whether coordinates were rounded to float32: all are such numbers, and some use the last bit that these have.

    Parameters
    ----------
    points : (n, 3) float64
    """

def rounding_of(points: NDArray[np.float64], far: float = 0.0) -> float:
    """How far apart places may be that were meant to be one: four roundings to float32, in which meshes are stored.

    Those of coordinates that were rounded grow with the distance from the origin. Others are known better, and it is
    the size of their box that counts, wherever that lies.

    Parameters
    ----------
    points : (n, 3) float64
    far : float
        The largest coordinate before the points were moved; 0.0 where they were not.
    """

def mesh_parts(
    points: NDArray[np.float64], triangles: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.bool_], NDArray[np.bool_]]:
    """The connected parts of faces: faces that share an edge are of one part. Rows with the same coordinates are one.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32

    Returns
    -------
    part : (m,) int32
        The part of each triangle, in the order of their first triangles; -1 for a triangle that repeats a corner.
    open : (k,) bool
        Whether a part has an edge through which its triangles do not run equally often in both directions.
    flat : (k,) bool
        Whether a part lies in a plane, up to `rounding_of` its corners.

    Raises
    ------
    InvalidInputError
        A corner is no row of the points, or a coordinate is not finite.
    """

def part_places(
    points: NDArray[np.float64], triangles: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.bool_], NDArray[np.uint8]]:
    """The connected parts of faces as `mesh_parts` finds them, and how they lie to each other.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32

    Returns
    -------
    part : (m,) int32
    open : (k,) bool
        As of `mesh_parts`.
    place : (k,) uint8
        0 for a part that meets no other one, 1 for one that touches others and shares no volume with them, 2 for one
        that lies inside another part, 3 for one that shares a part of its volume with others, and 4 for a sheet without
        thickness, which meets nothing. Parts touch where they are within the rounding of their corners to float32.

    Raises
    ------
    InvalidInputError
        A corner is no row of the points, or a coordinate is not finite.
    """

def even_sheet(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    length: float,
    *,
    progress: Progress | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]] | None:
    """A sheet of nearly equilateral triangles, by CGAL's isotropic remeshing (Botsch & Kobbelt 2004).

    New vertices lie on the given triangles. Border edges, and edges at which the sheet turns by more than 45 degrees,
    stay as they are.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
        Each turns as its neighbours do.
    length : float
        Of the edges that are wanted, in the unit of the points. No edge that stays may be longer than 4/3 of it.
    progress : Progress, optional

    Returns
    -------
    points : (k, 3) float64
    given : (k,) int32
        The row of the given point that each is; -1 for new ones.
    triangles : (l, 3) int32
        None instead of all three if an edge has more than two triangles, or its two triangles turn opposite ways.

    Raises
    ------
    InvalidInputError
        Rows are out of range, or the length is not positive.
    Cancelled
    """

def wrap(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    opening: float,
    distance: float,
    *,
    progress: Progress | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """A closed surface round faces that may bound nothing, by CGAL's alpha wrapping.

    It is as if a ball as wide as the openings rolled over the faces and stopped at a distance from them (Portaneri,
    Rouxel-Labbe, Hemmer, Cohen-Steiner & Alliez 2022).

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
    opening : float
        The width of the openings that are closed, as a share of the diagonal of the bounding box of the faces.
    distance : float
        How far outside of the faces the surface lies, as such a share.
    progress : Progress, optional

    Returns
    -------
    points : (k, 3) float64
    triangles : (l, 3) int32
        Closed, without self-intersections, outward.

    Raises
    ------
    InvalidInputError
        No face has an area, or the module was compiled with a CGAL older than 5.5.
    Cancelled
    """

def outward_faces(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> tuple[NDArray[np.int32], NDArray[np.uint8], int, int]:
    """Faces as those of a solid: whichever way they were drawn, they look outward.

    Faces that are closed, consistent and outward are returned as they are. Otherwise faces are made consistent where
    two meet at an edge, and each of these patches is turned such that it looks to the side from which more rays escape
    (Takayama, Jacobson, Kavan & Sorkine-Hornung 2014); an open patch whose faces agree only if nearly all rays say so.
    Patches for which rays do not decide keep the side of most of
    their faces, or are turned where most of the others are; where their own faces differ, they look to where rays meet
    an even number of faces. One of several equal faces stays, or none of an even number where this leaves fewer edges
    open; no reading leaves more edges open than the faces as they were given. Rows with the same coordinates are one.
    The result does not depend on the threads.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
    progress : Progress, optional
    threads : int, optional
        0 means all.

    Returns
    -------
    triangles : (m, 3) int32
        Faces that repeat another one have three times the same row, those that repeat a corner are as given; both count
        for nothing in every stage.
    reading : (m,) uint8
        0 as given, 1 turned, 2 left out because it repeats another face, 3 left out because it repeats a corner.
    patches : int
        The number of patches.
    unseen : int
        The number of patches for which rays do not decide.

    Raises
    ------
    InvalidInputError
        A corner is not below n, or a coordinate is not finite.
    """

def polygon_edges(
    face_offsets: NDArray[np.int32], face_vertices: NDArray[np.int32], vertices: int
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """The edges of polygons that share vertices, as of a `MedialMesh`.

    Parameters
    ----------
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    vertices : int
        Number of vertices; every corner is below it.

    Returns
    -------
    edges : (e, 2) int32
        Lower vertex first, in lexicographic order.
    corner_edges : (c,) int32
        The row of the edge from each corner to the next one of its polygon.

    Raises
    ------
    InvalidInputError
    """

def polygon_areas(
    points: NDArray[np.float64], face_offsets: NDArray[np.int32], face_vertices: NDArray[np.int32]
) -> NDArray[np.float64]:
    """The normals of polygons, as long as their areas are large.

    Parameters
    ----------
    points : (n, 3) float64
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
        Rows of `points`.

    Returns
    -------
    doubled : (f, 3) float64
        The sum over the triangles between the first corner and each side, twice as long as the area.

    Raises
    ------
    InvalidInputError
    """

def polygon_triangles(
    points: NDArray[np.float64], face_offsets: NDArray[np.int32], face_vertices: NDArray[np.int32]
) -> NDArray[np.int32]:
    """Polygons as triangles, without new vertices.

    Parameters
    ----------
    points : (n, 3) float64
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
        Rows of `points`, three at least for each polygon.

    Returns
    -------
    triangles : (c - 2 f, 3) int32
        Polygon after polygon, each with its boundary and turning as it does. Quads are cut from the first corner to the
        third, where they are convex there; larger ones by their constrained Delaunay triangulation.

    Raises
    ------
    InvalidInputError
    """

def crossing_faces(
    points: NDArray[np.float64], triangles: NDArray[np.int32], *, most: int = 20_000_000
) -> NDArray[np.int32]:
    """Pairs of triangles that pass through each other, decided exactly.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
    most : int
        It ends early when it has compared so many pairs whose boxes meet.

    Returns
    -------
    pairs : (k, 2) int32
        Rows of triangles of which one has a side that passes through the inside of the other one, the lower first, in
        ascending order. Triangles that only touch do not count, nor those in one plane.

    Raises
    ------
    InvalidInputError
    """

def winding_number(
    queries: NDArray[np.float64], vertices: NDArray[np.float64], triangles: NDArray[np.int32]
) -> NDArray[np.float64]:
    """Generalized winding number (Jacobson et al. 2013) of a triangle soup at each query: 1 inside an outward one.

    Parameters
    ----------
    queries : (q, 3) float64
    vertices : (v, 3) float64
    triangles : (m, 3) int32

    Returns
    -------
    winding : (q,) float64
        Sum of the solid angles over 4 pi, up to rounding.
    """

def surface_places(
    queries: NDArray[np.float64],
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """(q,) int32 and (q, 3) float64: the nearest triangle to each query, and its place there, as weights of corners.

    Parameters
    ----------
    queries : (q, 3) float64
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        One at least; they may be without area. Of several that are as near the first one counts.

    Raises
    ------
    InvalidInputError
    """

def smooth_line(places: NDArray[np.float64], widths: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) float64: the line with the least sum of squares of deviations and of weighted fourth differences.

    Parameters
    ----------
    places : (n, 3) float64
        In even steps.
    widths : (n,) float64
        Waves of 2 pi times so many steps lose half their height; the first two and the last two do not matter.

    Raises
    ------
    InvalidInputError
    """

def reduce_sphere_mesh(
    vertices: NDArray[np.float64],
    radius: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    wanted: int,
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]]:
    """The same solid with fewer spheres: `(vertices, radius, triangles, edges)`.

    Edges collapse as long as the homotopy type stays, those first that change the surface of the solid least; then the
    spheres are fitted to that surface. Where no more edge can collapse, more spheres stay than wanted.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
    triangles : (t, 3) int32
    edges : (w, 2) int32
        Those without a triangle; others are passed over.
    wanted : int
        Number of spheres.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def reduce_sheets(
    vertices: NDArray[np.float64],
    radius: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    part: NDArray[np.int32],
    nodes: NDArray[np.int32],
    wanted: int,
    *,
    shortest: float = 0.0,
    progress: Progress | None = None,
    threads: int = 0,
) -> (
    tuple[
        NDArray[np.float64],
        NDArray[np.float64],
        NDArray[np.int32],
        NDArray[np.int32],
        NDArray[np.int32],
        NDArray[np.int32],
        NDArray[np.int32],
    ]
    | None
):
    """The same sheets with fewer spheres: `(vertices, radius, row, face_offsets, face_vertices, part, edges)`.

    Nodes stay. Spheres on the border of a sheet merge along it, those of radius 0 to where one of them was; spheres
    inside a sheet merge as in `reduce_sphere_mesh`, without a fit. What is straight or flat keeps no
    sphere that changes nothing, however many are wanted. Triangles of a sheet in one plane become polygons, each with
    one border; a flat sheet with a hole is two of them or more. The homotopy type stays, and each sheet keeps a
    triangle. None if fewer spheres are wanted than there are nodes and bent borders: `reduce_sphere_mesh` makes a
    better solid of so few.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
    triangles : (t, 3) int32
    edges : (w, 2) int32
        Those without a triangle; others are passed over.
    part : (t,) int32
        The sheet of each triangle.
    nodes : (n,) int32
        Rows of vertices.
    wanted : int
        Number of spheres.
    shortest : float
        Borders of sheets have no shorter edges, if that can be.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    vertices : (w, 3) float64
    radius : (w,) float64
    row : (w,) int32
        The row of the given sphere that it is; -1 where it was moved.
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    part : (f,) int32
        The sheet of each polygon, ascending.
    edges : (e, 2) int32
        Those on no polygon.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def solid_distances(
    queries: NDArray[np.float64],
    vertices: NDArray[np.float64],
    radius: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> NDArray[np.float64]:
    """(q,) float64: signed distance of each query to the balls, cones and slabs of a sphere mesh, negative inside.

    Outside it is that to the solid; inside the surface is at least as far away.

    Parameters
    ----------
    queries : (q, 3) float64
    vertices : (v, 3) float64
    radius : (v,) float64
    triangles : (t, 3) int32
    edges : (w, 2) int32
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def solid_surface(
    vertices: NDArray[np.float64],
    radius: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    spacing: float,
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> NDArray[np.float64]:
    """(k, 3) float64: points on the surface of the solid of a sphere mesh, about `spacing` apart or closer.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
    triangles : (t, 3) int32
    edges : (w, 2) int32
    spacing : float
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def buried(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    offset: float,
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> NDArray[np.bool_]:
    """Where triangles are no boundary of the solid: overlapping shells, walls inside, sheets without thickness.

    The solid is where their winding number is above 1/2, be they closed or open.

    Parameters
    ----------
    points : (n, 3) float64
        On the surface.
    normals : (n, 3) float64
        Of the surface there.
    offset : float
        How far to step off it, times the length of the normals; positive.
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        Rows of `vertices`; rows with the same coordinates are one vertex.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    buried : (n,) bool
        The winding number is above 1/2 at both of points +- offset * normals, or at neither. False for a zero normal.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def wall_distances(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    reach: NDArray[np.float64],
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> NDArray[np.float64]:
    """How thick a solid is behind points of its surface.

    Parameters
    ----------
    points : (n, 3) float64
        On the surface.
    normals : (n, 3) float64
        Of the surface there: unit, outward.
    reach : (n,) float64
        How far one looks from each; positive.
    vertices : (v, 3) float64
    triangles : (m, 3) int32
        Rows of `vertices`, outward.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    distances : (n,) float64
        The way against the normal to where the solid ends, at a triangle that faces away from the point within 30
        degrees. Infinite: beyond reach, or the way ends at a slant, as beside a sharp edge; and for a zero normal.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def measure_scan(
    points: NDArray[np.float64], *, progress: Progress | None = None, threads: int = 0
) -> ScanMeasure:
    """Measure noise, duplicates, outliers and borders of points without faces.

    Quadrics are fitted to neighbourhoods of growing size. Curvature makes the residuals grow all along, noise makes a
    plateau.

    Parameters
    ----------
    points : (n, 3) float64
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def surface_noise(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> SurfaceNoise:
    """Measure the noise of the vertices of faces, as `measure_scan` does of points.

    Only neighbours whose normals look the same way are compared, so the walls of thin parts are no noise.

    Parameters
    ----------
    points : (n, 3) float64
    normals : (n, 3) float64
        Outward, of any length; those in one place are added, and vertices without any are left out.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def smooth_vertices(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    measure: SurfaceNoise,
    *,
    progress: Progress | None = None,
    threads: int = 0,
) -> NDArray[np.float64]:
    """Move the vertices of faces onto smooth surfaces through their neighbours.

    Each goes onto the quadric of the neighbours that look the same way, within the radius of the measure. Those without
    a normal or with few neighbours stay, and those that would move by many times the noise.

    Parameters
    ----------
    points : (n, 3) float64
    normals : (n, 3) float64
    measure : SurfaceNoise
        What `surface_noise` says of these points.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    (n, 3) float64

    Raises
    ------
    InvalidInputError, Cancelled
    """

def prepare_scan(
    points: NDArray[np.float64],
    measure: ScanMeasure,
    *,
    move: bool = True,
    progress: Progress | None = None,
    threads: int = 0,
) -> PreparedScan:
    """Leave the outliers of a scan out, move its points onto smooth surfaces, and thin them to the rest of the noise.

    Each point is moved onto the quadric of the largest neighbourhood with which all smaller ones agree.

    Parameters
    ----------
    points : (n, 3) float64
    measure : ScanMeasure
        Of the same points.
    move : bool
        False: no point is moved or thinned, and only outliers are left out.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    """

def cover_by_balls(
    centres: NDArray[np.float64],
    radii: NDArray[np.float64],
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    count: int = 64,
    mode: CoverMode = ...,
    places: int = 100_000,
    refine: bool = True,
    tolerance: float = 0.0,
    progress: Progress | None = None,
    threads: int = 0,
) -> BallCover:
    """A solid as few balls, chosen among those of its inner axis.

    The solid is where the winding number of its faces exceeds 1/2, and a volume the number of places of a cubic
    lattice in it. A refined choice bounds how far the surface is from the balls, INSIDE with nine tenths of them and
    AROUND with all, fills the rest by volume, and exchanges balls for those that hold more within that bound.

    A choice that is not refined is greedy. INSIDE, each ball is the one that holds most of what those before it left,
    of equal ones the first: the first n hold at least 1 - 1/e of the places that any n of the candidates hold. AROUND,
    it is one that comes near to the place farthest from those before it. In the end, each ball AROUND grows until it
    holds what is nearest to it.

    Parameters
    ----------
    centres : (m, 3) float64
    radii : (m,) float64
        Of the balls to choose from.
    vertices : (v, 3) float64
    triangles : (f, 3) int32
        The surface of the solid: outward, rows of `vertices`.
    count : int
        Balls at most.
    mode : CoverMode
    places : int
        Of the lattice in the solid; at least half as many, where a lattice of 16 million places in the box of the solid
        has them, a million where the surface is open.
    refine : bool
        More than 1024 balls are chosen greedily.
    tolerance : float
        INSIDE, a ball may grow to reach out so far, if that is needed to hold what is nearest to it.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    DegenerateInputError
        The faces enclose no place, or none of the balls holds one.
    """

def cover_by_capsules(
    ends: NDArray[np.float64],
    segments: NDArray[np.int32],
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    count: int = 64,
    mode: CoverMode = ...,
    tapered: bool = True,
    places: int = 100_000,
    tolerance: float = 0.0,
    radii: NDArray[np.float64] | None = None,
    progress: Progress | None = None,
    threads: int = 0,
) -> CapsuleCover:
    """A solid as few capsules round segments, such as the edges of a small medial mesh.

    INSIDE, each is the largest capsule that was found round its segment and stays in the solid, or a ball round one end
    if that is larger. AROUND, each, or that of the given radii, then grows or shrinks until it just holds what is
    nearest to it.

    Parameters
    ----------
    ends : (m, 3) float64
    segments : (s, 2) int32
        Rows of `ends`; both may be the same.
    vertices : (v, 3) float64
    triangles : (f, 3) int32
        The surface of the solid: outward, rows of `vertices`.
    count : int
        The capsules of the largest volume, at most so many.
    mode : CoverMode
    tapered : bool
        Whether radii may differ at both ends of a capsule.
    places : int
        Of the lattice in the solid, as for `cover_by_balls`.
    tolerance : float
        INSIDE, a capsule may grow to reach out so far, if that is needed to hold what is nearest to it.
    radii : (2 s,) float64, optional
        AROUND, those of the capsules to begin with, at both ends of each segment; then none of them need lie in the
        solid, and all are kept.
    progress : Progress, optional
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    InvalidInputError, Cancelled
    DegenerateInputError
        The faces enclose no place, or no end lies in the solid.
    """

def least_capsules(
    places: NDArray[np.float64],
    group: NDArray[np.int32],
    *,
    count: int,
    tapered: bool = False,
    threads: int = 0,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Capsules of nearly the least volume that hold groups of places.

    Parameters
    ----------
    places : (n, 3) float64
    group : (n,) int32
        The group of each place, below `count`.
    count : int
    tapered : bool
        Whether radii may differ at both ends of a capsule.
    threads : int
        0: as many as the machine has. The result does not depend on it.

    Returns
    -------
    ends : (2 count, 3) float64
    radii : (2 count,) float64
        The rows 2k and 2k + 1 are the ends of the capsule of group k. Those of an empty group have the radius 0.

    Raises
    ------
    InvalidInputError
    """
