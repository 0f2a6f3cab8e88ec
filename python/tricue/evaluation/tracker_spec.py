# SPDX-License-Identifier: MIT
"""Who takes part: our trackers, on whatever they can see of a sequence, and the installed cv2's."""

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

View = Callable[[Frame], Frame]
"""What a tracker is shown of a frame; made off the clock."""

MAX_DISPARITY, MIN_DISPARITY = 0.25, 4.0  # of a target in a stereo pair: of the image's width; pixels
_SLOWNESS = {"CSRT": 60.0, "MIL": 60.0, "KCF": 10.0, "KCF-0.1": 10.0, "script-pf": 5.0}
SCRIPT = "script-pf"  # the baseline that draws random numbers which its users can seed
BASELINE = Traits(channels=(Channels.of("color"), Channels.of("depth")))


class Offer(Protocol):
    """What a sequence has for trackers, as an ``Opened`` tells it: its channels, the one whose pixels the
    boxes count, whether depth is registered to color, and its cameras as far as they are known.
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
        """What it needs and takes; baselines see one picture."""
        return registry.traits(self.name) if self.ours else BASELINE

    @property
    def random(self) -> bool:
        """Whether it draws random numbers from a seed, so that one run isn't enough."""
        return self.traits.random if self.ours else self.name == SCRIPT

    @property
    def slowness(self) -> float:
        """About how long a frame takes beside one of our trackers; only for the order of the work."""
        return _SLOWNESS.get(self.name, 1.0)

    @property
    def described(self) -> str:
        """What else than the images decides a run: parameters and versions, as JSON."""
        if not self.ours:
            return json.dumps({"cv2": cv2.__version__})
        kind, settings = registry.tracker_class(self.name).Params, dict(self.settings)
        params = settings if kind is None else asdict(kind(**settings))
        return json.dumps({"tricue": tricue.__version__, **params}, default=str)

    def refuses(self, opened: Offer) -> str:
        """Why it can't run on a sequence, "" where it can."""
        present = _usable(opened)
        if self.traits.best(present) is not None:
            return ""
        missing = self.traits.channels[-1].names - present
        absent = missing - frozenset(opened.channels)
        if "right" in absent:
            return "no stereo pair"
        if absent:
            return f"no {', '.join(sorted(absent))}"
        return "boxes of the depth image" if "color" in missing else "depth not registered to color"

    def make(self, opened: Offer, seed: int) -> "SafeTracker":
        """The tracker for a sequence, with its cameras."""
        baselines.seed(seed)
        if not self.ours:
            return SafeTracker(baselines.available()[self.name](seed))
        keywords = _keywords(self.traits, opened) | dict(self.settings)
        return SafeTracker(tricue.create(self.name, seed=seed, **keywords))

    def view(self, opened: Offer) -> View:
        """What the tracker is shown: the channels that it uses. Baselines see depth as a picture where the
        true boxes are in it.
        """
        if not self.ours and opened.channel == "depth":
            return pictured()
        chosen = self.traits.best(_usable(opened))
        return partial(_only, frozenset({"color"}) if chosen is None else chosen.names)


class SafeTracker:
    """A tracker that never raises: from its first error on, which is ``trouble``, it finds nothing."""

    def __init__(self, tracker: AnyTracker) -> None:
        self.trouble = ""
        self._tracker = tracker

    def init(self, frame: Frame, box: Box) -> Track:
        """The tracker's, or a track without a box."""
        return self._tried(lambda: self._tracker.init(frame, box))

    def update(self, frame: Frame) -> Track:
        """The tracker's, or a track without a box."""
        return self._tried(lambda: self._tracker.update(frame))

    def _tried(self, call: Callable[[], Track]) -> Track:
        if not self.trouble:
            try:
                return call()
            except (ValueError, RuntimeError, cv2.error) as error:
                self.trouble = one_line(error)
        return Track(Box(*[float("nan")] * 4), 0.0, Status.LOST)


def pictured() -> View:
    """Depth as a picture in the color channel, near to far in the first frame's range."""
    shades: list[tuple[float, float]] = []

    def view(frame: Frame) -> Frame:
        frame.require("depth")
        assert frame.depth is not None
        if not shades:
            shades.append(depth_range(frame.depth) or (0.0, 1.0))
        return Frame(depth_picture(frame.depth, *shades[0]), timestamp=frame.timestamp)

    return view


def tracker_specs(
    chosen: Sequence[str] | None, settings: Mapping[str, Mapping[str, Any]]
) -> list[TrackerSpec]:
    """Those of the given names, by default all that are installed; settings: parameters by trackers' names.

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
    """Errors of names and parameters come before the first run."""
    if not spec.ours:
        if spec.settings:
            raise ValueError(f"--set: expected a parameter of one of our trackers, got one of {spec.name}")
        return
    kind = registry.tracker_class(spec.name).Params
    if kind is not None:
        kind(**dict(spec.settings))


def _usable(opened: Offer) -> frozenset[str]:
    """The channels whose pixels the true boxes count, or that belong to those."""
    if opened.channel == "depth":
        return frozenset({"depth"})
    channels = frozenset(opened.channels)
    return channels if opened.registered else channels - {"depth"}


def _keywords(traits: Traits, opened: Offer) -> dict[str, Any]:
    """What a tracker is told on a sequence: the parameters for its channels, and its camera or rig."""
    chosen = traits.best(_usable(opened))
    if chosen is None:
        return {}
    keywords = dict(chosen.params)
    if "right" in chosen.names and "rig" in traits.camera:
        keywords["rig"] = opened.rig
        if opened.rig is not None and traits.disparity_range is not None:
            keywords |= dict(zip(traits.disparity_range, _range(opened.rig), strict=True))
    elif "depth" in chosen.names and "intrinsics" in traits.camera:
        keywords["intrinsics"] = opened.intrinsics
    return keywords


def _range(rig: StereoRig) -> tuple[float, float]:
    """Between which distances, meters, a target is looked for: where its disparity is as large and as small
    as it may be.
    """
    product = rig.intrinsics.fx * rig.baseline
    return product / (MAX_DISPARITY * rig.intrinsics.width), product / MIN_DISPARITY


def _only(names: frozenset[str], frame: Frame) -> Frame:
    """The frame with these channels alone, of those that it has."""
    channels = {name: getattr(frame, name) for name in names}
    return Frame(**channels, timestamp=frame.timestamp)
