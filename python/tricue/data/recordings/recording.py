# SPDX-License-Identifier: MIT
"""A recording as a source: topics become channels, paired by their times while they are read."""

from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from numpy.typing import NDArray

from tricue.camera.numbers import positive
from tricue.data.files import natural_order
from tricue.data.joint import JointStream, Moment
from tricue.data.layouts import find_plain_images
from tricue.data.recordings.bag1 import Bag1
from tricue.data.recordings.cameras import View, calibrate, find_info
from tricue.data.recordings.container import Chain, Container
from tricue.data.recordings.head import Head, read_head
from tricue.data.recordings.images import DepthUnits, to_color, to_depth
from tricue.data.recordings.mcap_file import McapFile
from tricue.data.recordings.messages import IMAGES, ImageMessage, decoder, to_image
from tricue.data.recordings.pairing import Pairing, Timed
from tricue.data.recordings.sqlite_file import SqliteFile
from tricue.data.recordings.topics import CHANNELS, guess_topics, is_depth_topic, stem
from tricue.data.source import Source
from tricue.data.streams import DEFAULT_FPS, MAX_DAMAGED, remark_on_steps_back

READERS: dict[str, tuple[str, Callable[[Path], Container]]] = {
    ".bag": ("ROS 1 bag", Bag1),
    ".mcap": ("MCAP", McapFile),
    ".db3": ("ROS 2 recording", SqliteFile),
}
T = TypeVar("T")
METADATA = "metadata.yaml"  # in the folder of a closed ROS 2 recording
MAX_UNDECODED = 10  # skipped moments, after which the last undamaged one is decoded


class TopicSummary(NamedTuple):
    """A topic, as listed for the user. channel: the one it is read as, else ""."""

    name: str
    type: str
    messages: int
    channel: str


class Stored(NamedTuple):
    """An image, its time of recording, and its index among the topic's images with the same time."""

    time: int
    place: int
    image: ImageMessage


