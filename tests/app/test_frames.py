# SPDX-License-Identifier: MIT
"""Random access gives the frames that reading from the start gives, whatever the container and the codec."""

import struct
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue.app.frames import RecordedFrames
from tricue.app.seekable_video import SeekableVideo, read_index
from tricue.data.open_source import open_source
from tricue.data.streams import Video
from tricue.data.summary import compute_rate
from tricue.draw.video import OverlayWriter
from tricue.errors import one_line

from tests.app.conftest import FRAMES, HEIGHT, WIDTH, moving, write_video

KINDS = {
    "b-frames.mp4": ("libx264", {"g": "12", "bf": "3"}),
    "open-gop.mp4": ("libx264", {"g": "12", "bf": "3", "x264-params": "open-gop=1:scenecut=0"}),
    "one-key.mp4": ("libx264", {"g": "250"}),
    "b-frames.mkv": ("libx264", {"g": "12", "bf": "2"}),
    "b-frames.ts": ("libx264", {"g": "12", "bf": "2"}),
    "b-frames.avi": ("libx264", {"g": "12", "bf": "2"}),
    "bare.h264": ("libx264", {"g": "12", "bf": "2"}),
    "mpeg4.avi": ("mpeg4", {"g": "12", "bf": "2"}),
    "mpeg4.mp4": ("mpeg4", {"g": "12"}),
    "mpeg2.mpg": ("mpeg2video", {"g": "12", "bf": "2"}),
    "motion.avi": ("mjpeg", {"q": "3"}),
    "vp9.webm": ("libvpx-vp9", {"g": "20", "deadline": "realtime", "cpu-used": "8"}),
}


