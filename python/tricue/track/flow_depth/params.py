# SPDX-License-Identifier: MIT
"""The parameters of the flow and depth tracker."""

from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter

OURS = "our experiment: benchmarks/README.md"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowDepthParams(Params):
    """Places are pixels of a picture of at most about ``resolution`` columns, in which flow and disparity
    are measured. Lengths in places are those in a picture of 160 columns, the paper's, and grow with it.

    Nearest to the paper's own form is ``flow_levels=1``, ``disparity_levels=1``, ``ripple=0``,
    ``surround=0``, ``memory=0``, ``posterior=0.5``, ``flow_change=100``, ``depth_change=100``.
    """

    cues: tuple[Literal["flow", "disparity"], ...] = parameter(
        ("flow", "disparity"),
        unit="-",
        source="section 1; one alone: section 5",
        choices=("flow", "disparity"),
    )
    resolution: int = parameter(320, unit="places", source=OURS, low=32, doc="most columns")
    vergence: float = parameter(
        0.0, unit="degrees", source="section 3.1", above=-45, below=45, doc="right camera, inwards"
    )

    sigma: float = parameter(0.8, unit="places", source=OURS, low=0.5, high=8, doc="of the filters g, h")
    flow_levels: int = parameter(2, unit="levels", source="1: section 2; " + OURS, low=1, high=6)
    min_angle: float = parameter(0.05, unit="-", source="(5); " + OURS, low=0, high=1, doc="reliability")
    min_contrast: float = parameter(1.0, unit="levels²", source="(6); " + OURS, low=0, doc="reliability")
    disparity_levels: int = parameter(3, unit="levels", source="1: section 3; " + OURS, low=1, high=6)

    bins: int = parameter(48, unit="bins", source=OURS, low=8, high=512, doc="of each histogram")
    smoothing: float = parameter(1.5, unit="bins", source="section 4.2; " + OURS, above=0, high=8)
    ripple: float = parameter(
        0.05, unit="of the peak", source=OURS, low=0, below=1, doc="what rises less is no minimum's end"
    )
    flow_reach: float = parameter(
        3.0, unit="places", source=OURS, low=0.01, doc="of histograms, round the velocity"
    )
    depth_reach: float = parameter(6.0, unit="places", source=OURS, low=0.01, doc="and round the disparity")
    flow_change: float = parameter(
        0.3, unit="places", source="section 4.1; " + OURS, above=0, doc="of the velocity in a frame"
    )
    depth_change: float = parameter(
        0.5, unit="places", source=OURS, above=0, doc="of the disparity in a frame"
    )
    surround: float = parameter(
        0.8, unit="of P(F)", source="0: section 4.3; " + OURS, low=0, below=1, doc="as around the target"
    )
    sharp: float = parameter(
        0.3,
        unit="-",
        source=OURS,
        above=0,
        high=1,
        doc="of all lengths in disparity, with a depth camera: it errs less than matching does",
    )
    margin: float = parameter(
        0.25, unit="of the width", source="section 4.1; " + OURS, low=0, high=2, doc="candidate region"
    )
    memory: float = parameter(0.8, unit="-", source=OURS, low=0, below=1, doc="of densities, frame to frame")
    posterior: float = parameter(0.8, unit="-", source="(11); " + OURS, above=0, high=1, doc="by both cues")
    posterior_alone: float = parameter(
        0.5, unit="-", source="(11); " + OURS, above=0, high=1, doc="by one cue, which says less"
    )

    neighbours: int = parameter(3, unit="of 8", source=OURS, low=0, high=8, doc="of a target pixel")
    block: float = parameter(
        0.15, unit="of the window", source="section 4.4; " + OURS, above=0, high=1, doc="side"
    )
    share: float = parameter(0.25, unit="of a block", source="section 4.4; " + OURS, above=0, high=1)
    votes: int = parameter(3, unit="frames", source="section 4.4; " + OURS, low=1)
    against: int = parameter(4, unit="frames", source="section 4.4; " + OURS, low=1)
    idle: int = parameter(
        20, unit="frames", source=OURS, low=1, doc="by disparity alone, until a block isn't the target's"
    )
    nearer: float = parameter(2.0, unit="places", source=OURS, above=0, doc="of disparity: an occluder")
    similar: float = parameter(0.75, unit="places", source=OURS, above=0, doc="of disparity: the target's")
    thickness: float = parameter(
        0.1, unit="of the disparity", source=OURS, low=0, below=1, doc="at least that is similar, too"
    )

    covered: float = parameter(
        0.75, unit="of the blocks", source=OURS, above=0, high=1, doc="that are hidden: all of it is"
    )
    few: float = parameter(
        0.1, unit="of usual", source="section 4.5; " + OURS, above=0, high=1, doc="target pixels"
    )
    again: float = parameter(
        0.15, unit="of usual", source="section 4.5; " + OURS, above=0, high=1, doc="that come back"
    )
    unsure: float = parameter(
        0.4, unit="s", source=OURS, low=0, doc="not seen, though nothing hides it, until LOST"
    )
    lost_after: float = parameter(3.0, unit="s", source=OURS, low=0, doc="not seen, until LOST")
    rate: float = parameter(15.0, unit="frames/s", source="section 6", above=0, doc="without timestamps")
    place_noise: float = parameter(2.5, unit="places", source=OURS, above=0, doc="of the window's centre")
    disparity_noise: float = parameter(0.2, unit="places", source=OURS, above=0)
    agility: float = parameter(2.0, unit="m/s²", source=OURS, above=0, doc="while it isn't seen")

    def __post_init__(self) -> None:
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if len(self.cues) not in (1, 2) or len(set(self.cues)) < len(self.cues):
            raise ValueError(f"cues: expected 'flow', 'disparity' or both, got {self.cues}")
