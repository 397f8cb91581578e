# SPDX-License-Identifier: GPL-3.0-or-later
"""Few balls or capsules that cover a solid, for collisions, physics and robots."""
