# SPDX-License-Identifier: MIT
"""``tricue evaluate`` that is interrupted by Ctrl-C."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tricue.cli import main
from tricue.evaluation import tables

# Python doesn't hear Ctrl-C where its parent ignores it, as what a shell runs in the background does.
HEARING = "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
COMMAND = (sys.executable, "-c", HEARING + "from tricue.cli import main; sys.exit(main())", "evaluate")


def rows(folder: Path) -> list[bytes]:
    """The bytes of the tables that tell what the runs say."""
    return [(folder / name).read_bytes() for name in (tables.ROWS, tables.SUMMARY)]


@pytest.fixture(scope="module")
def undisturbed(dataset, tmp_path_factory):
    """The options of an evaluation of 48 runs, and the bytes of its tables."""
    options = [str(dataset), "--trackers", "color-particle,script-pf", "--seeds", "6", "--no-restarts"]
    output = tmp_path_factory.mktemp("undisturbed")
    assert main(["evaluate", *options, "--output", str(output)]) == 0
    return options, rows(output)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_and_the_same_command_again_give_the_same_tables(undisturbed, tmp_path, jobs):
    """Interrupted after some runs: exit code 130, no traceback; then as if nothing had happened."""
    options, whole = undisturbed
    for attempt in range(5):
        parts = tmp_path / f"parts{attempt}"
        command = [*COMMAND, *options, "--jobs", jobs, "--output", str(parts)]
        code, error = interrupted(command, parts)
        if code != 0:  # else a busy machine let it finish before this process could see the fifth file
            break
    assert code == 130
    assert 5 <= len(list(parts.rglob("*.json"))) < 48
    assert "the same command goes on" in error
    assert "Traceback" not in error
    assert subprocess.run(command, check=False, capture_output=True).returncode == 0
    assert rows(parts) == whole


def interrupted(command: list[str], output: Path) -> tuple[int, str]:
    """The exit code and the standard error of a command that gets Ctrl-C when it has written five runs."""
    child = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True)
    deadline = time.monotonic() + 120
    while len(list(output.rglob("*.json"))) < 5 and time.monotonic() < deadline and child.poll() is None:
        time.sleep(0.01)
    if child.poll() is None:
        os.killpg(child.pid, signal.SIGINT)  # as a terminal does
    _, error = child.communicate(timeout=120)
    return child.returncode, error


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_leaves_no_process_of_a_tracker(folders, own, jobs):
    """Interrupted in an update that lasts, the command ends with 130, and so do the trackers' processes."""
    words = [str(folders), "--trackers", "own_tracker:Stays", "--no-restarts", "--jobs", jobs]
    child = subprocess.Popen([*COMMAND, *words], stderr=subprocess.PIPE, text=True, start_new_session=True)
    deadline = time.monotonic() + 120
    while not (started := list((own / "processes").iterdir())) and time.monotonic() < deadline:
        time.sleep(0.01)
    os.killpg(child.pid, signal.SIGINT)
    _, error = child.communicate(timeout=120)
    assert child.returncode == 130
    assert "Traceback" not in error
    assert started
    while any(map(runs, started)) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(map(runs, started))


def runs(file):
    """Whether a process with the number that a file is named by is there, and no zombie."""
    try:
        return Path("/proc", file.name, "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False
