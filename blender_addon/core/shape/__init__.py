# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape that is read: points, triangles and normals, their own frame, and what bounds a volume."""
