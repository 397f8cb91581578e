# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin solids as sheets halfway between their walls, with the thickness of each place."""
