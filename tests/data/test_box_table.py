# SPDX-License-Identifier: MIT
import tracemalloc
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue import Box, Status, Track
from tricue.camera.frame import Frame
from tricue.cli.outputs import CsvOutput, Step
from tricue.data.box_table import BOX_TABLE, find_box_table, find_video_box_table, read_box_table
from tricue.data.open_source import open_source
from tricue.data.truth import OTB_TRUTH, Truth, read_truth_file


def read(folder: Path, text: str) -> Truth:
    """The truth in a table of this text."""
    (folder / BOX_TABLE).write_text(text)
    truth = read_box_table(folder / BOX_TABLE)
    np.testing.assert_array_equal(read_box_table(f"{folder}/{BOX_TABLE}").boxes, truth.boxes)
    return truth


@pytest.mark.parametrize(
    "text",
    [
        "1,2,3,4\n5,6,7,8\n",
        "0,1,2,3,4\n1,5,6,7,8\n",
        "1,5,6,7,8\r\n0,1,2,3,4",
        "x,y,width,height\n1,2,3,4\n5,6,7,8\n\n",
        "\ufeffx; y; w; h\n1; 2; 3; 4\n5; 6; 7; 8\n",
        "# frame\th\tw\ty\tx\n1\t8\t7\t6\t5\n0.0\t4\t3\t2\t1\n",
        " 1  2 3 4\n5 6 7 8 \n",
        "frame x y w h\n0 1 2 3 4\n1 5 6 7 8\n",
        "x1,y1,x2,y2\n1,2,4,6\n5,6,12,14\n",
        "frame;xmin;xmax;ymin;ymax\n0;1;4;2;6\n1;5;12;6;14\n",
        "X_min,Y_min,X_max,Y_max,label\n1,2,4,6,a\n5,6,12,14,a\n",
        "Left,Top,Right,Bottom\n1,2,4,6\n5,6,12,14\n",
        "cx,cy,w,h\n2.5,4,3,4\n8.5,10,7,8\n",
        "x_center,y_center,width,height,class\n2.5,4,3,4,a\n8.5,10,7,8,a\n",
        "frame\txcenter\tycenter\twidth\theight\n1\t8.5\t10\t7\t8\n0\t2.5\t4\t3\t4\n",
        "Center_X;Center_Y;W;H\n2.5;4;3;4\n8.5;10;7;8\n",
        "x,y,w,h,cx,cy\n1,2,3,4,0,0\n5,6,7,8,0,0\n",
        "x,y,w,h,x1,y1,x2,y2\n1,2,3,4,0,0,0,0\n5,6,7,8,0,0,0,0\n",
        'Frame,"X",Y,Width,Height,note\n0,1,2,3,4,"a, b"\n1,5,6,7,8,\n',
    ],
)
def test_columns(tmp_path: Path, text: str) -> None:
    """It proves that a header names the columns in any order, that without one they are four or five, and
    that rows come by their frames; pixels stay as they are, from 0.
    """
    truth = read(tmp_path, text)
    assert truth.boxes.tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]
    assert truth.absent.tolist() == [False, False]
    assert truth.positions is None


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-be"])
def test_byte_order_marks(tmp_path: Path, encoding: str) -> None:
    """It proves that a table is read as Excel and PowerShell write it, also beside a video, and so are other
    files of boxes.
    """
    mark = "\ufeff" if encoding == "utf-16-be" else ""  # which Python writes for the others
    table, plain = tmp_path / "clip.csv", tmp_path / "groundtruth.txt"
    table.write_text(f"{mark}x\ty\tw\th\n1\t2\t3\t4\n", encoding=encoding)
    plain.write_text(f"{mark}1,2,3,4\n", encoding=encoding)
    assert find_video_box_table(tmp_path / "clip.mp4") == table
    assert read_box_table(table).boxes.tolist() == read_truth_file(plain).boxes.tolist() == [[1, 2, 3, 4]]


@pytest.mark.parametrize("name", ["Frame_Number", "frame_index", "frame_idx", "frame_no", "frame_id"])
def test_other_names_of_the_frame(tmp_path: Path, name: str) -> None:
    """Frames without a row are unknown then, too, and no row is taken for another frame's."""
    boxes = read(tmp_path, f"{name},x,y,w,h\n0,1,2,3,4\n2,5,6,7,8\n").boxes
    assert np.isnan(boxes[1]).all()
    assert boxes[[0, 2]].tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]
    other = f"{name},frame,x,y,w,h\ncamera,0,1,2,3,4\ncamera,1,5,6,7,8\n"
    assert read(tmp_path, other).boxes.tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]


