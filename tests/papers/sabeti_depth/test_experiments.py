# SPDX-License-Identifier: MIT
import csv
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from tricue import DepthParticleTracker, Status, Track
from tricue.errors import TargetNotFoundError
from tricue.papers import reproduce
from tricue.papers.experiment import Case
from tricue.papers.sabeti_depth import experiments as depth_experiments
from tricue.scenes import crossing, walker
from tricue.track.depth_particle.params import DepthParticleParams

pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install tricue[demo]")

EXPERIMENT = depth_experiments.EXPERIMENTS["sabeti-depth"]
CASE = Case("m", "s", 0)


class Follower:
    """Reports the truth of one of a scene's people, TRACKED in every frame; may start without a box."""

    traits = DepthParticleTracker.traits

    def __init__(self, scene, who=None, off=0.0, first=None):
        self._boxes = scene.boxes if who is None else [others[who].box for others in scene.others]
        places = scene.positions if who is None else [others[who].position for others in scene.others]
        self._places = [np.asarray(place) + [off, 0, 0] for place in places]
        self._first = first

    def init(self, frame, box=None):
        self._index = 0
        if box is None and self._first is None:
            raise TargetNotFoundError("box: found nobody")
        return self._track(self._first if box is None else self._boxes[0])

    def update(self, frame):
        self._index += 1
        return self._track(self._boxes[self._index])

    def _track(self, box):
        return Track(box, 1.0, Status.TRACKED, self._places[self._index])


def measured(scene, **how):
    """The curve of a Follower."""
    return depth_experiments.measure(CASE, lambda seed, intrinsics: Follower(scene, **how), scene)


def test_errors_are_those_of_the_positions():
    """True boxes and positions 7 cm beside the truth have an overlap of 1 and errors of 7 cm."""
    scene = walker(seed=1, frames=5)
    curve = measured(scene, off=0.07)
    assert (curve.model, curve.scene, curve.seed) == CASE
    np.testing.assert_allclose(curve.errors, 0.07)
    np.testing.assert_allclose(curve.overlaps, 1.0)
    np.testing.assert_array_equal(curve.visible, scene.visible)
    assert not curve.on_other.any()


def test_tracking_somebody_else_is_counted():
    """TRACKED at the position of who crosses is counted in every frame, and at the target's in none."""
    scene = crossing(seed=1, frames=30)
    assert measured(scene, who=0).on_other.all()
    assert not measured(scene).on_other.any()
    assert not measured(scene, who=0, off=depth_experiments.MAX_OTHER_DISTANCE + 0.01).on_other.any()


def test_starts_without_a_box_are_tested_with_one_person():
    """A walker's curve has whether the start found the person, nobody or a wrong box; a crossing's hasn't."""
    scene = walker(seed=1, frames=2)
    assert measured(scene, first=scene.boxes[0]).starts is True
    assert measured(scene, first=scene.boxes[0]._replace(x=-500.0)).starts is False
    assert measured(scene).starts is False
    assert measured(crossing(seed=1, frames=30)).starts is None


def test_variants_differ_from_the_default_as_they_say():
    """One part at a time is taken from the default, and all at once are the paper's own form."""
    default = DepthParticleParams()
    kept = {name: dict(maker.keywords) for name, maker in EXPERIMENT.models.items()}
    assert list(kept) == [
        *("default", "absolute histogram", "no contrast", "object as proposal only", "as printed")
    ]
    assert kept["default"] == {}
    paper = kept.pop("as printed")
    assert paper == {"params": DepthParticleParams.paper()}
    for keywords in kept.values():
        assert all(getattr(default, name) != value for name, value in keywords.items())
        assert all(getattr(paper["params"], name) == value for name, value in keywords.items())


def test_scenes_are_those_of_the_paper_and_harder_ones():
    """One person and a crossing, each also with missing pixels and with noise; once the depth changes."""
    keywords = [getattr(make, "keywords", {}) for make in EXPERIMENT.scenes.values()]
    makes = [getattr(make, "func", make) for make in EXPERIMENT.scenes.values()]
    assert list(zip(makes, keywords, strict=True)) == [
        *((walker, {}), (walker, {"missing": 0.3}), (walker, {"noise": 3.0})),
        *((crossing, {}), (crossing, {"depth_change": 0.5})),
        *((crossing, {"missing": 0.3}), (crossing, {"noise": 3.0})),
    ]


@pytest.mark.slow
def test_default_follows_and_the_printed_form_does_not(tmp_path, monkeypatch):
    """Through one occlusion the default keeps the right person, within 10 cm; as printed it is on nobody at
    the end of each run, and several times as far off on the way.
    """
    short = replace(
        EXPERIMENT,
        scenes={"hidden": partial(crossing, frames=45)},
        models={name: EXPERIMENT.models[name] for name in ("default", "as printed")},
    )
    monkeypatch.setitem(reproduce.EXPERIMENTS, "sabeti-depth", short)
    report = reproduce.run("sabeti-depth", seeds=2, output=tmp_path, jobs=1)
    with report.table.open() as file:
        rows = [row for row in csv.DictReader(file) if float(row["visible"]) >= 0.5]
    errors = {name: [float(r["error_m"]) for r in rows if r["model"] == name] for name in short.models}
    ends = {
        name: [float(r["iou"]) for r in rows if r["model"] == name and r["frame"] == "44"] for name in errors
    }
    assert np.median(errors["default"]) < 0.1
    assert np.median(errors["as printed"]) > 3 * np.median(errors["default"])
    assert len(ends["default"]) == len(ends["as printed"]) == 2
    assert min(ends["default"]) > 0.5 > max(ends["as printed"])
    assert report.summary.count("| hidden |") == 2
