# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial axes in Blender: objects of results, what they show, their parts, reports of samples."""
