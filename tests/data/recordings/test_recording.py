# SPDX-License-Identifier: MIT
import random
import sys
import tracemalloc
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import zstandard
from tricue import Frame, Intrinsics, StereoRig, open_source
from tricue.camera.registration import Reprojection
from tricue.cli.program import main
from tricue.data.joint import JointStream
from tricue.data.source import Source
from tricue.data.summary import summarize_depth

from tests.data.recordings.test_containers import rewrite
from tests.data.recordings.written import (
    SECOND,
    START,
    Sent,
    color,
    compressed,
    depth,
    info,
    jpeg,
    png,
    pose,
    raw,
    transform,
    walk,
    write_bag1,
    write_bag2,
    write_json,
    write_mcap,
)

Writer = Callable[[Path, Sequence[Sent]], Path]
COLOR, DEPTH = "/camera/color/image_raw", "/camera/depth/image_rect_raw"


def bag1(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 1 bag."""
    return write_bag1(folder / "a.bag", sent)


def sqlite(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 2 folder with a database."""
    return write_bag2(folder / "b", sent)


def ros2_mcap(folder: Path, sent: Sequence[Sent]) -> Path:
    """A ROS 2 folder with an MCAP file."""
    return write_bag2(folder / "c", sent, "mcap")


def mcap(folder: Path, sent: Sequence[Sent]) -> Path:
    """An MCAP file alone."""
    return write_mcap(folder / "d.mcap", sent)


WRITERS = [bag1, sqlite, ros2_mcap, mcap]


def blues(frames: Iterable[Frame]) -> list[int]:
    """The blue of each frame's color."""
    return [int(frame.color[0, 0, 0]) for frame in frames if frame.color is not None]


def meters(source: Source) -> list[float]:
    """The depth in the middle of each frame."""
    return [float(frame.depth[12, 16]) for frame in source if frame.depth is not None]


@pytest.mark.parametrize("write", WRITERS)
def test_color_and_depth(tmp_path: Path, write: Writer) -> None:
    """It proves that every format gives the same frames: images, meters, times, and the camera."""
    source = open_source(write(tmp_path, walk(5, lag=SECOND // 100)))
    frames = list(source)
    assert [frame.channels for frame in frames] == [("color", "depth")] * 5
    assert blues(source) == [10, 20, 30, 40, 50]
    assert meters(source) == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])
    assert [frame.timestamp for frame in frames] == pytest.approx(
        [1.7e9 + index / 30 for index in range(5)], abs=1e-6
    )
    assert np.isnan(frames[0].depth[0, 0])  # type: ignore[index]
    assert source.fps == pytest.approx(30)
    assert source.camera == Intrinsics(30, 30, 15.5, 11.5, 32, 24)
    assert source.notes == (f"topics chosen: color={COLOR}, depth={DEPTH}",)
    assert source.remarks == ()
    assert [frame.timestamp for frame in source.frames([1, 3])] == [frames[1].timestamp, frames[3].timestamp]


def test_bag_time_where_the_header_has_none(tmp_path: Path) -> None:
    """It proves that a header's time counts, and the time of recording where that is 0."""
    late = 5 * SECOND
    stamped = [
        raw("/a", START + index, color(1), "bgr8", recorded=START + index + late) for index in range(2)
    ]
    bare = [each._replace(fields=each.fields | {"header": {"stamp": 0, "frame_id": ""}}) for each in stamped]
    for sent, seconds in ((stamped, 1.7e9), (bare, 1.7e9 + 5)):
        folder = tmp_path / str(seconds)
        folder.mkdir()
        assert next(iter(open_source(mcap(folder, sent)))).timestamp == pytest.approx(seconds, abs=1e-6)


def test_unpaired_images_are_counted(tmp_path: Path) -> None:
    """It proves that frames without depth are left out, and that this is told after reading."""
    sent = [each for each in walk(9) if each.topic != DEPTH or (each.time - START) // (SECOND // 30) % 3]
    source = open_source(mcap(tmp_path, sent))
    assert blues(source) == [20, 30, 50, 60, 80, 90]
    assert source.remarks == ("left out 3 of 9 color images, with no depth image within 16.7 ms",)


def test_images_that_never_meet(tmp_path: Path) -> None:
    """It proves that color and depth of two clocks are an error that says how to read one of them."""
    source = open_source(mcap(tmp_path, walk(4, lag=SECOND)))
    with pytest.raises(ValueError, match=f"found none; --topics color={COLOR} reads one alone"):
        list(source)


def test_chosen_topics(tmp_path: Path) -> None:
    """It proves that topics by channel are taken as they are said, without a note."""
    path = bag1(tmp_path, walk())
    source = open_source(path, topics={"depth": DEPTH})
    assert (list(source.channels), source.notes) == (["depth"], ())
    assert meters(source) == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])
    assert meters(open_source(path, topics={"depth": DEPTH}, depth_scale=0.0001))[0] == pytest.approx(0.1)
    with pytest.raises(ValueError, match=r"expected depth images where --depth-scale is given"):
        open_source(path, topics={"color": COLOR}, depth_scale=0.001)


@pytest.mark.parametrize(
    ("topics", "message"),
    [
        ({"color": "/nowhere"}, f"expected one of the images {COLOR}, {DEPTH}, got /nowhere, which isn't"),
        (
            {"color": "/camera/color/camera_info"},
            "got /camera/color/camera_info, of the type sensor_msgs/msg/CameraInfo",
        ),
        ({"infrared": COLOR}, f"--topics infrared={COLOR}: expected color, depth, or right beside color"),
        ({"right": COLOR}, "expected color, depth, or right beside color"),
        ({"depth": COLOR}, f"the encoding 'bgr8' isn't one of depth; got depth={COLOR}, choose others"),
    ],
)
def test_wrong_topics(tmp_path: Path, topics: dict[str, str], message: str) -> None:
    """It proves that a topic that isn't there, or holds something else, is an error with its name."""
    with pytest.raises(ValueError, match=message):
        open_source(mcap(tmp_path, walk()), topics=topics)


def test_topics_without_a_recording(tmp_path: Path) -> None:
    """It proves that topics of a folder of images are refused."""
    with pytest.raises(ValueError, match=r"^--topics: expected with a recording"):
        open_source(tmp_path, topics={"color": "/a"})


def test_compressed_images(tmp_path: Path) -> None:
    """It proves that compressed color and depth are read as the raw ones are."""
    sent = []
    for index in range(3):
        time = START + index * SECOND // 10
        sent += [
            compressed("/rgb/image/compressed", time, jpeg(color(50 * index)), "bgr8; jpeg compressed bgr8"),
            compressed(
                "/depth/image/compressedDepth",
                time,
                bytes(12) + png(depth(900)),
                "16UC1; compressedDepth png",
            ),
        ]
    source = open_source(sqlite(tmp_path, sent))
    assert blues(source) == pytest.approx([0, 50, 100], abs=2)
    assert meters(source) == pytest.approx([0.9] * 3)
    assert source.fps == pytest.approx(10)


def test_the_frame_before_stands_in_for_a_damaged_one(tmp_path: Path) -> None:
    """It proves that one image that can't be decoded doesn't end the reading, is told, and that frames have
    the same numbers however they are read.
    """
    images = [jpeg(color(10)), b"no image", jpeg(color(30))]
    sent = [
        compressed("/a/compressed", START + n * SECOND // 10, data, "jpeg") for n, data in enumerate(images)
    ]
    source = open_source(mcap(tmp_path, sent))
    assert blues(source) == pytest.approx([10, 10, 30], abs=2)
    assert source.remarks == ("took the frame before in place of 1 with a damaged image",)
    assert [frame.timestamp for frame in source] == pytest.approx([START / SECOND + n / 10 for n in range(3)])
    (stream,) = source.channels.values()
    assert isinstance(stream, JointStream)
    assert stream.count() == 3
    for numbers, shown in {(0, 2): [10, 30], (1, 2): [10, 30], (2,): [30], (1,): [10]}.items():
        assert blues(source.frames(numbers)) == pytest.approx(shown, abs=2)


@pytest.mark.parametrize("damaged", [{2}, {3, 5, 6}, set(range(4, 31)), set(range(9, 24)) | {25}])
def test_a_damaged_frame_is_the_same_however_it_is_read(tmp_path: Path, damaged: set[int]) -> None:
    """It proves that a damaged frame alone has the images of the last whole one before it, as in reading all,
    however far back that is, and that only the wanted frames count as damaged.
    """
    sent = [
        compressed(
            "/a/compressed",
            START + at * SECOND // 30,
            b"no" if at in damaged else jpeg(color(7 * at)),
            "jpeg",
        )
        for at in range(35)
    ]
    source = open_source(mcap(tmp_path, sent))
    every = blues(source)
    assert every == pytest.approx([7 * max(set(range(at + 1)) - damaged) for at in range(35)], abs=2)
    for number in (2, 6, 13, 23, 25, 30, 34):
        assert blues(source.frames([number])) == [every[number]]
        assert ("in place of 1 with" in str(source.remarks)) == (number in damaged)
    assert blues(source.frames([1, 8, 29, 33])) == [every[at] for at in (1, 8, 29, 33)]


def test_a_message_that_is_not_decompressed(tmp_path: Path) -> None:
    """It proves that a compressed message that is damaged is left out, which is told, and others are read."""
    folder = sqlite(tmp_path, [each for each in walk(6) if each.topic == COLOR])
    rewrite(next(folder.glob("*.db3")), lambda data: zstandard.compress(data)[:-5], 3)
    source = open_source(folder)
    assert blues(source) == [10, 20, 40, 50, 60]
    assert source.remarks == ("left out 1 unreadable message",)


@pytest.mark.parametrize(("encoding", "kind"), [("32FC1", np.float32), ("64FC1", np.float64)])
def test_depth_of_floats(tmp_path: Path, encoding: str, kind: type) -> None:
    """It proves that floats are meters, in frames and in the summary, unless a unit is given; RealSense's
    own unit is that of 16 bits.
    """
    image = np.full((24, 32), 1.5, kind)
    units = Sent(
        "/device_0/sensor_0/option/Depth Units/value", START, "std_msgs/msg/Float32", {"data": 0.00025}
    )
    path = bag1(tmp_path, [units, raw("/depth", START, image, encoding)])
    for scale, unit in ((None, 1.0), (0.5, 0.5)):
        source = open_source(path, depth_scale=scale)
        assert meters(source) == pytest.approx([1.5 * unit])
        summary = summarize_depth(source.channels["depth"], "its format")
        assert summary is not None
        assert summary["meters_per_unit"] == unit


@pytest.mark.parametrize("scale", [0, -0.001, float("nan")])
def test_an_impossible_unit_of_depth(tmp_path: Path, scale: float) -> None:
    """It proves that a scale that can't be one is an error that names it, not left out."""
    with pytest.raises(ValueError, match=r"^depth_scale: expected"):
        open_source(mcap(tmp_path, walk(1)), depth_scale=scale)


def test_depth_is_registered_by_transforms(tmp_path: Path) -> None:
    """It proves that depth of another camera is brought into color's pixels by /tf_static: a wall at 2 m,
    half as large in a camera of half the focal length that stands 0.4 m to the left, ends where it has to.
    """
    time, wall = START, np.full((24, 32), 2000, np.uint16)
    wall[:, 20:] = 0
    sent = [
        transform(time, "color", "depth", (-0.4, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)),
        info("/color/camera_info", time, (64, 48), 60.0, frame="color"),
        info("/depth/camera_info", time, (32, 24), 30.0, frame="depth"),
        raw("/color/image_raw", time, color(9, (64, 48)), "bgr8", frame="color"),
        raw("/depth/image_rect_raw", time, wall, "16UC1", frame="depth"),
    ]
    source = open_source(bag1(tmp_path, sent))
    (frame,) = source
    assert frame.depth is not None
    assert frame.depth.shape == (48, 64)
    assert source.size == (64, 48)
    assert source.camera == Intrinsics(60, 60, 31.5, 23.5, 64, 48)
    # the last column's far edge is 4 px right of the middle: 0.267 m, less 0.4 m, times 60 / 2 m
    assert np.isfinite(frame.depth[:, :28]).all()
    assert np.isnan(frame.depth[:, 28:]).all()
    assert np.nanmax(np.abs(frame.depth - 2.0)) < 1e-6
    assert "400.0 mm beside it" in source.notes[-1]


def test_a_stereo_pair(tmp_path: Path) -> None:
    """It proves that left and right are found, with the baseline of the right camera's P."""
    size, sent = (32, 24), []
    p = [30.0, 0, 15.5, -3.75, 0, 30.0, 11.5, 0, 0, 0, 1, 0]
    for index in range(3):
        time = START + index * SECOND // 20
        for side, other in (("left", {}), ("right", {"p": p})):
            level = 10 * index + (side == "right") * 100
            sent.append(info(f"/stereo/{side}/camera_info", time, size, 30.0, **other))
            sent.append(raw(f"/stereo/{side}/image_rect", time, color(level)[..., 0], "mono8"))
    source = open_source(ros2_mcap(tmp_path, sent))
    pairs = [(int(frame.color[0, 0, 0]), int(frame.right[0, 0, 0])) for frame in source]  # type: ignore[index]
    assert pairs == [(0, 100), (10, 110), (20, 120)]
    assert source.camera == StereoRig(Intrinsics(30, 30, 15.5, 11.5, 32, 24), 0.125)
    topics = {"color": "/stereo/right/image_rect", "right": "/stereo/left/image_rect"}
    swapped = open_source(tmp_path / "c", topics=topics)
    assert not isinstance(swapped.camera, StereoRig)
    assert swapped.notes[-1].endswith(
        "swap the two cameras: --topics color=/stereo/left/image_rect,right=/stereo/right/image_rect"
    )


def test_a_folder_of_images_beside_its_bag(tmp_path: Path) -> None:
    """It proves that images that were taken out of a bag are read, not the bag beside them."""
    (tmp_path / "rgb").mkdir()
    cv2.imwrite(str(tmp_path / "rgb" / "1.png"), color(3))
    bag1(tmp_path, walk())
    assert open_source(tmp_path).format == "images"


STREAM_INFO = "uint32 fps\nstring encoding\nbool is_recommended\n"


def realsense(path: Path, units: float = 0.00025) -> Path:
    """A bag with the topics that librealsense writes: static ones at time 0, the others from time 0 on."""
    place = "/device_0/sensor_{}/{}_0/"
    sent = [
        Sent("/file_version", 1, "std_msgs/msg/UInt32", {"data": 4}),
        Sent("/device_0/sensor_0/option/Depth Units/value", 1, "std_msgs/msg/Float32", {"data": units}),
    ]
    for sensor, stream, shift in ((0, "Depth", 0.0), (1, "Color", 0.015)):
        name = place.format(sensor, stream)
        fields = {"fps": 30, "encoding": "x", "is_recommended": False}
        sent.append(Sent(f"{name}info", 1, "realsense_msgs/msg/StreamInfo", fields))
        lens = info(f"{name}info/camera_info", 1, (32, 24), 30.0 if stream == "Color" else 20.0)
        sent.append(lens._replace(fields=lens.fields | {"p": np.zeros(12), "r": np.zeros(9)}))
        tf = pose((shift, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        sent.append(Sent(f"{name}tf/0", 1, "geometry_msgs/msg/Transform", tf))
    for index in range(4):
        time = 1 + index * SECOND // 30
        stamp = START + time
        rgb = color(10 * (index + 1))[..., ::-1]
        sent += [
            raw(place.format(0, "Depth") + "image/data", time, depth(4000), "mono16", stamp=stamp),
            raw(place.format(1, "Color") + "image/data", time, rgb, "rgb8", stamp=stamp + 2_000_000),
        ]
    return write_bag1(path, sent, "LZ4", realsense_msgs__msg__StreamInfo=STREAM_INFO)


def test_realsense_bags(tmp_path: Path) -> None:
    """It proves that RealSense's own recordings have their unit of depth, cameras, and extrinsics."""
    source = open_source(realsense(tmp_path / "a.bag"))
    assert blues(source) == [10, 20, 30, 40]
    assert meters(source) == pytest.approx([1.0] * 4)
    assert source.camera == Intrinsics(30, 30, 15.5, 11.5, 32, 24)
    assert isinstance(source.register, Reprojection)
    assert np.allclose(source.register.extrinsics.translation, [0.015, 0, 0])
    assert meters(open_source(tmp_path / "a.bag", depth_scale=0.0005)) == pytest.approx([2.0] * 4)


def test_foxglove_in_json(tmp_path: Path) -> None:
    """It proves that Foxglove's images and calibration in JSON are a source."""
    messages: list[tuple[str, int, str, dict[str, Any]]] = []
    for index in range(3):
        time = START + index * SECOND // 10
        stamp = {"timestamp": {"sec": time // SECOND, "nsec": time % SECOND}, "frame_id": "lens"}
        camera = {"width": 32, "height": 24, "distortion_model": "", "D": [], "R": []}
        camera |= {"K": [30, 0, 15.5, 0, 30, 11.5, 0, 0, 1], "P": []}
        image = {"data": jpeg(color(10 * index)), "format": "jpeg"}
        units = {"width": 32, "height": 24, "encoding": "16UC1", "step": 64, "data": depth(500).tobytes()}
        messages += [
            ("/cam/calibration", time, "foxglove.CameraCalibration", stamp | camera),
            ("/cam/image", time, "foxglove.CompressedImage", stamp | image),
            ("/cam/depth", time, "foxglove.RawImage", stamp | units),
        ]
    source = open_source(write_json(tmp_path / "a.mcap", messages))
    assert blues(source) == pytest.approx([0, 10, 20], abs=2)
    assert meters(source) == pytest.approx([0.5] * 3)
    assert source.camera == Intrinsics(30, 30, 15.5, 11.5, 32, 24)


@pytest.mark.parametrize("write", WRITERS)
def test_a_cut_off_recording(tmp_path: Path, write: Writer) -> None:
    """It proves that the frames before the end of a cut off file are read, but for those of the chunk that is
    cut, and that this is told.
    """
    noise = np.random.default_rng(0).integers(0, 255, (60, 120, 160, 3), dtype=np.uint8)
    sent = [raw("/a", START + index * SECOND // 30, image, "bgr8") for index, image in enumerate(noise)]
    path = write(tmp_path, sent)
    file = path if path.is_file() else next(each for each in path.iterdir() if each.suffix != ".yaml")
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    source = open_source(path)
    frames = list(source)
    assert 30 - 18 <= len(frames) <= 31  # a chunk of 1 MiB has 18 images
    assert all(np.array_equal(frame.color, image) for frame, image in zip(frames, noise, strict=False))
    (remark,) = source.remarks
    assert "it is cut off" in remark
    assert remark.endswith("; what is before that was read")


@pytest.mark.filterwarnings("ignore:depth")  # which may be damaged, too
@pytest.mark.parametrize("write", WRITERS)
def test_damaged_bytes(tmp_path: Path, write: Writer) -> None:
    """It proves that whatever bytes of a recording are wrong, it's read, or an error that names it."""
    path = write(tmp_path, walk(3))
    file = path if path.is_file() else next(each for each in path.iterdir() if each.suffix != ".yaml")
    content, rng = file.read_bytes(), random.Random(0)
    errors = []
    for _ in range(40):
        damaged = bytearray(content)
        for _ in range(rng.choice((1, 4, 20))):
            place = rng.randrange(len(damaged))
            damaged[place : place + rng.choice((1, 4))] = rng.choice((b"\xff" * 4, b"", rng.randbytes(1)))
        file.write_bytes(damaged)
        try:
            list(open_source(file))
        except ValueError as error:
            errors.append(str(error))
    assert 0 < len(errors) < 40
    assert all(file.name in error for error in errors)


def test_memory_stays_flat(tmp_path: Path) -> None:
    """It proves that a recording of ten times the length needs no more memory while it's read."""
    peaks = []
    for count in (20, 200):
        folder = tmp_path / str(count)
        folder.mkdir()
        peaks.append([])
        for write in (bag1, sqlite, mcap):
            source = open_source(write(folder, walk(count, size=(160, 120))))
            tracemalloc.start()
            for frame in source:
                assert frame.color is not None
            peaks[-1].append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
    for short, long in zip(*peaks, strict=True):
        assert long < 1.5 * short + 1e6


def no_images(folder: Path) -> Path:
    """A bag of other things."""
    return write_bag1(folder / "x.bag", [Sent("/n", START, "std_msgs/msg/UInt32", {"data": 1})])


def no_messages(folder: Path) -> Path:
    """A bag of nothing."""
    return write_bag1(folder / "x.bag", [])


def several(folder: Path) -> Path:
    """A folder of two recordings."""
    for name in ("1.mcap", "2.mcap"):
        write_mcap(folder / name, walk(1))
    return folder


def packed(folder: Path) -> Path:
    """A ROS 2 folder whose database is compressed as a whole."""
    path = next(write_bag2(folder / "b", walk(1)).glob("*.db3"))
    path.rename(path.with_name(f"{path.name}.zstd"))
    return path.parent


def unknown_encoding(folder: Path) -> Path:
    """A bag of images that nobody knows."""
    return write_bag1(folder / "x.bag", [raw("/a", START, color(1), "secret")])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (no_images, "x.bag: expected images in the recording, found only std_msgs/msg/UInt32"),
        (no_messages, "x.bag: expected images in the recording, found no messages"),
        (packed, "b.db3.zstd: expected unpacked files; zstd -d --rm "),
        (several, "expected one recording, found 2; name one of them"),
        (
            unknown_encoding,
            "the encoding 'secret' of color isn't known; got color=/a, choose others by --top",
        ),
    ],
)
def test_unusable_recordings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], make: Callable[[Path], Path], message: str
) -> None:
    """It proves that a recording without images that can be read is an error of one line."""
    assert main(["info", str(make(tmp_path))]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1


@pytest.mark.parametrize(("write", "package"), [(bag1, "rosbags"), (mcap, "mcap")])
def test_a_missing_package_is_named(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    write: Writer,
    package: str,
) -> None:
    """It proves that without the extra the one line says what to install."""
    path = write(tmp_path, walk(1))
    for name in [name for name in sys.modules if name.split(".")[0] == package]:
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setitem(sys.modules, package, None)
    assert main(["info", str(path)]) == 2
    assert f"the package {package}: pip install 'tricue[recordings]'" in capsys.readouterr().err


def test_info_shows_topics(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves what tricue info says of a recording."""
    assert main(["info", str(bag1(tmp_path, walk()))]) == 0
    said = capsys.readouterr().out
    for line in (
        "a: ROS 1 bag",
        "  frames       5, 30 a second, 0.13 s",
        "  depth        32x24, float32",
        "               0.001 m per unit, by ROS's format",
        "               1.000 m to 1.400 m, 5th to 95th percentile; 0.1 % invalid pixels; of all frames",
        "  calibration  the recording's own",
        "               fx 30.00, fy 30.00, cx 15.50, cy 11.50 px",
        f"  topic        {COLOR}, sensor_msgs/msg/Image, 5 messages, as color",
        "  topic        /camera/color/camera_info, sensor_msgs/msg/CameraInfo, 5 messages",
    ):
        assert line in said.splitlines()


def test_tracking_in_a_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that tricue track reads a recording with its own camera, and tells what was left out."""
    rng = np.random.default_rng(0)
    background, target = rng.integers(0, 90, (96, 128, 3)), rng.integers(90, 255, (24, 24, 3))
    sent = []
    for index in range(8):
        image = background.astype(np.uint8)
        image[30:54, 40 + index : 64 + index] = target
        time = START + index * SECOND // 30
        sent.append(raw("/color/image_raw", time, image, "bgr8"))
        sent.append(info("/color/camera_info", time, (128, 96), 100.0))
        if index != 5:
            sent.append(raw("/depth/image_raw", time, depth(1500, (128, 96)), "16UC1"))
            sent.append(info("/depth/camera_info", time, (128, 96), 100.0))
    csv = tmp_path / "track.csv"
    path = str(mcap(tmp_path, sent))
    topics = "color=/color/image_raw,depth=/depth/image_raw"
    assert main(["track", path, "--topics", topics, "--box", "40,30,24,24", "--csv", str(csv)]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "7 frames, 7 tracked" in said.out
    assert "left out 1 of 8 color images, with no depth image within 16.7 ms" in said.out
    assert "calibration: the recording's or the camera's own" in said.out
    assert len(csv.read_text().splitlines()) == 8


def test_true_boxes_beside_a_recording(tmp_path: Path) -> None:
    """It proves that a table of boxes with the recording's name is its truth."""
    path = mcap(tmp_path, walk(2))
    path.with_suffix(".csv").write_text("frame,x,y,width,height\n0,1,2,3,4\n")
    source = open_source(path)
    assert source.first_box == (1, 2, 3, 4)
    assert source.notes[-1].startswith("true boxes found")


@pytest.mark.parametrize("write", WRITERS)
def test_cameras_that_come_late(tmp_path: Path, write: Writer) -> None:
    """It proves that a camera_info and a transform that are recorded seconds after the images are found."""
    sent = [each for each in walk(150) if "camera_info" not in each.topic]
    for index, each in enumerate(sent):
        if each.topic == DEPTH:
            sent[index] = raw(DEPTH, each.time, depth(1000), "16UC1", frame="depth camera")
    later = START + 4 * SECOND
    sent += [
        info("/camera/color/camera_info", later, (32, 24), 30.0),
        info("/camera/depth/camera_info", later, (32, 24), 20.0, frame="depth camera"),
        transform(later, "camera", "depth camera", [0.05, 0, 0], [0, 0, 0, 1]),
    ]
    source = open_source(write(tmp_path, sorted(sent, key=lambda each: each.time)))
    assert source.camera == Intrinsics(30.0, 30.0, 15.5, 11.5, 32, 24)
    assert any("whose camera is 50.0 mm beside it" in note for note in source.notes)


@pytest.mark.parametrize("compression", ["NONE", "LZ4", "ZSTD"])
@pytest.mark.parametrize("whole", [True, False])
def test_chunks_of_mcap(tmp_path: Path, compression: str, whole: bool) -> None:
    """It proves that chunks of each compression are read, with and without a summary."""
    from mcap.writer import CompressionType

    path = write_mcap(tmp_path / "a.mcap", walk(12), compression=CompressionType[compression])
    if not whole:
        content = path.read_bytes()
        path.write_bytes(content[: content.index(b"\x0f", len(content) - 2000)])
    assert blues(open_source(path)) == [10 * (index + 1) for index in range(12)]


def test_big_endian_depth_in_meters(tmp_path: Path) -> None:
    """It proves that floats and 16 bits of a machine of the other byte order are read."""
    sent = []
    for name, image, encoding in (
        ("/float", np.full((24, 32), 1.5, ">f4"), "32FC1"),
        ("/whole", np.full((24, 32), 1500, ">u2"), "16UC1"),
    ):
        message = raw(name, START, image, encoding)
        message.fields["is_bigendian"] = 1
        sent.append(message)
    bag = bag1(tmp_path, sent)
    for name in ("/float", "/whole"):
        frame = next(iter(open_source(bag, topics={"depth": name})))
        assert frame.depth is not None
        assert frame.depth == pytest.approx(np.full((24, 32), 1.5))
