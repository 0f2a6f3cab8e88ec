# SPDX-License-Identifier: MIT
import json

from tricue import Status
from tricue.export.lost_ranges import LostRanges, as_json, clock_time

TRACKED, OCCLUDED, LOST = Status.TRACKED, Status.OCCLUDED, Status.LOST


def ranges(statuses: list[Status]) -> LostRanges:
    """Those of statuses at 10 frames a second, from frame 5 on."""
    found = LostRanges()
    for number, status in enumerate(statuses, 5):
        found.add(number, number / 10, status)
    return found


def test_ranges_begin_and_end_where_the_target_is_lost() -> None:
    """It proves that frames in a row are one range, and an occluded frame is in none."""
    found = ranges([TRACKED, LOST, LOST, OCCLUDED, LOST, TRACKED])
    assert [each[:2] for each in found.ranges] == [(6, 7), (9, 9)]
    assert str(found) == "lost in frames 6-7 (0:00.60-0:00.70), 9 (0:00.90)"
    assert json.loads(json.dumps(as_json(found.ranges, 3)))[1] == {
        "id": 3,
        "first": 9,
        "last": 9,
        "start_s": 0.9,
        "end_s": 0.9,
    }


def test_a_target_that_is_never_lost_has_none() -> None:
    """It proves that there is no line about nothing."""
    assert str(ranges([TRACKED, OCCLUDED, TRACKED])) == ""


def test_many_ranges_are_counted() -> None:
    """It proves that a line stays a line."""
    assert str(ranges([TRACKED, LOST] * 9)).endswith("16 (0:01.60) and 3 more ranges")
    assert str(ranges([TRACKED, LOST] * 7)).endswith("16 (0:01.60) and 1 more range")


def test_times_are_those_of_a_clock() -> None:
    """It proves that rounding carries, and hours stand only where there are some."""
    assert [clock_time(each) for each in (0, 59.999, 61.5, 3600)] == [
        "0:00.00",
        "1:00.00",
        "1:01.50",
        "1:00:00.00",
    ]
