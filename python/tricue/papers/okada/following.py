# SPDX-License-Identifier: MIT
"""Section 6 of Okada, Shirai and Miura (1996): the tracker turns its camera to keep the target in the middle
of the image.

The paper prints no control law; ours is :class:`tricue.PanTilt`. The camera looks where the head points when
a frame is taken, so what the tracker sees depends on all its earlier output.
"""

from functools import partial

import numpy as np

import tricue
from tricue.papers.experiment import Case, Experiment, Maker
from tricue.papers.okada import following_curves as curves
from tricue.papers.okada import following_figures as figures
from tricue.papers.okada.following_curves import FollowCurve, SeenFrame
from tricue.scenes import PanTiltScene, SimulatedHead, pan_tilt_scene
from tricue.scenes.pan_tilt.head import HeadLimits
from tricue.track.pan_tilt import PanTilt

GAIN = 1.5
"""The controller's gain, 1/s."""
MAX_ACCELERATION = 0.3
"""rad/s²; image motion then changes by a third of a pixel per frame, as the tracker expects."""
FIGURE_SEED = 0
"""The seed whose frames are in the figure."""
STANDING_HEAD = HeadLimits(max_speed=1e-9)


def measure(case: Case, make: Maker, scene: PanTiltScene) -> FollowCurve:
    """The closed loop: the camera looks, the tracker tracks, the controller turns the camera."""
    head = SimulatedHead(scene.limits, scene.start)
    limits, camera = scene.limits, scene.rig.intrinsics
    controller = PanTilt(
        camera,
        gain=GAIN,
        latency=limits.latency,
        max_acceleration=MAX_ACCELERATION,
        pan_limits=(-limits.max_pan, limits.max_pan),
        tilt_limits=(-limits.max_tilt, limits.max_tilt),
    )
    tracker = make(seed=case.seed, rig=scene.rig)
    shown = figures.key_frames(scene.frames) if case.seed == FIGURE_SEED else ()
    angles, directions, boxes, truths, visible, statuses, frames = [], [], [], [], [], [], {}
    for index in range(scene.frames):
        pan, tilt = head.angles.tolist()
        frame, truth = scene.look(index, pan, tilt), scene.truth(index, pan, tilt)
        true_box = truth.seen.target.box
        track = tracker.update(frame) if index else tracker.init(frame, true_box)
        angles.append(head.angles)
        directions.append(truth.direction)
        boxes.append(track.box)
        truths.append(true_box)
        visible.append(truth.seen.visible)
        statuses.append(track.status)
        if index in shown:
            assert frame.color is not None
            frames[index] = SeenFrame(frame.color, track.box, true_box)
        command = controller.command(track, pan, tilt, timestamp=frame.timestamp)
        head.drive(command.pan_speed, command.tilt_speed)
        head.move(1 / scene.rate)
    shares = np.array([box.center for box in truths]) / [camera.width, camera.height]
    return FollowCurve(
        *case,
        overlaps=np.array([box.iou(true) for box, true in zip(boxes, truths, strict=True)]),
        visible=np.array(visible),
        statuses=tuple(statuses),
        angles=np.array(angles),
        directions=np.array(directions),
        in_middle=np.abs(shares - 0.5).max(axis=1) <= 1 / 6,
        in_image=np.abs(shares - 0.5).max(axis=1) <= 1 / 2,
        rate=scene.rate,
        frames=frames,
    )


EXPERIMENTS: dict[str, Experiment[PanTiltScene, FollowCurve]] = {
    "okada-follow": Experiment(
        models={
            "default": partial(tricue.create, "flow-depth"),
            "as printed": partial(tricue.create, "flow-depth", params=tricue.FlowDepthTracker.Params.paper()),
            "fused": partial(tricue.create, "fused"),
        },
        scenes={
            "walks": pan_tilt_scene,
            "walks, is crossed": partial(pan_tilt_scene, crossed=True),
            "walks, camera stands still": partial(pan_tilt_scene, limits=STANDING_HEAD),
        },
        measure=measure,
        summarize=curves.summarize,
        write_csv=curves.write_csv,
        draw=figures.frames_and_angles,
    )
}
