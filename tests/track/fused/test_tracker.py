# SPDX-License-Identifier: MIT
"""That the fused tracker follows, reports a lost target, finds it again, and has no hidden state."""

import copy
import pickle
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker, Status, Track
from tricue.evaluation.metrics import overlaps

SHAPE = (240, 320, 3)
HERE = [(100 + 3.0 * i, 90.0) for i in range(12)]
THERE = (220.0, 20.0)
START = Box(100, 90, 50, 63)
CHANNELS = ["color", "rgbd", "pair", "depth"]
NOWHERE = np.full((240, 320), np.nan, np.float32)
RNG = np.random.default_rng(0)
BLANK = {
    "black": np.zeros(SHAPE, np.uint8),
    "white": np.full(SHAPE, 255, np.uint8),
    "noise": RNG.integers(0, 256, SHAPE, np.uint8),
}


@pytest.fixture(scope="module")
def film(drawn, shoot, follow) -> Callable[..., list[Track]]:
    """The tracks of the first frames of the plain scene, by channels and number, with a fresh tracker."""

    def tracks(name: str, count: int, **values) -> list[Track]:
        scene = drawn("plain")
        return follow(FusedTracker(rig=scene.rig, **values), shoot("plain", count * [name]), scene.boxes[0])

    return tracks


def test_follows_a_face_over_clutter(scene, follow):
    """The overlap with the true box stays above 0.5, whatever the light does; most frames are TRACKED."""
    tracks = follow(FusedTracker(), scene.frames, scene.boxes[0])
    overlap = overlaps([track.box for track in tracks], scene.boxes)
    assert overlap.min() > 0.5
    assert np.mean([track.status is Status.TRACKED for track in tracks]) > 0.8


@pytest.mark.parametrize("factor", [0.6, 1.6])
def test_follows_a_change_of_size(factor, stage, follow):
    """The box follows an image that grows or shrinks evenly in 40 frames, to 15 % of its sides."""
    import cv2

    frame = stage([(130.0, 90.0)])[0]
    steps = np.geomspace(1, factor, 40)
    turned = [cv2.getRotationMatrix2D((155.0, 121.5), 0.0, float(step)) for step in steps]
    frames = [cv2.warpAffine(frame, each, SHAPE[1::-1], borderMode=cv2.BORDER_REPLICATE) for each in turned]
    last = follow(FusedTracker(), frames, Box(130, 90, 50, 63))[-1].box
    assert last.width == pytest.approx(50 * factor, rel=0.15)
    assert last.height == pytest.approx(63 * factor, rel=0.15)


@pytest.mark.parametrize("blank", BLANK)
def test_a_frame_without_target_is_lost(blank, stage, follow):
    """In frames of one color or of noise it is never TRACKED, LOST from the third, and scores under 0.3."""
    tracker = FusedTracker()
    follow(tracker, stage(HERE), START)
    tracks = [tracker.update(BLANK[blank]) for _ in range(12)]
    assert [track.status for track in tracks] == 2 * [Status.OCCLUDED] + 10 * [Status.LOST]
    assert max(track.score for track in tracks) < 0.3


@pytest.mark.parametrize("blank", BLANK)
def test_a_second_frame_without_target_is_lost(blank, stage, follow):
    """So it is where nothing is known yet of how the target usually looks."""
    tracker = FusedTracker()
    follow(tracker, stage(HERE[:1]), START)
    tracks = [tracker.update(BLANK[blank]) for _ in range(6)]
    assert [track.status for track in tracks] == 2 * [Status.OCCLUDED] + 4 * [Status.LOST]
    assert max(track.score for track in tracks) < 0.6


@pytest.mark.parametrize("background", ["coffee", "cat", "motorcycle"])
def test_found_again_elsewhere(background, stage, follow):
    """After 30 lost frames the face is found within 10 frames where it comes back, 150 px away."""
    tracker = FusedTracker()
    follow(tracker, stage(HERE, background), START)
    for _ in range(30):
        tracker.update(BLANK["noise"])
    last = [tracker.update(frame) for frame in stage(10 * [THERE], background)][-1]
    assert last.status is Status.TRACKED
    assert last.box.iou(Box(*THERE, 50, 63)) > 0.5


@pytest.mark.parametrize("background", ["coffee", "cat", "motorcycle"])
def test_a_lost_face_is_not_seen_in_a_background(background, stage, follow):
    """Once lost, the target isn't found in 30 frames that show clutter alone."""
    tracker = FusedTracker()
    follow(tracker, stage(HERE, background), START)
    for _ in range(5):
        tracker.update(BLANK["black"])
    assert {tracker.update(frame).status for frame in stage(30 * [None], background)} == {Status.LOST}


CUES = [
    ("filter",),
    ("color",),
    ("filter", "size"),
    ("color", "size"),
    ("filter", "color"),
    ("filter", "color", "size"),
]


