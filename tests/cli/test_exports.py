# SPDX-License-Identifier: MIT
"""What MOTChallenge's and COCO's readers expect."""

import json
from pathlib import Path

import numpy as np
import pytest
from tricue import Box, Frame, Pose, Status, Track
from tricue.cli.exports import CocoOutput, MotOutput
from tricue.cli.outputs import Step

FRAME = Frame(np.zeros((48, 64, 3), np.uint8))
HERE = Track(Box(1, 2, 30, 40.5), 0.5, Status.TRACKED)
HIDDEN = Track(Box(1 / 3, -2, 3, 4), 0.25, Status.OCCLUDED, np.array([0.1, 0.2, 3.0]))
POSED = Track(
    Box(0, 0, 3, 4), 1.0, Status.TRACKED, np.array([0.1, 0.2, 3.0]), pose=Pose(np.eye(3), (1.0, 2.0, 0.5))
)
GONE = Track(Box(5, 6, 7, 8), 0.0, Status.LOST)
STEPS = [
    Step(0, FRAME, HERE, 0.1, tracks={1: HERE, 3: HIDDEN}),
    Step(1, FRAME, GONE, 0.1, tracks={1: GONE, 3: POSED}),
]


def test_mot(tmp_path: Path) -> None:
    """Ten values a line, counted from 1; meters in the world, else of the camera; no line of a lost one."""
    with MotOutput(tmp_path / "new" / "mot.txt") as output:
        for step in STEPS:
            output.write(step)
    assert (tmp_path / "new" / "mot.txt").read_text().splitlines() == [
        "1,1,2,3,30,40.5,0.5,-1,-1,-1",
        "1,3,1.333333,-1,3,4,0.25,0.1,0.2,3",
        "2,3,1,1,3,4,1,1.1,2.2,3.5",
    ]


def test_one_target_has_the_id_1(tmp_path: Path) -> None:
    """Both formats can hold a run on a single box."""
    with MotOutput(tmp_path / "m") as mot, CocoOutput(tmp_path / "c", "v", lambda: 25.0) as coco:
        for output in (mot, coco):
            output.write(Step(4, FRAME, HERE, 0.1))
    assert (tmp_path / "m").read_text() == "5,1,2,3,30,40.5,0.5,-1,-1,-1\n"
    assert [each["track_id"] for each in json.loads((tmp_path / "c").read_text())["annotations"]] == [1]


def test_coco(tmp_path: Path) -> None:
    """Ids lead to their entries; boxes count from 0; a lost target has no annotation, its frame an image."""
    with CocoOutput(tmp_path / "coco.json", "walk", lambda: 25.0) as output:
        for step in STEPS:
            output.write(step)
    content = json.loads((tmp_path / "coco.json").read_text())
    (video,), images, annotations = (content[name] for name in ("videos", "images", "annotations"))
    assert video == {"id": 1, "name": "walk", "fps": 25.0, "width": 64, "height": 48}
    names = [(each["id"], each["file_name"], each["frame_index"], each["frame_id"]) for each in images]
    assert names == [(1, "000001.jpg", 0, 0), (2, "000002.jpg", 1, 1)]
    assert all((each["width"], each["height"], each["video_id"]) == (64, 48, 1) for each in images)
    found = [(each["id"], each["image_id"], each["track_id"], each["bbox"]) for each in annotations]
    assert found == [
        (1, 1, 1, [1, 2, 30, 40.5]),
        (2, 1, 3, [0.333333, -2, 3, 4]),
        (3, 2, 3, [0, 0, 3, 4]),
    ]
    assert [(each["area"], each["score"], each["occluded"]) for each in annotations] == [
        (1215.0, 0.5, False),
        (12.0, 0.25, True),
        (12.0, 1.0, False),
    ]
    assert [each["id"] for each in content["tracks"]] == [1, 3]
    assert {each["category_id"] for each in annotations + content["tracks"]} == {1}
    assert [each["id"] for each in content["categories"]] == [1]


def test_the_size_is_the_depths_without_color(tmp_path: Path) -> None:
    """Boxes are then in pixels of depth."""
    with CocoOutput(tmp_path / "c", "v", lambda: 25.0) as output:
        output.write(Step(0, Frame(depth=np.ones((12, 16))), HERE, 0.1))
    assert json.loads((tmp_path / "c").read_text())["images"][0]["width"] == 16


def test_both_are_whole_after_an_error(tmp_path: Path) -> None:
    """They are complete up to the last frame when the loop breaks off."""
    with pytest.raises(KeyboardInterrupt):
        _interrupted(tmp_path)
    assert len((tmp_path / "m").read_text().splitlines()) == 2
    assert len(json.loads((tmp_path / "c").read_text())["annotations"]) == 2


def _interrupted(folder: Path) -> None:
    with MotOutput(folder / "m") as mot, CocoOutput(folder / "c", "v", lambda: 25.0) as coco:
        mot.write(STEPS[0])
        coco.write(STEPS[0])
        raise KeyboardInterrupt
