# SPDX-License-Identifier: MIT
"""Exports: CSV, JSON, MOT and COCO are read back by other code, and the overlay video shows the boxes."""

import csv
import dataclasses
import io
import json
import re
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box, Pose, Status, Track, app
from tricue.app import exports
from tricue.app import project as edits
from tricue.app.exports import Tracked
from tricue.app.frames import RecordedFrames
from tricue.app.project import Project
from tricue.app.session import Session
from tricue.cli import main
from tricue.data.open_source import open_source
from tricue.data.streams import Video
from tricue.draw.targets import TARGET_COLORS, target_color
from tricue.export.table import TableForm, columns

from tests.app.conftest import FRAMES, HEIGHT, START, WIDTH, moving
from tests.app.session_runs import run

POSE = Pose(np.eye(3), (1.0, 0.0, 0.0))


@pytest.fixture
def tracked(video: Path) -> Tracked:
    """Two targets: one tracked, occluded and lost in frames 0 to 2, with a position, one in frame 1 alone."""
    project = edits.add_target(Project(), 0, START, "fused")
    project = edits.rename_target(edits.add_target(project, 1, Box(5, 6, 7, 8), "flow-depth"), 2, "Anna")
    place = np.array([0.1, -0.2, 2.5])
    found = {
        1: Track(START, 0.5, Status.OCCLUDED, place, np.diag([0.01, 0.01, 0.09]), 2.5, POSE),
        2: Track(START, 0.0, Status.LOST),
    }
    return Tracked(
        edits.add_tracks(project, {1: found}),
        RecordedFrames(open_source(video)),
        {"source": "video"},
        world=True,
    )


def test_csv_has_a_line_per_frame_and_target(tracked: Tracked) -> None:
    """Lines are ordered by frame, then id; what wasn't measured is empty."""
    rows = list(csv.DictReader(io.StringIO(exports.as_csv(tracked))))
    assert [(row["frame"], row["id"], row["status"]) for row in rows] == [
        ("0", "1", "tracked"),
        ("1", "1", "occluded"),
        ("1", "2", "tracked"),
        ("2", "1", "lost"),
    ]
    assert rows[1]["time_s"] == "0.033333"
    assert [rows[1][name] for name in ("x", "Z_m", "ZZ_m2", "world_X_m")] == ["20.0", "2.5", "0.09", "1.1"]
    assert rows[2]["Z_m"] == rows[2]["world_X_m"] == ""


def test_json_has_the_same_and_the_names(tracked: Tracked) -> None:
    """The numbers of the CSV, and what the ids stand for."""
    content = json.loads(exports.as_json(tracked))
    assert content["targets"][1] == {"id": 2, "name": "Anna", "tracker": "flow-depth"}
    assert content["lost"] == [{"id": 1, "first": 2, "last": 2, "start_s": 0.066667, "end_s": 0.066667}]
    assert content["lost"][0]["start_s"] == content["tracks"][-1]["time_s"]
    rows = csv.DictReader(io.StringIO(exports.as_csv(tracked)))
    for mine, row in zip(content["tracks"], rows, strict=True):
        assert {name: "" if value is None else str(value) for name, value in mine.items()} == row


def test_lost_ranges_are_those_of_the_page(tracked: Tracked) -> None:
    """A range ends where the target wasn't tracked, as it does in the page's list."""
    lost = Track(START, 0.0, Status.LOST)
    project = edits.add_tracks(tracked.project, {1: {3: lost, 7: lost}})
    content = json.loads(exports.as_json(dataclasses.replace(tracked, project=project)))
    assert [(each["first"], each["last"]) for each in content["lost"]] == [(2, 3), (7, 7)]


