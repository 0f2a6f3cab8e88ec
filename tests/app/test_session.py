# SPDX-License-Identifier: MIT
"""A session: runs forwards and backwards up to the next drawn box, undo, errors, and a file that keeps up."""

import json
import os
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.app import project_file, saver
from tricue.app.exports import EXPORTS
from tricue.app.session import Session
from tricue.draw import video_encoders
from tricue.track.base import registry
from tricue.track.base.traits import Channels, Traits

from tests.app.conftest import FRAMES, START, moving, write_video

SessionOf = Callable[..., Session]
PATIENCE = 60.0  # seconds that a busy machine may take


def wait(condition: Callable[[], Any]) -> None:
    """Wait until something holds."""
    until = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < until, "it never came about"
        time.sleep(0.005)


def run(session: Session, *arguments: Any) -> None:
    """Track, and wait until the run has ended."""
    session.track(*arguments)
    wait(lambda: session.run is None)


class Counting:
    """Says by its score how often it was updated since init; raises in the frames named in ``bad``."""

    traits = Traits(channels=(Channels.of("color"),), follows="nothing")
    Params = None
    bad: ClassVar[set[int]] = set()
    gate: ClassVar[threading.Event | None] = None
    times: ClassVar[list[float]] = []

    def __init__(self, seed: int = 0, kernels: str = "native") -> None:
        self.params: dict[str, Any] = {}
        self.count = 0

    def init(self, frame: Frame, box: Any = None) -> Track:
        self.box, self.count = Box(*box), 0
        return self._track(frame)

    def update(self, frame: Frame) -> Track:
        self.count += 1
        if self.count in self.bad:
            raise RuntimeError(f"bad\nframe {self.count}")
        if self.gate is not None and self.count == 5:
            self.gate.wait(PATIENCE)
        return self._track(frame)

    def _track(self, frame: Frame) -> Track:
        self.times.append(frame.timestamp or 0.0)
        return Track(self.box, self.count / 1000, Status.TRACKED)


@pytest.fixture
def counting(monkeypatch: pytest.MonkeyPatch) -> type[Counting]:
    """That tracker under the name "counting"."""
    monkeypatch.setitem(registry._BUILT_IN, "counting", f"{Counting.__module__}:Counting")
    for name, value in {"bad": set(), "gate": None, "times": []}.items():
        monkeypatch.setattr(Counting, name, value)
    return Counting


def counts(session: Session, target: int = 1) -> dict[int, int]:
    """How often the tracker had been updated, by frame; the drawn boxes' 1000 are left out."""
    tracks = session.project.target(target).tracks
    return {at: round(1000 * each.score) for at, each in sorted(tracks.items()) if each.score < 1}


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
    counting.gate = threading.Event()
    session.track(0, 1)
    wait(lambda: session.run is not None and len(session.run.found) >= 5)
    stopping = threading.Thread(target=session.pause)
    stopping.start()
    wait(lambda: session.run is None or session.run.stop.is_set())
    counting.gate.set()
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
    counting.gate = threading.Event()
    session.track(0, 1)
    wait(lambda: session.run is not None and len(session.run.found) >= 5)
    editing = threading.Thread(target=lambda: session.add(3, START, "fused"))
    editing.start()
    wait(lambda: session.run is None or session.run.stop.is_set())
    counting.gate.set()
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


@pytest.mark.usefixtures("counting")
def test_work_is_there_again(video: Path, session_of: SessionOf) -> None:
    """A second session has what the first one had."""
    session = session_of(video)
    session.add(0, START, "counting")
    run(session, 0, 1)
    session.edit(lambda project: project_file.Project(project.targets, 7))
    session.close()
    again = session_of(video)
    assert again.project == session.project
    assert again.project.next_id == 7


def test_work_is_saved_as_it_goes(video: Path, session_of: SessionOf, counting: type[Counting]) -> None:
    """A box is in the file soon after it was drawn, and so is what a run has found before it ends."""
    session = session_of(video)
    session.add(0, START, "counting")
    wait(lambda: session.saved)
    path = video.with_name("video.mp4.tricue.json")
    assert json.loads(path.read_text())["targets"][0]["drawn"] == {"0": [20, 40, 40, 40]}
    counting.gate = threading.Event()
    session.track(0, 1)
    try:
        wait(lambda: len(json.loads(path.read_text())["targets"][0]["tracks"]) >= 5)
        assert session.run is not None
    finally:
        counting.gate.set()


