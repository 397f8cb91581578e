# SPDX-License-Identifier: GPL-3.0-or-later
"""How thick a solid is at each place, where it is too thin, and walls that are made thicker."""
