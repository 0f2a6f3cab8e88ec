# SPDX-License-Identifier: MIT
import dataclasses
import pickle
import re
import warnings
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray
from tricue import Frame
from tricue.camera.frame import as_frame

PICTURE = np.random.default_rng(0).integers(0, 256, (24, 32, 3), np.uint8)
GRAY = np.ascontiguousarray(PICTURE[:, :, 0])
METERS = np.full((12, 16), 2.5, np.float32)


def test_a_frame_names_its_channels() -> None:
    """It proves that each channel is found under its name and that absent ones are None."""
    frame = Frame(PICTURE, METERS, timestamp=2)
    assert frame.channels == ("color", "depth")
    assert frame.right is None
    assert frame.timestamp == 2.0
    assert Frame(PICTURE, right=PICTURE).channels == ("color", "right")


def test_a_bare_array_is_color() -> None:
    """It proves that an image alone becomes a frame's color, and a frame passes as it is."""
    assert as_frame(PICTURE).color is PICTURE
    frame = Frame(depth=METERS)
    assert as_frame(frame) is frame


@pytest.mark.parametrize(
    "image", [PICTURE, GRAY, PICTURE[3:20, 5:21], GRAY[3:20, 5:21], PICTURE[:, 4:5], PICTURE[2:3]]
)
def test_packed_rows_are_not_copied(image: NDArray[np.uint8]) -> None:
    """It proves that whole images and crops of them, padded rows included, are kept without a copy."""
    color = Frame(image).color
    assert color is not None
    assert np.shares_memory(color, image)


@pytest.mark.parametrize(
    "image",
    [
        PICTURE[::-1],
        PICTURE[:, ::-1],
        PICTURE[:, :, ::-1],
        PICTURE[:, ::2],
        np.asfortranarray(PICTURE),
        GRAY[:, ::-1],
        np.asfortranarray(GRAY),
        PICTURE[:, :, 0],
        np.dstack([PICTURE, GRAY])[:, :, :3],
        np.broadcast_to(PICTURE[:1], PICTURE.shape),
        PICTURE[:, ::2][:, :1],
        PICTURE[::-1][:1],
        PICTURE[:1, ::2][:, :1],
    ],
)
def test_other_layouts_are_copied(image: NDArray[np.uint8]) -> None:
    """It proves that mirrored, strided and Fortran images are read right: same values, packed pixels."""
    color = Frame(image).color
    assert color is not None
    assert np.array_equal(color, image)
    assert color.strides == np.empty(image.shape, np.uint8).strides or np.shares_memory(color, image)
    assert color.strides[1:] == ((3, 1) if image.ndim == 3 else (1,))
    assert color.strides[0] >= image[0].size


def test_one_channel_is_gray() -> None:
    """It proves that an image (H, W, 1) is taken as gray (H, W)."""
    color = Frame(GRAY[:, :, None]).color
    assert color is not None
    assert np.array_equal(color, GRAY)


@given(arrays.arrays(np.float64, (5, 7), elements=st.floats(width=32)))
def test_invalid_depth_becomes_nan(depth: NDArray[np.float64]) -> None:
    """It proves that zero, negative, NaN and depths beyond 1,000 km, and no others, become NaN in float32."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of values that look like millimeters
        stored = Frame(depth=depth).depth
    assert stored is not None
    assert stored.dtype == np.float32
    valid = (depth > 0) & (depth <= 1e6)
    assert np.array_equal(stored, np.where(valid, depth, np.nan).astype(np.float32), equal_nan=True)


@pytest.mark.parametrize("dtype", [np.uint16, np.int16, np.int32, np.int64, ">u2", np.float32])
def test_depth_scale_gives_meters(dtype: Any) -> None:
    """It proves that integers (and floats) in other units become meters, with 0 as no measurement."""
    frame = Frame(depth=np.array([[0, 500], [1000, 8000]], dtype), depth_scale=0.001)
    assert frame.depth is not None
    np.testing.assert_allclose(frame.depth, np.array([[np.nan, 0.5], [1, 8]]), rtol=1e-6)


def test_the_callers_depth_is_not_written_to() -> None:
    """It proves that the frame's depth is its own: marking invalid pixels leaves the caller's array alone."""
    depth = np.zeros((4, 4), np.float32)
    Frame(depth=depth)
    assert np.array_equal(depth, np.zeros((4, 4)))


def test_millimeters_as_meters_warn() -> None:
    """It proves that a depth image in millimeters, passed as meters, is warned of at the caller's line."""
    with pytest.warns(UserWarning, match="looks like millimeters") as caught:
        Frame(depth=np.full((480, 640), 1500.0))
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    ("meters", "scale", "message"),
    [
        (1400.0, None, "1000 m, which looks like millimeters; pass depth_scale=0.001"),
        (50.1, None, "50 m, which looks like millimeters"),
        (12_500.0, 0.1, "1000 m, which looks like a wrong depth_scale, 0.1 meters per unit"),
        (2.6, 0.001, "0.003 m, which looks like a wrong depth_scale, 0.001 meters per unit"),
        (0.0024, None, "0.002 m, which looks like another unit than meters; pass depth_scale"),
    ],
)
def test_a_wrong_unit_warns(meters: float, scale: float | None, message: str) -> None:
    """It proves that a median depth that no camera measures is warned of, with what is likely wrong."""
    depth = np.full((24, 32), meters)
    depth[::2] = 0
    with pytest.warns(UserWarning, match=f"^depth: its median is about {message}") as caught:
        Frame(depth=depth, depth_scale=scale)
    assert caught[0].filename == __file__


