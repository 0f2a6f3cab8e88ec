# SPDX-License-Identifier: MIT
"""Calibrations that cv2's parser can't be trusted with."""

from pathlib import Path

import pytest
from tricue import Intrinsics, StereoRig
from tricue.camera.opencv_file import MAX_BYTES

HEAD = "%YAML:1.0\n---\n"


@pytest.mark.parametrize(
    "text",
    [
        HEAD + "a: " + "[" * 100_000,
        HEAD + "a: " + "- " * 100_000,
        '{"a": ' * 50_000,
        '<?xml version="1.0"?><opencv_storage>' + "<a>" * 50_000,
    ],
    ids=["YAML", "YAML of dashes", "JSON", "XML"],
)
def test_deep_nesting_is_refused(tmp_path: Path, text: str) -> None:
    """It proves that values nested so deep that cv2 crashes are refused by the file's name."""
    path = tmp_path / "camera.yml"
    path.write_text(text)
    with pytest.raises(
        ValueError, match=r"camera\.yml: expected a calibration, its values are nested too deeply"
    ):
        Intrinsics.from_opencv(path, size=(640, 480))


def test_large_files_are_refused(tmp_path: Path) -> None:
    """It proves that a file that can't be a calibration isn't parsed."""
    path = tmp_path / "camera.yml"
    path.write_text(HEAD + " " * MAX_BYTES)
    with pytest.raises(
        ValueError, match=r"camera\.yml: expected a calibration of at most 1 MB, got 1,048,590 bytes"
    ):
        StereoRig.from_opencv(path)


@pytest.mark.parametrize("size", ["rows: 1", "cols: 1", "rows: 1\n   col: 1", f"sizes: [ {'1, ' * 63}1 ]"])
def test_a_matrix_without_rows_and_columns_is_refused(tmp_path: Path, size: str) -> None:
    """It proves that cv2 isn't given a matrix without cols or of many dimensions, of which it crashes."""
    path = tmp_path / "camera.yml"
    path.write_text(f"{HEAD}camera_matrix: !!opencv-matrix\n   {size}\n   dt: d\n   data: [ 1. ]\n")
    with pytest.raises(ValueError, match=r"camera\.yml: camera_matrix: expected a matrix with as many"):
        Intrinsics.from_opencv(path, size=(640, 480))


def test_a_matrix_has_as_many_numbers_as_it_says(tmp_path: Path) -> None:
    """It proves that a matrix of 3 x 3 with 8 numbers is named, with its file."""
    path = tmp_path / "camera.yml"
    matrix = (
        "!!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1., 0., 2., 0., 1., 2., 0., 0. ]\n"
    )
    path.write_text(f"{HEAD}camera_matrix: {matrix}")
    with pytest.raises(
        ValueError, match=r"camera\.yml: camera_matrix: expected a matrix with as many numbers as"
    ):
        Intrinsics.from_opencv(path, size=(640, 480))
