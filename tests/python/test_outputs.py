# SPDX-License-Identifier: GPL-3.0-or-later
"""A run knows which files it reads and writes, also when another run in the same folder replaces some of them."""

import os

import pytest
from medial_axis.core.batch.outputs import Files
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.products.mid_surface import MiddleSurface
from medial_axis.core.settings import MidSurfaceSettings, Settings

SHEETS = MiddleSurface(Settings(), MidSurfaceSettings())
SHEETS_AND_REST = MiddleSurface(Settings(), MidSurfaceSettings(keep_thick=True))


def test_an_inode_that_moved_to_another_name_is_another_file(tmp_path):
    """A file system gives the inode of a replaced file to the next new one."""
    first, second = tmp_path / "first.ma", tmp_path / "second.ma"
    first.write_text("an older result")
    files = Files()
    files.claim(first)
    os.rename(first, second)
    first.write_text("a new result")
    files.claim(second)


def test_two_links_to_one_file_are_one_output(tmp_path):
    first, second = tmp_path / "first.ma", tmp_path / "second.ma"
    first.write_text("an older result")
    os.link(first, second)
    files = Files()
    files.claim(first)
    with pytest.raises(InvalidInputError, match="found '.*second.ma' again"):
        files.claim(second)


def test_an_input_that_was_moved_is_still_not_replaced(tmp_path):
    first, second = tmp_path / "first.ply", tmp_path / "second.ply"
    first.write_text("points")
    files = Files([str(first)])
    os.rename(first, second)
    with pytest.raises(InvalidInputError, match="replaces no input"):
        files.claim(first)


def test_the_table_beside_triangles_replaces_nothing(tmp_path):
    table = tmp_path / "part.csv"
    table.write_text("an input")
    with pytest.raises(InvalidInputError, match="replaces no input"):
        Files([str(table)], SHEETS.beside).claim(tmp_path / "part.stl")
    files = Files(beside=SHEETS.beside)
    files.claim(tmp_path / "part.stl")
    with pytest.raises(InvalidInputError, match="found '.*part.csv' again"):
        files.claim(table)


def test_the_thick_parts_beside_a_middle_surface_replace_nothing(tmp_path):
    thick = tmp_path / "part_thick.stl"
    thick.write_text("an input")
    with pytest.raises(InvalidInputError, match="replaces no input"):
        Files([str(thick)], SHEETS_AND_REST.beside).claim(tmp_path / "part.inp")
    Files([str(thick)]).claim(tmp_path / "part.inp")
