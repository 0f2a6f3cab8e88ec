# SPDX-License-Identifier: MIT
"""A camera in work: a box belongs to the frame it was drawn in, trackers catch up, recordings are whole."""

import csv
import errno
import json
import warnings
from pathlib import Path

import cv2
import pytest
from tricue import Box, Frame, Status, Track
from tricue.app.live.session import Opened
from tricue.camera.shared_frame import messages_of, warn_of_frame
from tricue.draw.video import count_frames

from tests.app.conftest import START
from tests.app.live import conftest as live_conftest
from tests.app.live.conftest import IMAGES, Studio, level, wait


def place(studio: Studio, target: int = 1) -> Box:
    """The target's present box."""
    return next(each.track.box for each in studio.session.targets if each.target.id == target)


def test_a_box_belongs_to_its_frame(studio: Studio) -> None:
    """It proves that a box drawn in an older frame is started there, and has caught up in the next one."""
    studio.begin()
    number = studio.shows(3)
    studio.session.hold("page", number)
    studio.shows(15)  # while someone draws
    box = START._replace(x=START.x + level(number))
    assert studio.session.add(number, list(box), "fused") == 1
    latest = studio.shows()
    assert latest == number + 16
    assert abs(place(studio).x - START.x - level(latest)) < 3
    assert studio.session.recent[-1].tracks[1].status is Status.TRACKED
    assert studio.session.recent[-1].number == latest


def test_a_box_of_a_frame_that_is_gone(studio: Studio) -> None:
    """It proves that frames nobody has shown, and bad boxes, are refused in a line, and nothing changes."""
    studio.begin()
    for frame, box, message in ((99, START, "the frame is gone"), (0, [1, 2], "box"), ("0", START, "frame")):
        with pytest.raises(ValueError, match=message):
            studio.session.add(frame, list(box), "fused")
    with pytest.raises(ValueError, match="tracker: expected one of"):
        studio.session.add(0, list(START), "os:system")
    assert studio.session.targets == []


def test_pause_and_going_on(studio: Studio) -> None:
    """It proves that a pause keeps picture and tracks, and that trackers then catch up with what came."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    paused_at = studio.shows(3)
    studio.session.pause()
    for number in range(paused_at + 1, paused_at + 13):
        studio.device.give()
        wait(lambda number=number: studio.session._number == number)
    assert studio.session.phase == "paused"
    assert studio.session.latest[0] == paused_at
    assert studio.session.add(paused_at, [0, 0, 20, 20], "fused") == 2
    assert set(studio.session.recent[-1].tracks) == {1, 2}
    studio.session.go_on()
    studio.shows(2)
    given = studio.device.given
    assert abs(place(studio).x - START.x - level(given - 1)) < 3


def test_pause_before_the_first_picture(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a target can be added in a frame that came during such a pause."""
    begin = studio.session._begin

    def begin_paused(opened: Opened) -> None:
        begin(opened)
        studio.session.pause()

    monkeypatch.setattr(studio.session, "_begin", begin_paused)
    studio.session.start()
    wait(lambda: studio.session._number == 0)
    assert studio.session.add(0, list(START), "fused") == 1
    studio.session.go_on()
    studio.shows()
    assert studio.session.recent[-1].tracks[1].status is Status.TRACKED


def test_targets_are_corrected_named_and_removed(studio: Studio) -> None:
    """It proves that a target is drawn anew, followed by another tracker, renamed, and removed."""
    studio.begin()
    studio.session.add(0, [100, 90, 20, 20], "fused")
    number = studio.shows()
    studio.session.draw(1, number, list(START._replace(x=START.x + level(number))))
    number = studio.shows(4)
    assert abs(place(studio).x - START.x - level(number)) < 3
    studio.session.rename(1, "  Anna  ")
    studio.session.choose_tracker(1, "color-particle")
    studio.shows()
    (only,) = studio.session.targets
    assert (only.target.name, only.target.tracker) == ("Anna", "color-particle")
    studio.session.delete(1)
    studio.shows()
    assert studio.session.recent[-1].tracks == {}
    assert studio.session.add(studio.session.latest[0], list(START), "fused") == 2
    for change in (studio.session.delete, lambda each: studio.session.rename(each, "x")):
        with pytest.raises(ValueError, match="target: expected one of"):
            change(1)


def test_a_removed_target_keeps_no_frame(studio: Studio) -> None:
    """It proves that one drawn and removed in a pause leaves the backlog as it was."""
    studio.begin()
    studio.session.pause()
    studio.session.add(0, list(START), "fused")
    studio.session.delete(1)
    assert list(studio.session._backlog._held) == [studio.session]


