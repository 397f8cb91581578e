# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of robots whose links get balls or capsules as their collision geometry."""
