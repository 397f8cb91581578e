# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones with names, rolls and weights from a skeleton."""
