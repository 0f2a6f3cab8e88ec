# SPDX-License-Identifier: MIT
from types import SimpleNamespace

import numpy as np
from tricue.track.base.track import Status

from benchmarks.quality.common import scene_runs
from benchmarks.quality.common.scene_runs import faithful, longest_run, recovered, reported_lost
from benchmarks.quality.common.variants import parse_variants

BOX, AWAY, NAN = (10.0, 10, 20, 20), (100.0, 100, 20, 20), float("nan")


def scene(visible, **spans):
    """Of as many frames as shares are given; the target stands still, a look-alike elsewhere."""
    count = len(visible)
    others = np.tile(AWAY, (count, 1))
    return SimpleNamespace(
        boxes=np.tile(BOX, (count, 1)),
        visible=np.array(visible, float),
        lookalikes=(np.full((count, 4), NAN), others),
        spans=spans,
    )


def run(boxes, statuses=None):
    """A tracker's boxes and statuses."""
    reported = statuses or [Status.TRACKED] * len(boxes)
    return SimpleNamespace(boxes=np.array(boxes, float), statuses=tuple(reported))


def test_recovered_in_time():
    """Ten frames count from where the target is whole: the tenth is in time, the eleventh is not; half
    visible frames before don't count, and an event without a return isn't asked for.
    """
    visible = [1, 1, 0, 0, 0.5, 0.5, *[1] * 12]
    one = scene(visible, hidden=range(1, len(visible)))
    for late, expected in ((9, 1), (10, 0)):
        boxes = [AWAY] * (6 + late) + [BOX] * (12 - late)
        assert recovered(run(boxes), one) == expected
    assert np.isnan(recovered(run([BOX] * 18), scene(visible)))
    assert np.isnan(recovered(run([BOX] * 3), scene([1, 0, 0], leaving=range(3))))
    both = scene([1, 0, 1, *[1] * 20, 0, 1], leaving=range(10), hidden=range(20, 25))
    assert recovered(run([BOX] * 10 + [AWAY] * 15), both) == 0.5


def test_faithful_for_five_frames():
    """Five frames TRACKED on a look-alike are tolerated, six aren't, if no other status interrupts them."""
    one = scene([1] * 10, lookalike=range(10))
    assert faithful(run([AWAY] * 5 + [BOX] * 5), one) == 1
    assert faithful(run([AWAY] * 6 + [BOX] * 4), one) == 0
    statuses = [Status.TRACKED] * 3 + [Status.OCCLUDED] + [Status.TRACKED] * 6
    assert faithful(run([AWAY] * 8 + [BOX] * 2, statuses), one) == 1
    assert faithful(run([(200, 200, 5, 5)] * 10), one) == 1
    assert np.isnan(faithful(run([AWAY] * 10), scene([1] * 10)))
    assert longest_run(np.array([True, True, False, True])) == 2


def test_faithful_while_the_target_is_away():
    """Whatever is TRACKED where nothing of the target is visible is something else."""
    one = scene([1, *[0] * 6, 1, 1], hidden=range(9))
    assert faithful(run([BOX] * 9), one) == 0
    statuses = [Status.TRACKED] * 6 + [Status.LOST, Status.TRACKED, Status.TRACKED]
    assert faithful(run([BOX] * 9, statuses), one) == 1


def test_lost_has_to_be_reported_in_three_frames():
    """From the first frame without the target on."""
    one = scene([1, 1, 0, 0, 0, 0], blank=range(1, 6))
    for late, expected in ((0, 1), (2, 1), (3, 0)):
        statuses = [Status.TRACKED] * (2 + late) + [Status.LOST] * (4 - late)
        assert reported_lost(run([BOX] * 6, statuses), one) == expected
    assert np.isnan(reported_lost(run([BOX] * 2), scene([1, 0])))


def test_trackers_get_only_their_channels():
    """In a scene of color and depth, each tracker gets its channels; one that lacks some is left out."""
    found = parse_variants(["still-box", "flow-depth", "flow-depth:depth", "stereo-head"])
    results = scene_runs.run_scene(scene_runs.SceneTask("plain", 0, "rgbd", found))
    assert [each.tracker for each in results] == ["still-box", "flow-depth", "flow-depth:depth"]
    still, both, depth = results
    assert np.isnan(still.errors).all()
    assert np.nanmedian(both.errors) < 0.05
    assert np.nanmedian(depth.errors) < 0.05
    assert both.frames.overlaps[both.counted].mean() > still.frames.overlaps[still.counted].mean() + 0.3
    assert (
        scene_runs.run_scene(scene_runs.SceneTask("plain", 0, "color", parse_variants(["stereo-head"]))) == []
    )
