# SPDX-License-Identifier: GPL-3.0-or-later
"""What the method needs of the machine: the compiled module, memory, threads, progress."""
