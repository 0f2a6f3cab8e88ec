# SPDX-License-Identifier: MIT
"""The parameters of every tracker: their names, and that all ways to give them are one; each tracker's own
test_params.py adds its forms, files and extremes.
"""

import dataclasses
import re

import numpy as np
import pytest
import tricue
from tricue import (
    ColorParticleTracker,
    DepthParticleTracker,
    FlowDepthTracker,
    FusedTracker,
    StereoHeadTracker,
)

TRACKERS = ColorParticleTracker, DepthParticleTracker, FlowDepthTracker, FusedTracker, StereoHeadTracker


def fields(tracker):
    """The tracker's parameters, by name."""
    return {field.name: field for field in dataclasses.fields(tracker.Params)}


@pytest.mark.parametrize(
    ("tracker", "wrong", "right"),
    [
        (ColorParticleTracker, "particle", "particles"),
        (DepthParticleTracker, "aspects", "aspect"),
        (StereoHeadTracker, "disparity", "disparit"),
        (FlowDepthTracker, "cue", "cues"),
        (FusedTracker, "rigde", "ridge"),
    ],
)
def test_unknown_names_are_errors(tracker, wrong, right):
    """A misspelt parameter is a TypeError that proposes the right one."""
    with pytest.raises(TypeError, match=rf"^{wrong}: unknown parameter of .*did you mean {right}"):
        tracker(**{wrong: 1})


@pytest.mark.parametrize(
    ("tracker", "wrong", "hint"),
    [
        (ColorParticleTracker, "intrinsics", "ColorParticleTracker takes no camera"),
        (ColorParticleTracker, "rig", "ColorParticleTracker takes no camera"),
        (DepthParticleTracker, "rig", "DepthParticleTracker takes intrinsics="),
        (StereoHeadTracker, "intrinsics", "StereoHeadTracker takes rig="),
        (FusedTracker, "intrinsic", "did you mean intrinsics"),
        (FusedTracker, "kernel", "did you mean kernels"),
        (FlowDepthTracker, "rigs", "did you mean rig"),
        (
            FusedTracker,
            "camera",
            "expected one of rig, intrinsics, seed, kernels, or a parameter, which FusedTracker.Params",
        ),
    ],
)
def test_wrong_keywords_tell_those_of_the_constructor(tracker, wrong, hint):
    """Cameras, seed and kernels are keywords as well; of a camera it is told which one the tracker takes."""
    message = f"{wrong}: unknown parameter of {tracker.Params.__name__}; {hint}"
    with pytest.raises(TypeError, match=f"^{re.escape(message)}") as error:
        tracker(**{wrong: 1})
    assert len(str(error.value)) < 180


@pytest.mark.parametrize(
    ("name", "values", "runner", "camera"),
    [
        ("color-particle", {"particles": 40}, "run", None),
        ("depth-particle", {"particles": 50}, "pass_by", ("passing", "intrinsics")),
        ("stereo-head", {"window": 7}, "cover_up", ("covered", "rig")),
        ("flow-depth", {"bins": 32}, "walk_on", ("overtaken", "rig")),
    ],
)
def test_params_and_keywords_are_the_same(name, values, runner, camera, request):
    """Parameters by params=, by keywords and through create() give one track, another than without."""
    tracks = request.getfixturevalue(runner)
    cameras = {camera[1]: getattr(request.getfixturevalue(camera[0]), camera[1])} if camera else {}
    made = tricue.create(name, seed=3, **cameras, **values)
    params = type(made).Params(**values)
    assert tracks(params=params) == tracks(**values) != tracks()
    assert (made.seed, made.params) == (3, params)
    assert all(getattr(made, key) == value for key, value in cameras.items())


@pytest.mark.parametrize(
    ("tracker", "name", "value"),
    [
        (ColorParticleTracker, "particles", 40),
        (DepthParticleTracker, "particles", 40),
        (StereoHeadTracker, "window", 7),
        (FlowDepthTracker, "bins", 32),
        (FusedTracker, "color_weight", 0.25),
    ],
)
def test_params_come_alone_and_are_the_trackers(tracker, name, value):
    """Both ways at once are an error, as are parameters of another kind and another tracker's."""
    given = tracker.Params(**{name: value})
    assert tracker(params=given).params is given
    assert tracker(**{name: value}).params == given != tracker().params == tracker.Params()
    with pytest.raises(TypeError, match=rf"^params: expected alone, got also {name}"):
        tracker(params=given, **{name: value})
    for other in ({}, TRACKERS[TRACKERS.index(tracker) - 1].Params()):
        with pytest.raises(TypeError, match=rf"^params: expected {tracker.Params.__name__}, got "):
            tracker(params=other)


@pytest.mark.parametrize("tracker", [FlowDepthTracker, FusedTracker])
def test_params_may_come_first(tracker):
    """These two take them without a name."""
    given = tracker.Params(rate=25.0)
    assert tracker(given).params is given


@pytest.mark.parametrize("tracker", TRACKERS)
@pytest.mark.parametrize(
    ("seed", "error"),
    [(-1, ValueError), (None, TypeError), ("a", TypeError), (0.5, TypeError), (True, TypeError)],
)
def test_seeds_are_whole_numbers(tracker, seed, error):
    """A seed that is no whole number from 0 up is named, also where it changes nothing; None, which would
    mean chance, too.
    """
    with pytest.raises(error, match=r"^seed: expected"):
        tracker(seed=seed)
    assert tracker(seed=np.int64(5)).seed == 5


@pytest.mark.parametrize("tracker", TRACKERS)
@pytest.mark.parametrize("name", ["", "cuda", None, []])
def test_kernels_are_native_or_reference(tracker, name):
    """Another set of kernels is a ValueError that names both."""
    with pytest.raises(ValueError, match=r"^kernels: expected 'native' or 'reference'"):
        tracker(kernels=name)


@pytest.mark.parametrize("tracker", TRACKERS)
def test_every_parameter_says_what_it_is(tracker):
    """Each field has a meaning, a unit, a source and a line in the table; its default passes its check."""
    known = fields(tracker)
    lines = tracker.Params.describe().splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(known)
    said = ("doc", "unit", "source")
    assert all(field.metadata[each] for field in known.values() for each in said)
    assert tracker.Params(**{name: field.default for name, field in known.items()}) == tracker.Params()
