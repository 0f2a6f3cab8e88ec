# SPDX-License-Identifier: MIT
"""A tracker class's inputs and capabilities, declared as data."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal


@dataclass(frozen=True, slots=True)
class Channels:
    """A set of a frame's channels that a tracker can run on.

    names: some of "color", "right" and "depth". params: the parameters with which the tracker runs on these
    channels alone. The boxes are in pixels of color, or of depth if there is no color.
    """

    names: frozenset[str]
    params: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, *names: str, **params: Any) -> "Channels":
        """``Channels.of("color", "depth", cues=("flow",))``."""
        return cls(frozenset(names), params)

    def agrees(self, params: Any) -> bool:
        """Whether an object's attributes have the values of this set's parameters."""
        return all(getattr(params, name) == value for name, value in self.params.items())


@dataclass(frozen=True, slots=True, kw_only=True)
class Traits:
    """The attribute ``traits`` of a tracker class; the same for all parameters.

    channels: the sets of channels it runs on, best first; the first set that a frame has is used.
    camera: the keywords of its constructor that take a camera: "intrinsics", "rig".
    detects: what ``init`` detects without a box; None if it needs an initial box.
    random: whether it draws random numbers, so that its tracks depend on ``seed``.
    disparity_range: names of its parameters for the nearest and farthest stereo distance, meters.
    shows: its attributes that overlays can draw: particles (N, 2 or more) that begin with x, y in pixels,
        objects (boxes), mask (H, W), blocks (boxes of the target, boxes that are occluded).
    follows: what it tracks and by which cues, in a few words for tables.
    source: the paper, or "ours".
    """

    channels: tuple[Channels, ...]
    camera: frozenset[Literal["intrinsics", "rig"]] = frozenset()
    detects: Literal["face", "head", "person"] | None = None
    random: bool = False
    disparity_range: tuple[str, str] | None = None
    shows: frozenset[Literal["particles", "objects", "mask", "blocks"]] = frozenset()
    follows: str = ""
    source: str = ""

    def best(self, present: Collection[str]) -> Channels | None:
        """The first set whose channels are all present; None if the tracker can't run."""
        return next((each for each in self.channels if each.names <= set(present)), None)

    def fitting(self, params: Any) -> tuple[Channels, ...]:
        """The sets of channels for given parameters: those whose own parameters match the most of them."""
        agreeing = [each for each in self.channels if each.agrees(params)]
        most = max((len(each.params) for each in agreeing), default=0)
        return tuple(each for each in agreeing if len(each.params) == most)

    @property
    def needs(self) -> str:
        """Its sets of channels in words: "color and right, or color"."""
        sets = (" and ".join(sorted(each.names, key=_ORDER.index)) for each in self.channels)
        return ", or ".join(sets)


_ORDER = ("color", "right", "depth")
