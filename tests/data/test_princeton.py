# SPDX-License-Identifier: MIT
"""Color and depth in Princeton's folders, whose depth images have rotated bits."""

from pathlib import Path

import numpy as np
import pytest
from tricue import Box, Intrinsics
from tricue.camera.read_calibration import read_intrinsics
from tricue.data.open_source import open_source

from tests.data.depth_folders import color_folder, levels, meters, ptb, rotated, write_depth


def test_princeton_depth_is_turned_back(tmp_path: Path) -> None:
    """It proves that Princeton's frames come in the order of their numbers with the depth nearest in time,
    its bits turned back.
    """
    source = open_source(ptb(tmp_path))
    assert levels(source) == [10, 20, 30]
    assert meters(source) == pytest.approx([9.0, 1.5, 1.5])
    assert [frame.timestamp for frame in source] == pytest.approx([0.0, 0.033, 0.066])


@pytest.mark.parametrize("units", [1001, 1007, 1008, 8191, 8192, 10_000, 40_001])
def test_princeton_bits(tmp_path: Path, units: int) -> None:
    """It proves that a value comes back as it was, whichever of its bits are set."""
    folder = ptb(tmp_path)
    for path in (folder / "depth").iterdir():
        write_depth(path, rotated(units))
    assert meters(open_source(folder)) == pytest.approx(3 * [units / 1000])


def test_princeton_folders_alone(tmp_path: Path) -> None:
    """It proves that Princeton's rgb/ or depth/ alone is known by its names: order, times, bits and unit."""
    folder = ptb(tmp_path)
    depth = open_source(folder / "depth")
    assert (list(depth.channels), meters(depth)) == (["depth"], pytest.approx([9.0, 1.5]))
    assert [frame.timestamp for frame in depth] == pytest.approx([0.001, 0.06])
    color = open_source(folder / "rgb")
    assert levels(color) == [10, 20, 30]
    assert [frame.timestamp for frame in color] == pytest.approx([0.0, 0.033, 0.066])
    beside = open_source(color_folder(tmp_path / "c", 2), depth=folder / "depth")
    assert meters(beside) == pytest.approx([9.0, 1.5])


def frames_mat(folder: Path) -> None:
    """Princeton's frames.mat, with the camera matrix that counts from 1."""
    matrix = [[575.0, 0, 21], [0, 576.0, 16], [0, 0, 1]]
    io = pytest.importorskip("scipy.io")
    io.savemat(folder / "frames.mat", {"frames": {"length": 3.0, "K": matrix, "imageTimestamp": [0, 33_000]}})


def test_princeton_camera(tmp_path: Path) -> None:
    """It proves that the camera matrix of frames.mat is found, and counts from 0 then, as all of ours do."""
    folder = ptb(tmp_path)
    frames_mat(folder)
    source = open_source(folder)
    assert source.calibration == folder / "frames.mat"
    camera = read_intrinsics(source.calibration, source.size, "depth")
    assert camera == Intrinsics(575.0, 576.0, 20.0, 15.0, 40, 30)
    (folder / "intrinsics.toml").touch()
    assert open_source(folder).calibration == folder / "intrinsics.toml"


def test_princeton_truth(tmp_path: Path) -> None:
    """It proves that Princeton's boxes are read from <sequence>.txt, else init.txt has the first one."""
    folder = ptb(tmp_path / "bear_front")
    (folder / "init.txt").write_text("10,20,30,40\n")
    assert open_source(folder).first_box == Box(10, 20, 30, 40)
    (folder / "bear_front.txt").write_text("1,2,3,4,0\nNaN,NaN,NaN,NaN,1\n5,6,7,8,0\n")
    truth = open_source(folder).truth
    assert truth is not None
    assert truth[[0, 2]].tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]
    assert np.isnan(truth[1]).all()
