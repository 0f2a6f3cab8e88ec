# SPDX-License-Identifier: MIT
import dataclasses
import pickle
from typing import Any

import numpy as np
import pytest
from tricue import Box, Status, Track

BOX = Box(1.0, 2.0, 3.0, 4.0)
TRACK = Track(BOX, 0.5, Status.TRACKED, np.array([0.1, 0.2, 3.0]), np.eye(3))


def test_status_reads_as_a_word() -> None:
    """It proves that a status prints, formats and compares as its word, on every Python version."""
    assert [f"{status}" for status in Status] == ["tracked", "occluded", "lost"]
    assert {"lost": 1}[Status.LOST] == 1
    assert Status("occluded") is Status.OCCLUDED


def test_a_track_is_frozen() -> None:
    """It proves that nobody can change a track that was returned."""
    with pytest.raises(dataclasses.FrozenInstanceError):
        TRACK.score = 1.0  # type: ignore[misc]


def test_tracks_compare_to_the_last_bit() -> None:
    """It proves that equality looks at every field, arrays included."""
    assert pickle.loads(pickle.dumps(TRACK)) == TRACK
    assert Track(BOX, 0.5, Status.LOST) == Track(BOX, 0.5, Status.LOST)
    others: list[dict[str, Any]] = [
        {"box": BOX._replace(x=np.nextafter(1.0, 2.0))},
        {"score": 0.6},
        {"status": Status.LOST},
        {"position": None},
        {"position": np.array([0.1, 0.2, np.nextafter(3.0, 4.0)])},
        {"covariance": 2 * np.eye(3)},
        {"depth": 3.0},
    ]
    for change in others:
        assert dataclasses.replace(TRACK, **change) != TRACK
    assert TRACK != BOX
