# SPDX-License-Identifier: MIT
import struct
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.data.recordings.images import DepthUnits, is_depth, to_color, to_depth
from tricue.data.recordings.messages import ImageMessage

from tests.data.recordings.written import jpeg, png

RNG = np.random.default_rng(3)
SMOOTH = cv2.resize(RNG.integers(0, 255, (4, 5, 3), dtype=np.uint8), (40, 30), interpolation=cv2.INTER_CUBIC)


def message(image: NDArray[Any], encoding: str, padding: int = 0, **other: Any) -> ImageMessage:
    """A raw image, with unused bytes behind each row."""
    height, width = image.shape[:2]
    rows = np.ascontiguousarray(image).reshape(height, -1).view(np.uint8)
    rows = np.pad(rows, ((0, 0), (0, padding)), constant_values=99)
    return ImageMessage(0, "", encoding, rows.ravel(), False, width, height, rows.shape[1], **other)


def packed(data: bytes, form: str) -> ImageMessage:
    """A compressed image."""
    return ImageMessage(0, "", form, np.frombuffer(data, np.uint8), True)


@pytest.mark.parametrize("padding", [0, 7])
@pytest.mark.parametrize(
    ("encoding", "conversion"),
    [
        ("bgr8", None),
        ("8UC3", None),
        ("rgb8", cv2.COLOR_BGR2RGB),
        ("bgra8", cv2.COLOR_BGR2BGRA),
        ("rgba8", cv2.COLOR_BGR2RGBA),
    ],
)
def test_encodings_without_loss(encoding: str, conversion: int | None, padding: int) -> None:
    """It proves that channels come in the order B, G, R, whatever it was, and that padding is left out."""
    image = SMOOTH if conversion is None else cv2.cvtColor(SMOOTH, conversion)
    assert np.array_equal(to_color(message(image, encoding, padding)), SMOOTH)


@pytest.mark.parametrize("encoding", ["mono8", "8UC1"])
def test_gray_images(encoding: str) -> None:
    """It proves that gray becomes three equal channels."""
    assert np.array_equal(to_color(message(SMOOTH[..., 1], encoding)), np.repeat(SMOOTH[..., 1:2], 3, axis=2))


def test_infrared_of_16_bits() -> None:
    """It proves that of 16 bits asked for as color the upper 8 are shown."""
    image = SMOOTH[..., 0].astype(np.uint16) * 256 + 200
    assert np.array_equal(to_color(message(image, "mono16"))[..., 2], SMOOTH[..., 0])


@pytest.mark.parametrize("encoding", ["yuv422", "uyvy", "yuv422_yuy2", "yuyv", "YUYV"])
def test_yuv(encoding: str) -> None:
    """It proves that both orders of YUV 4:2:2 give the color that they were made of, by BT.601's formula."""
    blue, green, red = 60.0, 120.0, 180.0
    y = 16 + (65.738 * red + 129.057 * green + 25.064 * blue) / 256
    u = 128 + (-37.945 * red - 74.494 * green + 112.439 * blue) / 256
    v = 128 + (112.439 * red - 94.154 * green - 18.285 * blue) / 256
    order = (u, y, v, y) if encoding in ("yuv422", "uyvy") else (y, u, y, v)
    image = np.tile(np.round(order).astype(np.uint8).reshape(2, 2), (6, 4, 1))
    found = to_color(message(image, encoding))
    assert found.shape == (6, 8, 3)
    assert np.abs(found - np.array([blue, green, red])).max() <= 2  # rounding of Y, U and V


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
def test_bayer(pattern: str) -> None:
    """It proves that each pattern's pixels are taken for the color that the name says."""
    levels = {"r": 200, "g": 100, "b": 40}
    tile = np.array([levels[letter] for letter in pattern], np.uint8).reshape(2, 2)
    found = to_color(message(np.tile(tile, (8, 8)), f"bayer_{pattern}8"))
    assert np.array_equal(found[4:-4, 4:-4], np.broadcast_to([40, 100, 200], (8, 8, 3)))


@pytest.mark.parametrize("form", ["jpeg", "rgb8; jpeg compressed bgr8"])
def test_jpeg(form: str) -> None:
    """It proves that JPEG comes in BGR, up to its loss."""
    image = cv2.resize(SMOOTH, (320, 240))
    assert np.abs(to_color(packed(jpeg(image), form)).astype(int) - image).mean() < 1


def test_png() -> None:
    """It proves that PNG comes as it was."""
    assert np.array_equal(to_color(packed(png(SMOOTH), "bgr8; png compressed bgr8")), SMOOTH)


METERS = np.array([[0.5, 1.25, 4.0], [7.75, 0.0, 2.5]])


@pytest.mark.parametrize("big_endian", [False, True])
def test_depth_of_16_bits(big_endian: bool) -> None:
    """It proves that 16 bits are millimeters, or the unit that was told, in either order of bytes."""
    units = np.rint(1000 * METERS).astype(">u2" if big_endian else "<u2")
    sent = message(units, "16UC1", padding=2, big_endian=big_endian)
    assert np.allclose(to_depth(sent), METERS, atol=1e-6)
    assert np.allclose(to_depth(sent, DepthUnits(0.00025)), METERS / 4, atol=1e-6)


