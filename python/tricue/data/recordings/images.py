# SPDX-License-Identifier: MIT
"""Image messages as arrays: color in BGR, depth in meters."""

import struct
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.data.recordings.messages import ImageMessage

DEPTH_ENCODINGS = {"16UC1", "mono16", "32FC1", "64FC1", "Z16"}

_HEADER = struct.Struct("<iff")  # before the PNG of a compressedDepth: its format, and two parameters
_TO_BGR: dict[str, int | None] = {  # cv2's conversion for encodings with one byte per channel
    "bgr8": None,
    "8UC3": None,
    "rgb8": cv2.COLOR_RGB2BGR,
    "bgra8": cv2.COLOR_BGRA2BGR,
    "8UC4": cv2.COLOR_BGRA2BGR,
    "rgba8": cv2.COLOR_RGBA2BGR,
    "mono8": cv2.COLOR_GRAY2BGR,
    "8UC1": cv2.COLOR_GRAY2BGR,
    "bayer_rggb8": cv2.COLOR_BayerRGGB2BGR,
    "bayer_bggr8": cv2.COLOR_BayerBGGR2BGR,
    "bayer_gbrg8": cv2.COLOR_BayerGBRG2BGR,
    "bayer_grbg8": cv2.COLOR_BayerGRBG2BGR,
    "yuv422": cv2.COLOR_YUV2BGR_UYVY,
    "uyvy": cv2.COLOR_YUV2BGR_UYVY,
    "yuv422_yuy2": cv2.COLOR_YUV2BGR_YUY2,
    "yuyv": cv2.COLOR_YUV2BGR_YUY2,
    "YUYV": cv2.COLOR_YUV2BGR_YUY2,
}
_CHANNELS = {"8UC4": 4, "bgra8": 4, "rgba8": 4, "8UC3": 3, "bgr8": 3, "rgb8": 3}
_TWO_BYTES = {"yuv422", "uyvy", "yuv422_yuy2", "yuyv", "YUYV"}


class DepthUnits(NamedTuple):
    """Meters per unit of recorded depth, by pixel type; by default those of ROS's REP 118."""

    integers: float = 0.001
    floats: float = 1.0

    def of(self, message: ImageMessage) -> float:
        """The unit of a depth image with this encoding."""
        return self.floats if holds_floats(message) else self.integers


ROS_UNITS = DepthUnits()


def is_depth(message: ImageMessage) -> bool:
    """Whether the image's encoding is that of a depth image."""
    if message.compressed:
        form = message.encoding
        return "compressedDepth" in form or form.split(";")[0].strip() in ("16UC1", "32FC1")
    return message.encoding in DEPTH_ENCODINGS


def holds_floats(message: ImageMessage) -> bool:
    """Whether the pixels of a depth image are floats, by its encoding."""
    return message.encoding.lstrip().startswith(("32FC1", "64FC1"))


def to_color(message: ImageMessage) -> NDArray[np.uint8]:
    """The image (H, W, 3), BGR; ValueError for an unknown encoding, or one without color."""
    if message.compressed:
        return np.asarray(_decoded(message.data, cv2.IMREAD_COLOR), np.uint8)
    encoding = message.encoding
    if encoding in ("mono16", "16UC1"):  # from an infrared camera
        return np.asarray(cv2.cvtColor((_pixels(message, 2) >> 8).astype(np.uint8), cv2.COLOR_GRAY2BGR))
    if encoding not in _TO_BGR:
        raise ValueError(f"the encoding {encoding!r} of color isn't known")
    channels = 2 if encoding in _TWO_BYTES else _CHANNELS.get(encoding, 1)
    if channels == 2 and message.width % 2:
        raise ValueError(f"{encoding} pixels, which share their color in pairs, in rows of {message.width}")
    rows = _rows(message, channels)
    image = rows.reshape(message.height, message.width, channels)[..., slice(None) if channels > 1 else 0]
    conversion = _TO_BGR[encoding]
    if conversion is None:
        return np.array(image)  # a copy, because it is a view of the message
    return np.asarray(cv2.cvtColor(np.ascontiguousarray(image), conversion), np.uint8)


def to_depth(message: ImageMessage, units: DepthUnits = ROS_UNITS) -> NDArray[np.float32]:
    """The depth (H, W), meters, 0 or NaN where nothing was measured.

    ValueError if the encoding isn't one of depth.
    """
    if message.compressed:
        return _compressed_depth(message, units)
    sizes = {"16UC1": 2, "mono16": 2, "Z16": 2, "32FC1": 4, "64FC1": 8}
    if message.encoding not in sizes:
        raise ValueError(f"the encoding {message.encoding!r} isn't one of depth")
    return _meters(_pixels(message, sizes[message.encoding]), units)


def _meters(image: NDArray[Any], units: DepthUnits) -> NDArray[np.float32]:
    if image.dtype.kind == "f":
        return np.asarray(units.floats * image, np.float32)
    if image.dtype != np.uint16 or image.ndim != 2:
        raise ValueError(f"a depth image of {image.dtype} {image.shape}; 8 bits are a picture, not meters")
    meters: NDArray[np.float32] = image * np.float32(units.integers)
    return meters


def _compressed_depth(message: ImageMessage, units: DepthUnits) -> NDArray[np.float32]:
    """Depth from ROS's compressed_depth_image_transport: plain 16 bits, or quantized inverse depth."""
    form = message.encoding
    if "compressedDepth" not in form:
        return _meters(_decoded(message.data, cv2.IMREAD_UNCHANGED), units)
    if "rvl" in form.lower():
        raise ValueError(f"depth compressed by RVL ({form!r}) isn't read; record PNG or raw images")
    if len(message.data) <= _HEADER.size:
        raise ValueError("a compressedDepth image without pixels")
    _, quotient, offset = _HEADER.unpack(message.data[: _HEADER.size].tobytes())
    image = _decoded(message.data[_HEADER.size :], cv2.IMREAD_UNCHANGED)
    if not holds_floats(message):
        return _meters(image, units)
    with np.errstate(divide="ignore"):
        return _meters(np.where(image > 0, quotient / (image.astype(np.float64) - offset), np.nan), units)


def _decoded(data: NDArray[np.uint8], flag: int) -> NDArray[Any]:
    try:
        image = cv2.imdecode(data, flag) if data.size else None
    except cv2.error:
        image = None
    if image is None:
        raise ValueError("a compressed image that can't be decoded")
    return np.asarray(image)


def _rows(message: ImageMessage, bytes_per_pixel: int) -> NDArray[np.uint8]:
    """The bytes of the rows, without the padding after each row's last pixel."""
    width = message.width * bytes_per_pixel
    step = message.step or width
    if min(message.width, message.height) < 1 or step < width or len(message.data) < step * message.height:
        raise ValueError(
            f"an image of {message.width}x{message.height} {message.encoding} pixels with "
            f"{len(message.data)} bytes"
        )
    return message.data[: step * message.height].reshape(message.height, step)[:, :width]


def _pixels(message: ImageMessage, size: int) -> NDArray[Any]:
    """Pixels of one channel with 2, 4 or 8 bytes: integers or floats, in this machine's byte order."""
    order, kind = ">" if message.big_endian else "<", "u" if size == 2 else "f"
    rows = np.ascontiguousarray(_rows(message, size))
    return rows.view(np.dtype(f"{order}{kind}{size}")).astype(np.dtype(f"{kind}{size}"), copy=False)
