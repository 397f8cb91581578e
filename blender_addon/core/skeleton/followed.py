# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences tell where bones could not follow a mesh through frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .follow import Follower, Pose

_LEFT = 0.1  # a bone is left where so much of its weights is farther off than it is thick
_NAMED = 3  # so many bones are named in a sentence


class Followed:
    """The frames that were followed, and how far the mesh was off there.

    Parameters
    ----------
    names : list of str
        The bones.
    thickness : (b,) float64
        The mean distance of the vertices of each bone from it, at rest.
    stretch : bool
        Whether bones change their lengths.

    Attributes
    ----------
    off : dict of int to float
        The root mean square of the distances of the vertices of each frame from where the bones put them, as a share
        of the diagonal of the mesh.
    """

    def __init__(
        self, names: list[str], thickness: NDArray[np.float64], stretch: bool = False
    ) -> None:
        self._names, self._thickness, self._stretch = names, thickness, stretch
        self.off: dict[int, float] = {}
        self._left: dict[int, list[tuple[float, int]]] = {}  # the share and the frame, of each bone
        self._others: list[int] = []  # frames with other vertices

    def add(self, frame: int, follower: Follower, pose: Pose, places: NDArray[np.float64]) -> None:
        """Compare the vertices of a frame, (v, 3), with where the pose of the bones puts them."""
        off = follower.off(pose, places)
        self.off[frame] = float(np.sqrt((off**2).mean())) / follower.size
        self._tell(frame, follower.share_beyond(off, self._thickness))

    def add_back(
        self, frame: int, back: NDArray[np.float64], owner: NDArray[np.int64], size: float
    ) -> None:
        """Compare a frame with other vertices, after `add`: how far its own vertices are from the posed mesh.

        Parameters
        ----------
        frame : int
        back : (k,) float64
        owner : (k,) int64
            The bone of the nearest vertex of the posed mesh; -1 for none.
        size : float
            The diagonal of the mesh.
        """
        self._others.append(frame)
        self.off[frame] = max(self.off[frame], float(np.sqrt((back**2).mean())) / size)
        some, count = owner >= 0, len(self._names)
        beyond = back[some] > self._thickness[owner[some]]
        whole = np.maximum(np.bincount(owner[some], minlength=count), 1)
        self._tell(frame, np.bincount(owner[some], beyond, count) / whole)

    def _tell(self, frame: int, beyond: NDArray[np.float64]) -> None:
        """Remember the bones that the mesh has left at a frame, by the share that is beyond them."""
        for bone in np.flatnonzero(beyond > _LEFT).tolist():
            self._left.setdefault(bone, []).append((float(beyond[bone]), frame))

    @property
    def worst(self) -> tuple[int, float]:
        """Return the frame at which the mesh is farthest off, the first of several, and how far."""
        return max(self.off.items(), key=lambda item: (item[1], -item[0]))

    @property
    def warnings(self) -> list[str]:
        """Return sentences about frames with other vertices, and about bones that the mesh left."""
        return [*self._told_others(), *self._told_left()]

    def _told_others(self) -> list[str]:
        if not self._others:
            return []
        return [
            f"The mesh has other vertices or faces in {len(self._others)} frames, from {min(self._others)} to "
            f"{max(self._others)}: the bones follow the nearest places there, which may slide along the surface"
        ]

    def _told_left(self) -> list[str]:
        if not self._left:
            return []
        frames = sorted({frame for found in self._left.values() for _, frame in found})
        most = sorted(self._left, key=lambda bone: (-max(self._left[bone])[0], bone))
        named = [f"'{self._names[bone]}'" for bone in most[:_NAMED]]
        more = len(self._left) - len(named)
        words = ", ".join(named) + (f" and {more} more" if more else "")
        if self._stretch:
            return [
                f"The surface leaves {words} by more than their thickness in {len(frames)} frames, from {frames[0]} "
                f"to {frames[-1]}: a branch is born or gone"
            ]
        return [
            f"The surface leaves {words} by more than their thickness in {len(frames)} frames, from {frames[0]} to "
            f"{frames[-1]}: a branch is born or gone, or lengths change, which bones keep without Stretch"
        ]
