# SPDX-License-Identifier: MIT
"""The ranges of frames in which a target is lost."""

from collections.abc import Iterable
from typing import NamedTuple

from tricue.track.base.track import Status

SHOWN = 6  # ranges in a line


class LostRange(NamedTuple):
    """The first and the last frame of a range, and their times in seconds."""

    first: int
    last: int
    start_s: float
    end_s: float


class LostRanges:
    """Collects the ranges frame by frame."""

    def __init__(self) -> None:
        self.ranges: list[LostRange] = []
        self._is_lost = False

    def add(self, number: int, seconds: float, status: Status) -> None:
        """The target's status in the next frame."""
        if status is Status.LOST:
            if self._is_lost:
                self.ranges[-1] = self.ranges[-1]._replace(last=number, end_s=seconds)
            else:
                self.ranges.append(LostRange(number, number, seconds, seconds))
        self._is_lost = status is Status.LOST

    def interrupt(self) -> None:
        """End a range: nothing is known of the target in the next frame."""
        self._is_lost = False

    def __str__(self) -> str:
        """As in "lost in frames 12-40 (0:00.40-0:01.33), 80 (0:02.67)"; "" if it is never lost."""
        if not self.ranges:
            return ""
        more = len(self.ranges) - SHOWN
        shown = ", ".join(map(_text, self.ranges[:SHOWN]))
        rest = f" and {more} more range{'s' if more > 1 else ''}" if more > 0 else ""
        return f"lost in frames {shown}{rest}"


def clock_time(seconds: float) -> str:
    """Minutes, seconds and hundredths, as in 1:02.50; with hours if needed."""
    hundredths = round(100 * seconds)
    minutes, rest = divmod(hundredths, 6000)
    hours, minutes = divmod(minutes, 60)
    head = f"{hours}:{minutes:02}" if hours else str(minutes)
    return f"{head}:{rest // 100:02}.{rest % 100:02}"


def _text(found: LostRange) -> str:
    if found.first == found.last:
        return f"{found.first} ({clock_time(found.start_s)})"
    return f"{found.first}-{found.last} ({clock_time(found.start_s)}-{clock_time(found.end_s)})"


def as_json(ranges: Iterable[LostRange], target: int | None = None) -> list[dict[str, float]]:
    """The ranges as dictionaries, with times as in tables. target: its id, if there are several."""
    head = {} if target is None else {"id": target}
    rounded = (each._replace(start_s=round(each.start_s, 6), end_s=round(each.end_s, 6)) for each in ranges)
    return [{**head, **each._asdict()} for each in rounded]
