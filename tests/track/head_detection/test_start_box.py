# SPDX-License-Identifier: MIT
"""That trackers without a box start on a head where a frame has a pair or depth."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import tricue
from tricue import Frame, kernels
from tricue.errors import TargetNotFoundError
from tricue.scenes import head, room_scene
from tricue.track.head_detection.start_box import find_head_or_face


def test_a_color_tracker_starts_on_a_head_of_a_pair(rendered: Callable[..., Any]) -> None:
    """It proves that the color particle tracker starts on a head in a pair, and follows it in color."""
    scene = rendered(head, seed=1, frames=24)
    tracker = tricue.ColorParticleTracker()
    track = tracker.init(scene.frames[0])
    assert track.box.iou(scene.boxes[0]) > 0.5
    assert tracker.update(Frame(scene.frames[1].color)).box.iou(scene.boxes[1]) > 0.3


def test_a_color_tracker_starts_on_a_head_in_depth(rendered: Callable[..., Any]) -> None:
    """It proves that it does so with depth, and says what it looked for where there is no head."""
    scene = rendered(room_scene, kind="walker", seed=0, channels="rgbd")
    assert tricue.ColorParticleTracker().init(scene.frames[0]).box.height < 40
    blank = Frame(scene.frames[0].color, depth=np.full_like(scene.frames[0].depth, 3.0))
    with pytest.raises(TargetNotFoundError, match=r"^box: expected .*, as no head and no face was found"):
        tricue.ColorParticleTracker().init(blank)
    with pytest.raises(TargetNotFoundError, match=r"^box: expected .*, as no head on shoulders was found"):
        tricue.ColorParticleTracker().init(Frame(blank.color, right=blank.color))
    with pytest.raises(TargetNotFoundError, match=r"^box: expected .*, as no face was found"):
        tricue.ColorParticleTracker().init(Frame(blank.color))


def test_the_camera_tells_a_heads_size(rendered: Callable[..., Any]) -> None:
    """It proves that the given rig and intrinsics are asked: with others nothing has a head's size."""
    k, pair = kernels.load("native"), rendered(head, seed=1, frames=24)
    room = rendered(room_scene, kind="walker", seed=0, channels="rgbd")
    frame, camera = room.frames[0], room.intrinsics
    assert find_head_or_face(k, pair.frames[0], rig=pair.rig) is not None
    wide = pair.rig.intrinsics
    assert find_head_or_face(k, pair.frames[0], rig=tricue.StereoRig(wide, 4 * pair.rig.baseline)) is None
    assert find_head_or_face(k, frame, camera=camera) is not None
    near = tricue.Intrinsics(camera.fx / 4, camera.fy / 4, camera.cx, camera.cy, camera.width, camera.height)
    assert find_head_or_face(k, frame, camera=near) is None
