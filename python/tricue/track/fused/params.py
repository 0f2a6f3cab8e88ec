# SPDX-License-Identifier: MIT
"""The parameters of the fused tracker."""

from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter, seconds_of_frames

OURS = "our prototype, or a choice not yet compared with others"
Cue = Literal["filter", "color", "size", "depth"]


@dataclass(frozen=True, slots=True, kw_only=True)
class FusedParams(Params):
    """Units: "target" is the side of the square with the target's area, "box" a side of its box."""

    cues: tuple[Cue, ...] = parameter(
        ("filter", "color", "size", "depth"),
        unit="-",
        source="fused.md",
        doc="the experts that are used",
    )
    # the window that experts read
    context: float = parameter(3.0, unit="target", source=OURS, low=1.5, high=8, doc="side of the window")

    # correlation filter: cue "filter"
    label_width: float = parameter(
        0.1,
        unit="target",
        source="Danelljan et al. 2014",
        above=0,
        high=1,
        doc="standard deviation of the desired response",
    )
    temporal_weight: float = parameter(
        2.0, unit="-", source="Li et al. 2018", low=0, doc="that keeps the filter near the one before"
    )
    filter_penalty: float = parameter(
        0.05, unit="-", source="Li et al. 2018", above=0, doc="that keeps the filter in its mask, at first"
    )
    first_frame_weight: float = parameter(
        0.2,
        unit="-",
        source=OURS,
        low=0,
        high=1,
        doc="share of the first frame's filter, for place and size",
        was="anchor",
    )
    filter_weight: float = parameter(0.7, unit="-", source=OURS, low=0, doc="of its response")
    filter_mask_size: float = parameter(
        1.3,
        unit="box",
        source=OURS,
        above=1,
        high=99,
        doc="outer size of what adds to the response; it fades out from the box on",
        was="focus",
    )

    # colors: cue "color"
    color_weight: float = parameter(0.3, unit="-", source=OURS, low=0, doc="of the posterior's contrast")
    color_learning_rate: float = parameter(
        0.04,
        unit="per frame",
        source="Bertinetto et al. 2016",
        low=0,
        high=0.5,
        doc="of the histograms",
        was="color_rate",
    )
    surround_size: float = parameter(
        1.5, unit="box", source=OURS, above=1, doc="outer size of the contrast's surround", was="frame"
    )
    surround_weight: float = parameter(
        0.5, unit="-", source=OURS, low=0, doc="of the surround in the contrast", was="around"
    )

    # size: cue "size"
    size_learning_rate: float = parameter(
        0.025,
        unit="per frame",
        source="Danelljan et al. 2014",
        low=0,
        high=0.5,
        doc="of its filter",
        was="filter_rate",
    )
    ridge: float = parameter(
        1e-2, unit="of the mean energy", source=OURS, above=0, doc="regularization of its filter"
    )
    size_change_penalty: float = parameter(
        0.05, unit="per squared cell", source=OURS, low=0, doc="on the evidence of another size than the last"
    )
    size_range: tuple[float, float] = parameter(
        (0.2, 5.0), unit="of the first size", source=OURS, above=0, doc="limits of the size"
    )

    # depth: cue "depth", the outline, and the position in meters
    depth_learning_rate: float = parameter(
        0.02,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="of the target's depth spread and length",
        was="depth_rate",
    )
    outline_time_constant: float = parameter(
        0.5,
        unit="s",
        source=OURS,
        above=0,
        doc="with which the box's sides follow the outline",
        was="outline_time",
    )
    max_covered: float = parameter(
        0.5,
        unit="of the box",
        source=OURS,
        low=0,
        high=1,
        doc="with more covered by an occluder, the target is occluded",
        was="hidden_above",
    )
    depth_continuity_weight: float = parameter(
        8.0,
        unit="log-odds",
        source=OURS,
        low=0,
        doc="for what stands apart at the expected depth",
        was="continuity",
    )
    acceleration_noise: float = parameter(
        4.0, unit="m/s²", source=OURS, above=0, doc="standard deviation", was="agility"
    )
    max_speed: float = parameter(
        2.0, unit="m/s", source=OURS, above=0, doc="of a target that is measured first", was="fastest"
    )
    rate: float = parameter(30.0, unit="frames/s", source=OURS, above=0, doc="where timestamps tell nothing")

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

    # identity: learning, losing and finding the target
    learn_every: int = parameter(
        3, unit="frames", source=OURS, low=1, high=30, doc="between two in which appearance is learned"
    )
    min_score: float = parameter(
        0.33,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="under it a frame counts as missed",
        was="lost_below",
    )
    min_score_to_move: float = parameter(
        0.02,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="under it the box stays where it was",
        was="hopeless",
    )
    lost_after: float = parameter(
        0.08, unit="s", source=OURS, low=0, doc="missed, and in three frames at least, until LOST"
    )
    max_doubt: float = parameter(
        1 / 3, unit="s", source=OURS, low=0, doc="missed, in which it is still followed and learned"
    )
    lost_position_noise: float = parameter(
        0.5,
        unit="target per frame",
        source=OURS,
        above=0,
        doc="standard deviation of a missed target's place",
        was="reach",
    )
    min_score_to_redetect: float = parameter(
        0.9,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="that a LOST target needs to be TRACKED again",
        was="found_above",
    )
    candidates: int = parameter(
        2, unit="places", source=OURS, low=1, high=99, doc="measured in a search of the whole frame"
    )

    def __post_init__(self) -> None:
        seconds = seconds_of_frames(self.lost_after, "lost_after", self.rate)
        object.__setattr__(self, "lost_after", seconds)
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if not {"filter", "color"} & set(self.cues):
            raise ValueError(f"cues: expected filter or color, which localize the target, among {self.cues}")
        if self.size_range[0] > self.size_range[1]:
            raise ValueError(f"size_range: expected the lower number first, got {self.size_range}")
