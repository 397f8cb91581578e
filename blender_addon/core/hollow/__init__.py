# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids with a cavity, so that a wall of one thickness is left."""
