# SPDX-License-Identifier: MIT
"""Messages between processes: the wait for one."""

import socket
from multiprocessing.connection import Connection

import pytest
from tricue.track.multi import messages
from tricue.track.multi.messages import MAX_POLLS, poller, receive, send, stay_awake


class Counted:
    """Stands for a poller: a message comes at one of the polls."""

    def __init__(self, at: int) -> None:
        self.at, self.polls = at, 0

    def poll(self, milliseconds: int) -> bool:
        assert milliseconds == 0
        self.polls += 1
        return self.polls >= self.at


@pytest.mark.parametrize(
    ("cores", "at", "polls"), [(2, 1, 1), (2, 7, 7), (2, MAX_POLLS + 9, MAX_POLLS), (1, 7, 0)]
)
def test_a_busy_wait_ends_with_the_message(cores, at, polls, monkeypatch):
    """Or after a while, if none comes; on a single core there is none, as the other process has to run."""
    monkeypatch.setattr(messages, "CORES", cores)
    counted = Counted(at)
    stay_awake(counted)
    assert counted.polls == polls


def test_a_poller_tells_of_messages_and_of_the_end():
    """Nothing, a message, and that the other end is closed."""
    mine, theirs = (Connection(each.detach()) for each in socket.socketpair())
    with mine:
        there = poller(mine)
        assert not there.poll(0)
        with theirs:
            send(theirs, 5, "word")
            assert there.poll(0)
            assert receive(mine)[0] == 5
            assert not there.poll(0)
        assert there.poll(0)
        with pytest.raises(EOFError):
            receive(mine)
