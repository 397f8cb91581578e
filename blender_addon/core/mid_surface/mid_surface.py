# SPDX-License-Identifier: GPL-3.0-or-later
"""The middle surface of a thin solid: one sheet per wall, with its thickness (docs/mid_surface.md).

The sheets of the medial axis between walls that face each other are chosen (`thin_sheets.py`), carried on to where
they meet and to the walls at their rims (`carried_sheets.py`), and cleared of what they do not need.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..axis.compute import Computation, compute_axis
from ..axis.polygon_triangles import polygon_triangles
from ..errors import InvalidInputError
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.native import own_errors
from ..machine.progress import Progress
from ..samples.chosen import ChosenSamples, OfChosenSamples
from ..samples.density import percent
from ..samples.sample_spacing import mean_spacing
from ..settings import Form, Mesh, MidSurfaceSettings, Settings, Side, ThicknessSettings
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from ..shape.solid_faces import SolidFaces, sharp_angle_of
from ..shape.triangles import FEW, euler_characteristic, sides_of, unit_normals
from ..small_matrices import dot, length_of, summed
from ..thickness.face_lengths import are_enough
from ..united import united
from .carried_sheets import CarriedSheets, are_curved, carried
from .cut_out_plates import cut_out_plate
from .even_quads import even_quads
from .even_triangles import even_triangles
from .few_faces import few_faces
from .sheet_faces import SheetFaces
from .sheet_walls import Walls
from .thick_faces import ThickFaces, thick_faces
from .thick_joints import joined_by_thick_parts
from .thin_sheets import ThinSheets, thin_sheets

_SAME = 1e-7  # of the diagonal: vertices so close are one; derived: a float's rounding
_PER_AREA = 2.0 / 3.0**0.5  # vertices for an area of one squared edge; derived: 2 / sqrt(3)
_CURVED = 1.5  # mean thicknesses: the least edge of curved sheets with no size; chosen: midsurface
_MOST_FACES = 2_000_000  # more than that are refused before they are made
_MOST = 1.0 - FEW  # where less of the volume is sheet, a warning says so; derived: FEW
_DOUBLED = 1.05  # where they have more than this of it, one does, too; chosen: midsurface


@dataclass(frozen=True, eq=False)
class MidSurface(OfChosenSamples):
    """Sheets with thickness; those that meet share edges."""

    vertices: Floats  # (v, 3) In the frame of the shape
    face_offsets: Ints  # (f + 1,)
    # (c,) Face i has the corners `face_vertices[face_offsets[i]:face_offsets[i + 1]]`. All faces of a sheet turn the
    # same way.
    face_vertices: Ints
    part: Ints  # (f,) The sheet of each face, 0 to `sheets` - 1
    thickness: Floats  # (f,) Of the wall at the middle of each face
    # (v,) Of the wall at each vertex; where sheets meet, the thickness of the thickest
    of_vertices: Floats
    sheets: int
    # The volume of the sheets, area times thickness, as a share of that of the solid. Where walls meet, both count.
    share: float
    # Where it was asked for, the faces of the solid that no sheet stands for
    thick: ThickFaces | None
    shape: Shape
    chosen: ChosenSamples
    warnings: tuple[str, ...]
    seconds: float

    @property
    def triangles(self) -> Ints:
        """(c - 2 f, 3) the triangles of face after face."""
        return polygon_triangles(self.vertices, self.face_offsets, self.face_vertices)

    @property
    def face_of_triangles(self) -> Longs:
        return np.repeat(np.arange(len(self.part)), np.diff(self.face_offsets) - 2)


def mid_surface(
    shape: Shape,
    settings: Settings,
    wanted: MidSurfaceSettings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> MidSurface:
    """Turn a thin solid into sheets with thickness.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        Its options of sampling count; the form is always clean, with crisp places, of the inside.
    wanted : MidSurfaceSettings
    progress : Progress, optional
    limit : MemoryLimit

    Raises
    ------
    InvalidInputError
        The shape has no faces, or no thin walls.
    NativeModuleError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    if not len(shape.triangles):
        raise InvalidInputError(
            "Expected faces that bound a solid, found points alone; reconstruct a surface first"
        )
    shape = outward_shape(shape)
    # A sheet lies in the middle of its walls whatever the spacing, so no hole need be smaller than half of a wall,
    # the feature size there.
    settings = replace(
        settings,
        epsilon=1.0,
        form=Form.CLEAN,
        mesh=Mesh.VORONOI,
        crisp=True,
        side=Side.INNER,
        simplify=0.0,
        erode=0.0,
        spike=0.0,
    )
    # Its rims go out to the walls, so smoothing them first would only take them off their places.
    found = compute_axis(shape, settings, progress, limit, relaxed=False)
    if found.axis.structure is None or not found.axis.facets:
        raise _nothing_thin(wanted)
    thin = thin_sheets(found.axis, found.chosen.samples.patches, wanted.least_width)
    if not len(thin.triangles):
        raise _nothing_thin(wanted)
    sheets = _welded(carried(thin, _walls(shape, found.chosen.samples.solid, settings)))
    plate = cut_out_plate(shape, sheets)
    if plate is not None and are_enough(shape, settings, ThicknessSettings()):
        sheets = _welded(plate)
        thin = replace(thin, parts=int(sheets.part.max()) + 1)
    made = _simplified(sheets, wanted, progress)
    return _with_thickness(made, sheets, thin, shape, found, wanted.keep_thick, start)


