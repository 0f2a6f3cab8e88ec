# SPDX-License-Identifier: MIT
"""Several targets are followed as each would be alone, however many processes share them."""

import copy
import pickle
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tricue import Frame, MultiTracker, StereoRig, create
from tricue.camera.rig import Intrinsics
from tricue.errors import BoxError
from tricue.scenes import overtaking
from tricue.track.fused import prepared_frame

from tests.track.multi.kinds import FUSED, KINDS, each_workers, on


@each_workers
def test_each_target_is_followed_as_alone(workers, things, alone, started):
    """Tracks are those of trackers that know nothing of each other, bit for bit, whatever the workers."""
    with started(KINDS, workers=workers) as several:
        assert on(several, things.frames[1:]) == alone(KINDS)


@each_workers
def test_kinds_get_the_camera_that_they_take(workers, rendered):
    """With a rig, trackers of a stereo pair get it, one of depth its left camera, one of color none."""
    scene = rendered(overtaking, 0, 8)
    rig, box = scene.rig, scene.boxes[0]
    kinds = {
        "fused": {"rig": rig},
        "flow-depth": {"rig": rig},
        "stereo-head": {"rig": rig, "far": 20.0},
        "color-particle": {},
        "depth-particle": {"intrinsics": rig.intrinsics},
    }
    depth = Frame(depth=np.full(scene.frames[0].color.shape[:2], 4.0, np.float32)).depth
    depth[20:100, 60:90] = 2.0
    frames = [Frame(frame.color, depth, frame.right) for frame in scene.frames]
    single = {kind: create(kind, **camera) for kind, camera in kinds.items()}
    with MultiTracker(workers=workers, rig=rig) as several:
        for kind, tracker in single.items():
            parameters = {name: value for name, value in kinds[kind].items() if name == "far"}
            number = several.add(frames[0], box, kind, **parameters)
            assert several.tracks[number] == tracker.init(frames[0], box)
        for frame in frames[1:]:
            expected = [tracker.update(frame) for tracker in single.values()]
            assert list(several.update(frame).values()) == expected


def test_a_camera_alone_is_for_those_that_take_it(things):
    """Without a rig, trackers that take a camera get it, those that take a rig or a camera, too."""
    camera = Intrinsics.from_fov(240, 160, 50)
    depth = np.full((160, 240), 4.0, np.float32)
    depth[20:80, 100:130] = 2.0
    frames = [Frame(frame.color, depth) for frame in things.frames[:3]]
    kinds = {"fused": {"intrinsics": camera}, "depth-particle": {"intrinsics": camera}, "color-particle": {}}
    single = [create(kind, **takes) for kind, takes in kinds.items()]
    several = MultiTracker(intrinsics=camera)
    for kind, tracker in zip(kinds, single, strict=True):
        number = several.add(frames[0], (100, 20, 30, 60), kind)
        assert several.tracks[number] == tracker.init(frames[0], (100, 20, 30, 60))
    for frame in frames[1:]:
        assert list(several.update(frame).values()) == [tracker.update(frame) for tracker in single]
    assert several.tracks[1].position is not None


def test_parameters_are_of_the_default_kind(things):
    """Those of the constructor hold for it, those of add beside and before them; seed for all."""
    frames, (box, *_) = things.frames, things.boxes
    several = MultiTracker("color-particle", particles=50, skin_threshold=0.5, seed=3)
    several.add(frames[0], box, particles=60)
    several.add(frames[0], box, "fused", learn_every=0.0)
    several.add(frames[0], box)
    several.add(frames[0], box, "color-particle", seed=4)
    single = [
        create("color-particle", particles=60, skin_threshold=0.5, seed=3),
        create("fused", learn_every=0.0),
        create("color-particle", particles=50, skin_threshold=0.5, seed=3),
        create("color-particle", particles=50, skin_threshold=0.5, seed=4),
    ]
    for tracker in single:
        tracker.init(frames[0], box)
    for frame in frames[1:4]:
        assert list(several.update(frame).values()) == [tracker.update(frame) for tracker in single]


def test_ids_are_not_used_again(things, started):
    """They count from 1; one that was removed, or whose target didn't start, is no other target's."""
    several = started(FUSED[:3])
    assert several.ids == (1, 2, 3)
    several.remove(2)
    assert (several.ids, list(several.update(things.frames[1]))) == ((1, 3), [1, 3])
    with pytest.raises(BoxError):
        several.add(things.frames[1], (900, 900, 10, 10))
    assert several.add(things.frames[1], things.boxes[1]) == 4
    several.remove(4)
    assert several.add(things.frames[1], things.boxes[1]) == 5
    assert several.ids == tuple(several.tracks) == (1, 3, 5)
    with pytest.raises(ValueError, match="id: expected one of 1, 3, 5, got 2"):
        several.remove(2)


