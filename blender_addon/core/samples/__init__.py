# SPDX-License-Identifier: GPL-3.0-or-later
"""Which samples of a shape are analysed, in passes, and by which analysis."""
