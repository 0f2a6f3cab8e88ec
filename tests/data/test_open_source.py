# SPDX-License-Identifier: MIT
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box
from tricue.data.open_source import Source, open_source


def gray(level: int) -> NDArray[np.uint8]:
    """An image of one level."""
    return np.full((48, 64, 3), level, np.uint8)


def images(folder: Path, names: list[str]) -> Path:
    """A folder whose images are of the levels 10, 20, ... in the order of the names."""
    folder.mkdir(parents=True, exist_ok=True)
    for index, name in enumerate(names, 1):
        cv2.imwrite(str(folder / name), gray(10 * index))
    return folder


def video(path: Path, frames: int = 6, fps: float = 12.0) -> Path:
    """An MJPG video whose frames have the levels 10, 20, ..."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), fps, (64, 48))
    for index in range(1, frames + 1):
        writer.write(gray(10 * index % 256))
    writer.release()
    return path


def levels(source: Source) -> list[int]:
    """The mean level of each frame."""
    return [round(float(frame.color.mean())) for frame in source if frame.color is not None]


def test_a_folder_in_natural_order(tmp_path: Path) -> None:
    """It proves that images come in the order of their numbers, and other and hidden files are left out."""
    folder = images(tmp_path / "walk", ["a1.png", "a2.jpg", "a10.PNG", "a100.bmp", "b1.png"])
    (folder / "notes.txt").write_text("x")
    (folder / "._a3.png").write_text("x")
    source = open_source(folder)
    assert (source.name, source.length, source.truth, source.first_box) == ("walk", 5, None, None)
    assert levels(source) == [10, 20, 30, 40, 50]
    assert levels(source) == [10, 20, 30, 40, 50]  # once more from the start


def test_an_image_is_what_it_holds(tmp_path: Path) -> None:
    """It proves that a JPEG file that is called .png is read, and a PNG file that is called .jpg."""
    folder = images(tmp_path, ["1.jpg", "2.png"])
    (folder / "1.jpg").rename(folder / "1.png")
    (folder / "2.png").rename(folder / "2.jpg")
    assert levels(open_source(folder)) == [10, 20]


def test_times_follow_the_frame_rate(tmp_path: Path) -> None:
    """It proves that a frame's timestamp is its number over the frame rate, in seconds."""
    source = open_source(video(tmp_path / "v.avi", fps=12.0))
    assert source.fps == pytest.approx(12.0)
    assert [frame.timestamp for frame in source] == pytest.approx([index / 12 for index in range(6)])


def test_a_video_counts_itself(tmp_path: Path) -> None:
    """It proves that every frame of a video comes, and its length isn't taken from the container."""
    source = open_source(str(video(tmp_path / "v.avi")))
    assert (source.name, source.length) == ("v", None)
    assert levels(source) == pytest.approx([10, 20, 30, 40, 50, 60], abs=2)


def test_a_cut_video_gives_what_it_holds(tmp_path: Path) -> None:
    """It proves that a video that was cut off gives its whole frames, then ends and says so."""
    path = video(tmp_path / "v.avi", frames=40)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.warns(
        UserWarning, match=r"v\.avi: only \d+ of its 40 frames can be decoded; is it cut off\?"
    ):
        found = levels(open_source(path))
    assert 0 < len(found) < 40


def test_otb_sequences(tmp_path: Path) -> None:
    """It proves that OTB's layout gives the images of img/ and true boxes that count from 0."""
    images(tmp_path / "img", ["0001.jpg", "0002.jpg", "0003.jpg"])
    (tmp_path / "groundtruth_rect.txt").write_text("11,21,5,6\n12,22,5,6\n")
    source = open_source(tmp_path)
    assert source.length == 3
    assert source.truth is not None
    assert source.truth.tolist() == [[10, 20, 5, 6], [11, 21, 5, 6]]
    assert source.first_box == Box(10, 20, 5, 6)


