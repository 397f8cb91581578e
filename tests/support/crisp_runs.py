# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes of the solids of `crisp_solids` by the library's entry, and their measures."""

from dataclasses import dataclass
from typing import Any

from . import crisp_measures, crisp_solids, inputs

ROUND = ("plate", "stadium")


@dataclass(frozen=True)
class Case:
    """`seed` turns the mesh and chooses the samples; `single` rounds the mesh to float32."""

    name: str
    count: int
    seed: int = 0
    single: bool = False
    as_is: bool = False
    form: str = "clean"
    mesh: str = "even"

    def __str__(self) -> str:
        return f"{self.name}-{self.count}-{self.seed}{'-float32' * self.single}"

    def made(self, crisp: bool) -> "Made":
        import medial_axis

        solid = crisp_solids.solid(self.name)
        turn = None if self.as_is else self.seed
        mesh, frame = crisp_solids.turned(solid.mesh, turn, self.single)
        if self.name in ROUND:
            mesh = inputs.of_any_processor(mesh)
        chosen = {"samples": self.count, "seed": self.seed, "form": self.form, "mesh": self.mesh}
        return Made(
            self, medial_axis.compute(*mesh, sampling="surface", crisp=crisp, **chosen), frame
        )


@dataclass(frozen=True, eq=False)
class Made:
    case: Case
    computation: Any
    frame: crisp_solids.Array

    @property
    def samples(self) -> int:
        return len(self.computation.chosen.samples.points)

    def output(self, exact: bool = False) -> crisp_measures.Output:
        return crisp_measures.output_of(self.computation, self.frame, exact)

    def measured(self, exact: bool = False) -> crisp_measures.Found:
        """Measures of what is shown, or of the same cells at the places of the Voronoi diagram."""
        solid = crisp_solids.solid(self.case.name)
        return crisp_measures.measured(solid, self.output(exact), self.samples)
