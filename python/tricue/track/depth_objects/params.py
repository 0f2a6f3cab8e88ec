# SPDX-License-Identifier: MIT
"""The parameters of the segmentation of depth images into objects."""

from dataclasses import dataclass

from tricue.track.base.params import Params, parameter

OURS = "our experiment: benchmarks/README.md"


@dataclass(frozen=True, slots=True, kw_only=True)
class SegmentationParams(Params):
    """Lengths are in metres: a person has about the same size everywhere in front of the camera."""

    near: float = parameter(0.3, unit="m", source="section V: the SR-3000's", above=0, doc="least depth used")
    far: float = parameter(8.0, unit="m", source="SR-3000 7.5, RGB-D 8", above=0, doc="depth used below it")
    resolution: int = parameter(
        320, unit="pixels", source=OURS, low=16, doc="wider images are thinned out to about this width"
    )
    floor: bool = parameter(True, unit="-", source=OURS, doc="find the floor and take it out")
    floor_clear: float = parameter(0.12, unit="m", source=OURS, low=0, doc="taken out up to this height")
    edges: bool = parameter(True, unit="-", source=OURS, doc="cut objects apart at jumps of the depth")
    edge_gap: float = parameter(0.06, unit="m", source=OURS, low=0, doc="jump that cuts, plus")
    edge_slope: float = parameter(0.01, unit="1/m", source=OURS, low=0, doc="this times z²: noise grows")
    ragged: float = parameter(
        0.06, unit="of the pixels", source=OURS, low=0, high=1, doc="small gaps; with more they are filled"
    )
    gap_passes: int = parameter(
        3, unit="pixels", source=OURS, low=0, high=16, doc="filled from a gap's rim at most; 0: no gaps"
    )
    levels: int = parameter(256, unit="levels", source="section IV.B", low=8, high=4096, doc="of the range")
    bandwidth: float = parameter(
        0.12, unit="m", source=OURS, above=0, doc="of the depth's kernel density (32)"
    )
    prominence: float = parameter(
        0.05, unit="of the greatest", source=OURS, low=0, high=1, doc="of a maximum that counts"
    )
    least_area: float = parameter(0.03, unit="m² at far", source=OURS, above=0, doc="of an object")
    nearer: float = parameter(0.3, unit="m", source=OURS, above=0, doc="so much nearer is in front")

    def __post_init__(self) -> None:
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if self.near >= self.far:
            raise ValueError(f"near: expected under far, {self.far:g} m, got {self.near:g}")
        if self.bandwidth > self.far - self.near:
            reach = self.far - self.near
            raise ValueError(f"bandwidth: expected at most far - near, {reach:g} m, got {self.bandwidth:g}")
