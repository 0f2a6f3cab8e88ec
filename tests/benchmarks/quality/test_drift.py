# SPDX-License-Identifier: MIT
import pytest

from benchmarks.quality import drift
from benchmarks.quality.common import sequences


@pytest.fixture(scope="module")
def cases(data) -> list[drift.Case]:
    """Nine dozens of frames of David."""
    return list(drift.cases(sequences.load(data / "color" / "David")))


def test_cases_are_small_frames_with_boxes_in_them(cases) -> None:
    """It proves that starts and steps are those that are told, and boxes those of the reduced frames."""
    assert [(case.start, case.step) for case in cases[:4]] == [(0, 1), (0, 5), (0, 10), (120, 1)]
    for case in cases:
        assert [image.shape for image in case.frames] == 12 * [(120, 160, 3)]
        assert (case.boxes[:, :2] > 0).all()
        assert (case.boxes[:, :2] + case.boxes[:, 2:] < drift.SIZE).all()


@pytest.mark.parametrize("number", range(9))
def test_fused_does_not_drift(cases, number) -> None:
    """It proves that after 3,000 updates the overlap is at least 0.9 of that in the first pass."""
    first, last = drift.drift("fused", cases[number])
    assert last >= 0.9 * first


@pytest.mark.slow
@pytest.mark.parametrize("number", range(9))
def test_color_particle_does_not_drift(cases, number) -> None:
    """It proves the same of the means over five seeds; one run's differ by a few hundredths."""
    first, last = drift.drift_by_seed("color-particle", range(5), cases[number])
    assert last.mean() >= 0.9 * first.mean()
