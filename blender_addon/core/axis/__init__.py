# SPDX-License-Identifier: GPL-3.0-or-later
"""From analysed samples to the medial axis, its topology, and warnings about it."""
