# SPDX-License-Identifier: MIT
"""Foxglove's messages in protobuf, as dictionaries of their fields.

This needs no compiler and no package, because field numbers never change. Sources: the schemas of Foxglove's
SDK; "Encoding" in the documentation of Protocol Buffers.
"""

import struct
from collections.abc import Iterator, Mapping
from typing import Any

Schema = Mapping[int, tuple[str, Any]]
"""A field's name and kind, by its number. The kind is "int", "string", "bytes", "double", "doubles", a
schema, or a list of one schema.
"""

_VARINT, _FIXED64, _BYTES, _FIXED32 = 0, 1, 2, 5  # wire types
_TIME: Schema = {1: ("seconds", "int"), 2: ("nanos", "int")}
_VECTOR: Schema = {1: ("x", "double"), 2: ("y", "double"), 3: ("z", "double")}
_QUATERNION: Schema = {**_VECTOR, 4: ("w", "double")}
_TRANSFORM: Schema = {
    1: ("timestamp", _TIME),
    2: ("parent_frame_id", "string"),
    3: ("child_frame_id", "string"),
    4: ("translation", _VECTOR),
    5: ("rotation", _QUATERNION),
}
SCHEMAS: Mapping[str, Schema] = {
    "RawImage": {
        1: ("timestamp", _TIME),
        2: ("width", "int"),
        3: ("height", "int"),
        4: ("encoding", "string"),
        5: ("step", "int"),
        6: ("data", "bytes"),
        7: ("frame_id", "string"),
    },
    "CompressedImage": {
        1: ("timestamp", _TIME),
        2: ("data", "bytes"),
        3: ("format", "string"),
        4: ("frame_id", "string"),
    },
    "CameraCalibration": {
        1: ("timestamp", _TIME),
        2: ("width", "int"),
        3: ("height", "int"),
        4: ("distortion_model", "string"),
        5: ("D", "doubles"),
        6: ("K", "doubles"),
        7: ("R", "doubles"),
        8: ("P", "doubles"),
        9: ("frame_id", "string"),
    },
    "FrameTransform": _TRANSFORM,
    "FrameTransforms": {1: ("transforms", [_TRANSFORM])},
}
_ABSENT: dict[str, Any] = {"int": 0, "string": "", "bytes": b"", "double": 0.0}


def read_message(data: bytes, schema: Schema) -> dict[str, Any]:
    """The fields of a message by name; missing ones are 0 or empty.

    ValueError if the data isn't protobuf.
    """
    message: dict[str, Any] = {name: _absent(kind) for name, kind in schema.values()}
    for number, value in _values(data):
        if number not in schema:
            continue
        name, kind = schema[number]
        _check_kind(name, kind, value)
        if kind == "doubles":
            message[name] += [*struct.unpack(f"<{len(value) // 8}d", value)]
        elif isinstance(kind, list):
            message[name].append(read_message(value, kind[0]))
        else:
            message[name] = _converted(value, kind)
    return message


def _check_kind(name: str, kind: Any, value: int | bytes) -> None:
    """Raise ValueError if a value can't be of this kind, as in a damaged message."""
    size = 0 if isinstance(value, int) else len(value)
    if (
        (isinstance(value, int) and kind != "int")
        or (kind == "double" and size != 8)
        or (kind == "doubles" and size % 8)
    ):
        raise ValueError(f"a field {name} of another kind")


def _absent(kind: Any) -> Any:
    if isinstance(kind, list) or kind == "doubles":
        return []
    return read_message(b"", kind) if isinstance(kind, Mapping) else _ABSENT[kind]


def _converted(value: Any, kind: Any) -> Any:
    if isinstance(kind, Mapping):
        return read_message(value, kind)
    if kind == "int":
        return value if isinstance(value, int) else int.from_bytes(value, "little")
    if kind == "double":
        return struct.unpack("<d", value)[0]
    return value.decode(errors="replace") if kind == "string" else value


def _values(data: bytes) -> Iterator[tuple[int, Any]]:
    """The number and the value of each field: an int, or bytes."""
    at = 0
    while at < len(data):
        key, at = _varint(data, at)
        number, wire = key >> 3, key & 7
        if wire == _VARINT:
            value, at = _varint(data, at)
            yield number, value
            continue
        if wire == _BYTES:
            size, at = _varint(data, at)
        elif wire in (_FIXED32, _FIXED64):
            size = 4 if wire == _FIXED32 else 8
        else:
            raise ValueError(f"a field of the unknown kind {wire}")
        if at + size > len(data):
            raise ValueError("a field that is longer than the message")
        yield number, data[at : at + size]
        at += size


def _varint(data: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        if at >= len(data):
            raise ValueError("a number that doesn't end")
        value |= (data[at] & 0x7F) << shift
        shift, at = shift + 7, at + 1
        if data[at - 1] < 0x80:
            return value, at
