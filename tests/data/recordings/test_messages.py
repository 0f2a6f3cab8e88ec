# SPDX-License-Identifier: MIT
import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tricue.data.recordings.container import Topic
from tricue.data.recordings.messages import decoder, to_camera, to_image, to_transforms
from tricue.data.recordings.protobuf import SCHEMAS, read_message

from tests.data.recordings.written import START, color

K = [300.0, 0.0, 15.5, 0.0, 301.0, 11.5, 0.0, 0.0, 1.0]
IMAGE = color(7)
FIELDS: dict[str, dict[str, Any]] = {
    "RawImage": {
        "timestamp": {"seconds": 1_700_000_000, "nanos": 250},
        "frame_id": "lens",
        "width": 32,
        "height": 24,
        "encoding": "bgr8",
        "step": 96,
        "data": IMAGE.tobytes(),
    },
    "CompressedImage": {
        "timestamp": {"seconds": 1_700_000_000, "nanos": 250},
        "frame_id": "lens",
        "data": b"\x00\x01\xff",
        "format": "jpeg",
    },
    "CameraCalibration": {
        "timestamp": {"seconds": 1, "nanos": 0},
        "frame_id": "lens",
        "width": 32,
        "height": 24,
        "distortion_model": "plumb_bob",
        "D": [0.1, -0.2, 0.0, 0.0, 0.0],
        "K": K,
        "R": [],
        "P": [300.0, 0, 15.5, -36.0, 0, 301.0, 11.5, 0, 0, 0, 1, 0],
    },
    "FrameTransform": {
        "timestamp": {"seconds": 1, "nanos": 0},
        "parent_frame_id": "body",
        "child_frame_id": "lens",
        "translation": {"x": 0.1, "y": -0.2, "z": 0.3},
        "rotation": {"x": 0.0, "y": 0.0, "z": 0.6, "w": 0.8},
    },
}


def varint(value: int) -> bytes:
    """Seven bits a byte, the lowest first; the highest bit says that more follow."""
    head, rest = value & 0x7F, value >> 7
    return bytes([head | 0x80]) + varint(rest) if rest else bytes([head])


def encode(values: dict[str, Any], schema: Any) -> bytes:
    """The message as the documentation of Protocol Buffers says; integers of images are fixed32."""
    data = b""
    for number, (name, kind) in schema.items():
        value = values.get(name)
        if kind == "int" and name in ("seconds", "nanos"):
            data += varint(number << 3) + varint(value or 0)
        elif kind == "int":
            data += varint(number << 3 | 5) + struct.pack("<I", value)
        elif kind == "double":
            data += varint(number << 3 | 1) + struct.pack("<d", value)
        else:
            for content in value if isinstance(kind, list) else [value]:
                data += varint(number << 3 | 2) + sized(content, kind[0] if isinstance(kind, list) else kind)
    return data


def sized(value: Any, kind: Any) -> bytes:
    """A string, bytes, packed doubles or a message, behind its length."""
    if kind == "doubles":
        content = struct.pack(f"<{len(value)}d", *value)
    elif kind == "string":
        content = value.encode()
    else:
        content = value if kind == "bytes" else encode(value, kind)
    return varint(len(content)) + content


@pytest.mark.parametrize("name", FIELDS)
def test_protobuf(name: str) -> None:
    """It proves that a message that was written by the rules of the encoding is read as it was."""
    assert read_message(encode(FIELDS[name], SCHEMAS[name]), SCHEMAS[name]) == FIELDS[name]


@pytest.mark.parametrize("name", FIELDS)
def test_protobuf_by_its_own_library(name: str) -> None:
    """It proves that what Google's library wrote, from Foxglove's schema, is read as it was."""
    pytest.importorskip("google.protobuf", reason="needs the package protobuf")
    schema = SCHEMAS[name]
    assert read_message(google_message(name, schema, FIELDS[name]), schema) == FIELDS[name]


