# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis thickness` on the command line: files, exit codes, batches."""

import base64
import json
import re
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from medial_axis import cli
from support.meshes import write_off
from support.thick_meshes import block


@pytest.fixture
def box(tmp_path):
    return write_off(tmp_path / "box.off", block(1.0, 0.7, 0.4))


def run(*words):
    options = "--quiet", "--sampling", "surface", "--samples", "4000"
    return cli.main(["thickness", *map(str, words), *options])


def test_exit_code_says_whether_something_is_thin(box, tmp_path, capsys):
    out = tmp_path / "box.json"
    assert run(box, out, "--limit", 0.4) == cli.DONE
    assert "minimum 0.4, 0 % below 0.4" in capsys.readouterr().out
    assert run(box, out, "--limit", 0.41, "--unit", "mm") == cli.THIN == 5
    assert "minimum 0.4 mm, 100 % below 0.41 mm in 1 patch" in capsys.readouterr().out
    said = json.loads(out.read_text())
    assert said["unit"] == "mm" and len(said["patches"]) == 1
    assert run(box, out, "--limit", 0.41, "--unit", "mm") == cli.THIN, "also of what is kept"
    assert ", kept" in capsys.readouterr().out


def test_a_name_of_number_signs_stays_where_there_are_no_frames(box, tmp_path):
    source = Path(box).rename(tmp_path / "####.off")
    assert run(source, f"{tmp_path}/out/", "--format", "csv") == cli.DONE
    assert (tmp_path / "out" / "####.csv").exists()


def test_options_reach_the_measurement(box, tmp_path):
    out = tmp_path / "box.csv"

    def lengths():
        rows = np.loadtxt(out, delimiter=",", skiprows=1)
        return rows[rows[:, 0] >= 0, 4]  # at vertices

    assert run(box, out, "--gap") == cli.DONE and np.isinf(lengths()).all()
    assert run(box, out, "--edges", "ball") == cli.DONE and (lengths() < 0.2).all()
    assert run(box, out) == cli.DONE
    np.testing.assert_allclose(lengths(), 0.4, rtol=0.02)


def test_many_inputs_and_one_that_cannot_be_used(box, tmp_path, capsys):
    plate = write_off(tmp_path / "plate.off", block(1.0, 0.7, 0.1))
    folder = tmp_path / "out"
    assert run(box, plate, f"{folder}/", "--limit", 0.2, "--format", "csv") == cli.THIN
    assert sorted(p.name for p in folder.glob("*.csv")) == ["box.csv", "plate.csv"]
    report = json.loads((folder / "plate.csv.json").read_text())
    assert report["share_below"] == pytest.approx(1.0, abs=0.01) and report["status"] == "done"
    assert run(tmp_path / "none.off", plate, f"{folder}/", "--limit", 0.2) == cli.INPUT
    capsys.readouterr()


def test_a_page_shows_the_thin_places_in_colours(box, tmp_path):
    """The pictures are read again without a library, and the box fills them in the colour of thin faces."""
    out = tmp_path / "box.html"
    assert run(box, out, "--limit", 0.41, "--unit", "mm") == cli.THIN
    page = out.read_text(encoding="utf-8")
    assert "Thickness of box" in page and "0.41 mm" in page and "100 % of the surface" in page
    assert "http" not in page, "nothing is fetched"
    pictures = [pixels_of(data) for data in re.findall(r'base64,([^"]+)"', page)]
    assert len(pictures) >= 3
    for pixels in pictures[:2]:
        red, green, blue = pixels[:, :, :3].reshape(-1, 3).T.astype(int)
        drawn = (red != 255) | (green != 255) | (blue != 255)
        assert 0.2 < drawn.mean() < 0.95
        assert (red[drawn] > blue[drawn] + 30).mean() > 0.95, "all of it is below the limit"


def test_one_page_has_a_row_for_each_part(box, tmp_path, capsys):
    """The thin part is told at its place, a part that cannot be read with its reason, and there is one exit code."""
    plate = write_off(tmp_path / "plate.off", block(1.0, 0.7, 0.1))
    page = tmp_path / "new" / "parts.html"
    words = (box, plate, "--limit", 0.2, "--unit", "mm", "--page", page)
    assert run(*words) == cli.THIN
    said = capsys.readouterr().out.splitlines()
    assert said[0].startswith("box.off: minimum 0.4 mm, 0 % below 0.2 mm, done in")
    assert said[2] == f"{page}: Thinner than 0.2 mm at 1 place of 1 of 2 parts."
    text = page.read_text(encoding="utf-8")
    rows = re.findall("<tr><td>.*</tr>", text)
    assert "Thickness of 2 parts" in text and "http" not in text and len(rows) == 2
    assert all("data:image/png;base64," in row and "<svg" in row for row in rows)
    assert ["0.4 mm" in row for row in rows] == [True, False]
    assert ['class="thin"' in row for row in rows] == [False, True]
    assert sorted(p.name for p in page.parent.iterdir()) == ["parts.html"]
    assert run(tmp_path / "none.off", *words, "--json") == cli.INPUT
    told = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [report.get("row") for report in told] == [None, 1 + 1, 3, None]
    assert told[-1]["rows"] == 3 and told[-1]["places"] == 1
    assert "1 part could not be measured" in page.read_text(encoding="utf-8")


def test_a_page_that_cannot_be_written_is_an_error(box, tmp_path, capsys):
    assert run(box, "--page", box) == cli.USAGE
    assert "ends in .html, found" in capsys.readouterr().err
    (tmp_path / "file").write_text("")
    assert run(box, "--page", tmp_path / "file" / "page.html") == cli.FAILED
    capsys.readouterr()


def pixels_of(data):
    """(h, w, 3) of a PNG file that is not filtered; every part has its checksum."""
    file, chunks, at = base64.b64decode(data), {}, 8
    assert file[:8] == b"\x89PNG\r\n\x1a\n"
    while at < len(file):
        size, name = struct.unpack(">I4s", file[at : at + 8])
        chunks[name] = file[at + 8 : at + 8 + size]
        crc = struct.unpack(">I", file[at + 8 + size : at + 12 + size])[0]
        assert crc == zlib.crc32(name + chunks[name])
        at += 12 + size
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1)
    assert (rows[:, 0] == 0).all()
    return rows[:, 1:].reshape(height, width, 3)
