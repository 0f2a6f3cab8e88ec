# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest
from tricue.papers.okada import curves as walk_curves
from tricue.papers.okada.curves import WalkCurve
from tricue.scenes import Events
from tricue.track.base.track import Status

FRAMES = 100
TIME = np.arange(FRAMES)
EVENTS = Events(hiding=20, hidden=24, back=46, passing=74)
VISIBLE = np.where((TIME >= 20) & (TIME < 46), np.where((TIME >= 24), 0.0, 0.5), 1.0)


def curve(occluded=range(26, 47), **changes):
    """A tracker that is right in every frame, and reports OCCLUDED in some, but for the changes."""
    known = {
        "model": "m",
        "scene": "s",
        "seed": 0,
        "errors": np.full(FRAMES, 0.2),
        "distances": np.full(FRAMES, 4.0),
        "overlaps": np.ones(FRAMES),
        "visible": VISIBLE,
        "statuses": tuple(Status.OCCLUDED if at in occluded else Status.TRACKED for at in range(FRAMES)),
        "events": EVENTS,
        "restarted_overlaps": np.where(TIME < 54, np.nan, 1.0),
        "snapshots": {},
    }
    return WalkCurve(**(known | changes))


def cells(*curves):
    """The first line of their table, by column."""
    line = walk_curves.summarize(curves).splitlines()[2]
    return dict(zip(walk_curves.COLUMNS, (cell.strip() for cell in line.strip("|").split("|")), strict=True))


@pytest.mark.parametrize(("first", "right"), [(19, False), (20, True), (28, True), (29, False)])
def test_occlusion_has_to_be_reported_in_time(first, right):
    """From the first frame with less than 60 % visible to 4 frames after less than 10 % are."""
    assert curve(range(first, 47)).occlusion_reported is right


def test_occlusion_that_is_never_reported_is_wrong():
    """Unless the scene has no occlusion."""
    assert curve([]).occlusion_reported is False
    assert curve([], events=Events(None, None, None, None)).occlusion_reported is None


@pytest.mark.parametrize(("end", "right"), [(46, True), (54, True), (55, False)])
def test_target_has_to_be_recovered_soon(end, right):
    """TRACKED from the 8th frame after a fifth is visible, at the latest."""
    assert curve(range(26, end)).recovered is right


def test_target_has_to_be_recovered_for_good():
    """A frame or four of TRACKED between others don't count."""
    assert curve([*range(26, 46), *range(50, 60)]).recovered is False
    assert curve([*range(26, 46), *range(51, 60)]).recovered is True


@pytest.mark.parametrize(
    ("back", "occluded", "right"),
    [
        (93, range(26, 100), None),
        (93, range(26, 96), None),
        (93, range(26, 95), True),
        (87, range(26, 100), False),
    ],
)
def test_frames_after_the_end_are_no_recovery(back, occluded, right):
    """Nobody knows whether a target is recovered where the scene ends before it could be."""
    assert curve(occluded, events=EVENTS._replace(back=back)).recovered is right


def test_frames_before_the_start_are_no_recovery():
    """The frames from which TRACKED counts don't begin before the first one."""
    events = Events(hiding=0, hidden=0, back=2, passing=None)
    assert curve(range(60), events=events).recovered is False


def test_never_releasing_is_no_recovery():
    """TRACKED in more than 30 % of the frames in which nothing is visible is what follows somebody else."""
    assert curve([]).recovered is False
    assert curve(range(28, 41)).recovered is True  # 5 of 18 frames
    assert curve(range(28, 40)).recovered is False  # 6 of them


def test_frames_in_which_the_target_is_hidden_dont_count():
    """Overlaps and errors count where half is visible."""
    hidden = VISIBLE < 0.5
    row = cells(
        curve(overlaps=np.where(hidden, 0.0, 1.0), errors=np.where(hidden, 9.0, 0.2)),
        curve(overlaps=np.zeros(FRAMES), seed=1),
    )
    assert (row["IoU > 0.5: mean"], row["minimum"]) == ("50.0%", "0%")
    assert (row["error m"], row["% of distance"], row["runs"]) == ("0.20", "5.0", "2")


def test_overtaking_and_pass_are_counted_apart():
    """Shares count in 1 to 19, before the overtaking, 54 to 67, after it, and from 84 on."""
    row = cells(
        curve(overlaps=np.where((TIME > 0) & (TIME < 20), 1.0, 0.0)),
        curve(overlaps=np.where((TIME < 54) | (TIME > 67), 0.0, 1.0)),
        curve(overlaps=np.where(TIME < 84, 0.0, 1.0)),
        curve(overlaps=np.where(TIME < 92, 0.0, 1.0)),
    )
    assert (row["before the overtaking"], row["after it"], row["after the pass"]) == ("25%", "25%", "38%")


def test_pass_is_measured_by_itself():
    """A run that starts after the overtaking has its own shares, before the pass and after it."""
    row = cells(curve(overlaps=np.zeros(FRAMES), restarted_overlaps=np.where(TIME < 54, np.nan, TIME < 80)))
    assert (row["started after it: before the pass"], row["then after it"]) == ("100%", "0%")
    assert (row["after it"], row["after the pass"]) == ("0%", "0%")


def test_second_start_is_on_a_clear_target():
    """After the overtaking, from the first frame with nine tenths visible; in none where it isn't over."""
    visible = np.where(TIME < 58, 0.89, 0.9)
    assert walk_curves.restart_frame(EVENTS, visible) == 58
    assert walk_curves.restart_frame(Events(20, 24, None, None), visible) is None
    assert walk_curves.restart_frame(EVENTS, np.full(FRAMES, 0.5)) is None


def test_short_scene_has_gaps():
    """What the scene is too short for is "-", and no position has no error."""
    row = cells(curve(events=Events(20, None, None, None), errors=np.full(FRAMES, np.nan)))
    for name in (
        "after it",
        "after the pass",
        "then after it",
        "OCCLUDED in time",
        "recovered in time",
        "both",
        "error m",
        "% of distance",
    ):
        assert row[name] == "-"


def test_table_holds_every_frame(tmp_path):
    """A line a frame; an unknown error is empty."""
    walk_curves.write_csv(tmp_path / "all.csv", [curve(), curve(seed=1, errors=np.full(FRAMES, np.nan))])
    with (tmp_path / "all.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["frame"] for row in rows] == [str(at) for at in range(FRAMES)] * 2
    assert (rows[30]["status"], rows[30]["visible"], rows[30]["error_m"]) == ("occluded", "0.0000", "0.2000")
    assert rows[-1]["error_m"] == ""
