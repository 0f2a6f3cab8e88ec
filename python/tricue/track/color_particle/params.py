# SPDX-License-Identifier: MIT
"""The parameters of the color particle tracker."""

from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import Params, parameter, seconds_of_frames

OURS = "our experiment: benchmarks/README.md"
Observation = Literal["region", "gaussian", "lookup", "histogram", "rank-sections", "rank-spatial"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ColorParticleParams(Params):
    """Sizes are in pixels, "target" is the side of the square as large as the target: 2 sqrt(minor major)."""

    particles: int = parameter(100, unit="particles", source="section V", low=2, high=100_000)

    observation: Observation = parameter(
        "rank-spatial", unit="-", source="section III.B", doc="what particles are compared by"
    )
    likelihood: Literal["linear", "exponential"] = parameter(
        "exponential",
        unit="-",
        source="(18) is the linear form; " + OURS,
        doc="1 - d, or exp(-sharpness d^2)",
    )
    sharpness: float | None = parameter(
        None, unit="nats", source=OURS, above=0, doc="of the exponential form; None: the observation's own"
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
        1.0, unit="semi-axes", source=OURS, above=0, high=4, doc="half side of that grid"
    )
    color_weight: float = parameter(
        35.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="of target against surround colors in the likelihood; 0: off",
    )
    ring: tuple[float, float] = parameter(
        (1.3, 1.8), unit="semi-axes", source=OURS, low=1, high=8, doc="the surround: inner, outer radius"
    )
    ring_samples: int = parameter(40, unit="samples", source=OURS, low=1, high=4096, doc="in the surround")

    skin_threshold: float = parameter(
        0.45,
        unit="of 255 levels",
        source="(10); ROC",
        low=-1,
        high=1,
        doc="skin where the boundary value is above",
    )
    skin_share: float = parameter(
        0.1,
        unit="of particles",
        source="section III.A; " + OURS,
        low=0,
        below=1,
        doc="drawn from the skin's Gaussian",
    )
    reach: float = parameter(
        40.0, unit="pixels", source="section V", low=0, doc="how far particles go in a frame,"
    )
    reach_sizes: float = parameter(1.0, unit="target", source=OURS, low=0, doc="or this, whichever is more")

    velocity_rate: float = parameter(
        0.35, unit="-", source=OURS, low=0, high=1, doc="smoothing of the velocity; 1: none"
    )
    position_noise: float = parameter(0.05, unit="target", source="K0 of (30); " + OURS, low=0)
    velocity_noise: float = parameter(0.6, unit="of |v|", source="K of (30); " + OURS, low=0)
    size_noise: float = parameter(0.02, unit="of the size", source=OURS, low=0)
    aspect_noise: float = parameter(0.004, unit="of the size", source=OURS, low=0)
    size_pull: float = parameter(
        0.06,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="back to the remembered size; holds it in occlusions",
    )
    size_memory: float = parameter(
        0.008, unit="per frame", source=OURS, low=0, high=1, doc="rate of that memory"
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
        doc="effective sample size that resamples",
    )
    surprise: float = parameter(
        10.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="log-likelihood under its usual value that starts a wider sweep",
    )
    sweep: float = parameter(
        0.35, unit="target", source=OURS, above=0, doc="standard deviation of that sweep"
    )

    learning_rate: float = parameter(
        0.14, unit="per frame", source=OURS, low=0, high=1, doc="of the observation's model"
    )
    color_rate: float = parameter(0.04, unit="per frame", source=OURS, low=0, high=1, doc="of the colors")
    anchor: float = parameter(
        0.3, unit="-", source=OURS, low=0, high=1, doc="weight of the first frame's rank map in the distance"
    )
    learn_above: float = parameter(
        0.3, unit="score", source="section III.C", low=0, high=1, doc="no learning under this score"
    )
    lost_below: float = parameter(
        0.3, unit="score", source=OURS, low=0, high=1, doc="a frame under it counts as missed"
    )
    lost_after: float = parameter(
        0.15, unit="s", source=OURS, low=0, doc="missed, and in five frames at least, until LOST"
    )
    found_above: float = parameter(
        0.6, unit="score", source=OURS, low=0, high=1, doc="that ends the search of a lost target"
    )
    rate: float = parameter(
        30.0, unit="frames/s", source=OURS, above=0, doc="where frames have no timestamps"
    )

    def __post_init__(self) -> None:
        seconds = seconds_of_frames(self.lost_after, "lost_after", self.rate)
        object.__setattr__(self, "lost_after", seconds)
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        for name in ("ring", "size_range"):
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name}: expected the lower number first, got {(low, high)}")
