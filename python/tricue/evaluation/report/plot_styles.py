# SPDX-License-Identifier: MIT
"""Line styles of trackers in tables, plots and pictures: tricue's solid, the baselines' dashed.

The colors are Okabe and Ito's, which color-blind readers can distinguish. Those too light for a contrast of 3
on white are darkened; violet and gray replace yellow.
"""

from collections.abc import Sequence
from typing import NamedTuple

from tricue.evaluation.report.markup import Html, tag
from tricue.evaluation.tracker_spec import TrackerSpec

_TRICUE_COLORS = ("#0072B2", "#D55E00", "#009E73", "#C2649A", "#000000")
_BASELINE_COLORS = ("#5E3C99", "#B07800", "#2F97D4", "#767676")
_DASHES = ("6 3", "2 2", "8 2 2 2")


class LineStyle(NamedTuple):
    """A line. dashes: lengths of strokes and gaps in points, "" for a solid line."""

    color: str
    dashes: str
    width: float


def line_styles(specs: Sequence[TrackerSpec]) -> dict[str, LineStyle]:
    """The style of each tracker, by name; 5 trackers of tricue and 12 baselines get different ones."""
    ours = [each.name for each in specs if each.ours]
    baselines = [each.name for each in specs if not each.ours]
    found = {name: LineStyle(_TRICUE_COLORS[i % len(_TRICUE_COLORS)], "", 2.4) for i, name in enumerate(ours)}
    for i, name in enumerate(baselines):
        color, dashes = i % len(_BASELINE_COLORS), i // len(_BASELINE_COLORS) % len(_DASHES)
        found[name] = LineStyle(_BASELINE_COLORS[color], _DASHES[dashes], 1.6)
    return found


def swatch(style: LineStyle) -> Html:
    """A short piece of the line, beside the tracker's name."""
    line = tag(
        "line",
        x1=0,
        y1=5,
        x2=28,
        y2=5,
        stroke=style.color,
        stroke_width=style.width,
        stroke_dasharray=style.dashes or None,
    )
    return tag("svg", line, class_="swatch", viewBox="0 0 28 10", aria_hidden="true")
