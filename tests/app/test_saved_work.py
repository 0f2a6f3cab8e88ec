# SPDX-License-Identifier: MIT
"""A session's file: it keeps up with the work, and belongs to one video."""

import json
import os
from pathlib import Path

import pytest
from tricue.app import project_file, saver
from tricue.app.exports import EXPORTS

from tests.app.conftest import START, moving, write_video
from tests.app.session_runs import Counting, Gate, SessionOf, counts, run, wait


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
    counting.gate = Gate()
    session.track(0, 1)
    try:
        wait(lambda: len(json.loads(path.read_text())["targets"][0]["tracks"]) >= 5)
        assert session.run is not None
    finally:
        counting.gate.open.set()


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
