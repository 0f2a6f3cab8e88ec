# SPDX-License-Identifier: MIT
import re

import numpy as np
import pytest
from tricue import Box, Frame, Status, Track

from benchmarks.frame_size import Case, cases
from benchmarks.quality import soak


@pytest.fixture(scope="module")
def case() -> Case:
    """The fused tracker on color, six frames."""
    return next(case for case in cases(6) if case.name == "fused, color")


def test_disturbances_change_the_frames(case: Case) -> None:
    """It proves that the passes of a period show what they say, in the same order of frames."""
    passes = soak.Passes(case)
    assert [index for index, _ in passes.of(50)] == [*range(1, 10), 0]
    hidden = dict(passes.of(soak.COVERED))[8]
    x, y, width, height = (round(value) for value in passes.boxes[8])
    whole = passes.frames[8].color
    assert whole is not None
    assert hidden.color is not None
    changed = (hidden.color != whole).any(axis=2)
    assert changed[y : y + height, x : x + width].mean() > 0.9
    changed[y : y + height, x : x + width] = False
    assert not changed.any()
    black = dict(passes.of(soak.BLANK))[8].color
    assert black is not None
    assert not black.any()


def test_a_run_is_counted(case: Case) -> None:
    """It proves that updates, refusals and overlaps of a run are counted, and its memory measured."""
    found = soak.soak(case, 70)
    assert (found.refused, found.lost, found.astray, len(found.latencies)) == (1, 0, 0, 70)
    assert (found.latencies > 0).all()
    assert len(found.overlaps) == 1
    assert np.min(found.overlaps) > 0.5
    assert 10 < found.early_memory <= found.memory + 1
    assert re.match(r"\| fused, color \| 70 \| 1 \| 0 \| ", soak.row(found))


def test_a_tracker_that_takes_anything_is_told(case: Case) -> None:
    """It proves that what isn't refused fails the run."""

    class Careless:
        def init(self, frame: Frame, box: Box) -> Track:
            return Track(box, 0.5, Status.TRACKED)

        def update(self, frame: object) -> Track:
            return Track(Box(0, 0, 9, 9), 0.5, Status.TRACKED)

    class CarelessCase(Case):
        def make(self, size: tuple[int, int]) -> Careless:
            return Careless()

    careless = CarelessCase(case.name, case.tracker, case.frames, case.boxes, case.small)
    with pytest.raises(ValueError, match="took what is no frame"):
        soak.soak(careless, 1000)
