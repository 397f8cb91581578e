# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that the drawings of the docs share: a white page, a legend, and lines."""

WIDTH = 760
INK, RED, ORANGE, PALE = "#1c2833", "#c0392b", "#e08a1e", "#b4bec8"


def picture(title: str, height: int, parts: list[str], legend: list[tuple[str, str]]) -> str:
    """Lines of a legend are (colour, text)."""
    lines = []
    for i, (colour, text) in enumerate(legend):
        y = height - 22 * (len(legend) - i) + 6
        lines.append(f'<rect x="24" y="{y - 9}" width="22" height="10" fill="{colour}"/>')
        lines.append(f'<text x="56" y="{y}" fill="{INK}">{text}</text>')
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" '
            f'height="{height}" font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="14">',
            f"<title>{title}</title>",
            f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
            *parts,
            *lines,
            "</svg>\n",
        ]
    )


def path(points, closed=False) -> str:
    return "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points) + ("Z" if closed else "")


def stroke(points, colour: str, width: float, closed=False, extra="") -> str:
    return (
        f'<path d="{path(points, closed)}" fill="none" stroke="{colour}" stroke-width="{width}" '
        f'stroke-linecap="round" stroke-linejoin="round" {extra}/>'
    )
