# SPDX-License-Identifier: MIT
"""Depth in VOT's folders."""

from pathlib import Path

import numpy as np
import pytest
from tricue import Box
from tricue.data.open_source import open_source

from tests.data.depth_folders import CHANNELS, levels, meters, tum, vot, write_color, write_depth


def test_vot_depth_is_millimeters(tmp_path: Path) -> None:
    """It proves that VOT's depth channel comes in meters without being told its unit, or by the one told."""
    folder = vot(tmp_path, f"channel.default=color\n{CHANNELS}")
    source = open_source(folder)
    assert (source.fps, list(source.channels)) == (4.0, ["color", "depth"])
    assert levels(source) == [10, 20]
    assert meters(source) == pytest.approx([1.234, 2.345])
    assert meters(open_source(folder, depth_scale=0.0001)) == pytest.approx([0.1234, 0.2345])


@pytest.mark.parametrize("place", ["../other/%08d.png", "color/../../other/%08d.png", "/etc/%08d.png"])
def test_lists_stay_in_their_folder(tmp_path: Path, place: str) -> None:
    """It proves that a recording's list can't make tricue read files elsewhere."""
    write_color(tmp_path / "other" / "00000001.png", 10)
    folder = vot(tmp_path / "sequence", f"channel.default=color\nchannels.color={place}\n")
    with pytest.raises(ValueError, match=r"sequence: expected files below its folder, got '"):
        open_source(folder)
    times = tum(tmp_path / "tum", [1.0], [1.0])
    (times / "rgb.txt").write_text(f"1.0 {place.replace('%08d', '00000001')}\n")
    with pytest.raises(ValueError, match=r"rgb\.txt: expected files below its folder, got '"):
        open_source(times)


def test_vot_depth_alone(tmp_path: Path) -> None:
    """It proves that a VOT sequence whose only, default channel is depth isn't read as color."""
    source = open_source(vot(tmp_path, "channel.default=depth\nchannels.depth=depth/%08d.png\n"))
    assert list(source.channels) == ["depth"]
    assert meters(source) == pytest.approx([1.234, 2.345])


def vot_rgbd(folder: Path) -> Path:
    """A VOT folder without its sequence file, as DepthTrack's come."""
    for index in (1, 2):
        write_color(folder / "color" / f"{index:08}.png", 10 * index)
        write_depth(folder / "depth" / f"{index:08}.png", 1000 * index)
    (folder / "groundtruth.txt").write_text("1,2,3,4\nnan,nan,nan,nan\n")
    return folder


def test_vot_rgbd_is_known_without_its_sequence_file(tmp_path: Path) -> None:
    """It proves that color/ and depth/ of eight-digit names beside VOT's true boxes are in millimeters, that
    their frame rate can be given, and that folders of other names still ask for the unit.
    """
    source = open_source(vot_rgbd(tmp_path), fps=20)
    assert (levels(source), meters(source)) == ([10, 20], pytest.approx([1.0, 2.0]))
    assert [frame.timestamp for frame in source] == [0.0, 0.05]
    assert source.first_box == Box(1, 2, 3, 4)
    assert source.truth is not None
    assert np.isnan(source.truth[1]).all()
    assert meters(open_source(tmp_path, depth_scale=0.0001)) == pytest.approx([0.1, 0.2])
    for index in (1, 2):
        (tmp_path / "depth" / f"{index:08}.png").rename(tmp_path / "depth" / f"frame{index}.png")
    (note,) = open_source(tmp_path).notes
    assert "depth_scale" in note


def test_vot_masks_and_polygons_have_boxes(tmp_path: Path) -> None:
    """It proves that VOT's polygons and masks, which CDTB has, come as the boxes round them."""
    (vot_rgbd(tmp_path) / "groundtruth.txt").write_text("10,20,30,20,30,60,10,60\nm5,6,7,8,0,3,4\n")
    truth = open_source(tmp_path).truth
    assert truth is not None
    assert truth.tolist() == [[10, 20, 20, 40], [5, 6, 7, 8]]
