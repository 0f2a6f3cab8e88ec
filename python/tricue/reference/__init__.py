# SPDX-License-Identifier: MIT
"""The kernels in NumPy: slow and obvious, they read like the papers and say what the native kernels must compute."""

from tricue.reference.cues.color.color_ranks import color_ranks
from tricue.reference.cues.color.joint_histogram import joint_histogram
from tricue.reference.cues.color.rank_distance import rank_distance
from tricue.reference.cues.color.sample_ellipses import sample_ellipses
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

__all__ = ["color_ranks", "joint_histogram", "rank_distance", "sample_ellipses", "propose", "resample", "reweight", "summarize"]
