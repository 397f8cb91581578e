# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness in Blender: colours and selections of sources, and walls that a modifier moves apart."""
