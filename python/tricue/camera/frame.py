# SPDX-License-Identifier: MIT
"""A frame: the images that cameras took at one moment, by channel."""

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tricue.camera.numbers import finite, positive
from tricue.camera.pose import Pose, as_pose
from tricue.errors import MissingChannelError

MAX_DEPTH = 1e6  # meters; some drivers write the largest number of their type where nothing was measured
MAX_DEPTH_SCALE = 1e3  # meters per unit
MIN_MEDIAN_DEPTH, MAX_MEDIAN_DEPTH = 0.05, 50.0  # meters; beyond, depth is most likely in another unit
MAX_TIMESTAMP = 1e11  # seconds, 3,000 years
SMALLER_UNITS = (("milliseconds", 1e3), ("microseconds", 1e6), ("nanoseconds", 1e9))
_UINT8 = np.dtype(np.uint8)
_CHANNELS = ("color", "depth", "right")


@dataclass(frozen=True, slots=True, eq=False, init=False, repr=False)
class Frame:
    """The images of one moment; color or depth, or both.

    color: uint8, (H, W, 3) in BGR order or gray (H, W). In a stereo pair it is the left image.
    depth: (H, W), meters along the optical axis. float32 and float64 are meters unless ``depth_scale`` is
        given; integers need it. Kept as float32, with NaN where the input is 0, negative, NaN, beyond a
        million meters or masked. Its size may differ from the color image's.
    right: the right image of a rectified stereo pair, with the same shape as ``color``.
    timestamp: seconds of any clock. If two frames are more than a second apart, trackers assume one second.
    pose: the pose, when the frame was taken, of the camera in whose coordinates positions are: a
        :class:`tricue.Pose` or its (4, 4) matrix. It replaces the pose of the tracker's camera, unless None.
    depth_scale: meters per unit of ``depth``, 0.001 for millimeters; not used without ``depth``.

    Color images are not copied if the pixels of each row are contiguous, as in whole arrays and crops. Any
    other layout (mirrored, channels reversed, Fortran order) is copied once. A TypeError or ValueError
    names the channel. Warns (UserWarning) if the median depth is above 50 m, which looks like millimeters, or
    below 5 cm; if all depths are beyond a million meters; and if a timestamp is so large that it looks like
    milliseconds or a smaller unit.
    """

    color: NDArray[np.uint8] | None
    depth: NDArray[np.float32] | None
    right: NDArray[np.uint8] | None
    timestamp: float | None
    pose: Pose | None

    def __init__(
        self,
        color: NDArray[Any] | None = None,
        depth: NDArray[Any] | None = None,
        right: NDArray[Any] | None = None,
        timestamp: float | None = None,
        depth_scale: float | None = None,
        pose: Pose | ArrayLike | None = None,
    ) -> None:
        if color is None and depth is None:
            raise ValueError(
                f"frame: expected color or depth, got {'neither' if right is None else 'right alone'}"
            )
        assign = object.__setattr__  # the dataclass is frozen
        assign(self, "color", None if color is None else _image(color, "color"))
        assign(self, "depth", None if depth is None else _depth(depth, depth_scale))
        assign(self, "right", None if right is None else _right(right, self.color))
        assign(self, "timestamp", None if timestamp is None else as_seconds(timestamp))
        assign(self, "pose", as_pose(pose))

    @property
    def channels(self) -> tuple[str, ...]:
        """The names of the channels that the frame has."""
        return tuple(name for name in _CHANNELS if getattr(self, name) is not None)

    def require(self, *channels: str) -> None:
        """Raise ValueError if the frame lacks one of ``channels``; the error names the first missing one."""
        for name in channels:
            if getattr(self, name) is None:
                got = " and ".join(self.channels)
                raise MissingChannelError(
                    f"frame: expected the channel {name}, which this tracker needs, got {got}", name
                )

    def __repr__(self) -> str:
        words = [f"{name}=<{_described(getattr(self, name))}>" for name in self.channels]
        words += [
            f"{name}={value!r}"
            for name in ("timestamp", "pose")
            if (value := getattr(self, name)) is not None
        ]
        return f"Frame({', '.join(words)})"

    def _repr_html_(self) -> str:
        from tricue.notebook.frames import frame_html

        return frame_html(self)


