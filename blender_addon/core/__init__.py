# SPDX-License-Identifier: GPL-3.0-or-later
"""The method for Python, without Blender: settings, analysis, files."""