def test_a_video_beside_images(tmp_path: Path) -> None:
    """It proves that a note tells of a video that is left out for images beside it."""
    folder = images(tmp_path / "a", ["poster.png"])
    (folder / "preview.gif").touch()
    assert open_source(folder).notes == ()
    video(folder / "v.avi")
    source = open_source(folder)
    assert source.length == 1
    assert source.notes == (
        f"left out {folder / 'v.avi'}, as images are beside it; name the file to open it",
    )


@pytest.mark.parametrize(
    ("names", "kept"),
    [
        (["1.png", "1.jpg", "2.png", "2.jpg"], ["1.png", "2.png"]),
        (["1.JPG", "1.png", "2.JPG", "10.JPG"], ["1.JPG", "2.JPG", "10.JPG"]),
        (["1.jpg", "1.webp"], ["1.jpg"]),
    ],
)
def test_images_in_two_formats(tmp_path: Path, names: list[str], kept: list[str]) -> None:
    """It proves that an image that is there in two formats is one frame, and that a note tells."""
    folder = images(tmp_path / "a", names)
    source = open_source(folder)
    assert [path.name for path in source.channels["color"].paths] == kept
    left_out = min(set(names) - set(kept))
    assert source.notes == (
        f"left out {folder / left_out} and others, as images of these names are there in another format",
    )


def test_a_video_with_truth(tmp_path: Path) -> None:
    """It proves that a folder with one video and a truth file is a sequence; its first box may be unknown."""
    video(tmp_path / "video.avi")
    (tmp_path / "groundtruth_rect.txt").write_text("0,0,0,0\n12,22,5,6\n")
    source = open_source(tmp_path)
    assert len(levels(source)) == 6
    assert source.truth is not None
    assert source.first_box is None


def test_vot_sequences(tmp_path: Path) -> None:
    """It proves that VOT's sequence file gives the color channel and the frame rate."""
    images(tmp_path / "color", ["00000001.png", "00000002.png"])
    images(tmp_path / "depth", ["00000001.png"])
    (tmp_path / "sequence").write_text("fps=4\nchannel.default=color\nchannels.color=color/%08d.png\n")
    (tmp_path / "groundtruth.txt").write_text("10,20,5,6\n")
    source = open_source(tmp_path)
    assert (source.fps, source.length, source.first_box) == (4.0, 2, Box(10, 20, 5, 6))
    assert levels(source) == [10, 20]


def test_vot_reads_what_its_pattern_names(tmp_path: Path) -> None:
    """It proves that of a channel's folder only the images of its pattern come, in the order of their
    numbers.
    """
    folder = images(tmp_path / "c", ["x_00000002.png", "x_00000010.png"])
    images(folder, ["thumbnail.png", "00000001.png", "x_00000001.jpg"])
    (tmp_path / "sequence").write_text("channels.color=c/x_%08d.png\n")
    assert levels(open_source(tmp_path)) == [10, 20]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_byte_order_mark_in_vots_file(tmp_path: Path, encoding: str) -> None:
    """It proves that the first key counts where Windows' editor or PowerShell has written the file."""
    images(tmp_path / "color", ["00000001.png"])
    (tmp_path / "sequence").write_text("channels.color=color/%08d.png\nfps=4\n", encoding=encoding)
    assert levels(open_source(tmp_path)) == [10]


def test_fps_times_images_that_have_no_times(tmp_path: Path) -> None:
    """It proves that the frame rate is 30 or the one that is given, for images alone, OTB's, and VOT's that
    don't tell it, and that the timestamps follow from it.
    """
    alone = images(tmp_path / "alone", ["1.png", "2.png", "3.png"])
    otb = images(tmp_path / "otb" / "img", ["1.png", "2.png", "3.png"]).parent
    vot = images(tmp_path / "vot" / "color", ["1.png", "2.png", "3.png"]).parent
    (vot / "sequence").write_text("fps=0\nchannels.color=color/%08d.png\n")
    for folder in (alone, otb, vot):
        for given, fps in ((None, 30.0), (4.0, 4.0), (0.5, 0.5), (1000, 1000.0)):
            source = open_source(folder, fps=given)
            assert source.fps == fps
            expected = pytest.approx([0, 1 / fps, 2 / fps])
            assert [frame.timestamp for frame in source] == expected
            assert [frame.timestamp for frame in source] == expected  # once more from the start


