# SPDX-License-Identifier: MIT
"""The kernels' twins in NumPy: slow but plain, they read like the papers and define what the native kernels
must compute. A twin's help says how it computes; the native kernel's contract is appended.
"""

from tricue import _core
from tricue.reference.camera.back_project import back_project
from tricue.reference.camera.rectify_verged import rectify_verged
from tricue.reference.camera.reduce_gray import reduce_gray
from tricue.reference.cues.color.best_ellipse import best_ellipse
from tricue.reference.cues.color.bhattacharyya import bhattacharyya
from tricue.reference.cues.color.box_contrast import box_contrast
from tricue.reference.cues.color.color_bins import color_bins
from tricue.reference.cues.color.color_histogram import color_histogram
from tricue.reference.cues.color.color_lookup import color_lookup
from tricue.reference.cues.color.color_posterior import color_posterior
from tricue.reference.cues.color.color_ranks import color_ranks
from tricue.reference.cues.color.ellipse_search import ellipse_search
from tricue.reference.cues.color.histogram_mean import histogram_mean
from tricue.reference.cues.color.hog_color_cells import hog_color_cells
from tricue.reference.cues.color.image_mean import image_mean
from tricue.reference.cues.color.joint_histogram import joint_histogram
from tricue.reference.cues.color.learn_contrast import learn_contrast
from tricue.reference.cues.color.learn_histogram import learn_histogram
from tricue.reference.cues.color.learn_patch_colors import learn_patch_colors
from tricue.reference.cues.color.learn_ranks import learn_ranks
from tricue.reference.cues.color.pick_pixels import pick_pixels
from tricue.reference.cues.color.rank_distance import rank_distance
from tricue.reference.cues.color.rank_likelihood import rank_likelihood
from tricue.reference.cues.color.rank_search import rank_search
from tricue.reference.cues.color.rank_sections import rank_sections
from tricue.reference.cues.color.rank_window import rank_window
from tricue.reference.cues.color.sample_ellipses import sample_ellipses
from tricue.reference.cues.color.sample_turned_windows import sample_turned_windows
from tricue.reference.cues.color.sample_windows import sample_windows
from tricue.reference.cues.color.section_distance import section_distance
from tricue.reference.cues.color.shift_histogram import shift_histogram
from tricue.reference.cues.color.skin_blobs import skin_blobs
from tricue.reference.cues.color.skin_boundary import skin_boundary
from tricue.reference.cues.color.skin_gaussian import skin_gaussian
from tricue.reference.cues.color.skin_moments import skin_moments
from tricue.reference.cues.color.skin_reference import skin_reference
from tricue.reference.cues.color.skin_rule import skin_rule
from tricue.reference.cues.depth.above_floor import above_floor
from tricue.reference.cues.depth.changed_depth import changed_depth
from tricue.reference.cues.depth.complete_body import complete_body
from tricue.reference.cues.depth.cut_sides import cut_sides
from tricue.reference.cues.depth.density_extrema import density_extrema
from tricue.reference.cues.depth.depth_components import depth_components
from tricue.reference.cues.depth.depth_contrast import depth_contrast
from tricue.reference.cues.depth.depth_density import depth_density
from tricue.reference.cues.depth.depth_distance import depth_distance
from tricue.reference.cues.depth.depth_edges import depth_edges
from tricue.reference.cues.depth.depth_histogram import depth_histogram
from tricue.reference.cues.depth.depth_picture import depth_picture
from tricue.reference.cues.depth.depth_posterior import depth_posterior
from tricue.reference.cues.depth.divide_depth import divide_depth
from tricue.reference.cues.depth.fill_gaps import fill_gaps
from tricue.reference.cues.depth.find_foreground import find_foreground
from tricue.reference.cues.depth.floor_plane import floor_plane
from tricue.reference.cues.depth.ground_distance import ground_distance
from tricue.reference.cues.depth.match_object import match_object
from tricue.reference.cues.depth.measure_objects import measure_objects
from tricue.reference.cues.depth.median_depths import median_depths
from tricue.reference.cues.depth.plane_support import plane_support
from tricue.reference.cues.depth.rectangle_histogram import rectangle_histogram
from tricue.reference.cues.depth.remember_depth import remember_depth
from tricue.reference.cues.depth.segment_depth import segment_depth
from tricue.reference.cues.depth.support_pixels import support_pixels
from tricue.reference.cues.motion.gradient_flow import gradient_flow
from tricue.reference.cues.motion.pyramid_flow import pyramid_flow
from tricue.reference.cues.stereo.ellipse_disparity import ellipse_disparity
from tricue.reference.cues.stereo.gradient_disparity import gradient_disparity
from tricue.reference.cues.stereo.head_cells import head_cells
from tricue.reference.cues.stereo.sad_disparity import sad_disparity
from tricue.reference.fuse.block_counts import block_counts
from tricue.reference.fuse.block_mask import block_mask
from tricue.reference.fuse.block_votes import block_votes
from tricue.reference.fuse.combine_posteriors import combine_posteriors
from tricue.reference.fuse.correlation_response import correlation_response
from tricue.reference.fuse.correlation_train import correlation_train
from tricue.reference.fuse.evidence_peak import evidence_peak
from tricue.reference.fuse.filter_rectangles import filter_rectangles
from tricue.reference.fuse.kalman_predict import kalman_predict
from tricue.reference.fuse.kalman_update import kalman_update
from tricue.reference.fuse.learn_place_filter import learn_place_filter
from tricue.reference.fuse.learn_size_filter import learn_size_filter
from tricue.reference.fuse.localize_target import localize_target
from tricue.reference.fuse.log_polar_shift import log_polar_shift
from tricue.reference.fuse.observe_target import observe_target
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.rank_filter import rank_filter
from tricue.reference.fuse.rectangle_prior import rectangle_prior
from tricue.reference.fuse.regularized_filter import regularized_filter
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize
from tricue.reference.fuse.target_distribution import target_distribution
from tricue.reference.fuse.target_model import target_model
from tricue.reference.fuse.target_outline import target_outline
from tricue.reference.fuse.target_pixels import target_pixels
from tricue.reference.fuse.temporal_window import temporal_window
from tricue.reference.fuse.weighted_histogram import weighted_histogram

