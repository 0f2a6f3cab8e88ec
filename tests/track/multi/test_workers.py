# SPDX-License-Identifier: MIT
"""Worker processes: what starts and what ends them."""

import gc
import os
import pickle
import signal
import subprocess
import sys
import time
import weakref
from pathlib import Path

import pytest

from tests.track.multi.kinds import FUSED
from tests.track.multi.processes import PATIENCE, ends, is_running, process_of


def open_files() -> int:
    """How many this process has."""
    return sum(1 for _ in Path("/proc/self/fd").iterdir())


def test_no_file_stays_open(started):
    """Neither a closed object's, nor one's that nobody closed."""
    gc.collect()  # what earlier tests left
    before = open_files()
    with started(FUSED, workers=3):
        assert open_files() > before
    several = started(FUSED[:2], workers=2)
    del several
    gc.collect()
    assert open_files() == before


def test_one_worker_is_this_process(started):
    """Without workers nothing is started."""
    assert not hasattr(started(FUSED)._targets, "_workers")


def test_workers_share_the_targets(started):
    """Each process has as many as the others, or one more."""
    with started(FUSED, workers=3) as several:
        targets = several._targets
        assert [len(each.ids) for each in targets._parts] == [2, 1, 1]
        assert len({process_of(several), os.getpid(), targets._workers[1]._process.pid}) == 3


def test_few_targets_take_few_processes(started):
    """No more than there are targets, also where more are allowed."""
    with started(FUSED[:2], workers=8) as several:
        assert [len(each.ids) for each in several._targets._parts] == [1, 1]
    with started(FUSED[:1], workers=8) as several:
        assert [len(each.ids) for each in several._targets._parts] == [1]


def test_more_workers_than_targets_change_no_track(started, things, alone):
    """Those that are left out, neither."""
    with started(FUSED, workers=8) as several:
        assert [several.update(frame) for frame in things.frames[1:]] == alone(FUSED)


def test_closing_ends_them(started, things):
    """``with`` and close end the workers; an update is an error then, until a target is added."""
    with started(FUSED, workers=2) as several:
        process = process_of(several)
        assert is_running(process)
    assert ends(process)
    for each in several, pickle.loads(pickle.dumps(several)):
        assert each.ids == ()
        with pytest.raises(RuntimeError, match="update: the MultiTracker is closed; add a target first"):
            each.update(things.frames[1])
    assert several.add(things.frames[1], things.boxes[0]) == 5
    assert list(several.update(things.frames[2])) == [5]
    several.close()
    several.close()


def test_they_end_with_the_object(started):
    """One that nobody closed takes its workers with it."""
    several = started(FUSED, workers=2)
    process, gone = process_of(several), weakref.ref(several)
    del several
    gc.collect()
    assert gone() is None
    assert ends(process)


def test_closing_ends_them_beside_a_fork(started):
    """A process that was forked has their connections open; they end at once all the same."""
    several = started(FUSED, workers=2)
    worker = several._targets._workers[0]._process
    child = os.fork()
    if child == 0:
        time.sleep(PATIENCE)
        os._exit(0)
    several.close()
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    assert worker.returncode == 0


SCRIPT = """
import sys, time
import numpy as np
import tricue
frame = np.random.default_rng(0).integers(0, 256, (120, 160, 3), np.uint8)
several = tricue.MultiTracker(workers=2)
for x in (20, 60, 100):
    several.add(frame, (x, 30, 24, 32))
tracks = several.update(frame)
print(several._targets._workers[0]._process.pid, *(track.status for track in tracks.values()), flush=True)
"""


def test_a_script_needs_no_guard(tmp_path):
    """A script without ``if __name__ == "__main__"`` runs once, and its workers are gone when it is."""
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    process, *statuses = done.stdout.split()
    assert statuses == ["tracked"] * 3
    assert done.stderr == ""
    assert ends(int(process))


def test_they_end_when_the_process_is_killed(tmp_path):
    """Also where it couldn't say good-bye."""
    script = tmp_path / "script.py"
    script.write_text(SCRIPT + "time.sleep(60)\n")
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        process = int(parent.stdout.readline().split()[0])
        assert is_running(process)
        parent.kill()
    assert ends(process)


def test_ctrl_c_of_a_terminal_is_not_for_them(started, things, alone):
    """A signal that the terminal sends to all its processes doesn't end them."""
    with started(FUSED, workers=2) as several:
        for number in signal.SIGINT, signal.SIGHUP:
            os.kill(process_of(several), number)
        assert [several.update(frame) for frame in things.frames[1:]] == alone(FUSED)


def test_a_fork_is_told_to_copy(started, things):
    """A process that was forked can't talk to the workers, and says so in place of disturbing them."""
    with started(FUSED, workers=2) as several:
        child = os.fork()
        if child == 0:
            try:
                several.update(things.frames[1])
            except RuntimeError as error:
                os._exit(7 if "process that made them" in str(error) else 1)
            os._exit(2)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
        assert list(several.update(things.frames[1])) == [1, 2, 3, 4]
