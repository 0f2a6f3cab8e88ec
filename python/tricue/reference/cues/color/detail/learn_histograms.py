# SPDX-License-Identifier: MIT
"""The colors of a target and of its surround, and P(target | color) by Bayes' rule with equal priors."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.joint_histogram import joint_histogram

Samples = NDArray[np.uint8]
Cube = NDArray[np.float32]


def learn_histograms(
    inside: Samples, around: Samples, target: Cube, surround: Cube, rate: float, rare: float, unseen: float
) -> tuple[Cube, Cube, Cube]:
    """Blends the joint histograms of samples (1, 3, n) into both cubes, and computes the posterior's table.

    unseen: P(target) of a color that neither cube has.
    """
    for name, cube in (("target", target), ("surround", surround)):
        side = cube.shape[0]
        if cube.shape != (side, side, side) or side not in (1, 2, 4, 8, 16, 32, 64):
            refuse(name, "shape (B, B, B), B a power of two up to 64", cube.shape)
    if target.shape != surround.shape:
        refuse("surround", "the target's shape", surround.shape)
    if not 0 <= rate <= 1:
        refuse("rate", "a number in [0, 1]", float(rate))
    if not rare > 0:
        refuse("rare", "a number above 0", float(rare))

    def learned(samples: Samples, old: Cube) -> Cube:
        seen = joint_histogram(samples, len(old))[0].reshape(old.shape)
        blended: Cube = old + np.float32(rate) * (seen - old)
        return blended

    own, other = learned(inside, target), learned(around, surround)
    table: Cube = (own + np.float32(unseen * rare)) / (own + other + np.float32(rare))
    return own, other, table
