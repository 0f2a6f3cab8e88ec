# SPDX-License-Identifier: MIT
"""The kernels in NumPy: slow and obvious, they read like the papers and say what the native kernels must compute."""

from tricue.reference.fuse.resample import resample

__all__ = ["resample"]
