# SPDX-License-Identifier: MIT
"""The parameters of the depth particle tracker."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from tricue.track.base.params import OURS, parameter
from tricue.track.depth_objects.params import SegmentationParams

if TYPE_CHECKING:
    from typing_extensions import Self

SR_3000_NEAR, SR_3000_FAR = 0.3, 7.5  # meters, section V
ANY_SPEED = 1e9  # m/s, which no target has


@dataclass(frozen=True, slots=True, kw_only=True)
class DepthParticleParams(SegmentationParams):
    """Lengths are in meters: a person has about the same size everywhere in front of the camera.

    :meth:`paper` has the paper's own form.
    """

    particles: int = parameter(
        100, unit="particles", source="section V", low=2, high=100_000, doc="number of particles"
    )
    sweeps: int = parameter(
        2,
        unit="samplings",
        source="1 as printed; " + OURS,
        low=1,
        high=2,
        doc="per frame; the second is close to the first's estimate",
    )
    rate: float = parameter(
        15.0, unit="frames/s", source=OURS, above=0, doc="assumed for frames without timestamps"
    )

    aspect: tuple[float, float] = parameter(
        (1.0, 6.0),
        unit="height/width",
        source="section IV.A; " + OURS,
        above=0,
        doc="smallest and largest of a human candidate",
    )
    max_fill: float = parameter(
        0.62,
        unit="of its box",
        source=OURS,
        above=0,
        high=1,
        doc="largest share that a human candidate fills; furniture fills more; 1: no limit",
        was="fill",
    )
    human_filter: bool = parameter(
        False,
        unit="-",
        source="True: section IV.A; " + OURS,
        doc="only a human candidate can be the target, also while it is tracked",
    )
    depth_signature: bool = parameter(
        False,
        unit="-",
        source="True: section IV.A; " + OURS,
        doc="tell objects apart by their depth histograms, too",
    )
    complete: bool = parameter(
        True,
        unit="-",
        source=OURS,
        doc="join the pieces of a body, complete it where it is cut, and give its centroid as the position",
    )
    human_height: tuple[float, float] = parameter(
        (0.9, 2.2),
        unit="m",
        source="section IV.A; " + OURS,
        above=0,
        doc="smallest and largest of a human candidate",
    )

    histogram: Literal["relative", "absolute"] = parameter(
        "relative",
        unit="-",
        source="absolute: (38) as printed; " + OURS,
        doc="relative: to the particle's own depth",
    )
    likelihood: Literal["linear", "exponential"] = parameter(
        "exponential",
        unit="-",
        source="(37) is linear; " + OURS,
        doc="likelihood of a distance d: 1 - d, or exp(-sharpness d²)",
    )
    sharpness: float = parameter(30.0, unit="nats", source=OURS, above=0, doc="of the exponential form")
    histogram_reach: float = parameter(
        0.5, unit="m", source=OURS, above=0, doc="half the range of the relative histogram", was="reach"
    )
    bins: int = parameter(64, unit="levels", source=OURS, low=4, high=4096, doc="of the relative histogram")
    grid: tuple[int, int] = parameter(
        (14, 10),
        unit="samples",
        source=OURS,
        low=2,
        high=64,
        doc="rows, columns of the samples in a rectangle",
    )
    contrast: float = parameter(
        8.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="weight of the depth contrast in the log-likelihood; 0: not used",
    )
    margin: float = parameter(
        1.25, unit="half sizes", source=OURS, above=1, doc="outline on which the surround is sampled"
    )
    measurement: float = parameter(
        1.0, unit="-", source=OURS, low=0, doc="weight of the segmented object in the likelihood; 0: not used"
    )
    size_prior: float = parameter(
        1.0, unit="-", source=OURS, low=0, doc="weight of the mean size in the likelihood; 0: not used"
    )
    object_share: float = parameter(
        0.4,
        unit="of particles",
        source="section IV.A; " + OURS,
        low=0,
        below=1,
        doc="share drawn around the segmented object",
    )

    leave_out_others: bool = parameter(
        True,
        unit="-",
        source=OURS,
        doc="exclude surfaces that weren't the target's before and whose depth hasn't changed",
    )

    motion: Literal["velocity", "constant"] = parameter(
        "velocity",
        unit="-",
        source="constant: A = I in (39); " + OURS,
        doc="particles drift with the velocity, and to the mean size, or not at all",
    )
    max_speed: float = parameter(
        2.0, unit="m/s", source="a brisk walk", above=0, doc="the target's highest speed", was="fastest"
    )
    velocity_rate: float = parameter(
        0.5, unit="-", source=OURS, low=0, high=1, doc="learning rate of the velocity; 1: no smoothing"
    )
    position_noise: float = parameter(
        0.5,
        unit="m/s",
        source="K of (39); " + OURS,
        low=0,
        doc="standard deviation of a standing target's position, per second",
        was="agility",
    )
    speed_noise: float = parameter(
        0.5,
        unit="of the speed",
        source="K of (39) grows with the speed",
        low=0,
        doc="standard deviation of the position, per second, added in motion; 0: none",
    )
    size_noise: float = parameter(
        0.06, unit="of the size", source=OURS, above=0, doc="standard deviation per frame"
    )
    size_rate: float = parameter(
        0.15,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="learning rate of the running mean of the size",
    )

    learning_rate: float = parameter(
        0.08,
        unit="per frame",
        source="section IV.C",
        low=0,
        high=1,
        doc="learning rate of the depth histogram",
    )
    max_covered: float = parameter(
        0.25,
        unit="of its area",
        source=OURS,
        low=0,
        high=1,
        doc="largest share that objects in front may cover; a target that is covered more is hidden",
        was="hidden_above",
    )
    min_visible_share: float = parameter(
        0.5,
        unit="of its running mean",
        source=OURS,
        low=0,
        high=1,
        doc="share of the target's area that is at its depth, below which the target is missed",
        was="seen_above",
    )
    likelihood_drop: float = parameter(
        6.0,
        unit="nats",
        source=OURS,
        low=0,
        doc="drop of the log-likelihood below its running mean, from which the target is missed",
        was="surprise",
    )
    coast: bool = parameter(
        True,
        unit="-",
        source=OURS,
        doc="a missed target moves as predicted; False: the filter goes on, and always says TRACKED",
    )
    lost_after: float = parameter(
        1.5, unit="s", source=OURS, low=0, doc="time missed, with nothing in front, until LOST"
    )

    def __post_init__(self) -> None:
        SegmentationParams.__post_init__(self)  # not super(): slots=True makes another class of the same name
        for name in ("aspect", "human_height"):
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name}: expected the lower number first, got {(low, high)}")

    @classmethod
    def paper(cls) -> "Self":
        """The tracker as section IV prints it, without our additions.

        - Segmentation (32)-(36): all maxima of the density divide the range (``prominence``), and nothing but
          connected components separates what a division holds: no floor, no edges, no filled gaps, nothing
          remembered or completed. Z_min and Z_max of (35) are ``near`` and ``far``. The kernel's width
          (``bandwidth``) and the least area of an object aren't printed, and stay ours. Images of 480 columns
          and more are thinned (``resolution``); the paper's 176 aren't.
        - Human candidates: by aspect ratio and by size at their mean depth, always; not by the share of its
          box that a candidate fills. The limits aren't printed, and stay ours.
        - Which candidate is the target: by place and extent along the image's axes and in depth, by its
          horizontal and vertical distribution, and by the depth histogram of its rectangle, (38). No measure
          of similarity is printed: it is the cost of :mod:`tricue.track.depth_particle.matching`. For a
          person cut off by the image's border it leaves out the distributions; a size that was never wholly
          in the image is a lower bound.
        - State: "a scalable rectangle"; ours is in meters, with a depth. The location is the expected value,
          the rectangle's center. Particles, (39): A = I, and K grows with the speed, that of the last step
          (``velocity_rate``). K's numbers aren't printed, and stay ours: in X and Z 3 cm, plus 0.5 m and half
          of the speed per second; less in Y (``AXIS_NOISE``); 6 % of the size per frame.
        - Proposal: 40 % of the particles are drawn from a Gaussian at the target's object, with deviations of
          5 to 8 cm (``OBJECT_DEVIATION``). Neither is printed. Without an object all come from (39).
        - Weights, (2) and (31): resampled in every frame, so the weights before are equal.
        - Likelihood (37), (38): 1 - d of the depths' histograms, 256 levels over the camera's range, of 64 x
          64 places in a rectangle instead of all its pixels. With the counts as printed d would exceed 1:
          they are divided by their sum, and d by its maximum, the square root of 2.
        - The histogram is updated "if estimation confidence is high": while the likelihood of the estimate is
          above 0.6 of its running mean (``likelihood_drop``). Neither this nor the rate is printed; it stays
          ours, 8 % per frame.
        - Nothing is printed about hidden targets: the filter goes on, and every frame is TRACKED.
        - Number of particles and range: those of section V, 100 (of figure 1) and 0.3 to 7.5 m.
        """
        return cls(
            near=SR_3000_NEAR,
            far=SR_3000_FAR,
            floor=False,
            edges=False,
            gap_passes=0,
            prominence=0.0,
            occluder_margin=SR_3000_FAR,  # nothing counts as being in front
            sweeps=1,
            max_fill=1.0,
            human_filter=True,
            depth_signature=True,
            complete=False,
            histogram="absolute",
            likelihood="linear",
            grid=(64, 64),
            contrast=0.0,
            measurement=0.0,
            size_prior=0.0,
            leave_out_others=False,
            motion="constant",
            max_speed=ANY_SPEED,
            velocity_rate=1.0,
            min_visible_share=0.0,
            likelihood_drop=0.5,
            coast=False,
        )
