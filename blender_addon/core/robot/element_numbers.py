# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of an element's attributes, and the turns that they mean."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..counted import counted
from ..errors import ReadError
from ..portable_angle import turn_about
from ..small_matrices import times
from .xml_spans import Element


def numbers_of(
    element: Element, name: str, count: int, usual: str = "", signed: bool = False
) -> Floats:
    """Return the numbers of an attribute: `count` finite ones, above 0 unless signed."""
    text = element.attributes.get(name, usual)
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.empty(0)
    right = len(numbers) == count and np.isfinite(numbers).all()
    if not right or not (signed or (numbers > 0).all()):
        above = "" if signed else " above 0"
        raise ReadError(
            f"Expected {counted(count, 'number')}{above} as {name} of <{element.tag}>, found '{text}'; correct it"
        )
    return numbers


def turn_of(angles: Floats, order: str) -> Floats:
    """Return the matrix of turns one after the other: about axes that stay, 'XYZ', or that are turned along, 'xyz'."""
    turn = np.identity(3)
    for angle, letter in zip(angles.tolist(), order, strict=True):
        about = turn_about(np.identity(3)["xyz".index(letter.lower())], angle)
        turn = times(about, turn.T) if letter.isupper() else times(turn, about.T)
    return turn