def test_fps_beside_times_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a frame rate for what has its own is an error that says which: a video, VOT's, a
    camera.
    """
    folder = images(tmp_path / "vot" / "color", ["1.png"]).parent
    (folder / "sequence").write_text("fps=25\nchannels.color=color/%08d.png\n")
    monkeypatch.setattr(cv2, "VideoCapture", GrayCamera)
    with pytest.raises(ValueError, match=r"^fps=15: expected with images without times, but camera 3"):
        open_source("3", fps=15)
    monkeypatch.undo()
    for place, own in ((video(tmp_path / "v.avi", fps=12.5), "v has its own, 12.5"), (folder, "vot .* 25")):
        with pytest.raises(ValueError, match=f"^fps=15: .*, but {own} frames per second; leave it out$"):
            open_source(place, fps=15)


@pytest.mark.parametrize(
    ("fps", "error", "message"),
    [
        (0, ValueError, "expected frames per second above 0, got 0"),
        (-5.0, ValueError, "expected frames per second above 0, got -5.0"),
        (float("nan"), ValueError, "expected a finite number"),
        (float("inf"), ValueError, "expected a finite number"),
        (1001, ValueError, "expected at most 1000 frames per second, got 1001"),
        ("30", TypeError, "expected a number, frames per second, got '30'"),
    ],
)
def test_bad_fps_is_named(tmp_path: Path, fps: Any, error: type[Exception], message: str) -> None:
    """It proves that what can't be a frame rate is an error that names it."""
    with pytest.raises(error, match=f"^fps: {message}"):
        open_source(images(tmp_path, ["1.png"]), fps=fps)


def test_real_sequences(data: Path) -> None:
    """It proves that every real color sequence opens, with as many frames as its description says."""
    lengths = {"Couple": 140, "Crossing": 120, "David": 471, "FaceOcc2": 812, "Football1": 81, "Girl": 500}
    for name, length in lengths.items():
        source = open_source(data / "color" / name)
        assert source.first_box is not None
        if source.length is not None:
            assert source.length == length
        assert source.truth is not None
        assert len(source.truth) == (74 if name == "Football1" else length)
    assert len(levels(open_source(data / "color" / "FaceOcc2"))) == 812


class GrayCamera:
    """A cv2.VideoCapture that gives gray frames."""

    def __init__(self, _number: int) -> None:
        pass

    def isOpened(self) -> bool:  # noqa: N802 (as cv2 names it)
        return True

    def get(self, _property: int) -> float:
        return 0.0

    def read(self) -> tuple[bool, object]:
        time.sleep(0.01)
        return True, gray(10)

    def release(self) -> None:
        pass


def text_file(folder: Path) -> Path:
    """A text that is called a video."""
    (folder / "v.mp4").write_text("this is no video")
    return folder / "v.mp4"


def empty_file(folder: Path) -> Path:
    """A file of no bytes that is called a video."""
    (folder / "v.mp4").touch()
    return folder / "v.mp4"


def video_without_frames(folder: Path) -> Path:
    """A video cut off behind its header."""
    path = video(folder / "v.avi")
    path.write_bytes(path.read_bytes().split(b"movi")[0] + b"movi")
    return path


def damaged_image(folder: Path) -> Path:
    """A folder whose second image is cut off."""
    images(folder, ["1.png", "2.png"])
    (folder / "2.png").write_bytes((folder / "2.png").read_bytes()[:20])
    return folder


def two_videos(folder: Path) -> Path:
    """A folder that leaves the choice."""
    video(folder / "a.avi")
    video(folder / "b.avi")
    return folder


def vot_without_images(folder: Path) -> Path:
    """A VOT folder whose color channel is empty."""
    (folder / "color").mkdir()
    (folder / "sequence").write_text("channels.color=color/%08d.jpg\n")
    return folder


