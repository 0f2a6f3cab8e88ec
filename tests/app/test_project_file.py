# SPDX-License-Identifier: MIT
"""The project's file: what is written is read, a broken one is named, another video is noticed."""

import json
import os
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tricue import Box, Pose, Status, Track
from tricue.app import project as edits
from tricue.app import project_file
from tricue.app.project import Project
from tricue.app.project_file import Footprint, footprint, load, project_path, save

COVARIANCE = np.array([[0.01, 0.002, 0.0], [0.002, 0.02, 0.001], [0.0, 0.001, 0.3]])


@pytest.fixture
def full() -> Project:
    """Two targets, one of them with all that a track can have."""
    project = edits.add_target(Project(), 0, Box(1.5, 2, 30, 40), "fused")
    project = edits.rename_target(
        edits.add_target(project, 3, Box(9, 9, 9, 9), "flow-depth"), 2, 'Ännchen "x"'
    )
    place = np.array([0.1, -0.2, 2.5])
    found = {
        1: Track(Box(2.25, 3, 30, 40), 0.75, Status.TRACKED, place, COVARIANCE, 2.5),
        2: Track(Box(3, 3, 30, 40), 0.5, Status.OCCLUDED, depth=2.25),
        3: Track(Box(4, 3, 30, 40), 0.0, Status.LOST),
    }
    return edits.add_tracks(project, {1: found})


def test_what_is_saved_is_loaded(full: Project, video: Path, tmp_path: Path) -> None:
    """Targets, names, boxes, statuses, positions and covariances come back, and the video's footprint."""
    seen = footprint(video, 60, (160, 120))
    save(tmp_path / "project", full, seen)
    assert load(tmp_path / "project") == (full, seen)


def test_pose_is_the_cameras(full: Project, video: Path, tmp_path: Path) -> None:
    """Tracks get the pose of the camera they are opened with: the file has positions in its frame."""
    pose = Pose(np.eye(3), (1.0, 0.0, 0.0))
    save(tmp_path / "project", full, footprint(video, 60, (160, 120)))
    found, _ = load(tmp_path / "project", pose)
    assert found.target(1).tracks[1].world_position == pytest.approx([1.1, -0.2, 2.5])


def test_file_is_for_people_too(full: Project, video: Path, tmp_path: Path) -> None:
    """It is JSON with a track a line, and names as they are written."""
    save(tmp_path / "project", full, footprint(video, 60, (160, 120)))
    text = (tmp_path / "project").read_text(encoding="utf-8")
    assert json.loads(text)["targets"][1]["name"] == 'Ännchen "x"'
    assert '\n    [3, "lost", 0.0, 4.0, 3.0, 30.0, 40.0]' in text


def test_file_of_an_older_tricue_has_no_untracked_boxes(full: Project, video: Path, tmp_path: Path) -> None:
    """It didn't note which boxes were never tracked from, so the page hints at none."""
    path = tmp_path / "project"
    save(path, full, footprint(video, 60, (160, 120)))
    assert load(path)[0].target(2).untracked == {3}
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace('   "untracked": [3],\n', ""), encoding="utf-8")
    assert load(path)[0].target(2).untracked == set()