def test_a_wrong_unit_warns_once_for_frames_of_one_line() -> None:
    """It proves that frames of a video, whose medians differ a little, don't give a warning each."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("default")
        for millimeters in range(4600, 4700, 10):
            Frame(depth=np.full((24, 32), float(millimeters)))
    assert [str(each.message).partition(" m,")[0] for each in caught] == ["depth: its median is about 5000"]


@pytest.mark.parametrize(("dtype", "scale"), [(np.uint16, 5000), (np.float64, 5000), (np.float32, None)])
def test_a_unit_that_removes_all_depth_warns(dtype: Any, scale: float | None) -> None:
    """It proves that units per meter in the place of meters per unit are warned of where no depth is left."""
    depth = np.linspace(2000, 8000, 24 * 32).reshape(24, 32).astype(dtype) * (1 if scale else 5000)
    depth[::2] = 0
    with pytest.warns(UserWarning, match=r"^depth: all values are .*meters per unit, 0.001 for") as caught:
        frame = Frame(depth=depth, depth_scale=scale and 1000)
    assert frame.depth is not None
    assert np.isnan(frame.depth).all()
    assert caught[0].filename == __file__


@pytest.mark.parametrize("meters", [0.05, 0.4, 8.0, 49.9])
def test_usual_depths_do_not_warn(meters: float) -> None:
    """It proves that no warning comes from a hand before the camera to a street's end, a few odd pixels, or
    where nothing is measured.
    """
    depth = np.full((24, 32), meters, np.float32)
    depth[:4], depth[4:8] = 65.535, 0.001
    Frame(depth=depth)
    Frame(depth=np.zeros((24, 32)))


def test_masked_pixels_are_not_measured() -> None:
    """It proves that a masked array's masked pixels become NaN, of floats as of integers."""
    far = METERS.copy()
    far[2:5] = 7
    for masked, scale in (
        (np.ma.masked_greater(far, 5), None),
        (np.ma.masked_greater((1000 * far).astype(np.uint16), 5000), 0.001),
    ):
        depth = Frame(depth=masked, depth_scale=scale).depth
        assert depth is not None
        assert type(depth) is np.ndarray
        np.testing.assert_allclose(depth, np.where(far > 5, np.nan, far), rtol=1e-6)


def test_a_frame_can_be_pickled_and_replaced() -> None:
    """It proves that frames go through pickle and dataclasses.replace unchanged."""
    frame = dataclasses.replace(Frame(PICTURE, METERS * 1000, depth_scale=0.001), timestamp=1.5)
    copy = pickle.loads(pickle.dumps(frame))
    assert np.array_equal(copy.color, PICTURE)
    np.testing.assert_allclose(copy.depth, METERS, rtol=1e-6)
    assert copy.timestamp == 1.5


def test_a_missing_channel_is_named() -> None:
    """It proves that require says which channel is missing and which are there."""
    with pytest.raises(ValueError, match=r"^frame: expected the channel depth, .*, got color and right$"):
        Frame(PICTURE, right=PICTURE).require("color", "depth")


