# SPDX-License-Identifier: MIT
import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.camera.calibration_formats import read_kitti_offset
from tricue.data import kitti
from tricue.data.layouts import list_targets
from tricue.data.open_source import Source, open_source

CALIBRATION = "P2: 700 0 600 76 0 700 170 -136 0 0 1 0.01\nP3: 700 0 600 -333 0 700 170 2 0 0 1 0.01\n"


def images(folder: Path, numbers: range, digits: int = 4) -> Path:
    """A folder of images whose levels are their numbers."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in numbers:
        cv2.imwrite(str(folder / f"{number:0{digits}}.png"), np.full((12, 16, 3), number % 256, np.uint8))
    return folder


def levels(source: Source) -> list[int]:
    """The level of each frame."""
    return [int(frame.color[0, 0, 0]) for frame in source if frame.color is not None]


def label(frame: int, track: int, kind: str = "Car", left: float = 100) -> str:
    """A line for a box of 40x30 and a cuboid 1.5 m high whose bottom's middle is at (1, 1.6, 20)."""
    return f"{frame} {track} {kind} 0 0 -1.5 {left} 50 {left + 40} 80 1.5 1.6 4.5 1 1.6 20 0\n"


def tracking(root: Path, labels: str, numbers: range = range(6), calibration: str = CALIBRATION) -> Path:
    """KITTI's tracking layout."""
    for side in ("image_02", "image_03"):
        images(root / side / "0005", numbers, 6)
    for name, text in (("label_02", labels), ("calib", calibration)):
        (root / name).mkdir()
        (root / name / "0005.txt").write_text(text)
    return root


LABELS = label(4, 7) + label(1, 7) + label(2, 7, left=110) + label(0, 8, "Van") + label(3, 9) + label(5, 9)


def test_a_labeled_target(tmp_path: Path) -> None:
    """It proves that a label's frames, both images of each, its boxes and its cuboid's centers come, and that
    a frame of it without label is unknown.
    """
    root = tracking(tmp_path, LABELS + label(2, -1, "DontCare"))
    assert (
        list_targets(root)
        == list_targets(str(root))
        == list_targets(root / "image_02" / "0005")
        == ("Car 7", "Car 9")
    )
    source = open_source(root, target="Car 7")
    assert (source.format, source.length, list(source.channels)) == ("KITTI tracking", 4, ["color", "right"])
    assert levels(source) == [1, 2, 3, 4]
    assert source.truth is not None
    assert source.absent is not None
    assert source.truth[[0, 1, 3]].tolist() == [[100, 50, 40, 30], [110, 50, 40, 30], [100, 50, 40, 30]]
    assert np.isnan(source.truth[2]).all()
    assert not source.absent.any()
    assert source.positions is not None
    assert np.isnan(source.positions[2]).all()
    # The center is half the height above the bottom; P2 = K [I | (0.1, -0.197, 0.01)].
    offset = [(76 - 600 * 0.01) / 700, (-136 - 170 * 0.01) / 700, 0.01]
    np.testing.assert_allclose(source.positions[0], np.add([1, 1.6 - 0.75, 20], offset))
    assert open_source(root).truth is None


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_byte_order_mark_in_kittis_files(tmp_path: Path, encoding: str) -> None:
    """Windows' editor or PowerShell may have written the labels and the calibration."""
    root = tracking(tmp_path / "kitti", LABELS)
    truth = open_source(root, target="Car 7").positions
    for path in (root / "label_02" / "0005.txt", root / "calib" / "0005.txt"):
        path.write_text(path.read_text(), encoding=encoding)
    np.testing.assert_array_equal(open_source(root, target="Car 7").positions, truth)


def test_labels_are_by_the_files_numbers(tmp_path: Path) -> None:
    """It proves that of a cut copy, whose images don't begin at 0, the right ones come, and that one that is
    labeled but isn't there is named.
    """
    root = tracking(tmp_path, label(4, 7) + label(5, 7) + label(5, 8) + label(6, 8), range(3, 6))
    assert levels(open_source(root, target="Car 7")) == [4, 5]
    with pytest.raises(ValueError, match="0005: expected the image of frame 6, which is labeled"):
        open_source(root, target="Car 8")


def test_an_image_between_labels_is_named(tmp_path: Path) -> None:
    """It proves that a missing image of a frame that nobody labeled isn't said to be labeled."""
    root = tracking(tmp_path, label(3, 7) + label(5, 7), range(3, 6))
    (root / "image_02" / "0005" / "000004.png").unlink()
    with pytest.raises(ValueError, match="image of frame 4, between the first and last label"):
        open_source(root, target="Car 7")


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (label(0, 1) + label(0, 1), "line 2: expected Car 1 once in frame 0, got it again"),
        (label(-1, 1), "line 1: expected a tracking label"),
        (label(0, 1).replace("100", "nan"), "line 1: expected a tracking label"),
        (label(0, 1) + label(10**9, 1), "line 2: expected a tracking label"),
    ],
)
def test_bad_labels_are_named(tmp_path: Path, lines: str, message: str) -> None:
    """It proves that what can't be meant is an error with the file's name and the line's number."""
    root = tracking(tmp_path, lines)
    for call in (list_targets, lambda folder: open_source(folder, target="Car 1")):
        with pytest.raises(ValueError, match=rf"label_02/0005\.txt, {message}"):
            call(root)


