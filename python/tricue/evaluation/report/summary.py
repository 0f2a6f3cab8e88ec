# SPDX-License-Identifier: MIT
"""The table of a group of sequences: a line per tracker, with intervals. The best numbers are marked, and
those that can't be distinguished from them.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from tricue.evaluation.report.columns import Column, best, with_numbers
from tricue.evaluation.report.comparisons import interval, told
from tricue.evaluation.report.markup import Html, scrolled, tag
from tricue.evaluation.report.plot_styles import LineStyle, swatch
from tricue.evaluation.significance import TrackerComparison

Line = dict[str, Any]

TIMES = ("fps", "p99_ms")
SHOWN_INTERVALS = ("auc",)  # in the table; intervals.csv has the others


def summary_table(
    name: str,
    lines: Sequence[Line],
    total: int,
    ours: set[str],
    styles: Mapping[str, LineStyle],
    compared: Mapping[str, TrackerComparison],
) -> Html:
    """lines: the summary's and the speeds' lines of the group, merged. total: the group's sequences.
    compared: the comparison by column; in columns of times, which aren't compared, only the best is marked.
    """
    columns = with_numbers(lines)
    whole = {line["tracker"] for line in lines if line["sequences"] == total}
    marked = {column.key: _marked(column, lines, whole, compared) for column in columns}
    headings = [_heading(column) for column in columns]
    rows = [
        tag(
            "tr",
            _who(line, total, ours, styles),
            [_cell(column, line, marked[column.key], compared) for column in columns],
            class_="ours" if line["tracker"] in ours else None,
        )
        for line in lines
    ]
    table = tag(
        "table",
        tag("thead", tag("tr", tag("th", "tracker", scope="col"), headings)),
        tag("tbody", rows),
        class_="sortable",
    )
    return tag(
        "div",
        scrolled(table, f"summary, {name}"),
        told(compared["auc"]),
        _partial(lines, total),
        _meanings(columns),
    )


def _marked(
    column: Column, lines: Sequence[Line], whole: set[str], compared: Mapping[str, TrackerComparison]
) -> frozenset[str]:
    """The trackers whose numbers are marked, of those that ran on all sequences."""
    if column.key in compared:
        return compared[column.key].leaders(column.better) & whole
    if column.key not in TIMES or len(whole) < 2:
        return frozenset()
    top = column.text(best(column, [line for line in lines if line["tracker"] in whole]))
    return frozenset(
        line["tracker"] for line in lines if line["tracker"] in whole and column.text(line[column.key]) == top
    )


def _heading(column: Column) -> Html:
    arrow = tag("span", "↑" if column.better > 0 else "↓", class_="way", aria_hidden="true")
    return tag("th", column.heading, arrow, scope="col", title=column.meaning)


def _who(line: Line, total: int, ours: set[str], styles: Mapping[str, LineStyle]) -> Html:
    name, sequences = line["tracker"], line["sequences"]
    few = tag("small", f"{sequences} of {total}") if sequences < total else None
    badge = tag("span", "tricue", class_="badge") if name in ours else None
    return tag("th", swatch(styles[name]), tag("span", name, class_="who"), badge, few, scope="row")


def _cell(
    column: Column, line: Line, marked: frozenset[str], compared: Mapping[str, TrackerComparison]
) -> Html:
    value, is_best = line[column.key], line["tracker"] in marked
    text = column.text(value)
    if math.isnan(value):
        return tag("td", text)
    ends = None
    if column.key in SHOWN_INTERVALS and line["tracker"] in (means := compared[column.key].means):
        ends = interval(means[line["tracker"]].low, means[line["tracker"]].high)
    return tag(
        "td",
        tag("strong", text) if is_best else text,
        ends,
        class_="best" if is_best else None,
        data_value=repr(float(value)),
    )


def _partial(lines: Sequence[Line], total: int) -> Html | None:
    """A note, if some trackers ran on fewer sequences: means over different sequences aren't comparable."""
    few = [
        f"{line['tracker']} ({line['sequences']} of {total})" for line in lines if line["sequences"] < total
    ]
    if not few:
        return None
    words = f"Not run on all {total} sequences, so their means are over fewer: {', '.join(few)}."
    return tag("p", words, " Only trackers that ran on all sequences are marked.", class_="note")


def _meanings(columns: Sequence[Column]) -> Html:
    items = [(tag("dt", column.heading), tag("dd", f"{column.meaning}.")) for column in columns]
    return tag("details", tag("summary", "What the columns mean"), tag("dl", items, class_="meanings"))
