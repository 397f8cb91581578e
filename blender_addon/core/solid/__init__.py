# SPDX-License-Identifier: GPL-3.0-or-later
"""Results about the solid: its thickness, few balls that cover it, its reconstruction."""
