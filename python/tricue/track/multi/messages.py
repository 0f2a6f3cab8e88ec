# SPDX-License-Identifier: MIT
"""Messages between processes: tracks as plain values, which pickle thirty times as fast."""

import os
import pickle
import select
from multiprocessing.connection import Connection
from typing import Any

from tricue.camera.box import Box
from tricue.track.base.track import Status, Track

WAKE = "wake"  # in place of a method; it has no answer, and another request follows at once
NUMBER_BYTES = 8  # before a message, so that even one that can't be unpickled can be answered
MAX_POLLS = 2000  # takes about a millisecond
CORES = len(os.sched_getaffinity(0))
PlainTracks = dict[int, tuple[Any, ...]]


def send(connection: Connection, number: int, *message: Any) -> None:
    """Send a request's message or its answer; OSError if the other end is closed."""
    data = pickle.dumps(message, pickle.HIGHEST_PROTOCOL)
    connection.send_bytes(number.to_bytes(NUMBER_BYTES, "little") + data)


def receive(connection: Connection) -> tuple[int, memoryview]:
    """The next message, pickled, and its number; EOFError or OSError if none can come anymore."""
    data = memoryview(connection.recv_bytes())
    return int.from_bytes(data[:NUMBER_BYTES], "little"), data[NUMBER_BYTES:]


def poller(connection: Connection) -> select.poll:
    """Tells, by its ``poll``, whether a message has come; faster than the connection's own."""
    made = select.poll()
    made.register(connection.fileno(), select.POLLIN)
    return made


def stay_awake(messages: select.poll) -> None:
    """Wait busily, for a while, for a message that is about to come: waking up would take as long. Not on a
    single core, where the other process couldn't run meanwhile.
    """
    for _ in range(MAX_POLLS if CORES > 1 else 0):
        if messages.poll(0):
            return


def unpicklable(error: Exception) -> TypeError:
    """The error for a tracker that can't be sent to another process."""
    return TypeError(f"workers: expected 1, or a tracker that can be pickled; {error}")


def to_plain(tracks: dict[int, Track]) -> PlainTracks:
    """The attributes of tracks, as plain values."""
    return {
        target: (
            *(tuple(track.box), track.score, track.status.value),
            *(track.position, track.covariance, track.depth, track.pose),
        )
        for target, track in tracks.items()
    }


def from_plain(tracks: PlainTracks) -> dict[int, Track]:
    """The tracks with these attributes."""
    return {
        target: Track(Box(*box), score, Status(status), *others)
        for target, (box, score, status, *others) in tracks.items()
    }
