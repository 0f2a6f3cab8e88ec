# SPDX-License-Identifier: MIT
"""Who takes part: our trackers, on whatever they can see of a sequence, and the installed cv2's."""

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Protocol

import cv2

import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.errors import one_line
from tricue.evaluation import baselines
from tricue.evaluation.one_pass import Contender
from tricue.track.base.registry import names, tracker_class
from tricue.track.base.track import Status, Track

View = Callable[[Frame], Frame]
"""What a contender is shown of a frame; made off the clock."""

WIDEST, NARROWEST = 0.25, 4.0  # disparities of a stereo head's range: of the image's width; pixels
_SLOWNESS = {"CSRT": 60.0, "MIL": 60.0, "KCF": 10.0, "KCF-0.1": 10.0, "script-pf": 5.0}
_STEADY = tuple(name for name in baselines.available() if name != "script-pf")  # draw no random numbers


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
class Entrant:
    """A tracker of ours or a peer, by name. settings: parameters that aren't the defaults, for ours."""

    name: str
    settings: tuple[tuple[str, Any], ...] = ()

    @property
    def ours(self) -> bool:
        """Whether it is one of our trackers."""
        return self.name in names()

    @property
    def steady(self) -> bool:
        """Whether one run is enough: it draws no random numbers, or, as MIL, none that its users can seed."""
        return self.name in _STEADY or self.name in ("stereo-head", "flow-depth", "fused")

    @property
    def slowness(self) -> float:
        """About how long a frame takes beside one of our trackers; only for the order of the work."""
        return _SLOWNESS.get(self.name, 1.0)

    @property
    def described(self) -> str:
        """What else than the images decides a run: parameters and versions, as JSON."""
        if not self.ours:
            return json.dumps({"cv2": cv2.__version__})
        params = tracker_class(self.name).Params(**dict(self.settings))
        return json.dumps({"tricue": tricue.__version__, **asdict(params)}, default=str)

    def refuses(self, opened: Offer) -> str:
        """Why it can't run on a sequence, "" where it can."""
        channels, depth = opened.channels, opened.channel == "depth"
        if self.name == "stereo-head":
            return "" if "right" in channels else "no stereo pair"
        if self.name == "depth-particle":
            return "" if "depth" in channels and (depth or opened.registered) else "no depth"
        if self.name == "color-particle":
            return "boxes of the depth image" if depth else ""
        return ""

    def contender(self, opened: Offer, seed: int) -> "Guarded":
        """The tracker for a sequence, with its cameras."""
        baselines.seed(seed)
        if not self.ours:
            return Guarded(baselines.available()[self.name](seed))
        keywords = _FITTED[self.name](opened)[0] | dict(self.settings)
        return Guarded(tricue.create(self.name, seed=seed, **keywords))

    def view(self, opened: Offer) -> View:
        """What the tracker is shown: the channels that it can use. The peers see depth as a picture where the
        true boxes are in it.
        """
        if self.ours:
            return _FITTED[self.name](opened)[1]
        return pictured() if opened.channel == "depth" else _color


class Guarded:
    """A contender that never raises: from its first error on, which is ``trouble``, it finds nothing."""

    def __init__(self, tracker: Contender) -> None:
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


def entrants(chosen: Sequence[str] | None, settings: Mapping[str, Mapping[str, Any]]) -> list[Entrant]:
    """Those of the given names, by default all; settings: parameters by our trackers' names.

    ValueError for an unknown name lists the known ones.
    """
    known = [*names(), *baselines.available()]
    for name in [*(chosen or ()), *settings]:
        if name not in known:
            raise ValueError(f"--trackers: expected some of {', '.join(known)}, got {name!r}")
    found = [Entrant(name, tuple(settings.get(name, {}).items())) for name in chosen or known]
    for each in found:
        _check(each)
    return found


def _check(entrant: Entrant) -> None:
    """Errors of parameters come before the first run."""
    if entrant.ours:
        tracker_class(entrant.name).Params(**dict(entrant.settings))
    elif entrant.settings:
        raise ValueError(f"--set: expected a parameter of one of our trackers, got one of {entrant.name}")


Fitted = tuple[dict[str, Any], View]  # keywords for the tracker, and what it is shown


def _color_particle(opened: Offer) -> Fitted:
    return {}, _color


def _depth_particle(opened: Offer) -> Fitted:
    return {"intrinsics": opened.intrinsics}, _depth


def _stereo_head(opened: Offer) -> Fitted:
    rig = opened.rig
    return ({} if rig is None else {"rig": rig, **_range(rig)}), _pair


def _flow_depth(opened: Offer) -> Fitted:
    """Both cues where there is a pair, or depth that belongs to the color; else the one that there is."""
    channels = opened.channels
    if "right" in channels:
        return {"rig": opened.rig}, _pair
    if opened.channel == "depth":
        return {"intrinsics": opened.intrinsics, "cues": ("disparity",)}, _depth
    if "depth" in channels and opened.registered:
        return {"intrinsics": opened.intrinsics}, _whole
    return {"cues": ("flow",)}, _color


def _fused(opened: Offer) -> Fitted:
    """All that belongs together: the pair, color with registered depth, or the one of both that there is."""
    channels = opened.channels
    if "right" in channels:
        return {"rig": opened.rig}, _pair
    if opened.channel == "depth":
        return {"intrinsics": opened.intrinsics}, _depth
    if "depth" in channels and opened.registered:
        return {"intrinsics": opened.intrinsics}, _whole
    return {}, _color


def _range(rig: StereoRig) -> dict[str, float]:
    """Between which distances a target is looked for: where a pair's disparity is WIDEST and NARROWEST."""
    product = rig.intrinsics.fx * rig.baseline
    return {"near": product / (WIDEST * rig.intrinsics.width), "far": product / NARROWEST}


_FITTED: dict[str, Callable[[Offer], Fitted]] = {
    "color-particle": _color_particle,
    "depth-particle": _depth_particle,
    "stereo-head": _stereo_head,
    "flow-depth": _flow_depth,
    "fused": _fused,
}


def _whole(frame: Frame) -> Frame:
    return frame


def _color(frame: Frame) -> Frame:
    return Frame(frame.color, timestamp=frame.timestamp)


def _depth(frame: Frame) -> Frame:
    return Frame(depth=frame.depth, timestamp=frame.timestamp)


def _pair(frame: Frame) -> Frame:
    return Frame(frame.color, right=frame.right, timestamp=frame.timestamp)
