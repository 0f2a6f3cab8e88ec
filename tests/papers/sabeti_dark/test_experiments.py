# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest
from tricue import ColorParticleTracker, DepthParticleTracker
from tricue.evaluation.baselines import StillBox
from tricue.papers.experiment import Case
from tricue.papers.sabeti_dark import curves
from tricue.papers.sabeti_dark.curves import LitCurve
from tricue.papers.sabeti_dark.experiments import EXPERIMENTS, measure
from tricue.papers.sabeti_dark.names import COLOR, PRINTED, PRINTED_COLOR
from tricue.scenes import lit_walker

pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install tricue[demo]")

EXPERIMENT = EXPERIMENTS["sabeti-dark"]


def curve(overlaps, light=None, model="m"):
    """A curve with these overlaps."""
    count = len(overlaps)
    light = np.ones(count) if light is None else np.array(light, float)
    return LitCurve(model, "s", 0, np.array(overlaps, float), light=light, boxes=np.zeros((count, 4)))


def test_color_follows_the_head_and_depth_the_body():
    """As in the paper: the tracker of color starts on the head and is compared with it."""
    scene = lit_walker(1, 4)
    head = measure(Case(COLOR, "s", 0), lambda seed: StillBox(), scene)
    body = measure(Case(PRINTED, "s", 0), lambda seed, intrinsics: StillBox(), scene)
    assert tuple(head.boxes[0]) == pytest.approx(scene.heads[0])
    assert tuple(body.boxes[0]) == pytest.approx(scene.boxes[0])
    assert head.overlaps[0] == pytest.approx(1) == body.overlaps[0]
    np.testing.assert_array_equal(head.light, scene.light)


def test_as_printed_is_the_paper():
    """The printed row is Params.paper() and nothing else; the others are defaults."""
    kept = {name: make.keywords for name, make in EXPERIMENT.models.items()}
    assert kept.pop(PRINTED) == {"params": DepthParticleTracker.Params.paper()}
    assert kept.pop(PRINTED_COLOR) == {"params": ColorParticleTracker.Params.paper()}
    assert not any(kept.values())


def test_summary_tells_start_and_end():
    """Means over all frames, the first and the last sixth, and the share of frames above one half."""
    *_, line = curves.summarize([curve([1.0, 1, 1, 0, 0, 0.6]), curve([0.8, 1, 1, 0, 0, 0.4])]).splitlines()
    assert line == "| s | m | 0.57 | 0.90 | 0.50 | 58% | 2 |"


def test_csv_has_the_light_of_each_frame(tmp_path):
    """A line a frame, with its light."""
    curves.write_csv(tmp_path / "c.csv", [curve([0.5, 0.25], [1.0, 0.0123])])
    with (tmp_path / "c.csv").open() as file:
        rows = list(csv.reader(file))
    assert rows == [
        list(curves.CSV_COLUMNS),
        ["m", "s", "0", "0", "1", "0.5000"],
        ["m", "s", "0", "1", "0.0123", "0.2500"],
    ]


def test_depth_goes_on_in_darkness():
    """Section VI: without light the tracker of depth goes on, and the tracker of color has lost the head."""
    scenes = [lit_walker(seed, 60, light="dusk") for seed in (1, 2)]
    ends = {
        name: [
            measure(Case(name, "s", 0), EXPERIMENT.models[name], scene).overlaps[-5:].mean()
            for scene in scenes
        ]
        for name in (COLOR, "depth-particle")
    }
    assert min(ends["depth-particle"]) > 0.7
    assert np.mean(ends[COLOR]) < 0.2  # a box that stays somewhere overlaps by chance
