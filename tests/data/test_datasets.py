# SPDX-License-Identifier: MIT
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.data.datasets import find_sequences
from tricue.data.open_source import open_source


def image(path: Path, dtype: type[np.generic] = np.uint8) -> None:
    """A small gray image."""
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), np.full((6, 8), 100, dtype))


def text(path: Path, content: str = "1,2,3,4\n") -> None:
    """A file, by default of one box."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content)


@pytest.fixture
def collection(tmp_path: Path) -> Path:
    """A sequence of each format, between folders that are none."""
    root = tmp_path / "all"
    image(root / "otb" / "Girl" / "img" / "0001.png")
    text(root / "otb" / "Girl" / "groundtruth_rect.txt")
    image(root / "otb" / "Jogging" / "img" / "0001.png")
    text(root / "otb" / "Jogging" / "groundtruth_rect.1.txt")
    for number in (2, 10):
        image(root / "vot" / f"s{number}" / "color" / "00000001.png")
        text(root / "vot" / f"s{number}" / "sequence", "channels.color=color/%08d.png\n")
        text(root / "vot" / f"s{number}" / "groundtruth.txt")
    for name, truth in (("bear", "bear.txt"), ("child", "init.txt"), ("hidden", "README")):
        image(root / "ptb" / name / "rgb" / "r-0-1.png")
        image(root / "ptb" / name / "depth" / "d-0-1.png", np.uint16)
        text(root / "ptb" / name / truth)
    for name in ("tum", "tum-boxes"):
        image(root / name / "rgb" / "1.0.png")
        text(root / name / "rgb.txt", "1.0 rgb/1.0.png\n")
        text(root / name / "groundtruth.txt", "1.0 1 2 3 0 0 0 1\n")
    text(root / "tum-boxes" / "boxes.csv")
    for name in ("0000", "0001"):
        image(root / "kitti" / "image_02" / name / "000000.png")
        image(root / "kitti" / "image_03" / name / "000000.png")
    text(root / "kitti" / "label_02" / "0001.txt", "")
    for name in ("a.avi", "b.avi", "c.avi"):
        writer = cv2.VideoWriter(str(root / name), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (16, 16))
        writer.write(np.zeros((16, 16, 3), np.uint8))
        writer.release()
    text(root / "b.csv")
    text(root / "c.csv", "time,temperature\n")
    image(root / "pictures" / "1.png")
    image(root / "pairs" / "cones" / "im2.png")
    text(root / "pairs" / "README.txt", "groundtruth.txt")
    text(root / ".trash" / "groundtruth.txt")
    return root


SEQUENCES = [
    *("b.avi", "kitti/image_02/0001", "otb/Girl", "otb/Jogging", "ptb/bear", "ptb/child", "tum-boxes"),
    *("vot/s2", "vot/s10"),
]


def test_every_format_is_found(collection: Path) -> None:
    """It proves that the sequences with truth are found in natural order, each of which opens, and nothing
    else: no pictures, no sequence without truth, no path of a camera, no video with another table.
    """
    found = find_sequences(collection)
    assert [path.relative_to(collection).as_posix() for path in found] == SEQUENCES
    for path in found:
        source = open_source(path)
        assert (source.truth is None) == (path.parent.name == "image_02")


def test_a_sequence_itself(collection: Path) -> None:
    """It proves that a sequence is found in itself, a video too, and that what is none gives nothing."""
    for name in SEQUENCES:
        assert (
            find_sequences(collection / name) == find_sequences(str(collection / name)) == [collection / name]
        )
    for name in ("a.avi", "c.avi", "pictures", "ptb/hidden", "tum"):
        assert find_sequences(collection / name) == []


def test_kitti_with_one_sequence_is_its_root(collection: Path) -> None:
    """It proves that KITTI's root stands for its only sequence."""
    for side in ("image_02", "image_03"):
        (collection / "kitti" / side / "0000" / "000000.png").unlink()
    assert find_sequences(collection / "kitti") == [collection / "kitti"]


def test_links_are_followed_once(collection: Path) -> None:
    """It proves that a link that leads up again is no endless way, and no sequence comes twice."""
    (collection / "otb" / "loop").symlink_to(collection)
    (collection / "vot" / "again").symlink_to(collection / "otb" / "Girl")
    assert [path.relative_to(collection).as_posix() for path in find_sequences(collection)] == SEQUENCES


