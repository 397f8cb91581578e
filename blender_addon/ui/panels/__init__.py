# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels and menus that show the rest."""
