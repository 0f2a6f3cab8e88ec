# SPDX-License-Identifier: MIT
from dataclasses import replace

import numpy as np
import pytest
from tricue import Box, FlowDepthTracker, Status, Track
from tricue.papers.experiment import Case
from tricue.papers.okada import curves as walk_curves
from tricue.papers.okada import experiments as walk_experiments
from tricue.papers.okada import figures as walk_figures
from tricue.scenes import OVERTAKING_KINDS, Events, overtaking

EXPERIMENT = walk_experiments.EXPERIMENTS["okada-fig8"]
CASE = Case("m", "s", 0)


@pytest.fixture(scope="module")
def scene():
    """An overtaking that ends while the target is hidden."""
    return overtaking(1, frames=30)


class Follower:
    """Reports what a scene knows of its target; its mask has the frame's number of pixels."""

    traits = FlowDepthTracker.traits
    blocks = ((Box(1, 2, 3, 4),), ())

    def __init__(self, scene, away=0.0):
        self._scene, self._away = scene, np.array([0.0, 0.0, away])

    def init(self, frame, box):
        self._index = -1
        return self.update(frame)

    def update(self, frame):
        self._index += 1
        at = self._scene.positions[self._index] + self._away
        return Track(self._scene.boxes[self._index], 1.0, Status.TRACKED, at)

    @property
    def mask(self):
        pixels = np.zeros((120, 160), np.uint8)
        pixels.flat[: self._index] = 255
        return pixels


def test_errors_are_those_of_the_positions(scene):
    """True boxes, and positions 0.1 m too far, have overlaps of 1 and errors of 0.1 m."""
    curve = walk_experiments.measure(CASE, lambda seed, rig: Follower(scene, 0.1), scene)
    assert (curve.model, curve.scene, curve.seed) == CASE
    np.testing.assert_allclose(curve.errors, 0.1)
    np.testing.assert_allclose(curve.overlaps, 1.0)
    np.testing.assert_allclose(curve.distances, np.linalg.norm(scene.positions, axis=1))
    assert curve.success == 1
    assert np.isnan(curve.restarted_overlaps).all()


def test_snapshots_are_of_their_frames(scene):
    """Of the first seed alone pixels and blocks are kept, each from the frame that it is filed under."""
    curve = walk_experiments.measure(CASE, lambda seed, rig: Follower(scene), scene)
    assert tuple(curve.snapshots) == walk_figures.key_frames(scene)
    assert len(curve.snapshots) >= 3
    for index, snapshot in curve.snapshots.items():
        assert (snapshot.mask > 0).sum() == index
        assert snapshot.targets == Follower.blocks[0]
        assert snapshot.box == scene.boxes[index]
    other = walk_experiments.measure(Case("m", "s", 1), lambda seed, rig: Follower(scene), scene)
    assert other.snapshots == {}


def test_a_depth_camera_has_intrinsics():
    """Where there is no right image the tracker gets the camera, and knows where the target is."""
    scene = overtaking(0, frames=4, depth=True)
    curve = walk_experiments.measure(CASE, EXPERIMENT.models[walk_figures.BOTH], scene)
    assert curve.errors.max() < 0.3


def test_cues_are_both_and_each_alone():
    """Both cues beside one at a time, by default and as printed and nothing else, on both kinds of scenes, in
    stereo and with depth.
    """
    makers = list(EXPERIMENT.models.values())
    assert [make.keywords.get("cues") for make in makers[:3]] == [None, ("flow",), ("disparity",)]
    paper = FlowDepthTracker.Params.paper()
    cues = [paper.cues, ("flow",), ("disparity",)]
    assert [make.keywords["params"] for make in makers[3:]] == [replace(paper, cues=each) for each in cues]
    scenes = [(make.keywords["kind"], make.keywords["depth"]) for make in EXPERIMENT.scenes.values()]
    assert sorted(scenes) == [(kind, depth) for kind in OVERTAKING_KINDS for depth in (False, True)]


def test_key_frames_are_in_the_scene(scene):
    """A scene that ends early, or in which nothing happens, is shown as far as it goes."""
    assert walk_figures.key_frames(scene) == (1, scene.events.hiding, scene.events.hidden)
    more = replace(scene, events=Events(15, 23, 26, 29))
    assert walk_figures.key_frames(more) == (1, 15, 19, 23, 26, 29)
    assert walk_figures.key_frames(overtaking(0, frames=2)) == (1,)


@pytest.mark.slow
def test_both_cues_follow_through_the_occlusion(rendered):
    """With the default the targets of three plain scenes are tracked, reported hidden and recovered in time.

    Twenty of them are in docs/experiments.md; in one alone, overlaps may lie just under a half for a while,
    as they do in the first with cv2 5, whose scenes differ by a gray level here and there.
    """
    model = EXPERIMENT.models[walk_figures.BOTH]
    curves = [walk_experiments.measure(CASE, model, rendered(overtaking, seed)) for seed in range(3)]
    assert np.mean([curve.success for curve in curves]) >= 0.9
    for curve in curves:
        assert curve.success >= 0.8
        assert curve.occlusion_reported
        assert curve.recovered
        start = walk_curves.restart_frame(curve.events, curve.visible)
        assert np.isnan(curve.restarted_overlaps[: start + 1]).all()
        assert (curve.restarted_overlaps[start + 1 :] > 0.5).mean() > 0.8
