# SPDX-License-Identifier: MIT
"""The timeline of a stress scene: its length, and when its events happen."""

import numpy as np

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array
from tricue.scenes.motion import sample_sway
from tricue.scenes.stress import events
from tricue.scenes.stress.appearance import StressCards
from tricue.scenes.stress.events import EVENTS, STRESS_FRAME_RATE, CardPath, StressMotion

FRAME_COUNTS = {
    "plain": 120,
    "fast": 120,
    "light": 120,
    "camera": 120,
    "scale": 241,
    "leaving": 130,
    "hidden": 110,
    "lookalike": 150,
    "blank": 110,
    "all": 300,
}
AWAY_FRAMES = {"leaving": 30, "hidden": 20}
"""The default numbers of frames out of the image, and behind the occluder."""
EVENT_LENGTHS = {"camera": 40, "light": 45, "leaving": 70, "lookalike": 65, "hidden": 42, "blank": 32}
"""The number of frames of each event in a scene with all of them, which starts with six quiet frames."""
QUIET_FRAMES = 12  # at the start of a scene with one event
SCALE_FRAMES = 120  # over which the size changes 1:4
MAX_SPEED, MAX_FAST_SPEED = 0.08, 0.5  # of the target, in its widths per frame


def plan_motion(
    kind: str,
    away: int | None,
    camera: Intrinsics,
    cards: StressCards,
    middle: float,
    rng: np.random.Generator,
) -> StressMotion:
    """The motion and the events of a scene.

    kind: one of FRAME_COUNTS. away: replaces that kind's AWAY_FRAMES, and changes the scene's length
    accordingly. middle: the mean depth, meters.
    """
    frames, away_frames = FRAME_COUNTS[kind], AWAY_FRAMES
    if away is not None:
        frames, away_frames = frames + away - AWAY_FRAMES[kind], {**AWAY_FRAMES, kind: away}
    depth = _depth(kind, frames, middle, rng)
    speed = MAX_FAST_SPEED if kind == "fast" else MAX_SPEED
    paths = [
        events.sample_card_path(camera, card, depth.copy(), speed, rng)
        for card in (
            cards.target,
            cards.same_colors,
            cards.same_structure,
            cards.occluder,
        )
    ]
    motion = StressMotion(
        camera,
        paths[0],
        (paths[1], paths[2]),
        _hide_occluder(paths[3]),
        angles=np.zeros((frames, 2)),
        light=np.ones((frames, 3)),
        black=np.zeros(frames, bool),
        in_other_room=np.zeros(frames, bool),
        away=away_frames,
        spans=_spans(kind, frames, rng),
    )
    for path in motion.lookalikes:
        path.present[:] = False
    for name, event in EVENTS.items():
        if name in motion.spans:
            event(motion, motion.spans[name], rng)
    return motion


def _spans(kind: str, frames: int, rng: np.random.Generator) -> dict[str, range]:
    if kind in EVENTS:
        return {kind: range(QUIET_FRAMES, frames)}
    spans, start = {}, frames - sum(EVENT_LENGTHS.values())
    if kind == "all":
        for name in rng.permutation(list(EVENT_LENGTHS)).tolist():
            spans[name] = range(start, start + EVENT_LENGTHS[name])
            start += EVENT_LENGTHS[name]
    return spans


def _depth(kind: str, frames: int, middle: float, rng: np.random.Generator) -> Array:
    """The target's depth (N,), meters: changing 1:4 and back, or varying by a tenth."""
    time = np.arange(frames)
    if kind in ("scale", "all"):
        phase = np.pi * (rng.integers(2) if kind == "scale" else rng.random() * 2)
        return middle * 2.0 ** np.cos(np.pi * time / SCALE_FRAMES + phase)
    return middle * (1 + 0.1 * sample_sway(time / STRESS_FRAME_RATE, 2.0, 5.0, rng))


def _hide_occluder(path: CardPath) -> CardPath:
    """The occluder's path before its event: upright, and not in the scene."""
    path.roll[:] = path.yaw[:] = 0
    path.present[:] = False
    return path
