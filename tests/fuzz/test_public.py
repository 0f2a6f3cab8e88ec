# SPDX-License-Identifier: MIT
"""Public calls with values that nobody expects: each answers, or raises ValueError, TypeError or OSError.

``make fuzz`` tries more of them.
"""

import io
import os
import pickle
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tricue.cli.program import main
from tricue.data.box_table import read_box_table

from tests.fuzz.mutations import mutate
from tests.fuzz.values import anything, edge_arrays, images, numbers

REFUSALS = (ValueError, TypeError, OSError)
EXAMPLES = int(os.environ.get("TRICUE_FUZZ", "50"))
bounded = settings(
    max_examples=EXAMPLES,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
TRACKERS = ("color-particle", "depth-particle", "stereo-head", "flow-depth", "fused")
SIZE = 96, 128  # height, width
CONSTRUCTORS: dict[str, Callable[..., Any]] = {
    "Box": tricue.Box,
    "Intrinsics": tricue.Intrinsics,
    "Intrinsics.from_fov": tricue.Intrinsics.from_fov,
    "StereoRig": tricue.StereoRig,
    "Pose": tricue.Pose,
    "PanTilt": tricue.PanTilt,
}

pytestmark = pytest.mark.filterwarnings("ignore")


def attempt(call: Callable[[], Any], named: str = "") -> Any:
    """What the call answers; None where it refuses, with a message in which the name stands."""
    try:
        return call()
    except REFUSALS as error:
        message = str(error)
    assert message
    assert named in message
    return None


@bounded
@given(
    images("color") | st.none(),
    images("depth") | st.none(),
    images("right") | st.none(),
    anything | st.none(),
    anything | st.none(),
)
def test_frames(color: Any, depth: Any, right: Any, timestamp: Any, scale: Any) -> None:
    """It proves that whatever a frame is made of, it is a frame of the documented types, or is refused."""
    given_ = {"color": color, "depth": depth, "right": right, "timestamp": timestamp, "depth_scale": scale}
    chosen = {name: value for name, value in given_.items() if value is not None}
    frame = attempt(lambda: tricue.Frame(**chosen))
    if frame is None:
        return
    assert frame.color is None or frame.color.dtype == np.uint8
    assert frame.depth is None or frame.depth.dtype == np.float32
    assert frame.timestamp is None or np.isfinite(frame.timestamp)


@pytest.mark.parametrize("name", CONSTRUCTORS)
@bounded
@given(st.lists(anything | numbers | edge_arrays(), max_size=7))
def test_values(name: str, arguments: list[Any]) -> None:
    """It proves that cameras, poses and boxes are made of sound numbers alone."""
    attempt(lambda: CONSTRUCTORS[name](*arguments))


@pytest.mark.parametrize("name", TRACKERS)
@bounded
@given(st.data())
def test_parameters(name: str, data: st.DataObject) -> None:
    """It proves that a tracker takes a parameter's value or refuses it."""
    kind = tricue.create(name).Params
    known = data.draw(st.sampled_from(sorted(kind.__dataclass_fields__)))
    attempt(lambda: tricue.create(name, **{known: data.draw(anything)}))


@pytest.mark.parametrize("name", TRACKERS)
@bounded
@given(st.data())
def test_trackers(name: str, data: st.DataObject) -> None:
    """It proves that a frame gives a finite track, or an error that leaves the tracker as it was."""
    tracker = tricue.create(name)
    box = data.draw(st.sampled_from([(40, 30, 40, 50), (0, 0, 128, 96), (-20, 60, 50, 60)]) | anything)
    if attempt(lambda: tracker.init(plausible_frame(0), box)) is None:
        return
    for step in range(1, 4):
        frame = data.draw(st.just(plausible_frame(step)) | changed_frames(step) | strange_frames() | anything)
        before = pickle.dumps(tracker)
        track = attempt(lambda frame=frame: tracker.update(frame))
        if track is None:
            assert pickle.dumps(tracker) == before
        else:
            assert np.isfinite(track.box).all()
            assert 0 <= track.score <= 1
            assert track.position is None or np.isfinite(track.position).all()


@st.composite
def changed_frames(draw: st.DrawFn, step: int) -> Any:
    """A plausible frame with other values, types, shapes or strides in one channel, or without one."""
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    frame = plausible_frame(step)
    channels = {name: getattr(frame, name) for name in ("color", "depth", "right", "timestamp")}
    name = draw(st.sampled_from(sorted(channels)))
    channels[name] = None if draw(st.integers(0, 4)) == 0 else mutate(channels[name], random)
    return attempt(lambda: tricue.Frame(**channels))


@st.composite
def strange_frames(draw: st.DrawFn) -> Any:
    """A frame of images that don't belong together."""
    drawn = {name: draw(images(name) | st.none()) for name in ("color", "depth", "right")}
    return attempt(
        lambda: tricue.Frame(**{name: image for name, image in drawn.items() if image is not None})
    )


def plausible_frame(step: int) -> tricue.Frame:
    """A textured square in all channels, which moves to the right."""
    random = np.random.default_rng(0)
    color = random.integers(0, 90, (*SIZE, 3), np.uint8)
    depth = np.full(SIZE, 3.0, np.float32)
    square = random.integers(90, 255, (50, 40, 3), np.uint8)
    left = 40 + 2 * step
    color[30:80, left : left + 40] = square
    depth[30:80, left : left + 40] = 1.5
    right = np.roll(color, -8, 1)
    return tricue.Frame(color, depth=depth, right=right, timestamp=step / 30)


VALID_FILES = {
    "opencv.yml": "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 500., 0., 320., 0., 500., 240., 0., 0., 1. ]\nimage_width: 640\nimage_height: 480\n",
    "kitti.txt": "P2: 7.2e+02 0 6.1e+02 4.5e+01 0 7.2e+02 1.7e+02 2.1e-01 0 0 1 2.7e-03\n"
    "P3: 7.2e+02 0 6.1e+02 -3.4e+02 0 7.2e+02 1.7e+02 2.2e+00 0 0 1 2.7e-03\n",
    "camera.toml": "[intrinsics]\nfx = 500.0\nfy = 500.0\ncx = 320.0\ncy = 240.0\n"
    "width = 640\nheight = 480\n",
    "boxes.csv": "frame,x,y,width,height\n0,1,2,3,4\n2,5,6,7,8\n",
}
READERS: dict[str, list[Callable[[Path], Any]]] = {
    "opencv.yml": [tricue.Intrinsics.from_opencv, tricue.StereoRig.from_opencv],
    "kitti.txt": [tricue.Intrinsics.from_kitti, tricue.StereoRig.from_kitti],
    "camera.toml": [tricue.Intrinsics.from_toml, tricue.StereoRig.from_toml],
    "boxes.csv": [read_box_table],
}
INSERTS = [
    b"\0",
    b"\xff\xfe",
    b"1e999",
    b"-",
    b"nan",
    b"[" * 3000,
    b"\n",
    b",,,",
    b"9" * 400,
    b"\xef\xbb\xbf",
    b'"',
]


@pytest.mark.parametrize("name", VALID_FILES)
@bounded
@given(drawn=st.data())
def test_files(name: str, drawn: st.DataObject, tmp_path: Path) -> None:
    """It proves that a damaged calibration or table is read as far as it is sound, or named in an error."""
    content = bytearray(VALID_FILES[name].encode())
    for _ in range(drawn.draw(st.integers(0, 3))):
        at = drawn.draw(st.integers(0, len(content)))
        end = drawn.draw(st.integers(at, min(at + 20, len(content))))
        content[at:end] = drawn.draw(st.sampled_from(INSERTS) | st.binary(max_size=6))
    path = tmp_path / name
    path.write_bytes(content)
    for read in READERS[name]:
        attempt(lambda read=read: read(path), name)


WORDS = ["--box", "1,2,30,30", "0,0,0,0", "a,b", "--tracker", "fused", "flow-depth", "nobody", "x:Y", "--set"]
WORDS += [
    "rate=1e400",
    "particles=",
    "particles=-1",
    "--params",
    "--seed",
    "-1",
    "--csv",
    "--json",
    "--fps",
    "0",
]
WORDS += ["nan", "--fov", "60", "181,3", "--depth-scale", "inf", "--detect", "face", "--paper", "--kernels"]
WORDS += [
    "reference",
    "--calibration",
    "--depth",
    "--right",
    "--target",
    "--plot",
    "",
    "-",
    "\udcff",
    "=",
    "--",
]


@bounded
@given(command=st.sampled_from(["track", "info", "calibrate", "reproduce", "nothing"]), drawn=st.data())
def test_command_lines(command: str, drawn: st.DataObject, tmp_path: Path) -> None:
    """It proves that any words end with code 0, 1 or 2, and an error with one line."""
    picture = tmp_path / "walk" / "1.png"
    if not picture.exists():
        picture.parent.mkdir()
        noise = np.random.default_rng(0).integers(0, 256, (48, 64, 3), np.uint8)
        for index in (1, 2):
            cv2.imwrite(str(picture.with_name(f"{index}.png")), noise)
    places = [str(picture.parent), str(picture), str(tmp_path / "missing"), "/dev/null"]
    words = [command, *drawn.draw(st.lists(st.sampled_from([*WORDS, *places]), max_size=6))]
    if command == "reproduce":
        words = [word for word in words if "-" not in word or word.startswith("-")]  # no experiment runs
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            code: Any = main(words)
        except SystemExit as stopped:
            code = stopped.code
    assert code in (0, 1, 2, None), (words, code)
    assert "Traceback" not in err.getvalue()
    for left in tmp_path.glob("*"):
        assert left.name == "walk" or left.is_file()
