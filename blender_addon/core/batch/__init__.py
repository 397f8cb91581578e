# SPDX-License-Identifier: GPL-3.0-or-later
"""Many axes, one after the other: names of files, frames, stamps, and options as words."""
