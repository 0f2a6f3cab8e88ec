# SPDX-License-Identifier: MIT
"""The experts: one cue's model of the target each, behind two small interfaces.

All are immutable: learning returns another. What they tell of pixels is combined by Bayes' rule
(:func:`combine_posteriors`); what they tell of places is added up in :mod:`tricue.track.fused.localize`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Literal, Protocol

from tricue.kernels import Kernels
from tricue.track.base.params import Params, parameter
from tricue.track.fused.arrays import Plane
from tricue.track.fused.window import Window

Cue = Literal["filter", "color", "size", "depth"]


@dataclass(frozen=True, kw_only=True)
class CueParams(Params):
    """Which experts are asked."""

    cues: tuple[Cue, ...] = parameter(
        ("filter", "color", "size", "depth"),
        unit="-",
        source="fused.md",
        doc="the experts that are used",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not {"filter", "color"} & set(self.cues):
            raise ValueError(f"cues: expected filter or color, which localize the target, among {self.cues}")


class PixelExpert(Protocol):
    """Tells the target's pixels from the others."""

    def posterior(self, window: Window) -> Plane | None:
        """(64, 64) P(target | the pixel's cue), 0.5 where that tells nothing; None where it never does."""


class PlaceExpert(Protocol):
    """Tells the target's place from the others."""

    def responses(self, window: Window) -> Plane:
        """(n, 32, 32) of n models, for the target's center at each cell: about 1 on it, 0 elsewhere."""


def combine_posteriors(k: Kernels, posteriors: Sequence[Plane | None]) -> Plane | None:
    """(64, 64) posterior by independent cues of equal priors, whose odds multiply; None of none."""
    given = [each for each in posteriors if each is not None]
    return reduce(k.combine_posteriors, given) if given else None
