# SPDX-License-Identifier: MIT
"""The kernels in NumPy: slow and obvious, they read like the papers and say what the native kernels must compute."""

from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

__all__ = ["propose", "resample", "reweight", "summarize"]