def test_what_cannot_be_read_is_left_out(collection: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the search of a disk goes on behind folders of others, of which a warning tells; that it
    ends in one that can't be read itself.
    """
    locked = {collection / "otb", collection / "ptb" / "bear"}
    whole, stat = Path.iterdir, Path.stat

    def closed(path: Path) -> Path:
        if path.parent in locked or path in locked:
            raise PermissionError(13, "Permission denied", str(path))
        return path

    monkeypatch.setattr(Path, "iterdir", lambda path: whole(closed(path)))
    monkeypatch.setattr(
        Path, "stat", lambda path, **given: stat(path if path in locked else closed(path), **given)
    )
    with pytest.warns(UserWarning, match="left out what can't be read: .*/otb and 1 more"):
        found = find_sequences(collection)
    closed_ones = ("otb/Girl", "otb/Jogging", "ptb/bear")
    expected = [name for name in SEQUENCES if name not in closed_ones]
    assert [path.relative_to(collection).as_posix() for path in found] == expected
    with pytest.raises(PermissionError, match="otb"):
        find_sequences(collection / "otb")


def test_malformed_sequences_are_found(collection: Path) -> None:
    """It proves that a sequence with a bad line isn't left out without a word: opening it names the line."""
    text(collection / "otb" / "Girl" / "groundtruth_rect.txt", "1,2,three,4\n")
    (collection / "vot" / "s2" / "color" / "00000001.png").unlink()
    assert len(find_sequences(collection)) == len(SEQUENCES)
    with pytest.raises(ValueError, match=r"groundtruth_rect\.txt, line 1"):
        open_source(collection / "otb" / "Girl")
    with pytest.raises(ValueError, match="expected the images of the color channel, found none"):
        open_source(collection / "vot" / "s2")


def test_no_image_is_read(collection: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that finding takes the files' names alone, and doesn't look into a sequence's folders."""

    def read(*_: object) -> None:
        raise AssertionError("an image was read")

    looked: list[str] = []
    whole = Path.iterdir
    monkeypatch.setattr(cv2, "imread", read)
    monkeypatch.setattr(cv2, "VideoCapture", read)
    monkeypatch.setattr(Path, "iterdir", lambda path: looked.append(path.as_posix()) or whole(path))
    assert len(find_sequences(collection)) == len(SEQUENCES)
    assert not any(path.endswith(("img", "color")) for path in looked)


def test_real_sequences(data: Path) -> None:
    """It proves that all real sequences with truth are found, and neither pairs nor masks without."""
    with_truth = {
        path.parent.relative_to(data).as_posix()
        for name in ("groundtruth_rect.txt", "groundtruth.txt", "label_02")
        for path in data.rglob(name)
    }
    assert len(with_truth) >= 11
    assert [path.relative_to(data).as_posix() for path in find_sequences(data)] == sorted(with_truth)


def test_a_gif_with_a_table(tmp_path: Path) -> None:
    """It proves that a GIF with true boxes is a sequence, as it is when it's named, but not a preview of a
    video of its name, nor one without boxes.
    """
    for name in ("alone.gif", "walk.gif", "walk.mp4", "without.gif", "alone.ts.txt"):
        (tmp_path / name).touch()
    text(tmp_path / "alone.csv")
    text(tmp_path / "walk.csv")
    assert [path.name for path in find_sequences(tmp_path)] == ["alone.gif", "walk.mp4"]
    assert find_sequences(tmp_path / "alone.gif") == [tmp_path / "alone.gif"]


def test_a_list_of_videos_hides_no_sequence(tmp_path: Path) -> None:
    """A boxes.csv with a box for each video doesn't make their folder a sequence."""
    for name in ("a.mp4", "b.mp4"):
        (tmp_path / name).touch()
    text(tmp_path / "a.csv")
    (tmp_path / "boxes.csv").write_text("a.mp4,1,2,30,40\nb.mp4,1,2,30,40\n")
    assert find_sequences(tmp_path) == [tmp_path / "a.mp4"]


def test_a_missing_folder_is_told(tmp_path: Path) -> None:
    """It proves that it is told in the words of :func:`tricue.open_source`, not of the system."""
    with pytest.raises(FileNotFoundError, match=r"nowhere: there is no such file or folder$"):
        find_sequences(tmp_path / "nowhere")
