# SPDX-License-Identifier: MIT
"""The parameters of the stereo head tracker."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from tricue.track.base.params import OURS, Params, parameter

if TYPE_CHECKING:
    from typing_extensions import Self

MAX_COLOR_BINS = 65535  # that 16 bits can number, with one value left for "none"
NEVER = 1e9  # seconds or standard deviations, never reached


@dataclass(frozen=True, slots=True, kw_only=True)
class StereoHeadParams(Params):
    """The head is searched in a reduced image of about ``resolution`` columns, or of more if the head were
    less than ``min_head_cells`` wide there. A cell is one of its pixels.

    :meth:`paper` has the values with which the tracker is the one that the paper prints.
    """

    resolution: int = parameter(
        160, unit="cells", source="section 5", low=16, doc="columns of the image that is searched"
    )
    min_head_cells: int = parameter(
        18,
        unit="cells",
        source=OURS,
        low=0,
        high=1000,
        doc="width that the head has at least in that image, if need be with more columns; 0: any",
    )
    search: tuple[int, int] = parameter(
        (8, 4),
        unit="cells",
        source="8, 2: section 5; " + OURS,
        low=0,
        high=64,
        doc="range of the search: to each side; up and down",
    )
    bins: tuple[int, int, int] = parameter(
        (16, 16, 8), unit="bins", source=OURS, low=1, high=64, doc="of B - G, G - R, B + G + R"
    )
    max_chroma: int = parameter(
        64,
        unit="levels",
        source=OURS,
        low=1,
        high=255,
        doc="where the axes of B - G and G - R end",
        was="chroma",
    )
    compensate_light: bool = parameter(
        True, unit="-", source=OURS, doc="turn colors into those of the first frame's light", was="light"
    )
    ring: float = parameter(
        1.5, unit="semi-axes", source=OURS, above=1, high=4, doc="outer edge of the ring around the ellipse"
    )
    ring_weight: float = parameter(
        0.6, unit="-", source=OURS, low=0, doc="weight of the ring's colors, subtracted from the score"
    )
    depth_weight: float = parameter(
        0.4, unit="-", source=OURS, low=0, doc="weight of the share at the head's depth in the score"
    )
    depth_ring: float = parameter(
        0.5, unit="-", source=OURS, low=0, doc="weight of the ring's share, subtracted from that share"
    )
    disparity_tolerance: float = parameter(
        0.6,
        unit="cells",
        source=OURS,
        above=0,
        high=1e9,
        doc="difference of disparity up to which a cell is at the head's depth",
        was="coherent",
    )

    hair: float = parameter(
        0.5,
        unit="of the model",
        source="section 3.1; " + OURS,
        low=0,
        high=1,
        doc="weight of the head's top in the first model",
    )
    head_colors: tuple[tuple[int, float], ...] | None = parameter(
        None,
        unit="(bin, weight)",
        source="section 3.1: skin and hair samples",
        low=0,
        doc="the first model, bins in the order of color_bins; None: that of the first frame's ellipse",
    )
    first_frame_weight: float = parameter(
        0.15,
        unit="of the model",
        source=OURS,
        low=0,
        high=1,
        doc="weight of the first frame's colors, which is never unlearned",
        was="anchor",
    )
    learning_rate: float = parameter(
        0.3,
        unit="per frame",
        source="a of (2), not printed; " + OURS,
        low=0,
        high=1,
        doc="learning rate of the color model",
    )
    learn: Literal["coherent", "all"] = parameter(
        "coherent",
        unit="-",
        source="all: section 3.1; " + OURS,
        doc="cells of the ellipse that are learned: those at the head's depth, or all",
    )
    min_intersection_to_learn: float = parameter(
        0.6,
        unit="-",
        source="section 3.1; " + OURS,
        low=0,
        high=1,
        doc="intersection (1) from which colors are learned; learning_gate says of what",
        was="gate",
    )
    learning_gate: Literal["relative", "absolute"] = parameter(
        "relative",
        unit="-",
        source="absolute: section 3.1; " + OURS,
        doc="min_intersection_to_learn is a share of the running mean of (1), or a value of (1) itself",
    )

    disparities: tuple[int, int] = parameter(
        (4, 4),
        unit="cells",
        source="(4), section 5",
        low=1,
        high=64,
        doc="range of the disparity: below and above the expected one, each up to 2000 pixels",
    )
    window: int = parameter(
        5, unit="cells", source=OURS, low=1, high=15, doc="side of the matching window, odd"
    )
    subpixel: bool = parameter(
        True, unit="-", source="False: (3), (4); " + OURS, doc="disparities in fractions of a pixel"
    )
    uniqueness: int = parameter(
        5,
        unit="percent",
        source=OURS,
        low=0,
        high=100,
        doc="margin by which other disparities must cost more",
    )
    prefilter: bool = parameter(True, unit="-", source=OURS, doc="match edges: cameras differ in brightness")
    ellipse_margin: float = parameter(
        0.25,
        unit="windows",
        source="0: (5); " + OURS,
        low=0,
        high=1,
        doc="left out of the disparity at the ellipse's edge, where windows reach over it",
        was="rim",
    )
    disparity_statistic: Literal["median", "mean"] = parameter(
        "median",
        unit="-",
        source="mean: (5); " + OURS,
        doc="statistic of the ellipse's disparities",
        was="center",
    )

    fuse: bool = parameter(
        True, unit="-", source="section 4; False: figure 3, unfused", doc="filter the measurements"
    )
    motion: Literal["velocity", "constant"] = parameter(
        "velocity", unit="-", source="constant: (6); " + OURS, doc="constant velocity or constant position"
    )
    acceleration_noise: float = parameter(
        6.0,
        unit="m/s²",
        source=OURS,
        above=0,
        high=1e6,
        doc="standard deviation of the acceleration",
        was="agility",
    )
    max_speed: float = parameter(
        1.0,
        unit="m/s",
        source="a walk indoors; " + OURS,
        above=0,
        high=1e6,
        doc="highest speed of a head: for its first velocity, its motion when constant, and "
        "where it is re-detected",
        was="fastest",
    )
    noise_model: Literal["propagated", "polynomial"] = parameter(
        "propagated",
        unit="-",
        source="polynomial: (9); " + OURS,
        doc="how the noise of a measured position is modeled",
        was="noise",
    )
    disparity_noise: float = parameter(
        0.25,
        unit="pixels",
        source="1: figure 2; " + OURS,
        above=0,
        high=1e6,
        doc="standard deviation of a disparity",
    )
    place_noise: float = parameter(
        0.7, unit="cells", source=OURS, above=0, high=1e6, doc="standard deviation of the ellipse's center"
    )
    color_noise: tuple[float, float, float] = parameter(
        (4.0, 4.0, 4.0),
        unit="levels",
        source="section 4.1; " + OURS,
        above=0,
        doc="standard deviations of the measured mean color; one number stands for all three; only "
        "with feedback do tracks depend on it",
    )
    color_drift: tuple[float, float, float] = parameter(
        (2.0, 2.0, 2.0),
        unit="levels per frame",
        source="section 4.1; " + OURS,
        above=0,
        doc="standard deviations by which the mean color changes; one number stands for all three; only "
        "with feedback do tracks depend on it",
    )
    intersection_noise: float = parameter(
        0.1,
        unit="-",
        source="section 4.1; " + OURS,
        above=0,
        high=1e6,
        doc="standard deviation of the intersection (1), filtered as printed; no track depends on it",
    )
    feedback: bool = parameter(
        False, unit="-", source="True: section 4.1; " + OURS, doc="the filter's mean color moves the model"
    )
    rate: float = parameter(
        30.0, unit="frames/s", source="section 5", above=0, doc="assumed for frames without timestamps"
    )

    min_score: float = parameter(
        0.5,
        unit="of the running mean",
        source=OURS,
        low=0,
        high=1,
        doc="score and share at the head's depth from which the head is recognized",
        was="seen_above",
    )
    max_deviations: float = parameter(
        5.0,
        unit="deviations",
        source=OURS,
        above=0,
        doc="largest distance of a measured position from the predicted one",
        was="surprise",
    )
    search_frame_after: float = parameter(
        0.1,
        unit="s",
        source=OURS,
        low=0,
        doc="time without the head until the whole image is searched",
        was="again_after",
    )
    min_score_to_redetect: float = parameter(
        0.6,
        unit="of the running mean",
        source=OURS,
        low=0,
        high=1,
        doc="as min_score, in the search of the whole image",
        was="again_above",
    )
    lost_after: float = parameter(0.5, unit="s", source=OURS, low=0, doc="time without the head until LOST")
    near: float = parameter(0.4, unit="m", source=OURS, low=0.001, doc="smallest distance of a head")
    far: float = parameter(6.0, unit="m", source=OURS, above=0, high=1e9, doc="greatest distance of a head")

    def __post_init__(self) -> None:
        for name in ("color_noise", "color_drift"):
            if isinstance(value := getattr(self, name), (int, float)):
                object.__setattr__(self, name, (value,) * 3)
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if self.near >= self.far:
            raise ValueError(f"near: expected under far, {self.far:g} m, got {self.near:g}")
        if math.prod(self.bins) > MAX_COLOR_BINS:
            raise ValueError(f"bins: expected at most {MAX_COLOR_BINS} in all, got {self.bins}")
        if self.head_colors is not None:
            _check_histogram(self.head_colors, math.prod(self.bins))
        if self.window % 2 == 0:
            raise ValueError(f"window: expected an odd number, got {self.window}")

    @property
    def color_space(self) -> tuple[tuple[int, int, int], int]:
        """Bins and end of the chroma axes, as kernels take them."""
        return self.bins, self.max_chroma

    @property
    def matching(self) -> tuple[int, int, bool]:
        """How cells are matched, as kernels take it."""
        return self.window, self.uniqueness, self.prefilter

    @classmethod
    def paper(cls) -> "Self":
        """The tracker that the paper prints, without our additions; figure 3, unfused, has ``fuse=False``.

        Where print is silent or can't be followed to the letter:

        - Images of 160x120: a wider one is searched in cells, about 160 in a row. Ranges are in cells, too;
          disparities are whole pixels, and the window is 11 pixels wide at 640x480.
        - Start: by [5], another paper. Here the first box is given, or found in the disparities. The first
          disparity is that of most pixels between ``near`` and ``far``, which also limit the position. The
          first state is the first measurement, P_0 its R.
        - Color space: neither bins nor the ends of the axes are printed: the defaults.
        - Model: "a bimodal histogram containing skin and hair data samples" is that of all pixels of the
          first frame's ellipse, which has both. ``head_colors`` holds one of given samples instead.
        - (1), (2): print counts pixels. Histograms are divided by their sum here, as ellipses have different
          sizes; the intersection is a share of 1.
        - (2): a isn't printed: 0.1. Nor is the gate's threshold on (1): 0.5.
        - Search region, 16x4 pixels: the center moves up to 8 pixels to each side and 2 up and down.
        - (3) sums over the ellipse, which would leave (5) nothing to average. The text speaks of each pixel,
          so the sum is over a window around it. Its side isn't printed: 5 pixels, the default. The sign of d
          is that of the rig.
        - (4), with 9 candidates: those around the whole number that is nearest to the expected disparity.
        - (6): the maximum displacement per frame isn't printed: 3 m/s along each axis, the best of 1, 1.5, 3.
        - Q of μ is said to depend on the bins alone: a bin's width / √12, the deviation of a color of
          which only the bin is known. Q of the intersection is 1, as printed.
        - (9): the coefficients aren't printed: fitted to back-projection with 1 pixel of disparity error, as
          figure 2 assumes, to first order, which leaves the square alone, and at the image's border for X and
          Y. These have no error on the optical axis, and in between less than by back-projection.
        - R: a diagonal of squares, of (9) at the measured position plus 0.1 mm, so that none is 0.
        - e of μ and of the intersection: as ``tricue reproduce moreno-fig2`` measures them on a static head,
          the root mean square over the distances.
        - The position is filtered in the camera's frame, not in the world's; the rig's pose turns the result.
          Q is the same along all axes, so only (9) and a motion of the camera itself make a difference.
        - How the filter's μ goes back to the histogram isn't printed: the histogram is shifted as a whole.
        - Nothing tells a head from what hides it, so every measurement counts. Without one, for want of
          disparities, the prediction stays.
        """
        return cls(
            min_head_cells=0,
            search=(8, 2),
            hair=0.0,
            compensate_light=False,
            ring_weight=0.0,
            depth_weight=0.0,
            first_frame_weight=0.0,
            learning_rate=0.1,
            learn="all",
            min_intersection_to_learn=0.5,
            learning_gate="absolute",
            uniqueness=0,
            prefilter=False,
            subpixel=False,
            ellipse_margin=0.0,
            disparity_statistic="mean",
            motion="constant",
            max_speed=3.0,
            noise_model="polynomial",
            disparity_noise=1.0,
            color_noise=(0.5, 0.6, 2.4),
            color_drift=(2.31, 2.31, 27.6),
            intersection_noise=0.04,
            feedback=True,
            min_score=0.0,
            max_deviations=NEVER,
            search_frame_after=NEVER,
        )


def _check_histogram(histogram: tuple[tuple[int, float], ...], bins: int) -> None:
    """ValueError for a bin that doesn't exist or occurs twice, and for weights without a positive sum."""
    indices = [index for index, _ in histogram]
    if len(set(indices)) < len(indices) or max(indices, default=0) >= bins:
        raise ValueError(f"head_colors: expected each bin once and below {bins}, the product of bins")
    if not sum(weight for _, weight in histogram) > 0:
        raise ValueError("head_colors: expected weights of a sum above 0")