@pytest.mark.parametrize(("encoding", "type_"), [("32FC1", np.float32), ("64FC1", np.float64)])
def test_depth_of_floats(encoding: str, type_: type[np.floating[Any]]) -> None:
    """It proves that floats are meters, or in the unit that was told for them, and that what isn't finite
    stays so.
    """
    image = METERS.astype(type_)
    image[0, 0] = np.nan
    sent = message(image, encoding)
    for units in (DepthUnits(), DepthUnits(integers=0.1)):
        assert np.array_equal(to_depth(sent, units), image, equal_nan=True)
    millimeters = to_depth(message(1000 * image, encoding), DepthUnits(floats=0.001))
    assert np.allclose(millimeters, image, atol=1e-6, equal_nan=True)
    assert millimeters.dtype == np.float32


def test_compressed_depth_of_16_bits() -> None:
    """It proves that the 12 bytes in front of the PNG are left out."""
    units = np.rint(1000 * METERS).astype(np.uint16)
    data = struct.pack("<iff", 0, 0, 0) + png(units)
    assert np.allclose(to_depth(packed(data, "16UC1; compressedDepth png")), METERS, atol=1e-6)
    assert np.allclose(to_depth(packed(png(units), "16UC1; png compressed")), METERS, atol=1e-6)


def test_compressed_depth_in_meters() -> None:
    """It proves that quantized inverse depth is undone by the parameters in the 12 bytes, and 0 is nothing.

    The quantization is compressed_depth_image_transport's, with its default parameters.
    """
    quantization, farthest = 100.0, 10.0
    quotient = quantization * (quantization + 1)
    offset = 1 - quotient / farthest
    measured = METERS > 0
    units = np.zeros(METERS.shape, np.uint16)
    units[measured] = quotient / METERS[measured] + offset
    data = struct.pack("<iff", 0, quotient, offset) + png(units)
    found = to_depth(packed(data, "32FC1; compressedDepth png"))
    assert np.isnan(found[~measured]).all()
    # a step of the quantized inverse depth is z^2 / quotient
    assert (np.abs(found - METERS)[measured] <= METERS[measured] ** 2 / quotient + 1e-6).all()
    scaled = to_depth(packed(data, "32FC1; compressedDepth png"), DepthUnits(floats=0.5))
    assert np.array_equal(scaled, found / 2, equal_nan=True)


@pytest.mark.parametrize(
    ("encoding", "depth"),
    [("16UC1", True), ("mono16", True), ("32FC1", True), ("bgr8", False), ("mono8", False)],
)
def test_depth_by_encoding(encoding: str, depth: bool) -> None:
    """It proves which encodings hold depth."""
    assert is_depth(message(SMOOTH, encoding)) == depth


@pytest.mark.parametrize(
    ("form", "depth"),
    [("16UC1; compressedDepth png", True), ("16UC1; png compressed ", True), ("jpeg", False), ("", False)],
)
def test_depth_by_format(form: str, depth: bool) -> None:
    """It proves which compressed images hold depth."""
    assert is_depth(packed(b"", form)) == depth


@pytest.mark.parametrize(
    ("sent", "message_"),
    [
        (message(SMOOTH, "nv21"), "the encoding 'nv21' of color isn't known"),
        (message(SMOOTH, "bgr8")._replace(height=31), "an image of 40x31 bgr8 pixels with 3600 bytes"),
        (message(SMOOTH, "bgr8")._replace(width=0), "an image of 0x30"),
        (message(SMOOTH[:, :5, :2], "yuyv"), "yuyv pixels, which share their color in pairs, in rows of 5"),
        (packed(b"no jpeg", "jpeg"), "a compressed image that can't be decoded"),
        (packed(b"", "jpeg"), "a compressed image that can't be decoded"),
    ],
)
def test_broken_color(sent: ImageMessage, message_: str) -> None:
    """It proves that what can't be an image is an error that says what it is."""
    with pytest.raises(ValueError, match=message_):
        to_color(sent)


@pytest.mark.parametrize(
    ("sent", "message_"),
    [
        (message(SMOOTH, "bgr8"), "the encoding 'bgr8' isn't one of depth"),
        (packed(png(SMOOTH), "16UC1; png compressed"), "8 bits are a picture, not meters"),
        (packed(b"12 bytes long", "16UC1; compressedDepth rvl"), "compressed by RVL .* isn't read"),
        (packed(b"short", "16UC1; compressedDepth png"), "a compressedDepth image without pixels"),
    ],
)
def test_broken_depth(sent: ImageMessage, message_: str) -> None:
    """It proves that what can't be depth is an error that says what it is."""
    with pytest.raises(ValueError, match=message_):
        to_depth(sent)
