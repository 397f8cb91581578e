# SPDX-License-Identifier: GPL-3.0-or-later
"""A record of each product: its options, how it is computed, its figures and its files."""
