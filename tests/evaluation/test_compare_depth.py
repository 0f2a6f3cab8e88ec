# SPDX-License-Identifier: MIT
import csv
from dataclasses import asdict, replace

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Intrinsics
from tricue.evaluation import compare, compare_depth, sequences

CAMERA = Intrinsics.from_fov(160, 120, 60)
Z, WALL = 2.0, 4.0  # metres


@pytest.fixture
def folder(tmp_path):
    """A slab at 2 m that moves 4 px a frame to the right in front of a wall, as VOT's RGB-D; its truth."""
    (tmp_path / "slab" / "depth").mkdir(parents=True)
    lines = []
    for index in range(12):
        depth = np.full((120, 160), round(1000 * WALL), np.uint16)
        x = -10 + 4 * index
        depth[20:100, max(x, 0) : x + 36] = round(1000 * Z)
        cv2.imwrite(str(tmp_path / "slab" / "depth" / f"{index + 1:08d}.png"), depth)
        lines.append(f"{max(x, 0)},20,{x + 36 - max(x, 0)},80\n")
    (tmp_path / "slab" / "groundtruth.txt").write_text("".join(lines))
    (tmp_path / "slab" / "position_z_mm.txt").write_text("2000\n" * 11)
    (tmp_path / "slab" / "sequence").write_text("channels.depth=depth/%08d.png\nfps=10\n")
    values = (f"{name} = {value!r}" for name, value in asdict(CAMERA).items())
    (tmp_path / "intrinsics.toml").write_text("\n".join(["[depth]", *values]))
    return tmp_path


def test_sequence_has_camera_and_true_depths(folder):
    """The calibration beside the sequences and the true depths in metres are loaded; the last is unknown."""
    sequence = sequences.load(folder / "slab")
    assert sequence.intrinsics == CAMERA
    np.testing.assert_array_equal(sequence.depths, [Z] * 11 + [np.nan])


def test_sequence_without_them_has_neither(patrol, tmp_path):
    """A sequence in color alone has no intrinsics and no true depths."""
    (tmp_path / "img").mkdir()
    cv2.imwrite(str(tmp_path / "img" / "1.png"), patrol[0][0].color)
    (tmp_path / "groundtruth_rect.txt").write_text("1,1,9,9\n")
    sequence = sequences.load(tmp_path)
    assert sequence.intrinsics is None
    assert np.isnan(sequence.depths).all()


def test_depth_is_measured(folder, tmp_path, capsys):
    """Ours runs once a seed and says the slab's depth within 3 cm, a still box once and says none."""
    path = tmp_path / "runs.csv"
    names = "depth-particle,still-box"
    assert (
        compare.main([str(folder), "--depth", "--seeds", "2", "--trackers", names, "--csv", str(path)]) == 0
    )
    with path.open() as file:
        rows = list(csv.DictReader(file))
    assert [(row["tracker"], row["seed"]) for row in rows] == [
        *(("depth-particle", "0"), ("depth-particle", "1"), ("still-box", "0"))
    ]
    assert all(float(row["depth_error"]) < 0.03 for row in rows[:2])
    assert np.isnan(float(rows[2]["depth_error"]))
    assert all(float(row["iou"]) > 0.7 for row in rows[:2])
    table = capsys.readouterr().out
    assert table.count("| slab | depth-particle |") == table.count("| slab | still-box |") == 1
    assert table.count(" cm |") == 1


def test_boxes_are_measured_inside_the_image():
    """A box is cut at the edges of the depth image; one outside counts as none."""
    frame = Frame(depth=np.ones((120, 160)))
    boxes = np.array([[-10.0, 100, 30, 40], [150, -5, 30, 10], [200, 0, 5, 5]])
    np.testing.assert_array_equal(
        compare_depth.clipped(boxes, frame), [[0, 100, 20, 20], [150, 0, 10, 5], [np.nan] * 4]
    )


def test_peers_see_one_scale_of_shades():
    """The same depth has the same shade in every frame, nearer is brighter, and unknown is black."""
    first, second = np.full((2, 20, 20), 2.0)
    first[:, 10:], second[:, 10:], second[0] = 4.0, 9.0, np.nan
    pictures = [
        frame.color.astype(int) for frame in compare_depth.pictures([Frame(depth=first), Frame(depth=second)])
    ]
    np.testing.assert_array_equal(pictures[0][5, 5], pictures[1][5, 5])
    assert pictures[0][5, 5].sum() > pictures[0][5, 15].sum()
    assert not pictures[1][0].any()


def test_table_gives_means_and_the_range(folder):
    """Numbers of two seeds are averaged; the range of their overlaps stands beside."""
    sequence = sequences.load(folder / "slab")
    row = compare_depth.measure("still-box", compare_depth.makers()["still-box"], 0, sequence)
    changes = ({"iou": 0.5, "depth_error": 0.02, "fps": 10.0}, {"iou": 0.7, "depth_error": 0.04, "fps": 30.0})
    rows = [replace(row, **each) for each in changes]
    *_, line = compare_depth.table(rows).splitlines()
    assert line.endswith("| 0.60 (0.50-0.70) | 3.0 cm | 20 |")


def test_ours_follows_real_people(data):
    """On a recorded sequence the person is followed (mean IoU above 0.6, depth within 10 cm)."""
    sequence = sequences.load(data / "rgbd" / "queue-first")
    row = compare_depth.measure("depth-particle", compare_depth.makers()["depth-particle"], 0, sequence)
    assert row.iou > 0.6
    assert row.depth_error < 0.1


def test_start_is_the_first_true_box(folder):
    """A box that never moves has the overlap of the first true box with every other."""
    sequence = sequences.load(folder / "slab")
    row = compare_depth.measure("still-box", compare_depth.makers()["still-box"], 0, sequence)
    first = Box(*sequence.truth[0])
    assert row.iou == pytest.approx(np.mean([first.iou(Box(*box)) for box in sequence.truth]))
