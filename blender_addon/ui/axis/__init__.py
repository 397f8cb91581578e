# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators of medial axes, and the figures of what is selected."""
