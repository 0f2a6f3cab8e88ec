# SPDX-License-Identifier: MIT
import csv
from types import SimpleNamespace

import numpy as np
import pytest
from tricue.track.base.track import Status

from benchmarks.quality.fused import ablation, robust, scene_runs, scenes
from benchmarks.quality.fused.scene_runs import Followed, faithful, found_again, longest, told
from benchmarks.quality.fused.status_metrics import Said
from benchmarks.quality.fused.variants import participants

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
    """What a tracker said."""
    said = statuses or [Status.TRACKED] * len(boxes)
    return SimpleNamespace(boxes=np.array(boxes, float), statuses=tuple(said))


def test_found_again_in_time():
    """Ten frames count from where the target is whole: the tenth is in time, the eleventh is not; half
    visible frames before don't count, and an event without a return isn't asked for.
    """
    visible = [1, 1, 0, 0, 0.5, 0.5, *[1] * 12]
    one = scene(visible, hidden=range(1, len(visible)))
    for late, expected in ((9, 1), (10, 0)):
        boxes = [AWAY] * (6 + late) + [BOX] * (12 - late)
        assert found_again(run(boxes), one) == expected
    assert np.isnan(found_again(run([BOX] * 18), scene(visible)))
    assert np.isnan(found_again(run([BOX] * 3), scene([1, 0, 0], leaving=range(3))))
    both = scene([1, 0, 1, *[1] * 20, 0, 1], leaving=range(10), hidden=range(20, 25))
    assert found_again(run([BOX] * 10 + [AWAY] * 15), both) == 0.5


def test_faithful_for_five_frames():
    """Five frames TRACKED on a look-alike are forgiven, six aren't, unless the status tells of doubt."""
    one = scene([1] * 10, lookalike=range(10))
    assert faithful(run([AWAY] * 5 + [BOX] * 5), one) == 1
    assert faithful(run([AWAY] * 6 + [BOX] * 4), one) == 0
    doubt = [Status.TRACKED] * 3 + [Status.OCCLUDED] + [Status.TRACKED] * 6
    assert faithful(run([AWAY] * 8 + [BOX] * 2, doubt), one) == 1
    assert faithful(run([(200, 200, 5, 5)] * 10), one) == 1
    assert np.isnan(faithful(run([AWAY] * 10), scene([1] * 10)))
    assert longest(np.array([True, True, False, True])) == 2


def test_lost_is_told_in_three_frames():
    """From the first frame without the target on."""
    one = scene([1, 1, 0, 0, 0, 0], blank=range(1, 6))
    for late, expected in ((0, 1), (2, 1), (3, 0)):
        said = [Status.TRACKED] * (2 + late) + [Status.LOST] * (4 - late)
        assert told(run([BOX] * 6, said), one) == expected
    assert np.isnan(told(run([BOX] * 2), scene([1, 0])))


def followed(kind="plain", overlaps=(1.0, 0.6, 0.0), seen=(True, True, False), errors=(0.0, 0.2, NAN)):
    """Three frames, the last without the target."""
    gone = np.array([False, False, True])
    said = Said(np.array(overlaps), gone, np.array([1.0, 0.9, 0.2]), ~gone, np.full(2, 1e-3))
    return Followed("x", kind, 0, "color", said, np.array(errors), np.array(seen), NAN, 1.0, NAN)


def test_only_seen_frames_count():
    """Of overlaps and positions; the frame without a target counts as lost in AUROC."""
    line = dict(zip(scenes.NUMBERS, scenes.numbers_of([followed()]), strict=True))
    assert line["mean IoU"] == pytest.approx(0.8)
    assert line["IoU > 0.5"] == 1
    assert line["position, median m"] == pytest.approx(0.1)
    assert line["90 %"] == pytest.approx(0.18)
    assert line["with position"] == 1
    assert np.isnan(line["found again"])
    assert (line["faithful"], line["AUROC"]) == (1, 1)


def test_each_kind_counts_the_same():
    """In the mean of overlaps over kinds, though one has more scenes."""
    runs = [followed(), followed(), followed("fast", overlaps=(0.5, 0.1, 0.0))]
    assert scenes.overall(runs)[0] == pytest.approx((0.8 + 0.3) / 2)
    assert scenes.numbers_of(runs)[0] == pytest.approx((0.8 + 0.8 + 0.3) / 3)


def test_trackers_see_only_their_channels():
    """In one scene of color and depth, each with its channels; who can't see them is left out."""
    found = participants(["still-box", "flow-depth", "flow-depth:depth", "stereo-head"])
    results = scene_runs.perform(scene_runs.Task("plain", 0, "rgbd", found))
    assert [each.tracker for each in results] == ["still-box", "flow-depth", "flow-depth:depth"]
    still, both, depth = results
    assert np.isnan(still.errors).all()
    assert np.nanmedian(both.errors) < 0.05
    assert np.nanmedian(depth.errors) < 0.05
    assert both.said.overlaps[both.seen].mean() > still.said.overlaps[still.seen].mean() + 0.3
    assert scene_runs.perform(scene_runs.Task("plain", 0, "color", participants(["stereo-head"]))) == []


def test_the_command_prints_and_writes(monkeypatch, tmp_path, capsys):
    """A table for each set of channels with a line a kind and tracker, and their mean."""
    made = {("color", "still-box"): followed, ("depth", "still-box"): followed}
    monkeypatch.setattr(
        scenes,
        "perform",
        lambda task: [
            followed(task.kind)._replace(channels=task.channels, tracker=each.label)
            for each in task.participants
            if (task.channels, each.label) in made
        ],
    )
    words = ["--trackers", "still-box", "fused", "--kinds", "fast", "plain", "--channels", "depth", "color"]
    assert scenes.main([*words, "--seeds", "0:2", "--csv", str(tmp_path / "o.csv")]) == 0
    printed = capsys.readouterr().out
    assert printed.index("color\n\n| kind") < printed.index("depth\n\n| kind")
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [(line["channels"], line["kind"]) for line in lines] == [
        (channels, kind) for channels in ("color", "depth") for kind in ("plain", "fast", "mean")
    ]
    assert {float(line["mean IoU"]) for line in lines} == {0.8}


def test_the_ablation_has_a_row_a_cue(monkeypatch, folders, tmp_path, capsys):
    """All cues, without each, and no other row without cv2's CSRT; recordings and scenes side by side."""
    found = [each for each in ablation.contestants() if each.label != ablation.PEER]
    cues = found[0].contender(ablation_offer())._tracker.params.cues
    assert [each.label for each in found] == ["fused", *(f"without {cue}" for cue in cues)]
    for each in found[1:]:
        cut = each.contender(ablation_offer())._tracker.params.cues
        assert set(cues) - set(cut) == {each.label.removeprefix("without ")}
    monkeypatch.setattr(ablation, "contestants", lambda: found[:2])
    monkeypatch.setattr(
        scene_runs,
        "perform",
        lambda task: [followed(task.kind)._replace(tracker=e.label, channels=task.channels) for e in found],
    )
    assert ablation.main([str(folders), "--seeds", "0:1", "--csv", str(tmp_path / "o.csv")]) == 0
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [line[""] for line in lines] == ["fused", found[1].label]
    assert {float(line["stereo"]) for line in lines} == {0.8}
    assert all(float(line[protocol]) > 0 for line in lines for protocol in robust.PROTOCOLS)
    assert "| fused |" in capsys.readouterr().out


def ablation_offer():
    """Color alone."""
    from benchmarks.quality.fused.variants import Offered

    return Offered(("color",))