def _nothing_thin(wanted: MidSurfaceSettings) -> InvalidInputError:
    return InvalidInputError(
        f"Expected walls at least {wanted.least_width:g} times as wide as they are thick, found none; lower Least "
        "Width, or keep the solid"
    )


def _walls(shape: Shape, solid: SolidFaces | None, settings: Settings) -> Walls:
    """The faces, with the edges that are sharp for the axis."""
    with own_errors() as module:
        edges, convex, _ = module.BallFaces(
            shape.points,
            shape.triangles,
            sharp_angle=solid.options(settings)[0] if solid else sharp_angle_of(shape, settings),
            sharp_edges=shape.sharp_edges,
        ).creases()
    return Walls(shape.points, shape.triangles, edges[~convex])


def _welded(sheets: CarriedSheets) -> CarriedSheets:
    """The sheets with one vertex at each place, without triangles that have no area, and with no other vertices."""
    step = _SAME * length_of(np.ptp(sheets.vertices, axis=0))
    ends, edge, _ = sides_of(sheets.triangles)
    along = sheets.vertices[ends[:, 0]] - sheets.vertices[ends[:, 1]]
    short = ends[np.linalg.norm(along, axis=1) < step]
    row = united(len(sheets.vertices), short)
    pinches = _pinches(edge, ends, row)
    row = united(len(sheets.vertices), short[~pinches[row[short[:, 0]]]])
    triangles = row[sheets.triangles]
    kept = (triangles != np.roll(triangles, -1, axis=1)).all(axis=1)
    used, triangles = np.unique(triangles[kept], return_inverse=True)
    return CarriedSheets(
        sheets.vertices[used],
        triangles.reshape(-1, 3).astype(np.int32),
        sheets.part[kept],
        sheets.at_corners[kept],
    )


def _pinches(edge: Longs, ends: Longs, row: Longs) -> Flags:
    """(v,) the rows whose vertices, united, would lay edges on each other between which no triangle vanishes."""
    count = len(row)
    lasts = row[ends[:, 0]] != row[ends[:, 1]]
    vanish = lasts[edge].sum(axis=1) == 2
    of = united(len(ends), edge[vanish][lasts[edge[vanish]]].reshape(-1, 2))
    first = np.flatnonzero(lasts & (of == np.arange(len(ends))))  # one edge of each such set
    pairs = np.sort(row[ends[first]], axis=1)
    _, which, uses = np.unique(
        pairs[:, 0] * count + pairs[:, 1], return_inverse=True, return_counts=True
    )
    found = np.zeros(count, bool)
    found[pairs[uses[which] > 1]] = True
    return found


