# SPDX-License-Identifier: GPL-3.0-or-later
"""Points, meshes and axes as files; docs/formats.md describes them."""
