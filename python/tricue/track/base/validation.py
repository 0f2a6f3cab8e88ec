# SPDX-License-Identifier: MIT
"""Checks of arguments that every tracker makes before it changes its state."""

from numbers import Integral
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.errors import BoxError, BoxNeededError, UnregisteredDepthError
from tricue.track.base.params import Params

State = TypeVar("State")
P = TypeVar("P", bound=Params)

DEFAULT_BASELINE = 0.12  # meters, assumed for an unknown stereo rig
MAX_FRAME_INTERVAL = 1.0  # seconds; longer gaps are clamped
ADDED_TIME_ERROR = 1e-6  # seconds, rounding error of summed frame times
MIN_FRAME_INTERVAL = 1e-6  # seconds; for shorter intervals velocities would diverge
DEFAULT_FIELD_OF_VIEW = 60.0  # degrees, horizontal, assumed for an unknown camera


def color_image(
    frame: FrameLike, shape: tuple[int, ...] | None = None
) -> tuple[NDArray[np.uint8], float | None]:
    """The frame's BGR image, (H, W, 3), and its timestamp. ValueError for a gray image, and for a shape
    other than the first frame's.
    """
    channels = as_frame(frame)
    channels.require("color")
    return _bgr(channels.color, shape, None), channels.timestamp


def _bgr(
    image: Any, shape: tuple[int, ...] | None, camera: StereoRig | Intrinsics | None
) -> NDArray[np.uint8]:
    """The image itself. ValueError for a gray one, and for a shape other than the first frame's."""
    if image.ndim != 3:
        hint = "cv2.cvtColor(image, cv2.COLOR_GRAY2BGR) makes one"
        raise ValueError(f"frame.color: expected BGR (H, W, 3), got gray {image.shape}; {hint}")
    if shape is not None and image.shape != shape:
        raise changed_size("frame.color", "shape", shape, image.shape, camera)
    bgr: NDArray[np.uint8] = image
    return bgr


def changed_size(
    name: str,
    what: str,
    first: tuple[int, ...],
    found: tuple[int, ...],
    camera: StereoRig | Intrinsics | None,
) -> ValueError:
    """The error for a frame that isn't as large as the first one. what: "shape" or "size".

    camera: the tracker's, because ``init`` takes only its size.
    """
    hint = "init starts again on another size"
    if camera is not None and found[:2] != first[:2]:
        hint = "this tracker's camera has that size, so another size needs another tracker"
    return ValueError(f"{name}: expected the first frame's {what} {first}, got {found}; {hint}")


def seed(value: int) -> int:
    """The seed itself; TypeError for anything but a whole number, ValueError for one below 0."""
    if not isinstance(value, Integral) or isinstance(value, bool):
        raise TypeError(f"seed: expected a whole number, got {value!r:.80}")
    if value < 0:
        raise ValueError(f"seed: expected 0 or more, got {value}")
    return int(value)


def initial_box(given: BoxLike | None, shape: tuple[int, ...]) -> Box:
    """The box to start on; BoxNeededError if none is given, ValueError as :func:`check_box_in`."""
    if given is None:
        raise BoxNeededError(
            "box: expected (x, y, width, height), got None; this tracker needs an initial box"
        )
    return check_box_in(as_box(given), shape)


def check_box_in(box: Box, shape: tuple[int, ...]) -> Box:
    """The box itself. BoxError if it is less than 2 pixels wide or high, or entirely outside an image of that
    shape.
    """
    height, width = shape[:2]
    if min(box.width, box.height) < 2:
        raise BoxError(f"box: expected at least 2 pixels of width and height, got {tuple(box)}")
    if box.clip(width, height).area <= 0:
        raise BoxError(f"box: expected a part inside the image of {width}x{height} pixels, got {tuple(box)}")
    return box


def require_initialized(state: State | None) -> State:
    """The state; RuntimeError if there is none yet, before ``init``."""
    if state is None:
        raise RuntimeError("update: expected init first, with a frame and a box")
    return state


def depth_image(
    frame: FrameLike, shape: tuple[int, ...] | None = None, camera: Intrinsics | None = None
) -> tuple[NDArray[np.float32], float | None]:
    """The frame's depth, (H, W) float32 meters with NaN, and its timestamp. ValueError for a shape other than
    the first frame's. camera: the tracker's, for the error.
    """
    channels = as_frame(frame)
    channels.require("depth")
    depth: Any = channels.depth
    if shape is not None and depth.shape != shape:
        raise changed_size("frame.depth", "shape", shape, depth.shape, camera)
    return depth, channels.timestamp


