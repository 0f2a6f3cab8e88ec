# SPDX-License-Identifier: MIT
"""Code in a process of its own: whatever it does is an answer."""

import sys
from pathlib import Path

import pytest
from tricue.doctor.probe import MAX_ERROR, probe


def test_what_is_reported_comes_back():
    """Values of JSON's types, whatever else is printed."""
    answer = probe("print('noise')\nreport(name='x', numbers=[1, 2.5], none=None)\nprint('more')")
    assert answer.values == {"name": "x", "numbers": [1, 2.5], "none": None}
    assert answer.error == ""


@pytest.mark.parametrize(
    "code",
    ["raise ImportError('no libfoo')", "raise RuntimeError('no libfoo')", "raise OSError('no\\n  libfoo')"],
)
def test_an_error_is_told_in_a_line(code):
    """Its kind and its message."""
    error = probe(code).error
    assert error.endswith("Error: no libfoo")
    assert "\n" not in error


def test_a_long_error_is_cut():
    """A library may say pages."""
    assert len(probe("raise ValueError('x' * 100000)").error) < MAX_ERROR + 10


@pytest.mark.skipif(sys.platform == "win32", reason="needs signals")
def test_a_crash_is_told():
    """The signal is named."""
    crash = "import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)"
    assert probe(crash).error == "ends the process with SIGSEGV"


def test_an_exit_is_told():
    """Also one that the code asks for."""
    assert probe("import os\nos._exit(3)").error == "ends the process with exit code 3"
    assert "SystemExit" in probe("import sys\nsys.exit('no')").error


def test_a_hang_is_told():
    """After the given time."""
    assert probe("import time\ntime.sleep(100)", seconds=0.5).error == "gives no answer for 0.5 s"


def test_a_path_may_be_among_the_folders_of_modules(monkeypatch):
    """Of ``sys.path``, to which some add a pathlib.Path, as a sitecustomize may; nothing else is broken."""
    monkeypatch.setattr(sys, "path", [*sys.path, Path("somewhere")])
    assert probe("report(done=True)").values == {"done": True}


def test_it_imports_what_this_process_imports(tmp_path, monkeypatch):
    """The path is this process's; what lies in the current folder doesn't hide packages."""
    (tmp_path / "json.py").write_text("raise SystemError('hidden')")
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "only_here.py").write_text("value = 7")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path / "lib"))
    answer = probe("import only_here\nreport(value=only_here.value)")
    assert answer.error == ""
    assert answer.values == {"value": 7}
