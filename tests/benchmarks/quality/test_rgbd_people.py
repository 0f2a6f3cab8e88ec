# SPDX-License-Identifier: MIT
import csv

import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.evaluation.dataset import ReadOptions, find_entries

from benchmarks.quality import rgbd_people
from benchmarks.quality.common.registered_frames import color_camera, registered

FRAMES, LEFT, STEP = 10, 20, 2
DEPTH = "fx = 60.0\nfy = 60.0\ncx = 39.5\ncy = 29.5\n"
COLOR = "fx = 90.0\nfy = 90.0\ncx = 39.5\ncy = 29.5\n"


@pytest.fixture
def walk(tmp_path):
    """A red person of 12x40 px in depth pixels, 2 m away, who goes 2 px right a frame before a wall at 4 m;
    the color camera has a longer lens.
    """
    folder = tmp_path / "data" / "walk"
    for name in ("color", "depth"):
        (folder / name).mkdir(parents=True)
    truth = []
    for index in range(FRAMES):
        left = LEFT + STEP * index
        depth, color = np.full((60, 80), 4000, np.uint16), np.full((60, 80, 3), 90, np.uint8)
        depth[10:50, left : left + 12] = 2000
        ends = [round((column - 39.5) * 1.5 + 39.5) for column in (left, left + 12)]
        color[:, max(ends[0], 0) : max(ends[1], 0)] = (30, 30, 220)
        cv2.imwrite(str(folder / "depth" / f"{index + 1:08}.png"), depth)
        cv2.imwrite(str(folder / "color" / f"{index + 1:08}.png"), color)
        truth.append(f"{left},10,12,40\n")
    (folder / "groundtruth.txt").write_text("".join(truth))
    (folder / "position_z_mm.txt").write_text("2000\n" * FRAMES)
    channels = "".join(f"channels.{name}={name}/%08d.png\n" for name in ("color", "depth"))
    (folder / "sequence").write_text(f"name=walk\nfps=4\nlength={FRAMES}\n{channels}")
    (folder.parent / "intrinsics.toml").write_text(f"[depth]\n{DEPTH}[color]\n{COLOR}")
    return folder.parent


def opened(root):
    """The only sequence."""
    (entry,) = find_entries(root, ReadOptions(truth="depth"))
    return entry.open()


def test_color_is_registered_to_the_depth_image(walk):
    """The person's red is where the person's depth is, to a pixel."""
    one = opened(walk)
    for frame in registered(one, color_camera(one)):
        person = frame.depth < 3
        red = (frame.color[..., 2] > 150) & (frame.color[..., 0] < 80)
        rows = slice(12, 48)
        assert (person[rows] ^ red[rows]).mean() < 2 / 80
        assert frame.timestamp is not None


def test_without_a_color_camera_there_is_depth_alone(walk):
    """Without the calibration of both cameras, color can't be registered."""
    (walk / "intrinsics.toml").unlink()
    one = opened(walk)
    assert color_camera(one) is None
    assert registered(one, None)[0].channels == ("depth",)


def test_boxes_are_jittered_within_limits():
    """By up to 5 % of the sides, otherwise for each seed, the same for the same seed."""
    box = Box(100, 50, 40, 80)
    found = np.array([rgbd_people.jittered(box, seed) for seed in range(50)])
    off = (found - box) / [40, 80, 40, 80]
    assert np.abs(off).max() <= 0.05
    assert (np.abs(off).max(axis=0) > 0.03).all()
    assert len(np.unique(found, axis=0)) == 50
    assert rgbd_people.jittered(box, 3) == rgbd_people.jittered(box, 3)


def test_the_command_prints_and_writes(walk, tmp_path, capsys):
    """A line per tracker and run. A still box has lost the person at the end; a tracker on depth hasn't, and
    estimates the person's distance.
    """
    words = [
        "--trackers",
        "still-box",
        "flow-depth:depth",
        "--seeds",
        "0:2",
        "--csv",
        str(tmp_path / "o.csv"),
    ]
    assert rgbd_people.main([str(walk), *words]) == 0
    assert "| tracker | walk: mean IoU | at the end |" in capsys.readouterr().out
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [line["seed"] for line in lines] == ["0", "1", "0", "1"]
    still, other = lines[:2], lines[2:]
    assert [float(line["right"]) for line in still] == [0, 0]
    assert [float(line["right"]) for line in other] == [1, 1]
    assert all(line["z_error"] == "" for line in still)
    assert all(float(line["z_error"]) < 0.1 for line in other)
