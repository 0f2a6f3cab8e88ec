# SPDX-License-Identifier: MIT
"""Kinds of images in recordings, as cameras' drivers and tools write them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tricue import Intrinsics, open_source
from tricue.camera.registration import Reprojection
from tricue.data.summary import summarize_depth

from tests.data.recordings.recording_files import bag1, blues, mcap, meters, sqlite
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
    walk,
    write_bag1,
    write_json,
    write_mcap,
)


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
