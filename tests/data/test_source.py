# SPDX-License-Identifier: MIT
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue.data.layouts import read_layout
from tricue.data.open_source import Source, open_source
from tricue.data.streams import Images


def images(folder: Path, count: int) -> Path:
    """A folder of images of the levels 0, 10, ..."""
    folder.mkdir(parents=True, exist_ok=True)
    for index in range(count):
        cv2.imwrite(str(folder / f"{index:04}.png"), np.full((48, 64, 3), 10 * index, np.uint8))
    return folder


def video(path: Path, count: int) -> Path:
    """An MJPG video of the same levels, at 20 frames per second."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 20.0, (64, 48))
    for index in range(count):
        writer.write(np.full((48, 64, 3), 10 * index, np.uint8))
    writer.release()
    return path


def seen(frames: Iterable[Any]) -> list[tuple[int, float]]:
    """Each frame's level in tens, and its time."""
    return [(round(float(frame.color.mean()) / 10), frame.timestamp) for frame in frames]


@pytest.mark.parametrize("make", [lambda f: images(f / "i", 9), lambda f: video(f / "v.avi", 9)])
@pytest.mark.parametrize("wanted", [[], [0], [8], [0, 1, 2], [1, 4, 8], range(0, 9, 3)])
def test_chosen_frames(tmp_path: Path, make: Any, wanted: Iterable[int]) -> None:
    """It proves that the frames of some numbers and their times are those at these places of the whole."""
    source = open_source(make(tmp_path))
    whole = seen(source)
    assert seen(source.frames(wanted)) == [whole[index] for index in wanted]


def test_only_the_chosen_images_are_read(tmp_path: Path) -> None:
    """It proves that the images between are not decoded, of any channel, and that --fps gives the times."""
    paths = [tmp_path / str(index) for index in range(1000)]
    decoded: list[int] = []

    def read(path: Path) -> NDArray[np.uint8]:
        decoded.append(int(path.name))
        return np.zeros((4, 4, 3), np.uint8)

    source = Source("s", {"color": Images(paths, read=read), "right": Images(paths, read=read)}, rate=4.0)
    assert [frame.timestamp for frame in source.frames([10, 999])] == [2.5, 249.75]
    assert decoded == [10, 10, 999, 999]


@pytest.mark.parametrize("wanted", [[1, 1], [2, 1], [-1], [0, 0]])
def test_numbers_that_do_not_rise_are_refused(tmp_path: Path, wanted: list[int]) -> None:
    """It proves that numbers out of order are an error at once."""
    source = open_source(images(tmp_path, 3))
    with pytest.raises(ValueError, match=r"^indices: expected rising numbers of frames from 0, got \["):
        source.frames(wanted)


def test_frames_behind_the_end_are_named(tmp_path: Path) -> None:
    """It proves that a number that there isn't is an error after the frames before it."""
    for place, message in (
        (images(tmp_path / "i", 3), "i: expected 4 images, got 3"),
        (video(tmp_path / "v.avi", 3), r"v\.avi: expected 4 frames, got 3"),
    ):
        frames = open_source(place).frames([1, 3])
        next(frames)
        with pytest.raises(ValueError, match=message):
            next(frames)
    with pytest.raises(ValueError, match=r"v\.avi: expected 9 frames, got 3"):
        list(open_source(tmp_path / "v.avi").frames([8]))


def test_truth_without_absent_knows_of_none(tmp_path: Path) -> None:
    """It proves that who makes a source of boxes alone gets an ``absent`` that fits them."""
    stream = Images([tmp_path / "1.png"])
    source = Source("s", {"color": stream}, np.full((3, 4), np.nan))
    assert source.absent is not None
    assert source.absent.tolist() == [False] * 3
    assert Source("s", {"color": stream}).absent is None


def tables(folder: Path) -> dict[str, Path]:
    """A place of each layout that has no file of true boxes of its own, and where its table belongs."""
    images(folder / "plain", 3)
    images(folder / "sub" / "img", 3)
    for side in ("left", "right"):
        images(folder / "pair" / side, 3)
    images(folder / "tum" / "rgb", 3)
    lines = [f"{index}.0 rgb/{index:04}.png\n" for index in range(3)]
    (folder / "tum" / "rgb.txt").write_text("".join(lines))
    (folder / "tum" / "groundtruth.txt").write_text("0.0 1 2 3 0 0 0 1\n")
    images(folder / "kitti" / "image_2", 3)
    (folder / "one").mkdir()
    video(folder / "one" / "v.avi", 3)
    video(folder / "clip.avi", 3)
    return {
        "images": folder / "plain",
        "images in img/": folder / "sub",
        "stereo pair": folder / "pair",
        "TUM RGB-D": folder / "tum",
        "KITTI": folder / "kitti",
        "video": folder / "one",
    }