FrameLike = Frame | NDArray[Any]


def as_frame(value: FrameLike, name: str = "frame") -> Frame:
    """The frame itself, or a frame whose ``color`` is the given image array.

    TypeError or ValueError for anything else; ``name`` is the argument that the message names.
    """
    if isinstance(value, Frame):
        return value
    if not isinstance(value, np.ndarray):
        got = f"{type(value).__name__}{_conversion(value)}"
        raise TypeError(f"{name}: expected a BGR image or a tricue.Frame, got {got}")
    try:
        return Frame(value)
    except (TypeError, ValueError) as error:
        depth = value.ndim == 2 and value.dtype.kind in "iuf" and value.dtype.itemsize > 1
        hint = "; depth comes as tricue.Frame(depth=image)" if depth else ""
        raise type(error)(f"{name}.{error}{hint}") from None


def _conversion(value: Any) -> str:
    """A hint about an object that isn't an array: its likely origin, or how to convert it; "" without one."""
    if value is None:
        return " (cv2.imread and VideoCapture.read give None for what they can't read)"
    kind = type(value)
    if kind.__module__.partition(".")[0] == "PIL":
        return "; np.asarray(image.convert('RGB'))[..., ::-1] makes a BGR array of it"
    return "; image.get() makes an array of it" if kind.__name__ == "UMat" else ""


def _levels(image: NDArray[Any]) -> str:
    """How to make gray levels of an image's values."""
    if image.dtype.kind == "f":
        return "; (255 * image).astype(np.uint8) converts values from 0 to 1"
    if image.dtype == np.uint16:
        return "; (image >> 8).astype(np.uint8) converts values from 0 to 65535"
    return ""


def _image(value: Any, name: str) -> NDArray[np.uint8]:
    if not isinstance(value, np.ndarray):
        got = f"{type(value).__name__}{_conversion(value)}"
        raise TypeError(f"{name}: expected a NumPy array, uint8, got {got}")
    if value.dtype != _UINT8:
        hint = _levels(value) if value.ndim == 3 else ""
        raise TypeError(f"{name}: expected uint8 values from 0 to 255, got {_described(value)}{hint}")
    image: NDArray[np.uint8] = value[:, :, 0] if value.ndim == 3 and value.shape[2] == 1 else value
    if image.ndim not in (2, 3) or (image.ndim == 3 and image.shape[2] != 3):
        alpha = "; image[:, :, :3] drops the alpha channel" if value.shape[2:] == (4,) else ""
        raise ValueError(f"{name}: expected BGR (H, W, 3) or gray (H, W), got {_described(value)}{alpha}")
    if image.size == 0:
        raise ValueError(f"{name}: expected an image with pixels, got {_described(value)}")
    return image if _is_packed(image) else image.copy(order="C")


def _is_packed(image: NDArray[np.uint8]) -> bool:
    """Whether pixels are contiguous in each row, and rows are in order; rows may be padded, as in a crop."""
    row_stride, *strides = image.strides
    row_bytes = image.size // image.shape[0]
    return row_stride >= row_bytes and strides == ([3, 1] if image.ndim == 3 else [1])


def _right(value: Any, color: NDArray[np.uint8] | None) -> NDArray[np.uint8]:
    right = _image(value, "right")
    if color is None:
        raise ValueError("right: expected together with color, the left image of the stereo pair")
    if right.shape != color.shape:
        raise ValueError(f"right: expected the shape of color, {color.shape}, got {right.shape}")
    return right