def test_other_video_is_asked_about(video: Path, session_of: SessionOf) -> None:
    """A project of another video isn't changed before the user has said what shall become of it."""
    first = session_of(video)
    first.add(0, START, "fused")
    first.close()
    path = video.with_name("video.mp4.tricue.json")
    project, seen = project_file.load(path)
    project_file.save(path, project, project_file.footprint(video, 50, seen_size(seen)))
    saved = path.read_bytes()
    session = session_of(video)
    assert session.changed_video == ["50 frames then, 60 now"]
    with pytest.raises(ValueError, match="the video has changed"):
        session.track(0, 1)
    session.edit(lambda project: project_file.Project(project.targets, 9))
    wait(lambda: session.saved)
    assert path.read_bytes() == saved
    session.keep_project(False)
    wait(lambda: session.saved and path.exists())
    assert session.project.targets == ()
    assert video.with_name("video.mp4.1.tricue.json").read_bytes() == saved


def seen_size(seen: project_file.Footprint) -> tuple[int, int]:
    """The frames' size of a footprint."""
    return seen.width, seen.height


def test_project_kept_for_another_video(video: Path, session_of: SessionOf) -> None:
    """Kept on request, it is saved with the new video's footprint, and not asked about again."""
    first = session_of(video)
    first.add(0, START, "fused")
    first.close()
    video.write_bytes(video.read_bytes() + b"more")
    session = session_of(video)
    assert session.changed_video
    session.keep_project(True)
    session.close()
    again = session_of(video)
    assert again.changed_video == []
    assert again.project.target(1).drawn == {0: START}


@pytest.mark.usefixtures("counting")
def test_project_kept_for_a_shorter_video(video: Path, session_of: SessionOf) -> None:
    """What was in frames that are gone is left out at once, and put aside if the rest is kept."""
    first = session_of(video)
    first.add(0, START, "counting")
    first.draw(1, 50, START)
    run(first, 0, 1)
    first.close()
    path = video.with_name("video.mp4.tricue.json")
    whole = path.read_bytes()
    write_video(video, moving(20))
    session = session_of(video)
    assert session.changed_video
    assert list(session.project.target(1).drawn) == [0]
    assert max(counts(session)) == 19
    assert all(export.write(session.tracked()) for export in EXPORTS.values())
    session.close()
    assert path.read_bytes() == whole
    session = session_of(video)
    session.keep_project(True)
    session.close()
    assert video.with_name("video.mp4.1.tricue.json").read_bytes() == whole
    assert max(counts(session_of(video))) == 19


def test_video_replaced_meanwhile_is_noticed(video: Path, session_of: SessionOf) -> None:
    """A video that is replaced, or goes away, while its page is open isn't tracked in."""
    session = session_of(video)
    session.add(0, START, "fused")
    os.utime(video, (1, 1))
    with pytest.raises(ValueError, match="changed since it was opened"):
        session.track(0, 1)
    video.unlink()
    with pytest.raises(ValueError, match="there is no such file or folder any more"):
        session.track(0, 1)


def test_foreign_changes_are_not_overwritten(video: Path, session_of: SessionOf) -> None:
    """A project that another program has written since is left alone, and that is said."""
    session = session_of(video)
    session.add(0, START, "fused")
    wait(lambda: session.saved)
    path = video.with_name("video.mp4.tricue.json")
    path.write_text("mine")
    os.utime(path, (5, 5))
    session.add(1, START, "fused")
    why = f"{path}: another program changed it, so it isn't overwritten; export your work"
    wait(lambda: session.unsaved == why)
    session.add(2, START, "fused")
    wait(lambda: session._saver._tried == session.version)
    assert (path.read_text(), session.saved, session.errors) == ("mine", False, [f"not saved: {why}"])
    session.close()
    assert session.unsaved == why


def test_disk_that_is_full_is_told(
    video: Path, session_of: SessionOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Work that can't be saved is an error in the page, and is tried again until there is room."""
    monkeypatch.setattr(saver, "SAVE_INTERVAL", 0.02)
    session = session_of(video)

    def full_disk(_: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(project_file.os, "fsync", full_disk)
        session.add(0, START, "fused")
        wait(lambda: session.errors)
        session.draw(1, 3, START)
        wait(lambda: session._saver._tried == session.version)
        assert (session.saved, session.unsaved) == (False, "No space left on device")
    wait(lambda: session.saved)
    assert session.errors == ["not saved: No space left on device"]
    assert session.unsaved == ""
    path = video.with_name("video.mp4.tricue.json")
    assert len(project_file.load(path)[0].target(1).drawn) == 2


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
