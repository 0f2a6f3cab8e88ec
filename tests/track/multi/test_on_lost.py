# SPDX-License-Identifier: MIT
"""The function that is called for each target that becomes LOST."""

import numpy as np
import pytest
from tricue import Frame, MultiTracker, Status, Track

from tests.track.multi.kinds import on


@pytest.mark.parametrize("workers", [1, 2])
def test_a_lost_target_is_told_once(workers, things):
    """on_lost is called when it becomes LOST, after the update, and once more when it is lost again."""
    told: list[tuple[int, Status, Status]] = []
    several = MultiTracker(workers=workers)
    several.on_lost = lambda number, track: told.append((number, track.status, several.tracks[number].status))
    black = Frame(np.zeros_like(things.frames[0].color))
    with several:
        for box in things.boxes[:2]:
            several.add(things.frames[0], box)
        on(several, things.frames[1:3])
        assert told == []
        on(several, 6 * [black])
        assert told == [(1, Status.LOST, Status.LOST), (2, Status.LOST, Status.LOST)]
        on(several, 4 * [things.frames[2]])
        assert {track.status for track in several.tracks.values()} == {Status.TRACKED}
        on(several, 6 * [black])
        assert [number for number, *_ in told] == [1, 2, 1, 2]


def test_on_lost_may_remove_targets(things):
    """So a loop can drop a target where it is lost."""
    several = MultiTracker()
    several.on_lost = lambda number, _: several.remove(number)
    for box in things.boxes[:2]:
        several.add(things.frames[0], box)
    on(several, 6 * [Frame(np.zeros_like(things.frames[0].color))])
    assert several.ids == ()


def test_on_lost_is_not_called_for_what_it_removed(things):
    """Where the first of those that are lost ends them all."""
    told: list[int] = []
    several = MultiTracker()

    def end(number: int, _: Track) -> None:
        told.append(number)
        for each in several.ids:
            several.remove(each)

    several.on_lost = end
    for box in things.boxes[:3]:
        several.add(things.frames[0], box)
    on(several, 6 * [Frame(np.zeros_like(things.frames[0].color))])
    assert told == [1]


def test_an_error_of_on_lost_hides_no_other_loss(things):
    """It is called for all, and the tracks are those of that frame; then the first error is raised."""
    told: list[int] = []

    def tell(number: int, track: Track) -> None:
        told.append(number)
        raise OSError(f"no siren for {number}")

    several = MultiTracker(on_lost=tell)
    for box in things.boxes[:3]:
        several.add(things.frames[0], box)
    with pytest.raises(OSError, match="no siren for 1"):
        on(several, 6 * [Frame(np.zeros_like(things.frames[0].color))])
    assert told == [1, 2, 3]
    assert {track.status for track in several.tracks.values()} == {Status.LOST}
