# SPDX-License-Identifier: MIT
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
    assert (found.updates, found.refused, found.lost, found.found, found.restarted) == (70, 1, 0, 0, 0)
    assert found.latencies == sorted(found.latencies)
    assert found.latencies[0] > 0
    assert len(found.overlaps) == 1
    assert found.overlaps[0] > 0.5
    assert 10 < found.early_memory <= found.memory + 1
    assert soak.row(found).startswith("| fused, color | 70 | 1 | 0 | 0 | 0 | ")
    page = soak.section([found])
    assert len({line.count("|") for line in page.splitlines() if line.startswith("| fused")}) == 2


def test_a_lost_target_is_counted_as_found_only_on_the_target(case: Case) -> None:
    """It proves that what is lost is counted once, and as found where it is, not elsewhere.

    A tracker that is beside the target at the end of a pass starts again.
    """

    class Scripted:
        def __init__(self, script: list[tuple[Box, Status]]) -> None:
            self.script = iter(script)

        def init(self, frame: Frame, box: Box) -> Track:
            return Track(box, 0.5, Status.TRACKED)

        def update(self, frame: object) -> Track:
            if not isinstance(frame, Frame):
                raise TypeError
            box, status = next(self.script)
            return Track(box, 0.5, status)

    class ScriptedCase(Case):
        def make(self, size: tuple[int, int]) -> Scripted:
            box, far = self.box(0, size), Box(0, 0, 2, 2)
            lost, on, off = (far, Status.LOST), (box, Status.TRACKED), (far, Status.TRACKED)
            return Scripted([lost, lost, on, lost, off, *5 * [off]] + 5 * [on])

    scripted = ScriptedCase(case.name, case.tracker, case.frames, case.boxes, case.small)
    found = soak.soak(scripted, 15)
    assert (found.lost, found.found, found.restarted) == (2, 1, 1)


def test_memory_that_grows_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the slope is that of the last nine tenths of a run, whatever was allocated before."""
    megabytes = iter([*(1.0,) * 10, *(50 + 0.002 * i for i in range(90))])
    monkeypatch.setattr(soak, "resident_megabytes", lambda: next(megabytes))
    memory = soak.Memory()
    for number in range(100):
        memory.measure(1000 * number)
    early, last, growth = memory.summary()
    assert (early, last) == (50, pytest.approx(50.178))
    assert growth == pytest.approx(200)


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
