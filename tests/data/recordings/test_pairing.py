# SPDX-License-Identifier: MIT
import random
from collections.abc import Iterable

import pytest
from tricue.data.recordings.pairing import MAX_WAITING, Pairing, Timed

Found = list[tuple[int, int]]


def paired(items: Iterable[tuple[str, int]], tolerance: int = 16) -> tuple[Found, dict[str, int]]:
    """The times of the pairs, color first, and how many were left out."""
    pairing: Pairing[None] = Pairing(["color", "depth"], tolerance)
    found = [
        (moment["color"].time, moment["depth"].time)
        for moment in pairing(Timed(channel, time, None) for channel, time in items)
    ]
    return found, {name: pairing.left_out[name] for name in ("color", "depth")}


def alternating(count: int, lag: int) -> list[tuple[str, int]]:
    """Color each 33, and depth lag later, in the order of their times."""
    color = [("color", 33 * index) for index in range(count)]
    return sorted(color + [("depth", time + lag) for _, time in color], key=lambda item: item[1])


@pytest.mark.parametrize("lag", [-15, -5, 0, 5, 15])
def test_the_nearest_is_taken(lag: int) -> None:
    """It proves that each color image gets its depth, before or after it, and none is left out."""
    found, left_out = paired(alternating(100, lag))
    assert found == [(33 * index, 33 * index + lag) for index in range(100)]
    assert left_out == {"color": 0, "depth": 0}


def test_late_images_are_waited_for() -> None:
    """It proves that the order in the file doesn't matter while depth comes a few images late."""
    late = sorted(alternating(60, 5), key=lambda item: item[1] + (200 if item[0] == "depth" else 0))
    found, left_out = paired(late)
    assert found == [(33 * index, 33 * index + 5) for index in range(60)]
    assert left_out == {"color": 0, "depth": 0}


def test_depth_of_half_the_rate() -> None:
    """It proves that color images without depth are left out and counted."""
    items = [item for item in alternating(20, 3) if item[0] == "color" or (item[1] - 3) % 66 == 0]
    found, left_out = paired(items)
    assert found == [(66 * index, 66 * index + 3) for index in range(10)]
    assert left_out == {"color": 10, "depth": 0}


def test_depth_of_a_higher_rate() -> None:
    """It proves that depth images between are left out and counted."""
    color = [("color", 30 * index) for index in range(10)]
    depth = [("depth", 10 * index + 1) for index in range(30)]
    found, left_out = paired(sorted(color + depth, key=lambda item: item[1]), tolerance=15)
    assert found == [(30 * index, 30 * index + 1) for index in range(10)]
    assert left_out == {"color": 0, "depth": 20}


def test_a_depth_image_goes_to_the_nearer_color_image() -> None:
    """It proves that the only depth image isn't taken by an earlier color image than its own."""
    found, left_out = paired([("color", 0), ("depth", 12), ("color", 16), ("color", 50)])
    assert found == [(16, 12)]
    assert left_out == {"color": 2, "depth": 0}


def test_gaps_are_counted() -> None:
    """It proves that lost images of either channel leave the others paired rightly."""
    lost = {("color", 33 * 5), ("color", 33 * 6), ("depth", 33 * 11 + 4), ("depth", 33 * 0 + 4)}
    items = [item for item in alternating(20, 4) if item not in lost]
    found, left_out = paired(items)
    assert found == [(33 * index, 33 * index + 4) for index in range(20) if index not in (0, 5, 6, 11)]
    assert left_out == {"color": 2, "depth": 2}


def test_every_image_is_paired_or_counted() -> None:
    """It proves for random times and orders that no image is used twice, and none gets lost unseen."""
    rng = random.Random(0)
    for _ in range(200):
        items = [(rng.choice(("color", "depth")), rng.randrange(1000)) for _ in range(rng.randrange(80))]
        found, left_out = paired(items)
        assert all(abs(color - depth) <= 16 for color, depth in found)
        for channel in ("color", "depth"):
            assert len(found) + left_out[channel] == sum(name == channel for name, _ in items)


@pytest.mark.parametrize("channel", ["color", "depth"])
def test_little_is_held(channel: str) -> None:
    """It proves that a channel without partner isn't collected: what waits is bounded."""
    pairing: Pairing[None] = Pairing(["color", "depth"], 16)

    def items() -> Iterable[Timed[None]]:
        for index in range(1000):
            yield Timed(channel, 33 * index, None)
            assert sum(map(len, pairing._waiting.values())) <= MAX_WAITING + 1

    assert list(pairing(items())) == []
    assert pairing.left_out[channel] == 1000


def test_one_channel_alone() -> None:
    """It proves that a single channel goes through as it is."""
    pairing: Pairing[None] = Pairing(["depth"], 16)
    found = [moment["depth"].time for moment in pairing(Timed("depth", time, None) for time in (5, 40, 80))]
    assert found == [5, 40, 80]
    assert not +pairing.left_out
