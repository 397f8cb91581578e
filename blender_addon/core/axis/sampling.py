"""Which points are analysed: the vertices as they are, or samples of the surface that lie densely enough."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DegenerateInputError, InvalidInputError, MemoryLimitError
from ..machine import native
from ..machine.cache import CACHE, key_of
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..settings import Sampling, Settings, Side, SidesFrom
from .density import LOOKED_AT, Density, estimate, percent
from .sides import Sides, resolve_sides, resolve_sides_of_samples
from .thinning import fewer_samples, thinned_rows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..machine.progress import Progress
    from .shape import Shape

# Most passes, and the closest that samples come to each other at sharp edges and elsewhere, as shares
# of the first spacing. Automatic asks for little, so that a first click is fast.
_EFFORT = {
    Sampling.VERTICES: (0, 0.0, 0.0),
    Sampling.SURFACE: (1, 1.0, 1.0),
    Sampling.AUTOMATIC: (2, 1.0, 0.5),
    Sampling.ADAPTIVE: (4, 0.25, 0.0625),
}
_SPENT = 0.97  # of the budget, which is met by scaling all spacings
_SPARSE = 0.5  # a larger share of samples above epsilon is worth a warning
_OFF = 1e-3  # of the spacing: how far from the surface one looks for its two sides
# Edges are sharp from so much above the angle: tubes of twelve sides are round, and bent ones have 30.1 degrees.
_CLEARLY = 1.01
_ROUNDINGS = 4  # of float32, in which meshes are stored: a surface that is less thick is flat


@dataclass(frozen=True, eq=False)
class Samples:
    """Points, what is known of the surface at each, and their analysis.

    Parameters
    ----------
    key : str
        Names it in the cache.
    points : (n, 3) float64
    kinds : (n,) int32 or None
        Values of `_medial.SampleKind`; None: vertices.
    normals : (n, 3) float64 or None
        Of the surface there, outward.
    analysis : _medial.MedialAnalysis
    density : Density
    spacing : float
        Of an even sampling, the distance of neighbours; of others that of their first pass.
    buried : int
        Samples that were left out, for the surface there bounds nothing.
    rows : (n,) int32 or None
        Which points of the shape these are; None: all, or samples.
    """

    key: str
    points: NDArray[np.float64]
    kinds: NDArray[np.int32] | None
    normals: NDArray[np.float64] | None
    analysis: Any
    density: Density
    spacing: float = 0.0
    buried: int = 0
    rows: NDArray[np.int32] | None = None

    @property
    def bytes(self) -> int:
        """Memory that these and their analysis hold."""
        density = self.density
        own = (self.points, self.kinds, self.normals, self.rows)
        others = (density.points, density.spacing, density.feature_size, density.edges)
        arrays = [x for x in (*own, *others) if x is not None]
        return int(self.analysis.bytes) + sum(x.nbytes for x in arrays)


@dataclass(frozen=True, eq=False)
class Sampled:
    """The samples that are used, and why.

    Parameters
    ----------
    samples : Samples
    sampling : Sampling
        Never AUTOMATIC.
    reason : str
        A sentence for people.
    sides : Sides
        What told inside from outside, and why.
    gaps : int
        Edges at which the faces are open.
    thinned : str
        Why these are fewer than would have been used, a sentence; or empty.
    """

    samples: Samples
    sampling: Sampling
    reason: str
    sides: Sides
    gaps: int
    thinned: str = ""


def sample(
    shape: Shape, settings: Settings, progress: Progress, limit: MemoryLimit = WHAT_IS_FREE
) -> Sampled:
    """Choose and analyse samples of a shape.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress
    limit : MemoryLimit

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    try:
        return _Sampler(shape, settings, progress, limit).run()
    except MemoryLimitError as error:
        shape, settings, thinned = _thinned(shape, settings, limit, error)
    return replace(_Sampler(shape, settings, progress, limit).run(), thinned=thinned)


def _thinned(
    shape: Shape, settings: Settings, limit: MemoryLimit, error: MemoryLimitError
) -> tuple[Shape, Settings, str]:
    if len(shape.triangles):
        first = _count(shape, settings)
        return shape, *fewer_samples(shape, settings, first, limit, error)
    rows, sentence = thinned_rows(shape.points, limit, error)
    normals = None if shape.normals is None else shape.normals[rows]
    return replace(shape, points=shape.points[rows], normals=normals, rows=rows), settings, sentence


