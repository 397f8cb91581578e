# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of Blender: arrays and attributes in and out, materials, colours."""
