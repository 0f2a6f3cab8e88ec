# SPDX-License-Identifier: MIT
"""Protocols: the order in which a tracker sees a sequence's frames, and the box on which it starts.

"one-pass" goes from the first true box to the end. "backward" runs from the last one to the beginning.
"starts" are eight runs, from 0, 1/4, 1/2 and 3/4 of the sequence to its end, and the same on the reversed
sequence (temporal robustness in OTB, Wu, Lim, Yang 2013; "anchors" in VOT since 2020). "every-N" uses only
every N-th frame, like a slow camera or computer. "noisy-N" starts N times on a box beside the true one
(spatial robustness in OTB). "restarts" starts again after each failure (:mod:`tricue.evaluation.restarts`).

A run starts on the first of its frames with a true box; except for "one-pass" and "restarts" it ends with the
last label. A run that belongs to several protocols is run only once.
"""

import hashlib
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.data.source import Source
from tricue.evaluation.dataset import OpenedSequence

ONE_PASS, RESTARTS, BACKWARD, STARTS = "one-pass", "restarts", "backward", "starts"
EVERY, NOISY = "every", "noisy"  # followed by a number, as in every-3
START_SHARES = (0.0, 0.25, 0.5, 0.75)
NOISE = 0.1
"""Noise of the first box: how far its center moves, in units of its size, and how much its sides change."""
MAX_DRAWS = 1000
BLOCK_PIXELS = 50_000_000  # of a reversed sequence, decoded at once


class Order(NamedTuple):
    """The frames of a run. start: the share of the sequence skipped at the beginning. step: every step-th
    frame is used. noise: 0 for the true first box, else the number of the random draw that moves it.
    """

    start: float = 0.0
    backward: bool = False
    step: int = 1
    noise: int = 0

    @property
    def name(self) -> str:
        """A task's kind, such as "backward-from-25": a part of a file's path."""
        parts = [BACKWARD] if self.backward else []
        parts += [f"from-{100 * self.start:g}"] if self.start else []
        parts += [f"{EVERY}-{self.step}"] if self.step > 1 else []
        parts += [f"noise-{self.noise}"] if self.noise else []
        return "-".join(parts) or ONE_PASS

    @classmethod
    def named(cls, name: str) -> "Order":
        """The order of that name."""

        def value(pattern: str, missing: float) -> float:
            found = re.search(pattern + r"-([\d.]+)", name)
            return float(found[1]) if found else missing

        return cls(
            value("from", 0.0) / 100,
            name.startswith(BACKWARD),
            int(value(EVERY, 1)),
            int(value("noise", 0)),
        )

    def numbers(self, frames: int) -> NDArray[np.intp]:
        """The frames' numbers in the order in which the tracker sees them."""
        way = np.arange(frames)[:: -1 if self.backward else 1]
        return way[int(self.start * frames) :: self.step]

    def seen(self, opened: OpenedSequence) -> NDArray[np.intp]:
        """The same for a sequence's labeled frames, starting with the first true box; empty if fewer than two
        are left.
        """
        boxes = opened.boxes[: opened.frames]
        numbers = self.numbers(len(boxes))
        known = np.flatnonzero(~np.isnan(boxes[numbers]).any(axis=1))
        kept = numbers[known[0] :] if known.size else numbers[:0]
        return kept if len(kept) > 1 else kept[:0]


def orders(protocol: str) -> tuple[Order, ...]:
    """The runs of a protocol. ValueError for an unknown one, and for restarts."""
    if protocol == ONE_PASS:
        return (Order(),)
    if protocol == BACKWARD:
        return (Order(backward=True),)
    if protocol == STARTS:
        return tuple(Order(start, backward) for start in START_SHARES for backward in (False, True))
    word, _, number = protocol.partition("-")
    if word == EVERY and number.isdecimal() and int(number) > 1:
        return (Order(step=int(number)),)
    if word == NOISY and number.isdecimal() and 0 < int(number) <= MAX_DRAWS:
        return tuple(Order(noise=draw) for draw in range(1, int(number) + 1))
    known = f"{ONE_PASS}, {RESTARTS}, {STARTS}, {BACKWARD}, {EVERY}-3, {NOISY}-5"
    raise ValueError(f"protocols: expected some of {known}, got {protocol!r}")


def jittered(box: Box, sequence: str, draw: int) -> Box:
    """The box near a true one on which a noisy run starts: its center moves by NOISE of its size in a random
    direction, and each side is at most NOISE longer or shorter. It is the same for all trackers and machines.
    """
    digest = hashlib.sha256(f"{sequence}\n{draw}".encode()).digest()
    angle, wide, high = (
        int.from_bytes(digest[8 * index : 8 * index + 8], "big") / 2**64 for index in range(3)
    )
    width, height = (
        side * (1 + NOISE) ** (2 * share - 1) for side, share in ((box.width, wide), (box.height, high))
    )
    x, y = box.center
    x += NOISE * box.width * math.cos(2 * math.pi * angle)
    y += NOISE * box.height * math.sin(2 * math.pi * angle)
    return Box(x - width / 2, y - height / 2, width, height)


def read_frames(source: Source, numbers: NDArray[np.intp]) -> Iterator[Frame]:
    """The frames with these numbers, all forward or all backward, then with :func:`forward_times`' times.

    A reversed sequence is decoded in blocks of BLOCK_PIXELS, so that memory doesn't grow with its length.
    """
    wanted = numbers.tolist()
    if wanted == sorted(wanted):
        return source.frames(wanted)
    width, height = source.size
    size = max(1, BLOCK_PIXELS // (width * height * len(source.channels)))
    return forward_times(frame for block in _blocks(wanted, size) for frame in _reversed(source, block))


def forward_times(frames: Iterable[Frame]) -> Iterator[Frame]:
    """Frames in reverse order, with times in seconds from the first one; unknown times stay unknown."""
    first = None
    for index, frame in enumerate(frames):
        first = frame.timestamp if index == 0 else first
        known = first is not None and frame.timestamp is not None
        yield replace(frame, timestamp=first - frame.timestamp) if known else frame  # type: ignore[operator]


def _blocks(numbers: Sequence[int], size: int) -> Iterator[list[int]]:
    rest = iter(numbers)
    while block := list(islice(rest, size)):
        yield block


def _reversed(source: Source, falling: Sequence[int]) -> list[Frame]:
    return list(source.frames(falling[::-1]))[::-1]
