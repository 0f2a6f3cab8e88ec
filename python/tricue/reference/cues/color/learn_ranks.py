# SPDX-License-Identifier: MIT
"""Learning of a rank map."""

import numpy as np

from tricue.reference.base.arrays import Singles
from tricue.reference.base.checks import refuse


def learn_ranks(models: Singles, ranks: Singles, rate: float) -> Singles:
    """Blends the ranks into a copy of the first map."""
    if len(models) < 1:
        refuse("models", "at least one rank map", "none")
    if ranks.shape != models.shape[1:]:
        refuse("models", f"float32 (M, 3, {ranks.shape[1]})", models.shape)
    if not 0 <= rate <= 1:
        refuse("rate", "a number in [0, 1]", float(rate))
    learned: Singles = models.copy()
    learned[0] += np.float32(rate) * (ranks - learned[0])
    return learned