def test_saving_is_all_or_nothing(
    full: Project, video: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk that is full leaves the file of before."""
    path, seen = tmp_path / "project", footprint(video, 60, (160, 120))
    save(path, full, seen)

    def full_disk(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full_disk)
    with pytest.raises(OSError, match="No space left"):
        save(path, Project(), seen)
    assert load(path) == (full, seen)


def test_saving_that_fails_leaves_nothing(
    full: Project, video: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Least of all on a full disk."""

    def full_disk(_: int) -> None:
        raise OSError(28, "No space left on device")

    before = sorted(tmp_path.iterdir())
    monkeypatch.setattr(os, "fsync", full_disk)
    with pytest.raises(OSError, match="No space left"):
        save(tmp_path / "project", full, footprint(video, 60, (160, 120)))
    assert sorted(tmp_path.iterdir()) == before


def test_link_stays_one(full: Project, video: Path, tmp_path: Path) -> None:
    """A project that is a link to a file elsewhere is saved there."""
    (tmp_path / "elsewhere").mkdir()
    path, file = tmp_path / "project", tmp_path / "elsewhere" / "kept"
    path.symlink_to(file)
    save(path, full, footprint(video, 60, (160, 120)))
    assert path.is_symlink()
    assert load(file)[0] == full


@pytest.mark.parametrize(
    "content",
    [
        *("", "{}", "[]", '{"format": 1, "targets": [{"id": 1}]}', "\udcff", '{"format": "x"}'),
        *(
            f'{{"format": 1, "targets": [{{"id": 1, "name": "a", "tracker": "fused", {rest}}}]}}'
            for rest in ('"drawn": {"True": [1, 2, 3, 4]}', '"drawn": {"0": [1, 2]}', '"drawn": []')
        ),
        '{"format": 1, "targets": [{"id": 1e999, "name": "a", "tracker": "", "drawn": {}, "tracks": []}]}',
    ],
)
def test_broken_file_is_named(content: str, tmp_path: Path) -> None:
    """What isn't a project is an error of one line, not a project without targets."""
    path = tmp_path / "video.mp4.tricue.json"
    path.write_bytes(content.encode(errors="surrogateescape"))
    with pytest.raises(ValueError, match=r"video\.mp4\.tricue\.json: expected a project of tricue open"):
        load(path)


@pytest.mark.parametrize(
    ("written", "edited"),
    [
        ("[9, ", "[-9, "),
        ('"9": [', '"-9": ['),
        ('[9, "tracked", 1.0', '[9, "tracked", NaN'),
        ('"tracked", 1.0, 1.0', '"tracked", 1.0, Infinity'),
        ('"next_id": 2', '"next_id": 1'),
        ('"id": 1', '"id": 0'),
    ],
)
def test_numbers_that_cannot_be(written: str, edited: str, video: Path, tmp_path: Path) -> None:
    """A file that somebody has edited is refused where its numbers would break the page and the exports."""
    path = tmp_path / "video.mp4.tricue.json"
    save(path, edits.add_target(Project(), 9, Box(1, 2, 3, 4), "fused"), footprint(video, 60, (160, 120)))
    text = path.read_text()
    assert text.count(written) == 1
    path.write_text(text.replace(written, edited))
    with pytest.raises(ValueError, match="expected a project of tricue open"):
        load(path)


def test_newer_file_is_not_guessed_at(full: Project, video: Path, tmp_path: Path) -> None:
    """A project of a later format is refused with what to do."""
    path = tmp_path / "project"
    save(path, full, footprint(video, 60, (160, 120)))
    path.write_text(path.read_text().replace('"format": 1', '"format": 2'))
    with pytest.raises(ValueError, match="written by a newer tricue"):
        load(path)


def test_copied_video_is_the_same(video: Path, tmp_path: Path) -> None:
    """A copy, with another time of change, is no other video."""
    copy = Path(shutil.copy(video, tmp_path / "copy.mp4"))
    os.utime(copy, (1, 1))
    assert footprint(copy, 60, (160, 120)).differences(footprint(video, 60, (160, 120))) == []


def test_other_video_is_told_by_what_differs(video: Path) -> None:
    """Frames, size, length, and contents of the same length are each noticed."""
    before = footprint(video, 60, (160, 120))
    assert replace(before, frames=50).differences(before) == ["60 frames then, 50 now"]
    assert replace(before, width=320).differences(before) == ["160x120 px then, 320x120 now"]
    content = bytearray(video.read_bytes())
    content[len(content) // 3] ^= 255
    video.write_bytes(content)
    assert footprint(video, 60, (160, 120)).differences(before) == ["other contents of the same size"]
    video.write_bytes(content + b"more")
    found = footprint(video, 60, (160, 120)).differences(before)
    assert found == [f"{before.bytes:,} bytes then, {before.bytes + 4:,} now"]


def test_folders_footprint_are_its_images(tmp_path: Path) -> None:
    """An image more, or another name, is another recording; a project in the folder isn't."""
    for name in ("1.png", "2.png"):
        (tmp_path / name).write_bytes(b"x" * 10)
    before = footprint(tmp_path, 2, (4, 4))
    (tmp_path / "a.tricue.json").write_text("{}")
    assert footprint(tmp_path, 2, (4, 4)).differences(before) == []
    (tmp_path / "2.png").rename(tmp_path / "3.png")
    assert footprint(tmp_path, 2, (4, 4)).differences(before) == ["other contents of the same size"]


def test_project_is_beside_the_video(video: Path) -> None:
    """Where one looks for it, and where it moves along."""
    assert project_path(video) == video.with_name("video.mp4.tricue.json")


def test_project_is_in_the_data_folder_if_need_be(
    video: Path, data_home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the folder can't be written, the user's own folder is; videos of one name don't collide there."""
    monkeypatch.setattr(os, "access", lambda *_: False)
    found = project_path(video)
    assert found.parent == data_home / "tricue"
    assert found != project_path(video.parent / "other" / "video.mp4")


def test_project_of_a_long_name(tmp_path: Path, data_home: Path) -> None:
    """A name to which nothing can be added has its project in the data folder."""
    video = tmp_path / f"{'ひ' * 80}.mp4"
    video.write_bytes(b"")
    found = project_path(video)
    assert found.parent == data_home / "tricue"
    save(found, Project(), Footprint(video.name, 0, 0.0, "", 1, 1, 1))
    assert found.exists()


def test_put_aside_keeps_every_project(tmp_path: Path) -> None:
    """Projects that are put aside get names of their own."""
    path = tmp_path / "video.mp4.tricue.json"
    for text in ("first", "second"):
        path.write_text(text)
        project_file.put_aside(path)
    names = {each.name: each.read_text() for each in tmp_path.iterdir()}
    assert names == {"video.mp4.1.tricue.json": "first", "video.mp4.2.tricue.json": "second"}
