# SPDX-License-Identifier: MIT
import re

import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import baselines, metrics
from tricue.evaluation.one_pass import run
from tricue.evaluation.trackers import missing_note
from tricue.track.base.track import Status

MOVING = [name for name in baselines.available() if name != "still-box"]


@pytest.mark.parametrize("name", MOVING)
def test_peer_follows_an_easy_target(name, patrol):
    """Every baseline that moves stays with a square that moves 38 px in 20 frames."""
    frames, boxes = patrol
    result = run(baselines.available()[name](0), frames, boxes[0])
    error = metrics.center_errors(result.boxes, np.array(boxes))
    assert error[-1] < 12
    assert error.mean() < 8


def test_still_box_stays(patrol):
    """The floor gives the first box in every frame."""
    frames, boxes = patrol
    result = run(baselines.available()["still-box"](0), frames, boxes[0])
    np.testing.assert_array_equal(result.boxes, [boxes[0]] * 20)


def test_failure_keeps_the_last_box_and_says_lost(patrol):
    """Where a cv2 tracker reports failure or raises, the last good box stands with status LOST."""

    class Fails:
        def init(self, image, box):
            self.answers = iter([(True, (5, 6, 7, 8)), (False, (0, 0, 0, 0)), None, (True, (1, 1, 0, 4))])

        def update(self, image):
            answer = next(self.answers)
            if answer is None:
                raise cv2.error("out of the image")
            return answer

    frames, boxes = patrol
    result = run(baselines.OpenCVBaseline(Fails), frames[:5], boxes[0])
    np.testing.assert_array_equal(result.boxes, [boxes[0], *[[5, 6, 7, 8]] * 4])
    assert result.statuses == (Status.TRACKED,) * 2 + (Status.LOST,) * 3


def test_scripted_filter_is_seeded(patrol):
    """One seed of the scripted particle filter gives one track, another seed another."""
    frames, boxes = patrol
    first, again, other = (
        run(baselines.ScriptedParticleFilter(seed), frames, boxes[0]).boxes for seed in (0, 0, 1)
    )
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_peers_name_the_channel_they_lack():
    """A baseline that gets no color says so."""
    depth = Frame(depth=np.ones((8, 8), np.float32))
    with pytest.raises(ValueError, match="channel color"):
        baselines.ScriptedParticleFilter().init(depth, Box(1.0, 1.0, 4.0, 4.0))


@pytest.mark.parametrize(
    ("box", "shape"),
    [
        (Box(2.0, 1.0, 3.0, 4.0), (4, 3)),
        (Box(-2.0, -1.0, 3.0, 4.0), (3, 1)),
        (Box(8.0, 7.0, 9.0, 9.0), (3, 2)),
        (Box(-50.0, 40.0, 9.0, 9.0), (1, 1)),
    ],
)
def test_crop_cuts_at_the_edge_and_is_never_empty(box, shape):
    """A crop has the pixels inside the image, and at least one."""
    assert baselines.crop(np.zeros((10, 10, 3), np.uint8), box).shape[:2] == shape


@pytest.mark.parametrize(
    ("there", "told"),
    [
        (
            ("MIL", "MedianFlow"),
            r"not run: CSRT, KCF, KCF-0\.1, MOSSE: cv2 [^ ]+ has none of them; opencv-contrib",
        ),
        (
            ("CSRT", "KCF", "KCF-0.1", "MIL", "MOSSE"),
            r"not run: MedianFlow: cv2 [^ ]+ has no MedianFlow; opencv-",
        ),
    ],
)
def test_note_on_missing_baselines_blames_all_of_them(there, told, monkeypatch):
    """It proves that the note doesn't name several trackers and then says that one of them is missing."""
    others = ("CamShift", "meanShift", "script-pf", "still-box")
    monkeypatch.setattr(baselines, "available", lambda: [*there, *others])
    assert re.match(told, missing_note(None))
