# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: writes the asset library of the add-on's groups of nodes into the folder given after `--`."""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from blender_addon.bridge.nodes.groups import write_library  # noqa: E402 - the line above makes it found

write_library(Path(sys.argv[sys.argv.index("--") + 1]))
