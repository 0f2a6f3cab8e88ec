# SPDX-License-Identifier: MIT
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.camera.truth import OTB, VOT, find_truth, read_truth


def read(folder: Path, name: str, text: str) -> NDArray[np.float64]:
    """The boxes of a file with this name and text."""
    (folder / name).write_text(text)
    return read_truth(folder / name)


@pytest.mark.parametrize(
    "text", ["5,6,7,8\n1,2,3,4\n", "5\t6\t7\t8\n1\t2\t3\t4\n", "5 6 7 8\r\n1, 2, 3, 4", "5;6;7;8\n1;2;3;4"]
)
def test_separators(tmp_path: Path, text: str) -> None:
    """It proves that commas, tabs, blanks and semicolons are read alike, and OTB's count from 1 is undone."""
    assert read(tmp_path, OTB, text).tolist() == [[4, 5, 7, 8], [0, 1, 3, 4]]


def test_vot_counts_from_zero(tmp_path: Path) -> None:
    """It proves that VOT's rectangles stay, polygons become the boxes round them, masks their box."""
    boxes = read(tmp_path, VOT, "5.5,6,7,8\n10,10,20,12,18,30,8,28\nm3,4,5,6,0,12,7\n")
    assert boxes.tolist() == [[5.5, 6, 7, 8], [8, 10, 12, 20], [3, 4, 5, 6]]


@pytest.mark.parametrize(
    "line", ["nan,nan,nan,nan", "NaN", "0,0,0,0", "5,5,0,10", "nan,nan,nan,nan,nan,nan,nan,nan"]
)
def test_absent_targets_are_nan(tmp_path: Path, line: str) -> None:
    """It proves that a frame without the target is a row of NaN, and doesn't shift the rows after it."""
    boxes = read(tmp_path, VOT, f"1,2,3,4\n{line}\n5,6,7,8\n\n")
    assert np.isnan(boxes[1]).all()
    assert boxes[[0, 2]].tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]


@pytest.mark.parametrize("line", ["1,2,3", "a,b,c,d", "1,2,3,4,5", "", "1,2,3,4 # four"])
def test_bad_lines_are_named(tmp_path: Path, line: str) -> None:
    """It proves that a line that is no box is an error with the file's name and the line's number."""
    with pytest.raises(ValueError, match=r"groundtruth.txt, line 2: expected four numbers"):
        read(tmp_path, VOT, f"1,2,3,4\n{line}\n1,2,3,4\n")


def test_a_folder_without_truth(tmp_path: Path) -> None:
    """It proves that truth is optional and an empty file holds no rows."""
    assert find_truth(tmp_path) is None
    (tmp_path / OTB).write_text("\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert (truth.boxes.shape, truth.absent.shape, truth.positions) == ((0, 4), (0,), None)
