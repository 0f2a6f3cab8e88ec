# SPDX-License-Identifier: MIT
"""What trackers that take stereo pairs say of one that is swapped or not rectified."""

import contextlib
import warnings

import cv2
import numpy as np
import pytest
import tricue
from tricue.camera.frame import Frame

TRACKERS = ("stereo-head", "flow-depth", "fused")
BOX = (60, 30, 32, 38)


def pair(shift=0):
    """Left and right image of a textured box of 8 pixels of disparity before a wall of 2."""
    rng = np.random.default_rng(0)
    wall, target = (
        cv2.GaussianBlur(rng.integers(0, 256, size, np.uint8), (0, 0), 1.5)
        for size in ((100, 180, 3), (38, 32, 3))
    )
    images = []
    for wall_at, target_at in ((10, 60), (12, 52)):
        image = np.ascontiguousarray(wall[:, wall_at : wall_at + 160])
        image[30:68, target_at + shift : target_at + shift + 32] = target
        images.append(image)
    return images


LEFT, RIGHT = pair()
RIG = tricue.StereoRig(tricue.Intrinsics(200.0, 200.0, 80.0, 50.0, 160, 100), 0.04)


@pytest.mark.parametrize("name", TRACKERS)
def test_swapped_images_are_warned_of(name):
    """A start with left and right swapped warns, and points at the line that called init."""
    tracker = tricue.create(name, rig=RIG)
    expected = pytest.warns(UserWarning, match=r"^right: left and right seem to be swapped")
    with expected as caught, contextlib.suppress(ValueError):
        tracker.init(Frame(RIGHT, right=LEFT), BOX)
    assert [each.filename for each in caught] == [__file__]


@pytest.mark.parametrize("name", TRACKERS)
def test_an_unrectified_pair_is_warned_of(name):
    """A start on a pair whose rows are off warns, and says what to do."""
    message = r"^right: .*not to be rectified.*differ by 4.0 px.*rectify"
    with pytest.warns(UserWarning, match=message), contextlib.suppress(ValueError):
        tricue.create(name, rig=RIG).init(Frame(LEFT, right=np.roll(RIGHT, 4, axis=0)), BOX)


@pytest.mark.parametrize("name", TRACKERS)
def test_a_good_pair_is_not_warned_of(name):
    """Neither a start nor an update on a rectified pair warns, nor an update on any: it is checked once."""
    tracker = tricue.create(name, rig=RIG)
    left, right = pair(2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tracker.init(Frame(LEFT, right=RIGHT), BOX)
        tracker.update(Frame(right, right=left))
        tracker.update(Frame(left, right=np.roll(right, 4, axis=0)))


def test_a_verged_pair_is_not_warned_of():
    """Negative disparities are usual before the right image is turned back."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)
        with contextlib.suppress(ValueError):  # it isn't verged by that
            tricue.create("flow-depth", rig=RIG, vergence=5.0).init(Frame(RIGHT, right=LEFT), BOX)


@pytest.mark.parametrize(("name", "cues"), [("flow-depth", ("flow",)), ("fused", ("filter", "color"))])
def test_what_is_not_used_is_not_warned_of(name, cues):
    """A tracker that was told to leave depth out doesn't look at the right image."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tricue.create(name, rig=RIG, cues=cues).init(Frame(RIGHT, right=LEFT), BOX)
