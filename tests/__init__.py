# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that must hold, and what shows or measures it. `parts.py` is what `build_addon.py test` runs."""
