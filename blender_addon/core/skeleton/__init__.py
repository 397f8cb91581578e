# SPDX-License-Identifier: GPL-3.0-or-later
"""This package turns the levels of the axis into a skeleton: branches with radii and the parts of a body."""
