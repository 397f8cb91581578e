# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of things in words."""


def counted(number: int, one: str, many: str = "") -> str:
    """Return '1 cavity' or '1,200 cavities', for the words 'cavity' and 'cavities'; many are called `one` with an s."""
    return f"1 {one}" if number == 1 else f"{number:,} {many or one + 's'}"
