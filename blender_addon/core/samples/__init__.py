# SPDX-License-Identifier: GPL-3.0-or-later
"""From a shape to analysed samples, in one or more passes."""
