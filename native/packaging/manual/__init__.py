# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual that is installed with the add-on; mkdocs.yml says what is in it, hooks.py what mkdocs leaves to us."""