def test_images_of_another_size(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that trackers stop where the camera comes back so, that boxes then are of that size, and that
    a tracker chosen meanwhile starts on the next one.
    """
    studio.begin()
    studio.session.add(0, list(START), "fused")
    before = studio.session.size
    monkeypatch.setattr(live_conftest, "IMAGES", [cv2.resize(each, None, fx=2, fy=2) for each in IMAGES])
    number = studio.shows(2)
    width, height = studio.session.size
    assert (width, height) == (2 * before[0], 2 * before[1])
    assert studio.session.errors == [f"a camera: its images are {width}x{height} px now; draw the boxes anew"]
    studio.session.choose_tracker(1, "color-particle")
    assert studio.session.targets[0].stopped
    studio.session.draw(1, number, [2 * (START.x + level(number)), *(2 * each for each in START[1:])])
    number = studio.shows()
    assert abs(place(studio).x - 2 * (START.x + level(number))) < 6
    assert studio.session.targets[0].target.tracker == "color-particle"
    assert type(studio.session.targets[0].tracker).__name__ == "ColorParticleTracker"


def test_images_of_another_size_end_a_recording(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a recording has frames and boxes of one size, is finished, and that the page is told."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    studio.session.record()
    studio.shows(3)
    width, height = studio.session.size
    monkeypatch.setattr(live_conftest, "IMAGES", [cv2.resize(each, None, fx=2, fy=2) for each in IMAGES])
    studio.shows(2)
    assert studio.session.recorder is None
    changed = f"a camera: its images are {2 * width}x{2 * height} px now"
    assert studio.session.errors == [f"{changed}, so the recording has ended; draw the boxes anew"]
    table, told, video = studio.session.recorded
    assert len(table.read_text().splitlines()) == 1 + 3
    assert len(json.loads(told.read_text())["tracks"]) == 3
    assert cv2.VideoCapture(str(video)).read()[0]


def test_a_tracker_that_breaks_ends_alone(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an error of one tracker is said once, and others go on."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    studio.session.add(0, [0, 0, 30, 30], "color-particle")
    first = studio.session.targets[1].tracker

    def broken(_frame: object) -> None:
        raise RuntimeError("it\nbroke")

    monkeypatch.setattr(first, "update", broken)
    number = studio.shows(3)
    assert studio.session.errors == ["Target 2, color-particle: it broke"]
    assert [each.stopped for each in studio.session.targets] == [False, True]
    assert studio.session.recent[-1].tracks[2].status is Status.LOST
    assert abs(place(studio).x - START.x - level(number)) < 3


def test_warnings_are_told(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a tracker's warning about a frame reaches the page, with the target's name."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    tracker = studio.session.targets[0].tracker
    update = tracker.update

    def warn(frame: Frame) -> Track:
        warn_of_frame(messages_of(frame), "depth: not registered", stacklevel=1)
        return update(frame)

    monkeypatch.setattr(tracker, "update", warn)
    studio.shows()
    assert studio.session.errors == ["Target 1, fused: warning: depth: not registered"]


def test_a_box_that_is_unknown_is_the_last_one(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a lost target without a box, as a third party's may be, stays where it was seen last."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    unknown = Track(Box(float("nan"), 0, 1, 1), 0.0, Status.LOST)
    monkeypatch.setattr(studio.session.targets[0].tracker, "update", lambda _: unknown)
    studio.session.record()
    studio.shows(3)
    assert place(studio) == START
    assert studio.session.errors == []
    assert studio.session.recorder is not None


def test_what_is_recorded(studio: Studio, tmp_path: Path) -> None:
    """It proves that table, JSON and video hold what was tracked between start and stop."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    studio.shows(2)
    studio.session.record()
    first = studio.shows()
    last = studio.shows(9)
    assert studio.session.recorder is not None
    written = studio.session.recorder.files[0].read_text().splitlines()
    assert len(written) == 11  # while it is recorded
    studio.session.stop_recording()
    studio.shows(2)
    table, told, video = studio.session.recorded
    assert {path.parent for path in studio.session.recorded} == {tmp_path}
    assert studio.said == [f"wrote {table}, {told}, {video}"]
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [int(row["frame"]) for row in rows] == list(range(first, last + 1))
    assert {row["id"] for row in rows} == {"1"}
    content = json.loads(told.read_text())
    assert content["source"] == "a camera"
    entries = ["tricue", "source", "seed", "kernels", "intrinsics", "baseline", "started"]
    assert list(content) == [*entries, "tracks", "targets", "lost", "fps"]
    assert content["targets"] == [{"id": 1, "name": "Target 1", "tracker": "fused"}]
    assert [each["frame"] for each in content["tracks"]] == list(range(first, last + 1))
    capture = cv2.VideoCapture(str(video))
    assert capture.isOpened()
    assert capture.read()[0]


def test_recordings_of_one_second_have_names_of_their_own(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that none is overwritten by the next."""
    studio.begin()
    monkeypatch.setattr("time.strftime", lambda _: "now")
    tables = []
    for _ in range(3):
        studio.session.record()
        studio.shows()
        studio.session.stop_recording()
        tables.append(studio.session.recorded[0].name)
    assert tables == ["a-camera-now.csv", "a-camera-now-2.csv", "a-camera-now-3.csv"]


def test_a_recording_is_finished_at_the_end(studio: Studio) -> None:
    """It proves that closing lets the camera go and finishes the files."""
    studio.begin()
    studio.session.record()
    studio.shows(3)
    studio.device.give(3)
    studio.session.close()
    assert json.loads(studio.session.recorded[1].read_text())["tracks"] == []
    wait(lambda: studio.device.closed >= studio.device.opened)
    studio.session.start()  # too late
    assert studio.device.opened == studio.device.closed


def test_a_table_that_cannot_be_finished(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a disk that is full is told, and that the other files of the recording are finished."""
    studio.begin()
    studio.session.record()
    studio.shows(3)
    recorder = studio.session.recorder

    def full() -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    assert recorder is not None
    monkeypatch.setattr(recorder._json, "finish", full)
    studio.session.stop_recording()
    assert studio.session.errors == ["not recorded: No space left on device"]
    assert recorder._csv._file.closed
    assert recorder._json._file.closed
    assert not recorder._thread.is_alive()
    assert count_frames(recorder.files[2]) > 0


def test_tables_that_are_removed(studio: Studio) -> None:
    """They are named, as the video is."""
    studio.begin()
    studio.session.record()
    studio.shows(3)
    assert studio.session.recorder is not None
    table, other, video = studio.session.recorder.files
    for path in (table, other):
        path.unlink()
    studio.session.stop_recording()
    told = [f"not recorded: {path}: was removed while it was written" for path in (table, other)]
    assert (studio.session.errors, studio.session.recorded) == (told, (video,))


def test_a_folder_that_cannot_be_written(studio: Studio, tmp_path: Path) -> None:
    """It proves that the error names the file, and that the camera goes on."""
    studio.begin()
    studio.session.folder = tmp_path / "missing" / "more"
    (tmp_path / "missing").write_text("a file")
    with pytest.raises(OSError, match="missing"):
        studio.session.record()
    assert studio.session.recorder is None
    studio.shows()


def test_a_camera_that_stops_and_comes_back(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an outage is told while it lasts, and that targets are followed after it."""
    studio.begin()
    studio.session.add(0, list(START), "fused")
    studio.shows(2)
    studio.device.refused = "it is away"
    studio.device.broken = True
    warned: list[str] = []
    monkeypatch.setattr(warnings, "warn", lambda text, **_: warned.append(text))
    wait(lambda: studio.session.health.trouble and warned)
    assert warned == ["a camera: it stopped giving frames; connecting again"]
    studio.device.refused, studio.device.broken = "", False
    number = studio.shows(2)
    assert (studio.session.health.reopened, studio.session.health.trouble) == (1, "")
    assert studio.session.phase == "live"
    assert abs(place(studio).x - START.x - level(number)) < 4


def test_a_camera_that_never_starts(studio: Studio) -> None:
    """It proves that it is said in one line, on the page and the terminal, and can be tried again."""
    studio.device.refused = "a camera: can't be opened; is it plugged in and not in use elsewhere?"
    studio.session.start()
    wait(lambda: studio.session.phase == "ended")
    assert studio.session.problem == studio.device.refused
    assert studio.said == [studio.device.refused]
    with pytest.raises(ValueError, match="there is nothing to record"):
        studio.session.record()
    with pytest.raises(ValueError, match="tracker"):
        studio.session.add(0, list(START), "fused")
    studio.device.refused = ""
    wait(lambda: not studio.session._thread.is_alive())
    studio.begin()
    assert (studio.session.phase, studio.session.problem) == ("live", "")
