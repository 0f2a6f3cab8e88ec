# SPDX-License-Identifier: MIT
"""The flow-depth tracker by flow alone, without depth, compared with cv2's trackers.

    python -m benchmarks.quality.cues.flow_tracking [FOLDER]

Each tracker starts on the first true box and on six slightly different ones.
"""

import sys
from collections.abc import Sequence

import tricue
from tricue.evaluation import baselines
from tricue.evaluation.baselines import Maker

from benchmarks.quality.common import perturbed_starts

SEQUENCES = ("Crossing", "Couple")
BASELINES = ("MedianFlow", "MOSSE", "KCF", "CSRT", "still-box")


def makers() -> dict[str, Maker]:
    """Flow alone, and the baselines that the installed cv2 has."""
    known = baselines.available()
    return {
        "flow-depth, flow alone": lambda seed: tricue.FlowDepthTracker(cues=("flow",)),
        **{name: known[name] for name in BASELINES if name in known},
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    return perturbed_starts.main("cues.flow_tracking", __doc__, SEQUENCES, makers(), arguments)


if __name__ == "__main__":
    sys.exit(main())
