# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest
from tricue import Status
from tricue.papers.sabeti_depth import curves as depth_curves
from tricue.papers.sabeti_depth.curves import DepthCurve

LETTERS = {"T": Status.TRACKED, "O": Status.OCCLUDED, "L": Status.LOST}


def curve(visible, statuses="", overlaps=None, errors=None, on_other=None, starts=None, model="m"):
    """A curve of as many frames as ``visible``; statuses by their first letters, all TRACKED without."""
    count = len(visible)
    return DepthCurve(
        model,
        "s",
        0,
        errors=np.full(count, 0.1) if errors is None else np.array(errors, float),
        overlaps=np.ones(count) if overlaps is None else np.array(overlaps, float),
        visible=np.array(visible, float),
        statuses=tuple(LETTERS[letter] for letter in statuses) or count * (Status.TRACKED,),
        boxes=np.zeros((count, 4)),
        on_other=np.zeros(count, bool) if on_other is None else np.array(on_other, bool),
        starts=starts,
    )


def cells(*curves):
    """The last line of the table, by column."""
    *_, line = depth_curves.summarize(curves).splitlines()
    return dict(zip(depth_curves.COLUMNS, line.strip("| ").split(" | "), strict=True))


@pytest.mark.parametrize(("statuses", "soon"), [("TTTTOOT", True), ("TTTTTOO", False), ("OTTTTTT", False)])
def test_occlusion_is_reported_within_three_frames(statuses, soon):
    """A target hidden from frame 1 on is reported in time in frame 4, the third after it, not in frame 5."""
    assert curve([1, 0.1, 0, 0, 0, 0, 0], statuses).occlusion_reported == [soon]


def test_hidden_ends_at_half_visibility():
    """A share between 0.15 and 0.5 neither begins nor ends an occlusion; without an end is no recovery."""
    assert len(curve([1, 0.2, 0.1, 0.3, 0.1, 0.6, 1]).occlusion_reported) == 1
    assert len(curve([1, 0.1, 0.6, 0.1, 0.6]).recovered) == 2
    never = curve([1, 0.1, 0.4, 0.4])
    assert (len(never.occlusion_reported), never.recovered) == (1, [])
    assert curve([1, 0.16, 1]).occlusion_reported == []


@pytest.mark.parametrize(
    ("statuses", "overlaps", "soon"),
    [
        ("TOOOOOOTT", [1, 0, 0, 0, 0, 0, 0, 0.6, 0.6], True),  # five frames after half visibility in frame 2
        ("TOOOOOOOT", [1, 0, 0, 0, 0, 0, 0, 0.6, 0.6], False),  # one later
        ("TOOOOOOTT", [1, 0, 0, 0, 0, 0, 0, 0.4, 0.6], False),  # not on it
    ],
)
def test_recovered_is_tracked_on_the_right_person_within_five_frames(statuses, overlaps, soon):
    """TRACKED and an overlap above 0.5 count together, up to the fifth frame after half visibility."""
    assert curve([1, 0, 0.5, 1, 1, 1, 1, 1, 1], statuses, overlaps).recovered == [soon]


@pytest.mark.parametrize(
    ("statuses", "overlaps", "correct"),
    [
        ("TTTTTT", [0, 0.4, 0.6, 0.6, 0.6, 0.6], True),
        ("TTTTTT", [1, 0.4, 0.4, 0.6, 0.6, 0.4], False),  # the frame before the last five doesn't count
        ("TTTTTO", [0, 0.9, 0.9, 0.9, 0.9, 0.9], False),
    ],
)
def test_end_is_correct_by_overlap_and_status(statuses, overlaps, correct):
    """The last five frames' mean overlap is above 0.5 and the last one TRACKED: a box left behind isn't."""
    assert curve([1] * 6, statuses, overlaps).correct_at_end is correct


def test_summary_counts_visible_frames_and_runs():
    """Each number of the table is that of two hand-made runs; frames less than half visible don't count."""
    first = curve(
        [1, 0.1, 1, 1, 1, 1, 1],
        "TOTTTTT",
        overlaps=[0.8, 0, 0.6, 0.6, 0.6, 0.6, 0.6],
        errors=[0.1, 9, 0.2, 0.2, 0.2, 0.2, 0.3],
        starts=True,
    )
    second = curve(
        [1, 0.1, 1, 1, 1, 1, 1],
        "TTTLLLL",
        overlaps=[0.8, 0, 0.6, 0.6, 0.6, 0.6, 0.4],
        errors=[0.2, 9, 0.2, 0.2, 0.2, 0.2, np.nan],
        on_other=[0, 1, 1, 0, 0, 0, 0],
        starts=False,
    )
    assert list(cells(first, second).values()) == [
        *("s", "m", "0.62", "20.0", "25.0"),
        *("50%", "50%", "100%", "2", "50%", "50%", "2"),
    ]


def test_what_was_not_measured_is_a_dash():
    """Without position, occlusion or a start by itself there is no number, and no warning either."""
    row = cells(curve([1, 1, 1], errors=[np.nan] * 3))
    assert [name for name, cell in row.items() if cell == "-"] == [
        *("error cm: median", "95 %", "OCCLUDED within 3", "recovered within 5", "correct start")
    ]


def test_csv_has_a_line_a_frame(tmp_path):
    """The file holds every frame's numbers under their names; an unknown error is empty."""
    made = curve([1, 0.1], "TO", overlaps=[0.75, 0], errors=[0.05, np.nan], on_other=[0, 1])
    depth_curves.write_csv(tmp_path / "c.csv", [made])
    with (tmp_path / "c.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert rows == [
        dict(zip(depth_curves.CSV_COLUMNS, ["m", "s", "0", *line], strict=True))
        for line in (
            ["0", "0.0500", "0.7500", "1.0000", "tracked", "0"],
            ["1", "", "0.0000", "0.1000", "occluded", "1"],
        )
    ]
