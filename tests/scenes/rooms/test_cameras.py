# SPDX-License-Identifier: MIT
from itertools import pairwise

import numpy as np
import pytest
from tricue.scenes.rooms.cameras import Viewpoint, hold, stand

VIEW = Viewpoint(np.array([0.3, -0.1, 0.5]), 1.2, azimuth=0.4, pitch=0.6)


def test_it_looks_at_its_point_from_its_distance():
    """The point is in the image's middle, as far away as told; the world's up is up in the image."""
    pose = VIEW.pose()
    assert pose.points(VIEW.look_at) == pytest.approx([0, 0, 1.2])
    assert pose.rotation @ pose.rotation.T == pytest.approx(np.eye(3))
    assert np.linalg.det(pose.rotation) == pytest.approx(1)
    above = pose.points(VIEW.look_at - [0, 0.1, 0])
    assert above[0] == pytest.approx(0)
    assert above[1] < 0


def test_pitch_looks_down():
    """The camera is above what it looks at, by the sine of its pitch."""
    pose = VIEW.pose()
    eye = -pose.rotation.T @ pose.offset
    assert VIEW.look_at[1] - eye[1] == pytest.approx(1.2 * np.sin(0.6))


def test_a_stand_stays_and_a_hand_moves():
    """A hand goes around and to and fro, and never more than some degrees a frame."""
    poses = stand(VIEW, 5)
    assert len(poses) == 5
    assert all(np.array_equal(pose.offset, poses[0].offset) for pose in poses)
    poses = hold(VIEW, 90, 30.0, np.random.default_rng(0))
    eyes = np.array([-pose.rotation.T @ pose.offset for pose in poses])
    assert np.ptp(eyes, axis=0).max() > 0.05
    turns = [
        np.degrees(np.arccos(np.clip((np.trace(a.rotation @ b.rotation.T) - 1) / 2, -1, 1)))
        for a, b in pairwise(poses)
    ]
    assert 0.05 < np.median(turns) < 3
    seen = np.array([pose.points(VIEW.look_at) for pose in poses])
    assert (np.abs(seen[:, :2]) < 0.3 * seen[:, 2:]).all()
