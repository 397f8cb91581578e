# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's data in and out: objects to arrays, medial axes to objects. No user interface."""