class Recording:
    """The chosen topics of a container, as a joint of channels; see :class:`tricue.data.joint.Joint`."""

    def __init__(
        self, container: Container, chosen: Mapping[str, str], head: Head, units: DepthUnits
    ) -> None:
        self.container, self.chosen, self.head = container, dict(chosen), head
        self.units = units
        self._channels = {topic: channel for channel, topic in chosen.items()}
        self._decoders = {topic: decoder(container.topics[topic]) for topic in self._channels}
        self._moments = self._early = self._damaged = 0
        self._unreadable: set[tuple[str, int, int]] = set()  # topic, time and place of each message
        self._steps_back: list[int] = []
        self._first = self._first_whole()
        self.clock = next(iter(chosen))
        rate = head.fps(chosen[self.clock])
        self.fps = rate or DEFAULT_FPS
        self._left_out: Counter[str] = Counter()

    @property
    def paths(self) -> list[Path]:
        parts = self.container.parts if isinstance(self.container, Chain) else [self.container]
        return [each.path for each in parts]

    @property
    def tolerance(self) -> int:
        """The largest difference in time between the images of one moment, nanoseconds: half a frame."""
        return round(0.5e9 / self.fps)

    @property
    def depth_unit(self) -> float:
        """Meters per unit of recorded depth: 1 if it is recorded in meters."""
        return self.units.of(self.head.images[self.chosen["depth"]])

    @property
    def remarks(self) -> tuple[str, ...]:
        found = []
        if self.container.damage:
            found.append(f"{self.container.path}: {self.container.damage}; what is before that was read")
        for channel, count in self._left_out.items():
            others = " or ".join(name for name in self.chosen if name != channel)
            found.append(
                f"left out {count} of {count + self._moments} {channel} images, "
                f"with no {others} image within {self.tolerance / 1e6:.3g} ms"
            )
        if self._unreadable:
            count = len(self._unreadable)
            found.append(f"left out {count} unreadable message{'s' * (count > 1)}")
        if self._early:
            found.append(f"took the first whole image in place of {self._early} damaged before it")
        if self._damaged:
            found.append(f"took the frame before in place of {self._damaged} with a damaged image")
        if self._steps_back:
            found.append(remark_on_steps_back(self._steps_back))
        return tuple(found)

    def size(self, channel: str) -> tuple[int, int]:
        height, width = self._first[channel].shape[:2]
        return width, height

    def moments(self, channels: Sequence[str], indices: Sequence[int] | None = None) -> Iterator[Moment]:
        """Yield the moments. A moment with a damaged image repeats earlier images, so that frame numbers stay
        the same.

        The earlier images are those of the last undamaged moment, even if it wasn't requested; without one,
        each topic's first undamaged image.
        """
        remaining = None if indices is None else deque(indices)
        number = self._early = self._damaged = 0
        images = first = {channel: self._first[channel] for channel in channels}
        undecoded: list[dict[str, Timed[Stored]]] = []
        for paired in self._paired():
            undecoded.append(paired)
            wanted = remaining is None or (remaining and remaining[0] == number)
            if wanted or len(undecoded) == MAX_UNDECODED:
                images, is_last = self._last_whole(undecoded, images)
                undecoded.clear()
            if wanted:
                self._early += images is first
                self._damaged += not is_last and images is not first
                yield {channel: (1e-9 * paired[channel].time, image) for channel, image in images.items()}
                if remaining:
                    remaining.popleft()
            if remaining is not None and not remaining:
                return
            number += 1
        if remaining:
            raise ValueError(f"{self.container.path}: expected {remaining[0] + 1} frames, got {number}")

    @cached_property
    def times(self) -> Sequence[float]:
        """The times of all frames, in seconds; this reads the whole recording, without decoding images."""
        return [1e-9 * paired[self.clock].time for paired in self._paired()]

    def count(self) -> int:
        return len(self.times)

    def topics(self) -> list[TopicSummary]:
        """All topics, by name, with the numbers of their messages."""
        counts = self.container.counts()
        return [
            TopicSummary(name, topic.type, counts[name], self._channels.get(name, ""))
            for name, topic in sorted(self.container.topics.items())
        ]

    def _last_whole(
        self, moments: Sequence[dict[str, Timed[Stored]]], before: dict[str, NDArray[Any]]
    ) -> tuple[dict[str, NDArray[Any]], bool]:
        """The images of the last undamaged moment, and whether that is the last of these moments.

        before: the images to use if all are damaged; their channels are the ones that are read.
        """
        for paired in reversed(moments):
            try:
                images = {channel: self.decode(channel, paired[channel].item.image) for channel in before}
            except ValueError:
                continue
            return images, paired is moments[-1]
        return before, False

    def _first_whole(self) -> dict[str, NDArray[Any]]:
        """Each channel's first undamaged image; ValueError if there is none among the first MAX_DAMAGED."""
        found: dict[str, NDArray[Any]] = {}
        known = ((channel, self.head.images[topic]) for channel, topic in self.chosen.items())
        others = ((each.channel, each.item.image) for each in self.images())
        tried: Counter[str] = Counter()
        for channel, image in chain(known, others):
            if channel not in found:
                tried[channel] += 1
                with suppress(ValueError):
                    found[channel] = self.decode(channel, image)
            if found.keys() == self.chosen.keys() or tried[channel] > MAX_DAMAGED:
                break
        return {
            channel: found[channel] if channel in found else self.decode(channel, self.head.images[topic])
            for channel, topic in self.chosen.items()
        }

    def _paired(self) -> Iterator[dict[str, Timed[Stored]]]:
        yield from self.paired(self.images())

    def paired(self, images: Iterable[Timed[T]]) -> Iterator[dict[str, Timed[T]]]:
        """Yield the images of each moment, by channel; ValueError if there is no moment."""
        pairing: Pairing[T] = Pairing(list(self.chosen), self.tolerance)
        count, before, steps_back = 0, 0, list[int]()
        for count, paired in enumerate(pairing(images), 1):
            now = paired[self.clock].time
            if now < before:
                steps_back.append(count - 1)
            before = now
            yield paired
        self._left_out, self._moments, self._steps_back = +pairing.left_out, count, steps_back
        if count == 0:
            names = " and ".join(self.chosen)
            alone = {self.clock: self.chosen[self.clock]}
            raise ValueError(
                f"{self.container.path}: expected {names} images within {self.tolerance / 1e6:.3g} ms of "
                f"each other, found none; topics={alone} reads one alone"
            )

    def images(self, start: int = 0) -> Iterator[Timed[Stored]]:
        """The images as they were recorded, not decoded, in order of recording time.

        start: recording time, nanoseconds; earlier images aren't read.
        """
        latest: dict[str, tuple[int, int]] = {}
        for message in self.container.messages(self._channels, start):
            time, place = latest.get(message.topic, (-1, 0))
            place = place + 1 if time == message.time else 0
            latest[message.topic] = message.time, place
            try:
                image = to_image(self._decoders[message.topic](message.data))
            except ValueError:
                self._unreadable.add((message.topic, message.time, place))
                continue
            channel = self._channels[message.topic]
            yield Timed(channel, image.time or message.time, Stored(message.time, place, image))

    def decode(self, channel: str, image: ImageMessage) -> NDArray[Any]:
        """The image as an array, as the channel gives it; ValueError if it is damaged."""
        return to_depth(image, self.units) if channel == "depth" else to_color(image)


