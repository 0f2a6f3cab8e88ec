# SPDX-License-Identifier: MIT
"""What Ctrl-C, kill and a closed terminal do to a command, in this process and in another."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue.cli.signals import ENDING, catch_signals, clean_exits

from tests.data.mjpeg_server import mjpeg_server


@pytest.mark.parametrize("number", ENDING)
def test_the_first_signal_asks_and_the_second_breaks_off(number: signal.Signals) -> None:
    """The first one answers "stop?" with its number, another interrupts, and the old handlers return."""
    before = [signal.getsignal(each) for each in ENDING]
    with catch_signals() as stop:
        assert stop() == 0
        os.kill(os.getpid(), number)
        assert stop() == number
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
    assert [signal.getsignal(each) for each in ENDING] == before


@pytest.mark.parametrize("number", ENDING)
def test_a_signal_ends_the_wait_for_an_item(number: signal.Signals) -> None:
    """While the next item is awaited the first signal ends the iteration, and not in between."""

    def items() -> Iterator[int]:
        yield 0
        yield 1
        os.kill(os.getpid(), number)
        pytest.fail("went on waiting")

    with catch_signals() as stop:
        assert list(stop.until_caught(items())) == [0, 1]
        assert stop() == number
        assert list(stop.until_caught([2])) == []
    with catch_signals() as stop:
        for item in stop.until_caught(range(3)):
            os.kill(os.getpid(), number)
            assert item == 0


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="Windows has no alarm")
@pytest.mark.parametrize("number", ENDING)
def test_one_signal_ends_work_that_is_stuck(number: signal.Signals, monkeypatch: pytest.MonkeyPatch) -> None:
    """After a signal the item in work may take a while, but not forever; what is done with it may."""
    monkeypatch.setattr("tricue.cli.signals.MAX_LAST_FRAME", 0.2)

    def items() -> Iterator[int]:
        for item in range(3):
            if item == 1:
                os.kill(os.getpid(), number)
                time.sleep(0.05)
            if item == 2:
                time.sleep(0.5)  # the alarm of the item before is off
                os.kill(os.getpid(), signal.SIGINT)
            yield item
        pytest.fail("went on")

    def stuck() -> Iterator[int]:
        os.kill(os.getpid(), number)
        time.sleep(60)
        yield 0

    with catch_signals() as stop:
        assert list(stop.unless_stuck(items())) == [0, 1]
        assert stop() == number
    with catch_signals() as stop:
        began = time.monotonic()
        assert list(stop.unless_stuck(stuck())) == []
        assert time.monotonic() - began < 30
        assert stop() == number
    with catch_signals() as stop:
        for item in stop.unless_stuck(range(1)):
            os.kill(os.getpid(), number)
            time.sleep(0.5)
            assert item == 0
    with catch_signals() as stop, pytest.raises(KeyboardInterrupt):
        list(stop.unless_stuck(_interrupted()))


def _interrupted() -> Iterator[int]:
    """An interrupt that no signal caused."""
    yield 0
    raise KeyboardInterrupt


@pytest.mark.parametrize("number", ENDING[1:])
def test_other_commands_leave_by_an_exception(number: signal.Signals) -> None:
    """Elsewhere SIGTERM and SIGHUP raise SystemExit with a shell's code, so that ``with`` closes files."""
    with pytest.raises(SystemExit) as stop, clean_exits():
        os.kill(os.getpid(), number)
    assert stop.value.code == 128 + number


def test_an_ignored_signal_stays_ignored() -> None:
    """Nohup ignores SIGHUP; the command goes on, and so does this test."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with catch_signals() as stop:
            os.kill(os.getpid(), signal.SIGHUP)
            assert stop() == 0
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bright square that wanders over noise, 64x48, 2,000 frames."""
    path = tmp_path_factory.mktemp("video") / "long.avi"
    noise = np.random.default_rng(0).integers(0, 256, (48, 64, 3), np.uint8)
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 25.0, (64, 48))
    for index in range(2000):
        picture = noise.copy()
        picture[16:32, 20 + index % 8 : 36 + index % 8] = (60, 120, 220)
        writer.write(picture)
    writer.release()
    return path


def track(video: Path, *arguments: str) -> list[str]:
    """The words that track in the video in another process, so slowly that a signal comes in the middle."""
    slow = ("--box", "20,16,16,16", "--kernels", "reference")
    return [sys.executable, "-m", "tricue", "track", str(video), *slow, *arguments]


def wait_for_rows(path: Path, process: "subprocess.Popen[Any]") -> None:
    """Wait until the process has written some rows of the CSV, or ended."""
    deadline = time.monotonic() + 60
    while not (path.exists() and path.read_text().count("\n") > 2) and process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.05)


@pytest.mark.parametrize("number", ENDING)
def test_files_are_whole_after_a_signal(video: Path, tmp_path: Path, number: signal.Signals) -> None:
    """A signal in the middle of a run exits with 128 and its number, and all files can be read."""
    out = {name: tmp_path / f"out.{name}" for name in ("mp4", "csv", "json")}
    files = ["--output", str(out["mp4"]), "--csv", str(out["csv"]), "--json", str(out["json"])]
    with subprocess.Popen(track(video, *files), stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        wait_for_rows(out["csv"], process)
        os.kill(process.pid, number)
        printed, error = process.communicate(timeout=60)
    assert process.returncode == 128 + number, error
    assert b"until interrupted" in printed
    rows = out["csv"].read_text().splitlines()[1:]
    assert 0 < len(rows) < 2000
    assert len(json.loads(out["json"].read_text())["tracks"]) == len(rows)
    capture = cv2.VideoCapture(str(out["mp4"]))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == len(rows)


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="workers need Linux's memory files")
def test_one_signal_ends_a_run_whose_worker_hangs(video: Path, tmp_path: Path) -> None:
    """Without it, the run waited for a second one: the worker's answer never comes."""
    csv = tmp_path / "out.csv"
    command = track(video, "--box", "10,10,16,16", "--workers", "2", "--csv", str(csv))
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True) as process:
        wait_for_rows(csv, process)
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        (worker,) = map(int, children)
        os.kill(worker, signal.SIGSTOP)
        os.kill(process.pid, signal.SIGINT)
        printed, error = process.communicate(timeout=60)
    assert process.returncode == 130, error
    assert error == ""
    assert "until interrupted" in printed
    assert not Path(f"/proc/{worker}").exists()
    assert csv.read_text().endswith("\n")


@pytest.mark.parametrize("number", ENDING[:2])
def test_a_signal_ends_a_camera_that_has_stopped(number: signal.Signals) -> None:
    """While a live stream gives no frames, a signal ends the run at once and not after a minute."""
    with mjpeg_server() as server:
        command = [sys.executable, "-m", "tricue", "track", server.url, "--box", "9,9,20,20", "--json", "-"]
        pipe = subprocess.PIPE
        with subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True) as process:
            assert process.stdout is not None
            assert process.stderr is not None
            process.stdout.readline()
            server.stop()
            while "connecting again" not in process.stderr.readline():
                assert process.poll() is None
            process.send_signal(number)
            _, report = process.communicate(timeout=20)
    assert process.returncode == 128 + number
    assert "until interrupted" in report