@pytest.mark.parametrize("workers", [1, 2])
def test_a_removed_target_changes_no_other(workers, things, alone, started):
    """The others are followed as if it had gone on."""
    with started(KINDS, workers=workers) as several:
        found = on(several, things.frames[1:4])
        several.remove(2)
        several.remove(3)
        found += on(several, things.frames[4:])
    expected = alone(KINDS)
    assert found[:3] == expected[:3]
    assert found[3:] == [{number: tracks[number] for number in (1, 4)} for tracks in expected[3:]]


def test_without_targets_there_are_no_tracks(things):
    """An update then gives none, and says what is wrong with a frame all the same."""
    several = MultiTracker()
    assert several.update(things.frames[0]) == {}
    with pytest.raises(TypeError, match="frame: expected a BGR image"):
        several.update(None)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="id: expected none, as there are no targets, got 1"):
        several.remove(1)


@pytest.mark.parametrize(
    ("keywords", "error"),
    [
        ({"tracker": "fussed"}, "^tracker: expected one of 'color-particle'"),
        ({"workers": 0}, "workers: expected"),
        ({"workers": 1.5}, "workers: expected a whole number"),
        ({"learn_evry": 1}, "learn_evry: unknown parameter of FusedParams; did you mean learn_every"),
        ({"intrinsic": 1}, "intrinsic: unknown parameter of FusedParams; did you mean intrinsics"),
        ({"on_lost": "print"}, "on_lost: expected a function of id and track, got 'print'"),
        ({"rig": "a.toml"}, "rig: expected tricue.StereoRig, got str"),
    ],
)
def test_wrong_arguments_are_told_at_once(keywords, error):
    """Before any target is added."""
    with pytest.raises((TypeError, ValueError), match=error):
        MultiTracker(**keywords)


def test_an_unknown_kind_of_one_target(things):
    """The error has the argument's name, as that of the constructor."""
    with pytest.raises(ValueError, match=r"^tracker: expected one of 'color-particle'"):
        MultiTracker().add(things.frames[0], things.boxes[0], "fussed")


def test_rig_and_intrinsics_are_one_camera():
    """Both are an error, as of a tracker."""
    camera = Intrinsics.from_fov(64, 48, 60)
    with pytest.raises(TypeError, match="intrinsics: expected without rig"):
        MultiTracker(rig=StereoRig(camera, 0.1), intrinsics=camera)


@pytest.mark.parametrize("workers", [1, 2])
def test_threads_may_share_it(workers, things, alone, started):
    """Another thread adds and removes targets meanwhile; those that stay are followed as alone."""
    with started(FUSED, workers=workers) as several:

        def add_and_remove() -> None:
            for _ in range(10):
                several.remove(several.add(things.frames[0], things.boxes[0]))

        with ThreadPoolExecutor(1) as pool:
            done = pool.submit(add_and_remove)
            found = on(several, things.frames[1:])
            done.result()
        assert several.ids == (1, 2, 3, 4)
    assert [{number: tracks[number] for number in (1, 2, 3, 4)} for tracks in found] == alone(FUSED)


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize(
    "copied",
    [copy.copy, copy.deepcopy, lambda several: pickle.loads(pickle.dumps(several))],
    ids=["copy", "deepcopy", "pickle"],
)
def test_copies_are_independent(workers, copied, things, alone, started):
    """A copy goes on by itself, with the same ids, also to a new target; its original notices nothing."""
    expected = alone(KINDS)
    with started(KINDS, workers=workers) as several:
        assert on(several, things.frames[1:4]) == expected[:3]
        with copied(several) as other:
            assert on(other, things.frames[4:]) == expected[3:]
            other.remove(1)
            assert other.add(things.frames[0], things.boxes[0]) == 5
        assert on(several, things.frames[4:]) == expected[3:]
        assert several.ids == (1, 2, 3, 4)


@pytest.mark.parametrize("workers", [1, 2])
def test_a_warning_is_given_once(workers, things):
    """Depth in millimeters is told of once for all targets, at the caller's line, and not again later, also
    for a target that was added later.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        millimeters = Frame(things.frames[0].color, np.full((160, 240), 2000, np.float32))
    with MultiTracker(workers=workers) as several:
        for box in things.boxes:
            several.add(things.frames[0], box)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            for _ in range(3):
                several.update(millimeters)
            several.add(millimeters, things.boxes[0])
            several.update(millimeters)
        assert [str(each.message)[:28] for each in told] == ["frame.depth: expected meters"]
        assert told[0].filename == __file__


def test_what_is_alike_is_computed_once(things, started, monkeypatch):
    """Gray becomes BGR once a frame, not once a target; a tracker of another camera sees another frame."""
    gray = [Frame(np.ascontiguousarray(frame.color[..., 1])) for frame in things.frames]
    calls = []
    bgr = prepared_frame._bgr
    monkeypatch.setattr(prepared_frame, "_bgr", lambda image: calls.append(image) or bgr(image))
    several = started(FUSED)
    for frame in gray[1:4]:
        several.update(frame)
    assert len(calls) == 3 + len(FUSED)  # those are of the starts
    several.add(gray[0], things.boxes[0], intrinsics=Intrinsics.from_fov(240, 160, 50))
    calls.clear()
    several.update(gray[4])
    assert len(calls) == 2
