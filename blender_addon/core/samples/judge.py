# SPDX-License-Identifier: GPL-3.0-or-later
"""The judgement of a pass: what is chosen, or what is taken next.

The samples know the topology of the solid that they show, and closed faces that of the solid. Where they differ, or
where walls are close, Automatic tries samples in pairs, and their spacing becomes smaller where Voronoi edges meet the
faces in a way that samples of this surface cannot explain (`_medial.MedialAnalysis.doubts`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, takewhile

from ..settings import SamplingMode
from .analysed import Analysed
from .chosen import ChosenSamples
from .decide import Plan, plan_of
from .density import percent
from .doubts import Topology, worst_doubt
from .next_amount import finer_in_pairs, next_amount, sharp_at_doubts, sharp_on_flat
from .sample_spacing import Amount
from .sides import decided

# The budget counts as spent from this share on: all spacings are scaled to meet it, which is not exact.
_SPENT = 0.97  # work: progress
_PASSES = 10  # the most passes with pairs
_FEW_BURIED = 0.005  # so large a share of the samples may be buried while spacings become smaller; chosen: unseen
# Where smaller spacings make more differences by this factor, and by this number, they do not help. Some more are made
# on the way, as where the spacings of both sides of a wall become small one after the other; but a pass that is no
# better than the one before may be followed by no more than so many others of this kind.
_WORSE, _MANY, _STALLED = 10, 100, 2


@dataclass(frozen=True, eq=False)
class Pass:
    """Analysed samples, and how their topology compares with that of the faces."""

    amount: Amount
    samples: Analysed
    topology: Topology | None = None  # None where it was not compared

    @property
    def differences(self) -> int:
        """How many pieces, loops and cavities are too many or missing, once compared."""
        assert self.topology is not None
        by_faces = self.samples.by_faces or ()
        return sum(abs(a - b) for a, b in zip(self.topology.betti, by_faces, strict=True))


@dataclass(frozen=True, eq=False)
class Again:
    """Another pass."""

    plan: Plan
    amount: Amount
    passes: tuple[Pass, ...] = ()  # The passes before, of the same plan


@dataclass(frozen=True, eq=False)
class Compare:
    """The topology of the last pass has to be known."""

    plan: Plan
    passes: tuple[Pass, ...]


def judge(plan: Plan, passes: tuple[Pass, ...]) -> Again | Compare | ChosenSamples:
    """Judge the last pass of a plan: the vertices; samples of the faces, first without and then, if need be, in pairs.

    Once a pass was compared with the topology of the faces, all that follow are in pairs, and compared.
    """
    if not plan.of_faces:
        return _of_vertices(plan, passes[-1].samples)
    compared = trials(passes)
    amount = _next_in_pairs(plan, compared) if compared else _denser(plan, passes)
    if amount is not None:
        return Again(plan, amount, passes)
    if not compared and compares(plan, passes[-1].samples) and not passes[-1].samples.overlaps:
        return Compare(plan, passes)
    return finish(plan, passes)


def _of_vertices(plan: Plan, analysed: Analysed) -> Again | ChosenSamples:
    """Choose the vertices if they are dense enough and enclose a volume, or if samples would be no denser."""
    if not plan.is_trial:
        return _vertices(plan, analysed, plan.why)
    walls, density = analysed.walls, analysed.density
    if walls is not None and walls.are_missed:
        return instead_of_vertices(plan, "the walls are closer than the vertices are apart")
    dense = density.dense_enough
    if not dense and density.is_improved_by(plan.given.first.spacing):
        reason = (
            f"the vertices are too sparse, epsilon above {density.limit:g} at "
            f"{percent(density.share)} of them"
        )
        return instead_of_vertices(plan, reason, is_sparse=True)
    cocone = analysed.analysis.tight_cocone
    if cocone is not None and not cocone.encloses:
        return instead_of_vertices(plan, "the vertices alone enclose nothing")
    return _vertices(plan, analysed, plan.why if dense else "as dense as samples would be")


def instead_of_vertices(plan: Plan, why: str, is_sparse: bool = False) -> Again:
    """Return the first pass over the faces."""
    faces = plan_of(plan.given, why, of_faces=True, is_sparse=is_sparse)
    return Again(faces, faces.first)


def _vertices(plan: Plan, analysed: Analysed, why: str) -> ChosenSamples:
    given, sides = plan.given, decided(plan.sides, analysed.analysis)
    reason = f"The {len(given.shape.points):,} vertices, {why}"
    return ChosenSamples(
        analysed,
        SamplingMode.VERTICES,
        reason,
        sides,
        given.shape.open_edges,
        thinned=given.thinned,
        scan=given.scan,
    )


def _denser(plan: Plan, passes: tuple[Pass, ...]) -> Amount | None:
    """Return the amount of another pass without pairs, for Adaptive and Automatic; None where none is needed."""
    samples = passes[-1].samples
    if len(passes) == 1 and compares(plan, samples) and samples.walls_are_close:
        return None  # pairs see more between walls than smaller spacings
    if len(passes) >= plan.effort.passes:
        return None
    dense = samples.density.dense_enough and not _are_worth_more(plan, samples)
    if dense or _is_spent(plan, samples):
        return None
    return next_amount(plan, samples, plan.given.settings.budget)


def compares(plan: Plan, samples: Analysed) -> bool:
    """Return whether the topology is compared with that of the faces, which have to be closed."""
    return plan.compares and samples.by_faces is not None


def _are_worth_more(plan: Plan, samples: Analysed) -> bool:
    """Return whether the axis is missing between walls that are close, and the budget allows to change that."""
    walls, given = samples.walls_to_show, plan.given
    return (
        walls is not None
        and walls.are_missed
        and walls.are_reached_by(given.settings.budget, given.shape.area)
    )


def _is_spent(plan: Plan, samples: Analysed) -> bool:
    """Return whether the budget allows no more samples."""
    return len(samples.points) >= _SPENT * plan.given.settings.budget


def trials(passes: Sequence[Pass]) -> list[Pass]:
    """Return the passes that were compared: the last one without pairs, and all with pairs."""
    return [one for one in passes if one.topology is not None]


def _best_of(passes: Sequence[Pass]) -> tuple[Pass, int]:
    """Return the best pass, and the number of passes with pairs up to it.

    Without pairs that is the last one; if its walls are close, samples without pairs are worst.
    """
    start, *tried = trials(passes) or passes[-1:]
    best, found = start, 0
    for number, trial in enumerate(tried, 1):
        worst = not found and start.samples.walls_are_close
        if worst or trial.differences <= best.differences:
            best, found = trial, number
    return best, found


def _next_in_pairs(plan: Plan, compared: Sequence[Pass]) -> Amount | None:
    """Return the amount of the next pass with pairs, given `trials`; None where none is needed or would help."""
    start, *tried = compared
    if not tried:
        assert start.topology is not None
        if not start.samples.walls_are_close and not (
            start.differences and len(start.topology.gaps)
        ):
            return None
        return replace(plan.first, pairs=True, flat=sharp_on_flat(plan, start.samples))
    trial, samples, number = tried[-1], tried[-1].samples, len(tried)
    if trial.differences and not start.samples.walls_are_close and not start.differences:
        return None
    again = number == 1 and (not samples.density.dense_enough or samples.walls_are_close)
    left = plan.given.settings.budget - sum(len(one.samples.points) for one in tried)
    if not (trial.differences or again) or left <= len(samples.points):
        return None
    if number == _PASSES or _are_hopeless(tried):
        return None
    assert trial.topology is not None
    flat = trial.amount.flat
    if not flat and trial.differences:
        flat = sharp_at_doubts(plan, samples, trial.topology)
        if flat:
            return replace(plan.first, pairs=True, flat=flat)
    return replace(finer_in_pairs(plan, samples, trial.topology, number, left), flat=flat)


def _are_hopeless(tried: Sequence[Pass]) -> bool:
    """Whether smaller spacings do not help: parts overlap, or they made more differences, at once or again and again.

    The second pass differs from the first in more than its spacings.
    """
    samples = tried[-1].samples
    steps = [(a.differences, b.differences) for a, b in pairwise(tried)][1:]
    stalled = list(takewhile(lambda step: step[1] >= step[0], reversed(steps)))
    many = bool(steps) and steps[-1][1] > _WORSE * steps[-1][0] + _MANY
    overlap = samples.buried > _FEW_BURIED * len(samples.points)
    return overlap or many or len(stalled) > _STALLED


def finish(plan: Plan, passes: tuple[Pass, ...]) -> ChosenSamples:
    """Choose the best of some passes over the faces."""
    best, in_pairs = _best_of(passes)
    given, samples = plan.given, best.samples
    plain = passes.index(best) + 1
    words = _of_pairs(passes, in_pairs) if in_pairs else _of_passes(plan, samples, plain)
    differs = in_pairs > 0 and best.differences > 0
    worst = None
    if differs:
        words += "; the numbers of the faces are not reached within the budget"
        assert best.topology is not None
        worst = worst_doubt(given.shape, samples, best.topology.places)
    once = plain == 1 and not in_pairs
    return ChosenSamples(
        samples,
        SamplingMode.SURFACE if once else SamplingMode.ADAPTIVE,
        f"{len(samples.points):,} samples of the surface: {plan.why}{words}",
        plan.sides,
        given.shape.open_edges,
        thinned=given.thinned,
        sparse=plan.is_sparse,
        differs=differs,
        worst=worst,
        scan=given.scan,
    )


def _of_passes(plan: Plan, samples: Analysed, passes: int) -> str:
    """Say how samples without pairs were taken."""
    words = f"; closer together where it is thin, in {passes} passes" if passes > 1 else ""
    if plan.effort.passes > 1 and not samples.density.dense_enough and _is_spent(plan, samples):
        words += f", until the budget of {plan.given.settings.budget:,} was spent"
    return words


def _of_pairs(passes: tuple[Pass, ...], in_pairs: int) -> str:
    """Say why and how samples in pairs were taken."""
    close = trials(passes)[0].samples.walls_are_close
    why = "the walls are thin" if close else "the topology was not that of the faces"
    return f"; {why}: samples in pairs" + (f" in {in_pairs} passes" if in_pairs > 1 else "")
