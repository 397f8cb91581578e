# SPDX-License-Identifier: GPL-3.0-or-later
"""What the axis says about the solid: its thickness, its balls, its reconstruction."""