def test_video_in_a_network_is_refused(video: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One line says what to do."""
    source = open_source(video)
    monkeypatch.setattr(source.channels["color"], "place", "http://host/v.mp4")
    with pytest.raises(ValueError, match=r"http://host/v\.mp4: expected a file; download the video"):
        RecordedFrames(source)


@pytest.mark.parametrize("name", KINDS)
def test_any_order_is_the_order_of_reading(name: str, tmp_path: Path) -> None:
    """Each frame, sought in a random order and then backwards, is bit for bit the one OpenCV reads there."""
    codec, options = KINDS[name]
    path = write_video(tmp_path / name, moving(), codec, **options)
    expected = [image for _, image in Video(path)]
    video = SeekableVideo(path)
    assert video.length == len(expected) == FRAMES
    order = [*np.random.default_rng(0).permutation(FRAMES).tolist(), *reversed(range(FRAMES))]
    wrong = [at for at in order if not np.array_equal(next(video.at([at]))[1], expected[at])]
    assert not wrong


def test_times_are_those_of_the_file(tmp_path: Path) -> None:
    """A video of 25 frames a second has its frames 0.04 s apart, and says so."""
    video = SeekableVideo(write_video(tmp_path / "video.mp4", moving(10), fps=25))
    assert [time for time, _ in video.at(range(10))] == pytest.approx([at / 25 for at in range(10)])
    assert (video.fps, video.timed, video.size) == (25, True, (WIDTH, HEIGHT))


@pytest.mark.parametrize("name", ["video.mp4", "video.mkv"])
@pytest.mark.parametrize("times", [[0, 0.04, 1.04, 1.08, 3.0], [at / 30 for at in range(5)]])
def test_times_are_those_that_a_reader_gives(name: str, times: list[float], tmp_path: Path) -> None:
    """Frames have the same times and rate in the page as in tricue track and tricue info."""
    with OverlayWriter(tmp_path / name, 30.0) as writer:
        for image, time in zip(moving(5), times, strict=True):
            writer.write(image, time)
    source = open_source(tmp_path / name)
    recording = RecordedFrames(source)
    shown = [recording.seconds(at) for at in range(5)]
    assert shown == pytest.approx([frame.timestamp for frame in source], abs=1e-9)
    assert recording.fps == pytest.approx(compute_rate(source, 5)) == pytest.approx(4 / times[-1])


def test_index_knows_the_key_frames(video: Path) -> None:
    """Key frames every twelve frames are found without decoding."""
    index = read_index(video)
    assert index.keys.tolist() == [0, 12, 24, 36, 48]
    assert [index.key_before(at) for at in (0, 11, 12, 59)] == [0, 0, 12, 48]


def test_backwards_decodes_a_key_interval_at_once(video: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Going back through the whole video seeks once for each of its five key frames."""
    stream, sought = SeekableVideo(video), []
    seek = SeekableVideo._seek
    monkeypatch.setattr(SeekableVideo, "_seek", lambda self, key: (sought.append(key), seek(self, key)))
    for at in reversed(range(FRAMES)):
        next(stream.at([at]))
    assert sought == [48, 36, 24, 12, 0]


def test_few_frames_are_kept(video: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is kept of a long video is bounded, and going back through it is exact all the same."""
    monkeypatch.setattr("tricue.app.seekable_video.KEPT_BYTES", 5 * WIDTH * HEIGHT * 3 // 2)
    stream = SeekableVideo(video)
    expected = [image for _, image in Video(video)]
    for at in reversed(range(FRAMES)):
        assert np.array_equal(next(stream.at([at]))[1], expected[at])
        assert len(stream._kept) <= 5


def test_phone_video_is_upright(video: Path) -> None:
    """A video with the mark of a phone that was held upright is turned, as OpenCV turns it."""
    content = bytearray(video.read_bytes())
    matrix = content.index(b"tkhd") + 4 + 40
    content[matrix : matrix + 36] = struct.pack(
        ">9i", 0, 1 << 16, 0, -(1 << 16), 0, 0, HEIGHT << 16, 0, 1 << 30
    )
    video.write_bytes(content)
    expected = [image for _, image in Video(video)]
    assert expected[0].shape == (WIDTH, HEIGHT, 3)
    found = [image for _, image in SeekableVideo(video)]
    assert all(map(np.array_equal, found, expected))


def test_cut_off_video_ends_where_it_is_cut(tmp_path: Path) -> None:
    """A video of which a part is missing has the frames that are there."""
    path = write_video(tmp_path / "video.mkv", moving())
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    recording = RecordedFrames(open_source(path))
    assert 10 < recording.length < FRAMES
    numbers = [number for number, _ in recording.frames(0, recording.length)]
    assert numbers[:10] == list(range(10))


@pytest.mark.parametrize("content", [b"", b"no video at all" * 100])
def test_no_video_is_one_line(content: bytes, tmp_path: Path) -> None:
    """A file that is no video is named in an error of one line."""
    path = tmp_path / "video.mp4"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"video\.mp4: expected a video, this file can't be opened as one"):
        SeekableVideo(path)


def test_sound_alone_is_no_video(tmp_path: Path) -> None:
    """A file with sound alone is refused by name."""
    import av

    path = tmp_path / "sound.mp4"
    with av.open(str(path), "w") as file:
        stream: Any = file.add_stream("aac", rate=44100)
        frame = av.AudioFrame.from_ndarray(np.zeros((1, 1024), np.float32), format="fltp", layout="mono")
        frame.rate = 44100
        file.mux(stream.encode(frame))
        file.mux(stream.encode())
    with pytest.raises(ValueError, match="this file has no pictures"):
        SeekableVideo(path)


def test_unknown_codec_is_one_line(video: Path) -> None:
    """A video in a codec that nobody decodes says so and what to do."""
    content = video.read_bytes()
    video.write_bytes(content.replace(b"avc1", b"xyz9"))
    with pytest.raises(ValueError, match=r"there is no decoder for its codec; convert it to H\.264"):
        SeekableVideo(video)


def test_vanished_video_is_named(video: Path) -> None:
    """A file that goes away before it is read is named."""
    stream = SeekableVideo(video)
    video.unlink()
    with pytest.raises(FileNotFoundError) as caught:
        next(stream.at([3]))
    assert one_line(caught.value) == f"{video}: there is no such file"


def test_frame_beyond_the_end_is_refused(video: Path) -> None:
    """Numbers outside of the video are named."""
    with pytest.raises(ValueError, match="expected frame 0 to 59, got 60"):
        next(SeekableVideo(video).at([60]))


def test_backwards_time_runs_on(video: Path) -> None:
    """Trackers see rising times backwards, too: those of a mirrored recording."""
    recording = RecordedFrames(open_source(video))
    found = list(recording.frames(20, 10))
    assert [number for number, _ in found] == list(range(20, 10, -1))
    times = np.array([frame.timestamp for _, frame in found])
    assert np.allclose(np.diff(times), 1 / 30)
    assert times[0] == recording.seconds(20)


def test_folder_is_read_at_random(tmp_path: Path) -> None:
    """Images of a folder come in any order, with the times that --fps gives."""
    images = moving(6)
    for at, image in enumerate(images):
        cv2.imwrite(str(tmp_path / f"{at}.png"), image)
    recording = RecordedFrames(open_source(tmp_path, fps=10))
    assert (recording.length, recording.size, recording.seconds(3)) == (6, (WIDTH, HEIGHT), 0.3)
    for at in (4, 0, 5, 2):
        assert np.array_equal(recording.frame(at).color, images[at])


def test_image_of_another_size_is_refused(tmp_path: Path) -> None:
    """Boxes are in pixels of the first frame, which such an image doesn't have; the others are had."""
    for at, image in enumerate(moving(3)):
        half = cv2.resize(image, (WIDTH // 2, HEIGHT // 2))
        cv2.imwrite(str(tmp_path / f"{at}.png"), half if at == 1 else image)
    recording = RecordedFrames(open_source(tmp_path))
    with pytest.raises(ValueError, match="frame 1: expected the first frame's size 160x120, got 80x60 px"):
        recording.frame(1)
    assert [number for number, _ in recording.frames(0, 3)] == [0, 2]


def test_pair_of_videos_is_sought_together(video: Path, tmp_path: Path) -> None:
    """Both videos of a stereo pair are at the wanted frame."""
    right = write_video(tmp_path / "right.mp4", moving()[::-1])
    recording = RecordedFrames(open_source(video, right=right))
    frame = recording.frame(7)
    assert np.array_equal(frame.color, next(SeekableVideo(video).at([7]))[1])
    assert np.array_equal(frame.right, next(SeekableVideo(right).at([7]))[1])
    assert recording.again().frame(7).right is not None
