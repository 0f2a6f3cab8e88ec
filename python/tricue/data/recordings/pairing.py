# SPDX-License-Identifier: MIT
"""Pairs images of several cameras by their times, while they are read from a file."""

from collections import Counter, deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")
MAX_WAITING = 30  # images of a channel that wait for another channel's; later ones aren't paired


@dataclass(frozen=True)
class Timed(Generic[T]):
    """An item of a channel with its time, in nanoseconds."""

    channel: str
    time: int
    item: T


class Pairing(Generic[T]):
    """Finds, for each image of the first channel (the clock), the nearest in time of each other channel.

    tolerance: the largest difference, nanoseconds. Each image is used at most once. left_out: how many images
    of each channel weren't used so far.
    """

    def __init__(self, channels: Sequence[str], tolerance: int) -> None:
        self.channels, self.tolerance = tuple(channels), tolerance
        self.left_out: Counter[str] = Counter()
        self._waiting: dict[str, deque[Timed[T]]] = {channel: deque() for channel in channels}

    def __call__(self, items: Iterable[Timed[T]]) -> Iterator[dict[str, Timed[T]]]:
        """The images of one moment by channel, in the order of the first channel."""
        for item in items:
            waiting = self._waiting[item.channel]
            waiting.append(item)
            yield from self._decided(forced=len(waiting) > MAX_WAITING)
        yield from self._decided(forced=True, all_come=True)
        for channel, waiting in self._waiting.items():
            self.left_out[channel] += len(waiting)

    def _decided(self, forced: bool, all_come: bool = False) -> Iterator[dict[str, Timed[T]]]:
        clock, *others = self.channels
        while self._waiting[clock] and (forced or self._can_decide()):
            forced = all_come
            first = self._waiting[clock].popleft()
            found = {channel: self._nearest(channel, first.time) for channel in others}
            if None in found.values():
                self.left_out[clock] += 1
                for channel in others:
                    self._drop_before(channel, first.time - self.tolerance)
                continue
            for channel, match in found.items():
                self._drop_until(channel, match)
            yield {clock: first, **{channel: match for channel, match in found.items() if match}}
        for channel in others:
            while len(self._waiting[channel]) > MAX_WAITING:
                self._waiting[channel].popleft()
                self.left_out[channel] += 1

    def _can_decide(self) -> bool:
        """Whether nothing nearer can come: the clock's next image is here, the other channels are ahead."""
        clock, *others = self.channels
        late = self._waiting[clock][0].time + self.tolerance
        newest = [self._waiting[channel] for channel in others]
        return len(self._waiting[clock]) > 1 and all(each and each[-1].time >= late for each in newest)

    def _nearest(self, channel: str, time: int) -> Timed[T] | None:
        """The nearest image within the tolerance; None if it is nearer to the clock's next image."""
        waiting = self._waiting[channel]
        match = min(waiting, key=lambda each: abs(each.time - time), default=None)
        if match is None or abs(match.time - time) > self.tolerance:
            return None
        following = self._waiting[self.channels[0]]
        nearer = following and abs(match.time - following[0].time) < abs(match.time - time)
        return None if nearer else match

    def _drop_before(self, channel: str, time: int) -> None:
        while self._waiting[channel] and self._waiting[channel][0].time < time:
            self._waiting[channel].popleft()
            self.left_out[channel] += 1

    def _drop_until(self, channel: str, match: Timed[T] | None) -> None:
        """Drop the match and the images before it; the latter count as left out."""
        while self._waiting[channel].popleft() is not match:
            self.left_out[channel] += 1
