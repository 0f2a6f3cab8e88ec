# SPDX-License-Identifier: MIT
"""Ctrl-C while the package is imported."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from tricue import start

MODULE = "import os, signal, time; os.kill(os.getpid(), signal.SIGINT); time.sleep(0.5)"


def interrupted(folder: Path, *words: str, ignored: bool = False) -> tuple[int, str]:
    """The exit code and the errors of a Python that gets Ctrl-C when the package imports numpy."""
    (folder / "numpy.py").write_text(MODULE)
    paths = os.pathsep.join([str(folder), str(Path(start.__file__).parents[1])])
    handler = signal.SIG_IGN if ignored else signal.default_int_handler
    before = signal.signal(signal.SIGINT, handler)  # a child keeps an ignored signal alone
    try:
        done = subprocess.run(
            [sys.executable, *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
            env=os.environ | {"PYTHONPATH": paths},
            check=False,
        )
    finally:
        signal.signal(signal.SIGINT, before)
    return done.returncode, done.stderr


@pytest.fixture
def script(tmp_path: Path) -> Path:
    """The script of an installation."""
    path = tmp_path / "bin" / "tricue"
    path.parent.mkdir()
    path.write_text("from tricue.cli import main\nmain()\n")
    return path


def test_a_command_ends_quietly(tmp_path: Path, script: Path) -> None:
    """As a module or as a script, with the line and the exit code of later."""
    for words in (["-m", "tricue"], ["-W", "error", "-m", "tricue"], [str(script)]):
        told = interrupted(tmp_path, *words, "info", "video.mp4")
        assert told == (start.INTERRUPTED, "tricue: interrupted\n"), words


def test_an_ignored_interrupt_stays_ignored(tmp_path: Path) -> None:
    """As of a command that a script has started in the background: it goes on, to what numpy lacks here."""
    code, told = interrupted(tmp_path, "-m", "tricue", "info", "video.mp4", ignored=True)
    assert code == 1
    assert "numpy" in told.splitlines()[-1]


def test_a_program_that_imports_the_package_gets_the_exception(tmp_path: Path) -> None:
    """Its KeyboardInterrupt is its own, also if it has the command's words."""
    _, told = interrupted(tmp_path, "-c", "import tricue", "-m", "tricue")
    assert told.endswith("KeyboardInterrupt\n")


def test_later_interrupts_are_exceptions() -> None:
    """The command line itself catches them, to finish files; another handler isn't replaced."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        start.exit_at_interrupts()
        assert signal.getsignal(signal.SIGINT) is not signal.default_int_handler
        start.raise_interrupts()
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        start.exit_at_interrupts()
        start.raise_interrupts()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)