def _simplified(
    sheets: CarriedSheets, asked: MidSurfaceSettings, progress: Progress | None
) -> SheetFaces:
    """The sheets with the faces that show their shape, or with even ones of a size."""
    size = asked.size
    wanted = len(sheets.vertices)
    normals, doubled = unit_normals(sheets.vertices[sheets.triangles])
    area = 0.5 * float(doubled.sum())
    if size > 0.0:
        _check_size(size, area, asked.quads)
    thickness = np.average(sheets.at_corners.mean(axis=1), weights=doubled + np.finfo(float).tiny)
    length = size if size > 0.0 else _CURVED * float(thickness)
    parts = int(sheets.part.max()) + 1
    if size > 0.0 or are_curved(normals * doubled[:, None], sheets.part, parts).any():
        wanted = min(wanted, int(_PER_AREA * area / length**2) + 1)
    faces = few_faces(sheets, wanted, progress, size / 3.0)  # shorter edges make slivers
    if size <= 0.0:
        return faces
    if asked.quads:
        return even_quads(faces, size, progress and progress.part())
    vertices, triangles, part = even_triangles(
        faces.vertices, faces.triangles, faces.part[faces.of], size, progress and progress.part()
    )
    offsets = np.arange(0, triangles.size + 1, 3, dtype=np.int32)
    return SheetFaces(vertices, offsets, triangles.ravel(), part)


def _check_size(size: float, area: float, quads: bool) -> None:
    """Raise InvalidInputError where a size makes more faces than anyone can use."""
    each = 1.0 if quads else 2.0 * _PER_AREA
    number = each * (area / size) / size  # not the square of the size, which may be 0
    if number > _MOST_FACES:
        least = (each * area / _MOST_FACES) ** 0.5
        raise InvalidInputError(
            f"Expected a Size that makes at most {_MOST_FACES:,} faces, found {size:.3g}, which makes about "
            f"{number:.3g}; choose {least:.3g} or more"
        )


def _with_thickness(
    made: SheetFaces,
    sheets: CarriedSheets,
    thin: ThinSheets,
    shape: Shape,
    found: Computation,
    keep_thick: bool,
    start: float,
) -> MidSurface:
    lengths = _lengths(sheets, thin.parts)
    made = _with_volume(made, lengths(_centres(made)[0], made.part))
    centre, whole = _centres(made)
    triangles, thickness = made.triangles, lengths(centre, made.part)
    corner_part = np.repeat(made.part, np.diff(made.offsets))
    of_vertices = np.zeros(len(made.vertices))
    np.maximum.at(of_vertices, made.corners, lengths(made.vertices[made.corners], corner_part))
    share = float((whole * thickness).sum()) / shape.volume if shape.volume > 0.0 else float("nan")
    spacing = mean_spacing(shape.area, len(found.chosen.samples.points))
    left_out = _left_out(share, float(thickness.min()), spacing)
    numbers, part = np.unique(made.part, return_inverse=True)
    return MidSurface(
        made.vertices,
        made.offsets,
        made.corners,
        part.reshape(-1).astype(np.int32),
        thickness,
        of_vertices,
        len(numbers),
        share,
        thick_faces(shape, made, lengths) if keep_thick else None,
        shape,
        found.chosen,
        (
            *found.warnings,
            *left_out,
            *_torn(triangles, found, thin),
            *_outside(made.vertices, float(thickness.max()), shape),
        ),
        time.perf_counter() - start,
    )


def _centres(made: SheetFaces) -> tuple[Floats, Floats]:
    """(f, 3) the middle of each face, and (f,) its area."""
    count, triangles = len(made.part), made.triangles
    areas = 0.5 * unit_normals(made.vertices[triangles])[1]
    whole = np.asarray(np.bincount(made.of, areas, count), np.float64)
    middles = made.vertices[triangles].mean(axis=1) * areas[:, None]
    return summed(made.of, middles, count) / np.where(whole > 0.0, whole, 1.0)[:, None], whole


