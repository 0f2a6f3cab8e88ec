# SPDX-License-Identifier: MIT
"""The overlay video that a session makes in the background."""

import threading
import time
from pathlib import Path

import pytest
from tricue.draw import video_encoders

from tests.app.conftest import FRAMES, START
from tests.app.session_runs import SessionOf, wait


def test_overlay_video_is_made_in_the_background(video: Path, session_of: SessionOf, tmp_path: Path) -> None:
    """The job tells how far it is, and where the file is in the end."""
    session = session_of(video)
    session.add(0, START, "fused")
    session.make_video(tmp_path / "out.mp4")
    wait(lambda: session.job and (session.job.path or session.job.error))
    assert session.job is not None
    assert (session.job.path, session.job.error, session.job.written) == (tmp_path / "out.mp4", "", FRAMES)


def test_a_video_that_is_given_up_is_closed(
    video: Path, session_of: SessionOf, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However long its file takes to be finished: the next one has the same name."""
    begun, ended = threading.Event(), threading.Event()

    def slowly(_: Path) -> None:
        begun.set()
        time.sleep(0.3)
        ended.set()

    monkeypatch.setattr(video_encoders, "_defragment", slowly)
    session = session_of(video)
    session.make_video(tmp_path / "out.mp4")
    wait(begun.is_set)
    session.cancel_video()
    assert ended.is_set()