def named(folder: Path, text: str) -> Truth:
    """The truth of a folder of three images with such a table."""
    for name in ("a1.jpg", "b.2.jpg", "c3.jpg"):
        cv2.imwrite(str(folder / name), np.zeros((48, 64, 3), np.uint8))
    (folder / BOX_TABLE).write_text(text)
    source = open_source(folder)
    assert source.truth is not None
    assert source.absent is not None
    return Truth(source.truth, source.absent)


@pytest.mark.parametrize("name", ["filename", "file_name", "File", "image", "image_name"])
@pytest.mark.parametrize("written", ["{}.jpg", "labeled/{}.png", "C:\\labels\\{}.jpg", "{}"])
def test_images_are_named(tmp_path: Path, name: str, written: str) -> None:
    """As labeling tools write them, for some of the images in any order; the others are unknown."""
    rows = [
        f"{written.format(image)},64,48,car,{box}" for image, box in (("c3", "1,2,4,6"), ("a1", "5,6,12,14"))
    ]
    truth = named(tmp_path, f"{name},width,height,class,xmin,ymin,xmax,ymax\n" + "\n".join(rows))
    assert truth.boxes[[0, 2]].tolist() == [[5, 6, 7, 8], [1, 2, 3, 4]]
    assert np.isnan(truth.boxes[1]).all()
    assert not truth.absent.any()


def test_bad_names_of_images_are_named(tmp_path: Path) -> None:
    """Another image than the folder's, or one twice."""
    with pytest.raises(ValueError, match=r"line 3: expected the name of an image, got 'd.jpg'"):
        named(tmp_path, "image,x,y,w,h\na1.jpg,1,2,3,4\nd.jpg,1,2,3,4\n")
    with pytest.raises(ValueError, match="line 3: expected each frame once, got 0 again"):
        named(tmp_path, "image,x,y,w,h\na1.jpg,1,2,3,4\na1.jpg,1,2,3,4\n")


def test_other_files_are_ignored(tmp_path: Path) -> None:
    """A column of another name, or of files that aren't the images, such as their video, names no frames."""
    for header, cell in (
        ("label", "b.2.jpg"),
        ("file", "clip.mp4"),
        ("file", ""),
        ("frame,image", "0,b.2.jpg"),
    ):
        assert named(tmp_path, f"{header},x,y,w,h\n{cell},1,2,3,4\n").boxes.tolist() == [[1, 2, 3, 4]]


@pytest.mark.parametrize("header", ["frame;x;y;w;h\n", ""])
@pytest.mark.parametrize("mark", [";", "\t"])
def test_decimal_commas(tmp_path: Path, header: str, mark: str) -> None:
    """Spreadsheets of many countries write them, beside semicolons or tabs; points are read as before."""
    text = f"{header}0;1,5;-2,25;3;4,0\n1;1.5;-,5;3e0;4,5e1\n".replace(";", mark)
    assert read(tmp_path, text).boxes.tolist() == [[1.5, -2.25, 3, 4], [1.5, -0.5, 3, 45]]


@pytest.mark.parametrize("row", ["1,,,,", "1,nan,nan,nan,nan", "1,5,5,0,9", "1,5,5,9,0", "1,NaN,2,3,4"])
def test_absent_is_not_unknown(tmp_path: Path, row: str) -> None:
    """It proves that a row without a box says "absent", and that a frame without a row is unknown."""
    truth = read(tmp_path, f"0,1,2,3,4\n{row}\n3,5,6,7,8\n")
    assert truth.absent.tolist() == [False, True, False, False]
    assert np.isnan(truth.boxes).all(axis=1).tolist() == [False, True, True, False]


def test_a_negative_size_is_refused(tmp_path: Path) -> None:
    """It proves that it isn't taken for an absent target, here as in the other files of true boxes."""
    with pytest.raises(ValueError, match=r"boxes.csv, line 2: expected a width and height of 0 or more"):
        read(tmp_path, "0,1,2,3,4\n1,9,9,-5,4\n")


def test_positions(tmp_path: Path) -> None:
    """It proves that positions are kept, also of absent targets, and are NaN where a cell is empty."""
    truth = read(tmp_path, "frame,x,y,w,h,Z_m,X_m\n2,1,2,3,4,5,6\n0,,,,,7,\n")
    assert truth.positions is not None
    np.testing.assert_array_equal(truth.positions, [[np.nan, np.nan, 7], [np.nan] * 3, [6, np.nan, 5]])


