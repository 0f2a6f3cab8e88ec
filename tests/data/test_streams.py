# SPDX-License-Identifier: MIT
"""Times of videos' frames, and what is told of videos that end early."""

import os
import re
import warnings
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue.data.streams import FrameTimes, Images, Video, checked_fps, image_names

av: Any = pytest.importorskip("av")

PAUSES = [index / 30 + index // 10 for index in range(40)]
"""Of a recording at 30 frames/s that pauses for a second every ten frames, as screen recorders' do."""


def write(
    path: Path,
    times: Sequence[float],
    codec: str = "libx264",
    rate: Fraction = Fraction(30),
    unit: Fraction = Fraction(1, 1000),
    **options: str,
) -> Path:
    """A video of noise whose frames are shown at these times, seconds."""
    noise = np.random.default_rng(0).integers(0, 256, (len(times), 48, 64, 3), np.uint8)
    with av.open(str(path), "w") as file:
        stream = file.add_stream(codec, rate=rate)
        stream.width, stream.height, stream.options = 64, 48, options
        stream.pix_fmt = {"gif": "rgb8", "mjpeg": "yuvj420p"}.get(codec, "yuv420p")
        stream.codec_context.time_base = unit
        for time, picture in zip(times, noise, strict=True):
            frame = av.VideoFrame.from_ndarray(picture, format="bgr24")
            frame.pts, frame.time_base = round(time / unit), unit
            file.mux(stream.encode(frame))
        file.mux(stream.encode())
    return path


def times_of(path: Path) -> list[float]:
    """The times of all frames; a warning is an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return [time for time, _ in Video(path)]


@pytest.mark.parametrize(
    ("name", "codec", "unit"),
    [
        ("o.mkv", "libx264", Fraction(1, 1000)),
        ("o.webm", "libvpx-vp9", Fraction(1, 1000)),
        ("o.mp4", "libx264", Fraction(1, 90000)),
        ("o.gif", "gif", Fraction(1, 100)),
    ],
)
def test_frames_have_their_own_times(tmp_path: Path, name: str, codec: str, unit: Fraction) -> None:
    """It proves that at a variable rate times are the container's, however frames are read, and that an
    intact video isn't taken for cut off.
    """
    path = write(tmp_path / name, PAUSES, codec, unit=unit)
    found = times_of(path)
    assert found == pytest.approx(PAUSES, abs=0.51 * float(unit))
    assert [time for time, _ in Video(path).at([0, 9, 10, 39])] == [found[index] for index in (0, 9, 10, 39)]
    assert (Video(path).times, Video(path).count()) == (found, 40)


@pytest.mark.parametrize(
    ("name", "codec", "rate", "options"),
    [
        ("o.mp4", "libx264", Fraction(30000, 1001), {"bf": "2"}),
        ("o.mkv", "libx264", Fraction(30000, 1001), {"bf": "2"}),
        ("o.mkv", "libx264", Fraction(120), {"bf": "0"}),
        ("o.webm", "libvpx-vp9", Fraction(25), {}),
        ("o.flv", "libx264", Fraction(25), {"bf": "2"}),
        ("o.ts", "libx264", Fraction(25), {"bf": "2"}),
        ("o.avi", "mjpeg", Fraction(10), {}),
        ("o.avi", "libx264", Fraction(25), {"bf": "2"}),  # no times; FFmpeg guesses some
        ("o.h264", "libx264", Fraction(25), {}),  # no container
    ],
)
def test_a_constant_rate_is_exact(
    tmp_path: Path, name: str, codec: str, rate: Fraction, options: dict[str, str]
) -> None:
    """It proves that times are number / fps where the container's differ by their rounding alone, with
    B-frames, too, and where it has none.
    """
    times = [float(index / rate) for index in range(40)]
    path = write(tmp_path / name, times, codec, rate, 1 / rate, **options)
    assert Video(path).fps == pytest.approx(float(rate))
    assert times_of(path) == [index / Video(path).fps for index in range(40)]


@pytest.mark.parametrize(
    ("told", "expected"),
    [
        ([0.0, 0.0, 0.0, 0.0], [0, 0.1, 0.2, 0.3]),
        ([0.5, 0.6, 0.7, 0.8], [0, 0.1, 0.2, 0.3]),
        ([0.0, 0.1004, 0.1996, 0.3], [0, 0.1, 0.2, 0.3]),
        ([0.0, 0.1, 0.5, 0.5, 0.4, 0.8], [0, 0.1, 0.5, 0.6, 0.7, 0.8]),
        ([0.0, 0.1, 0.2, 0.0, 0.0], [0, 0.1, 0.2, 0.3, 0.4]),
        ([0.2, 0.0, 0.0, 0.0], [0, 0.1, 0.2, 0.3]),
        ([0.0, 0.2003, 0.2009], [0, 0.2003, 0.2009]),
        ([0.0, 0.0, 0.1003, 0.2002, 0.3], [0, 0.1, 0.2, 0.3, 0.4]),
    ],
)
def test_times_rise(told: list[float], expected: list[float]) -> None:
    """It proves that a frame's time is the container's after the one before, and else follows at the rate."""
    times = FrameTimes(10.0)
    assert [times.add(each) for each in told] == pytest.approx(expected, abs=1e-12)


def test_a_rate_that_nobody_stated(tmp_path: Path) -> None:
    """It proves that a unit of time isn't taken for a frame rate, as in what browsers record."""
    path = write(tmp_path / "o.webm", PAUSES, "libvpx-vp9", Fraction(1000))
    assert cv2.VideoCapture(str(path)).get(cv2.CAP_PROP_FPS) in (1000, 30)  # 30: cv2 4.8
    assert Video(path).fps == pytest.approx(30, rel=0.02)
    assert checked_fps(120.0, [0, 1 / 120, 2 / 120]) == 120
    assert checked_fps(25.0, [0, 1, 2]) == 25
    assert checked_fps(None, [0, 0.1, 0.2]) == pytest.approx(10)
    assert checked_fps(None, [0, 0, 0]) is checked_fps(None, []) is None


@pytest.mark.parametrize(
    ("times", "told"),
    [
        ([index / 30 for index in range(80)], r"only \d+ of its 80 frames"),
        ([index / 30 + index // 10 for index in range(80)], r"only \d\.\d\d of its 9\.67 seconds"),
    ],
)
def test_a_video_that_is_cut_off_is_told(tmp_path: Path, times: list[float], told: str) -> None:
    """It proves that what is missing is told in frames, or at a variable rate in seconds."""
    whole = write(tmp_path / "whole.mkv", times, bf="0", g="5")
    assert len(times_of(whole)) == 80
    content = whole.read_bytes()
    (tmp_path / "o.mkv").write_bytes(content[: len(content) // 2])
    with pytest.warns(UserWarning, match=rf"o\.mkv: {told} can be decoded; is it cut off\?"):
        assert 20 < len(list(Video(tmp_path / "o.mkv"))) < 60


@pytest.mark.parametrize(
    ("damaged", "told"),
    [
        ([12], "the damaged frame 12"),
        ([12, 13, 20], "3 damaged frames, the first of them frame 12"),
        ([39], ""),
    ],
)
def test_a_damaged_frame_is_the_one_before(tmp_path: Path, damaged: list[int], told: str) -> None:
    """It proves that a video goes on behind damaged frames, that all keep their numbers and times, however
    they are read, and that it's told; damage at its end ends it.
    """
    path = write(tmp_path / "o.avi", [index / 30 for index in range(40)], "mjpeg", unit=Fraction(1, 30))
    intact, content = list(Video(path)), bytearray(path.read_bytes())
    starts = [found.start() for found in re.finditer(b"\xff\xd8\xff", content)]
    for index in damaged:  # the JPEG image, not the container around it
        size = content.index(b"\xff\xd9", starts[index]) - starts[index]
        content[starts[index] : starts[index] + size] = bytes(size)
    path.write_bytes(content)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = list(Video(path))
    assert [str(each.message) for each in caught] == (
        [f"{path}: took the frame before in place of {told}"] if told else []
    )
    assert len(found) == (40 if told else 39)
    for index, (seconds, picture) in enumerate(found):
        whole = max(set(range(index + 1)) - set(damaged))
        assert seconds == intact[index][0]
        assert np.array_equal(picture, intact[whole][1])
    assert list(Video(path).times) == [seconds for seconds, _ in found]
    wanted = [3, 12, 13, 14, 20, 38]
    for index, (seconds, picture) in zip(wanted, Video(path).at(wanted), strict=True):
        assert seconds == found[index][0]
        assert np.array_equal(picture, found[index][1])


def test_sound_that_goes_on_is_no_cut(tmp_path: Path) -> None:
    """It proves that a file whose sound is longer than its video is intact, and no more so if it is cut."""
    with av.open(str(tmp_path / "o.mkv"), "w") as file:
        video, sound = file.add_stream("mjpeg", rate=10), file.add_stream("pcm_s16le", rate=8000)
        video.width, video.height, video.pix_fmt = 64, 48, "yuvj420p"
        for second in range(6):
            for _ in range(10 if second < 3 else 0):
                picture = np.full((48, 64, 3), 20 * second, np.uint8)
                file.mux(video.encode(av.VideoFrame.from_ndarray(picture, format="bgr24")))
            frame = av.AudioFrame.from_ndarray(np.zeros((1, 8000), np.int16), format="s16", layout="mono")
            frame.rate, frame.pts = 8000, 8000 * second
            file.mux(sound.encode(frame))
        file.mux(video.encode())
        file.mux(sound.encode())
    assert cv2.VideoCapture(str(tmp_path / "o.mkv")).get(cv2.CAP_PROP_FRAME_COUNT) == 60
    assert len(times_of(tmp_path / "o.mkv")) == 30
    content = (tmp_path / "o.mkv").read_bytes()
    (tmp_path / "o.mkv").write_bytes(content[: len(content) // 2])
    with pytest.warns(UserWarning, match=r"of its 60 frames can be decoded; is it cut off\?"):
        assert len(list(Video(tmp_path / "o.mkv"))) >= 20


@pytest.mark.parametrize("name", ["2024-01-01T12:30:15.mp4", "file:x.mp4", "http:x.mp4"])
def test_a_colon_is_no_protocol(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a relative name with a colon is a file's, which messages call as it was given."""
    write(tmp_path / name, PAUSES[:5])
    monkeypatch.chdir(tmp_path)
    assert len(times_of(Path(name))) == 5
    (tmp_path / name).write_bytes(b"no video")
    with pytest.raises(ValueError, match=f"^{name}: expected a video"):
        Video(Path(name))


def test_a_folder_need_not_be_utf_8(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a relative name is opened wherever it is."""
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    folder.mkdir()
    write(tmp_path / "o.mp4", PAUSES[:5]).rename(folder / "o.mp4")
    monkeypatch.chdir(folder)
    assert len(times_of(Path("o.mp4"))) == 5


def test_names_of_images() -> None:
    """It proves that images have their files' names, those of color before depth, and videos none."""
    color, depth = (Images([Path(f"{name}/{index}.png") for index in (1, 2)]) for name in ("c", "d"))
    assert image_names({"depth": Images([Path("d/7.png")]), "color": color}) == ["1.png", "2.png"]
    assert image_names({"depth": depth}) == ["1.png", "2.png"]
    assert image_names({}) == ()


def test_the_representation_of_many_images_is_a_line():
    """It proves that print(source) doesn't list each of a folder's files."""
    paths = [Path(f"frames/{number:04}.png") for number in range(1000)]
    assert repr(Images(paths, rate=12.5)) == (
        f"Images(1000 files, {str(paths[0])!r} to {str(paths[-1])!r}, fps=12.5)"
    )
    assert repr(Images([])) == "Images(0 files, fps=30)"
