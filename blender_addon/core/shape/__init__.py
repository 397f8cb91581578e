# SPDX-License-Identifier: GPL-3.0-or-later
"""What the input is: points, triangles and normals, their own frame, and what bounds a volume."""
