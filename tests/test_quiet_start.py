# SPDX-License-Identifier: MIT
"""Ctrl-C while modules are imported: the program ends quietly, other programs as they always do."""

import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from tricue import quiet_start

MAIN = "import sys\nfrom tricue.cli import main\nsys.exit(main())\n"


def interrupted(folder: Path, module: str, words: Sequence[str]) -> "subprocess.CompletedProcess[str]":
    """Python with these arguments, interrupted while it imports a module."""
    sends = "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(9)\n"
    (folder / f"{module}.py").write_text(sends)
    path = os.pathsep.join([str(folder), *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = os.environ | {"PYTHONPATH": path}
    return subprocess.run(
        [sys.executable, *words], env=environment, capture_output=True, text=True, timeout=60, check=False
    )


@pytest.mark.parametrize("module", ["numpy", "cv2"])  # the package needs the one, the command the other
@pytest.mark.parametrize("start", ["module", "script"])
def test_the_program_ends_quietly(tmp_path: Path, module: str, start: str) -> None:
    """Exit code 130 and one line, however it was started and whatever it imports just now."""
    script = tmp_path / "bin" / "tricue"
    script.parent.mkdir()
    script.write_text(MAIN)
    words = ["-m", "tricue"] if start == "module" else [str(script)]
    done = interrupted(tmp_path, module, [*words, "track", "video.mp4"])
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "tricue: interrupted\n")


def test_other_programs_are_left_alone(tmp_path: Path) -> None:
    """One that imports the package gets Python's KeyboardInterrupt, to handle as it likes."""
    script = tmp_path / "mine.py"
    script.write_text("try:\n    import tricue\nexcept KeyboardInterrupt:\n    print('mine')\n")
    done = interrupted(tmp_path, "numpy", [str(script), "tricue"])
    assert (done.returncode, done.stdout, done.stderr) == (0, "mine\n", "")


@pytest.mark.parametrize(
    ("argv", "words", "quiet"),
    [
        (["-m"], ["python", "-m", "tricue", "track"], True),
        (["/bin/tricue", "track"], ["python", "/bin/tricue", "track"], True),
        (["-m"], ["python", "-m", "pytest", "tricue"], False),
        (["-c"], ["python", "-c", "import tricue"], False),
        (["/bin/tricue", "track"], ["python", "-c", "spawn_main()", "--multiprocessing-fork"], False),
        ([], [], False),
    ],
)
def test_only_the_program_itself(
    monkeypatch: pytest.MonkeyPatch, argv: list[str], words: list[str], quiet: bool
) -> None:
    """A worker process of the program has its arguments, but not its command line."""
    monkeypatch.setattr(sys, "argv", argv)
    monkeypatch.setattr(sys, "orig_argv", words)
    before = signal.getsignal(signal.SIGINT)
    try:
        quiet_start.begin()
        assert (signal.getsignal(signal.SIGINT) is not before) is quiet
        quiet_start.end()
        assert signal.getsignal(signal.SIGINT) is before
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_ignored_signal_stays_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    """As in a shell's background job."""
    monkeypatch.setattr(sys, "argv", ["-m"])
    monkeypatch.setattr(sys, "orig_argv", ["python", "-m", "tricue"])
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        quiet_start.begin()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)
