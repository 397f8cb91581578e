# SPDX-License-Identifier: GPL-3.0-or-later
# ruff: noqa: F401 - the names of __all__ are imported for the users of the package.
"""The front door for Python programs: arrays in, a medial axis out (docs/libraries.md).

    import medial_axis
    found = medial_axis.compute(points, triangles, side="inner")
    medial_axis.write(found.axis, "shape.ply")

No Blender is needed. What a click in Blender computes, this computes, byte for byte.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import __all__ as __all__
from .core.arrays import Floats, Ints
from .core.axis import compute as axis
from .core.axis import each_part
from .core.axis.compute import Computation
from .core.axis.each_part import EachPart
from .core.axis.medial_axis import MedialAxis
from .core.cover import ball_cover
from .core.cover.ball_cover import BallCover, Balls
from .core.cover.write_balls import export_balls
from .core.errors import (
    Cancelled,
    DegenerateInputError,
    ExportError,
    InvalidInputError,
    MedialAxisError,
    NativeModuleError,
    OutOfMemoryError,
    ReadError,
)
from .core.files.load_axis import load_axis
from .core.files.read_ma import read_ma
from .core.files.read_shape import read_shape
from .core.files.write import export_axis
from .core.machine.progress import Progress
from .core.options import Choice, Switch
from .core.rebuild import reconstruction
from .core.rebuild.reconstruction import Reconstruction
from .core.rebuild.reduce import reduce_axis
from .core.settings import (
    ANALYSED,
    BALL_OPTIONS,
    OPTIONS,
    BallSettings,
    CoverMode,
    CoverShapes,
    Criteria,
    Form,
    Rule,
    SamplingMode,
    Settings,
    Side,
    SidesFrom,
)
from .core.shape.own_frame import in_own_frame, own_origin
from .core.shape.shape import Shape

# These options select facets of an existing analysis.
_THRESHOLDS = [name for name in OPTIONS if name not in ANALYSED]


def compute(
    points: ArrayLike,
    triangles: ArrayLike | None = None,
    normals: ArrayLike | None = None,
    *,
    progress: Progress | None = None,
    **settings: Any,
) -> Computation:
    """Return the medial axis of a surface or of a cloud of points.

    Parameters
    ----------
    points : (n, 3) floats
        Vertices of the surface, or points on it. In any unit.
    triangles : (m, 3) integers, optional
        Faces, rows of `points`, counter-clockwise as seen from outside.
    normals : (n, 3) floats, optional
        Outward normals of the points, of any length; a zero normal is ignored.
    progress : Progress, optional
        To watch the computation from another thread, or to cancel it from there.
    **settings
        Fields of `Settings`, where their defaults and units stand. A choice is a member, such as
        `Side.OUTER`, or its name, "outer".

    Returns
    -------
    computation : Computation
        `axis` is the medial axis; `warnings` are sentences that a person should read.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    wanted = Settings(**_checked(settings, list(OPTIONS)))
    shape, origin = _shape(points, triangles, normals)
    return axis.compute_axis(shape, wanted, _progress(progress)).moved(origin)


def compute_each_part(
    points: ArrayLike,
    triangles: ArrayLike,
    normals: ArrayLike | None = None,
    *,
    progress: Progress | None = None,
    **settings: Any,
) -> EachPart:
    """Return the medial axis of each connected part of a mesh, as if the others were not there.

    Parameters
    ----------
    points, triangles, normals, progress, **settings
        As of `compute`.

    Returns
    -------
    each : EachPart
        `computations` of the parts, their `numbers`, and `warnings` about sheets without thickness, which are left
        out.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    wanted = Settings(**_checked(settings, list(OPTIONS)))
    shape, origin = _shape(points, triangles, normals)
    each = each_part.compute_each_part(shape, wanted, _progress(progress))
    return replace(each, computations=tuple(one.moved(origin) for one in each.computations))


def extract(computation: Computation, **thresholds: Any) -> MedialAxis:
    """Return the axis for other thresholds, of the analysis that was computed: milliseconds.

    Parameters
    ----------
    computation : Computation
    **thresholds
        `form`, `simplify`, `erode`, `spike`, `limb`, `detail`, `crisp`, `mesh`, `theta`, `rho`, `rule`,
        `criteria` and `limit_set` of `Settings`; what is not given stays as it was. Forms are quick, too, once the
        hierarchy was computed for `crisp`, `theta`, `rho`, `rule` and `criteria`.

    Raises
    ------
    InvalidInputError
    """
    _check_kind(computation, "computation", Computation)
    settings = replace(computation.settings, **_checked(thresholds, _THRESHOLDS))
    return axis.extract_axis(computation, settings)


def cover_by_balls(
    points: ArrayLike,
    triangles: ArrayLike | None = None,
    normals: ArrayLike | None = None,
    *,
    count: int = BALL_OPTIONS["count"].default,
    mode: CoverMode | str = BALL_OPTIONS["mode"].default,
    shapes: CoverShapes | str = BALL_OPTIONS["shapes"].default,
    tolerance: float = BALL_OPTIONS["tolerance"].default,
    refine: bool = BALL_OPTIONS["refine"].default,
    progress: Progress | None = None,
    **settings: Any,
) -> BallCover:
    """Return a solid as few balls of its medial axis.

    Parameters
    ----------
    points, triangles, normals
        As of `compute`.
    count : int
        Balls, or capsules, at most.
    mode : CoverMode or its name
        "inside": no ball reaches out of the solid by more than the tolerance. "around": the balls hold the whole
        surface.
    shapes : CoverShapes or its name
        "balls"; "capsules" of one radius, or "tapered" ones with a radius at each end, along the edges of a small
        medial mesh.
    tolerance : float
        In percent of the diagonal of the bounding box; "around", it changes nothing.
    refine : bool
        Leave no place far from the balls, then hold as much volume as possible. Without, and for more than 1,024
        balls, the choice is greedy: the first balls of many are the few.
    progress : Progress, optional
    **settings
        As of `compute`; the side is always the inner one.

    Returns
    -------
    cover : BallCover
        `balls` has centres, radii, edges of capsules, and three figures: the share of the volume that is covered, how
        far balls reach out of the solid, and how far its surface is from them.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    wanted = BallSettings(
        count=_value(count, "count", BALL_OPTIONS["count"]),
        mode=_value(mode, "mode", BALL_OPTIONS["mode"]),
        shapes=_value(shapes, "shapes", BALL_OPTIONS["shapes"]),
        tolerance=_value(tolerance, "tolerance", BALL_OPTIONS["tolerance"]),
        refine=_value(refine, "refine", BALL_OPTIONS["refine"]),
    )
    chosen = Settings(**_checked(settings, list(OPTIONS)))
    shape, origin = _shape(points, triangles, normals)
    cover = ball_cover.cover_by_balls(shape, chosen, wanted, _progress(progress))
    return replace(cover, balls=cover.balls.moved(origin))


