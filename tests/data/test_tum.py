# SPDX-License-Identifier: MIT
"""Color and depth in TUM's folders, paired by their times."""

from pathlib import Path

import pytest
from tricue.data.open_source import open_source

from tests.data.depth_folders import color_folder, depth_folder, levels, meters, tum, write_depth


def test_tum_pairs_by_time(tmp_path: Path) -> None:
    """It proves that TUM's images are paired by the nearest time within 20 ms, each once, times kept."""
    color = [100.000, 100.033, 100.066, 100.200, 100.300]
    depth = [100.005, 100.028, 100.070, 100.225, 100.290, 100.295]
    source = open_source(tum(tmp_path, color, depth))
    assert levels(source) == [10, 20, 30, 50]
    assert [frame.timestamp for frame in source] == [100.000, 100.033, 100.066, 100.300]
    assert [round(5000 * z) - 5000 for z in meters(source)] == [0, 1, 2, 5]
    assert source.fps == pytest.approx(1 / 0.033)
    assert source.notes == ("left out 1 of 5 color images, with no depth image within 0.02 s",)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_byte_order_mark_in_tums_lists(tmp_path: Path, encoding: str) -> None:
    """Windows' editor or PowerShell may have written them, with a time in the first line."""
    folder = tum(tmp_path, [1.0, 2.0], [1.0, 2.0])
    for name in ("rgb.txt", "depth.txt"):
        lines = (folder / name).read_text().splitlines()
        (folder / name).write_text("\n".join(lines[2:]), encoding=encoding)
    assert [frame.timestamp for frame in open_source(folder)] == [1.0, 2.0]


def test_tum_lists_of_windows(tmp_path: Path) -> None:
    """It proves that backslashes part folders, and lead out of the sequence no more than slashes do."""
    folder = tum(tmp_path, [1.0, 2.0], [1.0, 2.0])
    for name in ("rgb.txt", "depth.txt"):
        (folder / name).write_text((folder / name).read_text().replace("/", "\\"), newline="\r\n")
    assert levels(open_source(folder)) == [10, 20]
    (folder / "rgb.txt").write_text("1.0 ..\\rgb\\1.png\n")
    with pytest.raises(ValueError, match=r"rgb\.txt: expected files below its folder, got '\.\./rgb/1\.png'"):
        open_source(folder)


def test_tum_serves_the_closest_first(tmp_path: Path) -> None:
    """It proves that of two color images that are near one depth image the nearer one gets it."""
    source = open_source(tum(tmp_path, [10.0, 10.012], [10.010]))
    assert levels(source) == [20]


def test_tum_camera_paths_are_no_boxes(tmp_path: Path) -> None:
    """It proves that TUM's groundtruth.txt, whose lines could pass for polygons, isn't taken for boxes."""
    source = open_source(tum(tmp_path, [1.0], [1.0]))
    assert source.truth is None
    assert source.first_box is None


def test_tum_channels_alone(tmp_path: Path) -> None:
    """It proves that a TUM folder with one of its lists is a source of that channel, in the order of time."""
    depth = open_source(tum(tmp_path / "d", [], [2.0, 1.0]))
    assert (list(depth.channels), [f.timestamp for f in depth]) == (["depth"], [1.0, 2.0])
    assert meters(depth) == pytest.approx([5001 / 5000, 1.0])
    color = open_source(tum(tmp_path / "c", [1.0, 2.0], []))
    assert (list(color.channels), levels(color)) == (["color"], [10, 20])


@pytest.mark.parametrize("apart", [" ", "\t", ",", ", "])
def test_tum_lists_may_be_parted_by_commas(tmp_path: Path, apart: str) -> None:
    """It proves that blanks, tabs and commas part a list's columns, and that file names may hold blanks."""
    write_depth(tmp_path / "depth" / "a b.png", 5000)
    (tmp_path / "depth.txt").write_text(f"# depth maps\n\n1305031102.160407{apart}depth/a b.png\r\n")
    source = open_source(tmp_path)
    assert [frame.timestamp for frame in source] == [1305031102.160407]
    assert meters(source) == pytest.approx([1.0])


def test_times_of_their_own_go_before_those_of_other_channels(tmp_path: Path) -> None:
    """It proves that color images without times take those of the depth beside them, so that --fps is
    refused there; where neither has times it counts.
    """
    color, depth = color_folder(tmp_path / "c", 2), tum(tmp_path / "d", [], [7.0, 7.25])
    source = open_source(color, depth=depth)
    assert ([frame.timestamp for frame in source], source.fps) == ([7.0, 7.25], 4.0)
    with pytest.raises(ValueError, match=r"^fps=15: .* but c has its own, 4 frames per second; leave it out"):
        open_source(color, depth=depth, fps=15)
    plain = depth_folder(tmp_path / "e", [1000, 2000])
    source = open_source(color, depth=plain, depth_scale=0.001, fps=8)
    assert ([frame.timestamp for frame in source], source.fps) == ([0.0, 0.125], 8.0)
