# SPDX-License-Identifier: MIT
import os
import signal
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.doctor.install import install_extra
from tricue.draw.video import OverlayWriter, count_frames
from tricue.draw.video_encoders import MAX_STILL, OpenCVEncoder, PyAVEncoder

KILLED = """
import os, signal, sys
import numpy as np
from tricue.draw.video import OverlayWriter
from tricue.draw.video_encoders import PyAVEncoder
PyAVEncoder.available = staticmethod(lambda: sys.argv[2] == "pyav")
writer = OverlayWriter(sys.argv[1], 10.0)
noise = np.random.default_rng(0).integers(0, 256, (240, 320, 3), np.uint8)
for i in range(200):
    writer.write(np.roll(noise, i, 1))
os.kill(os.getpid(), signal.SIGKILL)
"""
FULL = """
import sys
import numpy as np
from tricue.draw.video import OverlayWriter
with OverlayWriter(sys.argv[1], 10.0) as writer:
    for _ in range(100):
        writer.write(np.zeros((240, 320, 3), np.uint8))
"""


@pytest.fixture(params=["pyav", "opencv"])
def encoder(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """With and without PyAV."""
    found: str = request.param
    if found == "pyav":
        pytest.importorskip("av")
    monkeypatch.setattr(PyAVEncoder, "available", staticmethod(lambda: found == "pyav"))
    return found


def _write_seven(writer: OverlayWriter, picture: NDArray[np.uint8]) -> None:
    with writer:
        for _ in range(7):
            writer.write(picture)
        raise KeyboardInterrupt


def decoded(path: Path) -> list[NDArray[np.uint8]]:
    """All pictures of a video."""
    capture = cv2.VideoCapture(str(path))
    frames = []
    while (answer := capture.read())[0]:
        frames.append(answer[1])
    return frames  # type: ignore[return-value]


@pytest.mark.parametrize(
    ("name", "width"), [("o.mp4", 64), ("o.avi", 64), ("new/o.MP4", 65), ("o.webm", 65), ("o.mkv", 64)]
)
def test_videos_are_whole(tmp_path: Path, name: str, width: int, encoder: str) -> None:
    """It proves that what was written can be read again, every frame of it, after an interruption too."""
    picture = np.full((47, width, 3), 90, np.uint8)
    writer = OverlayWriter(tmp_path / name, 25.0)
    with pytest.raises(KeyboardInterrupt):
        _write_seven(writer, picture)
    frames = decoded(writer.path)
    assert len(frames) == count_frames(writer.path) == 7
    assert frames[0].shape == (48, 2 * ((width + 1) // 2), 3)
    assert np.mean(frames) == pytest.approx(90, abs=4)


@pytest.mark.parametrize("name", ["o.mp4", "o.avi"])
def test_another_size_is_scaled(tmp_path: Path, name: str, encoder: str) -> None:
    """As of a folder of images of several sizes: no frame is left out."""
    with OverlayWriter(tmp_path / name, 25.0) as writer:
        for height, width in ((48, 64), (101, 201), (20, 30)):
            writer.write(np.full((height, width, 3), 90, np.uint8))
    assert [frame.shape for frame in decoded(writer.path)] == [(48, 64, 3)] * 3


@pytest.mark.parametrize("picture", [np.zeros((48, 64), np.uint8), np.zeros((48, 64, 3))])
def test_another_kind_of_image_is_refused(tmp_path: Path, picture: NDArray[np.uint8], encoder: str) -> None:
    """It is named, not the disk or the codec."""
    with (
        OverlayWriter(tmp_path / "o.webm", 25.0) as writer,
        pytest.raises(ValueError, match=r"^picture: expected BGR \(H, W, 3\) uint8, got"),
    ):
        writer.write(picture)


def test_an_mp4_is_h264(tmp_path: Path) -> None:
    """It proves that browsers can play the default: H.264 in 4:2:0, at the rate asked for."""
    av = pytest.importorskip("av")
    with OverlayWriter(tmp_path / "o.mp4", 30000 / 1001) as writer:
        writer.write(np.zeros((48, 64, 3), np.uint8))
    with av.open(str(writer.path)) as file:
        stream = file.streams.video[0]
        assert (stream.codec_context.name, stream.codec_context.pix_fmt) == ("h264", "yuv420p")
        assert float(stream.average_rate) == pytest.approx(30000 / 1001)
    assert (writer.about, writer.note) == (str(tmp_path / "o.mp4"), "")


def test_without_pyav_a_webm_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """It proves that what browsers can't play is not written, that this is told, that no empty .mp4 stays,
    and that another video is not overwritten.
    """
    (tmp_path / "o.webm").write_bytes(b"another video")
    monkeypatch.setattr(PyAVEncoder, "available", staticmethod(lambda: False))
    with OverlayWriter(tmp_path / "o.mp4", 25.0) as writer:
        writer.write(np.zeros((48, 64, 3), np.uint8))
    assert writer.path == tmp_path / "o.mp4.webm"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["o.mp4.webm", "o.webm"]
    assert (tmp_path / "o.webm").read_bytes() == b"another video"
    assert writer.path.read_bytes()[:4] == b"\x1a\x45\xdf\xa3"  # EBML, of which WebM is made
    assert writer.about.endswith(f"o.mp4.webm (VP8, as H.264 needs PyAV: {install_extra('video')})")
    assert capfd.readouterr().err == ""


def test_a_missing_codec_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an OpenCV without the encoder is an error that says what to install."""
    monkeypatch.setattr(cv2.VideoWriter, "isOpened", lambda _: False)
    with pytest.raises(OSError, match=r"o\.avi: this OpenCV can't write it; PyAV can: .* -m pip install"):
        OpenCVEncoder(tmp_path / "o.avi", 25.0, (64, 48))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["o.mp4", "o.mkv", "o.webm"])
def test_what_was_written_before_a_kill_plays(tmp_path: Path, name: str, encoder: str) -> None:
    """It proves that of 20 seconds at least 15 can be played after kill -9."""
    path = tmp_path / name
    done = subprocess.run([sys.executable, "-c", KILLED, str(path), encoder], check=False)
    assert done.returncode == -signal.SIGKILL
    assert len(decoded(path if encoder == "pyav" or name == "o.webm" else tmp_path / f"{name}.webm")) >= 150


def _write_noise(encoder: PyAVEncoder, count: int) -> None:
    for picture in np.random.default_rng(0).integers(0, 256, (count, 48, 64, 3), np.uint8):
        encoder.write(picture)


def test_a_full_disk_names_the_file(tmp_path: Path) -> None:
    """It proves that an error of PyAV's file is an OSError with the file's name."""
    pytest.importorskip("av")
    path = tmp_path / "o.mp4"
    path.symlink_to("/dev/full")
    encoder = PyAVEncoder(path, 5.0, (64, 48))
    with pytest.raises(OSError, match=r"No space left on device: .*o\.mp4"):
        _write_noise(encoder, 100)


@pytest.mark.parametrize("name", ["o.mp4", "o.mkv", "o.webm"])
def test_a_full_disk_ends_no_process(tmp_path: Path, name: str) -> None:
    """It proves that a video without room for its first bytes is an error, also when it is closed."""
    pytest.importorskip("av")
    (tmp_path / name).symlink_to("/dev/full")
    done = subprocess.run(
        [sys.executable, "-c", FULL, str(tmp_path / name)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert f"No space left on device: '{tmp_path / name}'" in done.stderr.splitlines()[-1]


def test_what_the_encoder_refuses_names_the_file(tmp_path: Path) -> None:
    """It proves that an error of the library behind PyAV is an OSError, too, here of a picture too wide."""
    pytest.importorskip("av")
    encoder = PyAVEncoder(tmp_path / "o.mp4", 5.0, (20_000, 20))
    with pytest.raises(OSError, match=r"o\.mp4: expected a video that the encoder can write, got: "):
        encoder.write(np.zeros((20, 20_000, 3), np.uint8))
    with pytest.raises(OSError, match=r"o\.mp4: "):
        encoder.close()


TIMES = [5.0, 5.04, 5.08, 6.5, 6.54, 9.0]
"""Of a recording that pauses twice, seconds."""


def _write_timed(writer: OverlayWriter, times: list[float]) -> list[float]:
    """Pictures that brighten by 40 each; how far the times in the file are from the first."""
    with writer:
        for index, time in enumerate(times):
            writer.write(np.full((48, 64, 3), 40 * index, np.uint8), time)
    capture, found = cv2.VideoCapture(str(writer.path)), []
    while capture.grab():
        found.append(capture.get(cv2.CAP_PROP_POS_MSEC) / 1000)
    return found


@pytest.mark.parametrize("name", ["o.mp4", "o.mkv", "o.webm"])
def test_frames_have_their_own_times(tmp_path: Path, name: str) -> None:
    """It proves that a video of a variable rate plays as long as the frames took, from 0 on."""
    av = pytest.importorskip("av")
    writer = OverlayWriter(tmp_path / name, 25.0)
    _write_timed(writer, TIMES)
    with av.open(str(writer.path)) as file:  # cv2 4.8 finds no times in Matroska
        found = [frame.time for frame in file.decode(video=0)]
    assert found == pytest.approx([time - TIMES[0] for time in TIMES], abs=0.0006)


def test_times_that_do_not_rise_are_written(tmp_path: Path) -> None:
    """It proves that a clock that stands or goes back loses no frame."""
    pytest.importorskip("av")
    writer = OverlayWriter(tmp_path / "o.mp4", 25.0)
    found = _write_timed(writer, [1.0, 1.0, 0.5, 1.2])
    assert found == pytest.approx([0, 0, 0, 0.2], abs=0.001)
    assert count_frames(writer.path) == 4


def test_a_clock_that_is_set_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The frames after it keep their intervals, and follow those before it by a frame."""
    pytest.importorskip("av")
    times = [100.0, 100.2, 100.4, 40.0, 40.2, 40.6]
    found = _write_timed(OverlayWriter(tmp_path / "o.mp4", 25.0), times)
    assert found == pytest.approx([0, 0.2, 0.4, 0.44, 0.64, 1.04], abs=0.001)
    monkeypatch.setattr(PyAVEncoder, "available", staticmethod(lambda: False))
    writer = OverlayWriter(tmp_path / "o.avi", 25.0)
    assert len(_write_timed(writer, times)) == 27  # 1.04 s, and the last one


@pytest.mark.parametrize("name", ["o.avi", "o.webm"])
def test_opencv_repeats_frames_until_the_next(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that a file of a constant rate plays as long, each frame at its time, none left out."""
    monkeypatch.setattr(PyAVEncoder, "available", staticmethod(lambda: False))
    writer = OverlayWriter(tmp_path / name, 25.0)
    assert len(_write_timed(writer, TIMES)) == count_frames(writer.path) == 101
    levels = [round(float(picture.mean()) / 40) for picture in decoded(writer.path)]
    begins = [levels.index(level) / 25 for level in range(len(TIMES))]
    assert begins == pytest.approx([time - TIMES[0] for time in TIMES], abs=0.021)
    fast = OverlayWriter(tmp_path / f"fast-{name}", 25.0)
    assert len(_write_timed(fast, [0.0, 0.01, 0.02, 0.03])) == 4


def test_opencv_shortens_a_long_pause(tmp_path: Path) -> None:
    """It proves that a gap of hours in a recording's clock doesn't fill the disk."""
    encoder = OpenCVEncoder(tmp_path / "o.avi", 5.0, (64, 48))
    for time in (0.0, 1e5, 1e5 + 1):
        encoder.write(np.zeros((48, 64, 3), np.uint8), time)
    encoder.close()
    assert encoder.written == 1 + int(MAX_STILL * 5) + 5 + 1


def test_a_key_frame_a_second(tmp_path: Path) -> None:
    """It proves that at a rate far below the stated one there is a key frame at least every second, too."""
    av = pytest.importorskip("av")
    writer = OverlayWriter(tmp_path / "o.mp4", 100.0)
    _write_timed(writer, [index / 2 for index in range(6)])
    with av.open(str(writer.path)) as file:
        keys = [frame.time for frame in file.decode(video=0) if frame.key_frame]
    assert keys == pytest.approx([0, 1, 2])


@pytest.mark.parametrize("name", ["o.mp4", "o.mkv", "o.webm"])
def test_a_video_begins_at_0(tmp_path: Path, name: str) -> None:
    """It proves that frames are shown at number / fps, as tables have them, also in the fragments of an .mp4
    that is cut off: B-frames would delay the first.
    """
    av = pytest.importorskip("av")
    encoder = PyAVEncoder(tmp_path / name, 10.0, (64, 48))
    _write_noise(encoder, 30)
    (tmp_path / "cut.mp4").write_bytes((tmp_path / name).read_bytes())
    encoder.close()
    for path in [tmp_path / name, tmp_path / "cut.mp4"][: 2 if name == "o.mp4" else 1]:
        with av.open(str(path)) as file:
            times = [frame.time for frame in file.decode(video=0)]
        assert len(times) > 5
        assert times == pytest.approx([index / 10 for index in range(len(times))], abs=0.0006)


def test_nothing_else_is_removed(tmp_path: Path) -> None:
    """It proves that an .mp4 is finished by no file of another's name, nor leaves any, and keeps its mode."""
    pytest.importorskip("av")
    (tmp_path / "o.mp4.part").write_bytes(b"another's")
    (tmp_path / "link.mp4").symlink_to("o.mp4")
    (tmp_path / "o.mp4").touch(0o640)
    _write_timed(OverlayWriter(tmp_path / "link.mp4", 25.0), TIMES)
    assert (tmp_path / "o.mp4.part").read_bytes() == b"another's"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["link.mp4", "o.mp4", "o.mp4.part"]
    assert (tmp_path / "link.mp4").is_symlink()
    assert (tmp_path / "o.mp4").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("name", ["2024-01-01T12:30:15.mp4", "a:b.avi", "file:x.webm", f"{'n' * 251}.mp4"])
def test_any_name_can_be_written(tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a colon in a relative name is no protocol, and that a name may be as long as any."""
    if name.endswith(".mp4"):
        pytest.importorskip("av")
    monkeypatch.chdir(tmp_path)
    with OverlayWriter(name, 25.0) as writer:
        writer.write(np.zeros((48, 64, 3), np.uint8))
    assert (writer.about, [path.name for path in tmp_path.iterdir()]) == (name, [name])
    assert count_frames(writer.path) == 1


@pytest.mark.parametrize("suffix", [".mp4", ".avi"])
def test_a_path_that_is_not_utf_8_is_refused(tmp_path: Path, suffix: str) -> None:
    """It proves that it is an error before anything is written; OpenCV would die of it."""
    name = os.fsdecode(b"o\xff") + suffix
    with pytest.raises(ValueError, match=r"o\\udcff.*: expected a video's path in UTF-8; choose another"):
        OverlayWriter(tmp_path / name, 25.0)
    assert not list(tmp_path.iterdir())


def test_an_unused_writer_touches_nothing(tmp_path: Path, encoder: str) -> None:
    """It proves that a writer that got no picture leaves what is there."""
    (tmp_path / "o.mp4").write_bytes(b"before")
    (tmp_path / "o.mp4.webm").write_bytes(b"before")
    with OverlayWriter(tmp_path / "o.mp4", 25.0):
        pass
    assert sorted(path.name for path in tmp_path.iterdir()) == ["o.mp4", "o.mp4.webm"]
    assert {path.read_bytes() for path in tmp_path.iterdir()} == {b"before"}


def test_an_unused_writer_leaves_nothing(tmp_path: Path) -> None:
    """It proves that a writer that got no picture leaves no empty file behind."""
    with OverlayWriter(tmp_path / "o.mp4", 25.0):
        pass
    assert not list(tmp_path.iterdir())


def test_bad_names_are_refused(tmp_path: Path) -> None:
    """It proves that an unknown kind of file, or a place that can't be written, is an error at once."""
    with pytest.raises(ValueError, match=r"o\.gif: expected a video file's name that ends in \.mp4, \.mkv"):
        OverlayWriter(tmp_path / "o.gif", 25.0)
    (tmp_path / "o.mp4").mkdir()
    (tmp_path / "o.mp4.webm").mkdir()
    with pytest.raises(OSError, match="directory"):
        OverlayWriter(tmp_path / "o.mp4", 25.0)