FLOATS = PICTURE / 255
BAD = [
    ({}, ValueError, "frame: expected color or depth, got neither"),
    ({"right": PICTURE}, ValueError, "frame: expected color or depth, got right alone"),
    ({"color": "image.png"}, TypeError, "color: expected a NumPy array, uint8, got str"),
    ({"color": PICTURE.tolist()}, TypeError, "color: expected a NumPy array, uint8, got list"),
    (
        {"color": FLOATS},
        TypeError,
        r"color: expected uint8 values from 0 to 255, got float64 \(24, 32, 3\); \(255 \* image\).astype",
    ),
    (
        {"color": PICTURE.astype(np.uint16)},
        TypeError,
        r"color: .*, got uint16 \(24, 32, 3\); \(image >> 8\).* converts values from 0 to 65535$",
    ),
    ({"color": PICTURE.astype(np.uint32)}, TypeError, r"color: .*, got uint32 \(24, 32, 3\)$"),
    ({"color": PICTURE > 3}, TypeError, "color: expected uint8 .*, got bool"),
    ({"color": PICTURE.astype(object)}, TypeError, "color: expected uint8 .*, got object"),
    (
        {"color": np.dstack([PICTURE, GRAY])},
        ValueError,
        r"color: .*\(24, 32, 4\); .* drops the alpha channel",
    ),
    ({"color": PICTURE[:, :, :2]}, ValueError, r"color: expected BGR .*, got uint8 \(24, 32, 2\)"),
    ({"color": PICTURE[None]}, ValueError, r"color: expected BGR .*, got uint8 \(1, 24, 32, 3\)"),
    ({"color": PICTURE[0, 0]}, ValueError, r"color: expected BGR .*, got uint8 \(3,\)"),
    ({"color": PICTURE[:0]}, ValueError, "color: expected an image with pixels"),
    ({"color": PICTURE[:, :0]}, ValueError, "color: expected an image with pixels"),
    ({"depth": METERS, "right": PICTURE}, ValueError, "right: expected together with color"),
    (
        {"color": PICTURE, "right": PICTURE[1:]},
        ValueError,
        r"right: expected the shape of color, \(24, 32, 3\)",
    ),
    (
        {"color": PICTURE, "right": GRAY},
        ValueError,
        r"right: expected the shape of color, .*, got \(24, 32\)",
    ),
    ({"color": PICTURE, "right": FLOATS}, TypeError, "right: expected uint8"),
    (
        {"depth": METERS.astype(np.uint16)},
        ValueError,
        "depth: .*uint16 .*pass depth_scale, 0.001 for millimeters",
    ),
    ({"depth": GRAY}, TypeError, "depth: .*; 8 bits are a picture of the depth"),
    ({"depth": GRAY, "depth_scale": 0.01}, TypeError, "depth: .*; 8 bits are a picture of the depth"),
    ({"depth": PICTURE}, ValueError, "depth: expected one value a pixel.*; a colored depth picture"),
    (
        {"depth": METERS[..., None]},
        ValueError,
        r"depth: expected one value a pixel.*; depth\[:, :, 0\] has that shape",
    ),
    ({"depth": METERS > 1}, TypeError, "depth: expected float32"),
    ({"depth": METERS.astype(np.complex64)}, TypeError, "depth: expected float32"),
    ({"depth": METERS.astype(np.float16)}, TypeError, "depth: expected float32"),
    ({"depth": METERS[:0]}, ValueError, "depth: expected one value a pixel"),
    ({"depth": METERS[0]}, ValueError, "depth: expected one value a pixel"),
    ({"depth": METERS.tolist()}, TypeError, "depth: expected a NumPy array, got list"),
    ({"depth": METERS, "depth_scale": 0}, ValueError, "depth_scale: expected meters per unit above 0, got 0"),
    ({"depth": METERS, "depth_scale": -1.0}, ValueError, "depth_scale: expected meters per unit above 0"),
    ({"depth": METERS, "depth_scale": np.nan}, ValueError, "depth_scale: expected a finite number"),
    ({"depth": METERS, "depth_scale": "mm"}, TypeError, "depth_scale: expected a number"),
    (
        {"color": PICTURE, "timestamp": np.inf},
        ValueError,
        "timestamp: expected a finite number, seconds, got inf",
    ),
    ({"color": PICTURE, "timestamp": "now"}, TypeError, "timestamp: expected a number, seconds, got 'now'"),
    ({"color": PICTURE, "timestamp": True}, TypeError, "timestamp: expected a number, seconds, got True"),
]


