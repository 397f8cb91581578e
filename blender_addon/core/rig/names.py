# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones are named by what the shape shows of their chains, in order from head to tail and from the root outwards.

Where a body has two sides, its root is called pelvis if limbs go out on both; the bones between the sides are called
spine, head and tail. The limbs of a pair that leaves the pelvis are legs, and so are those that reach at least half as
far in their direction; of a body with one pair of legs the longest other pair that leaves the spine are arms. Which
way the body is turned does not matter. `arm.02.L` is the second bone of the left arm, and `leg.01.02.L` that of the
first of several legs. All else is called limb: `limb.02.03.L` is the third bone of the second limb, `limb.02.03.R` its
mirror image; chains between forks are called trunk. Left means positive X, as in Blender.
"""

from __future__ import annotations

from ..arrays import Floats
from ..small_matrices import dot
from .bones import Body
from .roll import upright

_REACH = 0.5  # of the way of the hind legs: legs reach at least so far; chosen: unseen


def names_of(bodies: list[Body], count: int) -> list[str]:
    """Return a name for each of `count` bones; those of further bodies begin with a number."""
    names = [""] * count
    for number, body in enumerate(bodies):
        for bone, name in _names_of_body(body).items():
            names[bone] = name if number == 0 else f"{number + 1:02d}.{name}"
    return names


def limbs_of(bodies: list[Body]) -> list[list[int]]:
    """Return the bones of each limb, that is of each chain that ends in a tip, without the root."""
    found = [
        [bone for bone in bones if bone != body.root]
        for body in bodies
        for chain, bones in zip(body.tree, body.bones, strict=True)
        if chain.to_tip
    ]
    return [bones for bones in found if bones]


def _names_of_body(body: Body) -> dict[int, str]:
    forked = any(
        chain.parent < 0 and body.sides.partner[n] >= 0 for n, chain in enumerate(body.tree)
    )
    middle = _of_the_middle(body)
    names: dict[int, str] = {}
    for word, chains in middle.items():
        bones = [bone for number in chains for bone in body.bones[number] if bone != body.root]
        names |= {bone: f"{word}.{step + 1:02d}" for step, bone in enumerate(bones)}
    rest = [n for n in _from_head_to_tail(body) if not any(n in m for m in middle.values())]
    arms, legs = _arms_and_legs(body, _with_partners(body, rest), {-1, *middle.get("spine", ())})
    named = [n for pair in arms + legs for n in pair.values()]
    trunks, limbs = (
        _with_partners(body, [n for n in rest if body.tree[n].to_tip == to_tip and n not in named])
        for to_tip in (False, True)
    )
    for word, pairs in {"arm": arms, "leg": legs, "trunk": trunks, "limb": limbs}.items():
        alone = word == "arm" or (word == "leg" and len(pairs) == 1)
        for number, pair in enumerate(pairs):
            stem = word if alone else f"{word}.{number + 1:02d}"
            for side, chain in pair.items():
                bones = [bone for bone in body.bones[chain] if bone != body.root]
                names |= {bone: f"{stem}.{step + 1:02d}{side}" for step, bone in enumerate(bones)}
    return names | {body.root: "pelvis" if forked else "root"}


def _arms_and_legs(
    body: Body, pairs: list[dict[str, int]], middle: set[int]
) -> tuple[list[dict[str, int]], list[dict[str, int]]]:
    """Return the pairs of chains that are arms and those that are legs; both leave the chains of the middle."""
    pairs = [pair for pair in pairs if len(pair) == 2 and body.tree[pair[".L"]].parent in middle]
    hind = [pair for pair in pairs if body.tree[pair[".L"]].parent < 0]
    if not hind:
        return [], []

    def length(pair: dict[str, int]) -> float:
        return body.tree[pair[".L"]].length

    def mean(pair: dict[str, int], row: int) -> Floats:
        left, right = (body.tree[number].points[row] for number in pair.values())
        return (left + right) / 2

    longest = max(hind, key=length)
    start = mean(longest, 0)
    down = mean(longest, -1) - start
    legs = [p for p in pairs if float(dot(mean(p, -1) - start, down)) >= _REACH * dot(down, down)]
    others = [pair for pair in pairs if pair not in legs]
    return ([max(others, key=length)] if others and len(legs) == 1 else []), legs


def _of_the_middle(body: Body) -> dict[str, list[int]]:
    """Return the chains of spine, head and tail, from the root outwards; there are none without two sides."""
    if not body.sides.found or body.spine < 0:
        return {}
    way = [body.spine]
    while (after := body.goes_on[way[-1]]) >= 0 and body.sides.within[after]:
        way.append(after)
    head = way[-1:] if len(way) > 1 and body.tree[way[-1]].to_tip else []
    tails = [
        number
        for number, chain in enumerate(body.tree)
        if chain.parent < 0 and chain.to_tip and body.sides.within[number] and number not in way
    ]
    tail = max(tails, key=lambda n: (body.tree[n].length, -n), default=None)
    return {
        "spine": [number for number in way if number not in head],
        "head": head,
        "tail": [] if tail is None else [tail],
    }


def _from_head_to_tail(body: Body) -> list[int]:
    """Return the chains by the place where their way leaves the spine, that farthest from the root first.

    Of those that leave at one place the nearest to the root comes first, then the longest, then the highest.
    """
    up, _ = upright(body.sides.normal)
    spine = {body.spine}
    leaves = [0.0] * len(body.tree)  # how far from the root, along the spine
    for number, chain in enumerate(body.tree):
        if chain.parent in spine:
            leaves[number] = chain.from_root
            if body.goes_on[chain.parent] == number:
                spine.add(number)
        elif chain.parent >= 0:
            leaves[number] = leaves[chain.parent]
    size = max(chain.from_root + chain.length for chain in body.tree)

    def key(number: int) -> tuple[float, ...]:
        chain = body.tree[number]
        rise = float(dot(chain.points[-1] - chain.points[0], up))
        shares = (leaves[number], -chain.from_root, chain.length, rise)
        return tuple(-round(share / size, 2) for share in shares)

    return sorted(range(len(body.tree)), key=key)


def _with_partners(body: Body, chains: list[int]) -> list[dict[str, int]]:
    """Return the chains in order, by side: those that are a pair come together."""
    found = []
    for number in chains:
        other = int(body.sides.partner[number])
        if other < 0:
            found.append({"": number})
        elif body.sides.is_left(body.tree[number]):
            found.append({".L": number, ".R": other})
    return found


def target_of(name: str, number: int = 0) -> str:
    """Return the name for a control of a limb from that of its first bone.

    `limb.02.01.L` gives `IK.limb.02.L` for the target of the limb, and `IK.limb.02.01.L` for the control with a number.
    """
    stem, _, side = name.rpartition(".")
    sided = side in ("L", "R")
    words = ["IK", stem.rpartition(".")[0] if sided else stem]
    words += [f"{number:02d}"] if number else []
    return ".".join(words + ([side] if sided else []))
