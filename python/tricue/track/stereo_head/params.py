# SPDX-License-Identifier: MIT
"""The parameters of the stereo head tracker."""

import math
from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter

MOST_BINS = 65535  # that 16 bits number
OURS = "our experiment: benchmarks/README.md"


@dataclass(frozen=True, slots=True, kw_only=True)
class StereoHeadParams(Params):
    """Places are pixels of a picture of about ``resolution`` columns: in it the head is searched.

    The paper's own form is ``ring_weight=0``, ``depth_weight=0``, ``light=False``, ``learn="all"``,
    ``learning_rate=0.1``, ``anchor=0``, ``rim=0``, ``center="mean"``, ``motion="constant"``,
    ``noise="polynomial"``, ``disparity_noise=1``, ``feedback=True``; unfused, as in its figure 3, is
    ``fuse=False``.
    """

    resolution: int = parameter(
        160, unit="pixels", source="section 5", low=16, doc="columns of the picture that is searched"
    )
    search: tuple[int, int] = parameter(
        (8, 4),
        unit="places",
        source="section 5: 8, 2; " + OURS,
        low=0,
        high=64,
        doc="to each side; up and down",
    )
    bins: tuple[int, int, int] = parameter(
        (16, 16, 8), unit="bins", source=OURS, low=1, high=64, doc="of B - G, G - R, B + G + R"
    )
    chroma: int = parameter(
        64, unit="levels", source=OURS, low=1, high=255, doc="where the axes of B - G and G - R end"
    )
    light: bool = parameter(True, unit="-", source=OURS, doc="take colors as in the first frame's light")
    ring: float = parameter(
        1.5, unit="semi-axes", source=OURS, above=1, high=4, doc="outline of the surround"
    )
    ring_weight: float = parameter(
        0.6, unit="-", source=OURS, low=0, doc="of the surround in a place's score"
    )
    depth_weight: float = parameter(0.4, unit="-", source=OURS, low=0, doc="of coherent depth in that score")
    depth_ring: float = parameter(0.5, unit="-", source=OURS, low=0, doc="of the surround in that depth")
    coherent: float = parameter(
        0.6, unit="places", source=OURS, above=0, doc="of disparity, up to which depth is the head's"
    )

    hair: float = parameter(
        0.5, unit="of the model", source="section 3.1; " + OURS, low=0, high=1, doc="in the first frame"
    )
    anchor: float = parameter(
        0.15, unit="of the model", source=OURS, low=0, high=1, doc="that stays as it was in the first frame"
    )
    learning_rate: float = parameter(
        0.3, unit="per frame", source="a of (2); 0.1: section 5; " + OURS, low=0, high=1
    )
    learn: Literal["coherent", "all"] = parameter(
        "coherent", unit="-", source="all: section 3.1; " + OURS, doc="pixels that are learned"
    )
    gate: float = parameter(
        0.6,
        unit="of usual",
        source="section 3.1; " + OURS,
        low=0,
        high=1,
        doc="of (1), from which it is learned",
    )

    disparities: tuple[int, int] = parameter(
        (4, 4), unit="places", source="(4), section 5", low=1, high=64, doc="below and above the expected one"
    )
    window: int = parameter(5, unit="places", source=OURS, low=1, high=15, doc="side of what is matched, odd")
    uniqueness: int = parameter(5, unit="percent", source=OURS, low=0, high=100, doc="of a match's cost")
    prefilter: bool = parameter(True, unit="-", source=OURS, doc="match edges: cameras differ in brightness")
    rim: float = parameter(
        0.25, unit="windows", source="0: (5); " + OURS, low=0, high=1, doc="left out: windows reach over it"
    )
    center: Literal["median", "mean"] = parameter("median", unit="-", source="mean: (5); " + OURS)

    fuse: bool = parameter(True, unit="-", source="section 4; False: figure 3, unfused")
    motion: Literal["velocity", "constant"] = parameter("velocity", unit="-", source="constant: (6); " + OURS)
    agility: float = parameter(6.0, unit="m/s²", source=OURS, above=0, doc="acceleration")
    fastest: float = parameter(1.0, unit="m/s", source="a walk indoors; " + OURS, above=0)
    noise: Literal["propagated", "polynomial"] = parameter(
        "propagated", unit="-", source="polynomial: (9); " + OURS, doc="of a measured position"
    )
    disparity_noise: float = parameter(0.25, unit="pixels", source="1: figure 2; " + OURS, above=0)
    place_noise: float = parameter(0.7, unit="places", source=OURS, above=0, doc="of the ellipse's centre")
    color_noise: float = parameter(4.0, unit="levels", source="section 4.1; " + OURS, above=0)
    feedback: bool = parameter(
        False, unit="-", source="True: section 4.1; " + OURS, doc="the filter's mean color moves the model"
    )
    rate: float = parameter(
        30.0, unit="frames/s", source="section 5", above=0, doc="where frames have no timestamps"
    )

    seen_above: float = parameter(
        0.5, unit="of usual", source=OURS, low=0, high=1, doc="score and depth: the head is seen"
    )
    surprise: float = parameter(
        5.0, unit="deviations", source=OURS, above=0, doc="of a position that isn't the head's"
    )
    again_after: float = parameter(
        0.1, unit="s", source=OURS, low=0, doc="not seen, until it is looked for everywhere"
    )
    again_above: float = parameter(
        0.6, unit="of usual", source=OURS, low=0, high=1, doc="score and depth of the head seen there"
    )
    lost_after: float = parameter(0.5, unit="s", source=OURS, low=0, doc="not seen, until LOST")
    near: float = parameter(0.4, unit="m", source=OURS, low=0.001, doc="least distance of a head")
    far: float = parameter(6.0, unit="m", source=OURS, above=0, doc="greatest distance")

    def __post_init__(self) -> None:
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if self.near >= self.far:
            raise ValueError(f"near: expected under far, {self.far:g} m, got {self.near:g}")
        if math.prod(self.bins) > MOST_BINS:
            raise ValueError(f"bins: expected at most {MOST_BINS} in all, got {self.bins}")
        if self.window % 2 == 0:
            raise ValueError(f"window: expected an odd number, got {self.window}")
