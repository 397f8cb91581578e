# SPDX-License-Identifier: GPL-3.0-or-later
"""The loop that Automatic closes: it samples again where the axis has other loops, pieces or cavities than the faces.

The samples know the topology of the solid that they show, and closed faces that of the solid. Where they differ, or
where walls are close, samples in pairs are tried, and their spacing becomes smaller where Voronoi edges meet the faces
in a way that samples of this surface cannot explain (`_medial.MedialAnalysis.doubts`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Floats
from ..errors import MemoryLimitError
from ..machine import native
from ..settings import Form, SamplingMode, Side, SidesFrom
from ..shape.nearness import nearest
from ..shape.sharp_angle import sharp_angle_of
from ..shape.solid_faces import SolidFaces
from .analysed import AnalysedSamples, Request, Sides
from .effort import EFFORT
from .sample_spacing import next_amount
from .worst_doubt import WorstDoubt, worst_doubt

_LEVELS = 0.9  # the share of all work that ends with the first hierarchy; work: progress
_PASSES = 10  # the most passes with pairs
_OF_REST = 0.3  # of the work left is shown as a pass: nobody knows their number; work: progress
_REACH = 1.5  # no place of a surface is farther from its samples than this number of spacings; chosen: unseen
# The spacing at a doubt is this share of its gap, but not more and not less than these shares of the spacing there.
_OF_GAP, _COARSEST, _FINEST = 0.5, 0.5, 0.25  # chosen: unseen
# Where a Voronoi edge passes the faces in a gap below this share of the way to its samples, it may touch a bulge.
_WIDE = 0.2  # chosen: unseen
# Walls that are missed on more than this share of the area are missed as a whole.
_AS_A_WHOLE = 0.2  # chosen: unseen
# So large a share of the samples may be buried, for foils are too thin to tell; and while spacings become smaller.
_BURIED, _FEW_BURIED = 0.01, 0.005  # chosen: unseen
# Where smaller spacings make more differences by this factor, and by this number, they do not help. Some more are made
# on the way, as where the spacings of both sides of a wall become small one after the other; but a pass that is no
# better than the one before may be followed by no more than so many others of this kind.
_WORSE, _MANY, _STALLED = 10, 100, 2
# Edges that bend so many times less than those of the faces that a smooth surface leaves are no edges of the solid;
# the least angle of the option is one degree.
_AS_BENT, _LEAST_SHARP = 3.0, math.radians(1.0)  # chosen: unseen


@dataclass(frozen=True, eq=False)
class Trial:
    """Samples, and how their topology compares with that of the faces.

    Parameters
    ----------
    samples : AnalysedSamples
    betti : tuple of int
        Pieces, loops and cavities of the solid that the samples show.
    places : (k, 3) float64
        Places of doubt, if the numbers differ.
    gaps : (k,) float64
    """

    samples: AnalysedSamples
    betti: tuple[int, int, int]
    places: Floats
    gaps: Floats

    @property
    def differences(self) -> int:
        """How many pieces, loops and cavities are too many or missing."""
        return sum(abs(a - b) for a, b in zip(self.betti, self.samples.by_faces or (), strict=True))


@dataclass(frozen=True, eq=False)
class Closed:
    """The result of the loop.

    Parameters
    ----------
    samples : AnalysedSamples
    passes : int
        The number of passes with pairs; 0: the samples are those that were there.
    why : str
        Why pairs were taken: what was wrong with the samples before.
    differs : bool
        The numbers of the samples still differ from those of the faces.
    worst : WorstDoubt or None
        Where the samples are most in doubt, if the numbers differ.
    """

    samples: AnalysedSamples
    passes: int
    why: str
    differs: bool
    worst: WorstDoubt | None = None

    def __str__(self) -> str:
        end = "; the numbers of the faces are not reached within the budget" if self.differs else ""
        if self.passes == 1:
            return f"{self.why}: samples in pairs" + end
        return f"{self.why}: samples in pairs in {self.passes} passes" + end


def closes(request: Request, sides: Sides) -> bool:
    """Whether the loop may run: the choice was left to Automatic, and a level of closed faces is wanted."""
    settings = request.settings
    return (
        settings.sampling is SamplingMode.AUTOMATIC
        and settings.side is Side.INNER
        and settings.form is not Form.PUBLISHED
        and sides.source is SidesFrom.SURFACE
        and not request.gaps
        and request.shape.solid_betti is not None
    )


def are_close(samples: AnalysedSamples) -> bool:
    """Whether the axis is missing between walls that are close."""
    return not overlaps(samples) and samples.walls is not None and samples.walls.are_missed


def overlaps(samples: AnalysedSamples) -> bool:
    """Whether parts of the surface bound nothing, so that the numbers of the faces mean nothing."""
    return samples.buried > _BURIED * len(samples.points)


def closed(
    request: Request,
    before: AnalysedSamples,
    take: Callable[[dict[str, Any] | None, float], AnalysedSamples],
) -> Closed | None:
    """Try samples in pairs, with smaller spacings where the topology is wrong, until it is that of the faces.

    Parameters
    ----------
    request : Request
    before : AnalysedSamples
        The samples without pairs.
    take : callable
        Takes samples in pairs: of an amount, or of the size of a first pass for None; on the flat faces, with edges
        sharp from an angle on, or for 0 on the smooth surface.

    Returns
    -------
    closed : Closed or None
        None: the samples are right as they are.
    """
    if overlaps(before):
        return None
    close = are_close(before)
    start = _first_trial(request, before, close)
    if not close and not (start.differences and len(start.gaps)):
        return None
    best, passes = _best(request, start, close, take)
    if not passes:
        return None
    why = "the walls are thin" if close else "the topology was not that of the faces"
    if not best.differences:
        return Closed(best.samples, passes, why, differs=False)
    worst = worst_doubt(request.shape, best.samples, best.places)
    return Closed(best.samples, passes, why, differs=True, worst=worst)


def _best(
    request: Request,
    start: Trial,
    close: bool,
    take: Callable[[dict[str, Any] | None, float], AnalysedSamples],
) -> tuple[Trial, int]:
    """Return the best trial, and the number of passes with pairs up to it; `close` samples without pairs are worst."""
    best, last, found, spent, stalled = start, start, 0, 0, 0
    amount: dict[str, Any] | None = None
    flat = _sharp_on_flat(request, start.samples)
    for number in range(1, _PASSES + 1):
        request.progress.begin_pass(number + 1)
        request.progress.begin_share(_OF_REST)
        try:
            samples = take(amount, flat)
        except MemoryLimitError:
            break
        spent += len(samples.points)
        trial = _trial(request, samples)
        if trial.differences <= best.differences or (close and not found):
            best, found = trial, number
        again = number == 1 and _is_worth_more(request, samples)
        left = request.settings.budget - spent
        if not (trial.differences or again) or left <= len(samples.points):
            break
        stalled = stalled + 1 if number > 2 and trial.differences >= last.differences else 0
        if stalled > _STALLED or _is_hopeless(trial, last, number):
            break
        last = trial
        flat = flat or _sharp_on_flat(request, samples)
        amount = _finer(request, trial, number, left)
    request.progress.begin_pass(1)
    request.progress.begin_share(1.0)
    return best, found


def _is_hopeless(trial: Trial, last: Trial, number: int) -> bool:
    """Whether smaller spacings do not help: parts overlap, or they made more differences."""
    overlap = trial.samples.buried > _FEW_BURIED * len(trial.samples.points)
    return overlap or (number > 2 and trial.differences > _WORSE * last.differences + _MANY)


def _first_trial(request: Request, samples: AnalysedSamples, close: bool) -> Trial:
    """Compare the topology of the first samples, by the hierarchy that will be needed if they are right.

    Samples of walls that are too close are replaced whatever they show.
    """
    assert samples.by_faces is not None
    if close:
        return Trial(samples, samples.by_faces, *_no_doubts())
    if not request.levels:
        return _trial(request, samples)
    request.progress.until(_LEVELS)
    solid = samples.solid if request.settings.crisp else None
    betti = _betti(request, samples, solid)
    places, gaps = _no_doubts() if betti == samples.by_faces else _doubts(request, samples)
    return Trial(samples, betti, places, gaps)


def _trial(request: Request, samples: AnalysedSamples) -> Trial:
    """Compare the topology; samples without pairs and without a doubt are taken to have that of the faces."""
    places, gaps = _doubts(request, samples)
    if not len(gaps) and samples.partners is None and samples.by_faces is not None:
        return Trial(samples, samples.by_faces, places, gaps)
    return Trial(samples, _betti(request, samples), places, gaps)


def _no_doubts() -> tuple[Floats, Floats]:
    return np.zeros((0, 3)), np.zeros(0)


def _betti(
    request: Request, samples: AnalysedSamples, solid: SolidFaces | None = None
) -> tuple[int, int, int]:
    """Count pieces, loops and cavities on the hierarchy, which stays with the samples; crisp places take long."""
    assert samples.by_faces is not None
    hierarchy = samples.levels.hierarchy(
        samples.analysis,
        request.settings,
        request.progress.part(0.5),
        samples.by_faces[0],
        solid,
        samples.partners,
    )
    pieces, loops, cavities = hierarchy.betti
    return pieces, loops, cavities


def _doubts(request: Request, samples: AnalysedSamples) -> tuple[Floats, Floats]:
    shape = request.shape
    assert samples.apart is not None
    with native.own_errors():
        found: tuple[Floats, Floats] = samples.analysis.doubts(
            shape.points,
            shape.triangles[shape.unfolded],
            samples.normals,
            _REACH * samples.apart,
            progress=request.progress.part(0.05),
        )
    return found


def _finer(request: Request, trial: Trial, number: int, budget: int) -> dict[str, Any]:
    """Return the amount of the pass after a `number` of passes: spacings as they are, or smaller ones at doubts.

    The first time they follow the density and the walls, as without pairs, where walls are missed or no doubt says
    where. Elsewhere that makes more loops than it closes.
    """
    samples, where = trial.samples, bool(len(trial.gaps) and trial.differences)
    effort = EFFORT[request.settings.sampling]
    assert samples.apart is not None
    sites, spacings = samples.points, samples.apart
    if number == 1 and (are_close(samples) or not where):
        sites, spacings = next_amount(samples, effort.elsewhere, effort.walls, budget)["sizing"]
    if where and not (number == 1 and _are_missed_as_a_whole(samples)):
        places, wanted = _wanted(trial)
        sites = np.concatenate((sites, places))
        spacings = np.concatenate((spacings, wanted))
    return {"sizing": (sites, spacings), "count": budget}


def _are_missed_as_a_whole(samples: AnalysedSamples) -> bool:
    """Whether so many walls are missed that doubts are everywhere and say nothing."""
    return samples.walls is not None and samples.walls.missed > _AS_A_WHOLE


def _wanted(trial: Trial) -> tuple[Floats, Floats]:
    """(k, 3) places of doubt, and (k,) the spacings there; first those where the gap is no mere touch."""
    samples = trial.samples
    assert samples.apart is not None
    rows = nearest(trial.places, samples.points)
    own, away = samples.apart[rows], np.linalg.norm(trial.places - samples.points[rows], axis=1)
    wide = trial.gaps > _WIDE * away
    if not wide.any():
        wide[:] = True
    wanted = np.clip(_OF_GAP * trial.gaps, _FINEST * own, _COARSEST * own)
    return trial.places[wide], wanted[wide]


def _is_worth_more(request: Request, samples: AnalysedSamples) -> bool:
    return not samples.density.dense_enough or are_close(samples)


def _sharp_on_flat(request: Request, samples: AnalysedSamples) -> float:
    """Return from which angle edges are sharp if samples belong on the flat faces, and 0 on the smooth surface.

    They belong there where the smooth surface is flat everywhere, or leaves close walls. Edges of the faces that it
    leaves are then edges of the solid: samples that miss them tear the sheet between close walls.
    """
    walls = samples.walls
    if walls is None or not (walls.are_bulging or walls.are_flat):
        return 0.0
    sharp = sharp_angle_of(request.shape, request.settings)
    bent = request.shape.smooth_bends(sharp)[walls.faces[walls.bulges]]
    return max(float(bent[bent > 0.0].min(initial=math.inf)) / _AS_BENT, _LEAST_SHARP)
