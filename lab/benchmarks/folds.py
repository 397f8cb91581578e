# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the skin folds where one bone of a rig turns: a Markdown table.

    python3 lab/benchmarks/folds.py [--output table.md] [--files hand_closed.obj ...] [--angles 40 60]

Each bone that has a parent turns about its first axis, to both sides, and about its third one; what is below it goes
along. Vertices follow the linear mean of their bones by their weights. A triangle is folded if its normal looks against
the one that the mean of its corners' turns gives it. The columns are the mean and the largest share of the surface at
rest that is folded, in percent: with the weights of the rig, and rigid, where each vertex follows its first bone alone.
Needs the optional data folder (MEDIAL_AXIS_TEST_DATA).
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import _module
import numpy as np
from scipy.spatial.transform import Rotation

_module.load()

from medial_axis.core.files.read_shape import read_shape  # noqa: E402  (found through _module)
from medial_axis.core.rig.bones import Bones  # noqa: E402
from medial_axis.core.rig.rig import Rig, compute_rig  # noqa: E402
from medial_axis.core.settings import Settings, SkeletonSettings  # noqa: E402

FILES = ["hand_closed.obj", "spot_low.obj", "dilo.off", "human_woman.obj"]
HEADER = ["mesh", "bones", "degrees", "weights: mean", "largest", "rigid: mean", "largest"]


def moves_with(bones: Bones, bone: int) -> np.ndarray:
    """(n,) whether each bone is the given one or below it; parents come first."""
    moves = np.zeros(bones.count, np.bool_)
    moves[bone] = True
    for child in range(bone + 1, bones.count):
        moves[child] = bones.parent[child] >= 0 and moves[bones.parent[child]]
    return moves


def turns_of(bones: Bones, bone: int, angle: float) -> Iterator[np.ndarray]:
    """The rotations about the first axis, to both sides, and about the third one."""
    along = bones.tail[bone] - bones.head[bone]
    third = bones.up[bone]
    first = np.cross(along / np.linalg.norm(along), third)
    for axis, size in ((first, angle), (first, -angle), (third, angle)):
        yield Rotation.from_rotvec(size * axis).as_matrix()


def folded_share(
    points: np.ndarray, triangles: np.ndarray, share: np.ndarray, turn: np.ndarray, head: np.ndarray
) -> float:
    """The share of the area at rest that is folded, where vertices follow a turn about a place by their share."""
    follow = share[:, None]
    posed = (1.0 - follow) * points + follow * ((points - head) @ turn.T + head)
    rest, now = (_normals(places[triangles]) for places in (points, posed))
    mean = share[triangles].mean(axis=1)[:, None]
    wanted = (1.0 - mean) * rest + mean * (rest @ turn.T)
    area = np.linalg.norm(rest, axis=1)
    return float(area[np.sum(now * wanted, axis=1) < 0.0].sum() / area.sum())


def _normals(corners: np.ndarray) -> np.ndarray:
    a, b, c = corners.transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def shares(rig: Rig, points: np.ndarray, triangles: np.ndarray, degrees: float) -> np.ndarray:
    """(p, 2) the folded share in each pose, with the weights of the rig and by the first bone alone."""
    found = []
    for bone in np.flatnonzero(rig.bones.parent >= 0).tolist():
        moves = moves_with(rig.bones, bone)
        by_weight = np.where(moves[rig.bone], rig.weight, 0.0).sum(axis=1)
        rigid = moves[rig.bone[:, 0]].astype(np.float64)
        head = rig.bones.head[bone]
        for turn in turns_of(rig.bones, bone, np.radians(degrees)):
            kinds = (by_weight, rigid)
            found.append([folded_share(points, triangles, kind, turn, head) for kind in kinds])
    return np.array(found)


def rows(files: list[str], angles: list[float]) -> Iterator[list[str]]:
    for name in files:
        shape, _ = read_shape(_module.DATA / name)
        rig = compute_rig(shape, Settings(), SkeletonSettings())
        for degrees in angles:
            found = 100.0 * shares(rig, shape.points, shape.triangles, degrees)
            cells = [f"{of(axis=0)[kind]:.2g}" for kind in (0, 1) for of in (found.mean, found.max)]
            yield [Path(name).stem, str(rig.bones.count), f"{degrees:g}", *cells]


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--files", nargs="*", default=FILES)
    parser.add_argument("--angles", nargs="*", type=float, default=[40.0, 60.0])
    options = parser.parse_args()
    _module.tell(HEADER, rows(options.files, options.angles), options.output)


if __name__ == "__main__":
    main()
