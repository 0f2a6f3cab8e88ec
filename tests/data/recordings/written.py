# SPDX-License-Identifier: MIT
"""Recordings that the tests write, with the libraries of ROS and MCAP themselves."""

import base64
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

pytest.importorskip("rosbags", reason="needs the extra recordings")
pytest.importorskip("mcap", reason="needs the extra recordings")

from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Bag1Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Bag2Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

SECOND = 10**9
START = 1_700_000_000 * SECOND  # ns, when the recordings begin


class Sent(NamedTuple):
    """A message that a test records: on a topic, at a time in ns, of a ROS 2 type, with its fields."""

    topic: str
    time: int
    type: str
    fields: dict[str, Any]


def header(time: int, frame: str = "camera") -> dict[str, Any]:
    """A std_msgs/Header."""
    return {"stamp": time, "frame_id": frame}


def raw(topic: str, time: int, image: NDArray[Any], encoding: str, **other: Any) -> Sent:
    """A sensor_msgs/Image. other: stamp, frame, recorded, step."""
    data = np.ascontiguousarray(image)
    height, width = data.shape[:2]
    return Sent(
        topic,
        other.get("recorded", time),
        "sensor_msgs/msg/Image",
        {
            "header": header(other.get("stamp", time), other.get("frame", "camera")),
            "height": height,
            "width": width,
            "encoding": encoding,
            "is_bigendian": 0,
            "step": data.nbytes // height,
            "data": data.reshape(-1).view(np.uint8),
        },
    )


def compressed(topic: str, time: int, data: bytes, form: str) -> Sent:
    """A sensor_msgs/CompressedImage."""
    fields = {"header": header(time), "format": form, "data": np.frombuffer(data, np.uint8)}
    return Sent(topic, time, "sensor_msgs/msg/CompressedImage", fields)


def info(topic: str, time: int, size: tuple[int, int], focal: float, **other: Any) -> Sent:
    """A sensor_msgs/CameraInfo with the principal point in the middle. other: frame, d, r, p."""
    width, height = size
    cx, cy = (width - 1) / 2, (height - 1) / 2
    k = [focal, 0, cx, 0, focal, cy, 0, 0, 1]
    p = [focal, 0, cx, 0, 0, focal, cy, 0, 0, 0, 1, 0]
    roi = {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}
    return Sent(
        topic,
        time,
        "sensor_msgs/msg/CameraInfo",
        {
            "header": header(time, other.get("frame", "camera")),
            "height": height,
            "width": width,
            "distortion_model": "plumb_bob",
            "d": np.array(other.get("d", [0.0] * 5), np.float64),
            "k": np.array(k, np.float64),
            "r": np.array(other.get("r", np.eye(3)), np.float64).ravel(),
            "p": np.array(other.get("p", p), np.float64),
            "binning_x": 0,
            "binning_y": 0,
            "roi": roi,
        },
    )


def transform(time: int, parent: str, child: str, move: Sequence[float], turn: Sequence[float]) -> Sent:
    """A tf2_msgs/TFMessage on /tf_static with one transform."""
    stamped = {
        "header": header(time, parent),
        "child_frame_id": child,
        "transform": pose(move, turn),
    }
    return Sent("/tf_static", time, "tf2_msgs/msg/TFMessage", {"transforms": [stamped]})


def pose(move: Sequence[float], turn: Sequence[float]) -> dict[str, Any]:
    """A geometry_msgs/Transform; turn: a quaternion x, y, z, w."""
    return {
        "translation": dict(zip("xyz", move, strict=True)),
        "rotation": dict(zip("xyzw", turn, strict=True)),
    }


def color(level: int, size: tuple[int, int] = (32, 24)) -> NDArray[np.uint8]:
    """A BGR image of one blue, green, red; no channel like another."""
    image = np.zeros((size[1], size[0], 3), np.uint8)
    image[:] = (level, level + 1, level + 2)
    return image


def depth(millimeters: int, size: tuple[int, int] = (32, 24)) -> NDArray[np.uint16]:
    """16 bits of one distance, with a corner where nothing was measured."""
    image = np.full(size[::-1], millimeters, np.uint16)
    image[0, 0] = 0
    return image


def walk(
    count: int = 5, period: int = SECOND // 30, lag: int = 0, size: tuple[int, int] = (32, 24)
) -> list[Sent]:
    """Color of the levels 10, 20, ... and depth of 1 m, 1.1 m, ... lag ns later, with their cameras."""
    sent = []
    for index in range(count):
        time = START + index * period
        sent += [
            info("/camera/color/camera_info", time, size, 30.0),
            raw("/camera/color/image_raw", time, color(10 * (index + 1) % 250, size), "bgr8"),
            info("/camera/depth/camera_info", time, size, 30.0),
            raw("/camera/depth/image_rect_raw", time + lag, depth(1000 + 100 * index, size), "16UC1"),
        ]
    return sent


