# SPDX-License-Identifier: MIT
"""What processes tell each other: tracks as plain values, which are pickled thirty times as fast."""

import pickle
from multiprocessing.connection import Connection
from typing import Any

from tricue.camera.box import Box
from tricue.track.base.track import Status, Track

WAKE = "wake"  # in the place of a method, without an answer: another request follows at once
PlainTracks = dict[int, tuple[Any, ...]]


def send(connection: Connection, message: tuple[Any, ...]) -> None:
    """Send a message; OSError where nobody has the other end."""
    connection.send_bytes(pickle.dumps(message, pickle.HIGHEST_PROTOCOL))


def receive(connection: Connection) -> Any:
    """The next message; EOFError, OSError or UnpicklingError where none can come any more."""
    return pickle.loads(connection.recv_bytes())


def to_plain(tracks: dict[int, Track]) -> PlainTracks:
    """The tracks' attributes."""
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
