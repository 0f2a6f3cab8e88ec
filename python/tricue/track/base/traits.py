# SPDX-License-Identifier: MIT
"""What a tracker class needs, takes and can do, as values that others read."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal


@dataclass(frozen=True, slots=True)
class Channels:
    """A set of a frame's channels that a tracker can run on.

    names: of "color", "right" and "depth". params: the parameters that make it run on these alone. The boxes
    are in pixels of color, or of depth where there is no color.
    """

    names: frozenset[str]
    params: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, *names: str, **params: Any) -> "Channels":
        """``Channels.of("color", "depth", cues=("flow",))``."""
        return cls(frozenset(names), params)

    def agrees(self, params: Any) -> bool:
        """Whether given parameters, an object with them as attributes, are those that this set takes."""
        return all(getattr(params, name) == value for name, value in self.params.items())


@dataclass(frozen=True, slots=True, kw_only=True)
class Traits:
    """One for each tracker class, its attribute ``traits``; the same for all parameters.

    channels: the sets of channels it runs on, best first: with more than one that a frame has, the first.
    camera: the cameras that its constructor takes, as keywords: "intrinsics", "rig".
    guesses: whether it tells positions by a default camera where none is known; else it tells none.
    detects: what it finds by itself when ``init`` gets no box; None where it needs an initial box.
    random: whether it draws random numbers, so that tracks depend on ``seed``.
    disparity_range: the parameters, in meters, that bound where it looks for a target in a stereo pair.
    shows: attributes that can be drawn, of those that overlays know: particles (N, 2 or more) with x, y in
        pixels first, objects (boxes), mask (H, W), blocks (boxes of the target, boxes that are occluded).
    follows: a few words for tables: what it tracks, and by what.
    source: the paper, or "ours".
    """

    channels: tuple[Channels, ...]
    camera: frozenset[Literal["intrinsics", "rig"]] = frozenset()
    guesses: bool = False
    detects: Literal["face", "person"] | None = None
    random: bool = False
    disparity_range: tuple[str, str] | None = None
    shows: frozenset[Literal["particles", "objects", "mask", "blocks"]] = frozenset()
    follows: str = ""
    source: str = ""

    def best(self, present: Collection[str]) -> Channels | None:
        """The first of its sets whose channels are all present; None where it can't run."""
        return next((each for each in self.channels if each.names <= set(present)), None)

    def fitting(self, params: Any) -> tuple[Channels, ...]:
        """Its sets of channels for given parameters: those whose own agree best with these."""
        agreeing = [each for each in self.channels if each.agrees(params)]
        most = max((len(each.params) for each in agreeing), default=0)
        return tuple(each for each in agreeing if len(each.params) == most)

    @property
    def needs(self) -> str:
        """Its sets of channels in words: "color and right, or color"."""
        sets = (" and ".join(sorted(each.names, key=_ORDER.index)) for each in self.channels)
        return ", or ".join(sets)


_ORDER = ("color", "right", "depth")
