# SPDX-License-Identifier: MIT
"""How trackers look, the same in tables, plots and pictures: ours in solid lines, the peers in broken ones.

Okabe and Ito's colors, which color-blind readers can tell apart, those too light for a contrast of 3 on white
darkened, and a violet and a gray for yellow.
"""

from collections.abc import Sequence
from typing import NamedTuple

from tricue.evaluation.report.markup import Html, tag
from tricue.evaluation.tracker_spec import Entrant

_OURS = ("#0072B2", "#D55E00", "#009E73", "#C2649A", "#000000")
_PEERS = ("#5E3C99", "#B07800", "#2F97D4", "#767676")
_DASHES = ("6 3", "2 2", "8 2 2 2")


class Look(NamedTuple):
    """A line. dashes: lengths in points of strokes and gaps, "" for a solid one."""

    color: str
    dashes: str
    width: float


def looks(entrants: Sequence[Entrant]) -> dict[str, Look]:
    """The look of each entrant, by name; no two are the same among 5 trackers of ours and 12 peers."""
    ours = [each.name for each in entrants if each.ours]
    peers = [each.name for each in entrants if not each.ours]
    found = {name: Look(_OURS[i % len(_OURS)], "", 2.4) for i, name in enumerate(ours)}
    for i, name in enumerate(peers):
        color, style = i % len(_PEERS), i // len(_PEERS) % len(_DASHES)
        found[name] = Look(_PEERS[color], _DASHES[style], 1.6)
    return found


def swatch(look: Look) -> Html:
    """A short piece of the line, beside the tracker's name."""
    line = tag(
        "line",
        x1=0,
        y1=5,
        x2=28,
        y2=5,
        stroke=look.color,
        stroke_width=look.width,
        stroke_dasharray=look.dashes or None,
    )
    return tag("svg", line, class_="swatch", viewBox="0 0 28 10", aria_hidden="true")
