# SPDX-License-Identifier: MIT
"""The beginning of a recording, which shows what its topics hold: the first images, cameras, transforms."""

import re
from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field

import numpy as np

from tricue.data.recordings.container import Container, Message, Topic
from tricue.data.recordings.messages import (
    CAMERAS,
    IMAGES,
    TRANSFORMS,
    CameraMessage,
    Decoder,
    ImageMessage,
    Transform,
    decoder,
    to_camera,
    to_image,
    to_transform,
    to_transforms,
)
from tricue.data.streams import plausible_fps

HEAD_IMAGES = 15  # of each topic
HEAD_SECONDS = 2.0  # after the first image
LATE_SECONDS = 10.0  # after the first image, within which cameras and transforms must come

STATIC_TRANSFORMS = "/tf_static"

# RealSense's own bags: the pose of a stream, such as /device_0/sensor_0/Depth_0/tf/0, and the unit of depth
_STREAM_PLACE = re.compile(r"(/device_\d+/sensor_\d+/\w+)/tf/(\d+)$")
_DEPTH_UNITS = re.compile(r"/option/Depth[ _]Units/value$")


@dataclass
class Head:
    """What the beginning of a recording holds, by topic.

    images: the first one of each. times: of the first few, nanoseconds. units: meters per unit of 16-bit
    depth, None if not recorded. unread: why image topics can't be read.
    """

    images: dict[str, ImageMessage] = field(default_factory=dict)
    times: dict[str, list[int]] = field(default_factory=dict)
    cameras: dict[str, CameraMessage] = field(default_factory=dict)
    transforms: list[Transform] = field(default_factory=list)
    units: float | None = None
    unread: dict[str, str] = field(default_factory=dict)

    def fps(self, topic: str) -> float | None:
        """Images per second of a topic; None if the first few don't determine it."""
        times = self.times.get(topic, [])
        step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
        return plausible_fps(1e9 / step) if step > 0 else None


def read_head(container: Container, images: Collection[str] | None = None) -> Head:
    """Read the beginning of a recording.

    images: the image topics to read, each up to its first image at least; by default all that are at the
    beginning.
    """
    head = Head()
    decoders: dict[str, Decoder] = {}
    for topic in container.topics.values():
        if _matters(topic, images) and (found := _decoder_of(topic, head)):
            decoders[topic.name] = found
    pending = {name for name in decoders if container.topics[name].kind in IMAGES}
    late = {name for name in decoders if container.topics[name].kind in CAMERAS or name == STATIC_TRANSFORMS}
    missing, damaged = set[str](), Counter[str]()
    if images is not None:
        counts = container.counts()
        missing = {name for name in pending if counts[name]}
    for message in _until_known(container, decoders, pending, late, missing):
        if container.topics[message.topic].kind in IMAGES and message.topic not in pending:
            continue
        try:
            _add(head, container.topics[message.topic], message, decoders[message.topic])
        except ValueError as error:
            head.unread[message.topic] = str(error)
            damaged[message.topic] += 1
        else:
            late.discard(message.topic)
        if message.topic in head.images or damaged[message.topic] == HEAD_IMAGES:
            missing.discard(message.topic)
        if len(head.times.get(message.topic, ())) + damaged[message.topic] == HEAD_IMAGES:
            pending.discard(message.topic)
    return head


def _decoder_of(topic: Topic, head: Head) -> Decoder | None:
    """The topic's decoder; None if it can't be read, and the head gets the reason."""
    try:
        return decoder(topic)
    except ValueError as error:
        head.unread[topic.name] = str(error)
        return None


def _matters(topic: Topic, images: Collection[str] | None) -> bool:
    if topic.kind in IMAGES:
        return images is None or topic.name in images
    return topic.kind in CAMERAS | TRANSFORMS or bool(
        _STREAM_PLACE.search(topic.name) or _DEPTH_UNITS.search(topic.name)
    )


def _until_known(
    container: Container, names: Collection[str], pending: set[str], late: set[str], missing: set[str]
) -> Iterator[Message]:
    """Yield messages until no topic is pending, or until too long after the first image.

    late: topics that may come later than images; their first message is enough. missing: topics that are
    waited for however late they come.
    """
    first = None
    images = frozenset(pending)
    for message in container.messages(names) if pending else ():
        if message.topic in images and first is None:
            first = message.time
        if first is not None and not missing:
            passed = 1e-9 * (message.time - first)
            if passed > (HEAD_SECONDS if not late else LATE_SECONDS):
                return
        yield message
        if not pending and not late:
            return


def _add(head: Head, topic: Topic, message: Message, decode: Decoder) -> None:
    value = decode(message.data)
    if topic.kind in IMAGES:
        image = to_image(value)
        head.images.setdefault(topic.name, image)
        head.times.setdefault(topic.name, []).append(image.time or message.time)
    elif topic.kind in CAMERAS:
        head.cameras.setdefault(topic.name, to_camera(value))
    elif topic.kind in TRANSFORMS:
        head.transforms += to_transforms(value)
    elif place := _STREAM_PLACE.search(topic.name):
        # librealsense writes x_stream = R x_reference + t
        head.transforms.append(to_transform(value, place[1], f"reference {place[2]}"))
    elif _DEPTH_UNITS.search(topic.name):
        head.units = float(value.data)
