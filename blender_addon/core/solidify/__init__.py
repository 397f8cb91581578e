# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed solids of an even wall, made of open sheets."""