def _with_volume(made: SheetFaces, thickness: Floats) -> SheetFaces:
    """The faces without sheets that have no thickness anywhere: crumbs of rims that lie in the surface of the solid."""
    thick = np.zeros(int(made.part.max()) + 1, bool)
    thick[made.part[thickness > 0.0]] = True
    kept = thick[made.part]
    if kept.all() or not kept.any():
        return made
    sizes = np.diff(made.offsets)
    used, corners = np.unique(made.corners[np.repeat(kept, sizes)], return_inverse=True)
    offsets = np.concatenate(([0], np.cumsum(sizes[kept]))).astype(np.int32)
    return SheetFaces(
        made.vertices[used], offsets, corners.reshape(-1).astype(np.int32), made.part[kept]
    )


def _left_out(share: float, least: float, spacing: float) -> tuple[str, ...]:
    """A sentence where area times thickness is not the volume."""
    if share > _DOUBLED:
        return (
            f"the sheets have {percent(share)} of the volume: where walls meet, both count, but some may also lie "
            "twice or not in the middle; more samples may help",
        )
    if share >= _MOST:
        return ()
    tips = (
        f", as Least Width decides, and so are tips that are narrower than samples are apart, {spacing:.2g}; more "
        "samples reach farther into these"
    )
    if least >= spacing:
        tips = ", and Least Width decides what counts as thin"
    return (f"the sheets have {percent(share)} of the volume; what is not thin is left out{tips}",)


def _torn(triangles: Ints, found: Computation, thin: ThinSheets) -> tuple[str, ...]:
    pieces, level = _pieces(triangles), found.axis.level
    if level is None or pieces <= level.betti[0]:
        if euler_characteristic(triangles) == euler_characteristic(thin.triangles):
            return ()
        return (
            "the sheets have other loops than the medial axis between the same walls: somewhere they lie over each "
            "other or are torn; more samples may help",
        )
    if pieces - joined_by_thick_parts(found.axis, thin) <= level.betti[0]:
        return (
            f"the sheets have {pieces:,} pieces and the solid {level.betti[0]:,}: what joins them is not thin, and is "
            "left out",
        )
    return (
        f"the sheets have {pieces:,} pieces and the solid {level.betti[0]:,}: sheets that should meet do not; more "
        "samples may help",
    )


def _outside(vertices: Floats, thickest: float, shape: Shape) -> tuple[str, ...]:
    """A sentence where a vertex is outside the solid, farther than the thickest wall round it reaches."""
    faces = shape.points, shape.triangles
    with own_errors() as module:
        away = np.asarray(module.TriangleTree(*faces).distances(vertices))
        far = np.flatnonzero(away > 0.5 * thickest)
        winding = np.asarray(module.winding_number(vertices[far], *faces))
    out = far[winding < 0.5]
    if not len(out):
        return ()
    place = ", ".join(f"{value:.3g}" for value in vertices[out[away[out].argmax()]])
    return (
        f"the sheets leave the solid by up to {away[out].max():.2g}, most of all at ({place}); more samples may help",
    )


def _pieces(triangles: Ints) -> int:
    label = united(int(triangles.max()) + 1, np.concatenate((triangles[:, :2], triangles[:, 1:])))
    return len(np.unique(label[triangles[:, 0]]))


def _lengths(sheets: CarriedSheets, parts: int) -> Callable[[Floats, Ints], Floats]:
    """The function of places and their sheets that returns the thickness at the nearest place of the sheet."""

    def lengths(queries: Floats, of: Ints) -> Floats:
        found = np.zeros(len(queries))
        for number in range(parts):
            rows, own = np.flatnonzero(of == number), np.flatnonzero(sheets.part == number)
            if not len(rows):
                continue
            asked, triangles = queries[rows], sheets.triangles[own]
            with own_errors() as module:
                nearest, weights = module.surface_places(asked, sheets.vertices, triangles)
            found[rows] = dot(sheets.at_corners[own[nearest]], weights)
        return found

    return lengths
