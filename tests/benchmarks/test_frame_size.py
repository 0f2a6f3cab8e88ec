# SPDX-License-Identifier: MIT
"""One target in larger frames: the frames, the cameras, the table's place, and frames of 7680x4320."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tricue import Intrinsics
from tricue.evaluation import metrics
from tricue.evaluation.one_pass import run
from tricue.track.base import registry

from benchmarks import frame_size, large_frames
from tools.page_sections import with_section

ROOT = Path(__file__).parents[2]
MAX_BYTES_AT_START = 30  # per pixel of a pair: corners are looked for in all of it, once
MAX_SHARE = 0.5  # of the frame's memory: gray images of a pair are copies


@pytest.fixture(scope="module")
def cases() -> list[frame_size.Case]:
    """All, with few frames."""
    return list(frame_size.cases(4))


def test_every_tracker_has_a_case(cases: list[frame_size.Case]) -> None:
    """Each of ours is measured; the names of the rows differ."""
    assert {case.tracker for case in cases} == set(registry.names())
    assert len({case.name for case in cases}) == len(cases)


def test_the_scene_stays_the_same(cases: list[frame_size.Case]) -> None:
    """The small frame stands unchanged where its box and its camera are said to be."""
    for case in cases:
        size = (case.small[0] + 51, case.small[1] + 30)
        box, old = case.box(1, size), case.boxes[1]
        assert tuple(box) == pytest.approx((old[0] + 25, old[1] + 15, old[2], old[3]))
        for channel in ("color", "depth", "right"):
            small, whole = (getattr(each, channel) for each in (case.frames[1], case.at(size)[1]))
            assert (small is None) == (whole is None)
            if small is not None:
                assert whole.shape[:2] == size[::-1]
                inside = whole[15 : 15 + case.small[1], 25 : 25 + case.small[0]]
                np.testing.assert_array_equal(inside, small)


def test_camera_sees_the_same_points() -> None:
    """A point in front of the camera is in the same pixel of the scene, wherever that stands."""
    small = Intrinsics(100, 110, 79.5, 59.5, 160, 120)
    wide = frame_size.widened(small, (200, 140))
    point = [0.1, 0.2, 2.0]
    np.testing.assert_allclose(wide.project(point), small.project(point) + [20, 10])
    assert (wide.width, wide.height) == (200, 140)


def test_frames_of_the_own_size_are_followed(cases: list[frame_size.Case]) -> None:
    """Each tracker follows its target, so that what is timed is tracking."""
    for case in cases:
        found = run(case.make(case.small), case.at(case.small), case.box(0, case.small))
        assert (metrics.overlaps(found.boxes, case.boxes) > 0.4).all(), case.name


def test_section_is_replaced_in_its_place() -> None:
    """The table is put where its heading stands, else at the end; all else stays."""
    new = f"{frame_size.HEADING}\n\nnew\n"
    assert with_section("# A\n\ntext\n", new) == f"# A\n\ntext\n\n{new}"
    old = f"# A\n\n{frame_size.HEADING}\n\nold\n\n## B\n\nmore\n"
    assert with_section(old, new) == f"# A\n\n{frame_size.HEADING}\n\nnew\n\n## B\n\nmore\n"
    assert with_section(f"# A\n\n{new}", new) == f"# A\n\n{new}"
    below = f"# A\n\n#{frame_size.HEADING}\n\ntext\n"
    assert with_section(below, new) == f"{below}\n{new}"
    assert with_section(new, new) == new


@pytest.mark.slow
def test_frames_of_7680x4320() -> None:
    """Each tracker starts and updates on 8K frames, and tells the memory that it takes beside them."""
    command = [sys.executable, "-m", "benchmarks.large_frames"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    print(done.stdout)
    assert done.returncode == 0, done.stderr
    rows = [re.split(r" *\| *", line)[1:-1] for line in done.stdout.splitlines()[2:]]
    assert [row[0] for row in rows] == [case.name for case in frame_size.cases(2)]
    pixels = large_frames.LARGE[0] * large_frames.LARGE[1] / 1e6
    for name, frame, at_start, more, _, status in rows:
        assert float(at_start) < MAX_BYTES_AT_START * pixels, name
        assert float(more) < MAX_SHARE * float(frame), name
        assert status in ("TRACKED", "OCCLUDED", "LOST"), name
