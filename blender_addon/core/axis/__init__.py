# SPDX-License-Identifier: GPL-3.0-or-later
"""From a shape to its medial axis: sampling, sides, the analysis, and what has to be said about them."""
