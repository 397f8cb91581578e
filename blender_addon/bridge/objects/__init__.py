# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of Blender: shapes read from them, results written next to their sources, what is outdated."""
