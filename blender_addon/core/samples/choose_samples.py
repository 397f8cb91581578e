# SPDX-License-Identifier: GPL-3.0-or-later
"""The choice of the points that are analysed: the vertices as they are, or dense enough samples of the faces.

A shape is prepared, a plan decided on, and then passes are made, each of which takes samples, analyses and judges them
(docs/architecture.md). This is the only file of the room that knows the cache, the memory and the progress.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import Any

from ..arrays import Floats
from ..errors import DegenerateInputError, MemoryLimitError
from ..machine.cache import CACHE, bytes_of, key_of
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings, SidesFrom
from ..shape.shape import Shape
from .analysed import Analysed, Kept
from .analysis import analyse, vertices_of
from .chosen import Begun, ChosenSamples
from .decide import Plan, decide
from .doubts import Topology, betti_of, doubts_of, no_doubts
from .judge import Again, Compare, Pass, compares, finish, instead_of_vertices, judge, trials
from .prepare import Input, prepare
from .sample_spacing import Amount
from .surface_samples import close_openings, sample_faces
from .thinning import thinned

_WRAPPING = 0.4  # of the analysis; work: progress
_PREPARING = 0.3  # of the analysis of points without faces; work: progress
_LEVELS = 0.9  # the share of all work that ends with the first hierarchy; work: progress
# The share of the work left that a pass is shown as: nobody knows how many there will be.
_OF_REST = 0.3  # work: progress


def begin(
    shape: Shape,
    settings: Settings,
    progress: Progress | None,
    limit: MemoryLimit,
    share: float = 1.0,
    levels: bool = False,
) -> Begun:
    """Begin a computation: turn the faces of a shape outward, choose samples and analyse them.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        `side` is not AUTOMATIC.
    progress : Progress or None
    limit : MemoryLimit
    share : float
        The share of the whole work that the analysis is.
    levels : bool
        The hierarchy will be needed, so it may as well be computed while samples are chosen.
    """
    start, progress = time.perf_counter(), progress or Progress()
    progress.until(share)
    part = _WRAPPING if settings.sides is SidesFrom.WRAP else _PREPARING
    given = prepare(shape, settings, progress.part(part))
    passes = _Passes(progress, limit, levels)
    chosen = passes.chosen(given)
    progress.until(1.0)
    return Begun(given.read, chosen, progress, start, given.given)


@dataclass(frozen=True)
class _Passes:
    """The loop, and what it uses of the machine; `levels` as in `begin`."""

    progress: Progress
    limit: MemoryLimit
    levels: bool

    def chosen(self, given: Input) -> ChosenSamples:
        """Make passes until the samples of one are chosen."""
        plan = decide(given)
        step: Again | Compare | ChosenSamples = Again(plan, plan.first)
        while not isinstance(step, ChosenSamples):
            step = self._next(step)
        self.progress.begin_pass(1)
        self.progress.begin_share(1.0)
        return step

    def _next(self, step: Again | Compare) -> Again | Compare | ChosenSamples:
        """Take a step and judge it; where the memory is short, samples without pairs have to do, or fewer points."""
        try:
            passes = self._made(step) if isinstance(step, Again) else self._compared(step)
        except MemoryLimitError as error:
            if trials(step.passes):
                return finish(step.plan, step.passes)
            if step.plan.given.thinned:
                raise
            plan = decide(thinned(step.plan.given, self.limit, error))
            return Again(plan, plan.first)
        except DegenerateInputError:
            if not step.plan.is_trial:
                raise
            return instead_of_vertices(step.plan, "the vertices alone span no volume", True)
        return judge(step.plan, passes)

    def _made(self, step: Again) -> tuple[Pass, ...]:
        """Take samples and analyse them; once the topology was compared, compare theirs, too."""
        plan, amount, passes = step.plan, step.amount, step.passes
        compared = trials(passes)
        self.progress.begin_pass(1 + len(compared or passes))
        if compared:
            self.progress.begin_share(_OF_REST)
        found = self._analysed(plan, amount)
        topology = self._topology(plan, found) if compared else None
        return (*passes, Pass(amount, found, topology))

    def _analysed(self, plan: Plan, amount: Amount) -> Analysed:
        """Return the samples of a pass, from the cache or taken and analysed, with what the settings call dense.

        Only those of a first pass may be too many for the memory: the budget bounds the others.
        """
        options, share, part = _options(plan.given, amount), amount.share, self.progress.part
        key = _key(plan, amount, options)
        found = CACHE.get(key)
        if found is None:
            samples = vertices_of(plan)
            if plan.of_faces and amount.sizing is None:
                self.limit.check(amount.count)
            if plan.of_faces:
                samples = sample_faces(plan, options, part(0.2 * share))
            if plan.closes_openings:
                samples = close_openings(plan, samples, part(0.1 * share))
            self.limit.check(len(samples.points))
            first = samples.spacing if amount.sizing is None else amount.spacing
            found = analyse(plan, samples, first, options, part(share))
            found = replace(found, kept=Kept(key))
            CACHE.put(key, found, bytes_of(found))
        settings, finest = plan.given.settings, plan.effort.at_edges * found.spacing
        density = replace(found.density, limit=settings.epsilon, finest=finest)
        if settings.has_crisp_places and compares(plan, found) and found.plates is not None:
            density = density.with_plates(found.plates)
        return replace(found, density=density)

    def _compared(self, step: Compare) -> tuple[Pass, ...]:
        """Compare the topology of the last pass, whose hierarchy will be needed if it is right.

        Samples of walls that are too close are replaced whatever they show.
        """
        self.progress.begin_pass(1)
        *passes, last = step.passes
        found = last.samples
        assert found.by_faces is not None
        if found.walls_are_close:
            topology = Topology(found.by_faces, *no_doubts())
        elif self.levels:
            topology = self._topology_of_levels(step.plan, found)
        else:
            topology = self._topology(step.plan, found)
        return (*passes, replace(last, topology=topology))

    def _topology_of_levels(self, plan: Plan, found: Analysed) -> Topology:
        self.progress.until(_LEVELS)
        settings = plan.given.settings
        solid = found.solid if settings.crisp else None
        betti = betti_of(found, settings, self.progress.part(0.5), solid)
        same = betti == found.by_faces
        return Topology(betti, *(no_doubts() if same else self._doubts(plan, found)))

    def _topology(self, plan: Plan, found: Analysed) -> Topology:
        """Samples without pairs and without a doubt are taken to have the topology of the faces."""
        places, gaps = self._doubts(plan, found)
        if not len(gaps) and found.partners is None and found.by_faces is not None:
            return Topology(found.by_faces, places, gaps)
        betti = betti_of(found, plan.given.settings, self.progress.part(0.5))
        return Topology(betti, places, gaps)

    def _doubts(self, plan: Plan, found: Analysed) -> tuple[Floats, Floats]:
        return doubts_of(plan.given.shape, found, self.progress.part(0.05))


def _options(given: Input, amount: Amount) -> dict[str, Any]:
    """Return the arguments of `_medial.sample_surface` beside the surface."""
    settings, flat = given.settings, amount.flat
    options = {
        "sharp_angle": flat or given.sharp,
        "smooth": settings.smooth and not flat,
        "keep_vertices": settings.keep_vertices,
        "pairs": settings.pairs or amount.pairs,
        "seed": settings.seed,
    }
    if amount.by_spacing:
        return {**options, "spacing": amount.spacing}
    sizing = {} if amount.sizing is None else {"sizing": amount.sizing}
    return {**options, **sizing, "count": amount.count}


def _key(plan: Plan, amount: Amount, options: dict[str, Any]) -> str:
    """Name all that an analysis depends on."""
    shape, source = plan.given.shape, plan.sides.source
    if plan.of_faces:
        surface = (shape.points, shape.triangles, shape.sharp_edges, shape.offset)
        first = 0.0 if amount.sizing is None else amount.spacing
        return key_of(plan.has_sphere, source, surface, tuple(options.items()), first)
    normals = shape.normals if source is SidesFrom.NORMALS else None
    edges = (shape.triangles, options["sharp_angle"], shape.sharp_edges)
    faces = edges if source is SidesFrom.SURFACE else None
    return key_of(plan.has_sphere, source, shape.points, shape.rows, normals, faces, shape.offset)
