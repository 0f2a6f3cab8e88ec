# SPDX-License-Identifier: MIT
"""Specs of third-party trackers: a class in a module or file, one of cv2's, a TraX program."""

import re
from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tricue.evaluation.foreign.host import CV2, TRAX, Description
from tricue.evaluation.foreign.process import (
    RemoteTracker,
    WorkerError,
    WorkerProcess,
    ended_by_another_limit,
)
from tricue.evaluation.safe_tracker import SafeTracker
from tricue.evaluation.toolkits.trax_client import command_words
from tricue.evaluation.tracker_spec import Make, SequenceInfo, TrackerSpec
from tricue.track.base import registry
from tricue.track.base.traits import Traits

DEFAULT_TIME_LIMIT = 60.0  # seconds for an update
_NAMED = re.compile(r"([^=:/\\]+)=(.+)", re.DOTALL)
"""NAME=place"""


@dataclass(frozen=True)
class ForeignSpec(TrackerSpec):
    """A tracker that runs in its own process. place: see :class:`Host`. time_limit: seconds for an update."""

    place: str = ""
    time_limit: float = DEFAULT_TIME_LIMIT
    described: Description = field(default=Description(Traits(channels=()), ""), compare=False)

    @property
    def ours(self) -> bool:
        """It isn't."""
        return False

    @property
    def traits(self) -> Traits:
        """Its inputs and capabilities, as its class or program declares them."""
        return self.described.traits

    @property
    def random(self) -> bool:
        """Whether its class says that it is random, or takes a seed."""
        return self.traits.random

    @property
    def relative_time(self) -> float:
        """It is assumed to be slow, so that it starts first."""
        return 60.0

    @property
    def description(self) -> str:
        """Its place, parameters, and version, as JSON."""
        return f"{self.place} {self.described.version}"

    def make(self, opened: SequenceInfo, seed: int) -> SafeTracker:
        """The tracker for a sequence, in a process of its own."""
        return self._made(WorkerProcess(self.place, self.time_limit), opened, seed)

    @contextmanager
    def session(self, opened: SequenceInfo) -> Iterator[Make]:
        """Yield the function that creates it, always in the same process. If that has ended, no new one is
        started.
        """
        process = WorkerProcess(self.place, self.time_limit)
        with closing(process):
            yield lambda seed: self._made(process, opened, seed)

    def outdated(self, error: str) -> bool:
        """Whether a different time limit ended it."""
        return ended_by_another_limit(error, self.time_limit)

    def _made(self, process: WorkerProcess, opened: SequenceInfo, seed: int) -> SafeTracker:
        keywords = dict(self.settings) if self.sees_a_picture(opened) else self.keywords(opened)
        try:
            return SafeTracker(RemoteTracker(process, keywords, seed))
        except WorkerError as error:
            return SafeTracker(None, str(error))

    def sees_a_picture(self, opened: SequenceInfo) -> bool:
        """Whether it gets depth as a picture: if it takes only color and the boxes are in the depth image."""
        return (
            opened.channel == "depth"
            and self.traits.best({"depth"}) is None
            and self.traits.best({"color"}) is not None
        )


def foreign_spec(text: str, settings: Mapping[str, Any], time_limit: float) -> ForeignSpec:
    """The spec of a place, such as ``mine.py:Mine``, or of NAME=place; settings: its parameters.

    Starts its process once, to inspect it. ValueError says what is wrong.
    """
    name, place = split_name(text)
    with closing(WorkerProcess(place, time_limit)) as process:
        try:
            found: Description = process.load("describe", dict(settings))
        except WorkerError as error:
            message = str(error)
            raise ValueError(message if message.startswith(place) else f"{place}: {message}") from None
    return ForeignSpec(name, tuple(settings.items()), place, time_limit, found)


def is_foreign(text: str) -> bool:
    """Whether a name is a place, or the name of another package's tracker."""
    place = split_prefix(text)[1]
    return ":" in text or (place in registry.names() and not registry.is_built_in(place))


def split_prefix(text: str) -> tuple[str, str]:
    """NAME and the rest of NAME=rest; "" and all of a text without NAME."""
    match = _NAMED.fullmatch(text)
    return (match[1].strip(), match[2].strip()) if match else ("", text)


def split_name(text: str) -> tuple[str, str]:
    """A tracker's name and place, with absolute paths of files. ValueError for a program without a
    command.
    """
    given, place = split_prefix(text)
    if ":" not in place:
        return given or place, registry.location(place)
    if place.startswith(TRAX):
        return given or TRAX + Path(command_words(place.removeprefix(TRAX))[0]).name, place
    file, _, attribute = place.rpartition(":")
    if file.endswith(".py") and not place.startswith(CV2):
        path = Path(file).resolve()
        return given or f"{path.name}:{attribute}", f"{path}:{attribute}"
    return given or place, place
