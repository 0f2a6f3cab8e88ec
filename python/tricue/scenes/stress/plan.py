# SPDX-License-Identifier: MIT
"""When what happens in a scene with everything: how long the scenes are, and the order of their events."""

import numpy as np

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array
from tricue.scenes.motion import sway
from tricue.scenes.stress import moves as moves_of
from tricue.scenes.stress.looks import Cast
from tricue.scenes.stress.moves import EVENTS, RATE, Moves, Way

FRAMES = {
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
LENGTHS = {"camera": 40, "light": 45, "leaving": 70, "lookalike": 65, "hidden": 42, "blank": 32}
"""Frames that an event takes in a scene with all of them; they leave six quiet ones at the begin."""
QUIET = 12  # frames at the begin of a scene with one event
SCALE = 120  # frames in which the size changes 1:4
SPEED, FAST = 0.08, 0.5  # of the target at most, its widths a frame


def lay(kind: str, camera: Intrinsics, cast: Cast, middle: float, rng: np.random.Generator) -> Moves:
    """All that happens in a scene of a kind. middle: metres, about which the target's distance lies."""
    frames = FRAMES[kind]
    depth = _depth(kind, frames, middle, rng)
    speed = FAST if kind == "fast" else SPEED
    ways = [
        moves_of.wander(camera, card, depth.copy(), speed, rng)
        for card in (cast.target, cast.same_colors, cast.same_structure, cast.curtain)
    ]
    moves = Moves(
        camera,
        ways[0],
        (ways[1], ways[2]),
        _hung(ways[3]),
        angles=np.zeros((frames, 2)),
        light=np.ones((frames, 3)),
        black=np.zeros(frames, bool),
        elsewhere=np.zeros(frames, bool),
        spans=_spans(kind, frames, rng),
    )
    for way in moves.lookalikes:
        way.there[:] = False
    for name, event in EVENTS.items():
        if name in moves.spans:
            event(moves, moves.spans[name], rng)
    return moves


def _spans(kind: str, frames: int, rng: np.random.Generator) -> dict[str, range]:
    if kind in EVENTS:
        return {kind: range(QUIET, frames)}
    spans, start = {}, frames - sum(LENGTHS.values())
    if kind == "all":
        for name in rng.permutation(list(LENGTHS)).tolist():
            spans[name] = range(start, start + LENGTHS[name])
            start += LENGTHS[name]
    return spans


def _depth(kind: str, frames: int, middle: float, rng: np.random.Generator) -> Array:
    """The target's distance (N,): 1:4 and back, or a tenth to and fro."""
    time = np.arange(frames)
    if kind in ("scale", "all"):
        phase = np.pi * (rng.integers(2) if kind == "scale" else rng.random() * 2)
        return middle * 2.0 ** np.cos(np.pi * time / SCALE + phase)
    return middle * (1 + 0.1 * sway(time / RATE, 2.0, 5.0, rng))


def _hung(way: Way) -> Way:
    """What hides the target stands upright, and isn't there yet."""
    way.roll[:] = way.turn[:] = 0
    way.there[:] = False
    return way
