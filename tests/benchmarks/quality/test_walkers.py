# SPDX-License-Identifier: MIT
"""The measurement of recorded walkers, on a drawn one."""

import csv

import cv2
import numpy as np
import pytest
from tricue.camera.frame import Frame

from benchmarks.quality import walkers

FRAMES, LEFT, STEP = 12, 20, 2


@pytest.fixture
def walk(tmp_path):
    """A person of 12x40 px, 2 m away, goes right before a wall at 4 m; in two frames somebody nearer hides
    the lower half.
    """
    folder = tmp_path / "data" / "walk"
    (folder / "depth").mkdir(parents=True)
    truth = []
    for index in range(FRAMES):
        left, depth = LEFT + STEP * index, np.full((60, 80), 4000, np.uint16)
        depth[10:50, left : left + 12] = 2000
        if index in (4, 5):
            depth[30:60, left - 10 : left + 20] = 1000
        cv2.imwrite(str(folder / "depth" / f"{index + 1:08}.png"), depth)
        truth.append(f"{left},10,12,40\n")
    (folder / "groundtruth.txt").write_text("".join(truth))
    (folder / "position_z_mm.txt").write_text("2000\n" * FRAMES)
    (folder / "sequence").write_text(
        f"name=walk\nfps=4\nlength={FRAMES}\nchannels.depth=depth/%08d.png\nchannel.default=depth\n"
    )
    (folder.parent / "intrinsics.toml").write_text("[depth]\nfx = 60.0\nfy = 60.0\ncx = 39.5\ncy = 29.5\n")
    return folder.parent


@pytest.mark.parametrize(
    ("covered", "ends"),
    [
        ([0, 0, 0.5, 0.5, 0, 0, 0], [4]),
        ([0, 0.5, 0, 0.5, 0, 0, 0], [4]),
        ([0, 0.5, 0, 0, 0, 0.5, 0], [2, 6]),
        ([0.5, 0, 0, 0, 0, 0, 0], []),
        ([0, 0, 0, 0, 0, 0.5, 0.5], []),
        ([0, 0.04, np.nan, 0, 0, 0, 0], []),
    ],
)
def test_a_crossing_ends_once(covered, ends):
    """Short pauses belong to a crossing; one that doesn't end, or that was over at the start, isn't one."""
    assert walkers.crossings(np.array(covered)) == ends


@pytest.mark.parametrize("numbers", [[0, 1, 2, 3], [3, 2, 1]])
def test_time_goes_forward(numbers):
    """Backward, too, the times of frames increase by what is between them."""
    frames = [Frame(depth=np.full((2, 2), i + 1.0, np.float32), timestamp=i / 4) for i in range(4)]
    seen = walkers.in_order(frames, np.array(numbers))
    assert [each.timestamp for each in seen] == [i / 4 for i in range(len(numbers))]
    assert [each.depth[0, 0] - 1 for each in seen] == numbers


def test_the_command_prints_and_writes(walk, tmp_path, capsys):
    """A line for each way, and a row for each run. A still box loses the person; the crossing counts in the
    runs that see its end.
    """
    words = ["--trackers", "still-box", "--seeds", "0:2", "--csv", str(tmp_path / "o.csv")]
    assert walkers.main([str(walk), *words]) == 0
    printed = capsys.readouterr().out
    assert printed.count("| still-box | walk |") == 2
    assert "| still-box | mean | both |" in printed
    rows = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert len(rows) == 8 * 2
    whole = [row for row in rows if row["start"] == "0"]
    assert [row["after"] for row in whole if row["way"] == "forward"] == ["0.0", "0.0"]
    assert all(0 < float(row["iou"]) < 0.5 for row in whole)
    assert [row["after"] for row in rows if row["start"] == "0.75"] == [""] * 4
