# SPDX-License-Identifier: MIT
"""The parameters of the segmentation of depth images into objects."""

from dataclasses import dataclass

from tricue.track.base.params import OURS, Params, parameter


@dataclass(frozen=True, slots=True, kw_only=True)
class SegmentationParams(Params):
    """Lengths are in meters: a person has about the same size everywhere in front of the camera."""

    near: float = parameter(
        0.3, unit="m", source="section V: the SR-3000's", above=0, doc="smallest depth used"
    )
    far: float = parameter(
        8.0,
        unit="m",
        source="SR-3000 7.5, RGB-D 8",
        above=0,
        high=1e6,
        doc="depths from here on are not used",
    )
    resolution: int = parameter(
        320, unit="pixels", source=OURS, low=16, doc="wider images are thinned to about this width"
    )
    floor: bool = parameter(True, unit="-", source=OURS, doc="find the floor and remove it")
    floor_clear: float = parameter(0.12, unit="m", source=OURS, low=0, doc="height up to which it is removed")
    edges: bool = parameter(True, unit="-", source=OURS, doc="separate objects at jumps of the depth")
    edge_gap: float = parameter(
        0.06, unit="m", source=OURS, low=0, doc="jump that separates, plus edge_slope z²"
    )
    edge_slope: float = parameter(
        0.01, unit="1/m", source=OURS, low=0, doc="growth of that jump with z², as the noise grows"
    )
    max_gap_share: float = parameter(
        0.06,
        unit="of the pixels",
        source=OURS,
        low=0,
        high=1,
        doc="largest share of small gaps; images with more are filled",
        was="ragged",
    )
    gap_passes: int = parameter(
        3,
        unit="pixels",
        source=OURS,
        low=0,
        high=16,
        doc="how far a gap is filled from its rim, at most; 0: no filling",
    )
    levels: int = parameter(
        256, unit="levels", source="section IV.B", low=8, high=4096, doc="levels of the depth histogram"
    )
    bandwidth: float = parameter(
        0.12, unit="m", source=OURS, above=0, doc="bandwidth of the kernel density of depth (32)"
    )
    prominence: float = parameter(
        0.05,
        unit="of the highest",
        source=OURS,
        low=0,
        high=1,
        doc="prominence of a maximum of that density, from which it is a division",
    )
    min_area: float = parameter(
        0.03,
        unit="m² at far",
        source=OURS,
        above=0,
        doc="smallest area of an object; a number of pixels that is the same at all depths",
        was="least_area",
    )
    occluder_margin: float = parameter(
        0.3,
        unit="m",
        source=OURS,
        above=0,
        doc="an object that is nearer by more than this is in front of the other",
        was="nearer",
    )

    def __post_init__(self) -> None:
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if self.near >= self.far:
            raise ValueError(f"near: expected under far, {self.far:g} m, got {self.near:g}")
        if self.bandwidth > self.far - self.near:
            limit = self.far - self.near
            raise ValueError(f"bandwidth: expected at most far - near, {limit:g} m, got {self.bandwidth:g}")
