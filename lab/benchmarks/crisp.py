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

from support import crisp_measures, crisp_solids  # noqa: E402  (found through _module)

HEADER = ["shape", "samples", "seed", "places", "facets", "err mean/99/max", "r-d mean/max"]
HEADER += ["cov mean/99/max", "gap mean/max", "rim", "area - 1", "folds", "crossings", "pieces, Euler", "s"]


def knows_crisp() -> bool:
    from medial_axis.core.settings import OPTIONS

    return "crisp" in OPTIONS


def computed(mesh, count: int, seed: int, form: str, crisp: bool):
    """A `Computation` through the library's entry; the option `crisp` is given where it exists."""
    import medial_axis

    more = {"crisp": crisp} if knows_crisp() else {}
    return medial_axis.compute(
        *mesh, sampling="surface", samples=count, seed=seed, form=form, **more
    )


def rows(name: str, count: int, seed: int, options) -> list[list[str]]:
    solid = crisp_solids.solid(name)
    turn = None if options.as_is else seed
    mesh, frame = crisp_solids.turned(solid.mesh, turn, options.float32)
    wanted = [False, True] if knows_crisp() and not options.no_crisp else [False]
    made = []
    for crisp in wanted:
        start = time.perf_counter()
        found = computed(mesh, count, seed, options.form, crisp)
        seconds = time.perf_counter() - start
        samples = len(found.chosen.samples.points)
        for exact in (False,) if crisp else (True, False):
            places = "crisp" if crisp else "exact" if exact else "relaxed"
            output = crisp_measures.output_of(found, frame, exact)
            measured = crisp_measures.measured(solid, output, samples)
            made.append([name, str(samples), str(seed), places, *cells(measured), f"{seconds:.1f}"])
            print(" | ".join(made[-1]), file=sys.stderr, flush=True)
    return made


def cells(found: crisp_measures.Found) -> list[str]:
    return [
        str(found.facets),
        spread(found.err),
        f"{found.ball.mean:.1e} {found.ball.most:.1e}",
        spread(found.cov),
        f"{found.gap.mean:.2f} {found.gap.most:.2f}",
        f"{found.rim:.3f}",
        "" if found.area is None else f"{found.area:.1e}",
        str(found.folds),
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
    table = [
        row
        for name in options.shapes
        for count in options.samples
        for seed in options.seeds
        for row in rows(name, count, seed, options)
    ]
    _module.publish(_module.markdown(HEADER, table), options.output)


if __name__ == "__main__":
    main()
