# SPDX-License-Identifier: MIT
"""Messages as values: images, cameras and transforms, whether ROS or Foxglove wrote them, in any encoding."""

import base64
import json
import re
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from tricue.data.recordings.container import Topic
from tricue.data.recordings.protobuf import SCHEMAS, read_message
from tricue.doctor.install import install_extra

IMAGES = {"Image", "RawImage", "CompressedImage"}
CAMERAS = {"CameraInfo", "CameraCalibration"}
TRANSFORMS = {"TFMessage", "FrameTransform", "FrameTransforms"}
T = TypeVar("T")
Decoder = Callable[[bytes], Any]
_ROS_TYPE = re.compile(r"[A-Za-z]\w*/msg/[A-Za-z]\w*", re.ASCII)


class ImageMessage(NamedTuple):
    """An image as it was recorded.

    time: of the exposure, nanoseconds; 0 if unknown. frame: the camera's coordinate frame. encoding: the
    layout of the pixels; for a compressed image, its format. step: bytes per row.
    """

    time: int
    frame: str
    encoding: str
    data: NDArray[np.uint8]
    compressed: bool
    width: int = 0
    height: int = 0
    step: int = 0
    big_endian: bool = False


class CameraMessage(NamedTuple):
    """A camera_info: K (9,), R (9,) and P (12,) row by row, D the distortion coefficients."""

    frame: str
    width: int
    height: int
    model: str
    d: tuple[float, ...]
    k: tuple[float, ...]
    r: tuple[float, ...]
    p: tuple[float, ...]


class Transform(NamedTuple):
    """A coordinate frame's pose in its parent: p_parent = R p_child + t. rotation: quaternion x, y, z, w."""

    parent: str
    child: str
    translation: tuple[float, ...]
    rotation: tuple[float, ...]


def decoder(topic: Topic) -> Decoder:
    """A function that turns a message of this topic into an object or a dictionary of its fields.

    ValueError, here or when it is called, for messages that can't be read.
    """
    if topic.encoding == "json":
        return json.loads
    if topic.encoding == "protobuf":
        if topic.kind not in SCHEMAS:
            raise ValueError(f"the protobuf type {topic.type} isn't known")
        schema = SCHEMAS[topic.kind]
        return lambda data: read_message(data, schema)
    if topic.encoding in ("ros1", "cdr"):
        return _ros_decoder(topic)
    raise ValueError(f"the encoding {topic.encoding!r} isn't known")


def _typed(convert: Callable[..., T]) -> Callable[..., T]:
    """Make a conversion raise ValueError also for fields of the wrong type, which JSON may have, such as null
    for NaN.
    """

    @wraps(convert)
    def typed(message: Any, *arguments: Any) -> T:
        try:
            return convert(message, *arguments)
        except (TypeError, OverflowError) as error:
            raise ValueError(f"a message with a field of another type ({error})") from None

    return typed


@_typed
def to_image(message: Any) -> ImageMessage:
    """The values of an Image, a RawImage or a CompressedImage."""
    header = _field(message, "header", default=message)
    time = _nanoseconds(_field(header, "stamp", "timestamp"))
    frame = str(_field(header, "frame_id", default="")).lstrip("/")
    data = _bytes(_field(message, "data"))
    form = _field(message, "format", default=None)
    if form is not None:
        return ImageMessage(time, frame, str(form), data, compressed=True)
    width, height, step = (int(_field(message, name)) for name in ("width", "height", "step"))
    big = bool(_field(message, "is_bigendian", default=False))
    encoding = str(_field(message, "encoding"))
    return ImageMessage(time, frame, encoding, data, False, width, height, step, big)


@_typed
def to_camera(message: Any) -> CameraMessage:
    """The values of a CameraInfo or a CameraCalibration."""
    header = _field(message, "header", default=message)
    return CameraMessage(
        str(_field(header, "frame_id", default="")).lstrip("/"),
        int(_field(message, "width")),
        int(_field(message, "height")),
        str(_field(message, "distortion_model", default="")),
        *(_numbers(_field(message, *names)) for names in (("d", "D"), ("k", "K"), ("r", "R"), ("p", "P"))),
    )