@pytest.mark.parametrize(
    "name",
    ["images", "images in img/", "stereo pair", "TUM RGB-D", "KITTI", "video", "video alone", "its own"],
)
def test_tables_of_boxes(tmp_path: Path, name: str) -> None:
    """It proves that a table gives the truth of every layout that has none of its own, and that a malformed
    one is named with its line.
    """
    places = tables(tmp_path)
    own = {"video alone": tmp_path / "clip.avi", "its own": tmp_path / "one"}
    place = own.get(name) or places[name]
    table = {"video alone": tmp_path / "clip.csv", "its own": place / "v.csv"}.get(name, place / "boxes.csv")
    assert open_source(place).truth is None
    table.write_text("frame,x,y,w,h,X_m,Y_m,Z_m\n2,10,20,5,6,0,0.5,2\n0,,,,,,,\n")
    source = open_source(place)
    assert source.format == ("video" if name in own else name.split(" in ", maxsplit=1)[0])
    assert source.truth is not None
    assert source.absent is not None
    assert source.positions is not None
    assert np.isnan(source.truth[:2]).all()
    assert source.truth[2].tolist() == [10, 20, 5, 6]
    assert source.absent.tolist() == [True, False, False]
    assert source.positions[2].tolist() == [0, 0.5, 2]
    assert source.notes == (f"true boxes found: {table}",)
    table.write_text("x,y,w,h\n1,2,3,4\n1,2,3\n")
    with pytest.raises(ValueError, match=rf"{table.name}, line 3: expected 4 values"):
        open_source(place)


def test_a_file_of_true_boxes_goes_before_a_table(tmp_path: Path) -> None:
    """It proves that a table isn't looked at beside OTB's or VOT's file."""
    (images(tmp_path, 1) / "boxes.csv").write_text("no table")
    (tmp_path / "groundtruth.txt").write_text("1,2,3,4\n")
    assert open_source(tmp_path).first_box == (1, 2, 3, 4)


def test_frames_without_a_row_have_no_true_box(tmp_path: Path) -> None:
    """It proves that there is no true box after the last row, nor before the first frame."""
    (images(tmp_path, 3) / "boxes.csv").write_text("x,y,w,h\n1,2,3,4\n5,6,7,8\n")
    source = open_source(tmp_path)
    assert [source.true_box(number) for number in (-2, -1, 0, 1, 2)] == [
        None,
        None,
        (1, 2, 3, 4),
        (5, 6, 7, 8),
        None,
    ]


WORDS = st.sampled_from(
    [
        "channels.color=",
        "channels.depth=",
        "channel.default=ir",
        "fps=",
        "nan",
        "30",
        "/",
        "%08d",
        "%d",
        ".png",
    ]
    + ["color", "..", "\n", "\0", "é", "1.5 a.png", "# x", "inf b", ","]
)
TEXTS = st.lists(WORDS, max_size=8).map("".join) | st.text(max_size=300)


@given(name=st.sampled_from(["sequence", "rgb.txt", "depth.txt"]), content=TEXTS)
def test_any_list_of_images(tmp_path_factory: pytest.TempPathFactory, name: str, content: str) -> None:
    """It proves that any text in VOT's or TUM's place is a layout, or a ValueError that names the file; with
    its line where a line is wrong.
    """
    folder = tmp_path_factory.mktemp("any")
    (folder / "color").mkdir()
    (folder / "color" / "00000001.png").touch()
    (folder / name).write_bytes(content.encode("utf-8", errors="surrogatepass"))
    try:
        layout = read_layout(folder, None)
    except ValueError as error:
        # The images may be meant to lie beside the list: then it is the folder that has none.
        known = str(folder / name), f"{folder}/", f"{folder}: expected the images"
        assert str(error).startswith(known)  # noqa: PT017
    else:
        assert layout.format in ("VOT", "VOT RGB-D", "TUM RGB-D")
        assert layout.channels