@pytest.mark.parametrize(("channels", "error", "message"), BAD)
def test_bad_channels_are_refused(channels: dict[str, Any], error: type[Exception], message: str) -> None:
    """It proves that each bad channel is an error that names it, what was expected and what came."""
    with pytest.raises(error, match=f"^{message}"):
        Frame(**channels)


@pytest.mark.parametrize(
    ("value", "error", "message"),
    [
        (None, TypeError, "image: expected a BGR image or a tricue.Frame, got NoneType .*cv2.imread"),
        ([1, 2], TypeError, "image: expected a BGR image or a tricue.Frame, got list$"),
        (
            cv2.UMat(PICTURE),
            TypeError,
            r"image: expected a BGR image or a tricue.Frame, got UMat; image.get\(\) makes",
        ),
        (FLOATS, TypeError, "image.color: expected uint8"),
        (PICTURE[:0], ValueError, "image.color: expected an image with pixels"),
        (METERS, TypeError, r"image.color: .* got float32 .*; depth comes as tricue.Frame\(depth=image\)$"),
        (
            (1000 * METERS).astype(np.uint16),
            TypeError,
            "image.color: .* got uint16 .*; depth comes as tricue.Frame",
        ),
    ],
)
def test_what_is_no_frame_is_refused(value: Any, error: type[Exception], message: str) -> None:
    """It proves that as_frame names the caller's argument."""
    with pytest.raises(error, match=f"^{message}"):
        as_frame(value, "image")


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_largest_number_is_no_depth(dtype: Any) -> None:
    """It proves that what drivers write for "nothing measured" is missing, without a word about overflow."""
    depth = np.full((6, 8), np.finfo(dtype).max, dtype)
    depth[2, 3] = 1.5
    stored = Frame(depth=depth).depth
    assert stored is not None
    assert np.isfinite(stored).sum() == 1
    depth[2, 3] = depth[0, 0]
    Frame(depth=depth)


def test_a_picture_of_pillow_tells_how_to_convert_it() -> None:
    """It proves that the message has an expression, and that the expression gives the BGR image."""
    pillow = pytest.importorskip("PIL.Image")
    image = pillow.fromarray(np.ascontiguousarray(PICTURE[..., ::-1]))
    hint = "np.asarray(image.convert('RGB'))[..., ::-1]"
    for make in (as_frame, Frame):
        with pytest.raises(TypeError, match=re.escape(f"got Image; {hint} makes a BGR array of it")):
            make(image)
    assert np.array_equal(as_frame(eval(hint)).color, PICTURE)


def test_a_frame_without_depth_may_have_its_scale() -> None:
    """A camera's depth image that was dropped, in a loop that always passes both."""
    frame = Frame(PICTURE, depth=None, depth_scale=0.001)
    assert frame.channels == ("color",)


def test_a_depth_scale_is_in_meters() -> None:
    """It proves that a scale by which no camera measures is refused by name."""
    message = r"depth_scale: expected at most 1000 meters per unit, got 1e\+300; it is 0.001 for millimeters"
    with pytest.raises(ValueError, match=message):
        Frame(depth=np.ones((6, 8), np.uint16), depth_scale=1e300)


def test_a_time_beyond_floats_is_refused() -> None:
    """It proves that a whole number that no float holds is refused by name."""
    with pytest.raises(ValueError, match="timestamp: expected a finite number, seconds, got 1000"):
        Frame(GRAY, timestamp=10**400)


@pytest.mark.parametrize(
    ("timestamp", "unit"),
    [(1.7e12, "milliseconds; divide by 1000"), (1.7e15, "microseconds"), (1_700_000_000 * 10**9, "nano")],
)
def test_timestamps_in_another_unit_are_told(timestamp, unit):
    """Of the clocks of 1970 on, in which drivers have them; they are kept, as any clock is right."""
    with pytest.warns(UserWarning, match=f"timestamp: expected seconds, got .*, which look like {unit}"):
        assert Frame(GRAY, timestamp=timestamp).timestamp == timestamp
    assert Frame(GRAY, timestamp=1.7e9).timestamp == 1.7e9
