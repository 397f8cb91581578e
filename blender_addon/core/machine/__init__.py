# SPDX-License-Identifier: GPL-3.0-or-later
"""This package gives the method access to the machine: the compiled module, memory, threads, progress."""
