# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups of Geometry Nodes, built by code: a module for each, and `groups` that lists them."""
