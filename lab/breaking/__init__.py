# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials that are to break the product: `python3 -m lab.breaking SECONDS [SEED [KIND ...]]` (docs/lab/breaking.md)."""