def write_bag1(path: Path, sent: Sequence[Sent], compression: str = "", **types: str) -> Path:
    """A ROS 1 bag. types: definitions of types that ROS doesn't have, "/" as "__"."""
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(
        get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage")
    )
    for name, definition in types.items():
        store.register(get_types_from_msg(definition, name.replace("__", "/")))
    writer = Bag1Writer(path)
    if compression:
        writer.set_compression(getattr(Bag1Writer.CompressionFormat, compression))
    with writer as bag:
        connections: dict[str, Any] = {}
        for each in sent:
            if each.topic not in connections:
                connections[each.topic] = bag.add_connection(each.topic, each.type, typestore=store)
            message = make(store, each.type, each.fields, ros1=True)
            bag.write(connections[each.topic], each.time, store.serialize_ros1(message, each.type))
    return path


def write_bag2(path: Path, sent: Sequence[Sent], storage: str = "sqlite3") -> Path:
    """A ROS 2 folder of version 9, its messages in sqlite3 or mcap."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    plugin = StoragePlugin.SQLITE3 if storage == "sqlite3" else StoragePlugin.MCAP
    with Bag2Writer(path, version=9, storage_plugin=plugin) as bag:
        connections: dict[str, Any] = {}
        for each in sent:
            if each.topic not in connections:
                connections[each.topic] = bag.add_connection(each.topic, each.type, typestore=store)
            message = make(store, each.type, each.fields)
            bag.write(connections[each.topic], each.time, store.serialize_cdr(message, each.type))
    return path


def write_mcap(path: Path, sent: Sequence[Sent], chunk: int = 4096, **options: Any) -> Path:
    """An MCAP file with ROS 2 messages, by MCAP's own writer, in several chunks."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    with path.open("wb") as file:
        writer = McapWriter(file, chunk_size=chunk, **options)
        writer.start("ros2")
        channels: dict[str, int] = {}
        for each in sent:
            if each.topic not in channels:
                text, _ = store.generate_msgdef(each.type, ros_version=2)
                schema = writer.register_schema(each.type, "ros2msg", text.encode())
                channels[each.topic] = writer.register_channel(each.topic, "cdr", schema)
            data = store.serialize_cdr(make(store, each.type, each.fields), each.type)
            writer.add_message(channels[each.topic], each.time, bytes(data), each.time)
        writer.finish()
    return path


def write_json(path: Path, sent: Sequence[tuple[str, int, str, dict[str, Any]]]) -> Path:
    """An MCAP file with Foxglove's messages in JSON: topic, time, type and fields of each."""
    with path.open("wb") as file:
        writer = McapWriter(file)
        writer.start()
        channels: dict[str, int] = {}
        for topic, time, kind, fields in sent:
            if topic not in channels:
                schema = writer.register_schema(kind, "jsonschema", b'{"type": "object"}')
                channels[topic] = writer.register_channel(topic, "json", schema)
            plain = {
                name: base64.b64encode(value).decode() if isinstance(value, bytes) else value
                for name, value in fields.items()
            }
            writer.add_message(channels[topic], time, json.dumps(plain).encode(), time)
        writer.finish()
    return path


def make(store: Any, kind: str, fields: dict[str, Any], ros1: bool = False) -> Any:
    """A message of rosbags: dictionaries become messages, and a time in ns a Time."""
    values = {}
    for name, (node, details) in store.fielddefs[kind][1]:
        if name == "seq" and name not in fields:
            values[name] = 0
            continue
        value = fields[name if name in fields else name.lower()]
        kinds = details if node.name == "NAME" else details[0][1]
        if node.name == "NAME" and isinstance(value, dict):
            value = make(store, kinds, value, ros1)
        elif kinds == "builtin_interfaces/msg/Time":
            value = store.types[kinds](value // SECOND, value % SECOND)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            value = [make(store, kinds, each, ros1) for each in value]
        values[name] = value
    return store.types[kind](**values)


def jpeg(image: NDArray[np.uint8]) -> bytes:
    """The image as JPEG of the best quality."""
    return cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, 100])[1].tobytes()


def png(image: NDArray[Any]) -> bytes:
    """The image as PNG."""
    return cv2.imencode(".png", image)[1].tobytes()
