# SPDX-License-Identifier: MIT
"""That only cells which nothing reads are left out of the reduced frames."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tricue import FlowDepthTracker, Frame
from tricue.arrays import Image
from tricue.kernels import load
from tricue.scenes import overtaking
from tricue.track.flow_depth.cues import Cues, measure
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.read_cells import CueReach
from tricue.track.flow_depth.rectangles import Region, cells_of, contains
from tricue.track.flow_depth.reduced_frame import ReducedFrame, WantedCells

SHAPE = 150, 210
forms = st.builds(
    FlowDepthParams,
    sigma=st.sampled_from([0.5, 0.8, 2.0]),
    flow_levels=st.integers(1, 3),
    disparity_levels=st.integers(1, 3),
    disparity_radius=st.integers(0, 3),
)


def noise(seed: int) -> Image:
    """Gray levels that make a motion and a disparity of any length."""
    return np.random.default_rng(seed).integers(0, 256, SHAPE, np.uint8)


def spoiled(image: Image, kept: Region, seed: int) -> Image:
    """The image with other levels where it isn't kept."""
    x0, y0, x1, y1 = kept
    other = noise(seed)
    other[y0:y1, x0:x1] = image[y0:y1, x0:x1]
    return other


def planes(cues: Cues) -> np.ndarray:
    """All observations and their weights."""
    return np.stack([plane for cue in cues.maps for plane in cue])


@example(FlowDepthParams(sigma=0.5, flow_levels=1), 0.0, 0.0, 4.000000000000001, 0.0)  # a sum that is rounded
@given(forms, st.floats(-60, 200), st.floats(-60, 140), st.floats(4, 60), st.floats(-250, 250))
def test_nothing_else_is_read(p: FlowDepthParams, x: float, y: float, side: float, disparity: float) -> None:
    """Other levels in all cells that aren't wanted change no observation."""
    candidate = x, y, x + side, y + side / 2
    region = cells_of(candidate, SHAPE)
    if region[0] == region[2] or region[1] == region[3]:
        return
    before, now, right = noise(0), noise(1), noise(2)
    reach = CueReach.of(p)
    wanted = reach.wanted(candidate, disparity, SHAPE)
    assert wanted.left is not None
    assert wanted.right is not None
    k = load("native")
    whole = measure(
        k, ReducedFrame(before, None, None, 1), ReducedFrame(now, right, None, 1), region, disparity, p
    )
    part = measure(
        k,
        ReducedFrame(spoiled(before, reach.before(candidate, SHAPE), 3), None, None, 1),
        ReducedFrame(spoiled(now, wanted.left, 4), spoiled(right, wanted.right, 5), None, 1),
        region,
        disparity,
        p,
    )
    np.testing.assert_array_equal(planes(part), planes(whole))


@pytest.mark.parametrize("cues", [("flow",), ("flow", "disparity")])
def test_tracks_are_those_of_whole_frames(cues: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """A target that jumps leaves the cells that were made: they are made anew while the frame is there."""
    scene = overtaking(1, 40)
    shift = [0, 0, 0, 0, 25, 25, 25, 60, 60, 0, 0, 0] + 28 * [-30]
    frames = [
        Frame(np.roll(f.color, by, axis=1), right=np.roll(f.right, by, axis=1))
        for f, by in zip(scene.frames, shift, strict=True)
        if f.color is not None and f.right is not None
    ]

    def tracks() -> list[object]:
        tracker = FlowDepthTracker(rig=scene.rig, cues=cues, resolution=160)  # type: ignore[arg-type]
        found: list[object] = [tracker.init(frames[0], scene.boxes[0])]
        for frame in frames[1:]:
            color, right = np.array(frame.color), np.array(frame.right)
            found.append(tracker.update(Frame(color, right=right)))
            color[:], right[:] = 0, 0  # as a caller that reads the next frame into the same memory
        return found

    few = tracks()
    everything = WantedCells(None, None)
    monkeypatch.setattr(CueReach, "wanted", lambda *_: everything)
    assert few == tracks()


def test_contains() -> None:
    """A region contains its parts and empty regions."""
    region = 2, 3, 10, 12
    assert all(contains(region, part) for part in [region, (4, 4, 5, 5), (0, 0, 0, 9)])
    beyond = [(1, 4, 5, 5), (4, 2, 5, 5), (4, 4, 11, 5), (4, 4, 5, 13)]
    assert not any(contains(region, other) for other in beyond)
