# SPDX-License-Identifier: MIT
"""The stereo head tracker's color search alone, in two dimensions, compared with cv2's trackers.

    python -m benchmarks.quality.cues.color_tracking [FOLDER]

Each tracker starts on the first true box and on six slightly different ones.
"""

import sys
from collections.abc import Sequence

from tricue.evaluation import baselines
from tricue.evaluation.baselines import Maker

from benchmarks.quality.common import perturbed_starts
from benchmarks.quality.common.color_search import ColorSearch, SearchParams

SEQUENCES = ("David", "Girl")
BASELINES = ("CamShift", "meanShift", "KCF")


def makers() -> dict[str, Maker]:
    """The search with and without the gradient, and the baselines that the installed cv2 has."""
    known = baselines.available()
    return {
        "color search": lambda seed: ColorSearch(),
        "color search, no gradient": lambda seed: ColorSearch(SearchParams(gradient_weight=0.0)),
        **{name: known[name] for name in BASELINES if name in known},
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    return perturbed_starts.main("cues.color_tracking", __doc__, SEQUENCES, makers(), arguments)


if __name__ == "__main__":
    sys.exit(main())
