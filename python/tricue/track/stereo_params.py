# SPDX-License-Identifier: MIT
"""The parameters of the stereo head tracker."""

from dataclasses import dataclass
from typing import Literal

from tricue.track.params import Params, parameter

OURS = "our experiment: benchmarks/README.md"


@dataclass(frozen=True, slots=True, kw_only=True)
class StereoHeadParams(Params):
    """ "Places" are pixels of an image of about ``resolution`` columns, in which the head is searched.

    The paper's own form is ``ring_weight=0``, ``depth_weight=0``, ``learn="all"``, ``motion="constant"``,
    ``noise="polynomial"``, ``disparity_noise=1``, ``center="mean"``, ``feedback=True``; unfused, as in its
    figure 3, is ``fuse=False``.
    """

    resolution: int = parameter(
        160, unit="pixels", source="section 5", low=16, doc="columns of the image that is searched, about"
    )
    search: tuple[int, int] = parameter(
        (8, 4),
        unit="places",
        source="section 5: 8, 2; " + OURS,
        low=0,
        high=64,
        doc="to each side, up and down",
    )
    bins: tuple[int, int, int] = parameter(
        (16, 16, 8), unit="bins", source=OURS, low=1, high=64, doc="of B - G, G - R, B + G + R"
    )
    chroma: int = parameter(
        64, unit="levels", source=OURS, low=1, high=255, doc="where the axes of B - G and G - R end"
    )
    ring: float = parameter(1.5, unit="semi-axes", source=OURS, above=1, high=4, doc="the surround's outline")
    ring_weight: float = parameter(
        0.5, unit="-", source=OURS, low=0, doc="of the surround in a place's score"
    )
    depth_weight: float = parameter(0.4, unit="-", source=OURS, low=0, doc="of coherent depth in that score")
    depth_ring: float = parameter(0.5, unit="-", source=OURS, low=0, doc="of the surround in that share")
    coherent: float = parameter(
        0.6,
        unit="places",
        source=OURS,
        above=0,
        doc="of disparity, within which a pixel is at the head's depth",
    )

    hair: float = parameter(
        0.5, unit="of the histogram", source="section 3.1: skin and hair; " + OURS, low=0, high=1, doc="at first"
    )
    anchor: float = parameter(
        0.15, unit="of the histogram", source=OURS, low=0, high=1, doc="that stays as it was at first"
    )
    learning_rate: float = parameter(0.3, unit="per frame", source="a of (2): 0.1; " + OURS, low=0, high=1)
    learn: Literal["coherent", "all"] = parameter(
        "coherent", unit="-", source="all: section 3.1; " + OURS, doc="pixels that are learnt"
    )
    gate: float = parameter(
        0.6,
        unit="of usual",
        source="section 3.1: a threshold; " + OURS,
        low=0,
        high=1,
        doc="of (1), to learn",
    )

    disparities: tuple[int, int] = parameter(
        (4, 4), unit="places", source="(4), section 5", low=1, high=64, doc="below and above the expected one"
    )
    window: int = parameter(5, unit="places", source=OURS, low=1, high=15, doc="side of the matched window")
    uniqueness: int = parameter(5, unit="percent", source=OURS, low=0, high=100, doc="of a match's cost")
    prefilter: bool = parameter(
        True, unit="-", source=OURS, doc="compare edges: both cameras differ in light"
    )
    center: Literal["median", "mean"] = parameter("median", unit="-", source="mean: (5); " + OURS)

    rim: float = parameter(
        0.25, unit="windows", source="0: (5); " + OURS, low=0, high=1, doc="not matched: the window sees what is behind"
    )
    light: bool = parameter(
        True, unit="-", source=OURS, doc="colors are taken as in the first frame's light"
    )

    fuse: bool = parameter(True, unit="-", source="section 4; False: unfused, figure 3")
    motion: Literal["velocity", "constant"] = parameter("velocity", unit="-", source="constant: (6); " + OURS)
    agility: float = parameter(
        3.0,
        unit="m/s²",
        source=OURS,
        above=0,
        doc="acceleration; of constant motion metres a frame are fastest",
    )
    fastest: float = parameter(1.0, unit="m/s", source="a walk indoors", above=0, doc="of the head")
    noise: Literal["propagated", "polynomial"] = parameter(
        "propagated", unit="-", source="polynomial: (9); " + OURS, doc="of a measured position"
    )
    disparity_noise: float = parameter(0.25, unit="pixels", source="1: figure 2; " + OURS, above=0)
    place_noise: float = parameter(0.7, unit="places", source=OURS, above=0, doc="of the ellipse's centre")
    color_noise: float = parameter(4.0, unit="levels", source="section 4.1; " + OURS, above=0)
    feedback: bool = parameter(
        False, unit="-", source="True: section 4.1; " + OURS, doc="of the filter's colors"
    )
    rate: float = parameter(30.0, unit="frames/s", source="section 5", above=0, doc="without timestamps")

    seen_above: float = parameter(
        0.5, unit="of usual", source=OURS, low=0, high=1, doc="of a place's score: the head is seen"
    )
    surprise: float = parameter(
        5.0, unit="deviations", source=OURS, above=0, doc="of a position that isn't it"
    )
    lost_after: float = parameter(0.5, unit="s", source=OURS, low=0, doc="not seen until LOST")
    again_after: float = parameter(
        0.1, unit="s", source=OURS, low=0, doc="not seen until it is looked for everywhere"
    )
    again_above: float = parameter(
        0.6, unit="of usual", source=OURS, low=0, high=1, doc="of a place's score: it is the head again"
    )
    near: float = parameter(0.4, unit="m", source=OURS, above=0, doc="least distance of a head looked for")
    far: float = parameter(6.0, unit="m", source=OURS, above=0, doc="greatest")

    def __post_init__(self) -> None:
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if self.near >= self.far:
            raise ValueError(f"near: expected under far, {self.far:g} m, got {self.near:g}")
