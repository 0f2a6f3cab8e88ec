# SPDX-License-Identifier: MIT
"""RealSense's own library records from a camera of software alone, and plays it back."""

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Intrinsics, open_source
from tricue.camera.registration import Reprojection
from tricue.data.live import Live, Patience, live_channels
from tricue.data.realsense import RealSense
from tricue.data.source import Source

rs = pytest.importorskip("pyrealsense2", reason="needs the extra realsense", exc_type=ImportError)

SIZE = 64, 48
UNITS = 0.00025


def stream(kind: Any, layout: Any, size: int, number: int) -> Any:
    """A stream with a lens of 60 pixels. size: bytes of a pixel."""
    lens = rs.intrinsics()
    lens.width, lens.height = SIZE
    lens.fx = lens.fy = 60.0
    lens.ppx, lens.ppy, lens.model, lens.coeffs = 31.5, 23.5, rs.distortion.none, [0.0] * 5
    made = rs.video_stream()
    made.type, made.index, made.uid, made.fmt, made.bpp = kind, 0, number, layout, size
    made.width, made.height, made.fps, made.intrinsics = *SIZE, 30, lens
    return made


def image_of(profile: Any, pixels: NDArray[Any], number: int) -> Any:
    """An image that a sensor of software gives."""
    image = rs.software_video_frame()
    image.bpp = pixels.itemsize * (pixels.shape[2] if pixels.ndim == 3 else 1)
    image.stride, image.pixels, image.timestamp = SIZE[0] * image.bpp, pixels, 1000 * number / 30
    image.domain, image.frame_number = rs.timestamp_domain.hardware_clock, number
    image.profile = profile.as_video_stream_profile()
    if pixels.ndim == 2:
        image.depth_units = UNITS
    return image


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Depth of 1 m and color of the levels 10, 20, ..., whose camera is 15 mm beside it."""
    device = rs.software_device()
    sensors = [device.add_sensor(name) for name in ("Depth", "Color")]
    depth = sensors[0].add_video_stream(stream(rs.stream.depth, rs.format.z16, 2, 0))
    color = sensors[1].add_video_stream(stream(rs.stream.color, rs.format.bgr8, 3, 1))
    sensors[0].add_read_only_option(rs.option.depth_units, UNITS)
    beside = rs.extrinsics()
    beside.rotation, beside.translation = [1, 0, 0, 0, 1, 0, 0, 0, 1], [0.015, 0, 0]
    depth.register_extrinsics_to(color, beside)
    path = tmp_path_factory.mktemp("realsense") / "a.db3"
    try:
        recorder = rs.recorder(str(path), device)
    except RuntimeError:  # older ones write ROS 1
        path = path.with_suffix(".bag")
        recorder = rs.recorder(str(path), device)
    recorded = recorder.query_sensors()
    for sensor in recorded:
        sensor.open(sensor.get_stream_profiles()[0])
        sensor.start(lambda _: None)
    for number in range(1, 11):
        level = np.full((SIZE[1], SIZE[0], 3), 10 * number, np.uint8)
        meter = np.full((SIZE[1], SIZE[0]), round(1 / UNITS), np.uint16)
        sensors[0].on_video_frame(image_of(depth, meter, number))
        sensors[1].on_video_frame(image_of(color, level, number))
        time.sleep(1 / 30)
    for sensor in recorded:
        sensor.stop()
        sensor.close()
    return path


def test_a_recording_of_the_library(recording: Path) -> None:
    """It proves that what librealsense records has its levels, meters, cameras, and extrinsics."""
    source = open_source(recording)
    frames = list(source)
    levels = [int(frame.color[0, 0, 0]) for frame in frames if frame.color is not None]
    assert levels == [10 * number for number in range(1, 11)][-len(levels) :]
    assert len(levels) >= 8  # the library may start late
    assert np.nanmax(np.abs(frames[0].depth - 1)) < 1e-6  # type: ignore[operator]
    assert source.camera == Intrinsics(60, 60, 31.5, 23.5, *SIZE)
    assert isinstance(source.register, Reprojection)
    assert np.allclose(source.register.extrinsics.translation, [0.015, 0, 0], atol=1e-6)
    assert np.allclose(source.register.extrinsics.rotation, np.eye(3))


def test_a_live_camera(recording: Path) -> None:
    """It proves, with the recording played as if it were a camera, that color and registered depth come."""
    context = rs.context()
    player = context.load_device(str(recording))  # it is there while it's held
    live = Live(RealSense(context=context), Patience(start=5, silence=5))
    source = Source("realsense:", live_channels(live), camera=live.camera)
    frame = next(iter(source))
    live.close()
    assert player is not None
    assert frame.color is not None
    assert frame.depth is not None
    assert frame.color.shape == (SIZE[1], SIZE[0], 3)
    assert int(frame.color[0, 0, 0]) in range(10, 101, 10)
    assert frame.depth.shape == (SIZE[1], SIZE[0])
    assert np.nanmedian(frame.depth) == pytest.approx(1.0)
    assert source.camera == Intrinsics(60, 60, 31.5, 23.5, *SIZE)
