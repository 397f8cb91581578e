# SPDX-License-Identifier: GPL-3.0-or-later
"""The user interface uses these everywhere: words, translation, the job that runs, tabs, sliders."""
