# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of the machine that the method needs: the compiled module, memory, threads, progress."""