def stereo_pair(
    frame: FrameLike, shape: tuple[int, ...] | None = None, stereo: StereoRig | None = None
) -> tuple[NDArray[np.uint8], NDArray[np.uint8], float | None]:
    """The frame's left image, BGR (H, W, 3), its right image, gray if the left one was, and its timestamp.

    ValueError as :func:`color_image`, and if there is no right image. stereo: the tracker's, for the error.
    """
    channels = as_frame(frame)
    channels.require("color", "right")
    right: Any = channels.right
    return _bgr(channels.color, shape, stereo), right, channels.timestamp


def check_depth_size(depth: NDArray[np.float32], size: tuple[int, ...]) -> None:
    """UnregisteredDepthError for depth of another size than color's, (height, width)."""
    if depth.shape == size:
        return
    register = (
        "tricue.camera.registration.Registration brings it there by both cameras' intrinsics, Reprojection "
        "by where they stand to each other as well"
    )
    resize = (
        f"cv2.resize(depth, {size[::-1]}, interpolation=cv2.INTER_NEAREST) does where the views are the same"
    )
    raise UnregisteredDepthError(
        f"frame.depth: expected shape {size}, got {depth.shape}; it has to be that of the color image's "
        f"pixels: {register}, {resize}"
    )


def elapsed(before: float | None, now: float | None, rate: float) -> float:
    """Seconds between two timestamps, or 1 / rate (frames/s) if they are missing or don't increase."""
    if before is None or now is None or now - before < MIN_FRAME_INTERVAL:
        return min(1 / rate, MAX_FRAME_INTERVAL)
    return min(now - before, MAX_FRAME_INTERVAL)


def rig(value: StereoRig | None) -> StereoRig | None:
    """The rig itself; TypeError for anything else."""
    if value is not None and not isinstance(value, StereoRig):
        raise TypeError(f"rig: expected tricue.StereoRig, got {type(value).__name__}")
    return value


def rig_or_default(value: StereoRig | None, shape: tuple[int, ...], channel: str = "color") -> StereoRig:
    """The rig, or a default one if None. ValueError if its size isn't that of the named channel."""
    height, width = shape[:2]
    if value is None:
        return StereoRig(Intrinsics.from_fov(width, height, DEFAULT_FIELD_OF_VIEW), DEFAULT_BASELINE)
    camera = value.intrinsics
    if (camera.width, camera.height) != (width, height):
        expected = f"the rig's size, {camera.width}x{camera.height}"
        raise ValueError(f"frame.{channel}: expected {expected}, got {width}x{height}")
    return value


def intrinsics(value: Intrinsics | None) -> Intrinsics | None:
    """The camera itself; TypeError for anything else."""
    if value is not None and not isinstance(value, Intrinsics):
        raise TypeError(f"intrinsics: expected tricue.Intrinsics, got {type(value).__name__}")
    return value


def camera_or_default(
    camera: Intrinsics | None, shape: tuple[int, ...], channel: str = "depth"
) -> Intrinsics:
    """The camera, or a default one if None. ValueError as :func:`rig_or_default`."""
    height, width = shape[:2]
    if camera is None:
        return Intrinsics.from_fov(width, height, DEFAULT_FIELD_OF_VIEW)
    if (camera.width, camera.height) != (width, height):
        expected = f"the camera's size, {camera.width}x{camera.height}"
        hint = f"the intrinsics are those of the {channel} image"
        raise ValueError(f"frame.{channel}: expected {expected}, got {width}x{height}; {hint}")
    return camera


def cameras(
    stereo: StereoRig | None, single: Intrinsics | None
) -> tuple[StereoRig | None, Intrinsics | None]:
    """A stereo rig or a single camera's intrinsics, unchanged. TypeError for both, and for other types."""
    known = rig(stereo), intrinsics(single)
    if None not in known:
        raise TypeError("intrinsics: expected without rig, whose intrinsics are those of the left camera")
    return known


def parameters(kind: type[P], params: P | None, values: dict[str, Any]) -> P:
    """The parameters, given as one object or one by one; TypeError for both."""
    if params is not None and values:
        raise TypeError(f"params: expected alone, got also {', '.join(values)}")
    if params is not None and not isinstance(params, kind):
        raise TypeError(f"params: expected {kind.__name__}, got {type(params).__name__}")
    return kind(**values) if params is None else params
