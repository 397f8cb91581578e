# SPDX-License-Identifier: GPL-3.0-or-later
"""A subinterpreter is refused in a sentence; the main interpreter of the same process goes on."""

import subprocess
import sys
from pathlib import Path

import pytest

TRY = """
import sys, _xxsubinterpreters as interpreters
other = interpreters.create()
load = "import sys; sys.path.insert(0, {!r}); import _medial".format(sys.argv[1])
try:
    interpreters.run_string(other, load)
except interpreters.RunFailedError as error:
    print(error)
exec(load)
print(sys.modules["_medial"].__name__)
"""


@pytest.mark.skipif(sys.version_info >= (3, 13), reason="_xxsubinterpreters has another name")
def test_subinterpreters_are_refused(medial):
    words = [sys.executable, "-c", TRY, str(Path(medial.__file__).parent)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=60)
    refused, name = done.stdout.splitlines()
    assert "Expected the main interpreter of the process, found a subinterpreter" in refused
    assert name == "_medial"
