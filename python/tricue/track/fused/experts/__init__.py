# SPDX-License-Identifier: MIT
"""Those who say where the target is and how large: one cue's model of it each, behind two small interfaces.

All are immutable: learning gives another. What a view's pixels tell is brought together by Bayes' rule
(:func:`posterior`); what places tell adds up in :mod:`tricue.track.fused.search`.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from tricue.track.fused.sight import Plane
from tricue.track.fused.view import View


class PixelExpert(Protocol):
    """Tells the target's pixels from the others."""

    def opinion(self, view: View) -> Plane | None:
        """(64, 64) P(target | what the pixel shows), 0.5 where that tells nothing; None where all is so."""


class PlaceExpert(Protocol):
    """Tells the target's place from the others."""

    def evidence(self, view: View) -> Plane:
        """(n, 32, 32) of n models, for the target's centre at each cell: about 1 on it, 0 elsewhere."""


def posterior(opinions: Sequence[Plane | None]) -> Plane | None:
    """(64, 64) what independent opinions of equal priors come to: their odds multiply.

    Okada, Shirai and Miura 1996, (10), for the two classes target and rest.
    """
    heard = [each for each in opinions if each is not None]
    if len(heard) < 2:
        return heard[0] if heard else None
    for_it, against = heard[0], 1 - heard[0]
    for each in heard[1:]:
        for_it, against = for_it * each, against * (1 - each)
    share: Plane = for_it / np.maximum(for_it + against, np.float32(1e-9))
    return share
