# SPDX-License-Identifier: MIT
"""Learning of a color histogram, and its mean color (Moreno et al. 2002, equations (2) and (7))."""

from tricue.reference.base.arrays import Floats
from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.cues.color.detail.color_space import ColorSpace, require_space
from tricue.reference.cues.color.histogram_mean import histogram_mean


def learn_histogram(
    histogram: Floats,
    measured: Floats,
    rate: float,
    first: Floats,
    weight: float,
    space: ColorSpace,
) -> tuple[Floats, Floats, Floats]:
    """Moves the histogram toward the measured one by a share of the difference, then mixes in the first."""
    require_space(*space)
    bins, _ = space
    size = (bins[0] * bins[1] * bins[2],)
    require_shape("histogram", histogram, size)
    require_shape("measured", measured, size)
    _require_share("rate", rate)
    require_shape("first", first, size)
    _require_share("weight", weight)
    learned = histogram + rate * (measured - histogram)
    return learned, (1 - weight) * learned + weight * first, histogram_mean(learned, space)


def _require_share(name: str, share: float) -> None:
    if not 0 <= share <= 1:
        refuse(name, "0 to 1", float(share))