def reduce(
    found: MedialAxis | Computation, vertices: int, *, progress: Progress | None = None
) -> MedialAxis:
    """Return a small medial mesh: the same solid with few vertices, as polygons and edges of the same topology.

    Parameters
    ----------
    found : MedialAxis or Computation
        Of the inside.
    vertices : int
        That are wanted at most. Where nothing more can go without changing the topology, more stay.
    progress : Progress, optional

    Returns
    -------
    axis : MedialAxis
        Its facets are triangles, and polygons where a crisp sheet is flat. They have no samples of their own:
        `generators` are -1, `theta` and `rho` infinite.

    Raises
    ------
    NativeModuleError, InvalidInputError, OutOfMemoryError, Cancelled
    """
    most = int(np.iinfo(np.int32).max)
    count = min(_plain(vertices, "vertices", int, "give a number above 0"), most)
    given = _axis(found)
    origin = own_origin(given.vertices)
    return reduce_axis(given.moved(-origin), count, _progress(progress)).moved(origin)


def reconstruct(points: ArrayLike, *, progress: Progress | None = None) -> Reconstruction:
    """Return the watertight surface through points that lie densely on a closed one (Tight Cocone).

    Parameters
    ----------
    points : (n, 3) floats
    progress : Progress, optional

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    given = _numbers(points, "points")
    origin = own_origin(given)
    found = reconstruction.reconstruct(given - origin, _progress(progress))
    return replace(found, vertices=found.vertices + origin)


def read(path: str | os.PathLike[str]) -> Shape:
    """Return points, triangles and normals of a file: .xyz .xyzn .off .ply .obj .stl .dae .npy .npz.

    Polygons are cut into triangles. Without faces `triangles` is empty, without normals `normals` is None.

    Raises
    ------
    ReadError, OutOfMemoryError
    """
    shape, _ = read_shape(_path(path))
    return shape


def write(
    found: MedialAxis | Computation, path: str | os.PathLike[str], *, triangles: bool = False
) -> Path:
    """Write a medial axis; the extension chooses the format: .ma .ply .obj .off .npz .csv (docs/formats.md).

    Parameters
    ----------
    found : MedialAxis or Computation
    path : path of the file; its folder must exist
    triangles : bool
        Write .ply, .obj and .off as triangles in text, which more programs read; the others are as ever.
        In .ply and .off they are without edges that have no facet; an axis of these alone is refused.

    Returns
    -------
    path : Path
        The file that was written. It is whole, or the old one is unchanged.

    Raises
    ------
    ExportError
    """
    return export_axis(_axis(found), _path(path), triangles=triangles)


def write_balls(found: Balls | BallCover, path: str | os.PathLike[str]) -> Path:
    """Write balls; the extension chooses the format: .ma .json .urdf .mjcf .xml (docs/balls.md).

    Parameters
    ----------
    found : Balls or BallCover
    path : path of the file; its folder must exist

    Returns
    -------
    path : Path
        The file that was written. It is whole, or the old one is unchanged.

    Raises
    ------
    ExportError
    """
    _check_kind(found, "found", Balls, BallCover)
    return export_balls(found.balls if isinstance(found, BallCover) else found, _path(path))


def read_axis(path: str | os.PathLike[str]) -> MedialAxis:
    """Return a medial axis that `write` wrote as .npz, bit for bit; or balls, triangles and edges of any tool's .ma.

    Raises
    ------
    ReadError
    """
    name = _path(path)
    return read_ma(name) if name.suffix.lower() == ".ma" else load_axis(name)


# --- what callers give


def _axis(found: MedialAxis | Computation) -> MedialAxis:
    _check_kind(found, "found", MedialAxis, Computation)
    return found.axis if isinstance(found, Computation) else found


def _progress(given: Progress | None) -> Progress | None:
    if given is not None:
        _check_kind(given, "progress", Progress)
    return given


def _path(given: str | os.PathLike[str]) -> Path:
    """Return the path, of text or of bytes, as `open` takes them."""
    _check_kind(given, "path", str, bytes, os.PathLike)
    name = os.fsdecode(given)
    if "\0" in name:
        raise InvalidInputError(
            f"Expected a path that files can have, found {name!r} with a zero byte; remove it"
        )
    return Path(name)


def _check_kind(given: Any, name: str, *kinds: type) -> None:
    if not isinstance(given, kinds):
        names = " or ".join(kind.__name__ for kind in kinds)
        raise InvalidInputError(
            f"Expected {name} of the kind {names}, found {type(given).__name__}; give what the other "
            "functions return, or a name of a file"
        )


def _shape(
    points: ArrayLike, triangles: ArrayLike | None, normals: ArrayLike | None
) -> tuple[Shape, Floats]:
    """Return what a caller gave as a shape in its own frame, and where the origin of this frame is."""
    found = _numbers(points, "points")
    faces = _corners(np.empty((0, 3), np.int32) if triangles is None else triangles)
    directions = None if normals is None else _numbers(normals, "normals")
    if directions is not None and len(directions) != len(found):
        raise InvalidInputError(
            f"Expected a normal for each of {len(found):,} points, found {len(directions):,}; "
            "give a zero normal where there is none"
        )
    return in_own_frame(Shape(found, faces, directions))


def _numbers(rows: ArrayLike, name: str) -> Floats:
    """Return an (n, 3) array of float64, a copy only where that is necessary."""
    return np.ascontiguousarray(_rows(rows, name, "fiu", "numbers"), np.float64)


def _corners(rows: ArrayLike) -> Ints:
    """Return an (m, 3) array of int32, a copy only where that is necessary."""
    found = _rows(rows, "triangles", "iu", "integers")
    limits = np.iinfo(np.int32)
    if found.size and not (limits.min <= found.min() and found.max() <= limits.max):
        raise InvalidInputError(
            f"Expected rows of points in triangles, found {found.min()} to {found.max()}; "
            "rebuild the faces"
        )
    return np.ascontiguousarray(found, np.int32)


def _rows(rows: ArrayLike, name: str, kinds: str, what: str) -> NDArray[Any]:
    try:
        found = np.asarray(rows)
    except (TypeError, ValueError):  # rows of different lengths, or what is no array
        found = np.empty(0, object)
    if np.ma.is_masked(rows):
        raise InvalidInputError(
            f"Expected {name} that are all known, found {np.ma.count_masked(rows):,} masked numbers; leave their rows "
            "out"
        )
    if found.ndim != 2 or found.shape[1] != 3 or found.dtype.kind not in kinds:
        raise InvalidInputError(
            f"Expected {name} as rows of three {what}, found shape {found.shape} of "
            f"{found.dtype}; convert them"
        )
    return found


def _checked(given: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """Return the arguments of `Settings` from the options that a caller gave."""
    unknown = next((name for name in given if name not in names), None)
    if unknown is not None:
        what = "; compute again for others" if unknown in OPTIONS else ""
        raise InvalidInputError(
            f"Expected settings among {', '.join(names)}, found '{unknown}'{what}"
        )
    return {name: _value(value, name, OPTIONS[name]) for name, value in given.items()}


def _value(value: Any, name: str, option: Any) -> Any:
    if isinstance(option, Choice):
        return _member(name, option, value)
    wanted = bool if isinstance(option, Switch) else type(option.default)
    return _plain(value, name, wanted, f"the default is {option.default}")


def _plain(value: Any, name: str, wanted: Any, advice: str) -> Any:
    """Return the value as bool, int or float, if it is one without rounding."""
    try:
        if isinstance(value, str) or wanted(value) != value:
            raise ValueError
    except (TypeError, ValueError, OverflowError):
        raise InvalidInputError(
            f"Expected {name} as {wanted.__name__}, found {value!r}; {advice}"
        ) from None
    return wanted(value)


def _member(name: str, option: Choice, value: Any) -> Any:
    words = {member.name: member for member in option.items}
    word = value.upper().replace("-", "_") if isinstance(value, str) else getattr(value, "name", "")
    if word not in words or not isinstance(value, (str, type(option.default))):
        choices = ", ".join(f"'{word.lower()}'" for word in words)
        raise InvalidInputError(f"Expected {name} as one of {choices}, found {value!r}; choose one")
    return words[word]
