# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of real models: `show.py` is what `build_addon.py demo` does."""
