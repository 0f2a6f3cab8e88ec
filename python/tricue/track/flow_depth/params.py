# SPDX-License-Identifier: MIT
"""The parameters of the flow and depth tracker."""

import typing
from dataclasses import dataclass
from typing import Literal

from tricue.track.base.params import OURS, Params, parameter

if typing.TYPE_CHECKING:
    from typing_extensions import Self

NEVER = 1e9  # seconds
ANY_CHANGE = 1e12  # cells, so that no peak is preferred to a higher one
MAX_VOTES = 1_000_000_000  # frames, over a year of video
PAPER_COLUMNS = 160  # of the paper's images, to which lengths in the parameters refer


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowDepthParams(Params):
    """Flow and disparity are measured in a reduced image of at most about ``resolution`` columns. A cell is
    one of its pixels. Lengths in cells are those in an image of 160 columns, the paper's, and grow with it.
    :meth:`paper` has the paper's own form.
    """

    # what is measured
    cues: tuple[Literal["flow", "disparity"], ...] = parameter(
        ("flow", "disparity"),
        unit="-",
        source="section 1; one alone: section 5",
        choices=("flow", "disparity"),
        doc="what is measured",
    )
    resolution: int = parameter(
        320, unit="cells", source=OURS, low=32, doc="largest number of columns of the image that is measured"
    )
    vergence: float = parameter(
        0.0,
        unit="degrees",
        source="section 3.1",
        above=-45,
        below=45,
        doc="by which the right camera is turned inwards",
    )

    # flow and disparity, sections 2 and 3
    sigma: float = parameter(0.8, unit="cells", source=OURS, low=0.5, high=8, doc="of the filters g, h")
    flow_levels: int = parameter(
        2, unit="levels", source="1: section 2; " + OURS, low=1, high=6, doc="levels of the flow's pyramid"
    )
    min_angle: float = parameter(
        0.05, unit="-", source="(5); " + OURS, low=0, high=1, doc="reliability of the flow"
    )
    min_contrast: float = parameter(
        1.0, unit="(levels/cell²)²", source="(6); " + OURS, low=0, doc="reliability of the flow"
    )
    disparity_levels: int = parameter(
        3,
        unit="levels",
        source="1: section 3; " + OURS,
        low=1,
        high=6,
        doc="levels of the disparity's pyramid",
    )
    disparity_radius: int = parameter(
        2,
        unit="cells",
        source="0: section 3; " + OURS,
        low=0,
        high=7,
        doc="radius of the window over which a disparity is solved for; 0: each pixel alone",
    )
    max_disparity_step: float = parameter(
        1.0,
        unit="cells",
        source=OURS,
        above=0,
        doc="largest step of the finest level from where it starts; a disparity farther off is left out",
    )

    # the densities, sections 4.1 and 4.2
    bins: int = parameter(48, unit="bins", source=OURS, low=8, high=512, doc="bins of each histogram")
    smoothing: float = parameter(
        1.5,
        unit="bins",
        source="section 4.2; " + OURS,
        above=0,
        high=8,
        doc="standard deviation of the smoothing of histograms",
    )
    histogram_region: Literal["blocks", "window"] = parameter(
        "blocks",
        unit="-",
        source="window: section 4.2; blocks: " + OURS,
        choices=("blocks", "window"),
        doc="cells of the histograms: those of the target's blocks in the temporal window, flow only at the "
        "target's depth; or all in the temporal window",
    )
    min_prominence: float = parameter(
        0.05,
        unit="of the peak",
        source=OURS,
        low=0,
        below=1,
        doc="rise of a histogram by which a minimum ends the target's part",
        was="ripple",
    )
    flow_half_range: float = parameter(
        3.0,
        unit="cells",
        source=OURS,
        low=0.01,
        high=PAPER_COLUMNS,
        doc="half the range of the flow's histograms, around the velocity",
        was="flow_reach",
    )
    disparity_half_range: float = parameter(
        6.0,
        unit="cells",
        source=OURS,
        low=0.01,
        high=PAPER_COLUMNS,
        doc="half the range of the disparity's histogram, around the disparity",
        was="depth_reach",
    )
    flow_change: float = parameter(
        0.3,
        unit="cells",
        source="section 4.1; " + OURS,
        above=0,
        doc="standard deviation of the velocity's change in a frame",
    )
    disparity_change: float = parameter(
        0.5,
        unit="cells",
        source=OURS,
        above=0,
        doc="standard deviation of the disparity's change in a frame",
        was="depth_change",
    )
    velocity_smoothing: bool = parameter(
        True,
        unit="-",
        source="False: section 4.2; " + OURS,
        doc="whether few target pixels pull the velocity to its mean, by which a missed target moves on",
    )
    surround_weight: float = parameter(
        0.8,
        unit="of P(F)",
        source="0: section 4.3; " + OURS,
        low=0,
        below=1,
        doc="weight of the surround's density; the rest is uniform",
        was="surround",
    )
    depth_camera_scale: float = parameter(
        0.3,
        unit="-",
        source=OURS,
        above=0,
        high=1,
        doc="factor of all lengths in disparity with a depth camera, which is more exact than matching",
        was="sharp",
    )
    margin: float = parameter(
        0.25,
        unit="of the width",
        source="section 4.1; " + OURS,
        low=0,
        high=2,
        doc="left and right margin of the candidate region around the window; above and below "
        "it is half as large a share of the height; at least 4 cells each",
    )
    prior_center: float = parameter(
        1.0,
        unit="of the window",
        source="section 4.1; " + OURS,
        low=0,
        high=1,
        doc="sides of the region in which the prior is 1",
    )
    density_memory: float = parameter(
        0.8,
        unit="-",
        source=OURS,
        low=0,
        below=1,
        doc="weight of the densities of the frame before",
        was="memory",
    )

    # target pixels, section 4.3
    min_posterior: float = parameter(
        0.8,
        unit="-",
        source="(11); " + OURS,
        above=0,
        high=1,
        doc="smallest posterior of a target pixel, by both cues",
        was="posterior",
    )
    min_posterior_one_cue: float = parameter(
        0.5,
        unit="-",
        source="(11); " + OURS,
        above=0,
        high=1,
        doc="smallest posterior of a target pixel, by one cue alone, whose posteriors are less extreme",
        was="posterior_alone",
    )
    min_neighbors: int = parameter(
        3,
        unit="of 8",
        source=OURS,
        low=0,
        high=8,
        doc="smallest number of target pixels around a target pixel",
        was="neighbours",
    )
    min_region_share: float = parameter(
        0.2,
        unit="of the largest",
        source="0: section 4; " + OURS,
        low=0,
        high=1,
        doc="size of a connected region of target pixels, below which it is left out",
    )
    outlier_share: float = parameter(
        0.02,
        unit="of the pixels",
        source="0: section 4; " + OURS,
        low=0,
        below=0.5,
        doc="left out on each side of the temporal window",
    )

    # the target's blocks, section 4.4
    block_rules: Literal["adaptive", "printed"] = parameter(
        "adaptive",
        unit="-",
        source="section 4.4; adaptive: " + OURS,
        choices=("adaptive", "printed"),
        doc="printed: blocks divide the box, keep their size, are Not_Target at first, and need target "
        "pixels; adaptive: there are some around the box, too, they grow as the target comes nearer, those "
        "of the box are the target's at first, and depth alone holds them for a while",
    )
    block_side: float = parameter(
        0.15,
        unit="of the window",
        source="section 4.4; " + OURS,
        above=0,
        high=1,
        doc="of a square window's side",
        was="block",
    )
    min_block_share: float = parameter(
        0.25,
        unit="of a block",
        source="section 4.4; " + OURS,
        above=0,
        high=1,
        doc="of target pixels, for a vote",
        was="share",
    )
    votes_to_add: int = parameter(
        3,
        unit="frames",
        source="section 4.4; " + OURS,
        low=1,
        high=MAX_VOTES,
        doc="until a block is the target's",
        was="votes",
    )
    votes_to_remove: int = parameter(
        4,
        unit="frames",
        source="section 4.4; " + OURS,
        low=1,
        high=MAX_VOTES,
        doc="until a block isn't the target's any more",
        was="against",
    )
    votes_to_release: int = parameter(
        8,
        unit="frames",
        source=OURS,
        low=1,
        high=MAX_VOTES,
        doc="in which an occluded block shows what is behind the target, until it isn't the target's",
    )
    max_frames_without_pixels: int = parameter(
        20,
        unit="frames",
        source=OURS,
        low=1,
        high=MAX_VOTES,
        doc="by disparity alone, until a block isn't the target's any more",
        was="idle",
    )
    occluder_margin: float = parameter(
        2.0,
        unit="cells",
        source=OURS,
        above=0,
        doc="disparity above the target's from which something is an occluder",
        was="nearer",
    )
    disparity_tolerance: float = parameter(
        0.75,
        unit="cells",
        source=OURS,
        above=0,
        doc="difference of disparity up to which a cell is at the target's depth",
        was="similar",
    )
    thickness: float = parameter(
        0.1,
        unit="of the disparity",
        source=OURS,
        low=0,
        below=1,
        doc="of the target: lower bound of that tolerance and that margin",
    )

    # the whole target, section 4.5
    target_window: Literal["outline", "pixels"] = parameter(
        "outline",
        unit="-",
        source="pixels: section 4.5; outline: " + OURS,
        choices=("outline", "pixels"),
        doc="pixels: the box is the target window, around blocks and target pixels; outline: the window is "
        "around the blocks, and the box halfway from there to the mean outline of the pixels",
    )
    complete_occlusion: Literal["blocks", "disparity"] = parameter(
        "blocks",
        unit="-",
        source="disparity: section 4.5; blocks: " + OURS,
        choices=("blocks", "disparity"),
        doc="by which a target counts as completely occluded and as back: by its blocks and pixels, or by "
        "jumps of the disparity in its window",
    )
    max_occluded_share: float = parameter(
        0.75,
        unit="of the blocks",
        source=OURS,
        above=0,
        high=1,
        doc="share of occluded blocks from which the whole target counts as occluded",
        was="covered",
    )
    min_pixels: float = parameter(
        0.1,
        unit="of the running mean",
        source="section 4.5; " + OURS,
        above=0,
        high=1,
        doc="number of target pixels below which the target is missed",
        was="few",
    )
    min_pixels_to_redetect: float = parameter(
        0.15,
        unit="of the running mean",
        source="section 4.5; " + OURS,
        above=0,
        high=1,
        doc="number of target pixels from which a missed target is found again",
        was="again",
    )
    unoccluded_lost_after: float = parameter(
        0.4,
        unit="s",
        source=OURS,
        low=0,
        doc="time missed, with nothing occluding the target, until LOST",
        was="unsure",
    )
    lost_after: float = parameter(3.0, unit="s", source=OURS, low=0, doc="time missed until LOST")

    # time, and the noise of the position
    rate: float = parameter(
        15.0,
        unit="frames/s",
        source="section 6",
        above=0,
        doc="where frames have no timestamps; with them, too, it sets how fast a missed target's candidate "
        "region grows",
    )
    place_noise: float = parameter(
        2.5,
        unit="cells",
        source=OURS,
        above=0,
        high=PAPER_COLUMNS,
        doc="standard deviation of the window's center",
    )
    disparity_noise: float = parameter(
        0.2, unit="cells", source=OURS, above=0, high=PAPER_COLUMNS, doc="standard deviation of a disparity"
    )
    acceleration_noise: float = parameter(
        2.0,
        unit="m/s²",
        source=OURS,
        above=0,
        doc="standard deviation of the acceleration while the target is missed",
        was="agility",
    )

    def __post_init__(self) -> None:
        Params.__post_init__(self)  # not super(): slots=True makes another class of the same name
        if len(self.cues) not in (1, 2) or len(set(self.cues)) < len(self.cues):
            raise ValueError(f"cues: expected 'flow', 'disparity' or both, got {self.cues}")

    @classmethod
    def paper(cls) -> "Self":
        """The paper as printed, without our additions; for one cue alone, ``cues`` can be replaced.

        Where print is wrong:

        - (4) lacks the minus of (3); here it has it.
        - (7) has a difference of slopes where a gradient method has one of images. It is taken as printed, as
          if f had been filtered by g like the frames of (4): the slopes in (7) and (9) are those of the
          derivative along x of a Gaussian of 1 cell.
        - (8) lacks its parentheses and moves rows alone, so that one depth has other disparities in other
          columns. Rows and columns are rectified (the kernel rectify_verged).

        Where it is silent, and our choice:

        - The filters g, h of (4): derivatives of a Gaussian along x and y, of the mean of two frames; f_t is
          their difference. Flow beyond 2.2 of the Gaussian's deviations, where it is ambiguous, isn't used.
        - (7) reaches one or two pixels: the right image is shifted by the last disparity. Disparities more
          than 100 cells from it aren't used. A depth camera's all have the weight 1 in place of (9).
        - (7) divides by the squared slope, which may be 0: 0.01 is added to it, so that the last disparity
          stays where there is hardly any contrast.
        - In the first frame there is no flow: tracking begins in the second, with a target that stands still.
          The first disparity is that of most of the box, by block matching or by the depth image.
        - The velocity without flow, ``cues=("disparity",)``: it changes by 0.3 of the distance between the
          target pixels' center and the predicted one.
        - The candidate region (section 4.1) is at least 4 cells larger than the window on each side. The
          prior falls to 0 at its edge. Target pixels may be anywhere in it (section 4.3: "in and around" the
          temporal window).
        - Histograms (section 4.2) are centered on the last peak. Peaks are those of the smoothed histograms,
          between bins by a parabola.
        - P(F) in (11) is constant, and has no number. Here P(obj|F) is P(F|obj) P(obj) over itself plus even
          densities, which gives the same pixels. A pixel needs a measurement of every cue.
        - Votes and negative votes (section 4.4) add up over all frames in which a block has one state. A
          target block with too few target pixels for a vote counts as one without. A mean disparity needs a
          fifth of the block's cells; without it a block isn't nearer.
        - "Much larger" (sections 4.4 and 4.5) is the same margin for blocks and for the whole target. Too few
          target pixels are less than 0.2 of their running mean, or fewer than 8.
        - Too few target pixels and no occluded block (section 4.5): the target is missed, and moves on at its
          last velocity as far as the image's edge. It is LOST after a while, unless something nearer hides
          it.
        - After a complete occlusion the disparity in the window is the target's.
        - All thresholds, sizes and numbers of votes: the best on scenes of ``tricue reproduce okada-fig8``.
          The least reliability (9) is 0.3.
        """
        return cls(
            resolution=160,
            sigma=1.2,
            flow_levels=1,
            min_contrast=10.0,
            disparity_levels=1,
            disparity_radius=0,
            max_disparity_step=100.0,
            bins=64,
            smoothing=1.0,
            histogram_region="window",
            min_prominence=0.0,
            disparity_half_range=10.0,
            flow_change=ANY_CHANGE,
            disparity_change=ANY_CHANGE,
            velocity_smoothing=False,
            surround_weight=0.0,
            depth_camera_scale=1.0,
            margin=0.05,
            prior_center=0.5,
            density_memory=0.0,
            min_posterior=0.98,
            min_posterior_one_cue=0.85,
            min_neighbors=0,
            min_region_share=0.0,
            outlier_share=0.0,
            block_rules="printed",
            min_block_share=0.1,
            votes_to_remove=8,
            disparity_tolerance=1.2,
            thickness=0.0,
            target_window="pixels",
            complete_occlusion="disparity",
            min_pixels=0.2,
            lost_after=NEVER,
        )
