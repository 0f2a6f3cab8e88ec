# SPDX-License-Identifier: MIT
"""The parameters of the fused tracker."""

from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter, seconds_of_frames

FAST = "our experiment on sparse and shaken frames"
OURS = "our prototype, or a choice not yet compared with others"
Cue = Literal["filter", "color", "ranks", "edges", "depth", "flow"]


@dataclass(frozen=True, slots=True, kw_only=True)
class FusedParams(Params):
    """Sizes are in pixels, "target" is the side of the square as large as the target."""

    cues: tuple[Cue, ...] = parameter(
        ("filter", "color", "ranks", "edges", "depth", "flow"),
        unit="-",
        source="fused.md",
        doc="the experts that are asked",
    )
    context: float = parameter(3.0, unit="target", source=OURS, low=1.5, high=8, doc="side of the window")

    label_width: float = parameter(0.1, unit="target", source="Danelljan et al. 2014", above=0, high=1)
    ridge: float = parameter(1e-2, unit="of the mean energy", source=OURS, above=0)
    filter_rate: float = parameter(0.025, unit="per frame", source="Danelljan et al. 2014", low=0, high=0.5)
    anchor: float = parameter(0.1, unit="-", source=OURS, low=0, high=1, doc="of the first frame's filter")
    filter_weight: float = parameter(0.7, unit="-", source=OURS, low=0)

    focus: float = parameter(
        2.0, unit="of the box", source=FAST, above=1, high=99, doc="outer size of what the filter learns"
    )
    background: float = parameter(
        1.0, unit="-", source=FAST, low=0, doc="weight of the rest, to be answered by 0"
    )

    color_weight: float = parameter(0.3, unit="-", source=OURS, low=0)
    color_rate: float = parameter(0.04, unit="per frame", source="Bertinetto et al. 2016", low=0, high=0.5)
    frame: float = parameter(1.5, unit="of the box", source=OURS, above=1, doc="the surround in the evidence")
    around: float = parameter(0.5, unit="-", source=OURS, low=0, doc="weight of the surround")

    scales: int = parameter(11, unit="steps", source=OURS, low=3, high=99)
    scale_step: float = parameter(1.04, unit="-", source=OURS, above=1, high=2)
    scale_reach: float = parameter(1.5, unit="of the box", source=OURS, above=0)
    scale_label: float = parameter(1.0, unit="steps", source=OURS, above=0)
    scale_prior: float = parameter(0.02, unit="per step²", source=OURS, low=0)
    scale_anchor: float = parameter(
        0.4, unit="-", source=OURS, low=0, high=1, doc="of the first frame's ranks"
    )
    rank_weight: float = parameter(1.0, unit="-", source=OURS, low=0)
    edge_weight: float = parameter(1.0, unit="-", source=OURS, low=0)
    size_range: tuple[float, float] = parameter((0.2, 5.0), unit="of the first size", source=OURS, above=0)

    depth_rate: float = parameter(
        0.02, unit="per frame", source=OURS, low=0, high=1, doc="of relief and length"
    )
    outline_time: float = parameter(
        0.5, unit="s", source=OURS, above=0, doc="in which the box's sides follow"
    )
    hidden_above: float = parameter(
        0.5,
        unit="of the box",
        source=OURS,
        low=0,
        high=1,
        doc="covered by what is nearer, it counts as hidden",
    )
    continuity: float = parameter(
        8.0, unit="log-odds", source=OURS, low=0, doc="for what stands apart at the depth that is expected"
    )
    agility: float = parameter(4.0, unit="m/s²", source=OURS, above=0, doc="standard deviation")
    fastest: float = parameter(2.0, unit="m/s", source=OURS, above=0)
    rate: float = parameter(30.0, unit="frames/s", source=OURS, above=0, doc="where timestamps tell nothing")

    velocity_rate: float = parameter(0.5, unit="-", source=OURS, low=0, high=1)
    drift: float = parameter(0.5, unit="of the velocity", source=OURS, low=0, high=1)
    doubt: float = parameter(0.6, unit="of the usual", source=OURS, low=0, high=1)
    far: float = parameter(0.2, unit="-", source=OURS, low=0)

    learn_every: int = parameter(
        3, unit="frames", source=OURS, low=1, high=30, doc="from one in which looks are learnt to the next"
    )
    learn_above: float = parameter(
        0.4, unit="score", source=OURS, low=0, high=1, doc="no learning under this score"
    )
    learn_odd: float = parameter(
        0.2, unit="of the rates", source=OURS, low=0, high=1, doc="where its structure is another"
    )
    lost_below: float = parameter(
        0.3, unit="score", source=OURS, low=0, high=1, doc="a frame under it counts as missed"
    )
    hopeless: float = parameter(
        0.02, unit="score", source=OURS, low=0, high=1, doc="under it the box isn't moved to what was found"
    )
    lost_after: float = parameter(
        0.08, unit="s", source=OURS, low=0, doc="missed, and in three frames at least, until LOST"
    )
    collapse: float = parameter(
        5.0,
        unit="log-odds",
        source=OURS,
        low=0,
        doc="of its structure, at which what is there may be another",
    )
    again: float = parameter(
        0.4,
        unit="of the usual log-odds",
        source=OURS,
        low=0,
        high=1,
        doc="of a missed target, to be taken up",
    )
    reach: float = parameter(
        0.5, unit="target per frame", source=OURS, above=0, doc="standard deviation of where a lost target is"
    )
    found_above: float = parameter(
        0.7, unit="score", source=OURS, low=0, high=1, doc="of something far away, to be taken for the target"
    )
    candidates: int = parameter(
        2, unit="places", source=OURS, low=1, high=99, doc="of the whole frame, examined in a frame"
    )

    def __post_init__(self) -> None:
        seconds = seconds_of_frames(self.lost_after, "lost_after", self.rate)
        object.__setattr__(self, "lost_after", seconds)
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if not {"filter", "color"} & set(self.cues):
            raise ValueError(f"cues: expected filter or color, which say where it is, among {self.cues}")
        if self.scales % 2 == 0:
            raise ValueError(f"scales: expected an odd number, got {self.scales}")
        if self.size_range[0] > self.size_range[1]:
            raise ValueError(f"size_range: expected the lower number first, got {self.size_range}")
