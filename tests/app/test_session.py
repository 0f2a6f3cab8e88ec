# SPDX-License-Identifier: MIT
"""A session: runs forwards and backwards up to the next drawn box, undo, and errors."""

import json
import threading
import warnings
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.app.exports import EXPORTS
from tricue.camera.shared_frame import messages_of, warn_of_frame
from tricue.errors import BoxError

from tests.app.conftest import FRAMES, START, moving
from tests.app.session_runs import PATIENCE, Counting, Gate, SessionOf, counts, run, wait


def test_target_is_followed_to_the_end(video: Path, session_of: SessionOf) -> None:
    """The default tracker holds the square within a few pixels, and notices where it isn't seen."""
    session = session_of(video)
    session.add(0, START, "fused")
    run(session, 0, 1)
    tracks = session.project.target(1).tracks
    assert sorted(tracks) == list(range(FRAMES))
    errors = [abs(tracks[at].box.x - 20 - at) for at in range(28)]
    assert max(errors) < 4
    assert any(tracks[at].status is not Status.TRACKED for at in range(31, 40))


def test_target_is_followed_backwards(video: Path, session_of: SessionOf) -> None:
    """From a later frame back to the first."""
    session = session_of(video)
    session.add(25, START._replace(x=45), "fused")
    run(session, 25, -1)
    tracks = session.project.target(1).tracks
    assert sorted(tracks) == list(range(26))
    assert max(abs(tracks[at].box.x - 20 - at) for at in range(26)) < 4


def test_box_on_which_nothing_can_start_is_refused(video: Path, session_of: SessionOf) -> None:
    """A box outside the image, or too thin for trackers, is refused when it is drawn, not on tracking."""
    session = session_of(video)
    session.add(0, START, "fused")
    before = session.project
    for box, message in (
        ((500, 500, 20, 20), "a part inside the image of 160x120"),
        ((0, 0, 1, 9), "2 pixels"),
    ):
        with pytest.raises(BoxError, match=message):
            session.add(0, box, "fused")
        with pytest.raises(BoxError, match=message):
            session.draw(1, 5, box)
    assert session.project == before