def is_recording(path: Path) -> bool:
    """Whether it is a recording's file, or a folder that has such files and no images."""
    if not path.is_dir():
        return path.suffix.lower() in READERS
    return bool(_files(path) or _packed(path)) and not find_plain_images(path)


def open_recording(path: Path, topics: Mapping[str, str] | None = None, scale: float | None = None) -> Source:
    """The recording as a source.

    topics: by channel: "color", "depth", "right"; by default chosen by their names and images.
    scale: meters per unit of depth, for 16 bits and floats. By default 16 bits are in the unit that the
        recording names, else in millimeters, and floats are meters.
    ValueError, OSError or ImportError says in one line what to do.
    """
    container, format_ = _open_container(path)
    _check_topics(container, topics)
    head = read_head(container, None if topics is None else set(topics.values()))
    chosen = dict(topics) if topics else guess_topics(head.images)
    _check_images(container, head, chosen)
    ordered = {channel: chosen[channel] for channel in CHANNELS if channel in chosen}
    units = _depth_units(head, scale)
    try:
        recording = Recording(container, ordered, head, units)
    except ValueError as error:
        given = ", ".join(f"{channel}={topic}" for channel, topic in ordered.items())
        raise ValueError(f"{path}: {error}; got {given}, choose others by topics=") from None
    cameras = calibrate({channel: _view(recording, channel) for channel in ordered}, head.transforms)
    return Source(
        path.resolve().stem,
        {channel: JointStream(recording, channel) for channel in ordered},
        notes=(*(() if topics else (_note_choice(ordered, container, head),)), *cameras.notes),
        register=cameras.register,
        rectify=cameras.rectify,
        camera=cameras.camera,
        format=format_,
    )


def _files(folder: Path) -> list[Path]:
    return natural_order(path for path in folder.iterdir() if path.suffix.lower() in READERS)


def _packed(folder: Path) -> list[Path]:
    """Files that ROS 2 compressed whole, such as walk_0.db3.zstd."""
    return [path for path in folder.glob("*.zstd") if Path(path.stem).suffix.lower() in READERS]