__all__ = [
    "above_floor",
    "back_project",
    "best_ellipse",
    "bhattacharyya",
    "block_counts",
    "block_mask",
    "block_votes",
    "box_contrast",
    "changed_depth",
    "color_bins",
    "color_histogram",
    "color_lookup",
    "color_posterior",
    "color_ranks",
    "combine_posteriors",
    "complete_body",
    "correlation_response",
    "correlation_train",
    "cut_sides",
    "density_extrema",
    "depth_components",
    "depth_contrast",
    "depth_density",
    "depth_distance",
    "depth_edges",
    "depth_histogram",
    "depth_picture",
    "depth_posterior",
    "divide_depth",
    "ellipse_disparity",
    "ellipse_search",
    "evidence_peak",
    "fill_gaps",
    "filter_rectangles",
    "find_foreground",
    "floor_plane",
    "gradient_disparity",
    "gradient_flow",
    "ground_distance",
    "head_cells",
    "histogram_mean",
    "hog_color_cells",
    "image_mean",
    "joint_histogram",
    "kalman_predict",
    "kalman_update",
    "learn_contrast",
    "learn_histogram",
    "learn_patch_colors",
    "learn_place_filter",
    "learn_ranks",
    "learn_size_filter",
    "localize_target",
    "log_polar_shift",
    "match_object",
    "measure_objects",
    "median_depths",
    "observe_target",
    "pick_pixels",
    "plane_support",
    "propose",
    "pyramid_flow",
    "rank_distance",
    "rank_filter",
    "rank_likelihood",
    "rank_search",
    "rank_sections",
    "rank_window",
    "rectangle_histogram",
    "rectangle_prior",
    "rectify_verged",
    "reduce_gray",
    "regularized_filter",
    "remember_depth",
    "resample",
    "reweight",
    "sad_disparity",
    "sample_ellipses",
    "sample_turned_windows",
    "sample_windows",
    "section_distance",
    "segment_depth",
    "shift_histogram",
    "skin_blobs",
    "skin_boundary",
    "skin_gaussian",
    "skin_moments",
    "skin_reference",
    "skin_rule",
    "summarize",
    "support_pixels",
    "target_distribution",
    "target_model",
    "target_outline",
    "target_pixels",
    "temporal_window",
    "weighted_histogram",
]


def _add_contracts() -> None:
    """Append the native kernels' contracts, without the line of their signature, to the twins' docstrings."""
    for name in __all__:
        _, _, contract = (getattr(_core, name).__doc__ or "").partition("\n\n")
        twin = globals()[name]
        twin.__doc__ = f"{twin.__doc__ or ''}\n\n{contract}"


_add_contracts()
