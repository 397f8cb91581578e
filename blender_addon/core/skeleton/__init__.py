# SPDX-License-Identifier: GPL-3.0-or-later
"""From the levels of the axis to a skeleton: branches with radii, parts, bones, weights."""