def _open_container(path: Path) -> tuple[Container, str]:
    """The container, and the name of its format."""
    if not path.is_dir():
        name, reader = READERS[path.suffix.lower()]
        return reader(path), name
    files = _files(path)
    if packed := _packed(path):
        raise ValueError(f"{packed[0]}: expected unpacked files; zstd -d --rm {packed[0]} unpacks it")
    if len(files) > 1 and not (path / METADATA).is_file():
        raise ValueError(f"{path}: expected one recording, found {len(files)}; name one of them")
    name, _ = READERS[files[0].suffix.lower()]
    parts = [READERS[file.suffix.lower()][1](file) for file in files]
    format_ = "ROS 2 recording" if (path / METADATA).is_file() else name
    return (parts[0] if len(parts) == 1 else Chain(path, parts)), format_


def _check_topics(container: Container, topics: Mapping[str, str] | None) -> None:
    """Raise ValueError for topics that are missing or don't hold images."""
    images = [name for name, topic in container.topics.items() if topic.kind in IMAGES]
    if not images:
        kinds = sorted({topic.type for topic in container.topics.values() if topic.type})
        found = f"only {', '.join(kinds[:5])}{', ...' if len(kinds) > 5 else ''}" if kinds else "no messages"
        damage = f" ({container.damage})" if container.damage else ""
        raise ValueError(f"{container.path}: expected images in the recording, found {found}{damage}")
    for channel, name in (topics or {}).items():
        if channel not in CHANNELS or (channel == "right" and "color" not in (topics or {})):
            wrong = {channel: name}
            raise ValueError(f"topics={wrong}: expected color, depth, or right beside color")
        if name not in images:
            topic = container.topics.get(name)
            got = f"{name}, of the type {topic.type}" if topic else f"{name}, which isn't there"
            raise ValueError(f"topics: expected one of the images {', '.join(sorted(images))}, got {got}")


def _check_images(container: Container, head: Head, chosen: Mapping[str, str]) -> None:
    for name in chosen.values():
        if name not in head.images:
            reason = head.unread.get(name, "it has no image at the beginning")
            raise ValueError(f"{container.path}: {name} can't be read: {reason}; choose by topics=")
    if not chosen:
        reason = next((f"{name}: {why}" for name, why in head.unread.items()), "the topics have no messages")
        raise ValueError(f"{container.path}: expected images in the recording, found none: {reason}")


def _depth_units(head: Head, scale: float | None) -> DepthUnits:
    """The given units, else the recording's own, else ROS's."""
    if scale is not None:
        unit = positive(scale, "depth_scale", "meters per unit")
        return DepthUnits(unit, unit)
    return DepthUnits(head.units) if head.units else DepthUnits()


def _note_choice(chosen: Mapping[str, str], container: Container, head: Head) -> str:
    others = [name for name in head.images if name not in chosen.values()]
    if unseen := [
        name for name, topic in container.topics.items() if topic.kind in IMAGES and name not in head.images
    ]:
        counts = container.counts()
        others += [
            f"{name} ({head.unread.get(name, 'it has no image at the beginning')})"
            for name in unseen
            if counts[name]
        ]
    named = ", ".join(f"{channel}={name}" for channel, name in chosen.items())
    rest = f"; left out {', '.join(others)}" if others else ""
    return f"topics chosen: {named}{rest}" + ("; topics= chooses others" if others else "")


def _view(recording: Recording, channel: str) -> View:
    topic, head = recording.chosen[channel], recording.head
    info = find_info(topic, head.images[topic].frame, head.cameras)
    own = stem(topic)
    frames = {each for transform in head.transforms for each in (transform.parent, transform.child)}
    # RealSense's own bags name the stream itself; in ROS the images name the camera's frame
    frame = own if own in frames else head.images[topic].frame or (info.frame if info else "")
    rectified = "rect" in own.rsplit("/", 1)[-1] or is_depth_topic(topic, head.images[topic])
    return View(topic, recording.size(channel), frame, info, rectified)
