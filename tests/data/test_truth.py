# SPDX-License-Identifier: MIT
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue.data.box_table import read_box_table
from tricue.data.truth import OTB_TRUTH, VOT_TRUTH, find_truth, otb_targets, read_truth_file


def read(folder: Path, name: str, text: str) -> NDArray[np.float64]:
    """The boxes of a file with this name and text."""
    (folder / name).write_text(text)
    boxes = read_truth_file(folder / name).boxes
    np.testing.assert_array_equal(read_truth_file(f"{folder}/{name}").boxes, boxes)
    return boxes


@pytest.mark.parametrize(
    "text", ["5,6,7,8\n1,2,3,4\n", "5\t6\t7\t8\n1\t2\t3\t4\n", "5 6 7 8\r\n1, 2, 3, 4", "5;6;7;8\n1;2;3;4"]
)
def test_separators(tmp_path: Path, text: str) -> None:
    """It proves that commas, tabs, blanks and semicolons are read alike, and OTB's count from 1 is undone."""
    assert read(tmp_path, OTB_TRUTH, text).tolist() == [[4, 5, 7, 8], [0, 1, 3, 4]]


def test_vot_counts_from_zero(tmp_path: Path) -> None:
    """It proves that VOT's rectangles stay, polygons become the boxes round them, masks their box."""
    boxes = read(tmp_path, VOT_TRUTH, "5.5,6,7,8\n10,10,20,12,18,30,8,28\nm3,4,5,6,0,12,7\n")
    assert boxes.tolist() == [[5.5, 6, 7, 8], [8, 10, 12, 20], [3, 4, 5, 6]]


@pytest.mark.parametrize(
    "line", ["nan,nan,nan,nan", "NaN", "0,0,0,0", "5,5,0,10", "nan,nan,nan,nan,nan,nan,nan,nan"]
)
def test_absent_targets_are_nan(tmp_path: Path, line: str) -> None:
    """It proves that a frame without the target is a row of NaN, and doesn't shift the rows after it."""
    boxes = read(tmp_path, VOT_TRUTH, f"1,2,3,4\n{line}\n5,6,7,8\n\n")
    assert np.isnan(boxes[1]).all()
    assert boxes[[0, 2]].tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]


@pytest.mark.parametrize("line", ["1,2,3", "a,b,c,d", "1,2,3,4,5", "", "1,2,3,4 # four"])
def test_bad_lines_are_named(tmp_path: Path, line: str) -> None:
    """It proves that a line that is no box is an error with the file's name and the line's number."""
    with pytest.raises(ValueError, match=r"groundtruth.txt, line 2: expected four numbers"):
        read(tmp_path, VOT_TRUTH, f"1,2,3,4\n{line}\n1,2,3,4\n")


@pytest.mark.parametrize("name", [OTB_TRUTH, VOT_TRUTH, "init.txt"])
@pytest.mark.parametrize("text", ["0.1,0.9,0.2,0.1\n0,0,0,0\n", "nan,nan,nan,nan\n0,0,0.4,1\n"])
def test_shares_of_the_image_are_told(tmp_path: Path, name: str, text: str) -> None:
    """Boxes as YOLO writes them aren't taken as pixels, of which the target would be a part of one."""
    with pytest.raises(
        ValueError, match=rf"{name}, line 1: expected boxes in pixels, .* shares of the image"
    ):
        read(tmp_path, name, text)


@pytest.mark.parametrize(
    "text", ["0,0,1,1\n1,1,1,1\n", "0.5,0.25,1,1\n", "0,0,0.5,0.5\n2,0,0.5,0.5\n", "0,0,0,0\n"]
)
def test_boxes_of_a_pixel_are_no_shares(tmp_path: Path, text: str) -> None:
    """Nor are smaller ones that move on, nor a target that is always absent."""
    assert len(read(tmp_path, VOT_TRUTH, text)) == text.count("\n")
    (tmp_path / "boxes.csv").write_text(text)
    assert len(read_box_table(tmp_path / "boxes.csv").boxes) == text.count("\n")


