# SPDX-License-Identifier: GPL-3.0-or-later
"""Analyses and hierarchies of the shapes with known axes, clean and noisy, each made once."""

import math
from typing import Any

import numpy as np

from .shapes import SHAPES


class Sampled:
    """(name, n, seed, noise) -> shape, analysis, hierarchy; noise along the normals, in spacings sqrt(area / n)."""

    def __init__(self, medial: Any) -> None:
        self.medial = medial
        self.made: dict[tuple[str, int, int, float], tuple[Any, Any, Any]] = {}

    def __call__(
        self, name: str, n: int = 2000, seed: int = 0, noise: float = 0.0
    ) -> tuple[Any, Any, Any]:
        key = name, n, seed, noise
        if key not in self.made:
            shape = SHAPES[name]
            points = shape.sample(n, seed)
            normals = shape.normals(points)
            if noise:
                away = np.random.default_rng(seed + 1).normal(size=(len(points), 1))
                points = points + noise * math.sqrt(shape.area / n) * away * normals
            analysis = self.medial.MedialAnalysis(points, normals=normals)
            self.made[key] = shape, analysis, analysis.hierarchy()
        return self.made[key]
