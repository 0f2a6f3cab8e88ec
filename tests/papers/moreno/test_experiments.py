# SPDX-License-Identifier: MIT
from dataclasses import asdict, replace
from functools import partial

import numpy as np
import pytest
from tricue import Status, Track
from tricue.papers import reproduce
from tricue.papers.experiment import Case
from tricue.papers.moreno import experiments as stereo_experiments
from tricue.papers.moreno import figures
from tricue.papers.moreno.experiments import Trial
from tricue.scenes import HEAD_KINDS
from tricue.track.stereo_head.params import StereoHeadParams

EXPERIMENT = stereo_experiments.EXPERIMENTS["moreno-fig3"]
CASE = Case("m", "s", 0)


class Follower:
    """Reports what a scene knows of its head."""

    def __init__(self, scene, away=1.0):
        self._scene, self._away = scene, away

    def init(self, frame, box):
        self._index = -1
        return self.update(frame)

    def update(self, frame):
        self._index += 1
        at = self._scene.positions[self._index] * self._away
        return Track(self._scene.boxes[self._index], 1.0, Status.TRACKED, at, np.eye(3))


def test_errors_are_those_of_the_positions():
    """True boxes, and positions 3 % too far, have overlaps of 1 and errors of 3 %."""
    trial = Trial.make(1, frames=5)
    curve = stereo_experiments.measure(CASE, lambda seed, rig: Follower(trial.scene, 1.03), trial)
    assert (curve.model, curve.scene, curve.seed) == CASE
    np.testing.assert_allclose(curve.errors, 0.03)
    np.testing.assert_allclose(curve.overlaps, 1.0)
    np.testing.assert_array_equal(curve.covariances, np.tile(np.eye(3), (5, 1, 1)))
    assert list(curve.seconds) == ["rest"]


def test_modules_add_up_to_the_update():
    """The time outside of the kernels is what is left of the updates', and isn't negative."""
    trial = Trial.make(1, frames=8)
    curve = stereo_experiments.measure(CASE, EXPERIMENT.models["fused (default)"], trial)
    assert set(curve.seconds) == {"search", "disparity", "filter", "rest"}
    assert min(curve.seconds.values()) > 0


@pytest.mark.slow
def test_perturbed_disparities_degrade_the_unfused_track():
    """0.3 px are twice the unfused error or more, as there is nothing that averages them."""
    make, errors = EXPERIMENT.models["unfused"], []
    for noise in (0.0, stereo_experiments.SCENE_DISPARITY_NOISE):
        curve = stereo_experiments.measure(CASE, make, Trial.make(3, noise=noise, frames=60))
        errors.append(np.median(curve.errors))
    assert errors[1] > 2 * errors[0]


def test_variants_differ_from_the_default_as_they_say():
    """One part at a time is taken from the default; as printed is the paper's form."""
    default = StereoHeadParams()
    kept = {name: maker.keywords for name, maker in EXPERIMENT.models.items()}
    assert kept.pop("fused (default)") == {}
    assert kept.pop("as printed") == {"params": StereoHeadParams.paper()}
    assert kept.pop("as printed, unfused") == {"params": replace(StereoHeadParams.paper(), fuse=False)}
    for keywords in kept.values():
        assert keywords
        assert all(getattr(default, name) != value for name, value in keywords.items())
    paper = asdict(StereoHeadParams.paper())
    assert kept["default with the paper's filter"].items() <= paper.items()
    assert kept["unfused"] == {"fuse": False}
    for name in ("light not compensated", "color alone"):
        assert kept[f"{name}, without updating"] == kept[name] | kept["without updating"]
    assert kept["color alone"] == kept["light not compensated"] | kept["without depth in the search"]


def test_scenes_are_all_kinds_and_the_noisy_and_the_large_one():
    """Every kind of head scene is run; the large pictures from a few seeds only."""
    keywords = [make.keywords for make in EXPERIMENT.scenes.values()]
    assert {each["kind"] for each in keywords} == set(HEAD_KINDS)
    assert [each["noise"] for each in keywords].count(0.3) == 1
    assert [each["camera"] for each in keywords].count("640x480") == 1
    assert set(EXPERIMENT.max_seeds) < set(EXPERIMENT.scenes)


def test_slow_scenes_run_from_fewer_seeds(tmp_path, monkeypatch):
    """A scene that asks for it has no more than its seeds; the others have all, and both are counted."""
    pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install tricue[demo]")
    names = ("normal", "normal, 0.3 px noise", "ramp")
    short = replace(
        EXPERIMENT,
        scenes={name: partial(Trial.make, frames=4) for name in names},
        models={"fused (default)": EXPERIMENT.models["fused (default)"]},
        max_seeds={"ramp": 1},
    )
    monkeypatch.setitem(reproduce.EXPERIMENTS, "moreno-fig3", short)
    calls = []
    report = reproduce.run("moreno-fig3", 2, tmp_path, progress=lambda *done: calls.append(done))
    assert calls == [(done, 5) for done in range(1, 6)]
    ends = [line.split("|")[-2].strip() for line in report.summary.splitlines()[2:5]]
    assert ends == ["2", "2", "1"]


def test_the_legend_hides_no_deviation():
    """In (b) the legend lies below all curves."""
    matplotlib = pytest.importorskip("matplotlib.figure")
    trial = Trial.make(0, frames=40)
    curves = [
        stereo_experiments.measure(Case(model, scene, 0), EXPERIMENT.models[model], trial)
        for scene in (figures.NORMAL, figures.NOISY)
        for model in figures.MODEL_COLORS
    ]
    figure = matplotlib.Figure()
    figures.paths(figure, curves, {figures.NORMAL: trial})
    figure.draw_without_rendering()
    (axes,) = (each for each in figure.axes if each.get_title("left").startswith("(b)"))
    lowest = min(np.nanmin(line.get_ydata()) for line in axes.lines)
    _, bottom = axes.transData.transform((0, lowest))
    assert axes.get_legend().get_window_extent().y1 < bottom


@pytest.mark.slow
def test_default_follows_and_the_printed_form_does_not():
    """In swinging light the default keeps every head and is within 1.2 % of the distance, as printed loses
    some of them.
    """
    trials = [Trial.make(seed) for seed in range(3)]
    ends, errors = {}, {}
    for name in ("fused (default)", "as printed"):
        runs = [stereo_experiments.measure(CASE, EXPERIMENT.models[name], trial) for trial in trials]
        ends[name] = [run.correct_at_end for run in runs]
        errors[name] = np.median(np.concatenate([run.errors for run in runs]))
    assert all(ends["fused (default)"])
    assert not all(ends["as printed"])
    assert errors["fused (default)"] < 0.012
    assert errors["as printed"] > 3 * errors["fused (default)"]
