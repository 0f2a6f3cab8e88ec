# SPDX-License-Identifier: MIT
"""The parameters of the fused tracker: those of its experts and of its loop."""

from dataclasses import dataclass

from tricue.track.base.params import parameter, seconds_of_frames
from tricue.track.fused.experts import CueParams
from tricue.track.fused.experts.color import ColorParams
from tricue.track.fused.experts.correlation_filter import FilterParams
from tricue.track.fused.experts.depth import DepthParams
from tricue.track.fused.experts.size import SizeParams
from tricue.track.fused.experts.turn import TurnParams
from tricue.track.fused.outline import OutlineParams
from tricue.track.fused.position_filter import PositionParams
from tricue.track.fused.sources import PROTOTYPE


@dataclass(frozen=True, kw_only=True)
class FusedParams(  # fields are in the order of the bases, last base first
    PositionParams, OutlineParams, DepthParams, TurnParams, SizeParams, ColorParams, FilterParams, CueParams
):
    """Units: "target" is the side of the square with the target's area, "box" a side of its box."""

    # the search around the last place
    min_response_share: float = parameter(
        0.5,
        unit="of the mean response",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="below it the neighboring windows are searched too",
        was="doubt",
    )
    distance_penalty: float = parameter(
        0.08,
        unit="per squared half window",
        source=PROTOTYPE,
        low=0,
        doc="penalty on the evidence of neighboring windows",
        was="far",
    )

    # whether a match is the target, and what follows from that
    max_covered: float = parameter(
        0.5,
        unit="of the box",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="share covered by an occluder, above which the target is occluded",
        was="hidden_above",
    )
    min_score: float = parameter(
        0.78,
        unit="score",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="below it a frame counts as missed",
        was="lost_below",
    )
    min_score_to_move: float = parameter(
        0.51,
        unit="score",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="below it the box stays where it was",
        was="hopeless",
    )
    jump_weight: float = parameter(
        0.7,
        unit="log-odds per typical jump",
        source=PROTOTYPE,
        low=0,
        doc="penalty on a place for a jump that is longer than the target's typical ones",
    )
    lost_after: float = parameter(
        0.08, unit="s", source=PROTOTYPE, low=0, doc="time missed, in at least three frames, until LOST"
    )
    max_missed_seconds: float = parameter(
        1 / 3,
        unit="s",
        source=PROTOTYPE,
        low=0,
        doc="time missed in which the target is still followed and learned",
    )
    learn_every: float = parameter(
        0.1,
        unit="s",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="time between two frames in which appearance is learned",
    )

    # the search of the whole frame
    lost_position_noise: float = parameter(
        0.5,
        unit="target per frame",
        source=PROTOTYPE,
        above=0,
        doc="standard deviation of a missed target's position",
        was="reach",
    )
    min_score_to_redetect: float = parameter(
        0.96,
        unit="score",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="a missed target is TRACKED again if a followed one would have this score",
        was="found_above",
    )
    min_score_above_clutter: float = parameter(
        0.89,
        unit="score",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="the same for a missed target that stands out from the clutter",
    )
    clutter_margin: float = parameter(
        1.5,
        unit="log-odds",
        source=PROTOTYPE,
        low=0,
        doc="margin above the best match in the search that makes a missed target stand out",
    )
    candidates: int = parameter(
        2,
        unit="places",
        source=PROTOTYPE,
        low=1,
        high=99,
        doc="candidates that are verified in a search of the whole frame",
    )

    # time
    rate: float = parameter(
        30.0,
        unit="frames/s",
        source=PROTOTYPE,
        above=0,
        doc="assumed where timestamps are missing or don't increase",
    )

    def __post_init__(self) -> None:
        for name in ("lost_after", "learn_every"):
            object.__setattr__(self, name, seconds_of_frames(getattr(self, name), name, self.rate))
        super().__post_init__()
