# SPDX-License-Identifier: GPL-3.0-or-later
"""How sources become a zip: Debian's packages, compiled modules, manual, presets, licences. Standard library only."""