def vot_without_color(folder: Path) -> Path:
    """A VOT folder of another channel."""
    (folder / "sequence").write_text("channels.ir=ir/%08d.jpg\n")
    return folder


def folder_of_sequences(folder: Path) -> Path:
    """A folder of sequences, and of notes."""
    (folder / "notes").mkdir()
    images(folder / "one" / "img", ["1.png"])
    return folder


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda folder: folder / "nowhere", "nowhere: there is no such file or folder$"),
        (lambda folder: folder / "*.jpg", r"\.jpg: there is no .*; give the folder of the images, .+\w$"),
        (lambda folder: folder / "%05d.jpg", r"d\.jpg: there is no .*; give the folder of the images, "),
        (
            lambda folder: folder,
            "expected a folder of images or a sequence, found neither images nor a video$",
        ),
        (
            folder_of_sequences,
            r"found neither images nor a video; name a folder in it, such as .*one$",
        ),
        (lambda folder: images(folder, ["1.png"]) / "1.png", "1.png: .* one picture; give its folder"),
        (text_file, "v.mp4: expected a video, this file can't be opened as one"),
        (empty_file, "v.mp4: expected a video, this file can't be opened as one"),
        (video_without_frames, "v.avi: expected a video, this file (can't be opened|has no frame)"),
        (damaged_image, "2.png: expected an image, this file can't be read as one"),
        (two_videos, "found 2 videos; name one of them"),
        (vot_without_images, "color: expected the images of the color channel, found none"),
        (vot_without_color, "sequence: expected channels.color=color/%08d.jpg, got ''"),
    ],
)
def test_bad_inputs_are_named(tmp_path: Path, make: Callable[[Path], Path], message: str) -> None:
    """It proves that each unusable input is an error that names the file and says what is wrong."""
    with pytest.raises((ValueError, OSError), match=message):
        levels(open_source(make(tmp_path)))


