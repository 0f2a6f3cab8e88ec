# SPDX-License-Identifier: MIT
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box, Intrinsics, Status, Track

pytest.importorskip("matplotlib")
from tricue.draw.paths import PLOT_STATUS_COLORS, check_format, draw_path, path_from_above, save_path

CAMERA = Intrinsics.from_fov(640, 480, 60)


def walk() -> list[Track]:
    """Three steps forward, the last one lost, and a track without a position between them."""
    positions = [(0.5, 0.1, 2.0), (0.6, 0.1, 2.5), None, (0.7, 0.1, 3.0)]
    statuses = [Status.TRACKED, Status.OCCLUDED, Status.TRACKED, Status.LOST]
    return [
        Track(Box(1, 2, 3, 4), 0.5, status, None if p is None else np.array(p))
        for p, status in zip(positions, statuses, strict=True)
    ]


def test_points_are_where_the_target_was() -> None:
    """It proves that x is drawn against z in meters at one scale, each point in the color of its status."""
    axes = path_from_above(walk(), CAMERA).axes[0]
    points = {line.get_color(): line.get_xydata().tolist() for line in axes.lines if line.get_marker() == "o"}
    assert points == {
        PLOT_STATUS_COLORS[Status.TRACKED]: [[0.5, 2.0]],
        PLOT_STATUS_COLORS[Status.OCCLUDED]: [[0.6, 2.5]],
        PLOT_STATUS_COLORS[Status.LOST]: [[0.7, 3.0]],
    }
    assert axes.get_aspect() == 1.0
    assert "m" in axes.get_xlabel()


def test_the_field_of_view_is_drawn() -> None:
    """It proves that the camera's angle is drawn from (0, 0) past the farthest point, where it is known."""
    *_, view = path_from_above(walk(), CAMERA).axes[0].patches
    corners = view.get_xy()
    assert corners[0].tolist() == [0.0, 0.0]
    assert np.degrees(np.arctan2(corners[2, 0], corners[2, 1])) == pytest.approx(30)
    assert corners[1, 0] == pytest.approx(-corners[2, 0])
    assert corners[1, 1] > 3.0
    assert len(path_from_above(walk()).axes[0].patches) == 1


def test_truth_is_a_thin_line() -> None:
    """It proves that true positions are drawn, with gaps where they aren't known."""
    truth = [[0.5, 0, 2.0], [np.nan] * 3, [0.7, 0, 3.0]]
    (line,) = [a for a in path_from_above(walk(), CAMERA, truth).axes[0].lines if a.get_label() == "truth"]
    np.testing.assert_array_equal(line.get_xydata(), [[0.5, 2.0], [np.nan, np.nan], [0.7, 3.0]])
    assert line.get_linewidth() < 1


def test_path_is_drawn_into_given_axes() -> None:
    """It proves that axes of another figure get the same lines, and axes beside them stay empty."""
    from matplotlib.figure import Figure

    left, right = Figure().subplots(1, 2)
    draw_path(left, walk(), CAMERA)
    expected = path_from_above(walk(), CAMERA).axes[0]
    for line, other in zip(left.lines, expected.lines, strict=True):
        np.testing.assert_array_equal(line.get_xydata(), other.get_xydata())
    assert not right.lines


def test_files(tmp_path: Path) -> None:
    """It proves that the figure is written as a picture, and a name that can't be one is refused before."""
    check_format(tmp_path / "o.PNG")
    save_path(tmp_path / "new" / "o.png", walk(), CAMERA)
    save_path(f"{tmp_path}/by_text.png", walk(), CAMERA)
    for name in ("new/o.png", "by_text.png"):
        assert cv2.imread(str(tmp_path / name)) is not None
    for name in ("o.txt", "o"):
        with pytest.raises(ValueError, match=f"{name}: expected a picture's name that ends in .png"):
            check_format(tmp_path / name)


def test_bad_input_is_named() -> None:
    """It proves that tracks without any position, or truth of another shape, are errors that say so."""
    flat = [Track(Box(1, 2, 3, 4), 0.5, Status.TRACKED)]
    with pytest.raises(ValueError, match="tracks: expected one with a position, got none"):
        path_from_above(flat, CAMERA)
    with pytest.raises(ValueError, match=r"truth: expected positions \(N, 3\), meters, got \(2, 2\)"):
        path_from_above(walk(), CAMERA, [[1, 2], [3, 4]])
