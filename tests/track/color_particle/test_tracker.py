# SPDX-License-Identifier: MIT
"""That the color particle tracker follows its target, in scenes and on real video, and over the image's
edge.
"""

import gc
import tracemalloc
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, ColorParticleTracker, Frame, Status, Track
from tricue.evaluation import metrics
from tricue.scenes import Scene, face_over_clutter, light_change

from benchmarks.quality.common import sequences

SEEDS = range(4)


def errors(tracks: Sequence[Track], boxes: Sequence[Box]) -> NDArray[np.float64]:
    """Distances between centers, pixels."""
    return metrics.center_errors([track.box for track in tracks], boxes)


@pytest.mark.parametrize("background", ["coffee", "immunohistochemistry"])
def test_follows_a_face_over_clutter(background, follow):
    """In the scene of figure 1 the mean error is at most 3 px, and at most 2 % of the frames are over 25
    px off.
    """
    scenes = [face_over_clutter(seed=seed, background=background) for seed in SEEDS]
    off = np.array(
        [
            errors(follow(ColorParticleTracker(seed=seed), scene.frames, scene.boxes[0]), scene.boxes)
            for seed, scene in enumerate(scenes)
        ]
    )
    assert off.mean() <= 3
    assert (off > 25).mean() <= 0.02


@pytest.mark.parametrize("seed", SEEDS)
def test_holds_through_a_change_of_light(seed, follow):
    """In the scene of figure 2 the overlap is above 0.5 in 95 % of the frames, whatever the new light is."""
    scene = light_change(seed=seed)
    tracks = follow(ColorParticleTracker(seed=seed), scene.frames, scene.boxes[0])
    overlap = metrics.overlaps([track.box for track in tracks], scene.boxes)
    assert (overlap > 0.5).mean() >= 0.95


@pytest.mark.parametrize("name", ["David", "Girl", "FaceOcc2"])
def test_follows_recorded_faces(name, data: Path, follow):
    """On recorded faces the success AUC is at least 0.5 with the default parameters: a floor, so that a
    regression shows.
    """
    folder = data / "color" / name
    if not folder.is_dir():
        pytest.skip(f"no sequence {folder}")
    sequence = sequences.load(folder)
    tracks = follow(ColorParticleTracker(seed=0), sequence.frames, Box(*sequence.truth[0]))
    assert metrics.score([track.box for track in tracks], sequence.truth).auc >= 0.5


@pytest.mark.parametrize("background", ["coffee", "cat"])
@pytest.mark.parametrize(
    ("dx", "dy"), [(-1, 0), (1, 0), (0, -1), (0, 1)], ids=["left", "right", "top", "bottom"]
)
def test_follows_half_out_of_the_picture(background, dx, dy, stage, follow):
    """A face that leaves the picture half over any edge, stays and comes back is followed within 6 px and
    never missed.
    """
    way = np.concatenate([np.linspace(0, 1, 30), np.ones(5), np.linspace(1, 0, 30)])
    center = np.array([160 + dx * 60, 120 + dy * 30])
    edge = np.array([160 + dx * 160, 120 + dy * 120])
    corners = center + way[:, None] * (edge - center) - [25, 31.5]
    boxes = [Box(x, y, 50, 63) for x, y in corners.tolist()]
    tracks = follow(ColorParticleTracker(seed=1), stage(list(map(tuple, corners)), background), boxes[0])
    assert errors(tracks, boxes).max() < 6
    assert {track.status for track in tracks} == {Status.TRACKED}


def test_starts_on_a_box_over_the_edge(stage, follow):
    """A box that begins half outside the picture is followed inwards, its part outside kept."""
    corners = [(-25 + 3.0 * i, 90.0) for i in range(30)]
    boxes = [Box(x, y, 50, 63) for x, y in corners]
    tracks = follow(ColorParticleTracker(seed=0), stage(corners), boxes[0])
    assert tracks[0].box == boxes[0]
    assert errors(tracks, boxes).max() < 6


def test_ranks_alone_are_invariant_to_light(scene: Scene, follow):
    """With ranks alone, a strictly increasing change of each channel of all frames leaves the track bit
    for bit as it is.
    """
    rng = np.random.default_rng(2)
    curves = [np.sort(rng.choice(256, 128, replace=False)).astype(np.uint8) for _ in range(3)]
    half = [np.asarray(frame.color) // 2 for frame in scene.frames]
    lit = [np.stack([curve[image[..., c]] for c, curve in enumerate(curves)], axis=-1) for image in half]
    ours, theirs = (
        follow(ColorParticleTracker(color_weight=0, skin_share=0), frames, scene.boxes[0])
        for frames in (half, lit)
    )
    assert ours == theirs


@pytest.mark.parametrize("seed", SEEDS)
def test_tracks_are_sane_in_any_frame(seed, follow):
    """In clutter, noise, black and foreign frames boxes are finite, sizes within their range, scores in
    [0, 1].
    """
    rng = np.random.default_rng(seed)
    scene = face_over_clutter(seed=seed, frames=40)
    frames = [np.asarray(frame.color) for frame in scene.frames]
    kinds = [image[::-1].copy() for image in frames[:5]] + [np.full_like(frames[0], v) for v in (0, 255)]
    kinds += [rng.integers(0, 256, frames[0].shape, np.uint8) for _ in range(5)]
    frames += [kinds[i] for i in rng.integers(len(kinds), size=60)] + frames
    tracks = follow(ColorParticleTracker(seed=seed, size_range=(0.5, 2.0)), frames, scene.boxes[0])
    boxes, scores = np.array([track.box for track in tracks]), np.array([track.score for track in tracks])
    assert np.isfinite(boxes).all()
    ratio = boxes[:, 2:] / scene.boxes[0][2:]
    assert ratio.min() >= 0.5 * (1 - 1e-12)
    assert ratio.max() <= 2.0 * (1 + 1e-12)
    assert ((scores >= 0) & (scores <= 1)).all()  # NaN is neither
    assert all(isinstance(track.status, Status) and track.position is None for track in tracks)


def test_particles_are_exposed(scene: Scene):
    """The particles are none before init, then as many as set, and spread around the estimate."""
    tracker = ColorParticleTracker(particles=37)
    assert tracker.particles.shape == (0, 4)
    tracker.init(scene.frames[0], scene.boxes[0])
    track = tracker.update(scene.frames[1])
    assert tracker.particles.shape == (37, 4)
    lowest, highest = tracker.particles.min(axis=0), tracker.particles.max(axis=0)
    assert (lowest <= track.box.ellipse).all()
    assert (track.box.ellipse <= highest).all()


def test_memory_stays_as_it_is(scene: Scene):
    """Three thousand updates keep no more than 64 kB above what the first 300 left."""
    tracker = ColorParticleTracker(seed=0)
    tracker.init(scene.frames[0], scene.boxes[0])
    cycle: list[Frame] = [*scene.frames, *reversed(scene.frames)]

    def updates(rounds: int) -> int:
        for frame in rounds * cycle:
            tracker.update(frame)
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        before = updates(4)
        assert updates(40) - before < 64_000
    finally:
        tracemalloc.stop()
