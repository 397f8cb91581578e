# SPDX-License-Identifier: GPL-3.0-or-later
"""Skeletons and armatures in Blender, and sequences of frames."""
