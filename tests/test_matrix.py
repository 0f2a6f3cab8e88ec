# SPDX-License-Identifier: MIT
"""The tests with other versions: what can't run here."""

import sys
from pathlib import Path

import pytest

from tools import matrix


@pytest.mark.parametrize(("names", "code"), [([], 0), (["oldest"], 1), (["clang", "oldest"], 1)])
def test_what_was_named_has_to_run(
    names: list[str],
    code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It proves that a combination whose Python is missing fails where it was asked for, and is left out of
    all otherwise.
    """
    monkeypatch.setattr(matrix, "ENVIRONMENTS", tmp_path)
    monkeypatch.setattr(matrix, "interpreter", lambda version: None)
    monkeypatch.setattr(sys, "argv", ["matrix", *names])
    assert matrix.main() == code
    assert "left out: no Python" in capsys.readouterr().out
