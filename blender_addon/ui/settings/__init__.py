# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties, preferences, presets, and what an artist is asked or told once."""
