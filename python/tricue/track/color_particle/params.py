# SPDX-License-Identifier: MIT
"""The parameters of the color particle tracker."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from tricue.track.base.params import OURS, Params, parameter, seconds_of_frames

if TYPE_CHECKING:
    from typing_extensions import Self

NEVER = 1e9  # nats or seconds: beyond any that occur
ObservationName = Literal["region", "gaussian", "lookup", "histogram", "rank-sections", "rank-spatial"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ColorParticleParams(Params):
    """Lengths are in pixels. "target" is the side of a square of the box's area, 2 sqrt(minor major)."""

    particles: int = parameter(
        100, unit="particles", source="section V", low=2, high=100_000, doc="number of particles"
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
        doc="likelihood of a distance d: 1 - d, or exp(-sharpness d²)",
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
    window_shape: Literal["box", "ellipse"] = parameter(
        "box", unit="-", source=OURS, doc="the part of the window that is sampled"
    )
    color_weight: float = parameter(
        35.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="weight of the color contrast in the log-likelihood; 0: not used",
    )
    ring: tuple[float, float] = parameter(
        (1.3, 1.8), unit="semi-axes", source=OURS, low=1, high=8, doc="inner and outer radius of the surround"
    )
    ring_samples: int = parameter(
        40, unit="samples", source=OURS, low=1, high=4096, doc="samples in the surround"
    )

    skin_threshold: float = parameter(
        0.45,
        unit="of 255 levels",
        source="(10); ROC",
        low=-1,
        high=1,
        doc="boundary value above which a pixel is skin",
    )
    skin_share: float = parameter(
        0.1,
        unit="of particles",
        source="section III.A; " + OURS,
        low=0,
        below=1,
        doc="share drawn from the Gaussian of the skin pixels",
    )
    skin_region: Literal["reach", "image"] = parameter(
        "reach",
        unit="-",
        source=OURS,
        doc="where skin is detected while tracking: where the target can be next, or everywhere",
    )
    max_step: float = parameter(
        40.0,
        unit="pixels",
        source="section V",
        low=0,
        doc="longest step of a particle per frame, along each axis; the greater of this and "
        "max_step_sizes counts",
        was="reach",
    )
    max_step_sizes: float = parameter(
        1.0, unit="target", source=OURS, low=0, doc="the same in sizes of the target", was="reach_sizes"
    )

    velocity_rate: float = parameter(
        0.35, unit="-", source=OURS, low=0, high=1, doc="learning rate of the velocity; 1: no smoothing"
    )
    drift: float = parameter(
        1.0,
        unit="of v",
        source="A of (30); " + OURS,
        low=0,
        high=1,
        doc="shift of the particles' mean along the velocity; 0: A = I, a random walk",
    )
    position_noise: float = parameter(
        0.05, unit="target", source="K0 of (30); " + OURS, low=0, doc="standard deviation per frame, at rest"
    )
    velocity_noise: float = parameter(
        0.6, unit="of |v|", source="K of (30); " + OURS, low=0, doc="added to position_noise in motion"
    )
    size_noise: float = parameter(
        0.02,
        unit="of the size",
        source=OURS,
        low=0,
        high=1e6,
        doc="standard deviation per frame of both semi-axes together",
    )
    aspect_noise: float = parameter(
        0.004,
        unit="of the size",
        source=OURS,
        low=0,
        high=1e6,
        doc="standard deviation per frame of each semi-axis by itself; that of their ratio is "
        "1.4 times as large",
    )
    size_pull: float = parameter(
        0.06,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="share of the way back to the mean size; keeps the size stable in occlusions",
    )
    size_rate: float = parameter(
        0.008,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="learning rate of the running mean of the size",
        was="size_memory",
    )
    size_range: tuple[float, float] = parameter(
        (0.3, 4.0), unit="of the first size", source=OURS, above=0, high=1e6, doc="smallest and largest size"
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
        doc="drop of the log-likelihood below its running mean that starts a wide search",
        was="surprise",
    )
    max_likelihood_drop: float = parameter(
        40.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="drop of the log-likelihood below its mean on the target, beyond which the target "
        "counts as missed",
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
        0.14, unit="per frame", source=OURS, low=0, high=1, doc="learning rate of the observation model"
    )
    color_rate: float = parameter(
        0.04, unit="per frame", source=OURS, low=0, high=1, doc="learning rate of the color contrast"
    )
    first_frame_weight: float = parameter(
        0.3,
        unit="-",
        source=OURS,
        low=0,
        high=1,
        doc="weight of the first frame's rank map in the distance",
        was="anchor",
    )
    min_score_to_learn: float = parameter(
        0.3,
        unit="recognition",
        source="section III.C",
        low=0,
        high=1,
        doc="below it nothing is learned",
        was="learn_above",
    )
    min_score: float = parameter(
        0.3,
        unit="recognition",
        source=OURS,
        low=0,
        high=1,
        doc="below it the target counts as missed in this frame",
        was="lost_below",
    )
    lost_after: float = parameter(
        0.15, unit="s", source=OURS, low=0, doc="time missed until LOST, at least five frames"
    )
    min_lead: float = parameter(
        15.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="lead of the log-likelihood over the windows beside the target, below which it isn't TRACKED",
    )
    max_time_without_lead: float = parameter(
        2.0, unit="s", source=OURS, low=0, doc="time below min_lead until LOST"
    )
    min_score_to_redetect: float = parameter(
        0.6,
        unit="recognition",
        source=OURS,
        low=0,
        high=1,
        doc="score from which a lost target is tracked again",
        was="found_above",
    )
    rate: float = parameter(
        30.0, unit="frames/s", source=OURS, above=0, doc="assumed for frames without timestamps"
    )

    @classmethod
    def paper(cls) -> "Self":
        """The tracker as section III prints it, without our additions.

        State and motion, (30)
            A = I: the mean stays where the particle is (``drift=0``), though the text calls that a model of
            constant velocity. K grows with the velocity, taken as the last step, unsmoothed
            (``velocity_rate=1``). Print gives no numbers for K: 5 % of the target at rest and one step more
            in motion (``velocity_noise=1``), on top of half a pixel (``MIN_PIXEL_NOISE``). Both axes of the
            ellipse vary by 2 % a frame, each by itself (``size_noise=0``, ``aspect_noise=0.02``), without a
            pull to a mean size; ``size_range`` only keeps them positive. "Maximum sample propagation area
            is the 40-pixel proximity": 40 px along each axis, whatever the target's size; particles that are
            drawn beyond are set to that border.
        Proposal, (3)-(16)
            (3) takes the most frequent color; as 8-bit colors hardly repeat, it is that of 32 levels a
            channel, in the middle third of the box. It stays that of the first frame.
            (9) is each pixel's largest channel, as its indices have it. The text calls it "the maximum RGB
            value in the image" instead (``tricue reproduce sabeti-roc`` has both). (10) is at most the
            largest channel of the reference color, so dark skin needs a lower threshold. The threshold comes
            from a ROC curve that isn't printed: our default.
            In (11)-(16), I is 1 on the skin pixels of the whole image, and 0 elsewhere. (14)-(16) lack the
            division by the count, without which they are no covariance; it is taken, and 1 px² is added to
            both variances (``MIN_PIXEL_VARIANCE``), so that skin in one row has one, too. Print gives no
            share of the particles: half come from this Gaussian, half from the transition. Less skin than a
            twentieth of the target gives no Gaussian.
        Likelihood, (17)-(29)
            1 - d (18), linear, of all pixels in the ellipse (a grid of 64x48 over its box). Section V says
            that the likelihood combines the ranks with a model of the skin's color, but no equation has one,
            so there is none. N of (19) isn't printed: 16. The sums (25), (26) are over the 256 levels, also
            those without pixels. They are divided by their sum and (29) by 3 sqrt 2, as 1 - d would be
            negative otherwise. (27) and (28) need q(N): the rank closest to 1.
        Weights, (2) and (31)
            Resampled in every frame, as CONDENSATION does; print doesn't say when. So the weights before are
            equal in (2), whose proposal is the mixture of transition and Gaussian.
        Update
            The model is that of the last estimate ("estimated in the previous frame"), where the confidence
            is high. Print doesn't define confidence: at the estimate, d is at most 0.21 (``min_score`` of
            1 - d / 0.3).

        There is no wide search (``likelihood_drop``) and no re-detection (``lost_after``): the paper recovers
        only by its several hypotheses. OCCLUDED still says that little is recognized, and only that
        (``max_likelihood_drop``); a likelihood as printed has no lead (``min_lead``), nor a look back.
        """
        return cls(
            particles=100,
            observation="rank-sections",
            likelihood="linear",
            grid=(64, 48),
            grid_reach=1.0,
            window_shape="ellipse",
            color_weight=0.0,
            skin_share=0.5,
            skin_region="image",
            max_step=40.0,
            max_step_sizes=0.0,
            velocity_rate=1.0,
            drift=0.0,
            velocity_noise=1.0,
            size_noise=0.0,
            aspect_noise=0.02,
            size_pull=0.0,
            size_range=(0.01, 100.0),
            resample_below=1.0,
            likelihood_drop=NEVER,
            max_likelihood_drop=NEVER,
            learning_rate=1.0,
            first_frame_weight=0.0,
            lost_after=NEVER,
        )

    def __post_init__(self) -> None:
        seconds = seconds_of_frames(self.lost_after, "lost_after", self.rate)
        object.__setattr__(self, "lost_after", seconds)
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        for name in ("ring", "size_range"):
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name}: expected the lower number first, got {(low, high)}")
