# SPDX-License-Identifier: GPL-3.0-or-later
"""The cost of reading the faces of a mesh, as a share of a click: a Markdown table.

    python3 lab/benchmarks/reading_cost.py [--output table.md] [--meshes spot_low.obj ...] [--times 3]

Each mesh runs as it is, and with its faces damaged: some of them turned, all of them, holes cut into it, faces twice.
Read: which side of the faces is outside, and whether sheets are left out. Parts: how the connected parts lie to each
other. Click: the whole medial axis with default settings. Each is the least processor time of several turns in one
process, so the shares do not depend on how busy the machine is. The data folder is MEDIAL_AXIS_TEST_DATA.
"""

import sys
import time
from collections.abc import Callable

import _module
import numpy as np

medial = _module.load()

from medial_axis.core.axis.compute import compute_axis  # noqa: E402
from medial_axis.core.errors import MedialAxisError  # noqa: E402
from medial_axis.core.machine.cache import CACHE  # noqa: E402
from medial_axis.core.samples.mesh_parts import without_sheets  # noqa: E402
from medial_axis.core.settings import Settings  # noqa: E402
from medial_axis.core.shape.mesh_counts import mesh_counts  # noqa: E402
from medial_axis.core.shape.outward_faces import outward_shape  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from support import meshes, messy  # noqa: E402

HEADER = ["mesh", "faces", "as", "read, s", "parts, s", "click, s", "share of the click"]


def with_turned(mesh: meshes.Mesh, share: float) -> meshes.Mesh:
    points, triangles = mesh
    turned = np.random.default_rng(0).random(len(triangles)) < share
    return points, np.where(turned[:, None], triangles[:, ::-1], triangles)


def cut_apart(mesh: meshes.Mesh) -> meshes.Mesh:
    return mesh[0][mesh[1]].reshape(-1, 3), np.arange(mesh[1].size, dtype=np.int32).reshape(-1, 3)


STATES: dict[str, Callable[[meshes.Mesh], meshes.Mesh]] = {
    "it is": lambda mesh: mesh,
    "1 % turned": lambda mesh: with_turned(mesh, 0.01),
    "50 % turned": lambda mesh: with_turned(mesh, 0.5),
    "all turned": lambda mesh: with_turned(mesh, 1.0),
    "with holes": messy.with_holes,
    "all doubled": messy.doubled_faces,
    "cut apart, 10 % turned": lambda mesh: cut_apart(with_turned(mesh, 0.1)),
}


def least(times: int, work: Callable[[], object]) -> float:
    """The least processor time of several turns."""
    spent = []
    for _ in range(times):
        CACHE.clear()
        start = time.process_time()
        work()
        spent.append(time.process_time() - start)
    return min(spent)


def row(name: str, state: str, mesh: meshes.Mesh, times: int) -> list[str]:
    shape, settings = Shape(*mesh), Settings()
    read = outward_shape(shape)
    reading = least(times, lambda: without_sheets(outward_shape(shape), settings))
    parts = least(times, lambda: mesh_counts(read))
    try:
        click = least(times, lambda: compute_axis(shape, settings))
    except MedialAxisError as error:
        print(f"{name}, {state}: {error}", file=sys.stderr)
        return []
    share = f"{(reading + parts) / click:.1%}"
    seconds = [f"{reading:.3f}", f"{parts:.3f}", f"{click:.2f}"]
    print(name, state, *seconds, share, file=sys.stderr, flush=True)
    return [name, f"{len(mesh[1]):,}", state, *seconds, share]


def main() -> None:
    parser = _module.parser(__doc__)
    known = [name for name in messy.CLOSED if (_module.DATA / name).is_file()]
    parser.add_argument("--meshes", nargs="+", default=known)
    parser.add_argument("--states", nargs="+", default=[*STATES], choices=STATES)
    parser.add_argument("--times", type=int, default=3)
    wanted = parser.parse_args()
    rows = []
    for name in wanted.meshes:
        mesh = messy.load(name, lambda file: _module.DATA / file)
        rows += [row(name, state, STATES[state](mesh), wanted.times) for state in wanted.states]
    _module.publish(_module.markdown(HEADER, list(filter(None, rows))), wanted.output)


if __name__ == "__main__":
    main()