def sampling_warnings(shape: Shape, sampled: Sampled) -> Iterator[str]:
    """What was left out, and where the samples are too sparse to trust the axis."""
    samples, density = sampled.samples, sampled.samples.density
    if sampled.thinned:
        yield sampled.thinned
    if sampled.sampling is not Sampling.VERTICES:
        loose = len(shape.points) - len(np.unique(shape.triangles))
        if loose and shape.of_samples:
            yield (
                f"{loose:,} vertices without a face were left out; choose Sampling Vertices to "
                "use them"
            )
    if samples.buried:
        yield (
            f"{samples.buried:,} samples were left out because the surface there bounds nothing: "
            "overlapping parts, walls inside, or sheets without thickness"
        )
    if density.share > _SPARSE:
        yield (
            f"{percent(density.share)} of the samples are too sparse for what the shape has there "
            f"(epsilon above {density.limit:g}), so the axis may be wrong; Report Sampling shows where"
        )


class _Sampler:
    """One run of `sample`."""

    def __init__(
        self, shape: Shape, settings: Settings, progress: Progress, limit: MemoryLimit
    ) -> None:
        self._shape = shape
        self._settings = settings
        self._progress = progress
        self._limit = limit
        self._gaps = open_edges(shape.points, shape.triangles)

    def run(self) -> Sampled:
        wanted, shape = self._settings.sampling, self._shape
        if wanted is Sampling.VERTICES:
            return self._of_vertices("as chosen")
        _check_faces(shape, wanted)
        if not len(shape.triangles):
            return self._of_vertices("there are no faces")
        if wanted is not Sampling.AUTOMATIC:
            return self._of_surface("as chosen")
        if not shape.of_samples:
            return self._of_surface("the object has no vertices of its own")
        return self._of_what_is_dense()

    def _of_what_is_dense(self) -> Sampled:
        try:
            found = self._of_vertices("dense enough", 0.2)
        except DegenerateInputError:  # their faces may span a volume all the same
            return self._of_surface("the vertices alone span no volume")
        density, cocone = found.samples.density, found.samples.analysis.tight_cocone
        dense = density.dense_enough
        if not dense and density.is_improved_by(_spacing(self._shape, self._settings)):
            return self._of_surface(
                f"the vertices are too sparse, epsilon above {density.limit:g} at "
                f"{percent(density.share)} of them"
            )
        if cocone is not None and not cocone.encloses:
            return self._of_surface("the vertices alone enclose nothing")
        if dense:
            return found
        return replace(found, reason=self._vertices("as dense as samples would be"))

    # --- vertices

    def _of_vertices(self, why: str, share: float = 1.0) -> Sampled:
        shape, settings = self._shape, self._settings
        sides = resolve_sides(settings.sides, shape.triangles, self._gaps, shape.normals)
        found = self._cached(
            (
                *(sides.source.name, shape.points, shape.rows),
                *_telling(sides, shape.triangles, shape.normals),
            ),
            lambda key: self._analysed_vertices(key, sides, share),
        )
        return Sampled(found, Sampling.VERTICES, self._vertices(why), sides, self._gaps)

    def _vertices(self, why: str) -> str:
        return f"The {len(self._shape.points):,} vertices, {why}"

    def _analysed_vertices(self, key: str, sides: Sides, share: float) -> Samples:
        points, normals = self._shape.points, self._shape.normals
        analysis = self._analyse(points, normals, sides, self._progress.part(share))
        density = estimate(
            analysis, points, points[:0], 0.0, self._settings.epsilon, most=LOOKED_AT
        )
        return Samples(key, points, None, normals, analysis, density, rows=self._shape.rows)

    # --- samples of the faces

    def _of_surface(self, why: str) -> Sampled:
        """Even samples; then, for Adaptive and Automatic, as many passes as it takes."""
        settings = self._settings
        _check_not_flat(self._shape)
        most, _, finest = _EFFORT[settings.sampling]
        found, passes = self._pass(_amount(self._shape, settings), 1.0 if most == 1 else 0.4), 1
        while passes < most and not found.density.dense_enough and self._may_grow(found):
            found = self._pass(_wanted(found, finest, settings.budget), 0.6, found.spacing)
            passes += 1
        reason = f"{len(found.points):,} samples of the surface: {why}"
        if passes > 1:
            reason += f"; closer together where it is thin, in {passes} passes"
        if most > 1 and not found.density.dense_enough and not self._may_grow(found):
            reason += f", until the budget of {settings.budget:,} was spent"
        kind = Sampling.SURFACE if passes == 1 else Sampling.ADAPTIVE
        return Sampled(found, kind, reason, self._sides, self._gaps)

    def _may_grow(self, found: Samples) -> bool:
        return len(found.points) < _SPENT * self._settings.budget

    @cached_property
    def _sides(self) -> Sides:
        """Of samples of the faces."""
        shape = self._shape
        return resolve_sides_of_samples(
            self._settings.sides, shape.points, shape.triangles, self._gaps
        )

    def _pass(self, amount: dict[str, Any], share: float, first: float = 0.0) -> Samples:
        shape, settings = self._shape, self._settings
        options = {
            name: getattr(settings, name)
            for name in ("sharp_angle", "smooth", "keep_vertices", "seed")
        }
        wider = 2.0 if shape.shaded_smooth else _CLEARLY
        options["sharp_angle"] = min(wider * settings.sharp_angle, math.pi)
        parts = (shape.points, shape.triangles, shape.sharp_edges, *options.values())
        amounts = (word for pair in amount.items() for word in pair)
        return self._cached(
            (self._sides.source.name, *parts, *amounts, first),
            lambda key: self._analysed_samples(key, {**options, **amount}, share, first),
        )

    def _analysed_samples(
        self, key: str, options: dict[str, Any], share: float, first: float
    ) -> Samples:
        """Samples and their analysis; `first` is the spacing of the first pass, 0 in that."""
        shape = self._shape
        if not first:
            self._limit.check(_count(shape, self._settings))
        with native.own_errors() as module:
            found = module.sample_surface(
                shape.points,
                shape.triangles,
                sharp_edges=shape.sharp_edges,
                progress=self._progress.part(0.2 * share),
                **options,
            )
        spacing = mean_spacing(found.area, len(found.points))
        bare = self._bare(found, _OFF * spacing)
        if not bare.any():
            raise DegenerateInputError(
                f"Expected a surface that bounds a solid, found that all {len(bare):,} samples of it "
                "bound nothing; remove doubled faces, or choose Sampling Vertices"
            )
        points, normals, kinds = (x[bare] for x in (found.points, found.normals, found.kind))
        analysis = self._analyse(points, normals, self._sides, self._progress.part(share))
        edge = kinds == int(module.SampleKind.SHARP)
        if not self._gaps:  # else corners may be those of an opening, where the shape may be thick
            edge |= kinds == int(module.SampleKind.CORNER)
        first = first or spacing
        density = estimate(analysis, points, points[edge], first, self._settings.epsilon)
        buried = len(bare) - len(points)
        return Samples(key, points, kinds, normals, analysis, density, first, buried)

    def _bare(self, found: Any, offset: float) -> NDArray[np.bool_]:
        """(n,) the samples that lie between inside and outside, and are not buried in the solid."""
        # Open faces bound nothing; of those that point inward the empty axis tells.
        if self._gaps or self._shape.volume < 0:
            return np.ones(len(found.points), bool)
        points, normals = _on_faces(self._shape, found, 100.0 * offset)
        with native.own_errors() as module:
            return ~module.buried(
                points, normals, offset, self._shape.points, self._shape.triangles
            )

    # --- both

    def _analyse(
        self,
        points: NDArray[np.float64],
        normals: NDArray[np.float64] | None,
        sides: Sides,
        progress: Any,
    ) -> Any:
        shape = self._shape
        self._limit.check(len(points))
        triangles, normals = _telling(sides, shape.triangles, normals)
        separate = triangles is not None and points is not shape.points
        with native.own_errors() as module:
            return module.MedialAnalysis(
                points,
                triangles,
                vertices=shape.points if separate else None,
                normals=normals,
                sides=getattr(module.SidesFrom, sides.source.name),
                bounding_sphere=self._settings.side is not Side.INNER,
                progress=progress,
            )

    def _cached(self, parts: tuple, make: Callable[[str], Samples]) -> Samples:
        """Samples by all that they depend on; their density is that of the epsilon that is wanted."""
        key = key_of(self._settings.side is not Side.INNER, *parts)
        found = CACHE.get(key)
        if found is None:
            found = make(key)
            CACHE.put(key, found, found.bytes)
        _, at_edge, _ = _EFFORT[self._settings.sampling]
        density = replace(
            found.density, limit=self._settings.epsilon, finest=at_edge * found.spacing
        )
        return replace(found, density=density)