def test_a_hint_looks_one_folder_deep(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the error of a folder without images doesn't search all that is below, as of a disk."""
    deep = tmp_path / "a" / "b" / "c"
    deep.mkdir(parents=True)
    looked: list[Path] = []
    whole = Path.iterdir
    monkeypatch.setattr(Path, "iterdir", lambda path: looked.append(path) or whole(path))
    with pytest.raises(ValueError, match=r"found neither images nor a video$"):
        open_source(tmp_path)
    assert set(looked) == {tmp_path, tmp_path / "a"}


@pytest.mark.parametrize("suffix", [".webp", ".png", ".tif"])
def test_an_animation_in_an_image_file_is_told(tmp_path: Path, suffix: str) -> None:
    """It proves that several pictures in one file aren't called one picture, as one alone is."""
    image = pytest.importorskip("PIL.Image")
    pictures = [image.fromarray(np.full((48, 64, 3), 20 * level, np.uint8)) for level in range(4)]
    path = tmp_path / f"x{suffix}"
    pictures[0].save(path, save_all=True, append_images=pictures[1:])
    with pytest.raises(ValueError, match=rf"x{suffix}: .* several pictures in one .* 8-bit images"):
        open_source(path)
    pictures[0].save(path)
    with pytest.raises(ValueError, match=rf"x{suffix}: .* one picture; give its folder"):
        open_source(path)


@pytest.mark.parametrize("option", ["place", "right", "depth"])
def test_a_local_files_url_is_told_with_its_path(tmp_path: Path, option: str) -> None:
    """A URL as file managers copy it is told with the path to give, if there is such a file."""
    own = video(tmp_path / "my video.avi")
    url = own.as_uri()
    assert url.endswith("/my%20video.avi")
    told = rf"^file:/.*/my%20video\.avi: expected a path, got a URL; give {re.escape(str(own))}$"
    with pytest.raises(FileNotFoundError, match=told):
        open_source(**{"place": own, option: url})
    with pytest.raises(FileNotFoundError, match=r"^file:/.*x\.avi: expected a path, got a URL$"):
        open_source(**{"place": own, option: url.replace("my%20video", "x")})


def test_a_text_is_no_video(tmp_path: Path) -> None:
    """It proves that a file of true boxes isn't shown as FFmpeg shows texts: as a video of its letters."""
    (tmp_path / "boxes.txt").write_text("1,2,3,4\n" * 100)
    with pytest.raises(ValueError, match=r"boxes\.txt: expected a video or a folder, got a text"):
        open_source(tmp_path / "boxes.txt")


@pytest.mark.parametrize("place", [None, True, 1.5, ["a.mp4", "b.mp4"], np.zeros((2, 2))])
def test_what_is_no_place_is_told(place: Any) -> None:
    """It proves that the argument is named, whatever it is."""
    with pytest.raises(TypeError, match="place: expected a path, a URL or a camera's number"):
        open_source(place)


@pytest.mark.parametrize("right", [True, 1.5, ["a.mp4"]])
def test_what_is_no_right_place_is_told(tmp_path: Path, right: Any) -> None:
    """It proves that the argument is named, whatever it is."""
    with pytest.raises(TypeError, match="right: expected a path, a URL or a camera's number"):
        open_source(video(tmp_path / "v.avi"), right=right)


def test_two_cameras_by_their_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the right camera may be a whole number as well."""
    opened: list[int] = []
    monkeypatch.setattr(cv2, "VideoCapture", lambda number: opened.append(number) or GrayCamera(number))
    source = open_source(0, right=1)
    assert (list(source.channels), source.format) == (["color", "right"], "stereo pair")
    assert opened == [0, 1]
    for stream in source.channels.values():
        stream.joint.close()  # type: ignore[attr-defined]


ELSEWHERE = ["7", "/dev/video7", "rtsp://me:word@host/x", "realsense:", "oak:", "https://me:word@host/a.mp4"]


@pytest.mark.parametrize("place", ELSEWHERE)
def test_topics_and_targets_of_no_folder(place: str) -> None:
    """It proves that cameras and URLs refuse topics and a target before they are opened, without telling a
    password.
    """
    with pytest.raises(ValueError, match=r"^topics: expected with a recording .*; leave it out$") as told:
        open_source(place, topics={"color": "/a"})
    assert "word" not in str(told.value)
    with pytest.raises(
        ValueError, match=r": expected no target, as it has only one, got 'Car 1'; leave it out$"
    ) as told:
        open_source(place, target="Car 1")
    assert "word" not in str(told.value)


@pytest.mark.parametrize("place", ELSEWHERE[:-1])
def test_live_devices_tell_their_own_unit(place: str) -> None:
    """It proves that a camera refuses a scale of depth before it is opened."""
    with pytest.raises(
        ValueError, match=r"^depth_scale: expected with recorded depth, got .*; leave it out$"
    ):
        open_source(place, depth_scale=0.001)


def test_passwords_stay_out_of_errors(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an error about an option names a URL without its password."""
    monkeypatch.setattr(cv2, "VideoCapture", GrayCamera)
    with pytest.raises(ValueError, match=r"^https://host/a\.mp4: expected depth images where depth_scale"):
        open_source("https://me:p@ss@host/a.mp4", depth_scale=0.001)


def test_a_file_in_a_network_is_named_without_its_password() -> None:
    """It proves the same for one that can't be opened, as which its address may be wrong."""
    told = r"^http://127\.0\.0\.1:9/a\.mp4: expected a video, none can be opened; is the address right\?$"
    with pytest.raises(ValueError, match=told):
        open_source("http://me:p@ss@127.0.0.1:9/a.mp4")


def test_a_number_is_a_cameras(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a whole number is taken as cv2 takes it, and a folder's name as the folder's."""
    with pytest.raises(OSError, match="9999"):
        open_source(9999)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "9999").mkdir()
    cv2.imwrite("9999/1.png", np.zeros((4, 6, 3), np.uint8))
    assert open_source("9999").size == (6, 4)
    with pytest.raises(OSError, match="9999"):
        open_source(9999)
