# SPDX-License-Identifier: MIT
"""Variants of trackers: with parameters, under a label, limited to some of a sequence's channels."""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.cli.evaluate import settings_by_tracker
from tricue.evaluation import baselines
from tricue.evaluation.frame_views import FrameView
from tricue.evaluation.safe_tracker import SafeTracker
from tricue.evaluation.tracker_spec import SequenceInfo, TrackerSpec
from tricue.evaluation.trackers import tracker_specs

CHANNELS = ("color", "depth", "right")


@dataclass(frozen=True)
class Inputs:
    """A sequence's channels and cameras, as in the protocol ``SequenceInfo``."""

    channels: tuple[str, ...]
    intrinsics: Intrinsics | None = None
    rig: StereoRig | None = None
    registered: bool = True

    @property
    def channel(self) -> str:
        """The channel in whose pixels boxes are: color, or else depth."""
        return "color" if "color" in self.channels else "depth"


@dataclass(frozen=True)
class Variant:
    """A tracker spec with a label.

    only: the channels that it gets; None for all that it can use. timed: whether its frames have timestamps.
    """

    label: str
    spec: TrackerSpec
    only: tuple[str, ...] | None = None
    timed: bool = True

    def unsupported(self, inputs: SequenceInfo) -> str:
        """Why the variant can't run on such inputs; "" if it can."""
        missing = [name for name in self.only or () if name not in inputs.channels]
        return f"no {missing[0]}" if missing else self.spec.unsupported_reason(self._limited(inputs))

    def make(self, inputs: SequenceInfo, seed: int = 0) -> SafeTracker:
        """The tracker with its cameras."""
        return self.spec.make(self._limited(inputs), seed)

    def view(self, inputs: SequenceInfo) -> FrameView:
        """The function that turns a frame into what the variant gets of it."""
        only, view = self.only, self.spec.view(self._limited(inputs))
        if only is None and self.timed:
            return view
        chosen = CHANNELS if only is None else only
        return lambda frame: view(
            Frame(
                **{name: getattr(frame, name) for name in chosen},
                timestamp=frame.timestamp if self.timed else None,
            )
        )

    def _limited(self, inputs: SequenceInfo) -> SequenceInfo:
        if self.only is None:
            return inputs
        return Inputs(
            self.only,
            inputs.intrinsics if "depth" in self.only else None,
            inputs.rig if "right" in self.only else None,
            inputs.registered,
        )


def parse_variants(words: Sequence[str], settings: Sequence[str] = ()) -> list[Variant]:
    """From names such as CSRT, fused, or fused:color and fused:color+depth, which get these channels only.

    settings: "name.parameter=value", for tricue's trackers. Trackers that the installed cv2 lacks are left
    out and named on stderr. ValueError for unknown names, and if no tracker is left.
    """
    words = _installed(words)
    names = [word.partition(":")[0] for word in words]
    values = settings_by_tracker(settings)
    if unused := [name for name in values if name not in names]:
        raise ValueError(f"--set: expected one of {', '.join(names)}, got {unused[0]!r}")
    specs = tracker_specs(names, values)
    return [Variant(word, spec, _channels(word)) for word, spec in zip(words, specs, strict=True)]


def _installed(words: Sequence[str]) -> list[str]:
    lacking = set(baselines.NAMES) - set(baselines.available())
    found = [word for word in words if word.partition(":")[0] not in lacking]
    for word in words:
        if word not in found:
            print(f"left out {word}: the installed cv2 doesn't have it", file=sys.stderr)
    if not found:
        raise ValueError(f"--trackers: expected some that the installed cv2 has, got {', '.join(words)}")
    return found


def with_settings(variant: Variant, label: str, values: Mapping[str, Any]) -> Variant:
    """The same tracker with another label and more parameters."""
    settings = dict(variant.spec.settings) | dict(values)
    return replace(variant, label=label, spec=replace(variant.spec, settings=tuple(settings.items())))


def without_times(variant: Variant) -> Variant:
    """The same tracker, with frames without timestamps."""
    return replace(variant, label=f"{variant.label}, no times", timed=False)


def _channels(word: str) -> tuple[str, ...] | None:
    _, colon, text = word.partition(":")
    if not colon:
        return None
    channels = tuple(text.split("+"))
    if unknown := [name for name in channels if name not in CHANNELS]:
        raise ValueError(f"--trackers: expected channels of {', '.join(CHANNELS)}, got {unknown[0]!r}")
    return channels