def test_unknown_targets_are_refused(tmp_path: Path) -> None:
    """It proves that another name than the known ones is an error that lists them, and so is any name of
    what has one target.
    """
    root = tracking(tmp_path / "kitti", LABELS)
    with pytest.raises(ValueError, match="expected target to be one of 'Car 7', 'Car 9', got 'Van 8'"):
        open_source(root, target="Van 8")
    alone = images(tmp_path / "alone", range(2))
    with pytest.raises(
        ValueError, match="alone: expected no target, as it has only one, got '1'; leave it out"
    ):
        open_source(alone, target="1")
    recording = alone / "walk.bag"
    recording.touch()
    with pytest.raises(ValueError, match=r"walk\.bag: expected no target, as it has only one"):
        open_source(recording, target="1")
    assert list_targets(alone) == ()


WORDS = st.sampled_from(["0", "1", "7", "-1", "Car", "Van", "DontCare", "nan", "1e300", "x", "9" * 30])
LINES = st.lists(st.lists(WORDS, min_size=15, max_size=18).map(" ".join), max_size=4).map("\n".join)
FAIR = st.tuples(st.integers(0, 3), st.integers(0, 1), st.sampled_from(["Car", "Van"])).map(
    lambda v: label(*v)
)


@given(text=LINES | st.lists(FAIR, max_size=5).map("".join) | st.text(max_size=80))
def test_any_labels(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    """It proves that any text is labels with a truth each, or a ValueError with file and line."""
    path = tmp_path_factory.mktemp("any") / "0000.txt"
    path.write_bytes(text.encode("utf-8", errors="surrogatepass"))
    try:
        labels = kitti.read_labels(path)
    except ValueError as error:
        assert re.match(rf"{re.escape(str(path))}, line \d+: ", str(error))  # noqa: PT017
    else:
        for each in labels:
            assert (np.diff(each.frames) > 0).all()
            assert len(each.frames) == len(each.boxes) == len(each.front_depths) == len(each.positions)


def test_real_positions_project_into_their_boxes(data: Path) -> None:
    """It proves that the center of a real target's cuboid is seen in the middle of its box, wherever the
    image's side doesn't cut the box off.
    """
    place = data / "stereo" / "kitti-tracking"
    assert list_targets(place) == ("Car 0", "Car 1", "Car 2", "Car 31")
    for name, length in {"Car 0": 14, "Car 31": 16}.items():
        source = open_source(place, target=name)
        assert source.length == length
        assert source.truth is not None
        assert source.positions is not None
        assert source.calibration is not None
        matrix = np.array(
            next(line.split()[1:] for line in source.calibration.read_text().splitlines() if "P2" in line),
            float,
        ).reshape(3, 4)
        seen = source.positions @ matrix[:, :3].T
        middles = source.truth[:, :2] + source.truth[:, 2:] / 2 - 0.5
        off = np.abs(seen[:, :2] / seen[:, 2:] - middles) / source.truth[:, 2:]
        whole = (source.truth[:, 0] > 0) & (source.truth[:, :2] + source.truth[:, 2:] < source.size).all(
            axis=1
        )
        assert whole.sum() > 10
        assert (off[whole] < 0.1).all()
        np.testing.assert_allclose(
            read_kitti_offset(source.calibration), [0.0598, -0.0004, 0.0027], atol=1e-4
        )


def otb(folder: Path, numbers: range, boxes: int) -> Path:
    """OTB's layout."""
    images(folder / "img", numbers)
    (folder / "groundtruth_rect.txt").write_text("".join(f"{x + 1},1,5,5\n" for x in range(boxes)))
    return folder


def test_otb_images_before_the_true_boxes(tmp_path: Path) -> None:
    """It proves that of David's images, where all 770 are there, those from 300 on come, with their boxes."""
    source = open_source(otb(tmp_path / "David", range(1, 771), 471))
    assert (source.format, source.length) == ("OTB", 471)
    assert levels(source)[::470] == [300 % 256, 770 % 256]
    assert source.notes == ("took 471 of 770 images, 0300.png to 0770.png, which OTB's true boxes are for",)


@pytest.mark.parametrize(
    ("name", "numbers", "boxes"),
    [
        ("David", range(300, 775), 471),  # they begin together
        ("David", range(1, 771), 770),  # a box for each
        ("David", range(1, 600), 471),  # the range isn't covered
        ("Football1", range(1, 82), 74),
        ("Girl", range(1, 11), 5),
    ],
)
def test_otb_images_that_stay(tmp_path: Path, name: str, numbers: range, boxes: int) -> None:
    """It proves that no image is left out where a box stands for the first, or the range can't be meant."""
    source = open_source(otb(tmp_path / name, numbers, boxes))
    assert (source.length, source.notes) == (len(numbers), ())


def test_otb_folders_of_two_targets(tmp_path: Path) -> None:
    """It proves that Jogging's two targets are listed and opened, the first without being named."""
    images(tmp_path / "img", range(1, 3))
    for number in (1, 2):
        (tmp_path / f"groundtruth_rect.{number}.txt").write_text(f"{number},2,3,4\n")
    assert list_targets(tmp_path) == ("1", "2")
    for target, x in ((None, 0), ("1", 0), ("2", 1)):
        source = open_source(tmp_path, target=target)
        assert source.truth is not None
        assert (source.format, source.truth.tolist()) == ("OTB", [[x, 1, 3, 4]])
