# SPDX-License-Identifier: GPL-3.0-or-later
"""Small manuals, made as the real one is."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def one_page_config(folder, page):
    """The settings of a manual of `folder`/docs with one page in its list: the real ones but for these."""
    config = folder / "mkdocs.yml"
    made_by = ROOT / "native" / "packaging" / "manual"
    config.write_text(
        f"INHERIT: {ROOT / 'mkdocs.yml'}\n"
        f"docs_dir: {folder / 'docs'}\n"
        f"theme: {{custom_dir: {made_by / 'theme'}}}\n"
        f"hooks: [{made_by / 'hooks.py'}]\n"
        f"nav: [{page}]\n"
    )
    return config


def make_manual(config, folder):
    """AssertionError with what mkdocs says, when it is not content."""
    words = ["-m", "mkdocs", "build", "--strict", "--config-file", config]
    words += ["--site-dir", folder]
    done = subprocess.run([sys.executable, "-B", *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
