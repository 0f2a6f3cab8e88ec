# SPDX-License-Identifier: MIT
"""Recorded stereo pairs as sequences, and the table of trackers on them."""

import cv2
import numpy as np
import pytest
from tricue import StereoRig
from tricue.data import kitti
from tricue.scenes import head

from benchmarks.quality import stereo_trackers
from benchmarks.quality.common import sequences, stereo_sequences

CALIBRATION = """%YAML:1.0
---
P1: !!opencv-matrix
  {{ rows: 3, cols: 4, dt: d, data: [{fx}, 0, {cx}, 0, 0, {fy}, {cy}, 0, 0, 0, 1, 0] }}
P2: !!opencv-matrix
  {{ rows: 3, cols: 4, dt: d, data: [{fx}, 0, {cx}, {shift}, 0, {fy}, {cy}, 0, 0, 0, 1, 0] }}
"""
CUBOID = "1.5 1.6 4.5 {x} 1.7 {z} {turn}"


@pytest.fixture(scope="module")
def scene():
    """A head in stereo, twelve frames."""
    return head(0, frames=12)


@pytest.fixture(scope="module")
def folder(scene, tmp_path_factory):
    """The scene written as left/, right/, the boxes of both, and a calibration in decimeters."""
    root = tmp_path_factory.mktemp("stereo")
    place = root / "head"
    for side in ("left", "right"):
        (place / side).mkdir(parents=True)
    for index, frame in enumerate(scene.frames):
        cv2.imwrite(str(place / "left" / f"{index:03d}.png"), frame.color)
        cv2.imwrite(str(place / "right" / f"{index:03d}.png"), frame.right)
    boxes = np.array(scene.boxes)
    moved = boxes - np.outer(_disparities(scene), [1, 0, 0, 0])
    np.savetxt(place / "groundtruth.txt", boxes, delimiter=",")
    np.savetxt(place / "groundtruth_right.txt", moved, delimiter=",")
    camera = scene.rig.intrinsics
    text = CALIBRATION.format(
        fx=camera.fx, fy=camera.fy, cx=camera.cx, cy=camera.cy, shift=-camera.fx * scene.rig.baseline * 10
    )
    (place / "calibration.yml").write_text(text)
    return root


def _disparities(scene):
    return scene.rig.intrinsics.fx * scene.rig.baseline / scene.positions[:, 2]


def test_a_folder_of_stereo_pairs_is_a_sequence(folder, scene):
    """Stereo pairs, boxes, true disparities from the boxes of both images, and the rig in meters."""
    assert stereo_sequences.find(folder) == [folder / "head"]
    (found,) = stereo_sequences.load(folder / "head", unit=0.1)
    assert len(found.frames) == 12
    np.testing.assert_array_equal(found.frames[3].right, scene.frames[3].right)
    np.testing.assert_allclose(found.truth, np.array(scene.boxes))
    np.testing.assert_allclose(found.disparities, _disparities(scene))
    assert found.rig.baseline == pytest.approx(scene.rig.baseline)


def test_the_table_has_a_line_per_tracker(folder, capsys):
    """The head tracker holds the head and knows its disparity within a pixel; the baselines have none."""
    assert stereo_trackers.main([str(folder), "--unit", "0.1"]) == 0
    lines = [line.strip("| ").split(" | ") for line in capsys.readouterr().out.splitlines()]
    rows = {line[1]: line for line in lines[2:]}
    assert list(rows) == list(stereo_trackers.makers())
    ours = rows["stereo-head"]
    assert ours[2] == "100%"
    assert float(ours[4]) > 0.7
    assert float(ours[6].removesuffix(" px")) < 1
    assert rows["still-box"][6] == "-"
    for name in ("flow-depth", "flow-depth, disparity alone"):
        assert float(rows[name][4]) > 0.5
        assert float(rows[name][6].removesuffix(" px")) < 1
    assert rows["flow-depth, flow alone"][6] == "-"


def test_parameters_come_from_a_file(folder, tmp_path, capsys):
    """Those of the file are the tracker's, near and far are the rig's; an unknown one is named."""
    path = tmp_path / "params.toml"
    path.write_text("resolution = 80\nmin_head_cells = 0\nnear = 3.0\n")
    assert stereo_trackers.main([str(folder / "head"), "--unit", "0.1", "--params", str(path)]) == 0
    coarse = capsys.readouterr().out.splitlines()[2].split(" | ")
    assert stereo_trackers.main([str(folder / "head"), "--unit", "0.1"]) == 0
    default = capsys.readouterr().out.splitlines()[2].split(" | ")
    assert coarse[:2] == default[:2]
    assert coarse[3:7] != default[3:7]
    assert float(coarse[4]) > 0.5
    path.write_text("resolutions = 80\n")
    with pytest.raises(TypeError, match="resolutions: unknown parameter"):
        stereo_trackers.main([str(folder), "--params", str(path)])


