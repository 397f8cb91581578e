# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of the sliders on even meshes: a Markdown table.

    python3 lab/benchmarks/even_levels.py [--output table.md] [--meshes spot_low.obj ...]

The default settings of the add-on, with one slider elsewhere. The columns are those of `even_meshes.py`; the seconds
are of the processor of the step, after another step.
"""

import time
from dataclasses import replace

import _module
import even_meshes
import numpy as np

medial = _module.load()

import medial_axis  # noqa: E402  (found through _module)
from support import crisp_measures, meshes  # noqa: E402

HEADER = ["mesh", "slider", "faces", "least angle", "turns", "crossings", "rim", "touch", "Euler"]
HEADER += ["step s"]
SHARES = (0.1, 0.3, 0.6, 0.9)  # of the way of a slider over lengths
STEPS = [{"theta": np.radians(angle)} for angle in (30, 45, 70)]
STEPS += [{"rho": 12.0}, {"rho": 20.0}, {"limb": 8.0}, {"limb": 20.0}]


def rows(name: str) -> list[list[str]]:
    made = medial_axis.compute(*meshes.read(_module.DATA / name))
    ranges = made.axis.level.ranges
    steps = [
        {slider: ranges[slider].length(share)}
        for slider in ("simplify", "erode", "spike")
        if slider in ranges
        for share in SHARES
    ]
    return [row(made, f"{name.rpartition('.')[0]}", step) for step in [{}, *steps, *STEPS]]


def row(made: medial_axis.Computation, name: str, step: dict[str, float]) -> list[str]:
    start = time.process_time()
    axis = medial_axis.extract(made, **step)
    seconds = time.process_time() - start
    slider = ", ".join(f"{setting} {value:.3g}" for setting, value in step.items()) or "none"
    if not axis.facets:
        return [name, slider, "0", *[""] * 6, f"{seconds:.2f}"]
    output = crisp_measures.output_of(replace(made, axis=axis), np.eye(3))
    return [name, slider, *even_meshes.cells(axis, output), f"{seconds:.2f}"]


if __name__ == "__main__":
    even_meshes.main(__doc__, HEADER, rows)