def test_warnings_of_a_run_are_told_once(
    video: Path, session_of: SessionOf, counting: type[Counting], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two targets warn of every frame; nothing goes to the terminal, which the page's user doesn't see."""

    def update(self: Counting, frame: Frame) -> Track:
        warn_of_frame(messages_of(frame), "color: too dark", stacklevel=1)
        return Track(self.box, 1.0, Status.TRACKED)

    monkeypatch.setattr(counting, "update", update)
    session = session_of(video)
    for _ in range(2):
        session.add(0, START, "counting")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run(session, 0, 1)
    assert session.errors == ["warning: color: too dark"]
    run(session, FRAMES - 1, -1)
    assert session.errors == 2 * ["warning: color: too dark"]


@pytest.mark.usefixtures("counting")
def test_run_ends_at_the_next_drawn_box(video: Path, session_of: SessionOf) -> None:
    """What was tracked from a later drawn box stays, forwards and backwards."""
    session = session_of(video)
    session.add(0, START, "counting")
    session.draw(1, 10, START)
    run(session, 10, 1)
    run(session, 0, 1)
    assert counts(session) == {**{at: at for at in range(10)}, **{at: at - 10 for at in range(10, FRAMES)}}
    session.draw(1, 5, START)
    run(session, 10, -1)
    assert counts(session) == {
        **{at: at for at in range(5)},
        **{at: 10 - at for at in range(6, 11)},
        **{at: at - 10 for at in range(11, FRAMES)},
    }


def test_time_runs_on_backwards(video: Path, session_of: SessionOf, counting: type[Counting]) -> None:
    """A tracker never sees time go back."""
    session = session_of(video)
    session.add(20, START, "counting")
    run(session, 20, -1)
    assert np.diff(counting.times) == pytest.approx(np.full(20, 1 / 30))


def test_pause_goes_on_where_it_was(video: Path, session_of: SessionOf, counting: type[Counting]) -> None:
    """A paused tracker goes on with all that it knows; after an edit there it starts anew."""
    session = session_of(video)
    session.add(0, START, "counting")
    counting.gate = Gate()
    session.track(0, 1)
    assert counting.gate.reached.wait(PATIENCE)
    stopping = threading.Thread(target=session.pause)
    stopping.start()
    wait(lambda: session.run is None or session.run.stop.is_set())
    counting.gate.open.set()
    stopping.join()
    assert session.last_run is not None
    assert session.last_run.reached == 5
    run(session, 5, 1)
    assert counts(session) == {at: at for at in range(FRAMES)}
    session.draw(1, 20, START)
    run(session, 20, 1)
    assert counts(session)[30] == 10


@pytest.mark.usefixtures("counting")
def test_each_target_ends_by_itself(video: Path, session_of: SessionOf) -> None:
    """Of two targets tracked together, one ends at its drawn box, the other at the end of the video."""
    session = session_of(video)
    session.add(0, START, "counting")
    session.add(0, START, "counting")
    session.draw(2, 8, START)
    run(session, 0, 1)
    assert max(counts(session, 1)) == FRAMES - 1
    assert max(counts(session, 2)) == 7


def test_error_of_a_tracker_is_told_once(
    video: Path, session_of: SessionOf, counting: type[Counting]
) -> None:
    """One line names target, tracker and frame; other targets go on, and what was found is kept."""
    session = session_of(video)
    session.add(0, START, "counting")
    session.add(0, START, "fused")
    counting.bad = {7}
    run(session, 0, 1)
    assert session.errors == ["Target 1, counting, frame 7: bad frame 7"]
    assert counts(session) == {at: at for at in range(7)}
    assert max(session.project.target(2).tracks) == FRAMES - 1


def test_a_box_that_is_unknown_is_the_last_one(
    video: Path, session_of: SessionOf, counting: type[Counting], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A third party's tracker may not know where a lost target is; pages and exports need numbers."""
    unknown = Track(Box(float("nan"), 0, 1, 1), 0.0, Status.LOST)
    monkeypatch.setattr(counting, "update", lambda *_: unknown)
    session = session_of(video)
    session.add(0, START, "counting")
    run(session, 0, 1)
    assert session.errors == []
    assert {track.box for track in session.project.target(1).tracks.values()} == {START}
    assert len(json.loads(EXPORTS["json"].write(session.tracked()))["tracks"]) == FRAMES


@pytest.mark.usefixtures("counting")
def test_undo_of_a_run(video: Path, session_of: SessionOf) -> None:
    """One undo takes back a run, the next the box, and redo brings both again."""
    session = session_of(video)
    session.add(0, START, "counting")
    run(session, 0, 1)
    whole = session.project
    session.undo()
    assert list(session.project.target(1).tracks) == [0]
    session.undo()
    assert session.project.targets == ()
    session.redo()
    session.redo()
    assert session.project == whole


def test_run_that_finds_nothing_is_no_step(
    video: Path, session_of: SessionOf, counting: type[Counting], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was undone can be done again after it; the same error is told again in the next run."""

    def refuse(*_: Any) -> Track:
        raise ValueError("nothing here")

    monkeypatch.setattr(counting, "init", refuse)
    session = session_of(video)
    session.add(0, START, "counting")
    session.draw(1, 5, START)
    session.undo()
    run(session, 0, 1)
    run(session, 0, 1)
    assert session.errors == ["Target 1, counting, frame 0: nothing here"] * 2
    session.redo()
    assert sorted(session.project.target(1).drawn) == [0, 5]


def test_edit_ends_the_run_first(video: Path, session_of: SessionOf, counting: type[Counting]) -> None:
    """What is edited while a tracker runs is edited after it, and one undo takes back the edit alone."""
    session = session_of(video)
    session.add(0, START, "counting")
    counting.gate = Gate()
    session.track(0, 1)
    assert counting.gate.reached.wait(PATIENCE)
    editing = threading.Thread(target=lambda: session.add(3, START, "fused"))
    editing.start()
    wait(lambda: session.run is None or session.run.stop.is_set())
    counting.gate.open.set()
    editing.join()
    assert session.run is None
    assert len(session.project.targets) == 2
    session.undo()
    assert counts(session) == {at: at for at in range(6)}


@pytest.mark.parametrize(
    ("frame", "step", "message"),
    [
        (5, 1, "frame 5: expected a box to start on; draw one around Target 1"),
        (0, -1, "frame 0: nothing to track, it is the first one"),
        (8, 1, "frame 8: nothing to track, frame 9 has a drawn box; track from there"),
        (60, 1, "frame: expected a number from 0 to 59, got 60"),
        ("0", 1, "frame: expected a number from 0 to 59, got '0'"),
    ],
)
def test_run_that_cannot_be_is_refused(
    video: Path, session_of: SessionOf, frame: Any, step: Any, message: str
) -> None:
    """One line says why, and what to do."""
    session = session_of(video)
    session.add(0, START, "fused")
    for drawn in (8, 9):
        session.draw(1, drawn, START)
    with pytest.raises(ValueError, match=message):
        session.track(frame, step)
    assert session.run is None


def test_no_targets_are_not_all(video: Path, session_of: SessionOf) -> None:
    """Without a list all are followed; an empty one names none."""
    session = session_of(video)
    session.add(0, START, "fused")
    with pytest.raises(ValueError, match="draw one around a target"):
        session.track(0, 1, [])


@pytest.mark.usefixtures("counting")
def test_trackers_are_those_that_fit(video: Path, session_of: SessionOf) -> None:
    """Color alone has no tracker that needs depth or a pair; each tells what it follows."""
    session = session_of(video)
    assert {"fused", "color-particle", "flow-depth"} <= set(session.trackers)
    assert not {"stereo-head", "depth-particle"} & set(session.trackers)
    with pytest.raises(ValueError, match=r"tracker: expected one of .*, got 'stereo-head'"):
        session.add(0, START, "stereo-head")
    session.add(0, START, "flow-depth")
    run(session, 0, 1)
    assert session.errors == []
    assert max(session.project.target(1).tracks) == FRAMES - 1


def test_image_that_vanishes_ends_the_run(tmp_path: Path, session_of: SessionOf) -> None:
    """A file of a folder that is gone is named; what was tracked before it is kept."""
    folder = tmp_path / "images"
    folder.mkdir()
    for at, image in enumerate(moving(20)):
        cv2.imwrite(str(folder / f"{at:02d}.png"), image)
    session = session_of(folder)
    session.add(0, START, "fused")
    (folder / "10.png").unlink()
    run(session, 0, 1)
    assert session.errors == [f"{folder / '10.png'}: there is no such file"]
    assert max(session.project.target(1).tracks) == 9


def test_frames_that_end_the_run_early_are_told(tmp_path: Path, session_of: SessionOf) -> None:
    """A run ends before images of another size at the end, and says so."""
    for at, image in enumerate(moving(5)):
        cv2.imwrite(str(tmp_path / f"{at}.png"), image if at < 3 else image[::2, ::2])
    session = session_of(tmp_path, tmp_path / "project")
    session.add(0, START, "fused")
    run(session, 0, 1)
    assert [*session.project.targets[0].tracks] == [0, 1, 2]
    assert session.errors == ["frame 4: expected the first frame's size 160x120, got 80x60 px"]