def test_what_track_writes(tmp_path: Path) -> None:
    """It proves that a table of tricue track is read back, with its positions where the tracker has them."""
    frame = Frame(np.zeros((4, 4, 3), np.uint8), timestamp=0.5)
    for position in (None, np.array([0.25, -0.5, 3.0])):
        with CsvOutput(tmp_path / BOX_TABLE) as output:
            for number in (2, 3):
                track = Track(Box(1.5, 2, 3, 4), 0.5, Status.TRACKED, position)
                output.write(Step(number, frame, track, 0.01))
        truth = read_box_table(tmp_path / BOX_TABLE)
        assert truth.boxes[2:].tolist() == [[1.5, 2, 3, 4]] * 2
        assert np.isnan(truth.boxes[:2]).all()
        assert not truth.absent.any()
        if position is None:
            assert truth.positions is None
        else:
            assert truth.positions is not None
            assert truth.positions[2:].tolist() == [[0.25, -0.5, 3.0]] * 2


def test_an_empty_table(tmp_path: Path) -> None:
    """It proves that a table without rows holds none, with a header or without."""
    for text in ("", "\n\n", "frame,x,y,width,height\n"):
        truth = read(tmp_path, text)
        assert (truth.boxes.shape, truth.absent.shape, truth.positions) == ((0, 4), (0,), None)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1,2,3\n", "line 1: expected columns x, y, width, height or cx, .*, each once, got '1,2,3'"),
        ("1,2,3,4,5,6\n", "line 1: expected columns"),
        ("1o,2,3,4\n", "line 1: expected columns x, y, width, height .* each once, got '1o,2,3,4'"),
        ("x1,y1,x2\n1,2,3\n", "line 1: expected columns x, .* height or x1, y1, x2, y2, each once"),
        ("x1,y1,x2,y2\n1,2,3,\n", "line 2: expected all of x1, y1, x2, y2 or none, got no y2"),
        ("x1,y1,x2,y2\n1,2,3,far\n", "line 2: expected a number y2, got 'far'"),
        ("x1,y1,x2,y2\n9,9,5,12\n", "line 2: expected a width and height of 0 or more, got '9,9,5,12'"),
        ("x,y,width\n1,2,3\n", "line 1: expected columns"),
        ("x,y,w,h,width\n1,2,3,4,5\n", "line 1: expected columns .* each once"),
        ("x,y,w,h\n1,2,3,4\n\n1,2,3,4\n", "line 3: expected 4 values, got ''"),
        ("x,y,w,h\n1,2,3\n", "line 2: expected 4 values, got '1,2,3'"),
        ("frame;x;y;w;h\n0;1,5,6;2;3;4\n", "line 2: expected a number x, got '1,5,6'"),
        ("1 2 3 4\n1 2 3\n", "line 2: expected 4 values, got '1 2 3'"),
        ("1,2,3,4\n1,2,3,4,5\n", "line 2: expected 4 values"),
        ("x,y,w,h\n1,two,3,4\n", "line 2: expected a number y, got 'two'"),
        ("1,2,3,4\n1,2,inf,4\n", "line 2: expected a number width, got 'inf'"),
        ("1,2,3,4\n1,2,1e7,4\n", "line 2: expected at most a million pixels, got '1,2,1e7,4'"),
        ("x,y,w,h,z_m\n1,2,3,4,1e300\n", "line 2: expected a number z_m, got '1e300'"),
        ("x,y,w,h,Z_m\n1,2,3,4,far\n", "line 2: expected a number z_m, got 'far'"),
        ("1,2,3,4,\n", "line 1: expected all of x, y, width, height or none, got no height"),
        ("0.5,1,2,3,4\n", "line 1: expected a frame's whole number from 0, got '0.5'"),
        ("-1,1,2,3,4\n", "line 1: expected a frame's whole number from 0, got '-1'"),
        ("frame,x,y,w,h\n,1,2,3,4\n", "line 2: expected a frame's whole number from 0, got ''"),
        (
            "x,y,w,h\n0.1,0.9,0.2,0.1\n,,,\n0.2,1,0.1,0\n",
            "line 2: expected boxes in pixels, .* shares of the",
        ),
        ("x1,y1,x2,y2\n0.1,0.2,0.9,1\n", "line 2: expected boxes in pixels, got no number above 1"),
        ("cx,cy,w,h\n0.5,0.5,0.1,0.2\n", "line 2: expected boxes in pixels"),
        ("cx,cy,w,h\n0.5,0.5,0.1,\n", "line 2: expected all of cx, cy, width, height or none, got no height"),
        ("99999999999,1,2,3,4\n", "line 1: expected a frame's whole number"),
        ("0,1,2,3,4\n1,1,2,3,4\n0,1,2,3,4\n", "line 3: expected each frame once, got 0 again"),
    ],
)
def test_bad_tables_are_named(tmp_path: Path, text: str, message: str) -> None:
    """It proves that what is no such table is an error with the file's name and the line's number."""
    with pytest.raises(ValueError, match=rf"boxes\.csv, {message}"):
        read(tmp_path, text)