@_typed
def to_transforms(message: Any) -> list[Transform]:
    """The transforms of a TFMessage, of a FrameTransforms, or the one of a FrameTransform."""
    return [_transform(each) for each in _field(message, "transforms", default=[message])]


@_typed
def to_transform(message: Any, parent: str, child: str) -> Transform:
    """The values of a bare geometry_msgs/Transform."""
    place, turn = _field(message, "translation"), _field(message, "rotation")
    return Transform(parent, child, _parts(place, "xyz"), _parts(turn, "xyzw"))


def _transform(message: Any) -> Transform:
    header = _field(message, "header", default=message)
    parent = str(_field(header, "frame_id", "parent_frame_id")).lstrip("/")
    child = str(_field(message, "child_frame_id")).lstrip("/")
    return to_transform(_field(message, "transform", default=message), parent, child)


def _parts(vector: Any, names: str) -> tuple[float, ...]:
    return tuple(float(_field(vector, name)) for name in names)


def _nanoseconds(time: Any) -> int:
    seconds = int(_field(time, "sec", "seconds", "secs"))
    return seconds * 10**9 + int(_field(time, "nanosec", "nsec", "nanos", "nsecs"))


def _numbers(values: Sequence[Any] | None) -> tuple[float, ...]:
    """The numbers of a list; Go writes an empty one to JSON as null."""
    return () if values is None else tuple(float(value) for value in values)


def _bytes(data: Any) -> NDArray[np.uint8]:
    """The bytes of an image, which JSON holds in base64."""
    if isinstance(data, str):
        data = base64.b64decode(data)
    return np.frombuffer(data, np.uint8) if isinstance(data, bytes) else np.ravel(np.asarray(data, np.uint8))


_NOTHING = object()


def _field(message: Any, *names: str, default: Any = _NOTHING) -> Any:
    """The first of these fields that the message has."""
    for name in names:
        found = message.get(name, _NOTHING) if isinstance(message, dict) else getattr(message, name, _NOTHING)
        if found is not _NOTHING:
            return found
    if default is _NOTHING:
        raise ValueError(f"a message without the field {names[0]}")
    return default


def _ros_decoder(topic: Topic) -> Decoder:
    """It decodes with the recording's own type definition, or, without one, with ROS's newest."""
    try:
        from rosbags.serde import SerdeError
        from rosbags.typesys import Stores, TypesysError, get_typestore
    except ImportError:
        raise ImportError(f"ROS's messages need the package rosbags: {install_extra('recordings')}") from None
    ros1 = topic.encoding == "ros1"
    kind = topic.type if "/msg/" in topic.type else topic.type.replace("/", "/msg/", 1)
    if not _ROS_TYPE.fullmatch(kind):  # rosbags turns it into Python code
        raise ValueError(f"{topic.type!r:.60} can't be the name of a type")
    try:
        store = get_typestore(Stores.EMPTY)
        store.register(_ros_types(topic, kind))
        store.get_msgdef(kind)
    except (KeyError, TypesysError):
        store = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.LATEST)
    if kind not in store.fielddefs:
        raise ValueError(f"the type {topic.type} isn't known, and the recording doesn't define it")
    read = store.deserialize_ros1 if ros1 else store.deserialize_cdr

    def decode(data: bytes) -> Any:
        try:
            return read(data, kind)
        except (SerdeError, AssertionError, IndexError, UnicodeDecodeError) as error:
            raise ValueError(f"a message that isn't {kind} ({error})") from None

    return decode


def _ros_types(topic: Topic, kind: str) -> Any:
    """rosbags' types from the topic's definition."""
    from rosbags.typesys import get_types_from_idl, get_types_from_msg

    if not topic.idl:
        return get_types_from_msg(topic.definition, kind) if topic.definition else {}
    types: dict[str, Any] = {}
    for part in topic.definition.split("=" * 80 + "\n"):
        text = part.split("\n", 1)[1] if part.startswith("IDL: ") else part
        types |= get_types_from_idl(text) if text.strip() else {}
    return types
