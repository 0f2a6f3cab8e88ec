# SPDX-License-Identifier: MIT
"""Tracker specs: which trackers are evaluated, with which parameters, and on which channels of a sequence."""

import json
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from functools import partial
from typing import Any, Protocol

import cv2

import tricue
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.evaluation import baselines
from tricue.evaluation.frame_views import FrameView, depth_as_picture, select_channels
from tricue.evaluation.safe_tracker import SafeTracker
from tricue.track.base import registry
from tricue.track.base.traits import Channels, Traits

Make = Callable[[int], SafeTracker]
"""Makes a tracker from a seed."""

# The range of a target's disparity in which trackers search a stereo pair.
MAX_DISPARITY_RATIO = 0.25  # of the image's width
MIN_DISPARITY = 4.0  # pixels
_RELATIVE_TIMES = {"CSRT": 60.0, "MIL": 60.0, "KCF": 10.0, "KCF-0.1": 10.0, "script-pf": 5.0}
SEEDED_BASELINE = "script-pf"  # the baseline whose random numbers can be seeded
BASELINE_TRAITS = Traits(channels=(Channels.of("color"),))


class SequenceInfo(Protocol):
    """The inputs that a sequence offers to trackers, such as an ``OpenedSequence``.

    Its channels, the one in whose pixels the boxes are, whether depth is registered to color, and the known
    cameras.
    """

    @property
    def channels(self) -> Collection[str]: ...
    @property
    def channel(self) -> str: ...
    @property
    def registered(self) -> bool: ...
    @property
    def intrinsics(self) -> Intrinsics | None: ...
    @property
    def rig(self) -> StereoRig | None: ...


@dataclass(frozen=True)
class TrackerSpec:
    """A tracker by its name: one of ours or a baseline, which run in this process.

    settings: parameters that aren't the defaults; baselines take none. kind: the registry's name of one of
    ours, if it runs under another name; else "".
    """

    name: str
    settings: tuple[tuple[str, Any], ...] = ()
    kind: str = field(default="", kw_only=True)

    @property
    def ours(self) -> bool:
        """Whether it is one of tricue's trackers; else it is one of the baselines."""
        return self.name not in baselines.NAMES

    @property
    def traits(self) -> Traits:
        """Its inputs and capabilities; baselines take one image."""
        return registry.traits(self.kind or self.name) if self.ours else BASELINE_TRAITS

    @property
    def random(self) -> bool:
        """Whether it depends on a seed, so that several runs are needed."""
        return self.traits.random if self.ours else self.name == SEEDED_BASELINE

    @property
    def relative_time(self) -> float:
        """The approximate time per frame relative to tricue's trackers; used only to order the tasks."""
        return _RELATIVE_TIMES.get(self.name, 1.0)

    @property
    def description(self) -> str:
        """What a run depends on besides the sequence: parameters and versions, as JSON."""
        if not self.ours:
            return json.dumps({"cv2": cv2.__version__})
        params = registry.tracker_class(self.kind or self.name).Params(**dict(self.settings))
        kind = {"tracker": self.kind} if self.kind else {}
        return json.dumps({"tricue": tricue.__version__, **kind, **asdict(params)}, default=str)

    def unsupported_reason(self, opened: SequenceInfo) -> str:
        """Why it can't run on a sequence, "" if it can."""
        if self.name in baselines.NAMES and self.name not in baselines.available():
            return baselines.missing_reason(self.name)
        if self.sees_a_picture(opened):
            return ""
        present = _usable_channels(opened)
        if self.traits.best(present) is not None:
            return ""
        missing = self.traits.channels[-1].names - present
        absent = missing - frozenset(opened.channels)
        if "right" in absent:
            return "no stereo pair"
        if absent:
            return f"no {', '.join(sorted(absent))}"
        return "boxes of the depth image" if "color" in missing else "depth not registered to color"

    def make(self, opened: SequenceInfo, seed: int) -> SafeTracker:
        """The tracker for a sequence, with its cameras."""
        baselines.seed(seed)
        if not self.ours:
            return SafeTracker(baselines.available()[self.name](seed))
        return SafeTracker(tricue.create(self.kind or self.name, seed=seed, **self.keywords(opened)))

    @contextmanager
    def session(self, opened: SequenceInfo) -> Iterator[Make]:
        """Yield the function that makes the tracker for a sequence from a seed, for one run."""
        yield partial(self.make, opened)

    def keywords(self, opened: SequenceInfo) -> dict[str, Any]:
        """The tracker's keywords for a sequence: its camera or rig, and the parameters."""
        return _keywords(self.traits, opened) | dict(self.settings)

    def sees_a_picture(self, opened: SequenceInfo) -> bool:
        """Whether it gets depth as a picture: baselines do, if the true boxes are in depth pixels."""
        return not self.ours and opened.channel == "depth"

    def outdated(self, error: str) -> bool:
        """Whether a run that ended with this error must be repeated."""
        return False

    def view(self, opened: SequenceInfo) -> FrameView:
        """Selects the channels that the tracker uses."""
        if self.sees_a_picture(opened):
            return depth_as_picture()
        chosen = self.traits.best(_usable_channels(opened))
        return partial(select_channels, frozenset({"color"}) if chosen is None else chosen.names)


def _usable_channels(opened: SequenceInfo) -> frozenset[str]:
    """The channels registered to the one in whose pixels the true boxes are."""
    if opened.channel == "depth":
        return frozenset({"depth"})
    channels = frozenset(opened.channels)
    return channels if opened.registered else channels - {"depth"}


def _keywords(traits: Traits, opened: SequenceInfo) -> dict[str, Any]:
    """A tracker's keywords for a sequence: the parameters for its channels, and its camera or rig."""
    chosen = traits.best(_usable_channels(opened))
    if chosen is None:
        return {}
    keywords = dict(chosen.params)
    if "right" in chosen.names and "rig" in traits.camera:
        keywords["rig"] = opened.rig
        if opened.rig is not None and traits.disparity_range is not None:
            keywords |= dict(zip(traits.disparity_range, _search_range(opened.rig), strict=True))
    elif "depth" in chosen.names and "intrinsics" in traits.camera:
        keywords["intrinsics"] = opened.intrinsics
    return keywords


def _search_range(rig: StereoRig) -> tuple[float, float]:
    """The nearest and farthest distances to search, meters: those of the largest and smallest disparities."""
    product = rig.intrinsics.fx * rig.baseline
    return product / (MAX_DISPARITY_RATIO * rig.intrinsics.width), product / MIN_DISPARITY