def test_exports_are_those_of_tricue_track(
    video: Path, session_of: Callable[..., Session], tmp_path: Path
) -> None:
    """The same boxes give the same files, but for COCO's categories, which are the targets' names."""
    session = session_of(video)
    words = []
    for box in (START, Box(100, 10, 30, 25)):
        session.add(0, box, "fused")
        words += ["--box", ",".join(map(str, box))]
    run(session, 0, 1)
    files = {name: tmp_path / f"of-track.{name}" for name in exports.EXPORTS}
    words += [word for name, path in files.items() for word in (f"--{name}", str(path))]
    assert main(["track", str(video), *words]) == 0
    theirs = {name: path.read_text() for name, path in files.items()}
    mine = {name: export.write(session.tracked()) for name, export in exports.EXPORTS.items()}
    assert [mine[name] for name in ("csv", "mot")] == [theirs[name] for name in ("csv", "mot")]
    told = json.loads(theirs["json"])
    assert told["lost"]
    assert (told.pop("tracker"), bool(told.pop("params"))) == ("fused", True)
    assert list(json.loads(mine["json"]).items()) == list(told.items())
    boxes = [
        [{**each, "category_id": 1} for each in json.loads(text["coco"])["annotations"]]
        for text in (mine, theirs)
    ]
    assert boxes[0] == boxes[1]


def test_mot_counts_from_one(tracked: Tracked) -> None:
    """The challenge counts frames and pixels from 1; a lost target isn't there, unknown positions are -1."""
    lines = exports.as_mot(tracked).splitlines()
    assert lines == [
        "1,1,21,41,40,40,1,-1,-1,-1",
        "2,1,21,41,40,40,0.5,1.1,-0.2,2.5",
        "2,2,6,7,7,8,1,-1,-1,-1",
    ]


def test_coco_points_to_its_images(tracked: Tracked) -> None:
    """Every annotation's image and category exist; lost targets have none; ids are unique."""
    content = json.loads(exports.as_coco(tracked))
    images = {image["id"]: image for image in content["images"]}
    categories = {each["id"]: each["name"] for each in content["categories"]}
    assert len(images) == FRAMES
    found = [
        (
            images[each["image_id"]]["frame_id"],
            each["track_id"],
            categories[each["category_id"]],
            each["bbox"],
        )
        for each in content["annotations"]
    ]
    assert found == [
        (0, 1, "Target 1", [20, 40, 40, 40]),
        (1, 1, "Target 1", [20, 40, 40, 40]),
        (1, 2, "Anna", [5, 6, 7, 8]),
    ]
    assert len({each["id"] for each in content["annotations"]}) == 3


def test_coco_names_the_files_of_a_folder(tmp_path: Path) -> None:
    """Images of a folder are named as they are."""
    for at, image in enumerate(moving(2)):
        cv2.imwrite(str(tmp_path / f"img{at}.png"), image)
    project = edits.add_target(Project(), 0, START, "fused")
    content = json.loads(
        exports.as_coco(Tracked(project, RecordedFrames(open_source(tmp_path)), {"source": "x"}))
    )
    assert [image["file_name"] for image in content["images"]] == ["img0.png", "img1.png"]


def test_coco_has_each_images_size(tmp_path: Path) -> None:
    """An image of another size, which has no box, keeps its own; a damaged one has the first one's."""
    for at, image in enumerate(moving(4)):
        cv2.imwrite(str(tmp_path / f"{at}.png"), image[: HEIGHT - 20 * (at == 1)])
    (tmp_path / "3.png").write_bytes(b"no image")
    project = edits.add_target(Project(), 0, START, "fused")
    content = json.loads(
        exports.as_coco(Tracked(project, RecordedFrames(open_source(tmp_path)), {"source": "x"}))
    )
    sizes = [(each["width"], each["height"]) for each in content["images"]]
    assert sizes == [(WIDTH, HEIGHT), (WIDTH, HEIGHT - 20), (WIDTH, HEIGHT), (WIDTH, HEIGHT)]


def test_video_shows_the_boxes(tracked: Tracked, tmp_path: Path) -> None:
    """The overlay video has all frames; a box is drawn in those that have it."""
    counted: list[int] = []
    exports.write_video(tmp_path / "out.mp4", tracked, lambda count: counted.append(count) is None)
    assert counted == list(range(1, FRAMES + 1))
    frames = [image for _, image in Video(tmp_path / "out.mp4")]
    assert len(frames) == FRAMES
    scale = frames[0].shape[0] // 120
    edges = np.array([image[60 * scale, 20 * scale - 2 : 20 * scale + 3] for image in frames[:6]], np.int64)
    differences = np.abs(edges - target_color(1)).sum(-1).min(-1)
    assert differences[0] < 90 < differences[4]


