"""From points to a medial axis: `_medial.MedialAnalysis`, typed, with a memory of the last ones.

Everything costly is kept, so that other thresholds for the same points cost milliseconds.
"""

from __future__ import annotations

import hashlib
import threading
import time
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import native
from .errors import Cancelled, DegenerateInputError, InvalidInputError, OutOfMemoryError
from .settings import Settings, Side

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class MedialAxis:
    """The selected facets as convex planar polygons that share vertices, as `_medial.MedialMesh`.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
        Of the empty ball round each vertex, in the unit of the input.
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    theta : (f,) float64, radians
    rho : (f,) float64
    side : (f,) int32
        0 not known, 1 inner, 2 outer, 3 crossing.
    generators : (f, 2) int32
        Rows of the two samples of each facet.
    unbounded, zero_area : int
        Selected facets that reach infinity, or that are a point or a segment; neither is here.
    """

    vertices: NDArray[np.float64]
    radius: NDArray[np.float64]
    face_offsets: NDArray[np.int32]
    face_vertices: NDArray[np.int32]
    theta: NDArray[np.float64]
    rho: NDArray[np.float64]
    side: NDArray[np.int32]
    generators: NDArray[np.int32]
    unbounded: int
    zero_area: int

    @property
    def facets(self) -> int:
        """Number of polygons."""
        return len(self.face_offsets) - 1


@dataclass(frozen=True, eq=False)
class Computation:
    """A medial axis and how it came about.

    Parameters
    ----------
    axis : MedialAxis
    settings : Settings
        `side` is never AUTOMATIC here.
    key : str
        Names the analysis for `refilter`.
    points, duplicates : int
        Rows of the input, and those of them merged into an earlier row with the same coordinates.
    warnings : tuple of str
        What was assumed or looks wrong, a sentence each.
    seconds : float
    """

    axis: MedialAxis
    settings: Settings
    key: str
    points: int
    duplicates: int
    warnings: tuple[str, ...]
    seconds: float


