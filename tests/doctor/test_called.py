# SPDX-License-Identifier: MIT
"""Which command lines are doctor's, for which the import leaves out what may be broken."""

import sys

import pytest
from tricue.doctor.called import is_called


@pytest.fixture(autouse=True)
def script(tmp_path, monkeypatch):
    """The script of an installation, in the current folder's bin/."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "tricue").write_text("#!python")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("words", "called"),
    [
        (["python", "-m", "tricue", "doctor"], True),
        (["python", "-W", "error", "-m", "tricue", "doctor", "--json"], True),
        (["python", "bin/tricue", "doctor"], True),
        (["python", "-I", "bin/tricue", "doctor", "--json"], True),
        (["python", "-m", "tricue", "track", "doctor"], False),
        (["python", "-m", "other", "tricue", "doctor"], False),
        (["python", "-c", "import tricue", "tricue", "doctor"], False),
        (["python", "-m", "doctor"], False),
        (["python", "bin/doctor"], False),
        (["python", "doctor", "tricue"], False),
        (["python", "-m", "tricue"], False),
        (["python"], False),
        ([], False),
    ],
)
def test_only_doctor_itself(monkeypatch, words, called):
    """As a module or as a script, with options of Python's; no other program with these words."""
    monkeypatch.setattr(sys, "orig_argv", words)
    assert is_called() is called
