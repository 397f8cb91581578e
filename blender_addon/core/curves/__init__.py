# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires of a level as branches: loops and limbs that come from the sampling, ends, smooth lines, room around them."""
