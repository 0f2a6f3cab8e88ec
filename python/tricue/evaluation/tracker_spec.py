# SPDX-License-Identifier: MIT
"""Tracker specs: which trackers are evaluated, with which parameters, and on which channels of a sequence."""

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any, Protocol

import cv2

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.errors import one_line
from tricue.evaluation import baselines
from tricue.evaluation.one_pass import AnyTracker
from tricue.track.base import registry
from tricue.track.base.track import Status, Track
from tricue.track.base.traits import Channels, Traits

FrameView = Callable[[Frame], Frame]
"""Selects the channels of a frame that a tracker gets; its time isn't measured."""

# Disparities of a target in a stereo pair between which trackers search.
MAX_DISPARITY_RATIO = 0.25  # of the image's width
MIN_DISPARITY = 4.0  # pixels
_RELATIVE_TIMES = {"CSRT": 60.0, "MIL": 60.0, "KCF": 10.0, "KCF-0.1": 10.0, "script-pf": 5.0}
SEEDED_BASELINE = "script-pf"  # the baseline whose random numbers can be seeded
BASELINE_TRAITS = Traits(channels=(Channels.of("color"), Channels.of("depth")))


class SequenceInfo(Protocol):
    """The inputs that a sequence offers to trackers, such as an ``OpenedSequence``.

    Its channels, the one in whose pixels the boxes are given, whether depth is registered to color, and the
    known cameras.
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
    """A tracker by its name: one of ours, of a package, of a module (``module:Class``), or a baseline.

    settings: parameters that aren't the defaults; baselines take none.
    """

    name: str
    settings: tuple[tuple[str, Any], ...] = ()

    @property
    def ours(self) -> bool:
        """Whether it has the interface of tricue's trackers; else it is one of the baselines."""
        return self.name not in baselines.NAMES

    @property
    def traits(self) -> Traits:
        """Its inputs and capabilities; baselines take one image."""
        return registry.traits(self.name) if self.ours else BASELINE_TRAITS

    @property
    def random(self) -> bool:
        """Whether it depends on a seed, so that several runs are needed."""
        return self.traits.random if self.ours else self.name == SEEDED_BASELINE

    @property
    def relative_time(self) -> float:
        """Roughly the time per frame relative to tricue's trackers; only used to order the tasks."""
        return _RELATIVE_TIMES.get(self.name, 1.0)

    @property
    def description(self) -> str:
        """What a run depends on besides the sequence: parameters and versions, as JSON."""
        if not self.ours:
            return json.dumps({"cv2": cv2.__version__})
        kind, settings = registry.tracker_class(self.name).Params, dict(self.settings)
        if kind is None:
            return json.dumps({"code": registry.code_digest(self.name), **settings}, default=str)
        return json.dumps({"tricue": tricue.__version__, **asdict(kind(**settings))}, default=str)

    def unsupported_reason(self, opened: SequenceInfo) -> str:
        """Why it can't run on a sequence, "" if it can."""
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

    def make(self, opened: SequenceInfo, seed: int) -> "SafeTracker":
        """The tracker for a sequence, with its cameras."""
        baselines.seed(seed)
        if not self.ours:
            return SafeTracker(baselines.available()[self.name](seed))
        keywords = _keywords(self.traits, opened) | dict(self.settings)
        return SafeTracker(tricue.create(self.name, seed=seed, **keywords))

    def view(self, opened: SequenceInfo) -> FrameView:
        """Selects the channels that the tracker uses. Baselines get depth as a picture if the true boxes are
        given in its pixels.
        """
        if not self.ours and opened.channel == "depth":
            return depth_as_picture()
        chosen = self.traits.best(_usable_channels(opened))
        return partial(_select_channels, frozenset({"color"}) if chosen is None else chosen.names)


class SafeTracker:
    """A tracker that never raises: after its first error, kept in ``error``, it returns tracks without a
    box.
    """

    def __init__(self, tracker: AnyTracker) -> None:
        self.error = ""
        self._tracker = tracker

    def init(self, frame: Frame, box: Box) -> Track:
        """The tracker's, or a track without a box."""
        return self._try(lambda: self._tracker.init(frame, box))

    def update(self, frame: Frame) -> Track:
        """The tracker's, or a track without a box."""
        return self._try(lambda: self._tracker.update(frame))

    def _try(self, call: Callable[[], Track]) -> Track:
        if not self.error:
            try:
                return call()
            except (ValueError, RuntimeError, cv2.error) as error:
                self.error = one_line(error)
        return Track(Box(*[float("nan")] * 4), 0.0, Status.LOST)


def depth_as_picture() -> FrameView:
    """Renders depth as a picture in the color channel, with the depth range of the first frame."""
    depth_limits: list[tuple[float, float]] = []

    def view(frame: Frame) -> Frame:
        frame.require("depth")
        assert frame.depth is not None
        if not depth_limits:
            depth_limits.append(depth_range(frame.depth) or (0.0, 1.0))
        return Frame(depth_picture(frame.depth, *depth_limits[0]), timestamp=frame.timestamp)

    return view


def tracker_specs(
    chosen: Sequence[str] | None, settings: Mapping[str, Mapping[str, Any]]
) -> list[TrackerSpec]:
    """The specs of the given names, by default of all installed trackers. settings: parameters by tracker
    name.

    ValueError for an unknown name lists the known ones.
    """
    known = [*registry.names(), *baselines.available()]
    for name in [*(chosen or ()), *settings]:
        if name not in known and ":" not in name:
            expected = f"some of {', '.join(known)} or module:Class"
            raise ValueError(f"--trackers: expected {expected}, got {name!r}")
    found = [TrackerSpec(name, tuple(settings.get(name, {}).items())) for name in chosen or known]
    for each in found:
        _check(each)
    return found


def _check(spec: TrackerSpec) -> None:
    """TypeError or ValueError for wrong parameters, before the first run."""
    if not spec.ours:
        if spec.settings:
            raise ValueError(f"--set: expected a parameter of one of our trackers, got one of {spec.name}")
        return
    kind = registry.tracker_class(spec.name).Params
    if kind is not None:
        kind(**dict(spec.settings))


def _usable_channels(opened: SequenceInfo) -> frozenset[str]:
    """The channels registered to the one in whose pixels the true boxes are given."""
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
    """The nearest and farthest distance, meters, at which to search: those of the largest and smallest
    disparity.
    """
    product = rig.intrinsics.fx * rig.baseline
    return product / (MAX_DISPARITY_RATIO * rig.intrinsics.width), product / MIN_DISPARITY


def _select_channels(names: frozenset[str], frame: Frame) -> Frame:
    """The frame with these channels only."""
    channels = {name: getattr(frame, name) for name in names}
    return Frame(**channels, timestamp=frame.timestamp)
