# SPDX-License-Identifier: GPL-3.0-or-later
"""Few balls with edges and triangles for a whole axis, and the solid that the balls of an axis rebuild."""
