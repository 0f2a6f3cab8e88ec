# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.scenes import pan_tilt_scene


@pytest.fixture(scope="module")
def scene():
    """A walker whom somebody crosses."""
    return pan_tilt_scene(1, 100, crossed=True)


def test_the_target_is_where_its_direction_says(scene):
    """Looked at in its direction, the center of its box is in the middle of the image, from anywhere."""
    index = 40
    camera = scene.rig.intrinsics
    pan, tilt = scene.truth(index, *scene.start).direction
    truth = scene.truth(index, pan, tilt)
    middle = camera.width / 2, camera.height / 2
    np.testing.assert_allclose(truth.seen.target.box.center, middle, atol=0.5)
    np.testing.assert_allclose(truth.direction, [pan, tilt], atol=0.005)


def test_one_view_is_one_frame(scene):
    """The same frame from the same angles has the same bits; from others the image moves by what they say."""
    pan, tilt = scene.truth(10, *scene.start).direction
    first, again = (scene.look(10, pan, tilt) for _ in range(2))
    np.testing.assert_array_equal(first.color, again.color)
    np.testing.assert_array_equal(first.right, again.right)
    assert first.timestamp == pytest.approx(10 / scene.rate)
    step = 5 / scene.rig.intrinsics.fx
    aside = scene.look(10, pan + step, tilt).color.astype(float)
    up = scene.look(10, pan, tilt + step).color.astype(float)
    image, inner = first.color.astype(float), np.s_[30:90, 40:120]
    right, below = np.roll(image, -5, axis=1)[inner], np.roll(image, 5, axis=0)[inner]
    still = np.abs(aside[inner] - image[inner]).mean()
    assert np.abs(aside[inner] - right).mean() < 0.6 * still
    assert np.abs(up[inner] - below).mean() < 0.6 * np.abs(up[inner] - image[inner]).mean()


def test_the_target_leaves_a_camera_that_stands(scene):
    """Its direction changes by more than the camera sees, slowly at first."""
    pans = np.array([scene.truth(index, *scene.start).direction[0] for index in range(0, 100, 9)])
    assert np.ptp(pans) > np.radians(32)
    assert abs(pans[1] - pans[0]) < np.radians(2.5)


def test_somebody_crosses(scene):
    """Someone nearer hides most of the target for some frames, which nobody does in the scene without."""
    other = pan_tilt_scene(1, 100)
    seen = []
    for each in (scene, other):
        directions = [each.truth(index, *each.start).direction for index in range(0, 100, 2)]
        seen.append([each.truth(2 * i, *at).seen.visible for i, at in enumerate(directions)])
    assert min(seen[0]) < 0.3
    assert np.mean(np.array(seen[0]) < 0.5) < 0.25
    assert min(seen[1]) > 0.9
