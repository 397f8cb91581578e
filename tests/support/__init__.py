# SPDX-License-Identifier: GPL-3.0-or-later
"""Code that tests and benchmarks share: shapes with known axes, meshes, oracles, measures."""