WORDS = st.sampled_from(
    [
        "frame",
        "x",
        "y",
        "w",
        "h",
        "width",
        "height",
        "X_m",
        "nan",
        "inf",
        "0",
        "1",
        "-2",
        "1e400",
        '"',
        "é",
        "",
    ]
)
LINES = st.lists(st.lists(WORDS, max_size=7).map(",".join), max_size=5).map("\n".join)


@given(text=LINES | st.text(max_size=80))
def test_any_text(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    """It proves that any text is a truth of rows that fit each other, or a ValueError with file and line."""
    path = tmp_path_factory.mktemp("any") / BOX_TABLE
    path.write_bytes(text.encode("utf-8", errors="surrogatepass"))
    try:
        truth = read_box_table(path)
    except ValueError as error:
        assert str(error).startswith(f"{path}, line ")  # noqa: PT017 (other texts are no error)
    else:
        assert len(truth.boxes) == len(truth.absent)
        assert np.isnan(truth.boxes[truth.absent]).all()
        assert (truth.boxes[:, 2:][np.isfinite(truth.boxes[:, 2:])] > 0).all()
        assert truth.positions is None or truth.positions.shape == (len(truth.boxes), 3)


def test_which_table_is_found(tmp_path: Path) -> None:
    """It proves that boxes.csv goes before a video's own table, and that a table beside a video whose header
    is about other things is left alone, while one with a box's columns is read, be it complete or not.
    """
    video, own = tmp_path / "clip.mp4", tmp_path / "clip.csv"
    assert find_box_table(tmp_path, video) is None
    own.write_text("time,acceleration\n0,9.81\n")
    assert find_video_box_table(video) is None
    own.write_text("fx,fy,cx,cy,width,height\n500,500,320,240,640,480\n")  # a camera's
    assert find_video_box_table(video) is None
    for text in ("x,y,width\n", "1,2,3,4\n", "1 2 3 4\n", "frame,x,y,w,h\n", "x1,y1,x2,y2\n", "cx,cy,w,h\n"):
        own.write_text(text)
        assert find_video_box_table(video) == find_box_table(tmp_path, video) == own
    assert find_box_table(tmp_path) is None
    (tmp_path / BOX_TABLE).touch()
    assert find_box_table(tmp_path, video) == tmp_path / BOX_TABLE


def test_what_a_tracker_wrote_beside_a_video_is_not_the_truth(tmp_path):
    """tricue track clip.mp4 --csv clip.csv must not make the next run judge itself by it."""
    (tmp_path / "clip.csv").write_text("frame,time_s,status,score,x,y,width,height\n0,0,tracked,1,1,2,3,4\n")
    assert find_video_box_table(tmp_path / "clip.mp4") is None
    (tmp_path / "clip.csv").write_text("frame,status,x,y,width,height\n0,seen,1,2,3,4\n")
    assert find_video_box_table(tmp_path / "clip.mp4") == tmp_path / "clip.csv"


@pytest.mark.parametrize("text", ["clip.mp4,1,2,30,40\n", "\ufeffWalk.AVI;1;2;30;40\r\nclip.mp4;5;6;7;8\r\n"])
def test_a_list_of_videos_is_not_the_truth(tmp_path: Path, text: str) -> None:
    """Where boxes.csv has a box for each of several videos, the table beside a video is its truth."""
    (tmp_path / BOX_TABLE).write_text(text)
    video, own = tmp_path / "clip.mp4", tmp_path / "clip.csv"
    assert find_box_table(tmp_path) is find_box_table(tmp_path, video) is None
    own.write_text("1,2,3,4\n")
    assert find_box_table(tmp_path, video) == own


@pytest.mark.parametrize("name", [OTB_TRUTH, BOX_TABLE])
def test_a_long_table_takes_little_memory(tmp_path: Path, name: str) -> None:
    """It proves that rows are kept as numbers while they are read, in 110 bytes each of a file and 160 of a
    table; as Python objects they took 250 and 840, gigabytes for a day of video.
    """
    rows, path = 20_000, tmp_path / name
    path.write_text("".join(f"{index},6,30,40\n" for index in range(rows)))
    read = read_box_table if name == BOX_TABLE else read_truth_file
    tracemalloc.start()
    try:
        assert len(read(path).boxes) == rows
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 200 * rows
