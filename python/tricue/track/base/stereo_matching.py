# SPDX-License-Identifier: MIT
"""How the kernels compare the images of a stereo pair."""

from typing import NamedTuple


class StereoMatching(NamedTuple):
    """Block matching, as in the kernel ``sad_disparity``.

    window: side, pixels, odd. uniqueness: percent. prefilter: whether slopes are compared, not gray levels.
    """

    window: int
    uniqueness: int
    prefilter: bool = True
