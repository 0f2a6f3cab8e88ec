# SPDX-License-Identifier: MIT
"""All that the fused tracker keeps from frame to frame."""

from dataclasses import dataclass
from typing import NamedTuple

from tricue.track.fused.experts import ColorExpert, FilterExpert
from tricue.track.fused.identity import Identity, Marks
from tricue.track.fused.scale import Looks, ScaleExpert
from tricue.track.fused.view import Target, View


class Models(NamedTuple):
    """What is known of the target's look; learning gives others."""

    filter: FilterExpert
    color: ColorExpert
    scale: ScaleExpert
    identity: Identity
    edge: float  # P(target | color) along the target's edge, in the first frame


class Place(NamedTuple):
    """Where something like the target was found, and the evidence for it."""

    target: Target
    view: View
    evidence: float
    answer: float  # the filter's


class Found(NamedTuple):
    """A place looked at closely: its size measured, its identity judged. view: its middle is the target."""

    target: Target
    view: View
    looks: Looks
    marks: Marks
    answer: float

    @property
    def log_odds(self) -> float:
        """Of its being the target."""
        return self.marks.log_odds


@dataclass(frozen=True, slots=True)
class State:
    """After a frame."""

    shape: tuple[int, ...]
    models: Models
    target: Target
    velocity: tuple[float, float]  # pixels a frame
    first_side: float  # pixels, of the first box
    marks: Marks
    score: float
    usual: float  # the filter's answer where the target is
    missed: int = 0  # frames in a row in which it was not recognised
    count: int = 0  # frames since init
