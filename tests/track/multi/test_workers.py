# SPDX-License-Identifier: MIT
"""Worker processes: what starts and what ends them, and what happens where one is killed."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref
from pathlib import Path

import numpy as np
import pytest
from tricue import Box, MultiTracker
from tricue.errors import WorkerEndedError
from tricue.track.multi import remote_targets
from tricue.track.multi.worker import _portable

from tests.track.multi.kinds import FUSED

PATIENCE = 20.0  # seconds


def process_of(several: MultiTracker) -> int:
    """The worker's."""
    return several._targets._workers[0]._process.pid


def is_running(process: int) -> bool:
    """Whether it is there, and no mere entry of an ended one."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def open_files() -> int:
    """How many this process has."""
    return sum(1 for _ in Path("/proc/self/fd").iterdir())


def ends(process: int) -> bool:
    """Whether it ends in time."""
    end = time.monotonic() + PATIENCE
    while is_running(process) and time.monotonic() < end:
        time.sleep(0.02)
    return not is_running(process)


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
    """``with`` and close end the workers; a target can be added afterwards."""
    with started(FUSED, workers=2) as several:
        process = process_of(several)
        assert is_running(process)
    assert ends(process)
    assert (several.ids, several.update(things.frames[1])) == ((), {})
    assert several.add(things.frames[1], things.boxes[0]) == 5
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


def test_a_killed_worker_is_one_clear_error(started, things, alone):
    """It names its targets; the others go on with that frame, and a new one gets a new worker."""
    expected = alone(FUSED)
    with started(FUSED, workers=2) as several:
        assert several.update(things.frames[1]) == expected[0]
        killed = process_of(several)
        os.kill(killed, signal.SIGKILL)
        assert ends(killed)
        message = (
            r"a worker process ended by signal 9; its targets 2, 4 are gone, the others are as they were"
        )
        with pytest.raises(WorkerEndedError, match=message):
            several.update(things.frames[2])
        assert several.ids == (1, 3)
        assert several.update(things.frames[2]) == {number: expected[1][number] for number in (1, 3)}
        assert several.add(things.frames[0], things.boxes[1]) == 5
        assert process_of(several) != killed
        assert list(several.update(things.frames[3])) == [1, 3, 5]


def test_a_worker_that_another_thread_ends(started, things):
    """As at the interpreter's exit, while a daemon thread calls: that gets the same error."""
    with started(FUSED, workers=2) as several:
        worker = several._targets._workers[0]
        os.kill(process_of(several), signal.SIGSTOP)  # so that it takes a moment
        ending = threading.Thread(target=worker._end_process)
        ending.start()
        while not worker._connection.closed:
            time.sleep(0.01)
        going_on = threading.Timer(0.5, os.kill, [process_of(several), signal.SIGCONT])
        going_on.start()
        with pytest.raises(WorkerEndedError, match="ended with exit code 0; its targets 2, 4 are gone"):
            several.update(things.frames[1])
        ending.join()


def test_a_worker_that_is_killed_during_an_update(started, things, alone):
    """The target of this process, which had gone on, goes back."""
    expected = alone(FUSED)
    with started(FUSED, workers=2) as several:
        worker = several._targets._workers[0]
        os.kill(process_of(several), signal.SIGSTOP)  # it doesn't answer
        finish = worker.finish_update

        def finish_later(frame):
            os.kill(process_of(several), signal.SIGKILL)
            return finish(frame)

        worker.finish_update = finish_later
        with pytest.raises(WorkerEndedError, match="its targets 2, 4 are gone"):
            several.update(things.frames[5])
        assert several.update(things.frames[1]) == {number: expected[0][number] for number in (1, 3)}


class Refusing:
    """A third party's, which refuses the second frame while a worker dies."""

    killing: MultiTracker | None = None

    def init(self, image, box) -> None:
        self.box = box

    def update(self, image):
        if Refusing.killing is not None:
            process = process_of(Refusing.killing)
            os.kill(process, signal.SIGKILL)
            assert ends(process)
            raise ValueError("a frame that it refuses")
        return self.box