def google_message(name: str, schema: Any, values: dict[str, Any]) -> bytes:
    """The message, serialized by Google's library."""
    from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

    file = descriptor_pb2.FileDescriptorProto(name="foxglove.proto", package="foxglove", syntax="proto3")
    describe(file, name, schema)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    made = message_factory.GetMessageClass(pool.FindMessageTypeByName(f"foxglove.{name}"))()
    fill(made, values)
    content: bytes = made.SerializeToString()
    return content


def describe(file: Any, name: str, schema: Any) -> None:
    """Add the type of a message, and those of its fields, to a file of Google's descriptors."""
    message = file.message_type.add(name=name)
    for number, (field, kind) in schema.items():
        added = message.field.add(name=field, number=number, label=1)
        if isinstance(kind, dict):
            added.type, added.type_name = 11, f".foxglove.{name}_{field}"
            describe(file, f"{name}_{field}", kind)
        elif kind == "doubles":
            added.type, added.label = 1, 3
        elif kind == "int":
            added.type = {"seconds": 3, "nanos": 5}.get(field, 7)  # int64, int32, fixed32
        else:
            added.type = {"double": 1, "string": 9, "bytes": 12}[kind]


def fill(message: Any, values: dict[str, Any]) -> None:
    """Set the fields of Google's message."""
    for name, value in values.items():
        if isinstance(value, dict):
            fill(getattr(message, name), value)
        elif isinstance(value, list):
            getattr(message, name).extend(value)
        else:
            setattr(message, name, value)


def test_unknown_fields_are_left_out() -> None:
    """It proves that fields of newer schemas, of every kind of encoding, don't disturb."""
    newer = varint(100 << 3 | 2) + varint(3) + b"new" + varint(99 << 3) + varint(300)
    newer += varint(98 << 3 | 1) + bytes(8) + varint(97 << 3 | 5) + bytes(4)
    schema = SCHEMAS["CompressedImage"]
    data = newer + encode(FIELDS["CompressedImage"], schema) + newer
    assert read_message(data, schema) == FIELDS["CompressedImage"]


@pytest.mark.parametrize("data", [b"\x0a\x7f", b"\x0b", b"\x80", b"\x09\x00"])
def test_what_is_no_protobuf(data: bytes) -> None:
    """It proves that cut off and impossible messages are errors."""
    with pytest.raises(ValueError, match=r"a field|a number"):
        read_message(data, SCHEMAS["RawImage"])


@pytest.mark.parametrize(
    ("kind", "data"),
    [
        ("RawImage", b"\x22\x01a\x20\x01"),  # the encoding as a number
        ("RawImage", b"\x08\x01"),  # the time as a number
        ("CameraCalibration", b"\x2a\x03abc"),  # three bytes of doubles
        ("CameraCalibration", b"\x28\x01"),  # doubles as a number
        ("FrameTransform", b"\x22\x05\x0d\x00\x00\x00\x00"),  # x as a float of four bytes
    ],
)
def test_fields_of_another_kind(kind: str, data: bytes) -> None:
    """It proves that a field whose bytes can't be its value is an error like other damage."""
    with pytest.raises(ValueError, match=r"a field .* of another kind"):
        read_message(data, SCHEMAS[kind])


def values_of(kind: str, encoding: str) -> Any:
    """A message of Foxglove's, decoded."""
    fields = dict(FIELDS[kind])
    topic = Topic("/a", f"foxglove.{kind}", encoding)
    if encoding == "protobuf":
        return decoder(topic)(encode(fields, SCHEMAS[kind]))
    import base64

    time = fields["timestamp"]
    fields["timestamp"] = {"sec": time["seconds"], "nsec": time["nanos"]}
    if "data" in fields:
        fields["data"] = base64.b64encode(fields["data"]).decode()
    return decoder(topic)(json.dumps(fields).encode())


