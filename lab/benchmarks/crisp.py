# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes of solids whose faces are known exactly, measured to the last digit: a Markdown table.

    python3 lab/benchmarks/crisp.py [--output table.md] [--shapes box wedge] [--samples 4000 20000] [--seeds 0 1 2]
        [--form clean] [--float32] [--as-is] [--no-crisp]

Each mesh is turned at random by its seed, sampled as Sampling Surface does, and its axis computed with the default
settings. Rows: exact, the places of the Voronoi diagram; relaxed, what is shown without crisp places; crisp, what is
shown with them, where the product has them. docs/lab/crisp.md says what the columns are.
"""

import sys
import time

import _module

medial = _module.load()

from support import crisp_measures, crisp_runs, crisp_solids  # noqa: E402  (found through _module)

HEADER = ["shape", "samples", "seed", "places", "facets", "err mean/99/max", "r-d mean/max"]
HEADER += [
    "cov mean/99/max",
    "gap mean/max",
    "rim",
    "area - 1",
    "folds",
    "dents",
    "lines",
    "crossings",
    "pieces, Euler",
    "s",
]


def rows(case: crisp_runs.Case, crisp: bool) -> list[list[str]]:
    start = time.perf_counter()
    made = case.made(crisp)
    seconds = time.perf_counter() - start
    kinds = {"crisp": False} if crisp else {"exact": True, "relaxed": False}
    found = []
    for places, exact in kinds.items():
        measures = cells(made.measured(exact))
        head = [case.name, str(made.samples), str(case.seed), places]
        found.append([*head, *measures, f"{seconds:.1f}"])
        print(" | ".join(found[-1]), file=sys.stderr, flush=True)
    return found


def cells(found: crisp_measures.Found) -> list[str]:
    return [
        str(found.facets),
        spread(found.err),
        f"{found.ball.mean:.1e} {found.ball.most:.1e}",
        spread(found.cov),
        "" if found.gap is None else f"{found.gap.mean:.2g} {found.gap.most:.2g}",
        f"{found.rim:.3f}",
        "" if found.area is None else f"{found.area:.1e}",
        str(found.folds),
        str(found.dents),
        str(found.lines),
        str(found.crossings),
        "{}, {}".format(*found.betti),
    ]


def spread(values: crisp_measures.Spread) -> str:
    return f"{values.mean:.1e} {values.p99:.1e} {values.most:.1e}"


def main() -> None:
    parser = _module.parser(__doc__)
    names = crisp_solids.NAMES
    parser.add_argument("--shapes", nargs="+", default=list(names), choices=names)
    parser.add_argument("--samples", nargs="+", type=int, default=[4_000, 20_000])
    parser.add_argument("--seeds", nargs="+", type=int, default=[0])
    parser.add_argument("--form", default="clean", choices=("clean", "curve"))
    parser.add_argument("--float32", action="store_true", help="round the vertices to float32")
    parser.add_argument("--as-is", action="store_true", help="do not turn the meshes")
    parser.add_argument("--no-crisp", action="store_true", help="leave crisp places out")
    options = parser.parse_args()
    wanted = [False, True] if crisp_runs.knows_crisp() and not options.no_crisp else [False]
    table = [
        row
        for name in options.shapes
        for count in options.samples
        for seed in options.seeds
        for crisp in wanted
        for row in rows(case_of(name, count, seed, options), crisp)
    ]
    _module.publish(_module.markdown(HEADER, table), options.output)


def case_of(name: str, count: int, seed: int, options) -> crisp_runs.Case:
    return crisp_runs.Case(
        name, count, seed, options.float32, as_is=options.as_is, form=options.form
    )


if __name__ == "__main__":
    main()
