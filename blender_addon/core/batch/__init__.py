# SPDX-License-Identifier: GPL-3.0-or-later
"""This package computes many results one after the other: file names, frames, stamps, and options as words."""