@pytest.mark.parametrize("encoding", ["json", "protobuf"])
def test_foxglove_messages(encoding: str) -> None:
    """It proves that images, cameras and transforms of Foxglove have the same values in both encodings."""
    image = to_image(values_of("RawImage", encoding))
    assert (image.time, image.frame, image.encoding) == (START + 250, "lens", "bgr8")
    assert np.array_equal(image.data, IMAGE.ravel())
    packed = to_image(values_of("CompressedImage", encoding))
    assert (packed.compressed, packed.encoding, packed.data.tobytes()) == (True, "jpeg", b"\x00\x01\xff")
    camera = to_camera(values_of("CameraCalibration", encoding))
    assert (camera.width, camera.height, camera.model) == (32, 24, "plumb_bob")
    assert (camera.k, camera.d[:2], camera.p[3], camera.r) == (tuple(K), (0.1, -0.2), -36.0, ())
    (transform,) = to_transforms(values_of("FrameTransform", encoding))
    assert (transform.parent, transform.child) == ("body", "lens")
    assert (transform.translation, transform.rotation) == ((0.1, -0.2, 0.3), (0.0, 0.0, 0.6, 0.8))


@pytest.mark.parametrize(
    ("kind", "convert", "field"),
    [
        ("RawImage", to_image, "width"),
        ("CameraCalibration", to_camera, "width"),
        ("FrameTransform", to_transforms, "rotation"),
    ],
)
def test_null_in_json(kind: str, convert: Callable[[Any], Any], field: str) -> None:
    """It proves that null, as writers put for NaN, is an error like other values that can't be."""
    with pytest.raises(ValueError, match="a message with"):
        convert({**values_of(kind, "json"), field: None})


def test_a_list_that_is_null() -> None:
    """It proves that null in place of the coefficients of a distortion is the empty list."""
    assert to_camera({**values_of("CameraCalibration", "json"), "D": None}).d == ()


@pytest.mark.parametrize(
    ("topic", "message"),
    [
        (Topic("/a", "foxglove.RawImage", "flatbuffer"), "the encoding 'flatbuffer' isn't known"),
        (Topic("/a", "foxglove.RawVideo", "protobuf"), "the protobuf type foxglove.RawVideo isn't known"),
        (Topic("/a", "my_msgs/msg/Image", "cdr"), "type my_msgs/msg/Image isn't known, and the recording"),
    ],
)
def test_unreadable_types(topic: Topic, message: str) -> None:
    """It proves that types and encodings that can't be read are errors that name them."""
    with pytest.raises(ValueError, match=message):
        decoder(topic)


HOSTILE = ("x/msg/X:\n    pass\nopen('owned', 'w')\nclass Y/Image", "x/msg/X:\n  open('owned', 'w') #/Image")


@pytest.mark.parametrize("kind", HOSTILE)
def test_hostile_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    """It proves that the name of a type, from which rosbags makes code, can't bring code of its own."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="can't be the name of a type"):
        decoder(Topic("/a", kind, "cdr", "uint8 a\n"))
    assert not Path("owned").exists()


def test_ros_without_a_definition() -> None:
    """It proves that ROS's own types are known where the recording doesn't define them, as old ones do."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    header = store.types["std_msgs/msg/Header"](store.types["builtin_interfaces/msg/Time"](5, 6), "lens")
    kind = "sensor_msgs/msg/CompressedImage"
    data = store.serialize_cdr(store.types[kind](header, "jpeg", np.arange(3, dtype=np.uint8)), kind)
    image = to_image(decoder(Topic("/a", kind, "cdr"))(bytes(data)))
    assert (image.time, image.frame, image.data.tolist()) == (5 * 10**9 + 6, "lens", [0, 1, 2])


def test_a_broken_ros_message() -> None:
    """It proves that bytes that aren't the type are an error that names it."""
    with pytest.raises(ValueError, match="a message that isn't sensor_msgs/msg/Image"):
        decoder(Topic("/a", "sensor_msgs/msg/Image", "cdr"))(b"\x00\x01\x00\x00\x01")
