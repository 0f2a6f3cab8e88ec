# SPDX-License-Identifier: MIT
"""The experts: each is a model of the target by one cue.

Experts are immutable: learning returns a new one. The kernel ``localize_target`` combines their pixel
posteriors by Bayes' rule, and adds up their evidence for places (:mod:`tricue.track.fused.localize`).
"""

from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter

Cue = Literal["filter", "color", "size", "turn", "depth"]


@dataclass(frozen=True, kw_only=True)
class CueParams(Params):
    """Which experts are used."""

    cues: tuple[Cue, ...] = parameter(
        ("filter", "color", "size", "turn", "depth"),
        unit="-",
        source="fused.md",
        doc="the experts that are used",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not {"filter", "color"} & set(self.cues):
            raise ValueError(f"cues: expected filter or color, which localize the target, among {self.cues}")
