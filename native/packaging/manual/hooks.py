# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens while mkdocs makes the manual, beside what mkdocs.yml says."""

from __future__ import annotations

import re
import sys
import tempfile
from collections import Counter
from pathlib import Path

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))  # mkdocs runs this file by its path
from native.packaging.manual import api_pages, links, search_index

_LINKS = links.LinksExtension()
_MADE = tempfile.TemporaryDirectory(prefix="manual-")  # the pages that no file of docs/ is

# Markdown inside a part that is folded is read only when it is asked for.
_FOLDED = re.compile(r"<details><summary>(.*?)</summary>")
_UNDERSTOOD = r'<details markdown="1">\n<summary markdown="span">\1</summary>\n'


def on_config(config):
    """Anchors as code hosts make them."""
    config["markdown_extensions"].append(_LINKS)
    config["mdx_configs"].setdefault("toc", {})["slugify"] = links.anchor
    return config


def on_files(files, config):
    """The pages of the interfaces that the navigation names, made of the sources."""
    wanted = str(config["nav"])
    for name, text in api_pages.pages().items() if "api_" in wanted else ():
        Path(_MADE.name, name).write_text(text, encoding="utf-8")
        files.append(File(name, _MADE.name, config["site_dir"], use_directory_urls=False))
    return files


def on_nav(nav, config, files):
    """Every page is listed once; else it could not be found, or be in two places."""
    listed = Counter(page.file.src_uri for page in nav.pages)
    for file in files.documentation_pages():
        if listed[file.src_uri] != 1:
            raise PluginError(
                f"mkdocs.yml: expected {file.src_uri} once in the list of pages, "
                f"found it {listed[file.src_uri]} times"
            )
    return nav


def on_page_markdown(markdown, page, config, files):
    page.title = links.title_of(markdown)
    _LINKS.page = page.file.src_uri
    return _FOLDED.sub(_UNDERSTOOD, markdown)


def on_env(env, config, files):
    """Only pictures that a page shows are copied; beside the pages lies what the search reads."""
    pages = list(in_order(files))
    shown = {name for page in pages for name in links.pictures(page.content, page.file.src_uri)}
    for file in list(files.media_files()):
        if file.src_uri.endswith((".png", ".svg")) and file.src_uri not in shown:
            files.remove(file)
    config["theme"].static_templates.clear()  # a map of the site, whose bytes change with the day
    index = Path(config["site_dir"], "search_index.js")
    index.parent.mkdir(parents=True, exist_ok=True)
    index.write_text(search_index.script(pages), encoding="utf-8")
    return env


def in_order(files):
    """The pages as one leafs through them."""
    pages = [file.page for file in files.documentation_pages()]
    page = next(page for page in pages if page.previous_page is None)
    while page:
        yield page
        page = page.next_page
