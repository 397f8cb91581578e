# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages for users name every option with its default; figures come from tables of the laboratory."""

import csv
import math
import re

import pytest
from medial_axis.core import settings
from medial_axis.core.options import Choice, Number, Switch
from support.package import ROOT

pytestmark = pytest.mark.docs

# The options that the table of a page describes.
DESCRIBED = {
    "user_guide": ("OPTIONS", "LOOKS", "DIVISION"),
    "skeleton": ("SKELETON_OPTIONS", "RIG_OPTIONS"),
    "thickness": ("THICKNESS_OPTIONS", "THICKEN_OPTIONS"),
    "mid_surface": ("MID_SURFACE_OPTIONS",),
    "hollow": ("HOLLOW_OPTIONS", "DRAIN_OPTIONS"),
    "solidify": ("SOLIDIFY_OPTIONS",),
    "balls": ("BALL_OPTIONS",),
}


def defaults(page):
    """The first word of the last cell of each row with three cells or more, by the label in its first cell."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([\w. ]+?)(?: \(`\w+`\))? \|.*\| ([^|]+?) \|$", text, re.MULTILINE)
    return dict(rows)


def shown(option):
    """A default as the panel shows it."""
    if isinstance(option, Switch):
        return "on" if option.default else "off"
    if isinstance(option, Choice):
        return option.items[option.default][0]
    value = option.default
    if isinstance(option, Number) and option.unit == "rad":
        value = math.degrees(value)
    return f"{value:,g}" if isinstance(value, float) else f"{value:,}"


@pytest.mark.parametrize("page", DESCRIBED)
def test_every_option_has_its_default(page):
    options = [option for name in DESCRIBED[page] for option in getattr(settings, name).values()]
    table = defaults(page)
    wrong = {
        option.label: (shown(option), table.get(option.label))
        for option in options
        if re.split(r"[:°%]", table.get(option.label, ""))[0].strip() != shown(option)
    }
    assert wrong == {}


def test_the_shares_of_noisy_samples_in_the_readme():
    """The README says how many of 30 noisy samples keep their topology, by the table of the laboratory."""
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    said = re.search(r"Of 30 samples of exact shapes, (\d+), (\d+) and (\d+) keep", readme).groups()
    right = {"0.25": 0, "0.5": 0, "1": 0}
    with open(ROOT / "docs" / "lab" / "scans_shapes.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            right[row["noise"]] += int(row["right, prepared"])
    assert [int(number) for number in said] == list(right.values())


def test_the_cost_of_a_click_in_the_readme():
    """The README has the most processor seconds for each 100,000 vertices, by the table of the laboratory."""
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    said = re.search(r"up to (\d+) seconds of one processor core for each 100,000", readme)[1]
    with open(ROOT / "docs" / "lab" / "performance_clicks.csv", encoding="utf-8") as file:
        costs = [
            float(row["processor seconds"]) / float(row["vertices"]) for row in csv.DictReader(file)
        ]
    assert int(said) == math.ceil(1e5 * max(costs))
