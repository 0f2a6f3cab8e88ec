# SPDX-License-Identifier: MIT
"""The table of a group of sequences: a line a tracker, the best numbers marked."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from tricue.evaluation.report.columns import Column, best, shown
from tricue.evaluation.report.looks import Look, swatch
from tricue.evaluation.report.markup import Html, scrolled, tag

Line = dict[str, Any]


def summary_table(
    name: str, lines: Sequence[Line], total: int, ours: set[str], looks: Mapping[str, Look]
) -> Html:
    """lines: the summary's and the speeds' lines of the group, merged. total: the group's sequences."""
    columns = shown(lines)
    whole = [line for line in lines if line["sequences"] == total]
    tops = {column.key: best(column, whole) for column in columns}
    heads = [_head(column) for column in columns]
    rows = [
        tag(
            "tr",
            _who(line, total, ours, looks),
            [_cell(column, line, whole, tops) for column in columns],
            class_="ours" if line["tracker"] in ours else None,
        )
        for line in lines
    ]
    table = tag(
        "table",
        tag("thead", tag("tr", tag("th", "tracker", scope="col"), heads)),
        tag("tbody", rows),
        class_="sortable",
    )
    return tag("div", scrolled(table, f"summary, {name}"), _partial(lines, total), _meanings(columns))


def _head(column: Column) -> Html:
    arrow = tag("span", "↑" if column.better > 0 else "↓", class_="way", aria_hidden="true")
    return tag("th", column.head, arrow, scope="col", title=column.meaning)


def _who(line: Line, total: int, ours: set[str], looks: Mapping[str, Look]) -> Html:
    name, sequences = line["tracker"], line["sequences"]
    few = tag("small", f"{sequences} of {total}") if sequences < total else None
    badge = tag("span", "tricue", class_="badge") if name in ours else None
    return tag("th", swatch(looks[name]), tag("span", name, class_="who"), badge, few, scope="row")


def _cell(column: Column, line: Line, whole: Sequence[Line], tops: Mapping[str, float]) -> Html:
    value = line[column.key]
    is_best = len(whole) > 1 and line in whole and column.text(value) == column.text(tops[column.key])
    text = column.text(value)
    if math.isnan(value):
        return tag("td", text)
    return tag(
        "td",
        tag("strong", text) if is_best else text,
        class_="best" if is_best else None,
        data_value=repr(float(value)),
    )


def _partial(lines: Sequence[Line], total: int) -> Html | None:
    """Means over other sequences don't compare."""
    few = [
        f"{line['tracker']} ({line['sequences']} of {total})" for line in lines if line["sequences"] < total
    ]
    if not few:
        return None
    words = f"Not run on all of the {total} sequences, so that their means are of fewer: {', '.join(few)}."
    return tag("p", words, " Only trackers that ran on all are marked as best.", class_="note")


def _meanings(columns: Sequence[Column]) -> Html:
    items = [(tag("dt", column.head), tag("dd", f"{column.meaning}.")) for column in columns]
    return tag("details", tag("summary", "What the columns mean"), tag("dl", items, class_="meanings"))
