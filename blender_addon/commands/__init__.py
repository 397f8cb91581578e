# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of the command line: their words, what they compute, and the items they are for."""