@pytest.mark.parametrize("then", ["update", "remove"])
def test_a_worker_that_is_killed_while_another_target_fails(then, things, monkeypatch):
    """That error comes first. The next call names the targets that went; the others go on."""
    frames, boxes = things.frames, things.boxes
    with MultiTracker(workers=2) as several:
        several.add(frames[0], boxes[0], f"{__name__}:Refusing")
        several.add(frames[0], boxes[1])
        several.update(frames[1])
        monkeypatch.setattr(Refusing, "killing", several)
        with pytest.raises(ValueError, match="target 1: a frame that it refuses"):
            several.update(frames[2])
        monkeypatch.setattr(Refusing, "killing", None)
        with pytest.raises(WorkerEndedError, match="a worker process ended; its targets 2 are gone"):
            several.update(frames[2]) if then == "update" else several.remove(2)
        assert several.ids == (1,)
        assert list(several.update(frames[2])) == [1]
        assert several.add(frames[2], boxes[1]) == 3
        assert list(several.update(frames[3])) == [1, 3]


def test_an_answer_that_was_read_in_part_ends_its_worker(started, things, alone, monkeypatch):
    """Ctrl-C in the middle of it would leave bytes that the next answer doesn't start with."""
    with started(FUSED, workers=2) as several:
        worker = several._targets._workers[0]

        def read_in_part(connection):
            os.read(connection.fileno(), 2)
            raise KeyboardInterrupt

        with monkeypatch.context() as patched:
            patched.setattr(remote_targets, "receive", read_in_part)
            with pytest.raises(KeyboardInterrupt):
                several.update(things.frames[5])
        assert worker.ended
        with pytest.raises(WorkerEndedError, match="its targets 2, 4 are gone"):
            several.update(things.frames[1])
        assert several.update(things.frames[1]) == {number: alone(FUSED)[0][number] for number in (1, 3)}


@pytest.mark.parametrize("call", ["update", "add"])
def test_a_worker_that_hangs_takes_one_interrupt(call, started, things, alone, monkeypatch, request):
    """Ctrl-C while it is waited for ends it after a moment, and is raised; the other targets go on."""
    monkeypatch.setattr(remote_targets, "PATIENCE", 0.5)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, before))
    with started(FUSED[:3], workers=2) as several:
        process = process_of(several)
        os.kill(process, signal.SIGSTOP)
        ctrl_c = threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT])
        again = threading.Timer(PATIENCE, os.kill, [os.getpid(), signal.SIGINT])  # so that the test ends
        begin = time.monotonic()
        ctrl_c.start()
        again.start()
        with pytest.raises(KeyboardInterrupt):
            several.update(things.frames[1]) if call == "update" else several.add(
                things.frames[1], things.boxes[0]
            )
        again.cancel()
        assert time.monotonic() - begin < PATIENCE / 2
        assert not is_running(process)
        with pytest.raises(WorkerEndedError, match="its targets 2 are gone"):
            several.update(things.frames[1])
        expected = alone(FUSED)[0]
        assert several.update(things.frames[1]) == {number: expected[number] for number in (1, 3)}


def test_a_frame_that_never_came_takes_nothing_back(started, things, alone, monkeypatch):
    """Ctrl-C while a frame is copied to the workers comes before they begin with it: they stay where they
    were, and go on with the next frame as the target of this process does.
    """
    expected = alone(FUSED)

    def interrupted(memory, frame):
        raise KeyboardInterrupt

    with started(FUSED, workers=2) as several:
        assert several.update(things.frames[1]) == expected[0]
        with monkeypatch.context() as patched:
            patched.setattr(remote_targets.FrameMemory, "write", interrupted)
            with pytest.raises(KeyboardInterrupt):
                several.update(things.frames[5])
        assert several.update(things.frames[2]) == expected[1]


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


class Odd(Exception):  # noqa: N818 (a third party's)
    def __init__(self, a: int, b: int) -> None:
        super().__init__(f"{a} and {b}")
        self.lock = threading.Lock()