def _depth(value: Any, scale: float | None) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):
        meters: NDArray[np.float32] = _measurements(value, scale).astype(np.float32, order="C")
        if scale is not None:
            meters *= np.float32(_checked_scale(scale))
    sample = meters[:: max(1, meters.shape[0] // 32), :: max(1, meters.shape[1] // 32)].copy()
    meters[~((meters > 0) & (meters <= MAX_DEPTH))] = np.nan
    _warn_of_unit(sample, scale)
    return meters


def _checked_scale(scale: Any) -> float:
    number = positive(scale, "depth_scale", "meters per unit")
    if number > MAX_DEPTH_SCALE:
        raise ValueError(
            f"depth_scale: expected at most {MAX_DEPTH_SCALE:g} meters per unit, got {scale!r:.80}; "
            "it is 0.001 for millimeters"
        )
    return number


def _shape_hint(depth: NDArray[Any]) -> str:
    if depth.ndim != 3:
        return ""
    one_channel = depth.shape[2] == 1  # as some cameras' libraries give it
    return "; depth[:, :, 0] has that shape" if one_channel else "; a colored depth picture holds no meters"


def _measurements(value: Any, scale: float | None) -> NDArray[Any]:
    if isinstance(value, np.ma.MaskedArray):
        value = value.filled(0)
    if not isinstance(value, np.ndarray):
        raise TypeError(f"depth: expected a NumPy array, got {type(value).__name__}")
    if value.ndim != 2 or value.size == 0:
        raise ValueError(
            f"depth: expected one value a pixel, (H, W), got {_described(value)}{_shape_hint(value)}"
        )
    if value.dtype.kind in "iu" and value.dtype.itemsize > 1:
        if scale is None:
            hint = "pass depth_scale, 0.001 for millimeters"
            raise ValueError(
                f"depth: expected depth_scale with integers, got {_described(value)} alone; {hint}"
            )
    elif value.dtype.kind != "f" or value.dtype.itemsize not in (4, 8):
        eight = (
            "; 8 bits are a picture of the depth, not meters"
            if value.dtype.itemsize == 1 and value.dtype.kind != "b"
            else ""
        )
        expected = "float32 or float64 meters, or integers with depth_scale"
        raise TypeError(f"depth: expected {expected}, got {_described(value)}{eight}")
    return value


def _warn_of_unit(sample: NDArray[np.float32], scale: float | None) -> None:
    measured = sample[(sample > 0) & (sample <= MAX_DEPTH)]
    message = _unit_problem(measured, scale) if measured.size else _loss(sample)
    if message:
        warnings.warn(f"depth: {message}", UserWarning, stacklevel=4)  # at the line with Frame(...)


def _unit_problem(measured: NDArray[np.float32], scale: float | None) -> str:
    """What seems wrong with the unit of depth; "" if nothing does."""
    median = float(np.median(measured))
    if MIN_MEDIAN_DEPTH <= median <= MAX_MEDIAN_DEPTH:
        return ""
    if scale is not None:
        why = f"a wrong depth_scale, {scale:g} meters per unit"
    elif median > MAX_MEDIAN_DEPTH:
        why = "millimeters; pass depth_scale=0.001"
    else:
        why = "another unit than meters; pass depth_scale, the meters per unit"
    about = float(f"{median:.1g}")  # the same in most frames, as Python shows each text of a line only once
    return f"its median is about {about:g} m, which looks like {why}"


def _loss(sample: NDArray[np.float32]) -> str:
    """Why no depth is left; "" if nothing was measured, for which drivers write one large number."""
    far = sample[(sample > MAX_DEPTH) & np.isfinite(sample)]
    if not far.size or far.min() == far.max():
        return ""
    return (
        f"all values are beyond {MAX_DEPTH:g} m and count as not measured; depth_scale is the meters per "
        "unit, 0.001 for millimeters"
    )


def as_seconds(timestamp: Any) -> float:
    """A timestamp as a float; warns, at the line that calls the caller, if it looks like a smaller unit."""
    seconds = finite(timestamp, "timestamp", "seconds")
    if seconds > MAX_TIMESTAMP:
        unit, scale = next(
            (each for each in SMALLER_UNITS if seconds <= each[1] * MAX_TIMESTAMP), SMALLER_UNITS[-1]
        )
        message = (
            f"timestamp: expected seconds, got {seconds:.4g}, which look like {unit}; divide by {scale:g}"
        )
        warnings.warn(message, UserWarning, stacklevel=3)
    return seconds


def _described(array: NDArray[Any]) -> str:
    return f"{array.dtype} {array.shape}"