def test_a_folder_without_sequences_is_refused(tmp_path, capsys):
    """One line that names the folder."""
    with pytest.raises(SystemExit):
        stereo_trackers.main([str(tmp_path)])
    assert "expected stereo sequences with true boxes" in capsys.readouterr().err


def test_boxes_of_fewer_images_are_refused(folder):
    """A file of right boxes that ends early is not measured against."""
    path = folder / "head" / "groundtruth_right.txt"
    text = path.read_text()
    path.write_text("".join(text.splitlines(keepends=True)[:5]))
    try:
        with pytest.raises(ValueError, match="expected 12 true boxes, got 12 and 5"):
            list(stereo_sequences.load(folder / "head"))
    finally:
        path.write_text(text)


def _label(frame, track, kind="Car", z=20.0, turn=0.0):
    return f"{frame} {track} {kind} 0 0 -1.5 100 50 140 80 {CUBOID.format(x=1, z=z, turn=turn)}\n"


def test_labels_are_read_by_target(tmp_path):
    """Rows of a target in the order of frames; a cuboid's nearest side depends on its turn."""
    path = tmp_path / "0000.txt"
    path.write_text(
        _label(1, 7, z=19.0) + _label(0, 7) + _label(0, -1, "DontCare") + _label(0, 8, "Van", turn=np.pi / 2)
    )
    car, van = kitti.read_labels(path)
    assert (car.name, van.name) == ("Car 7", "Van 8")
    np.testing.assert_array_equal(car.frames, [0, 1])
    np.testing.assert_array_equal(car.boxes[0], [100, 50, 40, 30])
    np.testing.assert_allclose(car.front_depths, [20 - 0.8, 19 - 0.8])
    np.testing.assert_allclose(van.front_depths, [20 - 2.25])


def test_disparities_of_labels_are_those_of_the_left_camera(tmp_path):
    """Which stands a meter behind camera 0, in whose frame the labels are."""
    for folder in ("image_02", "image_03"):
        (tmp_path / folder / "0000").mkdir(parents=True)
        for frame in range(10):
            cv2.imwrite(str(tmp_path / folder / "0000" / f"{frame:06}.png"), np.zeros((90, 150, 3), np.uint8))
    for name in ("calib", "label_02"):
        (tmp_path / name).mkdir()
    offsets = {"P2": 70 * 1, "P3": -100 * 0.5 + 70 * 1}  # fx x + cx z
    projections = [f"{name}: 100 0 70 {value} 0 100 40 40 0 0 1 1\n" for name, value in offsets.items()]
    (tmp_path / "calib" / "0000.txt").write_text("".join(projections))
    (tmp_path / "label_02" / "0000.txt").write_text("".join(_label(frame, 1) for frame in range(10)))
    (found,) = stereo_sequences.load(tmp_path)
    assert found.rig.baseline == pytest.approx(0.5)
    np.testing.assert_allclose(found.disparities, 100 * 0.5 / (20 - 0.8 + 1))


@pytest.mark.parametrize("line", ["0 1 Car 0 0\n", _label(0, 1).replace("100", "x")])
def test_a_line_that_is_no_label_is_named(tmp_path, line):
    """The file and the line's number are in the error."""
    path = tmp_path / "0000.txt"
    path.write_text(_label(0, 1) + line)
    with pytest.raises(ValueError, match="line 2: expected a tracking label"):
        kitti.read_labels(path)


def test_kitti_targets_are_sequences():
    """The recorded KITTI stereo pairs have two targets long and large enough, of known disparity."""
    place = sequences.data_folder() / "stereo" / "kitti-tracking"
    if not place.is_dir():
        pytest.skip(f"no recorded pairs under {place}")
    found = list(stereo_sequences.load(place))
    assert [each.name.split()[-1] for each in found] == ["0", "31"]
    assert all(isinstance(each.rig, StereoRig) and len(each.frames) == len(each.truth) for each in found)
    assert found[0].frames[3].timestamp == pytest.approx(0.3)
    assert stereo_sequences.find(place) == [place]
    assert 8 < found[0].disparities[0] < 9.5
