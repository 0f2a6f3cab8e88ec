# SPDX-License-Identifier: MIT
"""Whether what was found is the target, in one number that may be read as a probability."""

import math
from typing import NamedTuple

import numpy as np

from tricue.kernels import Kernels
from tricue.track.fused.experts import BINS, ColorExpert, FilterExpert, cells_of, masks
from tricue.track.fused.view import CELLS, Plane, View

MIDDLE = slice(CELLS // 2 - 1, CELLS // 2 + 2)  # cells: where the filter's answer to the target has to be
# Log-odds of "the overlap is above 0.1", by logistic regression over six recorded videos, the same made
# sparse, turned, shrunk, shaken and lit otherwise, and frames of other videos. With each video left out in
# turn the area under the ROC curve is 0.97.
WEIGHTS = {"sharpness": 0.38, "order": -14.76, "colors": 5.45, "contrast": 8.56, "first": 1.88}
OFFSET = -5.52


class Marks(NamedTuple):
    """What a view of the found target tells of who it is.

    sharpness: standard deviations by which the filter's answer stands above its mean. order: mean distance of
    its ranks from those learnt, in [0, 1]. colors: Bhattacharyya coefficient with the first frame's colors.
    contrast: mean P(target | color) in the box minus that round it. first: the first frame's filter's answer.
    """

    sharpness: float
    order: float
    colors: float
    contrast: float
    first: float

    @property
    def log_odds(self) -> float:
        """Of the target being there; above 0 it rather is."""
        return OFFSET + sum(WEIGHTS[name] * float(value) for name, value in self._asdict().items())

    @property
    def score(self) -> float:
        """The same as a probability."""
        return 1 / (1 + math.exp(-min(max(self.log_odds, -50.0), 50.0)))


class Identity(NamedTuple):
    """What is remembered of the target's look: colors (16³) of the first frame, which never learn, and its
    ranks (3, n), which do.
    """

    colors: Plane
    ranks: Plane

    def marks(self, k: Kernels, view: View, ranks: Plane, filter_: FilterExpert, color: ColorExpert) -> Marks:
        """Of the view whose middle is what was found, and whose ranks (3, n) these are."""
        cells = cells_of(k, view)
        answer = filter_.response(k, cells)
        contrast = k.box_contrast(color.posterior(k, view), *view.size, color.params.frame, 1.0)
        inside, _ = masks(*view.size)
        samples = np.ascontiguousarray(view.colors[:, :, inside])
        seen = k.joint_histogram(samples, BINS)[0]
        return Marks(
            sharpness=float((answer[MIDDLE, MIDDLE].max() - answer.mean()) / max(float(answer.std()), 1e-6)),
            order=float(np.abs(ranks - self.ranks).mean()),
            colors=float(np.sqrt(seen * self.colors.ravel()).sum()),
            contrast=float(contrast[CELLS // 2, CELLS // 2]),
            first=float(filter_.first_response(k, cells)[MIDDLE, MIDDLE].max()),
        )

    def learnt(self, ranks: Plane, rate: float) -> "Identity":
        """With the ranks of a found target blended in."""
        return self._replace(ranks=self.ranks + np.float32(rate) * (ranks - self.ranks))
