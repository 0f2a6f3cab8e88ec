# SPDX-License-Identifier: MIT
"""The parameters of the color particle tracker."""

from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter, seconds_of_frames

OURS = "our experiment: benchmarks/README.md"
ObservationName = Literal["region", "gaussian", "lookup", "histogram", "rank-sections", "rank-spatial"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ColorParticleParams(Params):
    """Lengths are in pixels. "target" is the side of a square of the box's area, 2 sqrt(minor major)."""

    particles: int = parameter(
        100, unit="particles", source="section V", low=2, high=100_000, doc="of the filter"
    )

    observation: ObservationName = parameter(
        "rank-spatial",
        unit="-",
        source="section III.B",
        doc="the observation model that weighs the particles",
    )
    likelihood: Literal["linear", "exponential"] = parameter(
        "exponential",
        unit="-",
        source="(18) is the linear form; " + OURS,
        doc="of a distance d: 1 - d, or exp(-sharpness d²)",
    )
    sharpness: float | None = parameter(
        None,
        unit="nats",
        source=OURS,
        above=0,
        doc="of the exponential form; None: the observation model's default",
    )
    grid: tuple[int, int] = parameter(
        (12, 8),
        unit="samples",
        source=OURS,
        low=2,
        high=64,
        doc="rows, columns of the samples in the window",
    )
    grid_reach: float = parameter(
        1.0, unit="semi-axes", source=OURS, above=0, high=4, doc="half the side of that grid"
    )
    color_weight: float = parameter(
        35.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="of the color contrast in the log-likelihood; 0: not used",
    )
    ring: tuple[float, float] = parameter(
        (1.3, 1.8), unit="semi-axes", source=OURS, low=1, high=8, doc="inner and outer radius of the surround"
    )
    ring_samples: int = parameter(40, unit="samples", source=OURS, low=1, high=4096, doc="in the surround")

    skin_threshold: float = parameter(
        0.45,
        unit="of 255 levels",
        source="(10); ROC",
        low=-1,
        high=1,
        doc="of the boundary value, above which a pixel is skin",
    )
    skin_share: float = parameter(
        0.1,
        unit="of particles",
        source="section III.A; " + OURS,
        low=0,
        below=1,
        doc="drawn from the Gaussian of the skin pixels",
    )
    max_step: float = parameter(
        40.0,
        unit="pixels",
        source="section V",
        low=0,
        doc="of a particle per frame, along each axis; the greater of this and max_step_sizes holds",
        was="reach",
    )
    max_step_sizes: float = parameter(
        1.0, unit="target", source=OURS, low=0, doc="the same in sizes of the target", was="reach_sizes"
    )

    velocity_rate: float = parameter(
        0.35, unit="-", source=OURS, low=0, high=1, doc="of learning the velocity; 1: no smoothing"
    )
    position_noise: float = parameter(
        0.05, unit="target", source="K0 of (30); " + OURS, low=0, doc="standard deviation per frame, at rest"
    )
    velocity_noise: float = parameter(
        0.6, unit="of |v|", source="K of (30); " + OURS, low=0, doc="added to position_noise in motion"
    )
    size_noise: float = parameter(
        0.02, unit="of the size", source=OURS, low=0, doc="standard deviation of both semi-axes per frame"
    )
    aspect_noise: float = parameter(
        0.004, unit="of the size", source=OURS, low=0, doc="standard deviation of their ratio per frame"
    )
    size_pull: float = parameter(
        0.06,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="share of the way back to the mean size; holds the size in occlusions",
    )
    size_rate: float = parameter(
        0.008,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="of the running mean of the size",
        was="size_memory",
    )
    size_range: tuple[float, float] = parameter(
        (0.3, 4.0), unit="of the first size", source=OURS, above=0, doc="smallest and largest size"
    )

    resample_below: float = parameter(
        0.5,
        unit="of particles",
        source="Doucet et al. 2001",
        low=0,
        high=1,
        doc="effective sample size below which particles are resampled",
    )
    likelihood_drop: float = parameter(
        10.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="of the log-likelihood below its running mean, from which a wide search starts",
        was="surprise",
    )
    wide_search_spread: float = parameter(
        0.35,
        unit="target",
        source=OURS,
        above=0,
        doc="standard deviation of the positions in the wide search",
        was="sweep",
    )

    learning_rate: float = parameter(
        0.14, unit="per frame", source=OURS, low=0, high=1, doc="of the observation model"
    )
    color_rate: float = parameter(
        0.04, unit="per frame", source=OURS, low=0, high=1, doc="of learning the color contrast"
    )
    first_frame_weight: float = parameter(
        0.3,
        unit="-",
        source=OURS,
        low=0,
        high=1,
        doc="of the first frame's rank map in the distance",
        was="anchor",
    )
    min_score_to_learn: float = parameter(
        0.3,
        unit="score",
        source="section III.C",
        low=0,
        high=1,
        doc="below it nothing is learned",
        was="learn_above",
    )
    min_score: float = parameter(
        0.3,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="below it the target counts as missed in this frame",
        was="lost_below",
    )
    lost_after: float = parameter(
        0.15, unit="s", source=OURS, low=0, doc="time missed until LOST, at least five frames"
    )
    min_score_to_redetect: float = parameter(
        0.6,
        unit="score",
        source=OURS,
        low=0,
        high=1,
        doc="from which a lost target is tracked again",
        was="found_above",
    )
    rate: float = parameter(
        30.0, unit="frames/s", source=OURS, above=0, doc="assumed for frames without timestamps"
    )

    def __post_init__(self) -> None:
        seconds = seconds_of_frames(self.lost_after, "lost_after", self.rate)
        object.__setattr__(self, "lost_after", seconds)
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        for name in ("ring", "size_range"):
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name}: expected the lower number first, got {(low, high)}")