def open_edges(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> int:
    """Edges at which triangles are open; 0 where there are none."""
    with native.own_errors() as module:
        return module.open_edges(points, triangles) if len(triangles) else 0


def mean_spacing(area: float, count: int) -> float:
    """Distance of neighbours in a hexagonal lattice of so many points on such an area."""
    return math.sqrt(2.0 * area / (math.sqrt(3.0) * count))


def _amount(shape: Shape, settings: Settings) -> dict[str, Any]:
    """How many samples the first pass has, as `_medial.sample_surface` is told.

    Automatic takes no fewer than there are vertices, within the budget.
    """
    corners = shape.points[np.unique(shape.triangles)]
    if settings.spacing == 0.0:
        count = settings.samples
        if settings.sampling is Sampling.AUTOMATIC:
            count = max(count, min(len(corners), settings.budget))
        return {"count": count}
    diagonal = float(np.linalg.norm(np.ptp(corners, axis=0)))
    return {"spacing": settings.spacing / 100.0 * diagonal}


def _spacing(shape: Shape, settings: Settings) -> float:
    """Of the first pass."""
    amount = _amount(shape, settings)
    return amount.get("spacing") or mean_spacing(shape.area, amount["count"])


def _count(shape: Shape, settings: Settings) -> int:
    """Of samples in the first pass, about; those that fill keep_vertices come on top."""
    amount = _amount(shape, settings)
    if "count" in amount:
        return amount["count"]
    return round(2.0 * shape.area / (math.sqrt(3.0) * amount["spacing"] ** 2))


def _wanted(found: Samples, finest: float, budget: int) -> dict[str, Any]:
    """What a pass asks of the next one; nowhere are samples farther apart than in the first."""
    density = found.density
    least = np.where(density.at_edge, density.finest, finest * found.spacing)
    spacings = np.clip(density.limit * density.feature_size, least, found.spacing)
    return {"sizing": (density.points, spacings), "count": budget}


def _telling(
    sides: Sides, triangles: NDArray[np.int32], normals: NDArray[np.float64] | None
) -> tuple[NDArray[np.int32] | None, NDArray[np.float64] | None]:
    """Triangles and normals, as far as they tell the sides."""
    return (
        triangles if sides.source is SidesFrom.SURFACE else None,
        normals if sides.source is SidesFrom.NORMALS else None,
    )


def _on_faces(
    shape: Shape, found: Any, step: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A place on a flat face for each sample, also where samples follow the smooth surface, and its normal.

    Places on edges and corners are moved by a step, or a tenth of the way, to the middle of the face, for
    on the edge itself the face's normal may lead along its neighbour.
    """
    corners = shape.points[shape.triangles[found.triangle]]
    points = np.einsum("ij,ijk->ik", found.barycentric, corners)
    with native.own_errors() as module:
        on_edge = found.kind != int(module.SampleKind.SURFACE)
    inward = corners[on_edge].mean(axis=1) - points[on_edge]
    ways = np.linalg.norm(inward, axis=1)[:, None]
    points[on_edge] += inward * np.minimum(0.1, step / np.where(ways > 0.0, ways, step))
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    return points, normals / np.where(lengths > 0.0, lengths, 1.0)[:, None]


def _check_faces(shape: Shape, wanted: Sampling) -> None:
    """Raise InvalidInputError when there are no faces where samples of them are needed."""
    if len(shape.triangles):
        return
    if not shape.of_samples:
        raise InvalidInputError(
            "Expected faces, found only lines; give the object a surface (a curve needs a bevel or "
            "an extrusion), or choose Sampling Vertices"
        )
    if wanted is not Sampling.AUTOMATIC:
        raise InvalidInputError(
            f"Expected faces for Sampling {wanted.name.capitalize()}, found points only; "
            "choose Sampling Automatic or Vertices"
        )


def _check_not_flat(shape: Shape) -> None:
    """Raise DegenerateInputError when all faces lie in a plane, but for the rounding of their corners."""
    corners = shape.points[np.unique(shape.triangles)]
    around = corners - corners.mean(axis=0)
    _, axes = np.linalg.eigh(around.T @ around)
    thickness = float(np.ptp(around @ axes[:, 0]))
    if thickness <= _ROUNDINGS * float(np.finfo(np.float32).eps) * float(np.abs(corners).max()):
        raise DegenerateInputError(
            "Expected faces that span a volume, found all of them in one plane; give them "
            "thickness (a Solidify modifier, or an extrusion)"
        )