@pytest.mark.parametrize("cues", CUES, ids=" ".join)
def test_experts_can_be_switched_off(cues, stage, follow):
    """With any of the experts left that localize the target, a slow face is followed."""
    last = follow(FusedTracker(cues=cues), stage(HERE), START)[-1]
    assert last.box.iou(Box(*HERE[-1], 50, 63)) > 0.5


@pytest.mark.parametrize("cues", [("filter", "depth"), ("color", "depth"), ("filter",)], ids=" ".join)
@pytest.mark.parametrize("name", CHANNELS)
def test_few_experts_are_enough_in_any_channels(cues, name, film, drawn):
    """With few experts the target is followed in any channels; a position needs depth, and beside color the
    cue depth.
    """
    tracks = film(name, 30, cues=cues)
    assert tracks[-1].box.iou(Box(*drawn("plain").boxes[29])) > 0.5
    without = name == "color" or ("depth" not in cues and name != "depth")
    assert (tracks[-1].position is None) == without


@pytest.mark.parametrize("expert", FusedTracker.Params().cues)
def test_every_expert_matters(expert, film):
    """Without any one of the experts the tracks are others; turns are followed where there is no depth."""
    others = tuple(each for each in FusedTracker.Params().cues if each != expert)
    channels = "color" if expert == "turn" else "rgbd"
    assert film(channels, 25, cues=others) != film(channels, 25)


def test_both_sets_of_kernels_agree(stage, follow):
    """Native and reference kernels give the same boxes to a tenth of a pixel, in color."""
    frames = stage(HERE)
    native, reference = (
        [track.box for track in follow(FusedTracker(kernels=each), frames, START)]
        for each in ("native", "reference")
    )
    assert np.abs(np.array(native) - np.array(reference)).max() < 0.1


@pytest.mark.parametrize("name", ["rgbd", "pair", "depth"])
def test_both_sets_of_kernels_agree_on_depth(name, film):
    """With depth, too, to a tenth of a pixel, a millimeter, and a thousandth of the covariance; the statuses
    are the same.
    """
    native, reference = (film(name, 5, kernels=each) for each in ("native", "reference"))
    for ours, theirs in zip(native, reference, strict=True):
        assert ours.status is theirs.status
        assert np.abs(np.subtract(ours.box, theirs.box)).max() < 0.1
        assert np.abs(ours.position - theirs.position).max() < 1e-3
        np.testing.assert_allclose(ours.covariance, theirs.covariance, rtol=1e-3, atol=1e-6)


@pytest.mark.parametrize("seen", [2, 6, 12])
def test_found_again_after_few_frames(seen, stage, follow):
    """A face that was visible in so few frames before it was lost is found within 10 where it comes back."""
    frames = stage(HERE[:seen]) + 3 * [BLANK["black"]] + stage(10 * [THERE])
    last = follow(FusedTracker(), frames, START)[-1]
    assert last.status is Status.TRACKED
    assert last.box.iou(Box(*THERE, 50, 63)) > 0.5


def test_both_sets_of_kernels_search_alike(stage, follow):
    """A search with either finds the same: after three blank frames both find the face where it came back."""
    frames = stage(HERE) + 3 * [BLANK["black"]] + stage(3 * [THERE])
    native, reference = (
        follow(FusedTracker(kernels=each), frames, START) for each in ("native", "reference")
    )
    assert [track.status for track in native] == [track.status for track in reference]
    assert native[-1].status is Status.TRACKED
    assert np.abs(np.subtract(native[-1].box, reference[-1].box)).max() < 0.1


@pytest.mark.parametrize("name", CHANNELS)
def test_nothing_is_random(name, film):
    """Two runs give the same tracks bit for bit, whatever the seed is and whoever else draws numbers."""
    first = film(name, 25)
    np.random.seed(0)  # noqa: NPY002 (it must not matter)
    assert film(name, 25, seed=0) == film(name, 25, seed=12345) == first


@pytest.mark.parametrize("protocol", [2, pickle.HIGHEST_PROTOCOL])
@pytest.mark.parametrize("lost", [False, True])
def test_pickled_in_the_middle(protocol, lost, stage, follow):
    """A pickled tracker goes on as the original does, bit for bit, also one that searches."""
    tracker = FusedTracker()
    follow(tracker, stage(HERE[:6]) + (4 * [BLANK["black"]] if lost else []), START)
    rest = stage(HERE[6:])
    restored, aside = pickle.loads(pickle.dumps(tracker, protocol)), copy.deepcopy(tracker)
    for _ in range(3):
        aside.update(BLANK["white"])
    assert list(map(restored.update, rest)) == list(map(tracker.update, rest))