def compute(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    settings: Settings,
    progress: Any | None = None,
) -> Computation:
    """The medial axis of samples of a surface.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
        Outward faces of the surface as rows of `points`; (0, 3) for a cloud of points.
    settings : Settings
    progress : _medial.Progress, optional

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    gaps = _open_edges(points, triangles)
    chosen = resolve_side(settings, triangles, gaps)
    key, analysis = _analyse(points, triangles, chosen.side is not Side.INNER, progress)
    axis = _extract(analysis, chosen, progress)
    return Computation(
        axis=axis,
        settings=chosen,
        key=key,
        points=len(points),
        duplicates=analysis.duplicates,
        warnings=tuple(_warnings(points, triangles, chosen, gaps, axis)),
        seconds=time.perf_counter() - start,
    )


def refilter(key: str, settings: Settings) -> MedialAxis | None:
    """The axis for other thresholds of a kept analysis; None when it is no longer kept."""
    analysis = CACHE.get(key)
    return None if analysis is None else _extract(analysis, settings, None)


def new_progress() -> Any:
    """A `_medial.Progress`, to be shared by the thread that computes and the one that watches."""
    return native.load().Progress()


# --- sides


def resolve_side(settings: Settings, triangles: NDArray[np.int32], gaps: int) -> Settings:
    """The settings with AUTOMATIC decided: INNER for a closed surface, BOTH for anything else."""
    has_surface = len(triangles) > 0
    if settings.side in (Side.INNER, Side.OUTER) and not has_surface:
        raise InvalidInputError(
            "Expected faces, which tell inside from outside, for side "
            f"{settings.side.name.capitalize()}, found points only; choose side Both or Automatic"
        )
    if settings.side is not Side.AUTOMATIC:
        return settings
    side = Side.INNER if has_surface and gaps == 0 else Side.BOTH
    return Settings(**{**vars(settings), "side": side})


def _warnings(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    settings: Settings,
    gaps: int,
    axis: MedialAxis,
) -> Iterator[str]:
    if gaps and settings.side in (Side.INNER, Side.OUTER):
        yield (
            f"the surface is open at {gaps:,} edges: inside was taken to be where the winding "
            "number of the open surface is above one half"
        )
    if axis.facets == 0:
        if settings.side is Side.INNER and gaps == 0 and _volume(points, triangles) < 0:
            yield (
                "no facet lies inside because the faces point inward; recalculate their normals "
                "(Mesh > Normals > Recalculate Outside) and compute again"
            )
        else:
            yield "no facet passes the conditions; lower theta or rho, or choose another side"


def _volume(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> float:
    a, b, c = (points[triangles[:, corner]] - points[0] for corner in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


# --- the compiled module


def _analyse(
    points: NDArray[np.float64], triangles: NDArray[np.int32], sphere: bool, progress: Any | None
) -> tuple[str, Any]:
    key = _key(points, triangles, sphere)
    analysis = CACHE.get(key)
    if analysis is None:
        module = native.load()
        with _own_errors(module):
            analysis = module.MedialAnalysis(
                points,
                triangles if len(triangles) else None,
                bounding_sphere=sphere,
                progress=progress,
            )
        CACHE.put(key, analysis, len(points))
    return key, analysis


def _open_edges(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> int:
    module = native.load()
    with _own_errors(module):
        return module.open_edges(points, triangles) if len(triangles) else 0


def _extract(analysis: Any, settings: Settings, progress: Any | None) -> MedialAxis:
    module = native.load()
    with _own_errors(module):
        mesh = analysis.extract(
            settings.theta,
            settings.rho,
            getattr(module.Side, settings.side.name),
            getattr(module.Rule, settings.rule.name),
            getattr(module.Criteria, settings.criteria.name),
            limit_set=settings.limit_set,
            progress=progress,
        )
    return MedialAxis(**{name: getattr(mesh, name) for name in MedialAxis.__dataclass_fields__})


@contextmanager
def _own_errors(module: Any) -> Iterator[None]:
    """The compiled module's errors as ours, which exist without it."""
    try:
        yield
    except module.InvalidInputError as error:
        raise InvalidInputError(str(error)) from error
    except module.DegenerateInputError as error:
        raise DegenerateInputError(str(error)) from error
    except module.Cancelled as error:
        raise Cancelled(str(error)) from error
    except MemoryError as error:
        raise OutOfMemoryError(
            "Expected enough memory, about 1.5 KB per point, found too little; "
            "close other programs or use fewer points"
        ) from error


# --- memory


def _key(points: NDArray[np.float64], triangles: NDArray[np.int32], sphere: bool) -> str:
    digest = hashlib.blake2b(bytes([sphere]), digest_size=16)
    for array in (points, triangles):
        digest.update(repr((array.shape, array.dtype.str)).encode())
        digest.update(np.ascontiguousarray(array).data)
    return digest.hexdigest()


class AnalysisCache:
    """The most recent analyses; the newest always stays, older ones as long as there is room.

    Parameters
    ----------
    entries : int
        Most analyses that are kept.
    points : int
        Most points that all kept analyses have together (about 1.5 KB each).
    """

    def __init__(self, entries: int = 8, points: int = 1_500_000) -> None:
        self._entries = entries
        self._points = points
        self._kept: OrderedDict[str, tuple[Any, int]] = OrderedDict()
        self._lock = threading.Lock()
        self.analyses = 0  # computed since Blender started

    def get(self, key: str) -> Any | None:
        with self._lock:
            if key not in self._kept:
                return None
            self._kept.move_to_end(key)
            return self._kept[key][0]

    def put(self, key: str, analysis: Any, points: int) -> None:
        with self._lock:
            self._kept[key] = (analysis, points)
            self._kept.move_to_end(key)
            self.analyses += 1
            while len(self._kept) > 1 and self._too_much():
                self._kept.popitem(last=False)

    def clear(self) -> None:
        with self._lock:
            self._kept.clear()

    def __len__(self) -> int:
        return len(self._kept)

    def _too_much(self) -> bool:
        points = sum(points for _, points in self._kept.values())
        return len(self._kept) > self._entries or points > self._points


CACHE = AnalysisCache()
