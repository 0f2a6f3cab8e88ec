# SPDX-License-Identifier: MIT
"""Flow alone beside MedianFlow, without any depth: ``python -m benchmarks.quality.cues.motion [FOLDER]``.

The flow and depth tracker with ``cues=("flow",)``; the table, with seven starts, is that of search.
"""

import sys
from collections.abc import Sequence

import tricue
from tricue.evaluation import baselines
from tricue.evaluation.baselines import Maker

from benchmarks.quality.cues import search

NAMES = ("Crossing", "Couple")
PEERS = ("MedianFlow", "MOSSE", "KCF", "CSRT", "still-box")


def makers() -> dict[str, Maker]:
    """Flow alone, and the peers that the installed cv2 has."""
    known = baselines.available()
    return {
        "flow-depth, flow alone": lambda seed: tricue.FlowDepthTracker(cues=("flow",)),
        **{name: known[name] for name in PEERS if name in known},
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code."""
    return search.report("cues.motion", NAMES, makers(), arguments)


if __name__ == "__main__":
    sys.exit(main())