@pytest.mark.parametrize("name", ["rgbd", "pair", "depth"])
@pytest.mark.parametrize("until", [1, 15])
def test_pickled_with_depth(until, name, drawn, shoot, follow):
    """So does one that knows depth, from its first frame and later, through frames of color alone as well."""
    scene, frames = drawn("plain"), shoot("plain", 20 * [name] + 5 * ["color"] + 5 * [name])
    whole = follow(FusedTracker(rig=scene.rig), frames, scene.boxes[0])
    tracker = FusedTracker(rig=scene.rig)
    follow(tracker, frames[:until], scene.boxes[0])
    restored = pickle.loads(pickle.dumps(tracker))
    tracker.update(Frame(np.zeros_like(frames[-1].color) if name != "depth" else None, depth=NOWHERE))
    assert list(map(restored.update, frames[until:])) == whole[until:]


def test_pickled_before_init(drawn, shoot, follow):
    """A tracker can be pickled before its init; cameras, seed, parameters and kernels come back."""
    scene, frames = drawn("plain"), shoot("plain", 3 * ["rgbd"])
    tracker = FusedTracker(rig=scene.rig, seed=7, kernels="reference", color_weight=0.25)
    restored = pickle.loads(pickle.dumps(tracker))
    assert (restored.seed, restored.kernels, restored.params) == (7, "reference", tracker.params)
    assert restored.rig == scene.rig
    ours, theirs = (follow(each, frames, scene.boxes[0]) for each in (restored, tracker))
    assert ours == theirs


def test_init_restarts_wholly(stage, follow):
    """A tracker that was lost gives a fresh one's tracks after another init, bit for bit."""
    frames = stage(HERE)
    used = FusedTracker()
    follow(used, frames + 5 * [BLANK["black"]], START)
    assert follow(used, frames, START) == follow(FusedTracker(), frames, START)


@pytest.mark.parametrize("before", CHANNELS)
@pytest.mark.parametrize("after", CHANNELS)
def test_init_forgets_the_other_channels(before, after, drawn, shoot, follow):
    """Whatever channels it had before, after another init it gives a fresh one's tracks, bit for bit."""
    scene = drawn("plain")
    used = FusedTracker(rig=scene.rig)
    follow(used, shoot("plain", 8 * [before]), scene.boxes[0])
    frames = shoot("plain", 8 * [after])
    assert follow(used, frames, scene.boxes[0]) == follow(FusedTracker(rig=scene.rig), frames, scene.boxes[0])


@pytest.mark.parametrize("name", CHANNELS)
def test_frames_are_only_read(name, drawn, shoot, follow):
    """Frames are left as they were, in all channels, also while it searches."""
    frames = shoot("plain", 8 * [name])
    frames = [Frame(**{each: getattr(frame, each).copy() for each in frame.channels}) for frame in frames]
    copies = copy.deepcopy([[getattr(frame, each) for each in frame.channels] for frame in frames])
    follow(FusedTracker(rig=drawn("plain").rig), [*frames, *frames[::-1]], drawn("plain").boxes[0])
    missed = follow(FusedTracker(rig=drawn("plain").rig), frames, Box(-10, -10, 30, 30))
    assert len(missed) == 8
    for frame, kept in zip(frames, copies, strict=True):
        for each, image in zip(frame.channels, kept, strict=True):
            np.testing.assert_array_equal(getattr(frame, each), image)


@pytest.mark.parametrize("name", CHANNELS)
def test_frames_may_be_reused(name, drawn, shoot, follow):
    """A caller may write every frame into the same buffers, as cameras do: the tracker keeps none of them."""
    scene, frames = drawn("plain"), shoot("plain", 12 * [name])
    buffers = {each: getattr(frames[0], each).copy() for each in frames[0].channels}
    tracker, tracks = FusedTracker(rig=scene.rig), []
    for frame in frames:
        for each, buffer in buffers.items():
            buffer[:] = getattr(frame, each)
        same = Frame(**buffers, timestamp=frame.timestamp)
        tracks.append(tracker.update(same) if tracks else tracker.init(same, scene.boxes[0]))
    assert tracks == follow(FusedTracker(rig=scene.rig), frames, scene.boxes[0])


def test_trackers_do_not_meet(film, drawn, shoot):
    """Trackers that take turns frame by frame leave each other's track alone."""
    scene, films = drawn("plain"), [shoot("plain", 15 * [name]) for name in CHANNELS]
    trackers = [FusedTracker(rig=scene.rig) for _ in films]
    tracks = [[each.init(frames[0], scene.boxes[0])] for each, frames in zip(trackers, films, strict=True)]
    for index in range(1, 15):
        for each, tracker, frames in zip(tracks, trackers, films, strict=True):
            each.append(tracker.update(frames[index]))
    assert tracks == [film(name, 15) for name in CHANNELS]


def test_threads_do_not_meet(film):
    """Trackers that run at once in threads, where kernels release the GIL, give the tracks that each gives
    alone, bit for bit.
    """
    alone = [film(name, 25) for name in CHANNELS]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda name: film(name, 25), 2 * CHANNELS)) == 2 * alone