def test_errors_that_can_not_be_pickled_are_told():
    """A third party's may hold anything."""
    error = _portable(Odd(1, 2))
    assert type(error) is RuntimeError
    assert str(error) == "Odd: 1 and 2"
    assert str(_portable(ValueError("x"))) == "x"


class Previous:
    """A third party's: it keeps the last image, and tells how much the new one differs from it."""

    def init(self, image, box) -> None:
        self.last = image

    def update(self, image) -> tuple[tuple[float, ...], float]:
        change = float(np.abs(image.astype(int) - self.last).mean())
        self.last = image
        return (change, 0.0, 5.0, 5.0), 0.5


@pytest.mark.parametrize("workers", [1, 2])
def test_a_third_partys_tracker_may_keep_images(workers, things):
    """Its tracks are the same in another process, which sees the frames in memory that is used again."""
    name = f"{__name__}:Previous"
    expected = [
        float(np.abs(new.color.astype(int) - old.color).mean())
        for old, new in zip(things.frames[:3], things.frames[1:4], strict=True)
    ]
    with MultiTracker(name, workers=workers) as several:
        for box in things.boxes[:2]:
            several.add(things.frames[0], box)
        for frame, change in zip(things.frames[1:4], expected, strict=True):
            assert [track.box[0] for track in several.update(frame).values()] == [change] * 2


class Locked(Previous):
    """One that can't go to another process."""

    def __init__(self) -> None:
        self.lock = threading.Lock()


def test_a_tracker_that_can_not_be_pickled_names_the_option(things):
    """The targets that are there go on."""
    with MultiTracker(f"{__name__}:Previous", workers=2) as several:
        several.add(things.frames[0], things.boxes[0])
        with pytest.raises(TypeError, match=r"^workers: expected 1, .*; cannot pickle '_thread.lock'"):
            several.add(things.frames[0], things.boxes[1], f"{__name__}:Locked")
        assert list(several.update(things.frames[1])) == [1]


def test_a_tracker_that_can_not_be_loaded_names_the_option(things, monkeypatch):
    """One of the user's script, which a worker doesn't run; the worker's targets go on."""
    own = type("Own", (Previous,), {"__module__": "__main__"})
    monkeypatch.setattr(sys.modules["__main__"], "Own", own, raising=False)
    with MultiTracker(f"{__name__}:Previous", workers=2) as several:
        for box in things.boxes[:3]:
            several.add(things.frames[0], box)
        with pytest.raises(TypeError, match=r"^workers: expected 1, .*; Can't get attribute 'Own'"):
            several.add(things.frames[0], things.boxes[3], "__main__:Own")
        assert list(several.update(things.frames[1])) == [1, 2, 3]


def test_a_box_may_be_of_a_class_of_the_script(things, monkeypatch):
    """A worker that can't load the class gets the box all the same."""
    own = type("Own", (Box,), {"__module__": "__main__"})
    monkeypatch.setattr(sys.modules["__main__"], "Own", own, raising=False)
    with MultiTracker(workers=2) as several:
        for box in things.boxes[:2]:
            several.add(things.frames[0], own(*box))
        assert list(several.update(things.frames[1])) == [1, 2]


def test_who_keeps_images_may_share_a_worker(things):
    """One third party's tracker among others in a process sees images of its own, too."""
    change = [
        float(np.abs(new.color.astype(int) - old.color).mean())
        for old, new in zip(things.frames[:3], things.frames[1:4], strict=True)
    ]
    with MultiTracker(workers=2) as several:
        for box, kind in zip(things.boxes, ("fused", f"{__name__}:Previous", "fused", "fused"), strict=True):
            several.add(things.frames[0], box, kind)
        assert [len(each.ids) for each in several._targets._parts] == [2, 2]
        assert [several.update(frame)[2].box[0] for frame in things.frames[1:4]] == change


def test_a_path_may_be_among_the_folders_of_modules(monkeypatch, started, things, alone):
    """Of ``sys.path``, to which some add a pathlib.Path; workers look for modules there, too."""
    monkeypatch.setattr(sys, "path", [*sys.path, Path("somewhere")])
    with started(FUSED, workers=2) as several:
        assert several.update(things.frames[1]) == alone(FUSED)[0]