def test_targets_have_the_colors_of_the_page(video: Path) -> None:
    """What the page shows in a color is drawn in this color, whatever its status, beside its name."""
    script = (Path(app.__file__).parent / "page" / "targets.js").read_text()
    shown = re.findall(r'"#(\w{6})"', script[script.index("COLORS") : script.index("];")])
    assert [tuple(bytes.fromhex(color)[::-1]) for color in shown] == list(TARGET_COLORS)

    project = edits.rename_target(edits.add_target(Project(), 0, START, "fused"), 1, "Anna")
    frame = next(iter(open_source(video)))
    pictures = [
        exports.draw_targets(frame, [(target, Track(START, 0.5, status))])
        for target in (project.targets[0], dataclasses.replace(project.targets[0], name="Ann"))
        for status in (Status.TRACKED, Status.OCCLUDED)
    ]
    scale = pictures[0].shape[0] // 120
    row, column = round(START.center[1]) * scale, round(START.x) * scale
    for picture in pictures:
        differences = np.abs(picture[row, column - 2 : column + 3].astype(int) - target_color(1)).sum(1)
        assert differences.min() < 90
    assert not np.array_equal(pictures[0], pictures[2])


def test_video_shows_the_trails(video: Path, tmp_path: Path) -> None:
    """With trails there is a line where the box's center came from, and none without."""
    project = edits.add_target(Project(), 0, START, "fused")
    tracks = {at: Track(START._replace(x=START.x + at), 0.9, Status.TRACKED) for at in range(FRAMES)}
    whole = Tracked(edits.add_tracks(project, {1: tracks}), RecordedFrames(open_source(video)), {})
    pictures = []
    for trail in (False, True):
        exports.write_video(tmp_path / "out.mp4", whole, lambda _: True, trail)
        *_, (_, last) = Video(tmp_path / "out.mp4")
        pictures.append(last.astype(int))
    scale = pictures[0].shape[0] // 120
    changed = np.abs(pictures[1] - pictures[0]).max(axis=2)
    assert changed[60 * scale, 70 * scale] > 60
    assert changed[50 * scale, 70 * scale] < 30


def test_trails_are_broken_where_nothing_is_known(video: Path, tmp_path: Path) -> None:
    """As in the page: no line leads over frames without a track, and the one before them fades."""
    project = edits.add_target(Project(), 0, START, "fused")
    known = [*range(20), *range(40, FRAMES)]
    tracks = {at: Track(START._replace(x=START.x + at), 0.9, Status.TRACKED) for at in known}
    whole = Tracked(edits.add_tracks(project, {1: tracks}), RecordedFrames(open_source(video)), {})
    pictures = []
    for trail in (False, True):
        exports.write_video(tmp_path / "out.mp4", whole, lambda _: True, trail)
        pictures.append([image.astype(int) for _, image in Video(tmp_path / "out.mp4")])
    scale = pictures[0][0].shape[0] // 120
    without, drawn = pictures
    changed = {at: np.abs(drawn[at] - without[at]).max(axis=2)[60 * scale] for at in (30, FRAMES - 1)}
    assert changed[30][50 * scale] > 60
    assert changed[FRAMES - 1][70 * scale] < 30


def test_video_can_be_given_up(tracked: Tracked, tmp_path: Path) -> None:
    """Writing ends when it is told to, with a whole file."""
    exports.write_video(tmp_path / "out.mp4", tracked, lambda count: count < 10)
    assert len(list(Video(tmp_path / "out.mp4"))) == 10


def test_nothing_tracked_is_nothing_written(video: Path) -> None:
    """Exports of an empty project are valid and empty."""
    empty = Tracked(Project(), RecordedFrames(open_source(video)), {"source": "video"})
    assert exports.as_csv(empty).splitlines() == [",".join(columns(TableForm(several=True)))]
    assert json.loads(exports.as_json(empty))["tracks"] == []
    assert exports.as_mot(empty) == ""
    assert json.loads(exports.as_coco(empty))["annotations"] == []


def test_session_exports_what_it_shows(video: Path, session_of: Callable[..., Session]) -> None:
    """What a session hands out is its present project."""
    session = session_of(video)
    session.add(0, START, "fused")
    assert exports.as_csv(session.tracked()).splitlines()[1].startswith("0,1,0.0,tracked,1.0,20.0,40.0")