def test_a_folder_without_truth(tmp_path: Path) -> None:
    """It proves that truth is optional and an empty file holds no rows."""
    assert find_truth(tmp_path) is None
    (tmp_path / OTB_TRUTH).write_text("\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert (truth.boxes.shape, truth.absent.shape, truth.positions) == ((0, 4), (0,), None)


def test_absent_is_not_unknown(tmp_path: Path) -> None:
    """It proves that lines without a box and VOT's tag say "absent", a tag also behind the boxes, and that
    the rest of the rows behind the boxes are unknown.
    """
    (tmp_path / VOT_TRUTH).write_text("1,2,3,4\n5,6,7,8\nnan,nan,nan,nan\n5,6,0,8\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert truth.absent.tolist() == [False, False, True, True]
    (tmp_path / "absent.tag").write_text("0\n1\n0\n0\n0\n1\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert truth.absent.tolist() == [False, True, True, True, False, True]
    assert np.isnan(truth.boxes).all(axis=1).tolist() == [False, True, True, True, True, True]
    (tmp_path / "absent.tag").write_text("1\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert truth.absent.tolist() == [True, False, True, True]


def test_depths_beside_the_boxes(tmp_path: Path) -> None:
    """It proves that position_z_mm.txt gives Z in meters, NaN where it says 0 or NaN, and nothing else."""
    (tmp_path / VOT_TRUTH).write_text("1,2,3,4\n")
    (tmp_path / "position_z_mm.txt").write_text("1500\n0\nnan\n 2250.5\n\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert truth.positions is not None
    np.testing.assert_array_equal(truth.positions[:, 2], [1.5, np.nan, np.nan, 2.2505])
    assert np.isnan(truth.positions[:, :2]).all()


@pytest.mark.parametrize(
    "files",
    [{"absence.label": "0\n1\n0\n1\n"}, {"full_occlusion.txt": "0,1,0,0\n", "out_of_view.txt": "0,0,0,1\n"}],
    ids=["GOT-10k", "LaSOT"],
)
def test_absent_targets_of_other_data_sets(tmp_path: Path, files: dict[str, str]) -> None:
    """GOT-10k has a line for each frame, LaSOT two files of one line; boxes of such frames are left out."""
    (tmp_path / "groundtruth.txt").write_text("1,2,3,4\n" * 4)
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    truth = find_truth(tmp_path)
    assert truth is not None
    assert truth.absent.tolist() == np.isnan(truth.boxes).all(axis=1).tolist() == [False, True, False, True]


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        (VOT_TRUTH, "1,2,3,4\n1,2,inf,4\n", "line 2: expected four numbers"),
        (VOT_TRUTH, "1,2,3,4\n1,2,1e308,4\n", "line 2: expected at most a million pixels"),
        (VOT_TRUTH, "-1e308,0,1e308,0,1,1", "line 1: expected at most a million pixels"),
        (
            VOT_TRUTH,
            "1,2,3,4\n1,2,-3,4\n",
            "line 2: expected a width and height of 0 or more, got '1,2,-3,4'",
        ),
        (OTB_TRUTH, "1,2,3,-4\n", "line 1: expected a width and height of 0 or more, got '1,2,3,-4'"),
        ("absent.tag", "0\n2\n", "line 2: expected 0, or 1 for an absent target, got '2'"),
        ("absent.tag", "0\n\n1\n", "line 2: expected 0, or 1"),
        ("out_of_view.txt", "0,1,,0\n", "line 1: expected 0, or 1 for an absent target, got ''"),
        ("position_z_mm.txt", "1\n-5\n", "line 2: expected a depth in millimeters, 0 if unknown, got '-5'"),
        ("position_z_mm.txt", "1\ninf\n", "line 2: expected a depth"),
        ("position_z_mm.txt", "1\n1e300\n", "line 2: expected a depth"),
        ("position_z_mm.txt", "1\n\n5\n", "line 2: expected a depth"),
        ("position_z_mm.txt", "1 2\n", "line 1: expected a depth"),
    ],
)
def test_bad_files_beside_the_boxes_are_named(tmp_path: Path, name: str, text: str, message: str) -> None:
    """It proves that what can't be meant is an error with the file's name and the line's number."""
    (tmp_path / VOT_TRUTH).write_text("1,2,3,4\n")
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=f"{name}, {message}"):
        find_truth(tmp_path)


@pytest.mark.parametrize("name", ["absence.label", "full_occlusion.txt", "out_of_view.txt"])
@pytest.mark.parametrize("count", [3, 5])
def test_tags_of_other_data_sets_are_as_many_as_boxes(tmp_path: Path, name: str, count: int) -> None:
    """It proves that tags that can't be those of the boxes are an error that names their file, and that the
    first box alone, as in test sets, goes with tags of all frames.
    """
    (tmp_path / VOT_TRUTH).write_text("1,2,3,4\n" * 4)
    (tmp_path / name).write_text("0\n" * count)
    with pytest.raises(ValueError, match=f"{name}: expected 4 numbers, one for each true box, got {count}"):
        find_truth(tmp_path)
    (tmp_path / VOT_TRUTH).write_text("1,2,3,4\n")
    truth = find_truth(tmp_path)
    assert truth is not None
    assert len(truth.absent) == count


def test_otb_targets(tmp_path: Path) -> None:
    """It proves that of OTB's files of several targets each can be chosen, the first without a choice, and
    that they count pixels from 1 too.
    """
    for number in (10, 2):
        (tmp_path / f"groundtruth_rect.{number}.txt").write_text(f"{number},2,3,4\n")
    (tmp_path / "groundtruth_rect.old.txt").write_text("x")
    assert otb_targets(tmp_path) == ("2", "10")
    for target, x in ((None, 1), ("2", 1), ("10", 9)):
        truth = find_truth(tmp_path, target)
        assert truth is not None
        assert truth.boxes.tolist() == [[x, 1, 3, 4]]
    with pytest.raises(ValueError, match="expected target to be one of '2', '10', got '1'"):
        find_truth(tmp_path, "1")


NUMBERS = st.sampled_from(["0", "1", "5.5", "-2", "nan", "inf", "1e400", "x", "m1", ""])
LINES = st.lists(st.tuples(st.lists(NUMBERS, max_size=9), st.sampled_from(", \t;")), max_size=4).map(
    lambda lines: "\n".join(apart.join(words) for words, apart in lines)
)
TEXTS = LINES | st.text(max_size=60)


@given(name=st.sampled_from([OTB_TRUTH, VOT_TRUTH]), boxes=TEXTS, tag=TEXTS, depths=TEXTS)
def test_any_text(
    tmp_path_factory: pytest.TempPathFactory, name: str, boxes: str, tag: str, depths: str
) -> None:
    """It proves that any texts are a truth of rows that fit each other, or an error with file and line."""
    folder = tmp_path_factory.mktemp("any")
    for path, text in ((name, boxes), ("absent.tag", tag), ("position_z_mm.txt", depths)):
        (folder / path).write_bytes(text.encode("utf-8", errors="surrogatepass"))
    try:
        truth = find_truth(folder)
    except ValueError as error:
        assert re.match(rf"{re.escape(str(folder))}/[\w.]+, line \d+: ", str(error))  # noqa: PT017
    else:
        assert truth is not None
        assert len(truth.boxes) == len(truth.absent)
        assert (np.isfinite(truth.boxes).all(axis=1) | np.isnan(truth.boxes).all(axis=1)).all()
        assert np.isnan(truth.boxes[truth.absent]).all()
