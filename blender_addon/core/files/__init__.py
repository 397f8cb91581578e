# SPDX-License-Identifier: GPL-3.0-or-later
"""This package reads and writes files of points, meshes and axes; docs/formats.md describes them."""
