# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials that are to break the product: `python3 -m tests.breaking SECONDS [SEED [KIND ...]]` (docs/breaking.md)."""
