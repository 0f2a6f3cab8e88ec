# SPDX-License-Identifier: MIT
"""Worker processes that are killed, hang, or are interrupted: which targets are lost, and what goes on."""

import os
import signal
import threading
import time

import pytest
from tricue import MultiTracker
from tricue.errors import WorkerEndedError
from tricue.track.multi import remote_targets

from tests.track.multi.kinds import FUSED
from tests.track.multi.processes import PATIENCE, ends, is_running, process_of


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
