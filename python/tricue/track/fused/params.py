# SPDX-License-Identifier: MIT
"""The parameters of the fused tracker: those of its experts, and of its loop."""

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
from tricue.track.fused.sources import OURS


@dataclass(frozen=True, kw_only=True)
class FusedParams(  # dataclasses take the fields of the last base first
    PositionParams, OutlineParams, DepthParams, TurnParams, SizeParams, ColorParams, FilterParams, CueParams
):
    """Units: "target" is the side of the square with the target's area, "box" a side of its box."""

    # the search around the last place
    min_response_share: float = parameter(
        0.5,
        unit="of the mean response",
        source=OURS,
        low=0,
        high=1,
        doc="under it the neighboring windows are searched too",
        was="doubt",
    )
    distance_penalty: float = parameter(
        0.08,
        unit="per squared half window",
        source=OURS,
        low=0,
        doc="on the evidence of neighboring windows",
        was="far",
    )

    # whether it is the target, and what follows from that
    max_covered: float = parameter(
        0.5,
        unit="of the box",
        source=OURS,
        low=0,
        high=1,
        doc="with more covered by an occluder, the target is occluded",
        was="hidden_above",
    )
    min_score: float = parameter(
        0.78,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="under it a frame counts as missed",
        was="lost_below",
    )
    min_score_to_move: float = parameter(
        0.51,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="under it the box stays where it was",
        was="hopeless",
    )
    jump_weight: float = parameter(
        0.7,
        unit="log-odds per typical jump",
        source=OURS,
        low=0,
        doc="that a place has less for jumping farther than the target does",
    )
    lost_after: float = parameter(
        0.08, unit="s", source=OURS, low=0, doc="missed, and in three frames at least, until LOST"
    )
    max_missed_seconds: float = parameter(
        1 / 3, unit="s", source=OURS, low=0, doc="missed, in which it is still followed and learned"
    )
    learn_every: float = parameter(
        0.1, unit="s", source=OURS, low=0, high=1, doc="between two frames in which appearance is learned"
    )

    # the search of the whole frame
    lost_position_noise: float = parameter(
        0.5,
        unit="target per frame",
        source=OURS,
        above=0,
        doc="standard deviation of a missed target's place",
        was="reach",
    )
    min_score_to_redetect: float = parameter(
        0.96,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="that a followed target would have where a missed one is TRACKED again",
        was="found_above",
    )
    min_score_above_clutter: float = parameter(
        0.89,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="that a followed target would have where a missed one that stands out is TRACKED again",
    )
    clutter_margin: float = parameter(
        1.5,
        unit="log-odds",
        source=OURS,
        low=0,
        doc="by which it stands out from all that was seen since it was missed",
    )
    candidates: int = parameter(
        2, unit="places", source=OURS, low=1, high=99, doc="recognized in a search of the whole frame"
    )

    # time
    rate: float = parameter(30.0, unit="frames/s", source=OURS, above=0, doc="where timestamps tell nothing")

    def __post_init__(self) -> None:
        for name in ("lost_after", "learn_every"):
            object.__setattr__(self, name, seconds_of_frames(getattr(self, name), name, self.rate))
        super().__post_init__()
